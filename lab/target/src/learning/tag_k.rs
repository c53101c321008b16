//! TAG-K, a published estimator of inertial parameters for microcontrollers, beside which the library's is shown.
//!
//! Sha, Bhakta, Jiang, Qiu, Mahajan, Bravo-Palacios & Plancher, "TAG-K: tail-averaged greedy Kaczmarz for computationally efficient
//! and performant online inertial parameter estimation" (ICRA 2026, arXiv:2510.04839), written anew from its description: as many
//! steps as rows, each a projection onto the row that a draw chooses among those of large residuals; the estimate is the mean of the
//! later half of the steps.
//!
//! ```text
//! r = b − A x      ε = ½ (max_i r_i² / ‖a_i‖² / ‖r‖² + 1 / ‖A‖²)      U = { i: r_i² ≥ ε ‖r‖² ‖a_i‖² }
//! x ← x + r_i / ‖a_i‖² a_i      i drawn from U with probabilities in proportion to r_i²
//! ```

#[derive(Clone, Debug)]
pub struct TagK {
    estimate: [f32; 10],
    random: u32,
}

impl Default for TagK {
    fn default() -> Self {
        Self {
            estimate: [0.0; 10],
            random: 1,
        }
    }
}

impl TagK {
    pub fn estimate(&self) -> &[f32; 10] {
        &self.estimate
    }

    /// Adds rows and their right-hand sides, each divided by the standard deviation of its noise. A row without entries is left out.
    #[inline(always)]
    pub fn update<const M: usize>(&mut self, a: &[[f32; 10]; M], b: &[f32; M]) {
        let squares = a.each_ref().map(|row| dot(row, row));
        let all = squares.iter().fold(0.0, |sum, square| sum + square);
        let (mut x, mut sum, mut count) = (self.estimate, [0.0; 10], 0.0);
        for step in 0..M {
            let mut residuals = [0.0; M];
            let (mut most, mut norm) = (0.0_f32, 0.0);
            for (((r, row), b), square) in residuals.iter_mut().zip(a).zip(b).zip(&squares) {
                if *square > 0.0 {
                    *r = b - dot(row, &x);
                    most = most.max(*r * *r / square);
                    norm += *r * *r;
                }
            }
            if norm <= 0.0 {
                break;
            }
            let least = 0.5 * (most + norm / all);
            let large = |(r, square): &(&f32, &f32)| **r * **r >= least * **square;
            let chosen = || residuals.iter().zip(&squares).filter(large);
            let drawn = chosen().fold(0.0, |sum, (r, _)| sum + r * r) * self.draw();
            let mut passed = 0.0;
            for ((r, square), row) in residuals.iter().zip(&squares).zip(a) {
                if large(&(r, square)) {
                    passed += r * r;
                }
                if passed > drawn {
                    let gain = r / square;
                    x.iter_mut().zip(row).for_each(|(x, a)| *x += gain * a);
                    break;
                }
            }
            if step >= M / 2 {
                sum.iter_mut().zip(&x).for_each(|(sum, x)| *sum += x);
                count += 1.0;
            }
        }
        if count > 0.0 {
            self.estimate = sum.map(|sum| sum / count);
        }
    }

    /// From 0 to less than 1. Marsaglia, "Xorshift RNGs" (2003).
    fn draw(&mut self) -> f32 {
        let mut x = self.random;
        x ^= x << 13;
        x ^= x >> 17;
        x ^= x << 5;
        self.random = x;
        (x >> 8) as f32 / (1 << 24) as f32
    }
}

#[inline(always)]
fn dot(a: &[f32; 10], b: &[f32; 10]) -> f32 {
    a.iter().zip(b).fold(0.0, |sum, (a, b)| sum + a * b)
}
