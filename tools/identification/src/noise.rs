//! The noise of the projected torques of each joint, from the residuals of least squares.

use crate::solved::Solved;

/// The least noise relative to a joint's torque: without any, as of a simulation, weights are
/// finite.
const LEAST: f64 = 1e-9;
/// No harmonic has less than this share of the mean square of all: more weight than that would be
/// no gain.
const SHARE: f64 = 0.01;
/// Harmonics before and after one of which the squares of residuals are averaged.
const WINDOW: usize = 10;

/// The variance σ² = s₀ + s₁ (h/H)⁴ of each joint in harmonic h, of the mean period: of torques,
/// and of accelerations from noisy positions, which grow with h².
pub(crate) struct Noise<const V: usize> {
    squares: [[f64; 2]; V],
    harmonics: usize,
}

impl<const V: usize> Noise<V> {
    /// As large as the torques, in proportion.
    pub(crate) fn first(torques: &[f64; V], harmonics: usize) -> Self {
        Self { squares: torques.map(|torque| [torque * torque, 0.0]), harmonics }
    }

    /// The rows of a joint: harmonic 0, then a sine and a cosine of each.
    fn each(&self) -> usize {
        2 * self.harmonics + 1
    }

    /// (h/H)⁴ of a row of a joint.
    fn share(&self, row: usize) -> f64 {
        (row.div_ceil(2) as f64 / self.harmonics as f64).powi(4)
    }

    /// σ² of a row of all.
    pub(crate) fn square(&self, at: usize) -> f64 {
        let [torques, positions] = self.squares[at / self.each()];
        torques + positions * self.share(at % self.each())
    }

    /// To what residuals imply, and returns the largest relative change of a joint's noise.
    ///
    /// The expected square of a residual is σ² (1 − leverage), its variance 2 σ⁴ (1 − leverage)²:
    /// weighted least squares of the squares by both components, neither of which is negative. An
    /// iteration of this is Fisher's scoring.
    pub(crate) fn update(&mut self, solved: &Solved, torques: &[f64; V]) -> f64 {
        let mut change = 0.0_f64;
        for (j, torque) in torques.iter().enumerate() {
            let (mut aa, mut ab, mut bb) = (0.0, 0.0, 0.0);
            let (mut at, mut bt) = (0.0, 0.0);
            let (mut sum, mut free) = (0.0, 0.0);
            for row in 0..self.each() {
                let (all, x) = (j * self.each() + row, self.share(row));
                let (square, residual) = (self.square(all), solved.squares[all]);
                let degrees = 1.0 - solved.leverages[all];
                // Relative to what is expected: the residuals are weighted already.
                let (a, b) = (degrees / square, degrees * x / square);
                (aa, ab, bb) = (aa + a * a, ab + a * b, bb + b * b);
                (at, bt) = (at + a * residual, bt + b * residual);
                (sum, free) = (sum + residual * square, free + degrees);
            }
            let least = (SHARE * sum / free).max((LEAST * torque).powi(2));
            let determinant = aa * bb - ab * ab;
            let a = (at * bb - bt * ab) / determinant;
            let b = (bt * aa - at * ab) / determinant;
            let new = match (a > least, b > 0.0) {
                (true, true) => [a, b],
                (_, false) => [(at / aa).max(least), 0.0],
                (false, true) => [least, ((bt - ab * least) / bb).max(0.0)],
            };
            let ends = |[a, b]: [f64; 2]| [a, a + b];
            for (new, before) in ends(new).into_iter().zip(ends(self.squares[j])) {
                change = change.max((new / before - 1.0).abs());
            }
            self.squares[j] = new;
        }
        change
    }

    /// The square of the residuals of each harmonic and those around it relative to σ², by rows.
    pub(crate) fn bands(&self, solved: &Solved) -> Vec<f64> {
        let mut bands = Vec::new();
        for row in 0..V * self.each() {
            let (from, h) = (row - row % self.each(), (row % self.each()).div_ceil(2));
            let first = (2 * h.saturating_sub(WINDOW)).saturating_sub(1);
            let last = 2 * (h + WINDOW).min(self.harmonics);
            let rows = from + first..=from + last;
            let squares: f64 = rows.clone().map(|at| solved.squares[at]).sum();
            bands.push(squares / rows.map(|at| 1.0 - solved.leverages[at]).sum::<f64>());
        }
        bands
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;

    // Two rows of each harmonic, −1 and 1, have one parameter: one degree of freedom, the square 2.
    #[test]
    fn the_variance_is_that_of_the_degrees_of_freedom() {
        let mut noise = Noise::first(&[1.0], 20);
        let rows = DMatrix::from_fn(41, 20, |row, k| f64::from(row.div_ceil(2) == k + 1));
        let torque = |row| if row == 0 { 2.0_f64.sqrt() } else { (row % 2) as f64 * 2.0 - 1.0 };
        let torques = DMatrix::from_fn(41, 1, |row, _| torque(row));
        for _ in 0..10 {
            let solved = Solved::of(&rows, &torques, |at| noise.square(at));
            noise.update(&solved, &[1.0]);
        }
        for at in 0..41 {
            assert!((noise.square(at) - 2.0).abs() < 1e-6, "{at}: {}", noise.square(at));
        }
    }
}
