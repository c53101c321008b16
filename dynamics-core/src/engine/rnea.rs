//! Inverse dynamics by one recursion over the bodies: out on the way down, back on the way up.
//!
//! The field form of Newton-Euler: a body's points accelerate as a(r) = a + U r with
//! U = [α]× + [ω]×[ω]×, and with Σ = ∫ r rᵀ dm the body takes f = m a + U h and
//! n = h × a + axial(U Σ − Σ Uᵀ). Balafoutis & Patel, *Dynamic Analysis of Robot Manipulators*
//! (1991), chapter 5, use U likewise.

use super::known::Known;
use super::prepare::{Joint, Prepared, Tree};
use super::small::{Mat3, Vec3};
use crate::effects::{Effect, JointState};
use crate::model::{BASE, Robot, Turn};
use crate::scalar::{Real, Vector};
use crate::spatial::{Force, Motion};
use crate::state::State;

/// How the points of a body move, in its frame.
#[derive(Clone, Copy)]
pub(crate) struct Field<R> {
    /// ω.
    omega: Vec3<R>,
    /// α.
    alpha: Vec3<R>,
    /// U = [α]× + [ω]×[ω]×.
    u: Mat3<R>,
    /// Acceleration of the origin, in units of length.
    a: Vec3<R>,
    /// Velocity of the origin, in units of length; zero unless an effect reads it.
    v: Vec3<R>,
}

/// A force f at the origin and a couple n.
#[derive(Clone, Copy)]
pub(crate) struct Wrench<R> {
    f: Vec3<R>,
    n: Vec3<R>,
}

/// What all bodies share.
pub(crate) struct Task<'a, R: Real, E, const Q: usize, const V: usize> {
    pub(crate) turns: &'a [Turn<R>; Q],
    pub(crate) state: &'a State<R, Q, V>,
    pub(crate) effects: &'a E,
    pub(crate) tau: &'a mut [R; V],
}

/// The base at rest: a = −g, in units of length.
#[inline(always)]
pub(crate) fn base<R: Real, E, const B: usize, const V: usize>(effects: &E, length: f64) -> Field<R>
where
    E: Effect<R, B, V>,
{
    let mut g = R::Vec3::ZERO;
    effects.field(&mut g);
    let (g, [x, y, z]) = (g.array(), E::FIELD_AXES);
    let per_length = Known::constant(-1.0 / length);
    let a = Vec3([
        Known::only_if(x, g[0]) * per_length,
        Known::only_if(y, g[1]) * per_length,
        Known::only_if(z, g[2]) * per_length,
    ]);
    Field {
        omega: Vec3::ZERO,
        alpha: Vec3::ZERO,
        u: Mat3::ZERO,
        a,
        v: Vec3::ZERO,
    }
}

impl<R: Real> Field<R> {
    /// The field of a child behind a revolute joint.
    #[inline(always)]
    fn turned(&self, joint: &Joint, turn: Turn<R>, rate: Known<R>, accel: Known<R>) -> Self {
        let (rot, p) = (Mat3::constant(&joint.rot), Vec3::constant(joint.pos));
        let [wx, wy, wz] = enter(&rot, turn, self.omega).0;
        let wz = wz + rate;
        let az = rot.transpose_mul(self.alpha).0[2] + accel;
        // Points on the joint's axis move with both links: U's column along it is the parent's.
        let along = enter(&rot, turn, self.u.mul(rot.0[2]));
        let a = enter(&rot, turn, self.a + self.u.mul(p));
        let v = enter(&rot, turn, self.v + self.omega.cross(p));
        Self::complete(Vec3([wx, wy, wz]), az, along, a, v)
    }

    /// U from ω, α_z and U's z column; α from the same.
    #[inline(always)]
    fn complete(w: Vec3<R>, az: Known<R>, along: Vec3<R>, a: Vec3<R>, v: Vec3<R>) -> Self {
        let ([wx, wy, wz], [uxz, uyz, uzz]) = (w.0, along.0);
        let (xz, yz, xy) = (wx * wz, wy * wz, wx * wy);
        let (xx, yy, zz) = (wx * wx, wy * wy, wz * wz);
        let (ax, ay) = (yz - uyz, uxz - xz);
        let u = Mat3([
            Vec3([-(yy + zz), xy + az, xz - ay]),
            Vec3([xy - az, -(xx + zz), yz + ax]),
            Vec3([uxz, uyz, uzz]),
        ]);
        Self {
            omega: w,
            alpha: Vec3([ax, ay, az]),
            u,
            a,
            v,
        }
    }

    /// The field of a child behind a prismatic joint at q, in units of length.
    #[inline(always)]
    fn slid(&self, joint: &Joint, q: Known<R>, rate: Known<R>, accel: Known<R>) -> Self {
        let rot = Mat3::constant(&joint.rot);
        let p = Vec3::constant(joint.pos) + rot.0[2].scale(q);
        let omega = rot.transpose_mul(self.omega);
        let a = rot.transpose_mul(self.a + self.u.mul(p));
        let v = rot.transpose_mul(self.v + self.omega.cross(p));
        let u = Mat3([
            rot.transpose_mul(self.u.mul(rot.0[0])),
            rot.transpose_mul(self.u.mul(rot.0[1])),
            rot.transpose_mul(self.u.mul(rot.0[2])),
        ]);
        Self {
            omega,
            alpha: rot.transpose_mul(self.alpha),
            u,
            a: a + omega.cross(along_z(rate + rate)) + along_z(accel),
            v: v + along_z(rate),
        }
    }

    /// What the body's inertia takes: f = m a + U h, n = h × a + axial(U Σ − Σ Uᵀ).
    #[inline(always)]
    fn wrench(&self, mass: Known<R>, h: Vec3<R>, second: &Mat3<R>) -> Wrench<R> {
        let ([x, y, z], [sx, sy, sz]) = (self.u.0, second.0);
        let ([wx, wy, wz], [sxx, sxy, sxz]) = (self.omega.0, sx.0);
        let (syy, syz, szz) = (sy.0[1], sy.0[2], sz.0[2]);
        let (xx, yy, zz) = (wx * wx, wy * wy, wz * wz);
        let (zy, xz, yx) = (zz - yy, xx - zz, yy - xx);
        let n = Vec3([zy * syz, xz * sxz, yx * sxy])
            + Vec3([x.0[2] * sxy, y.0[0] * syz, z.0[1] * sxz])
            + Vec3([y.0[2] * syy, z.0[0] * szz, x.0[1] * sxx])
            - Vec3([x.0[1] * sxz, y.0[2] * sxy, z.0[0] * syz])
            - Vec3([z.0[1] * szz, x.0[2] * sxx, y.0[0] * syy]);
        Wrench {
            f: self.a.scale(mass) + self.u.mul(h),
            n: h.cross(self.a) + n,
        }
    }
}

/// Visits joint I and all that it carries; returns what they ask of the parent, in its frame.
#[inline(always)]
pub(crate) fn visit<R, T, E, const B: usize, const Q: usize, const V: usize, const I: usize>(
    task: &mut Task<'_, R, E, Q, V>,
    parent: &Field<R>,
) -> Wrench<R>
where
    R: Real,
    T: Robot<B, Q, V>,
    E: Effect<R, B, V>,
{
    let tree: &'static Tree<B, V> = const { &Prepared::<T, B, Q, V>::TREE };
    let joint = const { &Prepared::<T, B, Q, V>::joint(I) };
    let moving = const { E::VELOCITY_PRODUCTS | E::BODY_VELOCITY };
    let at = JointState {
        q: task.state.q[I],
        qd: task.state.qd[I],
        qdd: task.state.qdd[I],
    };
    let turn = task.turns[I];
    let rate = Known::only_if(moving, at.qd);
    let accel = Known::only_if(E::ACCELERATIONS, at.qdd);
    let per_length = Known::constant(1.0 / tree.length);
    let slide = Known::any(at.q) * per_length;

    let field = if joint.prismatic {
        parent.slid(joint, slide, rate * per_length, accel * per_length)
    } else {
        parent.turned(joint, turn, rate, accel)
    };
    let moment = Vec3::constant(joint.moment);
    let mut total = field.wrench(
        Known::constant(joint.mass),
        moment,
        &Mat3::constant(&joint.second),
    );
    if E::WRENCH {
        total = environment::<R, T, E, B, Q, V, I>(task.effects, &field, total);
    }

    macro_rules! children {
        ($($j:literal)*) => {$(
            if const { carries::<T, B, Q, V>(I, $j) } {
                let child = visit::<R, T, E, B, Q, V, $j>(task, &field);
                total = Wrench { f: total.f + child.f, n: total.n + child.n };
            }
        )*};
    }
    children!(1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31);

    let along = if joint.prismatic {
        total.f.0[2] * per_length
    } else {
        total.n.0[2]
    };
    let mut tau = along.get();
    task.effects.torque(I, at, &mut tau);
    task.tau[I] = tau;

    let (rot, p) = (Mat3::constant(&joint.rot), Vec3::constant(joint.pos));
    if joint.prismatic {
        let f = rot.mul(total.f);
        return Wrench {
            f,
            n: rot.mul(total.n) + (p + rot.0[2].scale(slide)).cross(f),
        };
    }
    let f = leave(&rot, turn, total.f);
    Wrench {
        f,
        n: leave(&rot, turn, total.n) + p.cross(f),
    }
}

/// Rz(q)ᵀ Rᵀ v: from the parent's frame into the body's. A function, not a closure: closures are
/// inlined too late for the tags to fold.
#[inline(always)]
fn enter<R: Real>(rot: &Mat3<R>, turn: Turn<R>, v: Vec3<R>) -> Vec3<R> {
    rot.transpose_mul(v)
        .turn_back(Known::any(turn.sin), Known::any(turn.cos))
}

/// R Rz(q) v: out of the body's frame into the parent's.
#[inline(always)]
fn leave<R: Real>(rot: &Mat3<R>, turn: Turn<R>, v: Vec3<R>) -> Vec3<R> {
    rot.mul(v.turn(Known::any(turn.sin), Known::any(turn.cos)))
}

/// A vector along the joint's axis.
#[inline(always)]
fn along_z<R: Real>(z: Known<R>) -> Vec3<R> {
    Vec3([Known::ZERO, Known::ZERO, z])
}

/// Subtracts the wrenches fˣ of the bodies on joint I, given in their own frames.
#[inline(always)]
fn environment<R, T, E, const B: usize, const Q: usize, const V: usize, const I: usize>(
    effects: &E,
    field: &Field<R>,
    mut total: Wrench<R>,
) -> Wrench<R>
where
    R: Real,
    T: Robot<B, Q, V>,
    E: Effect<R, B, V>,
{
    let tree: &'static Tree<B, V> = const { &Prepared::<T, B, Q, V>::TREE };
    let length = Known::constant(tree.length);
    for (body, place) in tree.places.iter().enumerate() {
        if place.joint != I {
            continue;
        }
        let (rot, pos) = (Mat3::constant(&place.rot), Vec3::constant(place.pos));
        let mut velocity = Motion::ZERO;
        if E::BODY_VELOCITY {
            let v = field.v + field.omega.cross(pos);
            velocity = Motion::new(
                rot.transpose_mul(field.omega).get(),
                rot.transpose_mul(v).scale(length).get(),
            );
        }
        let mut fx = Force::ZERO;
        effects.wrench(body, velocity, &mut fx);
        let f = rot.mul(Vec3::any(fx.lin)).scale(length);
        let n = rot.mul(Vec3::any(fx.ang)) + pos.cross(f);
        total = Wrench {
            f: total.f - f,
            n: total.n - n,
        };
    }
    total
}

/// Whether joint `i` carries joint `j`.
pub(crate) const fn carries<T, const B: usize, const Q: usize, const V: usize>(
    i: usize,
    j: usize,
) -> bool
where
    T: Robot<B, Q, V>,
{
    j < V && Prepared::<T, B, Q, V>::TREE.joints[j].parent == i
}

/// Whether joint `j` stands on the base.
pub(crate) const fn stands<T, const B: usize, const Q: usize, const V: usize>(j: usize) -> bool
where
    T: Robot<B, Q, V>,
{
    carries::<T, B, Q, V>(BASE, j)
}
