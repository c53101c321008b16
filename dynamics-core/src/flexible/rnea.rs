//! Inverse dynamics of a robot whose links bend: the recursive Newton-Euler algorithm with modes.
//!
//! Book (1984); De Luca & Siciliano (1991); Shabana, *Dynamics of Multibody Systems* (2005),
//! chapter 5. A link's modes are between its body and its end, on which its children stand: outward
//! the velocity and the acceleration of the end are those of the body and of the modes' rates;
//! inward the force on the end acts on the modes and on the body.

use core::borrow::Borrow;

use heapless::Vec;

use super::deformation::End;
use super::modal_forces::{Outer, net_force};
use super::{JointsAndModes, Modes};
use crate::algorithms::{inward, per_body};
use crate::effects::{
    Declared, Effect, body_inertia, body_wrench, joint_torques, load_frictions,
    no_gyroscopic_rotors,
};
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::spatial::{Force, Xform};
use crate::state::{Configuration, RobotState, State};

/// The torque of each motor, N·m or N, and the force on each mode at a state of joints and modes.
///
/// With [`Elasticity`](crate::effects::Elasticity) among the effects, the forces on the modes are
/// zero where they move freely: nothing but the links' own stiffness and damping acts on them.
/// Without it they are the forces that stiffness and damping have to exert.
///
/// ```text
/// f_i = I_i(η) a_i + v_i ×* I_i(η) v_i + ∫ (φ η̈ + 2 ω × φ η̇) dm − fˣ_i + X_eᵀ f_e
/// Q_k = ∫ φ_k·a(r) dm + J_kᵀ f_e + K η + D η̇
/// ```
///
/// where f_e is the force of the bodies on the end, and J_k the end's motion per rate of mode k.
/// Terms of any order of η that a displacement linear in η has are included; a beam's shortening
/// when it bends is not.
///
/// # Frames
/// A wrench of the effects acts on the link where its joint is, and a payload is fixed there. One
/// at the end belongs to a body on the end, by a fixed joint if need be. Scenes with gyroscopic
/// rotors do not compile.
///
/// # Cost
/// The cost of [`rnea`](crate::algorithms::rnea()), and some 150 + 130 N + 40 N² flops for each
/// link with N modes.
///
/// # Source
/// Book, "Recursive Lagrangian dynamics of flexible manipulator arms" (1984).
///
/// # Example
/// ```
/// # use dynamics_core::flexible::{Beam, FlexibleLink, Shape};
/// # use dynamics_core::model::{ArmModel, BASE, Body, Joint, Robot};
/// use dynamics_core::effects::{Elasticity, RIGID_BODY};
/// use dynamics_core::flexible::{Modes, rnea};
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
/// let level = State::at([0.0]);
/// let sagging = rnea(&Boom::MODEL, &MODES, &level, &State::at([-0.1]), &scene);
/// let straight = rnea(&Boom::MODEL, &MODES, &level, &State::at([0.0]), &scene);
/// // Bent by 0.1 m, its weight acts closer to the joint to the second order only, and its stiffness on the mode.
/// assert!((sagging.joints[0] - straight.joints[0]).abs() < 1e-12);
/// assert!(sagging.modes[0] < straight.modes[0]);
/// ```
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn rnea<R: Real, D, E, const B: usize, const Q: usize, const V: usize, const M: usize>(
    robot: &D,
    modes: &Modes<R, M>,
    state: impl RobotState<R, Q, V>,
    bent: &State<R, M, M>,
    effects: &E,
) -> JointsAndModes<R, V, M>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    no_gyroscopic_rotors::<R, E, B, V>();
    let trig = state.configuration().trig_of(robot);
    let (turns, state) = (&trig.borrow().coordinates, state.state());
    let mut out = JointsAndModes::ZERO;
    let mut outer = per_body(robot, Outer::base(effects));
    let mut bodies: Vec<Body<R>, B> = Vec::new();
    for i in 0..B {
        let Some(link) = robot.link(i) else {
            break;
        };
        let (mut at, mut x) = (outer.parent(&link), link.xform(turns));
        let on = modes.of_body(link.parent);
        let mut end = None;
        if !on.is_empty() {
            let [bend, rates, accelerations] = modes.at_end(&on, [&bent.q, &bent.qd, &bent.qdd]);
            let of_parent = End::of(bend, modes.rest(&on));
            x = of_parent.xform(&x, modes.rest(&on));
            of_parent.add(effects, &mut at.v, &mut at.a, [rates, accelerations]);
            end = Some(of_parent);
        }
        at = at.moved(effects, &x);
        if const { E::VELOCITY_PRODUCTS | E::BODY_VELOCITY } {
            at.v = link.plus_motion(at.v, turns, &state.qd);
        }
        if E::ACCELERATIONS {
            at.a = link.plus_motion(at.a, turns, &state.qdd);
        }
        if E::VELOCITY_PRODUCTS {
            at.a = link.plus_velocity_product(at.a, turns, &state.qd, at.v);
        }
        let (rigid, own) = (body_inertia(effects, i, &link), modes.of_body(i));
        let mut f = if own.is_empty() {
            at.net_force(effects, &rigid)
        } else {
            net_force(effects, (modes, &own), rigid, &at, bent, &mut out.modes)
        };
        if E::WRENCH {
            f -= body_wrench(effects, i, &link, &at.pose, at.v);
        }
        outer.push(at);
        let _ = bodies.push(Body { x, f, end });
    }
    let mut bodies = inward(&mut bodies);
    while let Some((body, inner)) = bodies.next() {
        let Some(link) = robot.link(inner.len()) else {
            break;
        };
        link.project(turns, body.f, &mut out.joints);
        joint_torques(effects, &link, state, &mut out.joints);
        load_frictions(effects, &link, state, &mut out.joints);
        let Some(parent) = inner.get_mut(link.parent) else {
            continue;
        };
        let f = body.x.transpose_mul(body.f);
        parent.f += f;
        if let Some(end) = &body.end {
            let load = end.load(f);
            for k in modes.of_body(link.parent) {
                if let Some(of_mode) = out.modes.get_mut(k) {
                    *of_mode += modes.work(k, load);
                }
            }
        }
    }
    out
}

/// The results of the outward pass for the inward one.
struct Body<R: Real> {
    x: Xform<R>,
    f: Force<R>,
    /// The parent's end, if it has modes.
    end: Option<End<R>>,
}
