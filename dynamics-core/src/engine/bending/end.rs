//! The end of a link that bends: its field, on which the children stand, and the load of these on
//! the modes.
//!
//! The end is displaced by Σ φₖ ηₖ and rotated by the Rodrigues parameters g = ½ Σ ψₖ ηₖ, as in the
//! module `flexible`.

use super::for_each_mode;
use super::motion::Mode;
use super::table::{BendingBody, Bends, HasMode, MODES};
use crate::engine::acceleration_field::{AccelerationField, Wrench, u_of};
use crate::engine::folding::{Folded, Mat3, Vec3};
use crate::scalar::Real;

/// The acceleration field that a joint stands on: that of the body before it, or of the end of a
/// link that bends.
#[derive(Clone, Copy)]
pub(super) struct Stand<R> {
    pub(super) field: AccelerationField<R>,
    /// An angle that adds to that of the joint: its cosine, and its sine along its axis.
    pub(super) sin: Vec3<R>,
    pub(super) cos: Folded<R>,
}

impl<R: Real> Stand<R> {
    /// A body that does not bend, or the base.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn rigid(field: AccelerationField<R>) -> Self {
        Self { field, sin: Vec3::ZERO, cos: Folded::ONE }
    }
}

/// The end of a link, in the link's axes.
#[derive(Clone, Copy)]
pub(super) struct End<R> {
    /// The place.
    point: Vec3<R>,
    g: Vec3<R>,
    /// 2 / (1 + g²)
    scale: Folded<R>,
}

/// φₖ and ½ ψₖ, times the coordinates or their rates.
#[derive(Clone, Copy)]
struct Sum<R> {
    shift: Vec3<R>,
    g: Vec3<R>,
}

impl<R: Real> Sum<R> {
    const ZERO: Self = Self { shift: Vec3::ZERO, g: Vec3::ZERO };

    #[cfg_attr(optimised, inline(always))]
    fn plus(self, shift: Vec3<R>, half_turn: Vec3<R>, rate: Folded<R>) -> Self {
        Self { shift: self.shift + shift.scale(rate), g: self.g + half_turn.scale(rate) }
    }
}

impl<R: Real> End<R> {
    /// The end of the body of joint I, whose field is `field`, and its own, in the link's axes.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn of<T: Bends, const I: usize, const MOVES: bool>(
        field: &AccelerationField<R>,
        bent: &[Mode<R>; MODES],
    ) -> (Self, AccelerationField<R>) {
        let [mut bend, mut velocity, mut products, mut accel] = [Sum::ZERO; 4];
        for_each_mode!(K, {
            if HasMode::<T, I, K>::IS {
                let (mode, of) = (const { &BendingBody::<T, I, MOVES>::LINK.modes[K] }, bent[K]);
                let (shift, turn) = (Vec3::constant(mode.shift), Vec3::constant(mode.half_turn));
                bend = bend.plus(shift, turn, of.eta);
                velocity = velocity.plus(shift, turn, of.velocity);
                products = products.plus(shift, turn, of.products);
                accel = accel.plus(shift, turn, of.accel);
            }
        });
        let mut scale = Folded::constant(2.0);
        if BendingBody::<T, I, MOVES>::TURNS {
            let square = bend.g.dot(bend.g).get();
            scale = Folded::runtime(R::from_f64(2.0) / (R::ONE + square));
        }
        let end = Self {
            point: Vec3::constant(BendingBody::<T, I, MOVES>::LINK.end) + bend.shift,
            g: bend.g,
            scale,
        };
        (end, end.moved(field, velocity, products, accel))
    }

    /// The field that the joints on the end stand on; `along` is the field of the end in the link's
    /// axes.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn stand<T: Bends, const I: usize, const MOVES: bool>(
        &self,
        along: &AccelerationField<R>,
    ) -> Stand<R> {
        if !BendingBody::<T, I, MOVES>::ADDS_TO_ANGLES {
            return Stand::rigid(self.turned::<T, I, MOVES>(along));
        }
        let mut stand = Stand::rigid(*along);
        if BendingBody::<T, I, MOVES>::TURNS {
            stand.sin = self.g.scale(self.scale);
            stand.cos = self.scale - Folded::ONE;
        }
        stand
    }

    /// The field of the end, in the link's axes.
    #[cfg_attr(optimised, inline(always))]
    fn moved(
        &self,
        field: &AccelerationField<R>,
        velocity: Sum<R>,
        products: Sum<R>,
        accel: Sum<R>,
    ) -> AccelerationField<R> {
        let omega = field.omega_products;
        let spin = self.omega(products.g);
        let slowing = spin.scale(self.scale * self.g.dot(products.g));
        let alpha = field.alpha + (self.omega(accel.g) - slowing) + omega.cross(spin);
        let turning = omega + spin;
        AccelerationField {
            omega: field.omega + self.omega(velocity.g),
            omega_products: turning,
            alpha,
            u: u_of(alpha, turning),
            a: field.a
                + field.u.mul(self.point)
                + (omega + omega).cross(products.shift)
                + accel.shift,
            v: field.v + field.omega.cross(self.point) + velocity.shift,
            pose: field.pose.moved(self.point),
        }
    }

    /// The same in the axes of the end.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn turned<T: Bends, const I: usize, const MOVES: bool>(
        &self,
        field: &AccelerationField<R>,
    ) -> AccelerationField<R> {
        if !BendingBody::<T, I, MOVES>::TURNS {
            return *field;
        }
        let axes = self.axes();
        let (alpha, omega) = (axes.mul(field.alpha), axes.mul(field.omega_products));
        AccelerationField {
            omega: axes.mul(field.omega),
            omega_products: omega,
            alpha,
            u: u_of(alpha, omega),
            a: axes.mul(field.a),
            v: axes.mul(field.v),
            pose: field.pose.turned(&axes),
        }
    }

    /// From the link's axes to the end's: (1 − g²)/(1 + g²) 1 + 2/(1 + g²) (g gᵀ − g×).
    #[cfg_attr(optimised, inline(always))]
    fn axes(&self) -> Mat3<R> {
        let ([x, y, z], [dx, dy, dz]) = (self.g.0, self.g.scale(self.scale).0);
        let diagonal = self.scale - Folded::ONE;
        Mat3([
            Vec3([diagonal + x * dx, x * dy - dz, x * dz + dy]),
            Vec3([y * dx + dz, diagonal + y * dy, y * dz - dx]),
            Vec3([z * dx - dy, z * dy + dx, diagonal + z * dz]),
        ])
    }

    /// The angular velocity of ġ.
    #[cfg_attr(optimised, inline(always))]
    fn omega(&self, g_dot: Vec3<R>) -> Vec3<R> {
        (g_dot + self.g.cross(g_dot)).scale(self.scale)
    }

    /// A wrench about the end in the link's axes, from those of the end.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn turned_back<T: Bends, const I: usize, const MOVES: bool>(
        &self,
        load: Wrench<R>,
    ) -> Wrench<R> {
        if !BendingBody::<T, I, MOVES>::TURNS {
            return load;
        }
        let axes = self.axes();
        Wrench { f: axes.transpose_mul(load.f), n: axes.transpose_mul(load.n) }
    }

    /// Adds the work of a wrench about the end, in the link's axes, to the forces on the modes;
    /// returns it about the link's joint.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn carry<T: Bends, const I: usize, const MOVES: bool>(
        &self,
        load: Wrench<R>,
        forces: &mut [Folded<R>; MODES],
    ) -> Wrench<R> {
        let couple = (load.n - self.g.cross(load.n)).scale(self.scale);
        for_each_mode!(K, {
            if HasMode::<T, I, K>::IS {
                let mode = const { &BendingBody::<T, I, MOVES>::LINK.modes[K] };
                forces[K] = forces[K]
                    + Vec3::constant(mode.shift).dot(load.f)
                    + Vec3::constant(mode.half_turn).dot(couple);
            }
        });
        Wrench { f: load.f, n: load.n + self.point.cross(load.f) }
    }
}
