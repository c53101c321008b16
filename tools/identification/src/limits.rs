//! The limits of an excitation, and the motion of a given form that uses them fully.

use std::f64::consts::PI;

use crate::FourierMotion;

/// Within what an excitation stays at all times, of each joint.
///
/// ```
/// use identification::ExcitationLimits;
/// let limits = ExcitationLimits {
///     lower: [-1.0],
///     upper: [1.0],
///     velocity: [2.0],
///     acceleration: [5.0],
///     torque: [28.0],
/// };
/// assert!(limits.are_possible());
/// assert!(!ExcitationLimits { upper: [-1.0], ..limits }.are_possible());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExcitationLimits<const V: usize> {
    /// Least position, rad or m.
    pub lower: [f64; V],
    /// Greatest position, rad or m.
    pub upper: [f64; V],
    /// Greatest |q̇|, rad/s or m/s.
    pub velocity: [f64; V],
    /// Greatest |q̈|, rad/s² or m/s².
    pub acceleration: [f64; V],
    /// Greatest torque of the nominal rigid bodies, N·m or N, without friction and armatures. The
    /// rows of each joint are relative to it before their noise is known.
    pub torque: [f64; V],
}

impl<const V: usize> ExcitationLimits<V> {
    /// Whether all numbers are finite, each range is one, and the others are positive.
    #[must_use]
    pub fn are_possible(&self) -> bool {
        let range = self.lower.iter().zip(&self.upper);
        let positive = |x: &[f64; V]| x.iter().all(|x| *x > 0.0 && x.is_finite());
        range.into_iter().all(|(a, b)| (b - a).is_finite() && a < b)
            && [&self.velocity, &self.acceleration, &self.torque].into_iter().all(positive)
    }

    /// The motion of this form that begins at rest and reaches at least one limit of each joint but
    /// exceeds none.
    ///
    /// The form has any amplitudes, of which those of the motion are the nearest that start without
    /// velocity and acceleration, times a factor; `place` from 0 to 1 selects where the swing is
    /// within the room that the positions leave. A joint whose form is zero rests in the middle.
    /// Between samples a trigonometric polynomial of degree H exceeds the largest of m > 2 H
    /// samples by no more than the factor 1/cos(πH/m): Ehlich & Zeller (1964).
    pub(crate) fn fill(&self, form: &FourierMotion<V>, place: &[f64; V]) -> FourierMotion<V> {
        let mut motion = FourierMotion { centre: [0.0; V], ..form.clone() };
        let harmonics = motion.sines.len();
        for j in 0..V {
            start_at_rest(&mut motion.sines, j, 1);
            start_at_rest(&mut motion.cosines, j, 2);
        }
        let samples = 32 * harmonics;
        let (mut low, mut high) = ([0.0_f64; V], [0.0_f64; V]);
        let mut rates = [[0.0_f64; V]; 2];
        for k in 0..samples {
            let at = motion.at(motion.period * k as f64 / samples as f64);
            for j in 0..V {
                (low[j], high[j]) = (low[j].min(at.q[j]), high[j].max(at.q[j]));
                rates[0][j] = rates[0][j].max(at.qd[j].abs());
                rates[1][j] = rates[1][j].max(at.qdd[j].abs());
            }
        }
        let between = 1.0 / (PI / 32.0).cos();
        for j in 0..V {
            let (room, swing) = (self.upper[j] - self.lower[j], between * (high[j] - low[j]));
            let shares = [
                room / swing,
                self.velocity[j] / (between * rates[0][j]),
                self.acceleration[j] / (between * rates[1][j]),
            ];
            let factor = shares.into_iter().fold(f64::INFINITY, f64::min);
            let factor = if factor.is_finite() { factor } else { 0.0 };
            for amplitudes in motion.sines.iter_mut().chain(&mut motion.cosines) {
                amplitudes[j] *= factor;
            }
            let left = room - factor * swing;
            let middle = 0.5 * (low[j] + high[j]) * factor;
            motion.centre[j] = self.lower[j] + left * place[j] + 0.5 * factor * swing - middle;
        }
        motion
    }
}

/// The nearest amplitudes with Σ hᵖ a_h = 0, of which the velocity (p = 1) or the acceleration (p =
/// 2) is zero at the start.
fn start_at_rest<const V: usize>(amplitudes: &mut [[f64; V]], joint: usize, power: i32) {
    let weight = |h: usize| ((h + 1) as f64).powi(power);
    let all = || amplitudes.iter().enumerate();
    let sum: f64 = all().map(|(h, a)| weight(h) * a[joint]).sum();
    let squares: f64 = all().map(|(h, _)| weight(h) * weight(h)).sum();
    for (h, a) in amplitudes.iter_mut().enumerate() {
        a[joint] -= weight(h) * sum / squares;
    }
}
