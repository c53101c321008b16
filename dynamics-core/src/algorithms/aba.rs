//! Forward dynamics: the articulated-body algorithm in link coordinates.
//!
//! Featherstone, RBDA (2008), table 7.1; Featherstone & Orin (2000), section 3.2.

use core::fmt;

use heapless::Vec;

use crate::articulated::ArticulatedInertia;
use crate::effects::{Effect, JointState};
use crate::model::{Link, Model};
use crate::scalar::{Real, Vector};
use crate::spatial::{Force, Motion, Xform};
use crate::state::{Posture, State, entry};

/// M(q) is not positive definite: the named joint moves no inertia.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct NotPositiveDefinite {
    /// The joint's index in q̇.
    pub joint: usize,
}

impl fmt::Display for NotPositiveDefinite {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            out,
            "joint {} moves no inertia: M is not positive definite",
            self.joint
        )
    }
}

impl core::error::Error for NotPositiveDefinite {}

/// What one pass leaves for the next.
struct Body<'a, R: Real> {
    link: &'a Link<R>,
    x: Xform<R>,
    c: Motion<R>,
    ia: ArticulatedInertia<R>,
    pa: Force<R>,
    u_hat: Force<R>,
    per_d: R,
    u: R,
}

/// q̈ = FD(q, q̇, τ): the acceleration of each joint, rad/s² or m/s², under the effects named.
///
/// Shape: V. Cost: O(B). `state.qdd` is not read. Source: Featherstone (1983; RBDA table 7.1).
/// A scene without `Inertia` does not compile:
///
/// ```compile_fail
/// use dynamics_core::{Core, effects::Gravity, robots::Ur5e, state::State};
/// let _ = Core::<Ur5e>::aba(&State::at([0.0_f32; 6]), &[0.0; 6], &(Gravity::EARTH,));
/// ```
///
/// # Errors
/// [`NotPositiveDefinite`] names a joint that moves no inertia (a massless last link without rotor
/// inertia), or whose inertia is not a number.
#[inline(always)]
pub fn aba<R: Real, E, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
    state: &State<R, Q, V>,
    tau: &[R; V],
    effects: &E,
) -> Result<[R; V], NotPositiveDefinite>
where
    E: Effect<R, B, V>,
{
    aba_at(model, &Posture::of(model, &state.q), state, tau, effects)
}

/// As [`aba`], at a posture whose sines and cosines are at hand.
///
/// # Errors
/// As [`aba`].
#[inline(always)]
pub fn aba_at<R: Real, E, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
    posture: &Posture<R, Q>,
    state: &State<R, Q, V>,
    tau: &[R; V],
    effects: &E,
) -> Result<[R; V], NotPositiveDefinite>
where
    E: Effect<R, B, V>,
{
    const {
        assert!(
            E::ACCELERATIONS,
            "forward dynamics needs `Inertia` in the scene"
        )
    };
    let mut g = R::Vec3::ZERO;
    effects.field(&mut g);
    let (v_0, a_0) = (Motion::ZERO, Motion::new(R::Vec3::ZERO, -g));

    let mut v: Vec<Motion<R>, B> = Vec::new();
    let mut bodies: Vec<Body<'_, R>, B> = Vec::new();
    for (i, link) in model.links.iter().enumerate() {
        let mut loaded = link.inertia;
        let inertia = if E::PAYLOAD && i + 1 == B {
            effects.payload(&mut loaded);
            &loaded
        } else {
            &link.inertia
        };
        let turn = entry(&posture.turns, link.q_at);
        let x = link.joint.xform(turn, &link.placement);
        let qd = entry(&state.qd, link.v_at);
        let v_i = x * *v.get(link.parent).unwrap_or(&v_0) + link.joint.motion(qd);
        let (mut c, mut pa) = (Motion::ZERO, Force::ZERO);
        if E::VELOCITY_PRODUCTS {
            c = link.joint.velocity_product(v_i, qd);
            pa = v_i.cross_force(*inertia * v_i);
        }
        if E::WRENCH {
            let mut fx = Force::ZERO;
            effects.wrench(i, v_i, &mut fx);
            pa -= fx;
        }
        let _ = v.push(v_i);
        let _ = bodies.push(Body {
            link,
            x,
            c,
            ia: (*inertia).into(),
            pa,
            u_hat: Force::ZERO,
            per_d: R::ZERO,
            u: R::ZERO,
        });
    }

    let mut inner = bodies.as_mut_slice();
    while let Some((body, rest)) = core::mem::take(&mut inner).split_last_mut() {
        if let Some(&tau) = tau.get(body.link.v_at) {
            let s = body.link.joint.motion(R::ONE);
            body.u_hat = body.ia * s;
            let mut d = s.dot(body.u_hat);
            effects.inertia(body.link.v_at, &mut d);
            // One comparison that a NaN fails too.
            if !(d > R::ZERO && d.is_finite()) {
                return Err(NotPositiveDefinite {
                    joint: body.link.v_at,
                });
            }
            let at = JointState {
                q: entry(&state.q, body.link.q_at),
                qd: entry(&state.qd, body.link.v_at),
                qdd: R::ZERO,
            };
            let mut lost = R::ZERO;
            effects.torque(body.link.v_at, at, &mut lost);
            body.per_d = R::ONE / d;
            body.u = tau - lost - body.link.joint.project(body.pa);
        }
        if let Some(parent) = rest.get_mut(body.link.parent) {
            let ia = body.ia.minus_outer(body.u_hat, body.per_d);
            let pa = body.pa + ia * body.c + body.u_hat * (body.u * body.per_d);
            parent.ia += ia.at_parent(&body.x);
            parent.pa += body.x.transpose_mul(pa);
        }
        inner = rest;
    }

    let mut qdd = [R::ZERO; V];
    let mut a: Vec<Motion<R>, B> = Vec::new();
    for body in &bodies {
        let mut a_i = body.x * *a.get(body.link.parent).unwrap_or(&a_0) + body.c;
        if let Some(qdd) = qdd.get_mut(body.link.v_at) {
            *qdd = (body.u - a_i.dot(body.u_hat)) * body.per_d;
            a_i += body.link.joint.motion(*qdd);
        }
        let _ = a.push(a_i);
    }
    Ok(qdd)
}
