//! A robot whose negligible base parameters are dropped.

use core::marker::PhantomData;

use super::{Model, Robot};

/// The robot T, of which [`crate::Engine`] omits the base parameters that contribute less than
/// `PPM` millionths of its torque ([`Robot::NEGLIGIBLE`]), while [`crate::Core`] computes all of
/// it.
///
/// The torque error grows with the joints' accelerations and the square of their speeds; the error
/// along a robot's trajectory and the cycles saved are in `docs/accuracy.md` in the repository.
/// Pruning is most effective for arms with a light wrist.
///
/// ```
/// use dynamics_core::{Core, Engine, effects::RIGID_BODY, model::Pruned, robots::Ur5e, state::State};
/// type Light = Pruned<Ur5e, 1000>;
/// let state = State { q: [0.1_f32; 6], qd: [0.5; 6], qdd: [1.0; 6] };
/// let (all, most) = (Core::<Light>::rnea(&state, &RIGID_BODY), Engine::<Light>::rnea(&state, &RIGID_BODY));
/// assert!(all.iter().zip(most).all(|(a, b)| (a - b).abs() < 0.005)); // N·m, of 60
/// ```
///
/// Meant for inverse dynamics. The joint of a light last link may lose all of its inertia; M is
/// then singular, and forward dynamics returns an error that names the joint, unless an effect (a
/// rotor's inertia) adds inertia to it:
///
/// ```
/// use dynamics_core::{Engine, effects::RIGID_BODY, model::Pruned, robots::Ur5e, state::State};
/// let refused = Engine::<Pruned<Ur5e, 1000>>::forward_dynamics(&State::at([0.1_f32; 6]), &[0.0; 6], &RIGID_BODY);
/// assert_eq!(refused.unwrap_err().joint, 5);
/// ```
///
/// A share of 100 % does not compile:
///
/// ```compile_fail,E0080
/// use dynamics_core::{Engine, effects::RIGID_BODY, model::Pruned, robots::Ur5e, state::State};
/// let _ = Engine::<Pruned<Ur5e, 1_000_000>>::rnea(&State::at([0.1_f32; 6]), &RIGID_BODY);
/// // error: what is negligible is a share of the whole: not negative, and less than 1
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Pruned<T, const PPM: u32>(PhantomData<T>);

impl<T, const PPM: u32, const B: usize, const Q: usize, const V: usize> Robot<B, Q, V>
    for Pruned<T, PPM>
where
    T: Robot<B, Q, V>,
{
    const MODEL: Model<f64, B, Q, V> = T::MODEL;
    const MODEL_F32: Model<f32, B, Q, V> = T::MODEL_F32;
    const NEGLIGIBLE: f64 = PPM as f64 * 1e-6;
}
