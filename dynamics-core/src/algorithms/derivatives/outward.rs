//! The outward pass of all derivatives: each body's inertia, and what a coordinate of a joint and
//! its rate change of the bodies beyond it.
//!
//! Singh, Russell & Wensing (2022), equations (9) to (15).

use heapless::Vec;

use crate::algorithms::rnea::{acceleration, velocity};
use crate::algorithms::tree_pass::per_body;
use crate::effects::{Effect, base_motion, body_inertia};
use crate::model::{JointCoordinate, LinkView, RobotModel};
use crate::scalar::Real;
use crate::spatial::inertia::CompositeInertia;
use crate::spatial::{BodyCoriolis, Force, Motion, MotionSubspace, Xform};
use crate::state::State;

/// The results of the outward pass for the inward one.
pub(super) struct Body<'a, R: Real> {
    pub(super) link: LinkView<'a, R>,
    pub(super) x: Xform<R>,
    pub(super) ic: CompositeInertia<R>,
    pub(super) bc: BodyCoriolis<R>,
    pub(super) fc: Force<R>,
}

impl<R: Real> Body<'_, R> {
    /// Adds its composites to those of its parent, one of the bodies `inner` to it.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn add_to(&self, inner: &mut [Self]) {
        if let Some(parent) = inner.get_mut(self.link.parent) {
            parent.ic += self.ic.at_parent(&self.x);
            parent.bc += self.bc.at_parent(&self.x);
            parent.fc += self.x.transpose_mul(self.fc);
        }
    }

    /// 2 Bᶜ ν + Iᶜ η: the change of the force on all bodies from this one on by a change ν of their
    /// velocity and η of their acceleration.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn force(&self, rate: Motion<R>, accel: Motion<R>) -> Force<R> {
        let by_rate = self.bc * rate;
        by_rate + by_rate + self.ic.along(&MotionSubspace::General(accel))
    }
}

/// The changes of velocity and acceleration of all bodies from a joint on by one of its coordinates
/// and by its rate, in the coordinates of its body.
#[derive(Clone, Copy)]
pub(super) struct Column<R: Real> {
    /// S, of ∂/∂q̇ the change of velocity.
    pub(super) s: Motion<R>,
    /// ψ̇ = v_λ × S: of ∂/∂q the change of velocity beside the displacement by S.
    pub(super) s_rate: Motion<R>,
    /// ψ̈ = a_λ × S + v_λ × ψ̇: of ∂/∂q the change of acceleration beside it.
    pub(super) s_accel: Motion<R>,
    /// ψ̇ + Ṡ: of ∂/∂q̇ the change of acceleration.
    pub(super) s_rates: Motion<R>,
}

impl<R: Real> Default for Column<R> {
    #[cfg_attr(optimised, inline(always))]
    fn default() -> Self {
        Self::ZERO
    }
}

impl<R: Real> Column<R> {
    pub(super) const ZERO: Self = Self {
        s: Motion::ZERO,
        s_rate: Motion::ZERO,
        s_accel: Motion::ZERO,
        s_rates: Motion::ZERO,
    };
}

/// S, ψ̇, ψ̈ and ψ̇ + Ṡ of the coordinate k of a link's joint, as far as the effects need them.
///
/// S depends on q at a universal joint alone: with eₖ = (∂S/∂q_k) q̇, the change of the velocity in
/// the body's frame is v_λ × S + e, and that of the acceleration has (∂S/∂q_k) q̈ + ∂(S̊ q̇)/∂q_k +
/// v × e as well.
#[cfg_attr(optimised, inline(always))]
fn column<R: Real, E, const B: usize, const Q: usize, const V: usize>(
    link: &LinkView<'_, R>,
    k: usize,
    [v_parent, a_parent, v]: [Motion<R>; 3],
    turns: &[JointCoordinate<R>],
    state: &State<R, Q, V>,
) -> Column<R>
where
    E: Effect<R, B, V>,
{
    let s = link.column(turns, k);
    let mut column = Column { s, s_accel: a_parent.cross(s), ..Column::ZERO };
    let bend = link.bend(turns, k);
    if E::ACCELERATIONS
        && let Some(bend) = &bend
    {
        column.s_accel += bend.along(&state.qdd);
    }
    if E::VELOCITY_PRODUCTS {
        let mut s_rate = v_parent.cross(s);
        column.s_accel += v_parent.cross(s_rate);
        if let Some(bend) = &bend {
            let e = bend.along(&state.qd);
            // −e × v_λ + v × e, and ∂(S̊ q̇)/∂q.
            column.s_accel += v_parent.cross(e) + v.cross(e) + bend.of_rate(&state.qd);
            s_rate += e;
        }
        column.s_rate = s_rate;
        column.s_rates = s_rate + link.column_rate(turns, &state.qd, v, k);
    }
    column
}

/// The bodies with their own inertias and forces, and the columns of all coordinates.
#[cfg_attr(optimised, inline(always))]
pub(super) fn outward<'a, R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &'a D,
    turns: &[JointCoordinate<R>],
    state: &State<R, Q, V>,
    effects: &E,
) -> (Vec<Body<'a, R>, B>, [Column<R>; V])
where
    D: RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let (v_0, a_0) = base_motion(effects);
    let (mut v, mut a) = (per_body(robot, v_0), per_body(robot, a_0));
    let mut columns = [Column::ZERO; V];
    let mut bodies: Vec<Body<'a, R>, B> = Vec::new();
    for (i, link) in robot.links().enumerate() {
        let x = link.xform(turns);
        let (v_parent, a_parent) = (x * v.parent(&link), x * a.parent(&link));
        let v_i = velocity(effects, &link, v_parent, turns, state);
        let a_i = acceleration(effects, &link, a_parent, v_i, turns, state);
        for k in link.coordinates() {
            if let Some(own) = columns.get_mut(k) {
                let place = k - link.idx_v();
                *own =
                    column::<R, E, B, Q, V>(&link, place, [v_parent, a_parent, v_i], turns, state);
            }
        }
        v.push(v_i);
        a.push(a_i);
        let inertia = body_inertia(effects, i, &link);
        let (ic, bc) = (inertia.into(), BodyCoriolis::new(&inertia, v_i));
        let _ = bodies.push(Body { link, x, ic, bc, fc: inertia.force(a_i, v_i) });
    }
    (bodies, columns)
}
