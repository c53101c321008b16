//! Tracking errors of a run.

use motion_control::limits::Status;

use super::Record;

/// Tracking errors of one run, gathered outside the interrupt.
#[derive(Clone, Copy, Debug)]
pub struct Errors<const N: usize> {
    count: u32,
    squares: [f64; N],
    /// Largest absolute error of each joint.
    pub max: [f32; N],
    /// The first status with a fault or a limit in effect, or else the last.
    pub status: Option<Status>,
}

impl<const N: usize> Default for Errors<N> {
    fn default() -> Self {
        Self { count: 0, squares: [0.0; N], max: [0.0; N], status: None }
    }
}

impl<const N: usize> Errors<N> {
    pub fn add(&mut self, record: &Record<N>) {
        self.count += 1;
        for j in 0..N {
            let error = record.actual[j] - record.telemetry.reference[j];
            self.squares[j] += f64::from(error) * f64::from(error);
            self.max[j] = larger(self.max[j], error.abs());
        }
        let plain = |s: &Status| s.fault.is_none() && !s.limited;
        if self.status.is_none_or(|s| plain(&s)) {
            self.status = Some(record.telemetry.status);
        }
    }

    /// Root mean square of each joint.
    pub fn rms(&self) -> [f32; N] {
        self.squares.map(|s| self.root(s))
    }

    /// Root mean square over all joints.
    pub fn total(&self) -> f32 {
        self.root(self.squares.iter().sum::<f64>() / N as f64)
    }

    pub fn count(&self) -> u32 {
        self.count
    }

    fn root(&self, squares: f64) -> f32 {
        libm::sqrt(squares / f64::from(self.count.max(1))) as f32
    }
}

/// The larger one, or the one that is not a number: an error that is none may not pass for small.
pub fn larger(a: f32, b: f32) -> f32 {
    if b > a || b.is_nan() { b } else { a }
}
