//! Inverse dynamics of a chain of revolute joints by the accelerations of points.
//!
//! [`rnea`](crate::algorithms::rnea()) with (4) and (5) of Balafoutis, Patel & Misra (1988): a is
//! the acceleration of a body's origin as a point of the body, ȧ + ω × v, so that v does not occur;
//! see [`AccelerationField`].

use heapless::Vec;

use crate::algorithms::rnea::external_force;
use crate::algorithms::rotors::rotor;
use crate::algorithms::tree_pass::{inward, per_body};
use crate::effects::{Declared, Effect, base_motion, body_inertia, joint_torques, load_frictions};
use crate::model::RobotModel;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::{AccelerationField, Force, Motion, Xform};
use crate::state::{JointTrig, State, entry};

/// The results of the outward pass for the inward one.
struct Body<R: Real> {
    rot: R::Mat3,
    f: Force<R>,
}

/// τ of a chain of revolute joints under velocity products: `D::CHAIN`, and `D::KINDS` are
/// revolute.
///
/// `first_apart`: the first link has code of its own, with the same numbers; it takes fewer cycles,
/// and more code.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn rnea<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    trig: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
    first_apart: bool,
) -> [R; V]
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let turns = &trig.coordinates;
    let (mut v, mut a) = base_motion(effects);
    if E::BASE_MOTION {
        a.lin += v.ang.cross(v.lin);
    }
    let mut poses = per_body(robot, Xform::IDENTITY);
    let mut bodies: Vec<Body<R>, B> = Vec::new();
    let mut rotor_tau = [R::ZERO; V];
    let mut links = robot.links().enumerate();
    if first_apart
        && const { !E::BASE_MOTION && V > 1 }
        && let Some((i, link)) = links.next()
    {
        // Its axis stands still, and of the force on it only the couple about z is asked for. The
        // rate of a single link would not be read at all, so that a NaN of it were lost.
        let x = link.xform(turns);
        v = link.plus_motion(Motion::ZERO, turns, &state.qd); // (3)
        a = Motion::new(R::Vec3::ZERO, x.rot * a.lin); // (4)
        if E::ACCELERATIONS {
            a = link.plus_motion(a, turns, &state.qdd);
        }
        let mut f = body_inertia(effects, i, &link).couple_about_z(a); // (5)
        f -= external_force(effects, i, &link, &x, &mut poses, v); // (6)
        let rot = R::Mat3::IDENTITY; // not read
        let _ = bodies.push(Body { rot, f });
    }
    for (i, link) in links {
        let x = link.xform(turns);
        let parent = AccelerationField::new(v.ang, a);
        let v_parent =
            if E::BODY_VELOCITY { x * v } else { Motion::new(x.rot * v.ang, R::Vec3::ZERO) };
        v = link.plus_motion(v_parent, turns, &state.qd); // (3)
        let a_parent = parent.moved(&x);
        a = a_parent; // (4)
        if E::ACCELERATIONS {
            a = link.plus_motion(a, turns, &state.qdd);
        }
        a = link.plus_turning_product(a, &state.qd, v.ang);
        let field = AccelerationField::new(v.ang, a);
        let mut f = body_inertia(effects, i, &link).force_in(&field, v.ang); // (5)
        f -= external_force(effects, i, &link, &x, &mut poses, v); // (6)
        if E::GYROSCOPIC_ROTORS {
            let (couple, tau) = rotor(effects, &link, a_parent, v, state);
            if let Some(parent) = bodies.last_mut() {
                parent.f.ang += x.rot.transpose_mul(couple);
            }
            if let Some(rotor_tau) = rotor_tau.get_mut(i) {
                *rotor_tau = tau;
            }
        }
        // There is always a place; a branch that ends the loop does not join it again.
        if bodies.push(Body { rot: x.rot, f }).is_err() {
            break;
        }
    }

    let mut tau = [R::ZERO; V];
    let mut f_child = Force::ZERO;
    let mut bodies = inward(&mut bodies);
    while let Some((body, inner)) = bodies.next() {
        let i = inner.len();
        let Some(link) = robot.link(i) else {
            break;
        };
        let f = body.f + f_child;
        link.project(turns, f, &mut tau); // (8)
        joint_torques(effects, &link, state, &mut tau);
        if E::GYROSCOPIC_ROTORS
            && let Some(tau) = tau.get_mut(i)
        {
            *tau += entry(&rotor_tau, i);
        }
        load_frictions(effects, &link, state, &mut tau);
        if inner.is_empty() {
            break; // the first body stands on the base
        }
        let (rot, pos) = (body.rot, link.origin(turns));
        f_child = Xform { rot, pos }.transpose_mul(f); // (7)
    }
    tau
}
