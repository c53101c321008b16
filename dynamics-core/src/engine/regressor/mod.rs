//! The regressor Y of inverse dynamics, which is linear in the inertial parameters: τ = Y(q, q̇,
//! q̈) φ.
//!
//! Atkeson, An & Hollerbach, "Estimation of inertial parameters of manipulator loads and links"
//! (1986). Each entry is the power per parameter as the body moves at unit rate of the coordinate;
//! with the field of a body go outward its motions at unit rate of each coordinate that moves it.

mod power;
mod row;

use core::borrow::Borrow;
use core::marker::PhantomData;

use self::power::BodyPower;
use super::acceleration_field::AccelerationField;
use super::call::Call;
use super::compile::{Compiled, CompiledJoint, JointPair};
use super::folding::Folded;
use super::joint_rates::Twist;
use super::named::{AllBodies, ListedBody, joints};
use super::pass::{Motions, Nothing, Pass, sweep};
use super::{Engine, only_if};
use crate::effects::Effect;
use crate::model::{Bodies, OnBody, Robot};
use crate::scalar::Real;
use crate::state::{Configuration, RobotState, State};
use crate::trig::Kernel;

impl<T, K> Engine<T, K> {
    /// The regressor Y of the joints' torques, by coordinates, bodies and parameters, N·m or N per
    /// unit of each parameter, as [`crate::algorithms::regressor`] computes it.
    ///
    /// # Cost
    /// Some 40 flops for each body, and 60 for each pair of a body and a coordinate that moves it;
    /// the same instructions for all data.
    ///
    /// # Source
    /// Atkeson, An & Hollerbach (1986), (11) to (17).
    ///
    /// # Example
    /// ```
    /// use dynamics_core::algorithms::inertial_parameters;
    /// use dynamics_core::{Engine, effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
    /// let state = State { qd: [0.5; 6], qdd: [1.0; 6], ..State::at([0.3_f64; 6]) };
    /// let y = Engine::<Ur5e>::regressor(&state, &RIGID_BODY);
    /// let phi = inertial_parameters(&Ur5e::MODEL, &());
    /// let tau = y.map(|row| row.iter().flatten().zip(phi.iter().flatten()).map(|(y, phi)| y * phi).sum::<f64>());
    /// let same = Engine::<Ur5e>::rnea(&state, &RIGID_BODY);
    /// assert!(tau.iter().zip(same).all(|(tau, same)| (tau - same).abs() < 1e-12));
    /// ```
    #[doc(alias = "parameter identification")]
    #[inline(never)]
    #[must_use]
    pub fn regressor<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> [[[R; 10]; B]; V]
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        let configuration = state.configuration();
        let trig = configuration.trig_or(Self::trig_source());
        Self::call(trig.borrow(), effects).regressor_columns::<AllBodies, B>(state.state())
    }

    /// The columns of the regressor of one body, by coordinates: the torques of the joints per unit
    /// of its parameters, as [`crate::algorithms::regressor_columns`] computes them.
    ///
    /// A body that the robot does not have does not compile.
    ///
    /// # Cost
    /// Some 80 flops for each coordinate that moves the body; the same instructions for all data.
    ///
    /// # Source
    /// As [`Engine::regressor`].
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Core, Engine, effects::RIGID_BODY, model::{OnBody, Robot}, robots::Ur5e, state::State};
    /// const WRIST: usize = Ur5e::MODEL.body("wrist_3");
    /// let state = State { qd: [0.5; 6], qdd: [1.0; 6], ..State::at([0.3_f64; 6]) };
    /// let a = Core::<Ur5e>::regressor_columns(&state, &RIGID_BODY, OnBody::<WRIST>);
    /// let b = Engine::<Ur5e>::regressor_columns(&state, &RIGID_BODY, OnBody::<WRIST>);
    /// assert!(a.iter().flatten().zip(b.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-12));
    /// ```
    #[doc(alias = "payload identification")]
    #[inline(never)]
    #[must_use]
    pub fn regressor_columns<
        R: Real,
        E,
        const BODY: usize,
        const B: usize,
        const Q: usize,
        const V: usize,
    >(
        state: impl RobotState<R, Q, V>,
        effects: &E,
        body: OnBody<BODY>,
    ) -> [[R; 10]; V]
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        let _ = body;
        let configuration = state.configuration();
        let trig = configuration.trig_or(Self::trig_source());
        Self::call(trig.borrow(), effects)
            .regressor_columns::<OnBody<BODY>, 1>(state.state())
            .map(|[columns]| columns)
    }
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Call<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    /// The columns of the bodies of the list.
    #[cfg_attr(optimised, inline(always))]
    fn regressor_columns<List: Bodies<N>, const N: usize>(
        self,
        state: &State<R, Q, V>,
    ) -> [[[R; 10]; N]; V] {
        let mut y = [[[R::ZERO; 10]; N]; V];
        let mut pass = Columns::<R, T, List, E, N, B, Q, V> {
            call: self,
            state,
            y: &mut y,
            types: PhantomData,
        };
        let at_base = Moving { field: self.base(), by: [Twist::ZERO; V] };
        let Nothing = sweep(&mut pass, &at_base);
        y
    }

    /// The field of the body behind joint I, as far as the effects need it.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn regressed_field<const I: usize>(
        self,
        parent: &AccelerationField<R>,
        state: &State<R, Q, V>,
    ) -> AccelerationField<R> {
        let motions = Motions {
            turns: self.turns,
            qd: &state.qd,
            qdd: &state.qdd,
            velocity: false,
            products: E::VELOCITY_PRODUCTS,
            accel: E::ACCELERATIONS,
        };
        motions.field::<T, I>(parent)
    }
}

/// A body's field, and its motion at unit rate of each coordinate, in its joint's frame.
#[derive(Clone, Copy)]
struct Moving<R, const V: usize> {
    field: AccelerationField<R>,
    by: [Twist<R>; V],
}

struct Columns<'a, R, T, List, E, const N: usize, const B: usize, const Q: usize, const V: usize> {
    call: Call<'a, R, T, E, B, Q, V>,
    state: &'a State<R, Q, V>,
    y: &'a mut [[[R; 10]; N]; V],
    types: PhantomData<List>,
}

impl<
    R: Real,
    T: Compiled,
    List: Bodies<N>,
    E,
    const N: usize,
    const B: usize,
    const Q: usize,
    const V: usize,
> Pass for Columns<'_, R, T, List, E, N, B, Q, V>
where
    E: Effect<R, B, V>,
{
    type Tree = T;
    type Outward = Moving<R, V>;
    type Inward = Nothing;
    const NOTHING: Nothing = Nothing;
    const JOINTS: u64 = joints::<T>(&List::NUMBERS);

    #[cfg_attr(optimised, inline(always))]
    fn enter<const I: usize>(&mut self, parent: &Moving<R, V>) -> Moving<R, V> {
        let field = self.call.regressed_field::<I>(&parent.field, self.state);
        let at = self.call.displacement::<I>();
        let mut body = Moving { field, by: parent.by };
        for_each_joint!(K, {
            if JointPair::<T, I, K>::IS_COORDINATE {
                body.by[K] = Twist::along(CompiledJoint::<T, K>::JOINT, T::LENGTH_INV, Folded::ONE);
            } else if JointPair::<T, K, I>::IS_ANCESTOR {
                body.by[K] = parent.by[K].carried(&at);
            }
        });
        const { ListedBody::<T, List, N, I, 0>::ARE_FEW };
        for_each_joint!(N_TH, {
            if let Some(see) = const {
                only_if(
                    ListedBody::<T, List, N, I, N_TH>::IS_SOME,
                    Self::see::<I, N_TH> as fn(&mut _, &_),
                )
            } {
                see(self.y, &body);
            }
        });
        body
    }

    #[cfg_attr(optimised, inline(always))]
    fn leave<const I: usize>(&mut self, _: &Moving<R, V>, _: Nothing) -> Nothing {
        Nothing
    }
}

impl<R, T, List, E, const N: usize, const B: usize, const Q: usize, const V: usize>
    Columns<'_, R, T, List, E, N, B, Q, V>
where
    R: Real,
    T: Compiled,
    List: Bodies<N>,
{
    /// Writes the columns of the K-th of the bodies of the list that move with joint I.
    #[cfg_attr(optimised, inline(always))]
    fn see<const I: usize, const K: usize>(y: &mut [[[R; 10]; N]; V], body: &Moving<R, V>) {
        let (at, place) = ListedBody::<T, List, N, I, K>::BODY;
        let power = BodyPower::of(&body.field, place, T::LENGTH);
        for_each_joint!(J, {
            if JointPair::<T, I, J>::IS_COORDINATE || JointPair::<T, J, I>::IS_ANCESTOR {
                y[J][*at] = power.per_parameter(&body.by[J]);
            }
        });
    }
}
