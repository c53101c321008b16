//! The motion along which inverse dynamics is computed: that of a state, or the unit acceleration
//! of one coordinate.

use core::marker::PhantomData;

use super::table::MODES;
use crate::effects::{Declared, Effect};
use crate::engine::folding::Folded;
use crate::engine::joint_rates::JointRates;
use crate::scalar::Real;
use crate::state::State;

/// The motion of joints and modes; what an algorithm does not need is a known zero.
pub(crate) trait Moves<R: Real> {
    /// Whether effects act, and not the inertia alone.
    const ALL: bool;

    fn joint(&self, i: usize) -> JointRates<R>;

    fn mode(&self, k: usize) -> Mode<R>;
}

/// The coordinate of a mode and its rates.
#[derive(Clone, Copy)]
pub(crate) struct Mode<R> {
    pub(crate) eta: Folded<R>,
    /// The rate that damping acts on.
    pub(crate) damped: Folded<R>,
    pub(crate) velocity: Folded<R>,
    /// The velocity in the velocity products.
    pub(crate) products: Folded<R>,
    pub(crate) accel: Folded<R>,
}

impl<R: Real> Mode<R> {
    const NONE: Self = Self {
        eta: Folded::ZERO,
        damped: Folded::ZERO,
        velocity: Folded::ZERO,
        products: Folded::ZERO,
        accel: Folded::ZERO,
    };
    pub(super) const NO_MODES: [Self; MODES] = [Self::NONE; MODES];
}

/// A state of joints and modes, with the rates that the effects need.
pub(crate) struct Measured<'a, R, E, const Q: usize, const V: usize, const M: usize> {
    pub(crate) joints: &'a State<R, Q, V>,
    pub(crate) modes: &'a State<R, M, M>,
    pub(crate) effects: PhantomData<E>,
}

/// The effects of a type, on a robot of B bodies.
pub(crate) struct SceneType<E, const B: usize>(PhantomData<E>);

impl<R: Real, E, const B: usize, const Q: usize, const V: usize, const M: usize> Moves<R>
    for Measured<'_, R, SceneType<E, B>, Q, V, M>
where
    E: Effect<R, B, V>,
{
    const ALL: bool = true;

    #[cfg_attr(optimised, inline(always))]
    fn joint(&self, i: usize) -> JointRates<R> {
        let (qd, qdd) = (self.joints.qd[i], self.joints.qdd[i]);
        JointRates {
            velocity: Folded::runtime_if(E::BODY_VELOCITY, qd),
            omega_products: Folded::runtime_if(E::VELOCITY_PRODUCTS, qd),
            accel: Folded::runtime_if(E::ACCELERATIONS, qdd),
        }
    }

    #[cfg_attr(optimised, inline(always))]
    fn mode(&self, k: usize) -> Mode<R> {
        let (rate, accel) = (self.modes.qd[k], self.modes.qdd[k]);
        Mode {
            eta: Folded::runtime(self.modes.q[k]),
            damped: Folded::runtime_if(E::ELASTICITY, rate),
            velocity: Folded::runtime_if(E::BODY_VELOCITY, rate),
            products: Folded::runtime_if(E::VELOCITY_PRODUCTS, rate),
            accel: Folded::runtime_if(E::ACCELERATIONS, accel),
        }
    }
}

/// The unit acceleration of coordinate L, of V joints and then of the modes, of a robot whose links
/// are bent.
pub(crate) struct Unit<'a, R, const V: usize, const M: usize, const L: usize> {
    pub(crate) eta: &'a [R; M],
}

impl<R: Real, const V: usize, const M: usize, const L: usize> Unit<'_, R, V, M, L> {
    #[cfg_attr(optimised, inline(always))]
    fn of(k: usize) -> Folded<R> {
        if k == L { Folded::ONE } else { Folded::ZERO }
    }
}

impl<R: Real, const V: usize, const M: usize, const L: usize> Moves<R> for Unit<'_, R, V, M, L> {
    const ALL: bool = false;

    #[cfg_attr(optimised, inline(always))]
    fn joint(&self, i: usize) -> JointRates<R> {
        JointRates { velocity: Folded::ZERO, omega_products: Folded::ZERO, accel: Self::of(i) }
    }

    #[cfg_attr(optimised, inline(always))]
    fn mode(&self, k: usize) -> Mode<R> {
        Mode { eta: Folded::runtime(self.eta[k]), accel: Self::of(V + k), ..Mode::NONE }
    }
}
