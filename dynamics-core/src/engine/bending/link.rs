//! The wrench of a link that is bent, and the forces on its modes.
//!
//! The acceleration of a point is a(r) = a + U r + 2 ω × φ η̇ + φ η̈ with r = r₀ + Σ φₖ ηₖ, so that
//! with Φₖ = ∫ φₖ rᵀ dm
//!
//! f = m a + U h + 2 ω × Σ ∫φₖ dm η̇ₖ + Σ ∫φₖ dm η̈ₖ,
//! n = h × a + axial(U Σ − Σ Uᵀ) + Σ (tr Φₖ − Φₖ) 2 ω η̇ₖ + Σ axial(Φₖ) η̈ₖ,
//! Qₖ = ∫φₖ dm · a + U : Φₖ + Σ (2 ω · axial ∫φₖ φₗᵀ dm η̇ₗ + ∫φₖ·φₗ dm η̈ₗ) + K η + D η̇.

use super::for_each_mode;
use super::motion::Mode;
use super::table::{BendingBody, Bends, HasMode, MODES, axial, trace};
use crate::engine::acceleration_field::{AccelerationField, Inertia, Wrench};
use crate::engine::folding::{Folded, Mat3, Sym3, Vec3};
use crate::scalar::Real;

/// The wrench that accelerates the body of joint I, bent, and what its modes need; with stiffness
/// and damping, if the scene has these.
#[cfg_attr(optimised, inline(always))]
pub(super) fn bent_wrench<R, T, const I: usize, const MOVES: bool>(
    field: &AccelerationField<R>,
    rigid: Inertia<R>,
    bent: &[Mode<R>; MODES],
    elastic: bool,
    forces: &mut [Folded<R>; MODES],
) -> Wrench<R>
where
    R: Real,
    T: Bends,
{
    let twice = field.omega_products + field.omega_products;
    let mut body = rigid;
    // Σ ∫φ dm η̇, Σ ∫φ dm η̈, Σ Φ η̇, Σ tr Φ η̇ and Σ axial(Φ) η̈.
    let (mut drift, mut push) = (Vec3::ZERO, Vec3::ZERO);
    let (mut drifts, mut drift_trace, mut couple) = (Mat3::ZERO, Folded::ZERO, Vec3::ZERO);
    for_each_mode!(K, {
        if HasMode::<T, I, K>::IS {
            let mode = const { &BendingBody::<T, I, MOVES>::LINK.modes[K] };
            let (momentum, own) = (Vec3::constant(mode.momentum), bent[K]);
            let rest = Mat3::constant(&mode.moments);
            let (mut moments, mut force) = (rest, momentum.dot(field.a));
            let mut swing =
                Vec3::constant(const { axial(&BendingBody::<T, I, MOVES>::LINK.modes[K].moments) });
            let mut spread = Folded::constant(
                const { trace(&BendingBody::<T, I, MOVES>::LINK.modes[K].moments) },
            );
            for_each_mode!(L, {
                if HasMode::<T, I, L>::IS {
                    let (other, product) = (bent[L], Mat3::constant(&mode.products[L]));
                    let across = Vec3::constant(
                        const { axial(&BendingBody::<T, I, MOVES>::LINK.modes[K].products[L]) },
                    );
                    let along =
                        const { trace(&BendingBody::<T, I, MOVES>::LINK.modes[K].products[L]) };
                    moments = moments + scaled(product, other.eta);
                    swing = swing + across.scale(other.eta);
                    spread = spread + Folded::constant(along) * other.eta;
                    force = force + Folded::constant(mode.masses[L]) * other.accel;
                    force = force + twice.dot(across) * other.products;
                    if elastic {
                        force = force + Folded::constant(mode.stiffness[L]) * other.eta;
                        force = force + Folded::constant(mode.damping[L]) * other.damped;
                    }
                }
            });
            forces[K] = force + contracted(&field.u, &moments);
            body.moment = body.moment + momentum.scale(own.eta);
            let both = moments + Mat3(rest.rows());
            body.second = body.second + Sym3::of(&scaled(both, own.eta));
            drift = drift + momentum.scale(own.products);
            push = push + momentum.scale(own.accel);
            drifts = drifts + scaled(moments, own.products);
            drift_trace = drift_trace + spread * own.products;
            couple = couple + swing.scale(own.accel);
        }
    });
    let relative = Wrench {
        f: twice.cross(drift) + push,
        n: twice.scale(drift_trace) - drifts.mul(twice) + couple,
    };
    field.wrench(&body) + relative
}

#[cfg_attr(optimised, inline(always))]
fn scaled<R: Real>(Mat3([x, y, z]): Mat3<R>, s: Folded<R>) -> Mat3<R> {
    Mat3([x.scale(s), y.scale(s), z.scale(s)])
}

/// A : B, the sum of the products of their entries.
#[cfg_attr(optimised, inline(always))]
fn contracted<R: Real>(a: &Mat3<R>, b: &Mat3<R>) -> Folded<R> {
    a.0[0].dot(b.0[0]) + a.0[1].dot(b.0[1]) + a.0[2].dot(b.0[2])
}
