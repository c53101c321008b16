//! The rows and columns of a free base.
//!
//! The twist (ω, v) and its rate are along the axes of the base, and a small motion of it is one along
//! the same axes, so that ω and v stay as they are while the base moves: only gravity turns.
//!
//! ```text
//! a = E a₀ + v̇ + ω × v      ∂/∂θ_k: δa = E a₀ × e_k      ∂/∂p_k: 0
//! ∂/∂ω_k: δω = e_k, δa = e_k × v, β = ω × e_k            ∂/∂v_k: δa = ω × e_k
//! ```

use super::{Change, Composite, Felt, Task};
use crate::effects::{Effect, TorqueDerivatives};
use crate::engine::acceleration_field::{AccelerationField, Wrench};
use crate::engine::compile::{Compiled, CompiledJoint, JointPair};
use crate::engine::displacement::Displacement;
use crate::engine::folding::{Folded, Mat3, Vec3};
use crate::engine::joint_rates::{SeveralRates, Twist};
use crate::scalar::Real;

/// What the changes by a free base are made from, along its axes, in memory.
#[derive(Clone, Copy, Default)]
pub(super) struct Floating<Scalar> {
    /// E a₀, the acceleration without that of the base's own motion.
    gravity: [Scalar; 3],
    omega: [Scalar; 3],
    v: [Scalar; 3],
}

impl<Scalar, Tree, Effects, const B: usize, const Q: usize, const V: usize>
    Task<'_, Scalar, Tree, Effects, B, Q, V>
where
    Scalar: Real,
    Tree: Compiled,
    Effects: Effect<Scalar, B, V>,
{
    /// The field of the free base, of which I is the first coordinate.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn float<const I: usize>(
        &mut self,
        parent: &AccelerationField<Scalar>,
        at: &Displacement<Scalar, Tree, I>,
    ) -> AccelerationField<Scalar> {
        let products = Twist::of::<Tree, V, I>(&self.state.qd, Effects::VELOCITY_PRODUCTS);
        let accel = Twist::of::<Tree, V, I>(&self.state.qdd, Effects::ACCELERATIONS);
        let rates = SeveralRates { velocity: Twist::ZERO, products, accel };
        let rot = Mat3::constant(&CompiledJoint::<Tree, I>::JOINT.rot);
        let numbers = |v: Vec3<Scalar>| v.0.map(Folded::get);
        self.base = Floating {
            gravity: numbers(at.enter(&rot, parent.a)),
            omega: numbers(products.ang),
            v: numbers(products.lin),
        };
        parent.across_several(at, &rates)
    }

    /// E a₀, ω and v again.
    #[cfg_attr(optimised, inline(always))]
    fn floating(&self) -> [Vec3<Scalar>; 3] {
        let Floating { gravity, omega, v } = self.base;
        let moves = Effects::VELOCITY_PRODUCTS;
        let [w, v] = [omega, v].map(|x| Vec3(x.map(|x| Folded::runtime_if(moves, x))));
        [Vec3(gravity.map(Folded::runtime)), w, v]
    }

    /// The entries of the six coordinates of the free base with each other.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn pair_up_floating<const I: usize>(
        &mut self,
        all: &Composite<Scalar>,
        at: &Displacement<Scalar, Tree, I>,
    ) {
        let none = Change { omega: Vec3::ZERO, accel: Vec3::ZERO, beta: Vec3::ZERO };
        let (zero, one) = (Folded::ZERO, Folded::constant(1.0));
        let length_inv = Folded::constant(Tree::LENGTH_INV);
        let axes = [[one, zero, zero], [zero, one, zero], [zero, zero, one]].map(Vec3);
        let [gravity, w, v] = self.floating();
        for (k, e) in axes.into_iter().enumerate() {
            let (turned, dragged) = (gravity.cross(e), w.cross(e));
            let by_turn = all.wrench_by(&Change { accel: turned, ..none });
            let by_rate = all.wrench_by(&Change { omega: e, accel: e.cross(v), beta: dragged });
            let by_speed = all.wrench_by(&Change { accel: dragged, ..none });
            self.write_column(I, I + k, &by_turn, &by_rate, one);
            self.write_column(I, I + 3 + k, &Wrench::ZERO, &by_speed, length_inv);
        }
        for_each_joint!(K, {
            if JointPair::<Tree, I, K>::IS_COORDINATE {
                let mut own = TorqueDerivatives::default();
                self.call.effects.slopes(K, self.call.joint_state::<K>(self.state), &mut own);
                self.gradient.dqd[K][K] += own.dqd;
                // A position is along an axis of the frame outside, its change along the body's.
                if own.dq != Scalar::ZERO && CompiledJoint::<Tree, K>::PRISMATIC {
                    for (j, e) in axes.into_iter().enumerate() {
                        let slope = at.leave(e).0[CompiledJoint::<Tree, K>::JOINT.axis].get();
                        self.gradient.dq[K][I + 3 + j] += own.dq * slope;
                    }
                }
            }
        });
    }

    /// The entries of joint I with the free base, of which `first` is the first coordinate: wrenches
    /// and coefficients are in its frame, `unit` is that of the joint's position, `scale` that of its
    /// torque.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn pair_up_with_base<const I: usize>(
        &mut self,
        first: usize,
        [by_q, by_qd]: [Wrench<Scalar>; 2],
        felt: &Felt<Scalar>,
        [unit, scale]: [Folded<Scalar>; 2],
    ) {
        self.write_column(first, I, &by_q, &by_qd, unit);
        let length_inv = Folded::constant(Tree::LENGTH_INV);
        let [gravity, w, v] = self.floating();
        let Wrench { f, n } = felt.unit;
        let turn = f.cross(gravity);
        let rate = v.cross(f) + n.cross(w) + felt.rate + felt.rate;
        let speed = f.cross(w);
        for k in 0..3 {
            self.gradient.dq[I][first + k] = (turn.0[k] * scale).get();
            self.gradient.dqd[I][first + k] = (rate.0[k] * scale).get();
            self.gradient.dqd[I][first + 3 + k] = (speed.0[k] * scale * length_inv).get();
        }
    }

    /// The rows of the free base in a column.
    #[cfg_attr(optimised, inline(always))]
    fn write_column(
        &mut self,
        first: usize,
        column: usize,
        by_q: &Wrench<Scalar>,
        by_qd: &Wrench<Scalar>,
        unit: Folded<Scalar>,
    ) {
        let length_inv = Folded::constant(Tree::LENGTH_INV);
        for k in 0..3 {
            self.gradient.dq[first + k][column] = (by_q.n.0[k] * unit).get();
            self.gradient.dq[first + 3 + k][column] = (by_q.f.0[k] * length_inv * unit).get();
            self.gradient.dqd[first + k][column] = (by_qd.n.0[k] * unit).get();
            self.gradient.dqd[first + 3 + k][column] = (by_qd.f.0[k] * length_inv * unit).get();
        }
    }
}
