//! The velocity of a free base from the momentum of all bodies.
//!
//! Umetani & Yoshida, "Resolved motion rate control of space manipulators with generalized Jacobian
//! matrix" (1989). The momentum h of a robot that floats freely is constant, and the velocity of
//! its base follows from the rates of the joints. M_b is the composite inertia of all bodies at the
//! first one; as that of a rigid body, it has an inverse in closed form.

use core::borrow::Borrow;

use heapless::Vec;

use crate::algorithms::NotPositiveDefinite;
use crate::algorithms::tree_pass::{inward, per_body};
use crate::effects::{Declared, Effect, base_given, body_inertia, rotor_force};
use crate::model::{JointKind, RobotModel};
use crate::scalar::{Real, Vector};
use crate::spatial::inertia::CompositeInertia;
use crate::spatial::{Force, Xform};
use crate::state::{Configuration, RobotState, entry};

/// The results of the outward pass for the inward one.
struct Body<R: Real> {
    x: Xform<R>,
    parent: usize,
    h: Force<R>,
    ic: CompositeInertia<R>,
}

/// The velocity q̇ at which the total momentum of a floating robot is h.
///
/// The rates of the first body, which stands on a free joint, are replaced; h is about the base's
/// origin and along its axes, N·m·s and N·s. The velocity of a robot whose first joint is not free
/// is returned unchanged. The effects are those of [`momentum`](crate::algorithms::momentum()).
///
/// ```text
/// M_b v_b + M_bj q̇_j = h
/// ```
///
/// # Shape
/// V.
///
/// # Cost
/// O(B): some 260 flops for each revolute joint, and 150.
///
/// # Source
/// Umetani & Yoshida (1989), section II; RBDA (2008), (2.63) and (2.66).
///
/// # Example
/// ```
/// use dynamics_core::algorithms::{momentum, base_velocity_from_momentum};
/// use dynamics_core::model::{BASE, Body, Joint, Model};
/// use dynamics_core::{state::manifold::neutral, spatial::Force, state::State};
/// let wheel = |name, parent, joint| Body::new(name, parent, joint).mass(1.0).inertia([1.0, 0.0, 0.0, 1.0, 0.0, 2.0]);
/// let pair: Model<f64, 2, 8, 7> = Model::new("pair", [
///     wheel("satellite", BASE, Joint::free()), wheel("wheel", 0, Joint::revolute([0.0, 0.0, 1.0])),
/// ]);
/// let spun = State { qd: [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 3.0], ..State::at(neutral(&pair)) };
/// let qd = base_velocity_from_momentum(&pair, &spun, Force::ZERO, &())?;
/// assert_eq!(qd, [0.0, 0.0, -1.5, 0.0, 0.0, 0.0, 3.0]); // the satellite turns the other way
/// assert_eq!(momentum(&pair, &State { qd, ..spun }, &()), Force::ZERO);
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
///
/// # Errors
/// [`NotPositiveDefinite`] names the first coordinate if the bodies have no mass, or no inertia
/// about some axis.
#[doc(alias = "recoil")]
#[cfg_attr(optimised, inline(always))]
pub fn base_velocity_from_momentum<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: impl RobotState<R, Q, V>,
    h: Force<R>,
    effects: &E,
) -> Result<[R; V], NotPositiveDefinite>
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let trig = state.configuration().trig_of(robot);
    let (trig, state) = (trig.borrow(), state.state());
    let turns = &trig.coordinates;
    let mut v = per_body(robot, base_given(effects).0);
    let mut bodies: Vec<Body<R>, B> = Vec::new();
    for (i, link) in robot.links().enumerate() {
        let (x, parent) = (link.xform(turns), link.parent);
        let v_i = link.plus_motion(x * v.parent(&link), turns, &state.qd);
        let inertia = body_inertia(effects, i, &link);
        let (mut h, ic) = (inertia * v_i, inertia.into());
        if E::GYROSCOPIC_ROTORS {
            h += rotor_force(effects, &link) * entry(&state.qd, link.idx_v());
        }
        let _ = bodies.push(Body { x, parent, h, ic });
        v.push(v_i);
    }

    let mut lacking = h;
    let mut pass = inward(&mut bodies);
    while let Some((body, inner)) = pass.next() {
        let h = body.x.transpose_mul(body.h);
        match inner.get_mut(body.parent) {
            Some(parent) => {
                parent.h += h;
                parent.ic += body.ic.at_parent(&body.x);
            }
            None => lacking -= h,
        }
    }

    let (mut qd, first) = (state.qd, bodies.first().zip(robot.link(0)));
    let Some((first, link)) = first.filter(|(_, link)| link.kind() == JointKind::Free) else {
        return Ok(qd);
    };
    let Xform { rot, pos } = first.x;
    let couple = lacking.ang - pos.cross(lacking.lin);
    let (at, lacking) = (link.idx_v(), Force::new(rot * couple, rot * lacking.lin));
    let Some(step) = first.ic.solve(lacking) else {
        return Err(NotPositiveDefinite { joint: at });
    };
    let steps = step.ang.array().into_iter().chain(step.lin.array());
    for (qd, step) in qd.iter_mut().skip(at).zip(steps) {
        *qd += step;
    }
    Ok(qd)
}
