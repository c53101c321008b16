//! Robots that are known at compile time.

use super::Model;
use crate::scalar::Real;

/// A robot known at compile time.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a robot of these sizes",
    label = "not a robot",
    note = "describe it by `impl Robot<B, Q, V> for {Self}` with `const MODEL: Model<f64, B, Q, V> \
        = Model::new(..)`",
    note = "or write that from a URDF or MJCF: `cargo xtask import robot.urdf --out robot.rs`"
)]
pub trait Robot<const B: usize, const Q: usize, const V: usize> {
    /// The robot's description, in f64.
    const MODEL: Model<f64, B, Q, V>;
    /// The same, rounded to f32.
    const MODEL_F32: Model<f32, B, Q, V> = Self::MODEL.to_f32();
    /// The share of the robot's torque below which [`crate::Engine`] omits a base parameter, from
    /// 0, which omits none, to below 1; [`super::Pruned`] sets it.
    ///
    /// Torques are compared at 1 g and at the angular acceleration at which the largest second
    /// moment needs as much torque as the largest first moment weighs.
    const NEGLIGIBLE: f64 = 0.0;
}

/// A [`Robot`] of N joints of one degree of freedom, one body each: the bound of a function for
/// ordinary arms.
///
/// ```
/// use dynamics_core::{Engine, effects::RIGID_BODY, model::Arm, robots::Ur5e, state::ArmState};
/// fn torque<T: Arm<N>, const N: usize>(state: &ArmState<f32, N>) -> [f32; N] {
///     Engine::<T>::rnea(state, &RIGID_BODY)
/// }
/// assert!(torque::<Ur5e, 6>(&ArmState::at([0.0; 6]))[1] < -50.0); // N·m
/// ```
pub trait Arm<const N: usize>: Robot<N, N, N> {}

impl<T: Robot<N, N, N>, const N: usize> Arm<N> for T {}

/// The model of a robot known at compile time, in the scalar R.
///
/// ```
/// use dynamics_core::{model::model, robots::Ur5e};
/// assert_eq!(model::<f32, Ur5e, 6, 6, 6>().links[1].name, "upper_arm");
/// ```
#[cfg_attr(optimised, inline(always))]
pub fn model<R: Real, T, const B: usize, const Q: usize, const V: usize>()
-> &'static Model<R, B, Q, V>
where
    T: Robot<B, Q, V>,
{
    R::model::<T, B, Q, V>()
}
