//! A low-pass filter without delay, and the derivatives of what it lets pass.
//!
//! The samples are convolved with a Gaussian and with its derivatives, so that velocity and
//! acceleration are those of the filtered position exactly: Canny, "A computational approach to
//! edge detection" (1986), section IV; as a filter it needs the samples of both sides and is for
//! recordings only.

use std::f64::consts::{LN_2, TAU};

/// Standard deviations on either side: what lies farther away has a weight below 2·10⁻⁴.
const REACH: f64 = 4.2;

/// The weights of samples around the filtered one.
pub(crate) struct LowPass {
    /// Ticks on either side.
    pub reach: usize,
    /// For position, velocity and acceleration, per tick and tick².
    weights: Vec<[f64; 3]>,
}

impl LowPass {
    /// The standard deviation, in ticks, that halves the power at a frequency in 1/tick.
    pub fn width(cutoff: f64) -> f64 {
        LN_2.sqrt() / (TAU * cutoff)
    }

    /// A filter of this standard deviation, in ticks, whose output is that of a time `delay` ticks
    /// after the middle sample.
    pub fn new(width: f64, delay: f64) -> Self {
        let reach = (REACH * width + delay.abs()).ceil() as usize;
        let x = |i: usize| i as f64 - reach as f64 - delay;
        let bell = |i: usize| (-0.5 * (x(i) / width).powi(2)).exp();
        let count = 2 * reach + 1;
        let sum = |of: &dyn Fn(usize) -> f64| (0..count).map(of).sum::<f64>();
        let all = sum(&bell);
        // Lines and parabolas keep their derivatives, whatever the sampling.
        let first = |i: usize| x(i) * bell(i);
        let mean = sum(&first) / all;
        let slope = |i: usize| (x(i) - mean) * bell(i);
        let along = sum(&|i| slope(i) * x(i));
        let square = sum(&|i| x(i) * x(i) * bell(i)) / all;
        let tilt = sum(&|i| x(i) * x(i) * slope(i)) / along;
        let bend = |i: usize| (x(i) * x(i) - square - tilt * (x(i) - mean)) * bell(i);
        let curve = sum(&|i| 0.5 * x(i) * x(i) * bend(i));
        let weights = (0..count).map(|i| [bell(i) / all, slope(i) / along, bend(i) / curve]);
        Self { reach, weights: weights.collect() }
    }

    /// The weight of a sample this many ticks from the start of the window.
    pub fn weight(&self, place: usize) -> f64 {
        self.weights[place][0]
    }

    /// Position, velocity and acceleration, per tick and tick², in the middle of these samples.
    pub fn state<const V: usize>(&self, samples: &[[f64; V]]) -> [[f64; V]; 3] {
        let mut state = [[0.0; V]; 3];
        for (weights, sample) in self.weights.iter().zip(samples) {
            for (state, weight) in state.iter_mut().zip(weights) {
                for (state, x) in state.iter_mut().zip(sample) {
                    *state += weight * x;
                }
            }
        }
        state
    }
}
