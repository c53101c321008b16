//! ∂ID/∂q and ∂ID/∂q̇ over base parameters, in the field form of the Newton-Euler equations.
//!
//! A change of joint j's position or rate changes the velocities and accelerations of all points
//! beyond it, in the frame that moves with them, by
//!
//! ```text
//! δv(r) = δω × r        δa(r) = δa + β × r + 2 δω × (v(r) − v(0))
//! revolute    ∂/∂q: δω = ω × z, δa = a × z, β = U z     ∂/∂q̇: δω = z, δa = 0, β = 2 ω × z
//! prismatic   ∂/∂q: δω = 0, δa = U z, β = 0             ∂/∂q̇: δω = 0, δa = 2 ω × z, β = 0
//! helical     that of a revolute joint and its pitch times that of a prismatic one
//! ```
//!
//! with the origin on the axis, so that a composite body feels them by m, h and Σ and by its rates
//! P = ∫ ṙ dm and D = ∫ r ṙᵀ dm, ṙ being v(r) − v(0):
//!
//! ```text
//! f = m δa + β × h + 2 δω × P      n = h × δa + tr(Σ) β − Σ β + 2 (tr(D) δω − Dᵀ δω)
//! ```
//!
//! The composites are those of Singh, Russell & Wensing (2022); the classical acceleration takes
//! the place of the spatial one, as in [`super::acceleration_field`].

mod composite;
mod several;

use core::borrow::Borrow;

use crate::algorithms::{TorqueGradient, named_derivatives};
use crate::effects::{Declared, Effect, TorqueDerivatives};
use crate::engine::Engine;
use crate::engine::acceleration_field::{AccelerationField, Wrench, along_z};
use crate::engine::call::Call;
use crate::engine::compile::{Compiled, CompiledJoint, Joint, JointPair};
use crate::engine::folding::{Folded, Vec3, rotate_to_parent};
use crate::engine::joint_rates::{JointRates, Twist};
use crate::model::{BASE, Robot};
use crate::scalar::Real;
use crate::state::{Configuration, RobotState, State};
use crate::trig::Kernel;
use composite::Composite;

impl<T, K> Engine<T, K> {
    /// ∂τ/∂q and ∂τ/∂q̇ of inverse dynamics τ = ID(q, q̇, q̈) under the effects of the scene,
    /// N·m/rad and N·m·s/rad between revolute joints; ∂τ/∂q̈ is M, that of [`Engine::crba`].
    ///
    /// The same as [`rnea_derivatives`](crate::algorithms::rnea_derivatives()), with its tangent at
    /// spherical, planar and free joints.
    ///
    /// # Shape
    /// Two of V × V.
    ///
    /// # Cost
    /// `docs/costs.md` in the repository; the same instructions for all data.
    ///
    /// # Source
    /// Singh, Russell & Wensing (2022), by fields of acceleration over base parameters.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Engine, algorithms, effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
    /// let state = State { qd: [0.5; 6], ..State::at([0.0_f64, -1.2, 1.5, 0.3, 0.7, 0.0]) };
    /// let by = Engine::<Ur5e>::rnea_derivatives(&state, &RIGID_BODY);
    /// let same = algorithms::rnea_derivatives(&Ur5e::MODEL, &state, &RIGID_BODY);
    /// assert!((by.dq[1][2] - same.dq[1][2]).abs() < 1e-9);
    /// ```
    #[doc(alias = "computeRNEADerivatives")]
    #[inline(never)]
    #[must_use]
    pub fn rnea_derivatives<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> TorqueGradient<R, V>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        const { named_derivatives::<R, E, B, V>() };
        let trig = state.configuration().trig_or(Self::trig_source());
        let mut gradient = TorqueGradient { dq: [[R::ZERO; V]; V], dqd: [[R::ZERO; V]; V] };
        let call = Self::call(trig.borrow(), effects);
        call.torque_gradient(state.state(), &mut gradient);
        gradient
    }
}

/// The change of all motion beyond a joint by its position or its rate: see the module.
#[derive(Clone, Copy)]
struct Change<R> {
    omega: Vec3<R>,
    accel: Vec3<R>,
    beta: Vec3<R>,
}

impl<R: Real> Change<R> {
    /// The same acceleration everywhere.
    #[cfg_attr(optimised, inline(always))]
    fn shift(accel: Vec3<R>) -> Self {
        Self { omega: Vec3::ZERO, accel, beta: Vec3::ZERO }
    }
}

/// The data that all bodies share.
struct Task<'a, R: Real, T, E, const B: usize, const Q: usize, const V: usize> {
    call: Call<'a, R, T, E, B, Q, V>,
    state: &'a State<R, Q, V>,
    /// The parts of the changes by each joint of one coordinate, and by others.
    kept: [StoredField<R>; V],
    carried: [several::StoredTerms<R>; V],
    gradient: &'a mut TorqueGradient<R, V>,
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Call<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    #[cfg_attr(optimised, inline(always))]
    fn torque_gradient(self, state: &State<R, Q, V>, gradient: &mut TorqueGradient<R, V>) {
        let base = self.base();
        let (kept, carried) = ([StoredField::default(); V], [several::StoredTerms::default(); V]);
        let mut task = Task { call: self, state, kept, carried, gradient };
        for_each_joint!(
            J,
            CompiledJoint::<T, J>::IS_ON_BASE,
            visit = Task::visit::<J> as fn(&mut _, &_) -> _,
            {
                let _ = visit(&mut task, &base);
            }
        );
    }
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Task<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    /// Visits joint I and its descendants; returns their composite in the frame of the parent.
    #[cfg_attr(optimised, inline(always))]
    fn visit<const I: usize>(&mut self, parent: &AccelerationField<R>) -> Composite<R> {
        let joint = CompiledJoint::<T, I>::JOINT;
        let length_inv = Folded::constant(T::LENGTH_INV);
        let unit = if joint.prismatic { length_inv } else { Folded::constant(1.0) };
        let rates = JointRates {
            velocity: Folded::ZERO,
            omega_products: Folded::runtime_if(E::VELOCITY_PRODUCTS, self.state.qd[I]) * unit,
            accel: Folded::runtime_if(E::ACCELERATIONS, self.state.qdd[I]) * unit,
        };
        let at = self.call.displacement::<I>();
        let several = CompiledJoint::<T, I>::COUNT > 1;
        let field =
            if several { self.across_several::<I>(parent, &at) } else { parent.across(&at, rates) };
        let offset = Vec3::constant(joint.pos) + at.shift();
        let own = at.leave(self.velocity::<I>().lin);
        let step = parent.omega_products.cross(offset) + rotate_to_parent::<R, T, I>(own);
        self.kept[I] = StoredField::of(&field, step);

        let inertia = self.call.inertia::<I>(E::BASE_MOTION);
        let mut all = Composite::of(inertia, &field);
        for_each_joint!(
            J,
            JointPair::<T, I, J>::IS_CHILD,
            visit = Self::visit::<J> as fn(&mut _, &_) -> Composite<R>,
            {
                all = all + visit(self, &field);
            }
        );
        if several {
            self.pair_up_several::<I>(&all, &at);
        } else {
            self.pair_up::<I>(&all, &changes(joint, &field), unit);
        }
        all.to_parent(&at, step, offset)
    }

    /// The velocity of joint I in the velocity products, along the axes of its body.
    #[cfg_attr(optimised, inline(always))]
    fn velocity<const I: usize>(&self) -> Twist<R> {
        let (joint, moves) = (CompiledJoint::<T, I>::JOINT, E::VELOCITY_PRODUCTS);
        if CompiledJoint::<T, I>::COUNT > 1 {
            return Twist::of::<T, V, I>(&self.state.qd, moves);
        }
        Twist::along(joint, T::LENGTH_INV, Folded::runtime_if(moves, self.state.qd[I]))
    }

    /// v(0) of joint K's body less its parent's. A component is a known zero where neither an offset
    /// nor a rotation of the parent gives one.
    #[cfg_attr(optimised, inline(always))]
    fn step<const K: usize>(&self) -> Vec3<R> {
        let [x, y, z] = self.kept[K].step;
        let offset = CompiledJoint::<T, K>::JOINT.pos;
        let shifts = CompiledJoint::<T, K>::SHIFTS;
        let turns = !CompiledJoint::<T, K>::PARENT_ON_BASE || E::BASE_MOTION;
        let load =
            |needed: bool, x: R| Folded::runtime_if(E::VELOCITY_PRODUCTS && (shifts || needed), x);
        Vec3([
            load(offset.y != 0.0 || (turns && offset.z != 0.0), x),
            load(offset.x != 0.0 || (turns && offset.z != 0.0), y),
            load(turns && (offset.x != 0.0 || offset.y != 0.0), z),
        ])
    }

    /// The changes by the parent of joint K: ω and α of a revolute joint on a base at rest are
    /// along z.
    #[cfg_attr(optimised, inline(always))]
    fn changes_of_parent<const K: usize>(&self) -> [Change<R>; 2] {
        let joint = CompiledJoint::<T, K>::JOINT;
        let kept = &self.kept[joint.parent];
        let moves = !CompiledJoint::<T, K>::PARENT_ON_BASE || E::BASE_MOTION;
        let rates = moves && E::VELOCITY_PRODUCTS;
        let [w0, w1] = kept.turning.map(|x| Folded::runtime_if(rates, x));
        let [a0, a1] = kept.accel.map(Folded::runtime);
        let [u0, u1, u2] = kept.along.map(|x| Folded::runtime_if(moves, x));
        changes_by(
            CompiledJoint::<T, K>::PARENT,
            Vec3([w0, w1, Folded::ZERO]),
            Vec3([a0, a1, Folded::ZERO]),
            Vec3([u0, u1, u2]),
        )
    }

    /// The entries of joint I with itself and its ancestors.
    #[cfg_attr(optimised, inline(always))]
    fn pair_up<const I: usize>(
        &mut self,
        all: &Composite<R>,
        changes: &[Change<R>; 2],
        unit: Folded<R>,
    ) {
        let joint = CompiledJoint::<T, I>::JOINT;
        let length_inv = Folded::constant(T::LENGTH_INV);
        let [by_position, by_rate] = changes;
        let (by_q, by_qd) = (all.wrench_by(by_position), all.wrench_by(by_rate));
        let mut own = TorqueDerivatives::default();
        let state = self.call.joint_state::<I>(self.state);
        self.call.effects.slopes(I, state, &mut own);
        self.gradient.dq[I][I] = (by_q.along(joint, length_inv) * unit).get() + own.dq;
        self.gradient.dqd[I][I] = (by_qd.along(joint, length_inv) * unit).get() + own.dqd;
        self.pair_up_inward::<I>(all, I, [by_q, by_qd], unit);
    }

    /// The entries of coordinate `c` of joint I with the ancestors.
    #[cfg_attr(optimised, inline(always))]
    fn pair_up_inward<const I: usize>(
        &mut self,
        all: &Composite<R>,
        c: usize,
        [mut by_q, mut by_qd]: [Wrench<R>; 2],
        unit: Folded<R>,
    ) {
        let joint = &T::JOINTS[c];
        let length_inv = Folded::constant(T::LENGTH_INV);
        let one = Folded::constant(1.0);
        // Forces along a prismatic joint are in units of length.
        let of = |joint: &Joint| if joint.prismatic { length_inv } else { one };
        let mut felt = all.felt(joint);
        by_q = by_q + all.moved_wrench(joint);
        for_each_joint_reversed!(K, {
            if JointPair::<T, K, I>::SUPPORTS {
                let other = CompiledJoint::<T, K>::JOINT;
                if other.parent != BASE && other.first == K {
                    let at = self.call.displacement::<K>();
                    (by_q, by_qd) = (by_q.to_parent(&at), by_qd.to_parent(&at));
                    felt = felt.to_parent(&at, self.step::<K>());
                    let (j, parent) = (other.parent, CompiledJoint::<T, K>::PARENT);
                    if parent.count > 1 {
                        let scales = [unit, of(joint)];
                        let first = CompiledJoint::<T, K>::PARENT_FIRST;
                        self.pair_up_with_several(first, c, &[by_q, by_qd], &felt, scales);
                    } else {
                        let [by_position, by_rate] = self.changes_of_parent::<K>();
                        let scale = of(parent) * of(joint);
                        let (q, qd) = (felt.of(&by_position), felt.of(&by_rate));
                        self.gradient.dq[j][c] = (by_q.along(parent, length_inv) * unit).get();
                        self.gradient.dqd[j][c] = (by_qd.along(parent, length_inv) * unit).get();
                        self.gradient.dq[c][j] = (q * scale).get();
                        self.gradient.dqd[c][j] = (qd * scale).get();
                    }
                }
            }
        });
    }
}

/// The field of a joint's body as far as the joints beyond it need it, in memory.
#[derive(Clone, Copy, Default)]
struct StoredField<R> {
    /// ω × z and a × z, without their z.
    turning: [R; 2],
    accel: [R; 2],
    /// U z.
    along: [R; 3],
    /// v(0) less the parent's, in the parent's frame.
    step: [R; 3],
}

impl<R: Real> StoredField<R> {
    #[cfg_attr(optimised, inline(always))]
    fn of(field: &AccelerationField<R>, step: Vec3<R>) -> Self {
        let ([wx, wy, _], [ax, ay, _]) = (field.omega_products.0, field.a.0);
        let [ux, uy, uz] = field.u.0[2].0;
        let [sx, sy, sz] = step.0;
        Self {
            turning: [wy.get(), (-wx).get()],
            accel: [ay.get(), (-ax).get()],
            along: [ux.get(), uy.get(), uz.get()],
            step: [sx.get(), sy.get(), sz.get()],
        }
    }
}

/// The changes by a joint's position and by its rate, in the frame of its body.
#[cfg_attr(optimised, inline(always))]
fn changes<R: Real>(joint: &Joint, field: &AccelerationField<R>) -> [Change<R>; 2] {
    let cross_z = |v: Vec3<R>| Vec3([v.0[1], -v.0[0], Folded::ZERO]);
    changes_by(joint, cross_z(field.omega_products), cross_z(field.a), field.u.0[2])
}

/// The same from ω × z, a × z and U z; a screw turns and slides.
#[cfg_attr(optimised, inline(always))]
fn changes_by<R: Real>(
    joint: &Joint,
    w: Vec3<R>,
    accel: Vec3<R>,
    along: Vec3<R>,
) -> [Change<R>; 2] {
    if joint.prismatic {
        return [Change::shift(along), Change::shift(w + w)];
    }
    let pitch = Folded::constant(joint.pitch);
    let omega = along_z(Folded::constant(1.0));
    let by_rate = Change { omega, accel: (w + w).scale(pitch), beta: w + w };
    [Change { omega: w, accel: accel + along.scale(pitch), beta: along }, by_rate]
}
