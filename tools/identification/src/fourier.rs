//! Periodic motion as a finite Fourier series of each joint.

use std::f64::consts::TAU;

use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use motion_control::reference::Reference;

/// A periodic motion of V joints: a finite Fourier series of each, rad or m.
///
/// ```text
/// q_j(t) = c_j + Σ_{h=1..H} (a_jh sin(h ω t) + b_jh cos(h ω t))      ω = 2π / T
/// ```
///
/// Its velocity and acceleration are derivatives of the same coefficients.
///
/// # Source
/// Swevers, Ganseman, Tükel, de Schutter & Van Brussel, "Optimal robot excitation and
/// identification" (1997), (5) to (7), with amplitudes of positions in place of those of
/// velocities.
///
/// # Example
/// ```
/// use identification::FourierMotion;
/// let swing = FourierMotion { period: 2.0, centre: [0.5], sines: vec![[0.0]], cosines: vec![[-0.2]] };
/// let (start, middle) = (swing.at(0.0), swing.at(1.0));
/// assert!((start.q[0] - 0.3).abs() < 1e-12 && start.qd[0].abs() < 1e-12);
/// assert!((middle.q[0] - 0.7).abs() < 1e-12 && (middle.qdd[0] + 0.2 * std::f64::consts::PI.powi(2)).abs() < 1e-12);
/// ```
#[doc(alias = "excitation trajectory")]
#[doc(alias = "exciting trajectory")]
#[derive(Clone, Debug, PartialEq)]
pub struct FourierMotion<const V: usize> {
    /// T, s.
    pub period: f64,
    /// c, rad or m.
    pub centre: [f64; V],
    /// a of each harmonic, the first one first, rad or m.
    pub sines: Vec<[f64; V]>,
    /// b of each harmonic, as many as sines, rad or m.
    pub cosines: Vec<[f64; V]>,
}

impl<const V: usize> FourierMotion<V> {
    /// Position, velocity and acceleration at a time, rad and s or m and s.
    ///
    /// # Cost
    /// One sine and cosine, and some 12 V + 6 flops for each harmonic.
    #[must_use]
    pub fn at(&self, t: f64) -> State<f64, V, V> {
        let rate = TAU / self.period;
        // It takes the time within the period: exact after many of them.
        let (sine, cosine) = (rate * (t % self.period)).sin_cos();
        let (mut s, mut c) = (sine, cosine);
        let mut state = State::at(self.centre);
        for (h, (a, b)) in (1_u32..).zip(self.sines.iter().zip(&self.cosines)) {
            let w = rate * f64::from(h);
            for j in 0..V {
                let swing = a[j] * s + b[j] * c;
                state.q[j] += swing;
                state.qd[j] += w * (a[j] * c - b[j] * s);
                state.qdd[j] -= w * w * swing;
            }
            (s, c) = (s * cosine + c * sine, c * cosine - s * sine);
        }
        state
    }

    /// The same motion as a reference of a controller: this many periods in ticks of this length,
    /// s, at rest at the end.
    ///
    /// ```
    /// use motion_control::reference::Reference;
    /// use identification::FourierMotion;
    /// let swing = FourierMotion { period: 2.0, centre: [0.5], sines: vec![[0.0]], cosines: vec![[-0.2]] };
    /// let reference = swing.reference(1e-3, 3);
    /// let end = Reference::<f32, 1>::at(&reference, 9000);
    /// assert!(Reference::<f32, 1>::ticks(&reference) == 6000 && (end.q[0] - 0.3).abs() < 1e-6 && end.qdd == [0.0]);
    /// ```
    #[must_use]
    pub fn reference(&self, tick: f64, periods: u32) -> PeriodicReference<'_, V> {
        let ticks = (self.period * f64::from(periods) / tick).round() as u32;
        PeriodicReference { motion: self, tick, ticks }
    }
}

/// Periods of a motion by ticks: the [`Reference`] of [`FourierMotion::reference`].
#[derive(Clone, Copy, Debug)]
pub struct PeriodicReference<'a, const V: usize> {
    motion: &'a FourierMotion<V>,
    tick: f64,
    ticks: u32,
}

impl<R: Real, const V: usize> Reference<R, V> for PeriodicReference<'_, V> {
    fn at(&self, tick: u32) -> State<R, V, V> {
        if tick >= self.ticks {
            let end = self.tick * f64::from(self.ticks);
            return State::at(self.motion.at(end).q.map(R::from_f64));
        }
        let State { q, qd, qdd } = self.motion.at(self.tick * f64::from(tick));
        State { q: q.map(R::from_f64), qd: qd.map(R::from_f64), qdd: qdd.map(R::from_f64) }
    }

    fn ticks(&self) -> u32 {
        self.ticks
    }
}
