//! Forward dynamics of a robot whose links bend: bias, inertia, and elimination of the modes.

use core::borrow::Borrow;
use core::fmt;

use super::crba::modal_inertia;
use super::{FlexibleInertia, JointsAndModes, Modes, crba, rnea};
use crate::effects::{Bias, Effect, all_transmitted};
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::{Configuration, RobotState, State, entry};

/// The inertia of joints and modes is not positive definite, or a result is not finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum FlexibleError {
    /// The joint of this index in q̇ moves no inertia.
    Joint(usize),
    /// The mode of this number moves no inertia, or has no stiffness or too little for its weight.
    Mode(usize),
}

impl fmt::Display for FlexibleError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (what, k) = match self {
            Self::Joint(k) => ("joint", k),
            Self::Mode(k) => ("mode", k),
        };
        write!(out, "{what} {k} moves no inertia or is too soft, or a number is not finite")
    }
}

impl core::error::Error for FlexibleError {}

/// The accelerations of joints and modes, rad/s² or m/s², under these torques of the motors.
///
/// # Cost
/// The cost of [`rnea()`] and [`crba()`], and (V + M)³ / 3 flops.
///
/// # Errors
/// [`FlexibleError`] names a joint or a mode that moves no inertia, or whose acceleration is not
/// finite.
///
/// # Example
/// ```
/// # use dynamics_core::flexible::{Beam, FlexibleLink, Shape};
/// # use dynamics_core::model::{ArmModel, BASE, Body, Joint, Robot};
/// use dynamics_core::effects::{Elasticity, RIGID_BODY};
/// use dynamics_core::flexible::{Modes, forward_dynamics, rnea};
/// use dynamics_core::state::State;
/// # const BEAM: Beam = Beam::new(0.5, 0.8).bending([4.0, 4.0]).tip(0.3, 1e-4);
/// # const LINK: FlexibleLink = match BEAM.link(0, &[Shape::BendZ(1)]) { Ok(link) => link, Err(_) => panic!() };
/// # struct Boom;
/// # impl Robot<1, 1, 1> for Boom {
/// #     const MODEL: ArmModel<f64, 1> = ArmModel::new("boom", [
/// #         Body::new("boom", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(BEAM.mass()).com(BEAM.com()).inertia(BEAM.inertia()),
/// #     ]);
/// # }
/// const MODES: Modes<f64, 1> = Modes::new(&Boom::MODEL, &[LINK]);
/// let scene = (RIGID_BODY, Elasticity);
/// let (mut joint, mut bent) = (State::at([0.3]), State::at([-0.02]));
/// let found = forward_dynamics(&Boom::MODEL, &MODES, &joint, &bent, &[2.0], &scene)?;
/// (joint.qdd, bent.qdd) = (found.joints, found.modes);
/// let tau = rnea(&Boom::MODEL, &MODES, &joint, &bent, &scene);
/// assert!((tau.joints[0] - 2.0).abs() < 1e-12 && tau.modes[0].abs() < 1e-12);
/// # Ok::<(), dynamics_core::flexible::FlexibleError>(())
/// ```
#[cfg_attr(optimised, inline(always))]
pub fn forward_dynamics<
    R: Real,
    D,
    E,
    const B: usize,
    const Q: usize,
    const V: usize,
    const M: usize,
>(
    robot: &D,
    modes: &Modes<R, M>,
    state: impl RobotState<R, Q, V>,
    bent: &State<R, M, M>,
    tau: &[R; V],
    effects: &E,
) -> Result<JointsAndModes<R, V, M>, FlexibleError>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    const { accelerates::<R, E, B, V>() };
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    let bias = rnea(robot, modes, trig.with(state), bent, &Bias(effects));
    let m = crba(robot, modes, trig, &bent.q, effects);
    let tau = all_transmitted(robot, state, effects, tau);
    m.solve(&JointsAndModes {
        joints: core::array::from_fn(|k| entry(&tau, k) - entry(&bias.joints, k)),
        modes: bias.modes.map(|force| -force),
    })
}

pub(super) const fn accelerates<R: Real, E, const B: usize, const V: usize>()
where
    E: Effect<R, B, V>,
{
    assert!(E::ACCELERATIONS, "forward dynamics needs `Inertia` in the scene");
}

/// The accelerations η̈ of the modes along a motion of the joints, m/s² or rad/s².
///
/// The motion of the joints is given by q, q̇, q̈ of the state; η̈ of `bent` is not read. The modes
/// then move as those of links on clamped joints, whatever torques that motion takes.
///
/// # Cost
/// The cost of [`forward_dynamics()`] without the entries of joints and their elimination.
///
/// # Errors
/// [`FlexibleError::Mode`].
///
/// # Example
/// See the example of [`ModalFeedforward`](super::ModalFeedforward).
#[cfg_attr(optimised, inline(always))]
pub fn modal_dynamics<
    R: Real,
    D,
    E,
    const B: usize,
    const Q: usize,
    const V: usize,
    const M: usize,
>(
    robot: &D,
    modes: &Modes<R, M>,
    state: impl RobotState<R, Q, V>,
    bent: &State<R, M, M>,
    effects: &E,
) -> Result<[R; M], FlexibleError>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    let coasting = State { qdd: [R::ZERO; M], ..*bent };
    let force = rnea(robot, modes, trig.with(state), &coasting, effects).modes;
    let m = modal_inertia(robot, modes, trig, &bent.q, effects);
    accelerations(&m, force)
}

/// The accelerations of the modes that need these forces at rest.
#[cfg_attr(optimised, inline(always))]
pub(super) fn accelerations<R: Real, const M: usize>(
    m: &[[R; M]; M],
    force: [R; M],
) -> Result<[R; M], FlexibleError> {
    let factors = Factors::of(m).map_err(FlexibleError::Mode)?;
    let accelerations = factors.solve(force.map(|force| -force));
    finite(&accelerations).map_err(FlexibleError::Mode)?;
    Ok(accelerations)
}

impl<R: Real, const V: usize, const M: usize> FlexibleInertia<R, V, M> {
    /// The accelerations of these forces, by elimination of the modes.
    ///
    /// # Errors
    /// [`FlexibleError`] names the first coordinate whose pivot is not positive.
    #[cfg_attr(optimised, inline(always))]
    pub fn solve(
        &self,
        forces: &JointsAndModes<R, V, M>,
    ) -> Result<JointsAndModes<R, V, M>, FlexibleError> {
        let modes = Factors::of(&self.modes.rows).map_err(FlexibleError::Mode)?;
        let mut joints = self.joints.rows;
        let mut rest = forces.joints;
        let free = modes.solve(forces.modes);
        for (j, row) in joints.iter_mut().enumerate() {
            let column = self.coupling.map(|row| entry(&row, j));
            let along = modes.solve(column);
            for (i, m_ij) in row.iter_mut().enumerate() {
                for (row, &along) in self.coupling.iter().zip(&along) {
                    *m_ij -= entry(row, i) * along;
                }
            }
            if let Some(rest) = rest.get_mut(j) {
                *rest -= dot(&column, &free);
            }
        }
        let joints = Factors::of(&joints).map_err(FlexibleError::Joint)?.solve(rest);
        let modes = modes.solve(core::array::from_fn(|k| {
            let row = self.coupling.get(k).map_or(R::ZERO, |row| dot(row, &joints));
            entry(&forces.modes, k) - row
        }));
        finite(&joints).map_err(FlexibleError::Joint)?;
        finite(&modes).map_err(FlexibleError::Mode)?;
        Ok(JointsAndModes { joints, modes })
    }
}

/// The number of the first value that is not finite is the error.
pub(super) fn finite<R: Real>(values: &[R]) -> Result<(), usize> {
    match values.iter().position(|x| !x.is_finite()) {
        Some(k) => Err(k),
        None => Ok(()),
    }
}

/// L and D⁻¹ of a symmetric matrix L D Lᵀ.
pub(super) struct Factors<R, const N: usize> {
    rows: [[R; N]; N],
    d_inv: [R; N],
}

impl<R: Real, const N: usize> Factors<R, N> {
    /// The number of the first row whose pivot is not positive, beyond what rounding leaves of it,
    /// is the error.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn of(matrix: &[[R; N]; N]) -> Result<Self, usize> {
        let (mut rows, mut d_inv) = (*matrix, [R::ZERO; N]);
        let noise = R::EPSILON * R::from_f64(N as f64);
        for k in 0..N {
            let (above, below) = rows.split_at_mut(k + 1);
            let (Some(row), Some(inv)) = (above.get(k), d_inv.get_mut(k)) else {
                break;
            };
            let (pivot, whole) =
                (entry(row, k), matrix.get(k).map_or(R::ZERO, |row| entry(row, k)));
            // One comparison that a NaN fails too.
            if !((pivot > whole * noise) & pivot.is_finite()) {
                return Err(k);
            }
            *inv = R::ONE / pivot;
            for lower in below {
                let l = entry(lower, k) * *inv;
                for j in k + 1..N {
                    if let Some(x) = lower.get_mut(j) {
                        *x -= l * entry(row, j);
                    }
                }
                if let Some(x) = lower.get_mut(k) {
                    *x = l;
                }
            }
        }
        Ok(Self { rows, d_inv })
    }

    /// L⁻¹ x.
    #[cfg_attr(optimised, inline(always))]
    fn forward(&self, mut x: [R; N]) -> [R; N] {
        for i in 0..N {
            let row = self.rows.get(i).map_or(R::ZERO, |row| dot(row.split_at(i).0, &x));
            if let Some(x) = x.get_mut(i) {
                *x -= row;
            }
        }
        x
    }

    /// D^-½ L⁻¹ x.
    pub(super) fn half_solve(&self, x: [R; N]) -> [R; N] {
        let mut x = self.forward(x);
        for (x, &d_inv) in x.iter_mut().zip(&self.d_inv) {
            *x *= d_inv.sqrt();
        }
        x
    }

    /// The solution of L D Lᵀ x = b.
    pub(super) fn solve(&self, b: [R; N]) -> [R; N] {
        let mut x = self.forward(b);
        for i in (0..N).rev() {
            let mut sum = entry(&x, i) * entry(&self.d_inv, i);
            for (row, &x) in self.rows.iter().zip(&x).skip(i + 1) {
                sum -= entry(row, i) * x;
            }
            if let Some(x) = x.get_mut(i) {
                *x = sum;
            }
        }
        x
    }
}

fn dot<R: Real>(a: &[R], b: &[R]) -> R {
    let products = a.iter().zip(b).map(|(&a, &b)| a * b);
    products.fold(R::ZERO, |sum, product| sum + product)
}
