//! Inverse dynamics with its first two derivatives, τ, τ̇ and τ̈, by one recursion over the bodies.
//!
//! The recursion of [`super::rnea`] on polynomials in time (Buondonno & De Luca, "A recursive
//! Newton-Euler algorithm for robots with elastic joints", 2015), over base parameters: they give
//! the same τ along every course of q, hence the same derivatives. Quantities that are linear in
//! the field with constant coefficients, such as the wrench of a body, are computed for each
//! coefficient; ω ωᵀ is the only product of polynomials, and of a rotation there are its sine and
//! its cosine and the terms of q̇ and q̈.

use core::hint::black_box;
use core::marker::PhantomData;

use super::Engine;
use super::acceleration_field::{Inertia, Wrench, along_z};
use super::call::Call;
use super::compile::{Compiled, CompiledJoint, CompiledRobot, Joint, JointMotion, JointPair};
use super::folding::{Folded, Mat3, Series, Sym3, Turn, Vec3};
use super::folding::{constant_offset_cross, rotate_to_parent};
use crate::effects::{Effect, JointState, add_joint_torque_rates};
use crate::model::Robot;
use crate::scalar::Real;
use crate::state::{JointTrig, State, TrigSource};
use crate::trig::Kernel;

impl<T, K> Engine<T, K> {
    /// τ = ID(q, q̇, q̈) and its derivatives τ̇ and τ̈, along a course with these third and fourth
    /// derivatives of q.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn torque_rates<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: &State<R, Q, V>,
        jerk: &[R; V],
        snap: &[R; V],
        effects: &E,
    ) -> [[R; 3]; V]
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        const { takes_elastic_joints::<CompiledRobot<T, B, Q, V>>() };
        let trig: JointTrig<R, Q> = Self::trig_source().compute(&state.q);
        // As forward dynamics: see [`Call`].
        let call = Call {
            turns: &trig.coordinates,
            effects,
            robot: PhantomData::<CompiledRobot<T, B, Q, V>>,
        };
        call.torque_rates(state, [jerk, snap])
    }
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Call<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    #[cfg_attr(optimised, inline(always))]
    fn torque_rates(self, state: &State<R, Q, V>, [jerk, snap]: [&[R; V]; 2]) -> [[R; 3]; V] {
        let mut tau = [[R::ZERO; 3]; V];
        let mut task = Task { call: self, state, jerk, snap, tau: &mut tau };
        let base = Field::at_rest(self.unaccelerated().a);
        for_each_joint!(
            J,
            CompiledJoint::<T, J>::IS_ON_BASE,
            visit = Task::visit::<J> as fn(&mut _, &_) -> _,
            {
                visit(&mut task, &base);
            }
        );
        tau
    }
}

/// A robot whose joints may be elastic here.
const fn takes_elastic_joints<T: Compiled>() {
    let mut i = 0;
    while i < T::JOINTS.len() {
        assert!(
            matches!(T::JOINTS[i].motion, JointMotion::Turn | JointMotion::Slide),
            "the engine takes elastic joints that are revolute or prismatic; use `Core`"
        );
        i += 1;
    }
}

/// The data that all bodies share.
struct Task<'a, R: Real, T, E, const B: usize, const Q: usize, const V: usize> {
    call: Call<'a, R, T, E, B, Q, V>,
    state: &'a State<R, Q, V>,
    jerk: &'a [R; V],
    snap: &'a [R; V],
    tau: &'a mut [[R; 3]; V],
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Task<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    /// Visits joint I and its descendants; returns the wrench that they need from the parent, in
    /// its frame.
    #[cfg_attr(optimised, inline(always))]
    fn visit<const I: usize>(&mut self, parent: &Field<R>) -> WrenchSeries<R> {
        let joint = CompiledJoint::<T, I>::JOINT;
        let (half, length_inv) = (R::from_f64(0.5), Folded::constant(T::LENGTH_INV));
        let (at, qdd) = (JointState::new(self.state.q[I], self.state.qd[I]), self.state.qdd[I]);
        let (jerk, snap) = (self.jerk[I], self.snap[I]);
        let turn = Turn::new(self.call.turns[I], at.qd, qdd);
        let slide = Series::runtime([self.call.turns[I].q, at.qd, half * qdd]).times(length_inv);
        let accel = Series::runtime([qdd, jerk, half * snap]);
        let field = if joint.prismatic {
            let rate = Series::runtime([at.qd, qdd, half * jerk]).times(length_inv);
            parent.across_prismatic(joint, slide, rate, accel.times(length_inv))
        } else {
            parent.across_revolute(joint, &turn, at.qd, accel)
        };
        let body = self.call.inertia::<I>(false);
        let mut total = field.wrench(&body);
        if const { !CompiledJoint::<T, I>::IS_ON_BASE } {
            total = total.finished();
        }

        for_each_joint!(
            J,
            JointPair::<T, I, J>::IS_PARENT,
            visit = Self::visit::<J> as fn(&mut _, &_) -> WrenchSeries<R>,
            {
                let child = visit(self, &field);
                total = WrenchSeries { f: total.f + child.f, n: total.n + child.n };
            }
        );

        let along = if joint.prismatic { total.f.z().times(length_inv) } else { total.n.z() };
        let [tau, rate, half_accel] = along.0.map(Folded::get);
        let mut rates = [tau, rate, half_accel + half_accel];
        add_joint_torque_rates(self.call.effects, I, at, [qdd, jerk, snap], &mut rates);
        self.tau[I] = rates;
        total.to_parent::<T, I>(&turn, slide)
    }
}

/// The acceleration field of a body, in its frame: the components' polynomials in time.
#[derive(Clone, Copy)]
struct Field<R> {
    omega: Series<Vec3<R>>,
    /// α: the derivative of `omega`, so to t³ of it.
    alpha: Series<Vec3<R>>,
    /// U = \[α\]× + \[ω\]×\[ω\]×.
    u: Series<Mat3<R>>,
    /// Acceleration of the origin, in units of length.
    a: Series<Vec3<R>>,
    /// ω ωᵀ.
    squares: [Sym3<R>; 3],
}

impl<R: Real> Field<R> {
    /// The field of a base at rest, where a = −g.
    #[cfg_attr(optimised, inline(always))]
    fn at_rest(a: Vec3<R>) -> Self {
        Self {
            omega: Series([Vec3::ZERO; 3]),
            alpha: Series([Vec3::ZERO; 3]),
            u: Series([Mat3::ZERO; 3]),
            a: Series::constant(a),
            squares: [Sym3::ZERO; 3],
        }
    }

    /// The field of a child behind a revolute joint.
    #[cfg_attr(optimised, inline(always))]
    fn across_revolute(
        &self,
        joint: &Joint,
        turn: &Turn<R>,
        rate: R,
        accel: Series<Folded<R>>,
    ) -> Self {
        let (rot, p) = (Mat3::constant(&joint.rot), Vec3::constant(joint.pos));
        let a = turn.enter((self.a + self.u.mul(Series::constant(p))).times_transposed(&rot));
        // Points on the joint's axis move with both links: U's column along it is the parent's.
        let axis = Series::constant(rot.0[2]);
        let along = turn.enter(self.u.mul(axis).times_transposed(&rot));
        let az = self.alpha.times_transposed(&rot).z() + accel;
        let half = Folded::constant(0.5);
        // α of each order is the next coefficient of ω, which the products of the next order need.
        let w0 =
            turn.enter_now(rot.transpose_mul(self.omega.0[0])) + along_z(Folded::runtime(rate));
        let s0 = Sym3::square(w0, Folded::ONE);
        let (w1, u0) = completed(&s0, az.0[0], along.0[0]);
        let s1 = Sym3::both(w0, w1);
        let (a1, u1) = completed(&s1, az.0[1], along.0[1]);
        let w2 = a1.scale(half);
        let s2 = Sym3::both(w0, w2) + Sym3::square(w1, Folded::ONE);
        let (a2, u2) = completed(&s2, az.0[2], along.0[2]);
        Self {
            omega: Series([w0, w1, w2]),
            alpha: Series([w1, a1, a2]),
            u: Series([u0, u1, u2]),
            a,
            squares: [s0, s1, s2],
        }
    }

    /// The field of a child behind a prismatic joint at q, in units of length.
    #[cfg_attr(optimised, inline(always))]
    fn across_prismatic(
        &self,
        joint: &Joint,
        q: Series<Folded<R>>,
        rate: Series<Folded<R>>,
        accel: Series<Folded<R>>,
    ) -> Self {
        let rot = Mat3::constant(&joint.rot);
        let axis = Series::constant(rot.0[2]);
        let p = Series::constant(Vec3::constant(joint.pos)) + axis.scale(q);
        let a = (self.a + self.u.mul(p)).times_transposed(&rot);
        let [x, y, z] = rot.0;
        let x = self.u.mul(Series::constant(x)).times_transposed(&rot);
        let y = self.u.mul(Series::constant(y)).times_transposed(&rot);
        let z = self.u.mul(Series::constant(z)).times_transposed(&rot);
        let omega = self.omega.times_transposed(&rot);
        let [w0, w1, w2] = omega.0;
        let up = Series::constant(along_z(Folded::ONE));
        Self {
            omega,
            alpha: self.alpha.times_transposed(&rot),
            u: Series([
                Mat3([x.0[0], y.0[0], z.0[0]]),
                Mat3([x.0[1], y.0[1], z.0[1]]),
                Mat3([x.0[2], y.0[2], z.0[2]]),
            ]),
            a: a + omega.cross(up.scale(rate + rate)) + up.scale(accel),
            squares: [
                Sym3::square(w0, Folded::ONE),
                Sym3::both(w0, w1),
                Sym3::both(w0, w2) + Sym3::square(w1, Folded::ONE),
            ],
        }
    }

    /// The wrench that accelerates the body's inertia.
    #[cfg_attr(optimised, inline(always))]
    fn wrench(&self, body: &Inertia<R>) -> WrenchSeries<R> {
        let ([a0, a1, a2], [u0, u1, u2]) = (self.a.0, &self.u.0);
        let [s0, s1, s2] = &self.squares;
        let w0 = wrench(body, a0, u0, s0);
        let w1 = wrench(body, a1, u1, s1);
        let w2 = wrench(body, a2, u2, s2);
        WrenchSeries { f: Series([w0.f, w1.f, w2.f]), n: Series([w0.n, w1.n, w2.n]) }
    }
}

/// α and U from ω ωᵀ, α_z and U's z column: linear in all three, so for each coefficient.
#[cfg_attr(optimised, inline(always))]
fn completed<R: Real>(squares: &Sym3<R>, az: Folded<R>, along: Vec3<R>) -> (Vec3<R>, Mat3<R>) {
    let (s, [uxz, uyz, uzz]) = (squares, along.0);
    let (ax, ay) = (s.yz - uyz, uxz - s.xz);
    let u = Mat3([
        Vec3([-(s.yy + s.zz), s.xy + az, s.xz - ay]),
        Vec3([s.xy - az, -(s.xx + s.zz), s.yz + ax]),
        Vec3([uxz, uyz, uzz]),
    ]);
    (Vec3([ax, ay, az]), u)
}

/// The wrench of an inertia, f = m a + U h and n = h × a + axial(U Σ − Σ Uᵀ), linear in a, U and ω
/// ωᵀ: for each coefficient.
#[cfg_attr(optimised, inline(always))]
fn wrench<R: Real>(body: &Inertia<R>, a: Vec3<R>, u: &Mat3<R>, squares: &Sym3<R>) -> Wrench<R> {
    let (m, [x, y, z]) = (&body.second, u.0);
    // U_yy − U_zz and the others by its symmetric part.
    let zy = squares.zz - squares.yy;
    let (xz, yx) = (squares.xx - squares.zz, squares.yy - squares.xx);
    let n = Vec3([zy * m.yz, xz * m.xz, yx * m.xy])
        + Vec3([x.0[2] * m.xy, y.0[0] * m.yz, z.0[1] * m.xz])
        + Vec3([y.0[2] * m.yy, z.0[0] * m.zz, x.0[1] * m.xx])
        - Vec3([x.0[1] * m.xz, y.0[2] * m.xy, z.0[0] * m.yz])
        - Vec3([z.0[1] * m.zz, x.0[2] * m.xx, y.0[0] * m.yy]);
    Wrench { f: a.scale(body.mass) + u.mul(body.moment), n: body.moment.cross(a) + n }
}

/// A force f at the origin and a couple n: the components' polynomials in time.
#[derive(Clone, Copy)]
struct WrenchSeries<R> {
    f: Series<Vec3<R>>,
    n: Series<Vec3<R>>,
}

impl<R: Real> WrenchSeries<R> {
    /// The same, computed before the children's fields: the compiler does not see through it. Left
    /// to itself, it mixes the bodies and keeps more numbers than there are registers, which takes
    /// an eighth of the cycles more.
    #[cfg_attr(optimised, inline(always))]
    fn finished(self) -> Self {
        let (f, n) = black_box((self.f.0.map(Vec3::get), self.n.0.map(Vec3::get)));
        Self { f: Series(f.map(Vec3::runtime)), n: Series(n.map(Vec3::runtime)) }
    }

    /// The same in the frame of joint I's parent and about its origin.
    #[cfg_attr(optimised, inline(always))]
    fn to_parent<T: Compiled, const I: usize>(
        self,
        turn: &Turn<R>,
        slide: Series<Folded<R>>,
    ) -> Self {
        let (mut f, mut n) = (self.f, self.n);
        if !CompiledJoint::<T, I>::PRISMATIC {
            (f, n) = (turn.leave(f), turn.leave(n));
        }
        let ([f0, f1, f2], [n0, n1, n2]) = (f.0, n.0);
        let f = Series([
            rotate_to_parent::<R, T, I>(f0),
            rotate_to_parent::<R, T, I>(f1),
            rotate_to_parent::<R, T, I>(f2),
        ]);
        let [f0, f1, f2] = f.0;
        let mut n = Series([
            rotate_to_parent::<R, T, I>(n0) + constant_offset_cross::<R, T, I>(f0),
            rotate_to_parent::<R, T, I>(n1) + constant_offset_cross::<R, T, I>(f1),
            rotate_to_parent::<R, T, I>(n2) + constant_offset_cross::<R, T, I>(f2),
        ]);
        if CompiledJoint::<T, I>::PRISMATIC {
            let axis = Vec3::constant(CompiledJoint::<T, I>::JOINT.rot.z_axis);
            n = n + Series::constant(axis).scale(slide).cross(f);
        }
        Self { f, n }
    }
}
