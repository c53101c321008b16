//! The forces of one link with modes: on its body, and on the modes.

use core::ops::Range;

use super::Modes;
use super::deformation::{axial, deform, trace};
use super::modes::Integrals;
use crate::effects::{Declared, Effect, base_motion};
use crate::scalar::{Real, Vector};
use crate::spatial::{Force, Motion, SpatialInertia, Xform};
use crate::state::{State, entry};

/// The motion of a body, with which the recursion continues to its children.
#[derive(Clone, Copy)]
pub(super) struct Outer<R: Real> {
    pub(super) v: Motion<R>,
    pub(super) a: Motion<R>,
    pub(super) pose: Xform<R>,
}

impl<R: Real> Outer<R> {
    /// The motion of the base, with a₀ = −g.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn base<E, const B: usize, const V: usize>(effects: &E) -> Self
    where
        E: Effect<R, B, V>,
    {
        let (v, a) = base_motion(effects);
        Self { v, a, pose: Xform::IDENTITY }
    }

    /// The same motion in another frame.
    #[cfg_attr(optimised, inline(always))]
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
        Self { v, a: *x * self.a, pose }
    }

    /// The force I a + v ×* I v that accelerates a body; without `Coriolis` I a.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn net_force<E, const B: usize, const V: usize>(
        &self,
        _: &E,
        inertia: &SpatialInertia<R>,
    ) -> Force<R>
    where
        E: Effect<R, B, V>,
    {
        if E::VELOCITY_PRODUCTS { inertia.force(self.a, self.v) } else { *inertia * self.a }
    }
}

/// The force that accelerates a link with modes, and those that accelerate its modes: ∫ a dm, ∫ r ×
/// a dm and ∫ φₖ·a dm of a = p̈ + α × r + ω × (ω × r) + 2 ω × φ η̇ + φ η̈. The latter are added to
/// `of_modes`, with K η + D η̇.
#[cfg_attr(optimised, inline(always))]
pub(super) fn net_force<R: Real, E, const B: usize, const V: usize, const M: usize>(
    effects: &E,
    (modes, range): (&Modes<R, M>, &Range<usize>),
    rigid: SpatialInertia<R>,
    at: &Outer<R>,
    bent: &State<R, M, M>,
    of_modes: &mut [R; M],
) -> Force<R>
where
    E: Effect<R, B, V>,
{
    let (omega, alpha) = (at.v.ang, at.a.ang);
    let mut point = at.a.lin;
    if E::VELOCITY_PRODUCTS {
        point += omega.cross(at.v.lin);
    }
    let (squared, two) = (omega.dot(omega), R::from_f64(2.0));
    let mut inertia = rigid;
    // ∫ (2 ω × φ η̇ + φ η̈) dm.
    let mut relative = Force::ZERO;
    for k in range.clone() {
        let (Some(mode), Some(products), Some(of_mode)) =
            (modes.each.get(k), modes.products.get(k), of_modes.get_mut(k))
        else {
            break;
        };
        let (mut moments, mut force) = (mode.moments, mode.momentum.dot(point));
        for l in range.clone() {
            let Some(&product) = products.get(l) else {
                break;
            };
            let [eta, rate, acceleration] = [&bent.q, &bent.qd, &bent.qdd].map(|x| entry(x, l));
            moments += product * eta;
            if E::ACCELERATIONS {
                force += trace::<R>(&product) * acceleration;
            }
            // The integral over the product of mode k with itself is symmetric: its axial vector is
            // zero.
            if E::VELOCITY_PRODUCTS && l != k {
                force += omega.dot(axial::<R>(&product)) * (rate * two);
            }
            if E::ELASTICITY {
                force += modes.elasticity(k, l, [eta, rate]);
            }
        }
        deform::<R>(&mut inertia, mode, moments, entry(&bent.q, k));
        let swing = axial::<R>(&moments);
        force += swing.dot(alpha);
        if E::VELOCITY_PRODUCTS {
            // r × (ω × u) = ω r·u − u r·ω
            let (turned, trace) = (moments * omega, trace::<R>(&moments));
            let twice = entry(&bent.qd, k) * two;
            let momentum = omega.cross(mode.momentum);
            relative += Force::new(omega * trace - turned, momentum) * twice;
            force += omega.dot(turned) - squared * trace;
        }
        if E::ACCELERATIONS {
            relative += Force::new(swing, mode.momentum) * entry(&bent.qdd, k);
        }
        *of_mode += force;
    }
    at.net_force(effects, &inertia) + relative
}

impl<R: Real, const M: usize> Modes<R, M> {
    /// K η + D η̇ of mode k by mode l.
    #[cfg_attr(optimised, inline(always))]
    fn elasticity(&self, k: usize, l: usize, [eta, rate]: [R; 2]) -> R {
        match (self.stiffness.get(k), self.damping.get(k)) {
            (Some(stiffness), Some(damping)) => {
                entry(stiffness, l) * eta + entry(damping, l) * rate
            }
            _ => R::ZERO,
        }
    }

    /// The force on mode k of a load on the end of its link: see
    /// [`End::load`](super::deformation::End::load).
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn work(&self, k: usize, load: Force<R>) -> R {
        let work = |mode: &Integrals<R>| mode.half_turn.dot(load.ang) + mode.shift.dot(load.lin);
        self.each.get(k).map_or(R::ZERO, work)
    }
}
