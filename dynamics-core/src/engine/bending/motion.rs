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
pub(crate) trait Moves<Scalar: Real> {
    /// Whether effects act, and not the inertia alone.
    const ALL: bool;

    fn joint(&self, i: usize) -> JointRates<Scalar>;

    fn mode(&self, k: usize) -> Mode<Scalar>;
}

/// The coordinate of a mode and its rates.
#[derive(Clone, Copy)]
pub(crate) struct Mode<Scalar> {
    pub(crate) eta: Folded<Scalar>,
    /// The rate that damping acts on.
    pub(crate) damped: Folded<Scalar>,
    pub(crate) velocity: Folded<Scalar>,
    /// The velocity in the velocity products.
    pub(crate) products: Folded<Scalar>,
    pub(crate) accel: Folded<Scalar>,
}

impl<Scalar: Real> Mode<Scalar> {
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
pub(crate) struct Measured<'a, Scalar, Effects, const Q: usize, const V: usize, const M: usize> {
    pub(crate) joints: &'a State<Scalar, Q, V>,
    pub(crate) modes: &'a State<Scalar, M, M>,
    pub(crate) effects: PhantomData<Effects>,
}

/// The effects of a type, on a robot of B bodies.
pub(crate) struct Of<Effects, const B: usize>(PhantomData<Effects>);

impl<Scalar: Real, Effects, const B: usize, const Q: usize, const V: usize, const M: usize>
    Moves<Scalar> for Measured<'_, Scalar, Of<Effects, B>, Q, V, M>
where
    Effects: Effect<Scalar, B, V>,
{
    const ALL: bool = true;

    #[cfg_attr(optimised, inline(always))]
    fn joint(&self, i: usize) -> JointRates<Scalar> {
        let (qd, qdd) = (self.joints.qd[i], self.joints.qdd[i]);
        JointRates {
            velocity: Folded::runtime_if(Effects::BODY_VELOCITY, qd),
            omega_products: Folded::runtime_if(Effects::VELOCITY_PRODUCTS, qd),
            accel: Folded::runtime_if(Effects::ACCELERATIONS, qdd),
        }
    }

    #[cfg_attr(optimised, inline(always))]
    fn mode(&self, k: usize) -> Mode<Scalar> {
        let (rate, accel) = (self.modes.qd[k], self.modes.qdd[k]);
        Mode {
            eta: Folded::runtime(self.modes.q[k]),
            damped: Folded::runtime_if(Effects::ELASTICITY, rate),
            velocity: Folded::runtime_if(Effects::BODY_VELOCITY, rate),
            products: Folded::runtime_if(Effects::VELOCITY_PRODUCTS, rate),
            accel: Folded::runtime_if(Effects::ACCELERATIONS, accel),
        }
    }
}

/// The unit acceleration of coordinate L, of V joints and then of the modes, of a robot whose links
/// are bent.
pub(crate) struct Unit<'a, Scalar, const V: usize, const M: usize, const L: usize> {
    pub(crate) eta: &'a [Scalar; M],
}

impl<Scalar: Real, const V: usize, const M: usize, const L: usize> Unit<'_, Scalar, V, M, L> {
    #[cfg_attr(optimised, inline(always))]
    fn of(k: usize) -> Folded<Scalar> {
        if k == L { Folded::ONE } else { Folded::ZERO }
    }
}

impl<Scalar: Real, const V: usize, const M: usize, const L: usize> Moves<Scalar>
    for Unit<'_, Scalar, V, M, L>
{
    const ALL: bool = false;

    #[cfg_attr(optimised, inline(always))]
    fn joint(&self, i: usize) -> JointRates<Scalar> {
        JointRates { velocity: Folded::ZERO, omega_products: Folded::ZERO, accel: Self::of(i) }
    }

    #[cfg_attr(optimised, inline(always))]
    fn mode(&self, k: usize) -> Mode<Scalar> {
        Mode { eta: Folded::runtime(self.eta[k]), accel: Self::of(V + k), ..Mode::NONE }
    }
}
