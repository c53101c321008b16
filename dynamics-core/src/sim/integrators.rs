//! Time steps as increments of q and q̇, which [`Summed`](super::Summed) adds up with or without loss.
//!
//! Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I* (1993), section II.1; Hairer, Lubich &
//! Wanner, *Geometric Numerical Integration* (2006), sections I.1.2 and IV.4. What each costs and loses is in
//! `docs/accuracy.md` in the repository.

use super::Mechanics;
use crate::algorithms::NotPositiveDefinite;
use crate::scalar::Real;
use crate::state::State;

/// What a step adds to q and q̇.
pub type Increments<R, const V: usize> = [[R; V]; 2];

/// A way to step through time.
pub trait Integrator<R: Real, const V: usize>: Sized {
    /// For a motion from this state on.
    fn start(mechanics: &impl Mechanics<R, V>, at: &State<R, V, V>) -> Self;

    /// What a step of h seconds adds to q and q̇; `at.qdd` is not read.
    ///
    /// # Errors
    /// As forward dynamics.
    fn step(
        &self,
        mechanics: &impl Mechanics<R, V>,
        at: &State<R, V, V>,
        h: R,
    ) -> Result<Increments<R, V>, NotPositiveDefinite>;
}

/// Explicit Euler: q̇ and q̈ of the step's beginning. First order; gains energy.
#[derive(Clone, Copy, Debug, Default)]
pub struct Euler;

/// Semi-implicit (symplectic) Euler: q moves with the new q̇. First order; energy swings, but does not drift.
///
/// ```
/// use dynamics_core::{effects::RIGID_BODY, model::Robot, robots::Ur5e, state::State};
/// use dynamics_core::sim::{Described, Integrator, SemiImplicit, Summed};
/// let arm = Described { robot: &Ur5e::MODEL_F32, tau: [0.0; 6], effects: &RIGID_BODY };
/// let mut falling = Summed::<f32, 6, true>::at(State::at([0.0, -1.5, 0.0, 0.0, 0.0, 0.0]));
/// let euler = SemiImplicit::start(&arm, &falling.state);
/// falling.add(euler.step(&arm, &falling.state, 1e-3)?);
/// assert!(falling.state.qd[1] != 0.0);
/// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct SemiImplicit;

/// The same with joint effects at the step's end along their slopes: no damping makes it unstable.
#[derive(Clone, Copy, Debug, Default)]
pub struct ImplicitDamping;

/// Runge and Kutta's classical method. Fourth order, four forward dynamics a step.
#[derive(Clone, Copy, Debug, Default)]
pub struct RungeKutta;

/// [`RungeKutta`], then q̇ scaled until T + U is what it was at the start: the projection on constant energy that is
/// orthogonal in M. For motions without friction and drives.
#[derive(Clone, Copy, Debug, Default)]
pub struct EnergyKept<R> {
    /// T + U, J.
    energy: R,
}

fn times<R: Real, const V: usize>(h: R, x: &[R; V]) -> [R; V] {
    x.map(|x| h * x)
}

fn plus<R: Real, const V: usize>(mut a: [R; V], b: &[R; V]) -> [R; V] {
    for (a, &b) in a.iter_mut().zip(b) {
        *a += b;
    }
    a
}

macro_rules! without_memory {
    ($integrator:ident, |$mechanics:ident, $at:ident, $h:ident| $step:expr) => {
        impl<R: Real, const V: usize> Integrator<R, V> for $integrator {
            fn start(_: &impl Mechanics<R, V>, _: &State<R, V, V>) -> Self {
                Self
            }

            fn step(
                &self,
                $mechanics: &impl Mechanics<R, V>,
                $at: &State<R, V, V>,
                $h: R,
            ) -> Result<Increments<R, V>, NotPositiveDefinite> {
                $step
            }
        }
    };
}

without_memory!(Euler, |mechanics, at, h| {
    let qdd = mechanics.acceleration(at)?;
    Ok([times(h, &at.qd), times(h, &qdd)])
});

without_memory!(SemiImplicit, |mechanics, at, h| {
    let added = times(h, &mechanics.acceleration(at)?);
    Ok([times(h, &plus(at.qd, &added)), added])
});

without_memory!(ImplicitDamping, |mechanics, at, h| {
    let added = times(h, &mechanics.implicit_acceleration(at, h)?);
    Ok([times(h, &plus(at.qd, &added)), added])
});

without_memory!(RungeKutta, |mechanics, at, h| {
    // (q̇, q̈) at the beginning, twice in the middle, and at the end.
    let slopes = |state: &State<R, V, V>| {
        let qdd = mechanics.acceleration(state)?;
        Ok([state.qd, qdd])
    };
    let from = |[qd, qdd]: &[[R; V]; 2], h| State {
        q: plus(at.q, &times(h, qd)),
        qd: plus(at.qd, &times(h, qdd)),
        qdd: at.qdd,
    };
    let half = h * R::from_f64(0.5);
    let first = slopes(at)?;
    let second = slopes(&from(&first, half))?;
    let third = slopes(&from(&second, half))?;
    let last = slopes(&from(&third, h))?;
    let [third_of_h, sixth_of_h] = [1.0 / 3.0, 1.0 / 6.0].map(|share| h * R::from_f64(share));
    Ok(core::array::from_fn(|k| {
        core::array::from_fn(|j| {
            sixth_of_h * (first[k][j] + last[k][j]) + third_of_h * (second[k][j] + third[k][j])
        })
    }))
});

impl<R: Real, const V: usize> Integrator<R, V> for EnergyKept<R> {
    fn start(mechanics: &impl Mechanics<R, V>, at: &State<R, V, V>) -> Self {
        let (kinetic, potential) = mechanics.energies(at);
        Self {
            energy: kinetic + potential,
        }
    }

    fn step(
        &self,
        mechanics: &impl Mechanics<R, V>,
        at: &State<R, V, V>,
        h: R,
    ) -> Result<Increments<R, V>, NotPositiveDefinite> {
        let [moved, mut added] = RungeKutta.step(mechanics, at, h)?;
        let end = State {
            q: plus(at.q, &moved),
            qd: plus(at.qd, &added),
            qdd: at.qdd,
        };
        let (kinetic, potential) = mechanics.energies(&end);
        // √(1 + 2x) − 1 of a small x to second order; near rest there is nothing to scale.
        let x = (self.energy - potential - kinetic) * R::from_f64(0.5) / kinetic;
        if x.abs() < R::from_f64(0.1) {
            let share = x - R::from_f64(0.5) * x * x;
            added = plus(added, &times(share, &end.qd));
        }
        Ok([moved, added])
    }
}
