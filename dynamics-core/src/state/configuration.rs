//! The configurations and states that the algorithms accept: plain numbers, or with precomputed
//! sines and cosines.

use core::borrow::Borrow;

use super::{JointTrig, State};
use crate::model::RobotModel;
use crate::scalar::Real;

mod sealed {
    /// Restricts the two traits to the types of this module: the engine relies on their behaviour.
    pub trait Sealed {}
    impl<R, const Q: usize> Sealed for [R; Q] {}
    impl<R, const Q: usize> Sealed for super::JointTrig<R, Q> {}
    impl<R, const Q: usize, const V: usize> Sealed for &super::State<R, Q, V> {}
    impl<R, const Q: usize, const V: usize> Sealed for super::StateWithTrig<'_, R, Q, V> {}
}

/// A configuration q: an array `[R; Q]`, whose sines and cosines are computed by the callee, or a
/// [`JointTrig`], which contains them.
///
/// Several algorithms at one configuration share a [`JointTrig`]:
///
/// ```
/// use dynamics_core::{Engine, effects::RIGID_BODY, robots::Ur5e};
/// let q = [0.0_f32, -1.2, 1.5, 0.3, 0.0, 0.0];
/// let trig = Engine::<Ur5e>::joint_trig(&q); // once a tick
/// assert_eq!(Engine::<Ur5e>::crba(&trig, &RIGID_BODY), Engine::<Ur5e>::crba(&q, &RIGID_BODY));
/// ```
pub trait Configuration<R, const Q: usize>: sealed::Sealed {
    /// Whether the sines and cosines are computed already.
    const PRECOMPUTED: bool;

    /// The sines and cosines: its own, or those that `source` computes.
    fn trig_or(&self, source: impl TrigSource<R, Q>) -> impl Borrow<JointTrig<R, Q>>;

    /// The sines and cosines: its own, or those of [`JointTrig::new`] for `robot`.
    #[cfg_attr(optimised, inline(always))]
    fn trig_of<D, const B: usize, const V: usize>(&self, robot: &D) -> impl Borrow<JointTrig<R, Q>>
    where
        R: Real,
        D: RobotModel<R, B, Q, V>,
    {
        self.trig_or(Textbook::<D, B, V>(robot))
    }
}

impl<R, const Q: usize> Configuration<R, Q> for [R; Q] {
    const PRECOMPUTED: bool = false;

    #[cfg_attr(optimised, inline(always))]
    fn trig_or(&self, source: impl TrigSource<R, Q>) -> impl Borrow<JointTrig<R, Q>> {
        source.compute(self)
    }
}

impl<R, const Q: usize> Configuration<R, Q> for JointTrig<R, Q> {
    const PRECOMPUTED: bool = true;

    #[cfg_attr(optimised, inline(always))]
    fn trig_or(&self, _: impl TrigSource<R, Q>) -> impl Borrow<JointTrig<R, Q>> {
        self
    }
}

/// A source of the sines and cosines of a configuration. It is a trait, since a closure would not
/// be inlined everywhere.
#[doc(hidden)]
pub trait TrigSource<R, const Q: usize> {
    /// The sines and cosines at q.
    fn compute(&self, q: &[R; Q]) -> JointTrig<R, Q>;
}

/// [`JointTrig::new`] of a robot.
struct Textbook<'a, D, const B: usize, const V: usize>(&'a D);

impl<R: Real, D, const B: usize, const Q: usize, const V: usize> TrigSource<R, Q>
    for Textbook<'_, D, B, V>
where
    D: RobotModel<R, B, Q, V>,
{
    #[cfg_attr(optimised, inline(always))]
    fn compute(&self, q: &[R; Q]) -> JointTrig<R, Q> {
        JointTrig::new(self.0, q)
    }
}

/// A state q, q̇, q̈: a reference to a [`State`], whose sines and cosines are computed by the
/// callee, or [`JointTrig::with`], which contains them.
///
/// ```
/// use dynamics_core::{Engine, effects::{Coriolis, Gravity}, robots::Ur5e, state::State};
/// let state = State { q: [0.1_f32; 6], qd: [0.5; 6], qdd: [1.0; 6] };
/// let bias = (Gravity::EARTH, Coriolis);
/// let trig = Engine::<Ur5e>::joint_trig(&state.q);
/// assert_eq!(Engine::<Ur5e>::rnea(trig.with(&state), &bias), Engine::<Ur5e>::rnea(&state, &bias));
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a state of {Q} positions and {V} velocities in `{R}`",
    label = "not a state of this size and scalar",
    note = "a state is `&State<R, Q, V>`, or `trig.with(&state)` with its sines and cosines",
    note = "a robot that is known at run time only is the first argument of a function of \
            `algorithms`, such as `algorithms::rnea(&model, &state, &effects)`; `Engine` and \
            `Core` take a type, `Engine::<Ur5e>::rnea(&state, &effects)`"
)]
pub trait RobotState<R, const Q: usize, const V: usize>: Copy + sealed::Sealed {
    /// The type of its configuration.
    type Configuration: Configuration<R, Q>;

    /// The configuration.
    fn configuration(&self) -> &Self::Configuration;

    /// q, q̇ and q̈.
    fn state(&self) -> &State<R, Q, V>;
}

impl<R, const Q: usize, const V: usize> RobotState<R, Q, V> for &State<R, Q, V> {
    type Configuration = [R; Q];

    #[cfg_attr(optimised, inline(always))]
    fn configuration(&self) -> &[R; Q] {
        &self.q
    }

    #[cfg_attr(optimised, inline(always))]
    fn state(&self) -> &State<R, Q, V> {
        self
    }
}

/// A state with the sines and cosines of its configuration, by reference: [`JointTrig::with`].
#[derive(Debug)]
#[doc(hidden)]
pub struct StateWithTrig<'a, R, const Q: usize, const V: usize> {
    trig: &'a JointTrig<R, Q>,
    state: &'a State<R, Q, V>,
}

impl<R, const Q: usize, const V: usize> Clone for StateWithTrig<'_, R, Q, V> {
    #[cfg_attr(optimised, inline(always))]
    fn clone(&self) -> Self {
        *self
    }
}

impl<R, const Q: usize, const V: usize> Copy for StateWithTrig<'_, R, Q, V> {}

impl<R, const Q: usize, const V: usize> RobotState<R, Q, V> for StateWithTrig<'_, R, Q, V> {
    type Configuration = JointTrig<R, Q>;

    #[cfg_attr(optimised, inline(always))]
    fn configuration(&self) -> &JointTrig<R, Q> {
        self.trig
    }

    #[cfg_attr(optimised, inline(always))]
    fn state(&self) -> &State<R, Q, V> {
        self.state
    }
}

impl<R, const Q: usize> JointTrig<R, Q> {
    /// The state with these sines and cosines as its configuration's. `state.q` is used by the
    /// effects of joints only.
    #[cfg_attr(optimised, inline(always))]
    #[must_use]
    pub fn with<'a, const V: usize>(
        &'a self,
        state: &'a State<R, Q, V>,
    ) -> StateWithTrig<'a, R, Q, V> {
        StateWithTrig { trig: self, state }
    }
}
