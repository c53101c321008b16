//! ∂ID/∂q and ∂ID/∂q̇ over base parameters, in the field form of the Newton-Euler equations.
//!
//! A change of joint j's position or rate changes the velocities and accelerations of all points
//! beyond it, in the frame that moves with them, by
//!
//! ```text
//! δv(r) = δω × r        δa(r) = δa + β × r + 2 δω × (v(r) − v(0))
//! revolute    ∂/∂q: δω = ω × z, δa = a × z, β = U z     ∂/∂q̇: δω = z, δa = 0, β = 2 ω × z
//! prismatic   ∂/∂q: δω = 0, δa = U z, β = 0             ∂/∂q̇: δω = 0, δa = 2 ω × z, β = 0
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

mod floating;

use core::borrow::Borrow;

use crate::algorithms::{TorqueGradient, named_derivatives};
use crate::effects::{Declared, Effect, TorqueDerivatives};
use crate::engine::Engine;
use crate::engine::acceleration_field::{AccelerationField, Inertia, Wrench, along_z};
use crate::engine::call::Call;
use crate::engine::compile::{
    Compiled, CompiledJoint, CompiledRobot, Joint, JointMotion, JointPair,
};
use crate::engine::displacement::Displacement;
use crate::engine::folding::{Folded, Mat3, Vec3, rotate_matrix_to_parent, rotate_to_parent};
use crate::engine::joint_rates::JointRates;
use crate::model::{BASE, Robot};
use crate::scalar::Real;
use crate::state::{Configuration, RobotState, State};
use crate::trig::Kernel;
use floating::Floating;

impl<Arm, Sines> Engine<Arm, Sines> {
    /// ∂τ/∂q and ∂τ/∂q̇ of inverse dynamics τ = ID(q, q̇, q̈) under the effects of the scene,
    /// N·m/rad and N·m·s/rad between revolute joints; ∂τ/∂q̈ is M, that of [`Engine::crba`].
    ///
    /// The same as [`rnea_derivatives`](crate::algorithms::rnea_derivatives()), for robots of
    /// revolute and prismatic joints, on a base that is fixed, moves or is free; others do not compile.
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
    pub fn rnea_derivatives<Scalar: Real, Effects, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<Scalar, Q, V>,
        effects: &Effects,
    ) -> TorqueGradient<Scalar, V>
    where
        Arm: Robot<B, Q, V>,
        Sines: Kernel<Scalar>,
        Effects: Effect<Scalar, B, V>,
    {
        scene_is_taken!();
        const {
            named_derivatives::<Scalar, Effects, B, V>();
            takes_joints::<CompiledRobot<Arm, B, Q, V>>(Effects::BASE_MOTION);
        };
        let trig = state.configuration().trig_or(Self::trig_source());
        let mut gradient =
            TorqueGradient { dq: [[Scalar::ZERO; V]; V], dqd: [[Scalar::ZERO; V]; V] };
        let call = Self::call(trig.borrow(), effects);
        call.torque_gradient(state.state(), &mut gradient);
        gradient
    }
}

/// A robot of revolute and prismatic joints, on a base that may move or be free.
const fn takes_joints<Tree: Compiled>(base_moves: bool) {
    let mut i = 0;
    while i < Tree::JOINTS.len() {
        let first = Tree::JOINTS[Tree::JOINTS[i].first];
        assert!(
            match first.motion {
                JointMotion::Turn | JointMotion::Slide => true,
                JointMotion::Free => first.parent == BASE && !base_moves,
                _ => false,
            },
            "the engine differentiates robots of revolute and prismatic joints, on a base that is \
             fixed, moves or is free; use `algorithms::rnea_derivatives`"
        );
        i += 1;
    }
}

/// The change of all motion beyond a joint by its position or its rate: see the module.
#[derive(Clone, Copy)]
struct Change<Scalar> {
    omega: Vec3<Scalar>,
    accel: Vec3<Scalar>,
    beta: Vec3<Scalar>,
}

impl<Scalar: Real> Change<Scalar> {
    /// The same acceleration everywhere.
    #[cfg_attr(optimised, inline(always))]
    fn shift(accel: Vec3<Scalar>) -> Self {
        Self { omega: Vec3::ZERO, accel, beta: Vec3::ZERO }
    }
}

/// The inertia of a body and its descendants, its rates, and the wrench that it needs.
#[derive(Clone, Copy)]
struct Composite<Scalar> {
    inertia: Inertia<Scalar>,
    /// P.
    momentum: Vec3<Scalar>,
    /// D, whose column k is ∫ r ṙ_k dm.
    product: Mat3<Scalar>,
    wrench: Wrench<Scalar>,
}

/// The coefficients of the torque by which a joint feels a change: g δa + κ β + 2 s δω.
#[derive(Clone, Copy)]
struct Felt<Scalar> {
    /// (g, κ): the wrench of a unit acceleration.
    unit: Wrench<Scalar>,
    rate: Vec3<Scalar>,
}

/// The data that all bodies share.
struct Task<'a, Scalar: Real, Tree, Effects, const B: usize, const Q: usize, const V: usize> {
    call: Call<'a, Scalar, Tree, Effects, B, Q, V>,
    state: &'a State<Scalar, Q, V>,
    /// The parts of the changes by each joint, and by a free base.
    kept: [Kept<Scalar>; V],
    base: Floating<Scalar>,
    gradient: &'a mut TorqueGradient<Scalar, V>,
}

impl<Scalar, Tree, Effects, const B: usize, const Q: usize, const V: usize>
    Call<'_, Scalar, Tree, Effects, B, Q, V>
where
    Scalar: Real,
    Tree: Compiled,
    Effects: Effect<Scalar, B, V>,
{
    #[cfg_attr(optimised, inline(always))]
    fn torque_gradient(
        self,
        state: &State<Scalar, Q, V>,
        gradient: &mut TorqueGradient<Scalar, V>,
    ) {
        let base = self.base();
        let (kept, floating) = ([Kept::default(); V], Floating::default());
        let mut task = Task { call: self, state, kept, base: floating, gradient };
        for_each_joint!(
            J,
            CompiledJoint::<Tree, J>::IS_ON_BASE,
            visit = Task::visit::<J> as fn(&mut _, &_) -> _,
            {
                let _ = visit(&mut task, &base);
            }
        );
    }
}

impl<Scalar, Tree, Effects, const B: usize, const Q: usize, const V: usize>
    Task<'_, Scalar, Tree, Effects, B, Q, V>
where
    Scalar: Real,
    Tree: Compiled,
    Effects: Effect<Scalar, B, V>,
{
    /// Visits joint I and its descendants; returns their composite in the frame of the parent.
    #[cfg_attr(optimised, inline(always))]
    fn visit<const I: usize>(&mut self, parent: &AccelerationField<Scalar>) -> Composite<Scalar> {
        let joint = CompiledJoint::<Tree, I>::JOINT;
        let length_inv = Folded::constant(Tree::LENGTH_INV);
        let unit = if joint.prismatic { length_inv } else { Folded::constant(1.0) };
        let rates = JointRates {
            velocity: Folded::ZERO,
            omega_products: Folded::runtime_if(Effects::VELOCITY_PRODUCTS, self.state.qd[I]) * unit,
            accel: Folded::runtime_if(Effects::ACCELERATIONS, self.state.qdd[I]) * unit,
        };
        let at = self.call.displacement::<I>();
        let floats = CompiledJoint::<Tree, I>::COUNT > 1;
        let field = if floats { self.float::<I>(parent, &at) } else { parent.across(&at, rates) };
        let offset = Vec3::constant(joint.pos) + at.shift();
        let mut step = parent.omega_products.cross(offset);
        if joint.prismatic {
            let along = rotate_to_parent::<Scalar, Tree, I>(along_z(rates.omega_products));
            step = step + along;
        }
        self.kept[I] = Kept::of(&field, step);

        let inertia = self.call.inertia::<I>(Effects::BASE_MOTION);
        let mut all = Composite::of(inertia, &field);
        for_each_joint!(
            J,
            JointPair::<Tree, I, J>::IS_CHILD,
            visit = Self::visit::<J> as fn(&mut _, &_) -> Composite<Scalar>,
            {
                all = all + visit(self, &field);
            }
        );
        if floats {
            self.pair_up_floating::<I>(&all, &at);
        } else {
            self.pair_up::<I>(&all, &changes(joint.prismatic, &field), unit);
        }
        all.to_parent(&at, step, offset)
    }

    /// v(0) of joint K's body less its parent's, of which the components are known zeros that no
    /// offset and no rotation of the parent give.
    #[cfg_attr(optimised, inline(always))]
    fn step<const K: usize>(&self) -> Vec3<Scalar> {
        let [x, y, z] = self.kept[K].step;
        let offset = CompiledJoint::<Tree, K>::JOINT.pos;
        let shifts = CompiledJoint::<Tree, K>::SHIFTS;
        let turns = !CompiledJoint::<Tree, K>::PARENT_ON_BASE || Effects::BASE_MOTION;
        let load = |needed: bool, x: Scalar| {
            Folded::runtime_if(Effects::VELOCITY_PRODUCTS && (shifts || needed), x)
        };
        Vec3([
            load(offset.y != 0.0 || (turns && offset.z != 0.0), x),
            load(offset.x != 0.0 || (turns && offset.z != 0.0), y),
            load(turns && (offset.x != 0.0 || offset.y != 0.0), z),
        ])
    }

    /// The changes by the parent of joint K: ω and α of a revolute joint on a base at rest are
    /// along z.
    #[cfg_attr(optimised, inline(always))]
    fn changes_of_parent<const K: usize>(&self) -> [Change<Scalar>; 2] {
        let joint = CompiledJoint::<Tree, K>::JOINT;
        let kept = &self.kept[joint.parent];
        let moves = !CompiledJoint::<Tree, K>::PARENT_ON_BASE || Effects::BASE_MOTION;
        let rates = moves && Effects::VELOCITY_PRODUCTS;
        let [w0, w1] = kept.turning.map(|x| Folded::runtime_if(rates, x));
        let [a0, a1] = kept.accel.map(Folded::runtime);
        let [u0, u1, u2] = kept.along.map(|x| Folded::runtime_if(moves, x));
        changes_by(
            CompiledJoint::<Tree, K>::PARENT.prismatic,
            Vec3([w0, w1, Folded::ZERO]),
            Vec3([a0, a1, Folded::ZERO]),
            Vec3([u0, u1, u2]),
        )
    }

    /// The entries of joint I with itself and its ancestors.
    #[cfg_attr(optimised, inline(always))]
    fn pair_up<const I: usize>(
        &mut self,
        all: &Composite<Scalar>,
        changes: &[Change<Scalar>; 2],
        unit: Folded<Scalar>,
    ) {
        let joint = CompiledJoint::<Tree, I>::JOINT;
        let length_inv = Folded::constant(Tree::LENGTH_INV);
        let one = Folded::constant(1.0);
        // Forces along a prismatic joint are in units of length.
        let of = |joint: &Joint| if joint.prismatic { length_inv } else { one };
        let [by_position, by_rate] = changes;
        let (mut by_q, mut by_qd) = (all.wrench_by(by_position), all.wrench_by(by_rate));
        let mut felt = all.felt(joint.prismatic);
        let mut own = TorqueDerivatives::default();
        let state = self.call.joint_state::<I>(self.state);
        self.call.effects.slopes(I, state, &mut own);
        self.gradient.dq[I][I] = (by_q.along(joint, length_inv) * unit).get() + own.dq;
        self.gradient.dqd[I][I] = (by_qd.along(joint, length_inv) * unit).get() + own.dqd;
        by_q = by_q + all.turned_wrench(joint.prismatic);
        for_each_joint_reversed!(K, {
            if JointPair::<Tree, K, I>::SUPPORTS {
                let other = CompiledJoint::<Tree, K>::JOINT;
                if other.parent != BASE && other.first == K {
                    let at = self.call.displacement::<K>();
                    (by_q, by_qd) = (by_q.to_parent(&at), by_qd.to_parent(&at));
                    felt = felt.to_parent(&at, self.step::<K>());
                    let (j, parent) = (other.parent, CompiledJoint::<Tree, K>::PARENT);
                    if parent.count > 1 {
                        let scales = [unit, of(joint)];
                        self.pair_up_with_base::<I>(parent.first, [&by_q, &by_qd], &felt, scales);
                    } else {
                        let [by_position, by_rate] = self.changes_of_parent::<K>();
                        let scale = of(parent) * of(joint);
                        let (q, qd) = (felt.of(&by_position), felt.of(&by_rate));
                        self.gradient.dq[j][I] = (by_q.along(parent, length_inv) * unit).get();
                        self.gradient.dqd[j][I] = (by_qd.along(parent, length_inv) * unit).get();
                        self.gradient.dq[I][j] = (q * scale).get();
                        self.gradient.dqd[I][j] = (qd * scale).get();
                    }
                }
            }
        });
    }
}

/// The field of a joint's body as far as the joints beyond it need it, in memory.
#[derive(Clone, Copy, Default)]
struct Kept<Scalar> {
    /// ω × z and a × z, without their z.
    turning: [Scalar; 2],
    accel: [Scalar; 2],
    /// U z.
    along: [Scalar; 3],
    /// v(0) less the parent's, in the parent's frame.
    step: [Scalar; 3],
}

impl<Scalar: Real> Kept<Scalar> {
    #[cfg_attr(optimised, inline(always))]
    fn of(field: &AccelerationField<Scalar>, step: Vec3<Scalar>) -> Self {
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
fn changes<Scalar: Real>(
    is_prismatic: bool,
    field: &AccelerationField<Scalar>,
) -> [Change<Scalar>; 2] {
    let cross_z = |v: Vec3<Scalar>| Vec3([v.0[1], -v.0[0], Folded::ZERO]);
    changes_by(is_prismatic, cross_z(field.omega_products), cross_z(field.a), field.u.0[2])
}

/// The same from ω × z, a × z and U z.
#[cfg_attr(optimised, inline(always))]
fn changes_by<Scalar: Real>(
    is_prismatic: bool,
    w: Vec3<Scalar>,
    accel: Vec3<Scalar>,
    along: Vec3<Scalar>,
) -> [Change<Scalar>; 2] {
    if is_prismatic {
        return [Change::shift(along), Change::shift(w + w)];
    }
    let omega = along_z(Folded::constant(1.0));
    let by_rate = Change { omega, accel: Vec3::ZERO, beta: w + w };
    [Change { omega: w, accel, beta: along }, by_rate]
}

impl<Scalar: Real> Composite<Scalar> {
    /// A body alone: P = ω × h, D = Σ \[ω\]×ᵀ.
    #[cfg_attr(optimised, inline(always))]
    fn of(inertia: Inertia<Scalar>, field: &AccelerationField<Scalar>) -> Self {
        let ([wx, wy, wz], [x, y, z]) = (field.omega_products.0, inertia.second.columns());
        let product =
            Mat3([z.scale(wy) - y.scale(wz), x.scale(wz) - z.scale(wx), y.scale(wx) - x.scale(wy)]);
        let momentum = field.omega_products.cross(inertia.moment);
        Self { inertia, momentum, product, wrench: field.wrench(&inertia) }
    }

    /// The wrench by which a change is felt, at the origin.
    #[cfg_attr(optimised, inline(always))]
    fn wrench_by(&self, change: &Change<Scalar>) -> Wrench<Scalar> {
        let (h, s, d) = (self.inertia.moment, &self.inertia.second, &self.product.0);
        let (w, beta) = (change.omega, change.beta);
        let [x, y, z] = s.columns();
        let half_f = w.cross(self.momentum);
        let f = change.accel.scale(self.inertia.mass) + beta.cross(h) + half_f + half_f;
        let half_n = w.scale(d[0].0[0] + d[1].0[1] + d[2].0[2])
            - Vec3([d[0].dot(w), d[1].dot(w), d[2].dot(w)]);
        let spin = beta.scale(s.xx + s.yy + s.zz) - Vec3([x.dot(beta), y.dot(beta), z.dot(beta)]);
        Wrench { f, n: h.cross(change.accel) + spin + half_n + half_n }
    }

    /// The coefficients of the joint's torque.
    #[cfg_attr(optimised, inline(always))]
    fn felt(&self, is_prismatic: bool) -> Felt<Scalar> {
        let (zero, [hx, hy, _]) = (Folded::ZERO, self.inertia.moment.0);
        let (s, d) = (&self.inertia.second, &self.product.0);
        if is_prismatic {
            let [px, py, _] = self.momentum.0;
            let unit = Wrench { f: along_z(self.inertia.mass), n: Vec3([hy, -hx, zero]) };
            return Felt { unit, rate: Vec3([py, -px, zero]) };
        }
        let unit = Wrench { f: Vec3([-hy, hx, zero]), n: Vec3([-s.xz, -s.yz, s.xx + s.yy]) };
        Felt { unit, rate: Vec3([-d[2].0[0], -d[2].0[1], d[0].0[0] + d[1].0[1]]) }
    }

    /// The change of the composite's wrench as it is turned or shifted by the joint.
    #[cfg_attr(optimised, inline(always))]
    fn turned_wrench(&self, is_prismatic: bool) -> Wrench<Scalar> {
        let z_cross = |v: Vec3<Scalar>| Vec3([-v.0[1], v.0[0], Folded::ZERO]);
        let Wrench { f, n } = self.wrench;
        if is_prismatic {
            return Wrench { f: Vec3::ZERO, n: z_cross(f) };
        }
        Wrench { f: z_cross(f), n: z_cross(n) }
    }

    /// The same in the frame of joint I's parent and about its origin, which is `offset` away and
    /// moves more slowly by `step`.
    #[cfg_attr(optimised, inline(always))]
    fn to_parent<Tree: Compiled, const I: usize>(
        self,
        at: &Displacement<Scalar, Tree, I>,
        step: Vec3<Scalar>,
        offset: Vec3<Scalar>,
    ) -> Self {
        let turned = self.inertia.turned(at);
        let h = rotate_to_parent::<Scalar, Tree, I>(turned.moment);
        let p = rotate_to_parent::<Scalar, Tree, I>(at.leave(self.momentum));
        let Mat3([x, y, z]) =
            rotate_matrix_to_parent::<Scalar, Tree, I>(&at.leave_matrix(&self.product));
        let m = self.inertia.mass;
        let ([px, py, pz], [ux, uy, uz]) = (p.0, step.0);
        let there = h + offset.scale(m);
        let product = Mat3([
            x + offset.scale(px) + there.scale(ux),
            y + offset.scale(py) + there.scale(uy),
            z + offset.scale(pz) + there.scale(uz),
        ]);
        Self {
            inertia: turned.turned_to_parent(at),
            momentum: p + step.scale(m),
            product,
            wrench: self.wrench.to_parent(at),
        }
    }
}

impl<Scalar: Real> core::ops::Add for Composite<Scalar> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn add(self, o: Self) -> Self {
        Self {
            inertia: self.inertia + o.inertia,
            momentum: self.momentum + o.momentum,
            product: self.product + o.product,
            wrench: self.wrench + o.wrench,
        }
    }
}

impl<Scalar: Real> Felt<Scalar> {
    #[cfg_attr(optimised, inline(always))]
    fn of(&self, change: &Change<Scalar>) -> Folded<Scalar> {
        let half = self.rate.dot(change.omega);
        self.unit.f.dot(change.accel) + self.unit.n.dot(change.beta) + half + half
    }

    /// The same in the frame of joint I's parent, at whose origin the change is then.
    #[cfg_attr(optimised, inline(always))]
    fn to_parent<Tree: Compiled, const I: usize>(
        self,
        at: &Displacement<Scalar, Tree, I>,
        step: Vec3<Scalar>,
    ) -> Self {
        let unit = self.unit.to_parent(at);
        let rate = rotate_to_parent::<Scalar, Tree, I>(at.leave(self.rate));
        Self { unit, rate: rate + step.cross(unit.f) }
    }
}
