//! The forces of one link with modes: on its body, and on the modes.

use core::ops::Range;

use super::Modes;
use super::deformation::{End, Moments, axial, trace};
use crate::effects::{Effect, base_motion};
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::{Force, Motion, SpatialInertia, Xform};
use crate::state::{State, entry};

/// The motion of a body, or of the end of one with modes: what the bodies on it start from.
#[derive(Clone, Copy)]
pub(super) struct Outer<R: Real> {
    pub(super) v: Motion<R>,
    pub(super) a: Motion<R>,
    pub(super) pose: Xform<R>,
}

impl<R: Real> Outer<R> {
    /// That of the base, with a₀ = −g.
    #[inline(always)]
    pub(super) fn base<E, const B: usize, const V: usize>(effects: &E) -> Self
    where
        E: Effect<R, B, V>,
    {
        let (v, a) = base_motion(effects);
        Self {
            v,
            a,
            pose: Xform::IDENTITY,
        }
    }

    /// The same motion in another frame.
    #[inline(always)]
    pub(super) fn moved<E, const B: usize, const V: usize>(&self, _: &E, x: &Xform<R>) -> Self
    where
        E: Effect<R, B, V>,
    {
        let (mut v, mut pose) = (Motion::ZERO, Xform::IDENTITY);
        if const { E::VELOCITY_PRODUCTS | E::BODY_VELOCITY } {
            v = *x * self.v;
        }
        if E::BODY_POSE {
            pose = *x * self.pose;
        }
        Self {
            v,
            a: *x * self.a,
            pose,
        }
    }

    /// I a + v ×* I v, as far as the effects have it.
    #[inline(always)]
    pub(super) fn net_force<E, const B: usize, const V: usize>(
        &self,
        _: &E,
        inertia: &SpatialInertia<R>,
    ) -> Force<R>
    where
        E: Effect<R, B, V>,
    {
        if E::VELOCITY_PRODUCTS {
            inertia.force(self.a, self.v)
        } else {
            *inertia * self.a
        }
    }
}

/// A link with modes at one state.
pub(super) struct Deformed<'a, R: Real, const M: usize> {
    pub(super) modes: &'a Modes<R, M>,
    pub(super) range: Range<usize>,
    pub(super) moments: Moments<R, M>,
    pub(super) bent: &'a State<R, M, M>,
}

impl<R: Real, const M: usize> Deformed<'_, R, M> {
    /// The force that accelerates the link, and those that accelerate its modes: ∫ a dm, ∫ r × a dm and ∫ φₖ·a dm of
    /// a = p̈ + α × r + ω × (ω × r) + 2 ω × φ η̇ + φ η̈.
    #[inline(always)]
    pub(super) fn net_force<E, const B: usize, const V: usize>(
        &self,
        effects: &E,
        rigid: &SpatialInertia<R>,
        at: &Outer<R>,
        of_modes: &mut [R; M],
    ) -> Force<R>
    where
        E: Effect<R, B, V>,
    {
        let Self {
            modes,
            range,
            moments,
            bent,
        } = self;
        let inertia = moments.inertia(modes, range, *rigid, &bent.q);
        let mut f = at.net_force(effects, &inertia);
        if E::ACCELERATIONS {
            let (sum, momentum) = moments.sum(modes, range, &bent.qdd);
            f += Force::new(axial::<R>(&sum), momentum);
        }
        let (omega, two) = (at.v.ang, R::from_f64(2.0));
        if E::VELOCITY_PRODUCTS {
            // r × (ω × u̇) = ω r·u̇ − u̇ r·ω
            let (sum, momentum) = moments.sum(modes, range, &bent.qd);
            let ang = omega * trace::<R>(&sum) - sum * omega;
            f += Force::new(ang, omega.cross(momentum)) * two;
        }
        let mut point = at.a.lin;
        if E::VELOCITY_PRODUCTS {
            point += omega.cross(at.v.lin);
        }
        for k in range.clone() {
            let momentum = moments.momentum(modes, k);
            let mut force = momentum.lin.dot(point) + momentum.ang.dot(at.a.ang);
            if E::VELOCITY_PRODUCTS {
                force += self.velocity_force(k, omega);
            }
            if E::ACCELERATIONS {
                for l in range.clone() {
                    force += modes.inertia(k, l) * entry(&bent.qdd, l);
                }
            }
            if let Some(of_mode) = of_modes.get_mut(k) {
                *of_mode += force;
            }
        }
        f
    }

    /// ∫ φₖ·(ω × (ω × r) + 2 ω × u̇) dm.
    #[inline(always)]
    fn velocity_force(&self, k: usize, omega: R::Vec3) -> R {
        let (Some(moments), Some(products)) =
            (self.moments.each.get(k), self.modes.products.get(k))
        else {
            return R::ZERO;
        };
        let centripetal = omega.dot(*moments * omega) - omega.dot(omega) * trace::<R>(moments);
        let mut rates = R::Mat3::ZERO;
        for l in self.range.clone() {
            if let Some(&product) = products.get(l) {
                rates += product * entry(&self.bent.qd, l);
            }
        }
        centripetal + omega.dot(axial::<R>(&rates)) * R::from_f64(2.0)
    }

    /// The end, and its motion.
    #[inline(always)]
    pub(super) fn end<E, const B: usize, const V: usize>(
        &self,
        effects: &E,
        at: &Outer<R>,
    ) -> (Outer<R>, End<R>)
    where
        E: Effect<R, B, V>,
    {
        let Self {
            modes, range, bent, ..
        } = self;
        let end = End::of(modes, range, &bent.q);
        let mut on_end = at.moved(effects, &end.x);
        if const { E::VELOCITY_PRODUCTS | E::BODY_VELOCITY } {
            let velocity = end.velocity(modes, range, &bent.qd);
            on_end.v += velocity.motion;
            if E::VELOCITY_PRODUCTS {
                on_end.a += end.velocity_product(&velocity) + on_end.v.cross(velocity.motion);
            }
        }
        if E::ACCELERATIONS {
            on_end.a += end.velocity(modes, range, &bent.qdd).motion;
        }
        (on_end, end)
    }
}

/// Adds what a load on the end of a link does to its modes.
#[inline(always)]
pub(super) fn add_load<R: Real, const M: usize>(
    modes: &Modes<R, M>,
    range: &Range<usize>,
    load: Force<R>,
    of_modes: &mut [R; M],
) {
    for k in range.clone() {
        if let (Some(mode), Some(of_mode)) = (modes.each.get(k), of_modes.get_mut(k)) {
            *of_mode += mode.turn.dot(load.ang) + mode.shift.dot(load.lin);
        }
    }
}

/// Adds K η + D η̇.
#[inline(always)]
pub(super) fn elasticity<R: Real, const M: usize>(
    modes: &Modes<R, M>,
    bent: &State<R, M, M>,
    of_modes: &mut [R; M],
) {
    let rows = modes.stiffness.iter().zip(&modes.damping);
    for ((stiffness, damping), of_mode) in rows.zip(of_modes) {
        let terms = stiffness
            .iter()
            .zip(&bent.q)
            .chain(damping.iter().zip(&bent.qd));
        *of_mode = terms.fold(*of_mode, |sum, (&a, &x)| sum + a * x);
    }
}
