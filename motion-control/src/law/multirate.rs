//! Torque between two computations of the dynamics, for loops that tick faster than they compute.
//!
//! A loop computes in every `TICKS`-th tick and passes the result to `update`, which returns the
//! torque of that tick; in the other ticks, `hold` returns it. The error grows with `TICKS` and
//! with the speed of the arm. It is largest where the jerk of the reference jumps, as at the
//! way-points of [`Trajectory`](crate::reference::Trajectory), unless the dynamics are computed in
//! such ticks. Errors and savings are in `docs/accuracy.md` in the repository.

use dynamics_core::algorithms::MassMatrix;
use dynamics_core::scalar::Real;

/// Keeps the torque of the last computation.
///
/// ```
/// use motion_control::law::ZeroOrderHold;
/// let mut held = ZeroOrderHold::start();
/// held.update([3.0_f32]);
/// assert_eq!(held.hold(), [3.0]);
/// ```
#[doc(alias = "zero-order hold")]
#[doc(alias = "sample and hold")]
#[doc(alias = "Held")]
#[derive(Clone, Copy, Debug)]
pub struct ZeroOrderHold<R, const V: usize> {
    torque: [R; V],
}

impl<R: Real, const V: usize> ZeroOrderHold<R, V> {
    /// A state before the first computation: its torques are zero.
    pub fn start() -> Self {
        Self { torque: [R::ZERO; V] }
    }

    /// Updates the state in a tick that has computed the torque.
    #[inline(always)]
    pub fn update(&mut self, torque: [R; V]) -> [R; V] {
        self.torque = torque;
        torque
    }

    /// The torque of a tick that has not computed it.
    #[inline(always)]
    pub fn hold(&self) -> [R; V] {
        self.torque
    }
}

/// Extrapolates the torque along the line through the last two computations.
///
/// ```
/// use motion_control::law::FirstOrderHold;
/// let mut torque = FirstOrderHold::<f32, 1, 2>::start();
/// torque.update([3.0]);
/// assert_eq!(torque.hold(), [3.0]); // nothing is known yet
/// torque.update([4.0]);
/// assert_eq!(torque.hold(), [4.5]);
/// ```
#[doc(alias = "extrapolation")]
#[doc(alias = "Extrapolated")]
#[derive(Clone, Copy, Debug)]
pub struct FirstOrderHold<R, const V: usize, const TICKS: usize> {
    computed: [R; V],
    torque: [R; V],
    /// The increment of a tick.
    step: [R; V],
    known: bool,
}

impl<R: Real, const V: usize, const TICKS: usize> FirstOrderHold<R, V, TICKS> {
    /// A state before the first computation: its torques are zero.
    pub fn start() -> Self {
        Self { computed: [R::ZERO; V], torque: [R::ZERO; V], step: [R::ZERO; V], known: false }
    }

    /// Updates the state in a tick that has computed the torque.
    #[inline(always)]
    pub fn update(&mut self, torque: [R; V]) -> [R; V] {
        if self.known {
            self.step = slope::<R, V, TICKS>(&torque, &self.computed);
        }
        self.known = true;
        self.computed = torque;
        self.torque = torque;
        torque
    }

    /// The torque of a tick that has not computed it.
    #[inline(always)]
    pub fn hold(&mut self) -> [R; V] {
        for (torque, &step) in self.torque.iter_mut().zip(&self.step) {
            *torque += step;
        }
        self.torque
    }
}

/// Interpolates the torque between one computation and the next, which is made ahead of its time.
///
/// For feed-forward, whose reference is known: `update` receives the torque of `TICKS` ticks later.
///
/// ```
/// use motion_control::law::Interpolator;
/// let mut torque = Interpolator::<f32, 1, 2>::start([3.0]);
/// assert_eq!(torque.update([4.0]), [3.0]); // that of two ticks later
/// assert_eq!(torque.hold(), [3.5]);
/// assert_eq!(torque.update([6.0]), [4.0]);
/// ```
#[doc(alias = "linear interpolation")]
#[doc(alias = "Interpolated")]
#[derive(Clone, Copy, Debug)]
pub struct Interpolator<R, const V: usize, const TICKS: usize> {
    ahead: [R; V],
    torque: [R; V],
    /// The increment of a tick.
    step: [R; V],
}

impl<R: Real, const V: usize, const TICKS: usize> Interpolator<R, V, TICKS> {
    /// Before the first tick, with its torque.
    pub fn start(torque: [R; V]) -> Self {
        Self { ahead: torque, torque, step: [R::ZERO; V] }
    }

    /// Updates the state in a tick that has computed the torque of `TICKS` ticks later; returns the
    /// torque of this tick.
    #[inline(always)]
    pub fn update(&mut self, ahead: [R; V]) -> [R; V] {
        self.torque = self.ahead;
        self.step = slope::<R, V, TICKS>(&ahead, &self.torque);
        self.ahead = ahead;
        self.torque
    }

    /// The torque of a tick that has not computed it.
    #[inline(always)]
    pub fn hold(&mut self) -> [R; V] {
        for (torque, &step) in self.torque.iter_mut().zip(&self.step) {
            *torque += step;
        }
        self.torque
    }
}

/// (b − a)/`TICKS`.
#[inline(always)]
fn slope<R: Real, const V: usize, const TICKS: usize>(b: &[R; V], a: &[R; V]) -> [R; V] {
    let ticks_inv = R::from_f64(const { 1.0 / TICKS as f64 });
    let mut slope = *b;
    for (slope, &a) in slope.iter_mut().zip(a) {
        *slope = (*slope - a) * ticks_inv;
    }
    slope
}

/// τ = b + M q̈ with the M of the last computation and the q̈ of now; b, the bias τ − M q̈, is
/// extrapolated linearly from the last two.
///
/// Exact where the acceleration jumps, which the others see a period late.
///
/// ```
/// use motion_control::law::InertiaUpdate;
/// use dynamics_core::{Engine, effects::RIGID_BODY, robots::Ur5e, state::State};
/// let mut state = State { qdd: [1.0_f32; 6], ..State::at([0.3; 6]) };
/// let mut torque = InertiaUpdate::<f32, 6, 5>::start();
/// let m = Engine::<Ur5e>::crba(&state.q, &RIGID_BODY);
/// torque.update(Engine::<Ur5e>::rnea(&state, &RIGID_BODY), m, &state.qdd);
/// state.qdd = [2.0; 6]; // brakes off
/// let (held, computed) = (torque.hold(&state.qdd), Engine::<Ur5e>::rnea(&state, &RIGID_BODY));
/// assert!(held.iter().zip(computed).all(|(a, b)| (a - b).abs() < 1e-4));
/// ```
#[doc(alias = "Linearised")]
#[derive(Clone, Copy, Debug)]
pub struct InertiaUpdate<R, const V: usize, const TICKS: usize> {
    mass_matrix: MassMatrix<R, V>,
    bias: FirstOrderHold<R, V, TICKS>,
}

impl<R: Real, const V: usize, const TICKS: usize> InertiaUpdate<R, V, TICKS> {
    /// A state before the first computation: its torques are zero.
    pub fn start() -> Self {
        Self { mass_matrix: MassMatrix::ZERO, bias: FirstOrderHold::start() }
    }

    /// Updates the state in a tick that has computed the torque, and M at the acceleration q̈.
    #[inline(always)]
    pub fn update(
        &mut self,
        torque: [R; V],
        mass_matrix: MassMatrix<R, V>,
        qdd: &[R; V],
    ) -> [R; V] {
        let mut bias = torque;
        for (bias, &inertial) in bias.iter_mut().zip(&mass_matrix.mul_vec(qdd)) {
            *bias -= inertial;
        }
        self.bias.update(bias);
        self.mass_matrix = mass_matrix;
        torque
    }

    /// The torque of a tick that has not computed it.
    #[inline(always)]
    pub fn hold(&mut self, qdd: &[R; V]) -> [R; V] {
        let mut torque = self.bias.hold();
        for (torque, &inertial) in torque.iter_mut().zip(&self.mass_matrix.mul_vec(qdd)) {
            *torque += inertial;
        }
        torque
    }
}
