//! The rows and columns of planar, spherical and free joints.
//!
//! The joint's twist (ω_J, v_J) and its rate are along the axes of the body, and so is a small motion
//! of the joint: both keep their components while the body moves. The motion of the parent does not:
//! ω_λ, the parent's field U_λ, and the acceleration A of the parent's point at the body's origin
//! have other components along the turned axes, and other values at the shifted origin. A free base
//! on a base at rest has gravity alone in A, and zeros for the rest.
//!
//! ```text
//! ω = ω_λ + ω_J                                            a = A + v̇_J + (ω_λ + ω) × v_J
//! ∂/∂θ_k: δω = ω_λ × e_k, δa = A × e_k + 2 δω × v_J, β = U_λ e_k        ∂/∂p_k: δa = U_λ e_k
//! ∂/∂ω_k: δω = e_k, δa = e_k × v_J, β = (ω_λ + ω) × e_k    ∂/∂v_k: δa = (ω_λ + ω) × e_k
//! ```

use glam::DVec3;

use super::composite::{Composite, Felt, subspace};
use super::{Change, Task};
use crate::algorithms::TorqueGradient;
use crate::effects::{Declared, Effect, TorqueDerivatives};
use crate::engine::acceleration_field::{AccelerationField, Wrench};
use crate::engine::compile::{Compiled, CompiledJoint, Joint, JointMotion, JointPair};
use crate::engine::displacement::Displacement;
use crate::engine::folding::{Folded, Mat3, Vec3};
use crate::engine::joint_rates::{SeveralRates, Twist};
use crate::model::BASE;
use crate::scalar::Real;

/// The vectors of [`ChangeTerms`], in memory.
#[derive(Clone, Copy, Default)]
pub(super) struct StoredTerms<R>([[R; 3]; 5]);

/// The quantities of which the changes by a joint are made, along the axes of its body.
struct ChangeTerms<R> {
    /// A.
    accel: Vec3<R>,
    /// α_λ and ω_λ.
    alpha: Vec3<R>,
    omega: Vec3<R>,
    /// ω_λ + ω.
    both: Vec3<R>,
    /// v_J.
    v: Vec3<R>,
}

impl<R: Real> ChangeTerms<R> {
    /// U_λ x.
    #[cfg_attr(optimised, inline(always))]
    fn field(&self, x: Vec3<R>) -> Vec3<R> {
        self.alpha.cross(x) + self.omega.cross(self.omega.cross(x))
    }

    /// The wrenches by which the position and the rate of a coordinate are felt.
    #[cfg_attr(optimised, inline(always))]
    fn wrenches(&self, all: &Composite<R>, joint: &Joint) -> [Wrench<R>; 2] {
        let Twist { ang, lin } = subspace(joint);
        let omega = self.omega.cross(ang);
        let swung = omega.cross(self.v);
        let accel = self.accel.cross(ang) + swung + swung + self.field(lin);
        let by_position = Change { omega, accel, beta: self.field(ang) };
        let accel = ang.cross(self.v) + self.both.cross(lin);
        let by_rate = Change { omega: ang, accel, beta: self.both.cross(ang) };
        [all.wrench_by(&by_position), all.wrench_by(&by_rate)]
    }
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Task<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    /// The field behind a joint, of which I is the first coordinate.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn across_several<const I: usize>(
        &mut self,
        parent: &AccelerationField<R>,
        at: &Displacement<R, T, I>,
    ) -> AccelerationField<R> {
        let joint = CompiledJoint::<T, I>::JOINT;
        let products = self.velocity::<I>();
        let accel = Twist::of::<T, V, I>(&self.state.qdd, E::ACCELERATIONS);
        let rates = SeveralRates { velocity: Twist::ZERO, products, accel };
        let field = parent.across_several(at, &rates);
        let (rot, p) = (Mat3::constant(&joint.rot), Vec3::constant(joint.pos) + at.shift());
        let omega = at.enter(&rot, parent.omega_products);
        let numbers = |v: Vec3<R>| v.0.map(Folded::get);
        self.carried[I] = StoredTerms([
            numbers(at.enter(&rot, parent.a + parent.u.mul(p))),
            numbers(at.enter(&rot, parent.alpha)),
            numbers(omega),
            numbers(omega + field.omega_products),
            numbers(products.lin),
        ]);
        field
    }

    /// The motion that carries the joint of this first coordinate, from memory.
    #[cfg_attr(optimised, inline(always))]
    fn carried(&self, first: &Joint) -> ChangeTerms<R> {
        let moves = Self::moves(first);
        let load = |needed: bool, v: [R; 3]| Vec3(v.map(|x| Folded::runtime_if(needed, x)));
        let StoredTerms([accel, alpha, omega, both, v]) = self.carried[first.first];
        ChangeTerms {
            accel: load(true, accel),
            alpha: load(moves, alpha),
            omega: load(moves && E::VELOCITY_PRODUCTS, omega),
            both: load(E::VELOCITY_PRODUCTS, both),
            v: load(E::VELOCITY_PRODUCTS, v),
        }
    }

    /// Whether the parent of a joint may move.
    #[cfg_attr(optimised, inline(always))]
    fn moves(first: &Joint) -> bool {
        first.parent != BASE || E::BASE_MOTION
    }

    /// The entries of the coordinates of joint I with each other and with its ancestors.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn pair_up_several<const I: usize>(
        &mut self,
        all: &Composite<R>,
        at: &Displacement<R, T, I>,
    ) {
        self.pair_up_axis::<I>(all, I);
        self.pair_up_axis::<I>(all, I + 1);
        self.pair_up_axis::<I>(all, I + 2);
        for_each_joint!(K, {
            if JointPair::<T, I, K>::IS_COORDINATE {
                let joint = CompiledJoint::<T, K>::JOINT;
                let mut own = TorqueDerivatives::default();
                self.call.effects.slopes(K, self.call.joint_state::<K>(self.state), &mut own);
                self.gradient.dqd[K][K] += own.dqd;
                if own.dq != R::ZERO && joint.prismatic {
                    // A position is along an axis of the joint's frame, its change along the body's.
                    let along = K - joint.axis;
                    for (j, e) in [DVec3::X, DVec3::Y, DVec3::Z].into_iter().enumerate() {
                        if along + j < I + joint.count {
                            let slope = at.leave(Vec3::constant(e)).along_axis(joint.axis).get();
                            self.gradient.dq[K][along + j] += own.dq * slope;
                        }
                    }
                } else if joint.position.is_some() && !joint.prismatic {
                    self.gradient.dq[K][K] += own.dq;
                }
            }
        });
    }

    /// The columns of coordinate `c` of joint I, and of a free joint's translation along its axis,
    /// which has products in common with it: in the joint's rows, and with the ancestors.
    #[cfg_attr(optimised, inline(always))]
    fn pair_up_axis<const I: usize>(&mut self, all: &Composite<R>, c: usize) {
        let first = CompiledJoint::<T, I>::JOINT;
        let (length_inv, one) = (Folded::constant(T::LENGTH_INV), Folded::constant(1.0));
        let unit = if T::JOINTS[c].prismatic { length_inv } else { one };
        let carried = self.carried(first);
        let by_turn = carried.wrenches(all, &T::JOINTS[c]);
        if first.count > 3 {
            let by_shift = carried.wrenches(all, &T::JOINTS[c + 3]);
            self.write_column(first, c, &by_turn, unit);
            self.write_column(first, c + 3, &by_shift, length_inv);
            self.pair_up_inward::<I>(all, c + 3, by_shift, length_inv);
        } else {
            self.write_column(first, c, &by_turn, unit);
        }
        self.pair_up_inward::<I>(all, c, by_turn, unit);
    }

    /// The entries of coordinate `c` with an ancestor's joint of this first coordinate: wrenches and
    /// coefficients are in its frame, `unit` is that of the coordinate's position, `scale` that of
    /// its torque.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn pair_up_with_several(
        &mut self,
        first: &Joint,
        c: usize,
        wrenches: &[Wrench<R>; 2],
        felt: &Felt<R>,
        [unit, scale]: [Folded<R>; 2],
    ) {
        self.write_column(first, c, wrenches, unit);
        let ChangeTerms { accel, alpha, omega, both, v } = self.carried(first);
        let Wrench { f, n } = felt.unit;
        let along = scale * Folded::constant(T::LENGTH_INV);
        let swung = v.cross(f);
        let by_spin = n.cross(omega) + swung + swung + felt.rate + felt.rate;
        let by_turn = f.cross(accel) + n.cross(alpha) + by_spin.cross(omega);
        let by_shift = f.cross(alpha) + f.cross(omega).cross(omega);
        let by_rate = (swung + n.cross(both) + felt.rate + felt.rate).scale(scale);
        let by_q = spread(first.motion, by_turn.scale(scale), by_shift.scale(along));
        let by_qd = spread(first.motion, by_rate, f.cross(both).scale(along));
        let (row, rates) = (&mut self.gradient.dq[c], &mut self.gradient.dqd[c]);
        // A translation of a free base on a base at rest changes nothing.
        write(row, first.first, if Self::moves(first) { first.count } else { 3 }, by_q);
        write(rates, first.first, first.count, by_qd);
    }

    /// The rows of the joint of this first coordinate in a column.
    #[cfg_attr(optimised, inline(always))]
    fn write_column(
        &mut self,
        first: &Joint,
        column: usize,
        [by_q, by_qd]: &[Wrench<R>; 2],
        unit: Folded<R>,
    ) {
        let along = unit * Folded::constant(T::LENGTH_INV);
        let TorqueGradient { dq, dqd } = &mut *self.gradient;
        for (rows, by) in [(dq, by_q), (dqd, by_qd)] {
            let by = spread(first.motion, by.n.scale(unit), by.f.scale(along));
            let i = first.first;
            rows[i][column] = by[0].get();
            rows[i + 1][column] = by[1].get();
            rows[i + 2][column] = by[2].get();
            if first.count > 3 {
                rows[i + 3][column] = by[3].get();
                rows[i + 4][column] = by[4].get();
                rows[i + 5][column] = by[5].get();
            }
        }
    }
}

/// The coordinates of a joint, rotations first.
#[cfg_attr(optimised, inline(always))]
fn spread<R: Real>(
    motion: JointMotion,
    Vec3([a, b, c]): Vec3<R>,
    Vec3([x, y, z]): Vec3<R>,
) -> [Folded<R>; 6] {
    let zero = Folded::ZERO;
    if matches!(motion, JointMotion::Planar) {
        [c, x, y, zero, zero, zero]
    } else {
        [a, b, c, x, y, z]
    }
}

/// Three or six entries of a row.
#[cfg_attr(optimised, inline(always))]
fn write<R: Real, const V: usize>(
    row: &mut [R; V],
    first: usize,
    count: usize,
    by: [Folded<R>; 6],
) {
    row[first] = by[0].get();
    row[first + 1] = by[1].get();
    row[first + 2] = by[2].get();
    if count > 3 {
        row[first + 3] = by[3].get();
        row[first + 4] = by[4].get();
        row[first + 5] = by[5].get();
    }
}
