//! The choice of a form: which code computes inverse dynamics, M and forward dynamics of a robot.
//!
//! The textbook's passes ([`crate::algorithms`]) take every tree and joint; chains have passes of
//! their own ([`chain`]). The choice changes neither signature nor meaning, and a robot that is
//! known to the compiler has one form in the machine code. A model that is read at run time is
//! asked whether it is a chain of revolute joints.

mod chain;

use core::borrow::Borrow;

use crate::algorithms::aba::aba as textbook_aba;
use crate::algorithms::crba::crba as textbook_crba;
use crate::algorithms::rnea::rnea as textbook_rnea;
use crate::algorithms::{MassMatrix, NotPositiveDefinite, Prescribed};
use crate::effects::{Effect, Scene};
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::{Configuration, RobotState, entry};

/// `$chain` if the robot is a chain of revolute joints at run time, where `$views` allows it, or is
/// a chain by its type, where `$chains` says so; else `$tree`. Both see the robot as `$robot`;
/// `$viewed` is whether it is a view.
macro_rules! by_form {
    (
        $robot:ident: $D:ident, $viewed:ident;
        views $views:expr, chains $chains:expr;
        $chain:expr, $tree:expr
    ) => {
        if const { $views && $D::MAY_BE_REVOLUTE }
            && let Some(view) = $robot.as_revolute_chain()
        {
            let ($robot, $viewed) = (&view, true);
            $chain
        } else if const { $chains } {
            let $viewed = false;
            $chain
        } else {
            $tree
        }
    };
}

/// The torque of each motor, τ = ID(q, q̇, q̈), N·m or N, under the effects of the scene.
///
/// A non-finite input gives a non-finite output, which the safety gate of `motion-control` rejects.
///
/// The velocities and accelerations follow from the base to the tips, with a₀ = −g, the forces from
/// the tips to the base:
///
/// ```text
/// v_i = ⁱX_λ(i) v_λ(i) + S_i q̇_i                                   (3)
/// a_i = ⁱX_λ(i) a_λ(i) + S_i q̈_i + S̊_i q̇_i + v_i × S_i q̇_i         (4)
/// f_i = I_i a_i + v_i ×* I_i v_i − fˣ_i + Σ_{λ(j)=i} ʲX_iᵀ f_j     (5), (6), (7)
/// τ_i = S_iᵀ f_i                                                   (8)
/// ```
///
/// The effects of joints (friction, armatures, springs) add their torque to τ_i.
///
/// # Shape
/// V.
///
/// # Cost
/// O(B): 250 flops for each revolute joint, less what no effect needs.
///
/// # Source
/// Featherstone & Orin (2000); Luh, Walker & Paul (1980).
///
/// # Example
/// ```
/// use dynamics_core::{algorithms::rnea, effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// let tau = rnea(&Ur5e::MODEL, &State::at([0.0; 6]), &RIGID_BODY);
/// assert!(tau[1] < -50.0 && tau[0] == 0.0); // the arm stretched out; gravity does not turn its base
/// ```
#[doc(alias = "computed torque")]
#[doc(alias = "inverse dynamics")]
#[doc(alias = "ID")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn rnea<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    effects: &E,
) -> [R; V]
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    const { Scene::<R, E, B, V>::OF_CORE };
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    by_form!(
        robot: D, viewed;
        views E::VELOCITY_PRODUCTS,
        chains E::VELOCITY_PRODUCTS && D::CHAIN && D::KINDS.are_revolute();
        chain::rnea(robot, trig, state, effects, viewed),
        textbook_rnea(robot, trig, state, effects, |_, _| ())
    )
}

/// The joint-space inertia matrix M(q), kg·m² between revolute joints, kg between prismatic ones,
/// kg·m mixed.
///
/// Armatures, rotors and payloads are the effects that are part of M. A non-finite input gives a
/// non-finite output.
///
/// ```text
/// Iᶜ_i = I_i + Σ_{λ(j)=i} ʲX_iᵀ Iᶜ_j ʲX_i      M_ij = M_ji = S_iᵀ ʲX_iᵀ Iᶜ_j S_j
/// ```
///
/// where joint i is joint j or one of its ancestors.
///
/// # Shape
/// V × V, symmetric; an entry between joints of which neither is an ancestor of the other is
/// exactly zero.
///
/// # Cost
/// For B revolute joints some 190 B flops, and 40 for each pair of a joint and its ancestor: B² / 2
/// pairs on a chain.
///
/// # Source
/// Walker & Orin (1982); RBDA (2008), table 6.2.
///
/// # Example
/// ```
/// use dynamics_core::{algorithms::crba, effects::RIGID_BODY, model::Robot, robots::Ur5e};
/// let m = crba(&Ur5e::MODEL, &[0.0, -1.2, 1.5, 0.3, 0.0, 0.0], &RIGID_BODY);
/// assert!(m.get(1, 1) > m.get(5, 5) && m.get(0, 3) == m.get(3, 0));
/// ```
#[doc(alias = "HandC")]
#[doc(alias = "JSIM")]
#[doc(alias = "inertia matrix")]
#[doc(alias = "mass matrix")]
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn crba<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    q: &impl Configuration<R, Q>,
    effects: &E,
) -> MassMatrix<R, V>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    const { Scene::<R, E, B, V>::OF_CORE };
    let trig = q.trig_of(robot);
    let trig = trig.borrow();
    by_form!(
        robot: D, _viewed;
        views true,
        chains D::CHAIN && D::SINGLE;
        chain::crba(robot, trig, effects),
        textbook_crba(robot, trig, effects)
    )
}

/// The acceleration of each joint, q̈ = FD(q, q̇, τ), rad/s² or m/s², under the effects of the
/// scene.
///
/// `state.qdd` is not read.
///
/// Velocities as in [`rnea`](crate::algorithms::rnea()), then the articulated bodies from the tips
/// to the base, then the accelerations from the base, with a₀ = −g, to the tips:
///
/// ```text
/// c_i  = S̊_i q̇_i + v_i × S_i q̇_i
/// Iᴬ_i = I_i + Σ_{λ(j)=i} ʲX_iᵀ Iᵃ_j ʲX_i    pᴬ_i = v_i ×* I_i v_i − fˣ_i + Σ_{λ(j)=i} ʲX_iᵀ pᵃ_j
/// U_i  = Iᴬ_i S_i      D_i = S_iᵀ U_i        u_i  = τ_i − S_iᵀ pᴬ_i
/// Iᵃ_i = Iᴬ_i − U_i D_i⁻¹ U_iᵀ               pᵃ_i = pᴬ_i + Iᵃ_i c_i + U_i D_i⁻¹ u_i
/// a′_i = ⁱX_λ(i) a_λ(i) + c_i
/// q̈_i  = D_i⁻¹ (u_i − U_iᵀ a′_i)             a_i  = a′_i + S_i q̈_i
/// ```
///
/// The effects of joints add their inertia (armatures) to D_i and subtract their torque from u_i.
///
/// # Shape
/// V.
///
/// # Cost
/// O(B): some 590 flops for each revolute joint; of a chain some 530, and 440 if each link is
/// turned from its parent about x and shifted along x and along its own axis, as Denavit &
/// Hartenberg's parameters say.
///
/// # Source
/// Featherstone (1983); RBDA (2008), table 7.1; of these chains McMillan & Orin (1995).
///
/// A scene without `Inertia` does not compile:
///
/// ```compile_fail
/// use dynamics_core::{Core, effects::Gravity, robots::Ur5e, state::State};
/// let _ = Core::<Ur5e>::aba(&State::at([0.0_f32; 6]), &[0.0; 6], &Gravity::EARTH);
/// ```
///
/// # Errors
/// [`NotPositiveDefinite`] names the outermost coordinate that moves no inertia when its
/// descendants are free (a massless last link without rotor inertia, a joint on the axis of another
/// with no inertia between them, a massless wrist in gimbal lock), or whose inertia is NaN: its
/// pivot does not exceed eight roundings of the largest inertia that its descendants, stretched
/// out, could have about it. For four or more joints without inertia whose axes meet in one point,
/// the rounding error may be larger.
#[doc(alias = "articulated-body inertia")]
#[doc(alias = "ABI")]
#[doc(alias = "forward dynamics")]
#[doc(alias = "FDab")]
#[doc(alias = "FD")]
#[cfg_attr(optimised, inline(always))]
pub fn aba<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    tau: &[R; V],
    effects: &E,
) -> Result<[R; V], NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    const { Scene::<R, E, B, V>::OF_CORE };
    const { assert!(E::ACCELERATIONS, "forward dynamics needs `Inertia` in the scene") };
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    let given = |joint| Prescribed::Torque(entry(tau, joint));
    by_form!(
        robot: D, _viewed;
        views true,
        chains D::CHAIN && D::SINGLE;
        chain::aba(robot, trig, state, effects, tau),
        Ok(textbook_aba(robot, trig, state, effects, given)?.qdd)
    )
}
