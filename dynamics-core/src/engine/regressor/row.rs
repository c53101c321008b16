//! The row of the regressor of one coordinate, whose number may be known at run time only.

use core::borrow::Borrow;

use super::power::BodyPower;
use crate::effects::Effect;
use crate::engine::acceleration_field::AccelerationField;
use crate::engine::call::Call;
use crate::engine::compile::{Compiled, CompiledJoint, JointPair};
use crate::engine::folding::Folded;
use crate::engine::joint_rates::Twist;
use crate::engine::named::{AllBodies, ListedBody};
use crate::engine::pass::{Nothing, Pass, sweep};
use crate::engine::{Engine, only_if};
use crate::model::Robot;
use crate::scalar::Real;
use crate::state::{Configuration, RobotState, State};
use crate::trig::Kernel;

impl<T, K> Engine<T, K> {
    /// The row of the regressor of one coordinate, by bodies: its torque per unit of each body's
    /// parameters, N·m or N, as [`crate::algorithms::regressor_row`] computes it.
    ///
    /// All entries are zero for a coordinate that the robot does not have.
    ///
    /// # Cost
    /// Some 140 flops for each body; the same instructions for all data and coordinates.
    ///
    /// # Source
    /// As [`Engine::regressor`].
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Core, Engine, effects::RIGID_BODY, robots::Ur5e, state::State};
    /// let state = State { qd: [0.5; 6], qdd: [1.0; 6], ..State::at([0.3_f64; 6]) };
    /// let a = Core::<Ur5e>::regressor_row(&state, &RIGID_BODY, 2);
    /// let b = Engine::<Ur5e>::regressor_row(&state, &RIGID_BODY, 2);
    /// assert!(a.iter().flatten().zip(b.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-12));
    /// ```
    #[cfg_attr(optimised, inline(always))]
    #[must_use]
    pub fn regressor_row<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
        coordinate: usize,
    ) -> [[R; 10]; B]
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        Self::regressor_row_of_bodies(state, effects, coordinate, &[true; B])
    }

    /// The entries of a [`Engine::regressor_row`] at these bodies, and zeros, as
    /// [`crate::algorithms::regressor_row_of_bodies`] computes them.
    ///
    /// # Cost
    /// Some 60 flops for each body, and 80 for each of these; the same instructions for all data
    /// and coordinates.
    ///
    /// # Source
    /// As [`Engine::regressor`].
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Engine, effects::RIGID_BODY, robots::Ur5e, state::State};
    /// let state = State { qd: [0.5; 6], qdd: [1.0; 6], ..State::at([0.3_f64; 6]) };
    /// let bodies = [false, false, true, false, true, false];
    /// let row = Engine::<Ur5e>::regressor_row_of_bodies(&state, &RIGID_BODY, 1, &bodies);
    /// let whole = Engine::<Ur5e>::regressor_row(&state, &RIGID_BODY, 1);
    /// assert_eq!([row[2], row[4], row[5]], [whole[2], whole[4], [0.0; 10]]);
    /// ```
    #[inline(never)]
    #[must_use]
    pub fn regressor_row_of_bodies<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
        coordinate: usize,
        bodies: &[bool; B],
    ) -> [[R; 10]; B]
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        let configuration = state.configuration();
        let trig = configuration.trig_or(Self::trig_source());
        let call = Self::call(trig.borrow(), effects);
        let mut y = [[R::ZERO; 10]; B];
        let mut pass = Row { call, state: state.state(), coordinate, bodies, y: &mut y };
        let at_base = Moving { field: call.base(), by: Twist::ZERO };
        let Nothing = sweep(&mut pass, &at_base);
        y
    }
}

/// A body's field, and its motion at unit rate of the coordinate, in its joint's frame.
#[derive(Clone, Copy)]
struct Moving<R> {
    field: AccelerationField<R>,
    by: Twist<R>,
}

struct Row<'a, R, T, E, const B: usize, const Q: usize, const V: usize> {
    call: Call<'a, R, T, E, B, Q, V>,
    state: &'a State<R, Q, V>,
    coordinate: usize,
    bodies: &'a [bool; B],
    y: &'a mut [[R; 10]; B],
}

impl<R: Real, T: Compiled, E, const B: usize, const Q: usize, const V: usize> Pass
    for Row<'_, R, T, E, B, Q, V>
where
    E: Effect<R, B, V>,
{
    type Tree = T;
    type Outward = Moving<R>;
    type Inward = Nothing;
    const NOTHING: Nothing = Nothing;

    #[cfg_attr(optimised, inline(always))]
    fn enter<const I: usize>(&mut self, parent: &Moving<R>) -> Moving<R> {
        let field = self.call.regressed_field::<I>(&parent.field, self.state);
        let at = self.call.displacement::<I>();
        let mut by = parent.by.carried(&at);
        for_each_joint!(K, {
            if JointPair::<T, I, K>::IS_COORDINATE {
                // A coordinate that moves an ancestor does not move this joint: one of the two
                // motions is zero.
                let rate = Folded::runtime(R::either(self.coordinate == K, R::ONE, R::ZERO));
                let own = Twist::along(CompiledJoint::<T, K>::JOINT, T::LENGTH_INV, rate);
                (by.ang, by.lin) = (by.ang + own.ang, by.lin + own.lin);
            }
        });
        let body = Moving { field, by };
        const { ListedBody::<T, AllBodies, B, I, 0>::ARE_FEW };
        for_each_joint!(N_TH, {
            if let Some(see) = const {
                only_if(
                    ListedBody::<T, AllBodies, B, I, N_TH>::IS_SOME,
                    see::<R, T, B, I, N_TH> as See<R, B>,
                )
            } {
                see(self.y, self.bodies, &body);
            }
        });
        body
    }

    #[cfg_attr(optimised, inline(always))]
    fn leave<const I: usize>(&mut self, _: &Moving<R>, _: Nothing) -> Nothing {
        Nothing
    }
}

type See<R, const B: usize> = fn(&mut [[R; 10]; B], &[bool; B], &Moving<R>);

/// Writes the entries of the K-th body that moves with joint I.
#[cfg_attr(optimised, inline(always))]
fn see<R: Real, T: Compiled, const B: usize, const I: usize, const K: usize>(
    y: &mut [[R; 10]; B],
    bodies: &[bool; B],
    body: &Moving<R>,
) {
    let (at, place) = ListedBody::<T, AllBodies, B, I, K>::BODY;
    if bodies[*at] {
        y[*at] = BodyPower::of(&body.field, place, T::LENGTH).per_parameter(&body.by);
    }
}
