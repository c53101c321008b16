//! The regressor for a robot known at compile time.

use super::Core;
use crate::algorithms;
use crate::effects::{Effect, Scene};
use crate::model::{BodyNumber, RobotModel, Static};
use crate::scalar::Real;
use crate::state::RobotState;

impl<T, K> Core<T, K> {
    /// Y with τ = Y φ, by coordinates, bodies and parameters, see [`algorithms::regressor`].
    #[inline(never)]
    pub fn regressor<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> [[[R; 10]; B]; V]
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        algorithms::regressor(&Static::<T, K>::NEW, state, effects)
    }

    /// The columns of Y of one body, by coordinates, see [`algorithms::regressor_columns`].
    #[inline(never)]
    pub fn regressor_columns<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
        body: impl BodyNumber,
    ) -> [[R; 10]; V]
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        algorithms::regressor_columns(&Static::<T, K>::NEW, state, effects, body.number())
    }

    /// The row of Y of one coordinate, by bodies, see [`algorithms::regressor_row`].
    #[inline(never)]
    pub fn regressor_row<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
        coordinate: usize,
    ) -> [[R; 10]; B]
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        algorithms::regressor_row(&Static::<T, K>::NEW, state, effects, coordinate)
    }

    /// Its entries at these bodies, see [`algorithms::regressor_row_of_bodies`].
    #[inline(never)]
    pub fn regressor_row_of_bodies<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
        coordinate: usize,
        bodies: &[bool; B],
    ) -> [[R; 10]; B]
    where
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        algorithms::regressor_row_of_bodies(
            &Static::<T, K>::NEW,
            state,
            effects,
            coordinate,
            bodies,
        )
    }
}
