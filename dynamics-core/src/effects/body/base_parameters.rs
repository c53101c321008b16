//! Base parameters of a robot's bodies, loaded at run time.

use core::marker::PhantomData;

use crate::effects::delegate::delegate_effect;
use crate::effects::{Effect, RegroupedInertia, hook};
use crate::model::Robot;
use crate::scalar::Real;

/// The base parameters of the robot `T`, which the engine then reads instead of the constants of
/// its description.
///
/// [`Engine::base_parameters`](crate::Engine::base_parameters) computes them from calibrated
/// inertias, outside the tick. The geometry stays constant: the engine's algorithms take up to 1.3
/// times as long as without them (rows `loaded` of `docs/costs.md` in the repository). A set is a
/// plain value: between two ticks the scene receives another one as a whole, by value or by
/// reference.
///
/// ```
/// use dynamics_core::effects::RIGID_BODY;
/// use dynamics_core::model::{BodyInertia, Calibrated, Robot};
/// use dynamics_core::{Engine, algorithms::rnea, robots::Ur5e, state::State};
/// const UPPER_ARM: usize = Ur5e::MODEL.body("upper_arm");
/// let mut arm = Calibrated::<Ur5e, f64, 6, 6, 6>::nominal();
/// let described = arm.inertia(UPPER_ARM).expect("the robot has this body");
/// arm.set_inertia(UPPER_ARM, BodyInertia { mass: described.mass + 0.4, ..described }, 1e-6)?;
/// let learned = Engine::<Ur5e>::base_parameters(&arm, &())?;
///
/// let state = State { q: [0.3; 6], qd: [0.5; 6], qdd: [1.0; 6] };
/// let tau = Engine::<Ur5e>::rnea(&state, &(RIGID_BODY, &learned));
/// let textbook = rnea(&arm, &state, &RIGID_BODY);
/// assert!(tau.iter().zip(textbook).all(|(a, b)| (a - b).abs() < 1e-12));
/// # Ok::<(), dynamics_core::model::ModelError>(())
/// ```
///
/// The textbook algorithms have no base parameters; they accept the calibrated robot itself:
///
/// ```compile_fail,E0080
/// use dynamics_core::{Core, Engine, effects::RIGID_BODY, model::Calibrated, robots::Ur5e, state::State};
/// let learned = Engine::<Ur5e>::base_parameters(&Calibrated::<Ur5e, f64, 6, 6, 6>::nominal(), &()).unwrap();
/// let _ = Core::<Ur5e>::rnea(&State::at([0.3; 6]), &(RIGID_BODY, learned));
/// // error: base parameters are the engine's: give the textbook algorithms the `Calibrated` robot
/// ```
///
/// The base parameters of one robot are none of another:
///
/// ```compile_fail,E0080
/// use dynamics_core::{Engine, effects::RIGID_BODY, model::Calibrated, robots::{Iiwa14, Panda}, state::State};
/// let other = Engine::<Iiwa14>::base_parameters(&Calibrated::<Iiwa14, f64, 7, 7, 7>::nominal(), &()).unwrap();
/// let _ = Engine::<Panda>::rnea(&State::at([0.3; 7]), &(RIGID_BODY, other));
/// // error: the base parameters are those of another robot
/// ```
///
/// # Source
/// Khalil & Dombre, *Modeling, Identification and Control of Robots* (2002), chapter 9.
#[doc(alias = "calibrated")]
#[doc(alias = "identified")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BaseParameters<T, R, const B: usize, const Q: usize, const V: usize> {
    pub(crate) joints: [RegroupedInertia<R>; V],
    // A function, so that the type contains no T.
    pub(crate) robot: PhantomData<fn() -> T>,
}

impl<T, R: Real, const B: usize, const Q: usize, const V: usize> Effect<R, B, V>
    for BaseParameters<T, R, B, Q, V>
where
    T: Robot<B, Q, V>,
{
    const DIFFERENTIABLE: bool = true;
    const REGROUPED: hook::Regrouped<Self, R> = hook::Regrouped::loaded(T::MODEL.name, Self::load);
}

delegate_effect! {
    impl[T: Robot<B, Q, V>, R: Real, const B: usize, const Q: usize, const V: usize]
    Effect<R, B, V> for &BaseParameters<T, R, B, Q, V>,
    |this| { BaseParameters<T, R, B, Q, V> => **this }
}

impl<T, R: Real, const B: usize, const Q: usize, const V: usize> BaseParameters<T, R, B, Q, V> {
    /// The parameters that are left to the body behind `joint`.
    #[cfg_attr(optimised, inline(always))]
    fn load(&self, joint: usize, body: &mut RegroupedInertia<R>) {
        if let Some(loaded) = self.joints.get(joint) {
            *body = *loaded;
        }
    }
}
