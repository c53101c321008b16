//! Forward dynamics of a chain of joints with one coordinate each: the articulated-body algorithm
//! where nothing branches.
//!
//! The passes of [`aba`](crate::algorithms::aba()), Featherstone, RBDA (2008), table 7.1. One
//! articulated inertia runs from the tip to the base, of which the row that a free turn about z
//! cannot feel is left out; of the first body only its pivot is computed. A link that is placed by
//! Denavit & Hartenberg's parameters is crossed by two screws: McMillan & Orin (1995).

use heapless::Vec;

use super::across::{Across, AcrossZ};
use crate::algorithms::NotPositiveDefinite;
use crate::algorithms::aba::JointFactor;
use crate::algorithms::pivot_check::{Magnitude, PivotCheck};
use crate::algorithms::rnea::external_force;
use crate::algorithms::rotors::with_rotor;
use crate::algorithms::tree_pass::per_body;
use crate::effects::{
    Declared, Effect, add_inertia, base_motion, body_inertia, gyroscopic, joint_state,
    joint_torque, transmitted,
};
use crate::model::RobotModel;
use crate::scalar::{Matrix, Real};
use crate::spatial::inertia::ArticulatedInertia;
use crate::spatial::{AxialScrews, Force, Motion, MotionSubspace, SpatialInertia, Xform};
use crate::state::{JointTrig, State, entry};

/// The result of the first pass for a body: its part of X, c, and pᴬ of the body alone.
struct Body<R: Real, X: Across<R>> {
    x: X::Memo,
    c: AcrossZ<R>,
    pa: Force<R>,
}

/// Iᵃ, pᵃ and the sizes of the bodies beyond a joint, at the parent's frame; beyond the last one
/// all are zero.
struct Beyond<R: Real> {
    ia: ArticulatedInertia<R>,
    pa: Force<R>,
    magnitude: Magnitude<R>,
}

/// q̈ of a chain: `D::CHAIN` and `D::SINGLE` hold.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn aba<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    trig: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
    tau: &[R; V],
) -> Result<[R; V], NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    if const { D::KINDS.are_revolute() && !matches!(D::SCREWS, Some(false)) } && robot.has_screws()
    {
        sweep::<AxialScrews<R>, _, _, _, B, Q, V>(robot, trig, state, effects, tau)
    } else {
        sweep::<Xform<R>, _, _, _, B, Q, V>(robot, trig, state, effects, tau)
    }
}

/// The three passes, with the transforms across links in the form X.
#[cfg_attr(optimised, inline(always))]
fn sweep<X, R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    trig: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
    tau: &[R; V],
) -> Result<[R; V], NotPositiveDefinite>
where
    X: Across<R>,
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let turns = &trig.coordinates;
    let (v_0, a_0) = base_motion(effects);
    let mut bodies: Vec<Body<R, X>, V> = Vec::new();
    outward_velocities(robot, trig, state, effects, v_0, &mut bodies);

    let mut factors: Vec<JointFactor<R>, V> = Vec::new();
    let mut beyond = Beyond {
        ia: ArticulatedInertia::from(SpatialInertia::ZERO),
        pa: Force::ZERO,
        magnitude: Magnitude::from(&SpatialInertia::ZERO),
    };
    for i in (0..V).rev() {
        let (Some(link), Some(body)) = (robot.link(i), bodies.get(i)) else {
            continue;
        };
        let inertia = body_inertia(effects, i, &link);
        let Beyond { mut ia, mut pa, mut magnitude } = beyond;
        ia += inertia;
        pa += body.pa;
        magnitude += Magnitude::from(&inertia);
        let s = link.subspace(turns, 0);
        let u_a = ia.along(&s);
        let mut d = s.dot(u_a);
        add_inertia(effects, i, &mut d);
        PivotCheck::of(magnitude).check(&link, 0, turns, u_a, d)?;
        let d_inv = R::ONE / d;
        let tau = transmitted(effects, i, joint_state(&link, state, i), entry(tau, i));
        let u = tau - joint_torque(effects, &link, state, i) - s.dot(pa);
        let u_a = with_rotor(effects, &link, u_a);
        let _ = factors.push(JointFactor { u_a, d_inv, u });
        if i == 0 {
            break;
        }
        pa += u_a * (u * d_inv);
        let x = X::again(body.x, &link, turns);
        // Iᵃ c after the update of Iᴬ: pᵃ = pᴬ + Iᵃ c + U D⁻¹ u.
        let (ia_c, ia) = if matches!(s, MotionSubspace::RevoluteZ) && effects.inertia(i).is_none() {
            let free = ia.free_about_z(u_a, d_inv);
            (free.times_across(body.c.motion()), x.free_back(&free))
        } else {
            let rest = ia.minus_outer(u_a, d_inv);
            (rest.times(body.c.motion()), x.inertia_back(&rest))
        };
        beyond = Beyond {
            ia,
            pa: x.force_back(pa + ia_c),
            magnitude: magnitude.at_distance(x.distance()),
        };
    }
    Ok(outward_accelerations(robot, &bodies, trig, a_0, &factors))
}

/// vᵢ, cᵢ = v × S q̇, and pᴬ = v ×* I v − fˣ of each body alone.
#[cfg_attr(optimised, inline(always))]
fn outward_velocities<X: Across<R>, R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    trig: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
    v_0: Motion<R>,
    bodies: &mut Vec<Body<R, X>, V>,
) where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let turns = &trig.coordinates;
    let (mut v, mut poses) = (v_0, per_body(robot, Xform::IDENTITY));
    for (i, link) in robot.links().enumerate() {
        let x = X::of(&link, turns);
        v = link.plus_motion(x * v, turns, &state.qd);
        let (mut c, mut pa) = (Motion::ZERO, Force::ZERO);
        if E::VELOCITY_PRODUCTS {
            c = link.column_rate(turns, &state.qd, v, 0) * entry(&state.qd, i);
            pa = body_inertia(effects, i, &link).bias_force(v);
        }
        if E::WRENCH {
            pa -= external_force(effects, i, &link, &link.xform(turns), &mut poses, v);
        }
        if E::GYROSCOPIC_ROTORS
            && E::VELOCITY_PRODUCTS
            && let Some(parent) = bodies.last_mut()
        {
            let rate = entry(&state.qd, i);
            let couple = gyroscopic(effects, &link, v.ang, rate, R::ZERO);
            parent.pa.ang += link.xform(turns).rot.transpose_mul(couple);
        }
        let (x, c) = (x.memo(), AcrossZ::of(c));
        if bodies.push(Body { x, c, pa }).is_err() {
            break;
        }
    }
}

/// q̈ᵢ = D⁻¹ (u − Uᵀ a′) with a′ = X a + c, and aᵢ = a′ + S q̈.
#[cfg_attr(optimised, inline(always))]
fn outward_accelerations<X: Across<R>, R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    bodies: &[Body<R, X>],
    trig: &JointTrig<R, Q>,
    a_0: Motion<R>,
    factors: &[JointFactor<R>],
) -> [R; V]
where
    D: RobotModel<R, B, Q, V>,
{
    let turns = &trig.coordinates;
    let (mut qdd, mut a) = ([R::ZERO; V], a_0);
    let bodies = robot.links().zip(bodies).zip(factors.iter().rev());
    for (((link, body), factor), qdd) in bodies.zip(&mut qdd) {
        let a_parent = X::again(body.x, &link, turns) * a + body.c.motion();
        *qdd = (factor.u - a_parent.dot(factor.u_a)) * factor.d_inv;
        a = link.subspace(turns, 0).add_scaled_to(a_parent, *qdd);
    }
    qdd
}
