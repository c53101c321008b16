//! The rows and columns of a free base.
//!
//! The twist (ω, v) and its rate are along the axes of the base, and a small motion of it is one along
//! the same axes, so that ω and v stay as they are while the base moves: only gravity turns.
//!
//! ```text
//! a = E a₀ + v̇ + ω × v      ∂/∂θ_k: δa = E a₀ × e_k      ∂/∂p_k: 0
//! ∂/∂ω_k: δω = e_k, δa = e_k × v, β = ω × e_k            ∂/∂v_k: δa = ω × e_k
//! ```

use glam::DVec3;

use super::{Change, Composite, Felt, Task};
use crate::algorithms::TorqueGradient;
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
        let (zero, one) = (Folded::ZERO, Folded::constant(1.0));
        self.pair_up_axis::<I>(all, I, Vec3([one, zero, zero]));
        self.pair_up_axis::<I>(all, I + 1, Vec3([zero, one, zero]));
        self.pair_up_axis::<I>(all, I + 2, Vec3([zero, zero, one]));
        for_each_joint!(K, {
            if JointPair::<Tree, I, K>::IS_COORDINATE {
                let mut own = TorqueDerivatives::default();
                self.call.effects.slopes(K, self.call.joint_state::<K>(self.state), &mut own);
                self.gradient.dqd[K][K] += own.dqd;
                // A position is along an axis of the frame outside, its change along the body's.
                if own.dq != Scalar::ZERO && CompiledJoint::<Tree, K>::PRISMATIC {
                    for (j, e) in [DVec3::X, DVec3::Y, DVec3::Z].into_iter().enumerate() {
                        let along = at.leave(Vec3::constant(e));
                        let slope = along.along_axis(CompiledJoint::<Tree, K>::JOINT.axis).get();
                        self.gradient.dq[K][I + 3 + j] += own.dq * slope;
                    }
                }
            }
        });
    }

    /// The columns of the rotation about an axis, which is coordinate `at`, and of the translation
    /// along it.
    #[cfg_attr(optimised, inline(always))]
    fn pair_up_axis<const I: usize>(
        &mut self,
        all: &Composite<Scalar>,
        at: usize,
        e: Vec3<Scalar>,
    ) {
        let length_inv = Folded::constant(Tree::LENGTH_INV);
        let [gravity, w, v] = self.floating();
        let dragged = w.cross(e);
        let by_turn = all.wrench_by(&Change::shift(gravity.cross(e)));
        let by_rate = all.wrench_by(&Change { omega: e, accel: e.cross(v), beta: dragged });
        let by_speed = all.wrench_by(&Change::shift(dragged));
        self.write_column(I, at, [&by_turn, &by_rate], Folded::constant(1.0));
        self.write_column(I, at + 3, [&Wrench::ZERO, &by_speed], length_inv);
    }

    /// The entries of joint I with the free base, of which `first` is the first coordinate: wrenches
    /// and coefficients are in its frame, `unit` is that of the joint's position, `scale` that of its
    /// torque.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn pair_up_with_base<const I: usize>(
        &mut self,
        first: usize,
        wrenches: [&Wrench<Scalar>; 2],
        felt: &Felt<Scalar>,
        [unit, scale]: [Folded<Scalar>; 2],
    ) {
        self.write_column(first, I, wrenches, unit);
        let [gravity, w, v] = self.floating();
        let Wrench { f, n } = felt.unit;
        let by_turn = f.cross(gravity).scale(scale);
        let by_rate = (v.cross(f) + n.cross(w) + felt.rate + felt.rate).scale(scale);
        let by_speed = f.cross(w).scale(scale * Folded::constant(Tree::LENGTH_INV));
        write(&mut self.gradient.dq[I], first, by_turn);
        write(&mut self.gradient.dqd[I], first, by_rate);
        write(&mut self.gradient.dqd[I], first + 3, by_speed);
    }

    /// The rows of the free base in a column.
    #[cfg_attr(optimised, inline(always))]
    fn write_column(
        &mut self,
        first: usize,
        column: usize,
        [by_q, by_qd]: [&Wrench<Scalar>; 2],
        unit: Folded<Scalar>,
    ) {
        let along = unit * Folded::constant(Tree::LENGTH_INV);
        let TorqueGradient { dq, dqd } = &mut *self.gradient;
        for (rows, by) in [(dq, by_q), (dqd, by_qd)] {
            let (Vec3([nx, ny, nz]), Vec3([fx, fy, fz])) = (by.n.scale(unit), by.f.scale(along));
            rows[first][column] = nx.get();
            rows[first + 1][column] = ny.get();
            rows[first + 2][column] = nz.get();
            rows[first + 3][column] = fx.get();
            rows[first + 4][column] = fy.get();
            rows[first + 5][column] = fz.get();
        }
    }
}

/// Three entries of a row.
#[cfg_attr(optimised, inline(always))]
fn write<Scalar: Real, const V: usize>(
    row: &mut [Scalar; V],
    first: usize,
    Vec3([x, y, z]): Vec3<Scalar>,
) {
    row[first] = x.get();
    row[first + 1] = y.get();
    row[first + 2] = z.get();
}
