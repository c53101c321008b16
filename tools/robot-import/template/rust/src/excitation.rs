//! A motion that shows masses, inertias and frictions: a Fourier series of each joint, with
//! pseudo-random amplitudes.
//!
//! It starts and returns to `home` at rest, and stays within the ranges, half the speeds and most
//! of the torques of the limits.

use core::array;
use core::f32::consts::TAU;

use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use motion_control::reference::Reference;

use crate::scene::{self, Motion, N, TICK};

/// The ticks after which it repeats: 10 s.
const PERIOD: u32 = (10.0 / TICK) as u32;
/// The frequencies of each joint: 0.1 Hz to 0.8 Hz.
const HARMONICS: usize = 8;
/// The greatest way of a joint, rad or m.
const MOST: f32 = 1.6;
/// Times of a period at which limits are checked.
const CHECKED: u32 = 200;

/// The series of all joints.
#[derive(Clone, Copy, Debug)]
pub struct Excitation {
    /// Amplitudes of sines and cosines by harmonics, rad or m.
    amplitudes: [[[f32; N]; 2]; HARMONICS],
    /// The positions around which the joints swing, rad or m.
    centre: [f32; N],
}

impl Excitation {
    /// Within the limits of the scene, which may depend on its `motion`.
    pub fn new(motion: &Motion) -> Self {
        let mut found = Self { amplitudes: random(), centre: [0.0; N] };
        found.start_at_rest();
        let factors = found.within_ranges();
        found.scale(&factors);
        // Smaller until the torques are possible.
        let most = scene::limits(motion).torque;
        for _ in 0..20 {
            let fits = |tick| {
                let torque = scene::inverse_dynamics(&found.at(tick));
                (0..N).all(|joint| torque[joint].abs() < 0.7 * most[joint])
            };
            if times().all(fits) {
                break;
            }
            found.scale(&[0.85; N]);
        }
        found
    }

    /// The nearest amplitudes without velocity and acceleration at the start: Σ h a = 0 and Σ h² b
    /// = 0.
    fn start_at_rest(&mut self) {
        for kind in 0..2 {
            for joint in 0..N {
                let weight = |h: usize| {
                    if kind == 0 { (h + 1) as f32 } else { ((h + 1) * (h + 1)) as f32 }
                };
                let (mut sum, mut squares) = (0.0, 0.0);
                for (h, amplitudes) in self.amplitudes.iter().enumerate() {
                    sum += weight(h) * amplitudes[kind][joint];
                    squares += weight(h) * weight(h);
                }
                for (h, amplitudes) in self.amplitudes.iter_mut().enumerate() {
                    amplitudes[kind][joint] -= weight(h) * sum / squares;
                }
            }
        }
    }

    /// By how much each joint's series may be multiplied; negative where there is more room on the
    /// other side.
    fn within_ranges(&self) -> [f32; N] {
        let (home, limits) = (scene::home(), scene::described_limits());
        let start = self.at(0).q;
        let (mut low, mut high, mut speed) = ([0.0_f32; N], [0.0_f32; N], [1e-6_f32; N]);
        for state in times().map(|tick| self.at(tick)) {
            for joint in 0..N {
                let way = state.q[joint] - start[joint];
                (low[joint], high[joint]) = (low[joint].min(way), high[joint].max(way));
                speed[joint] = speed[joint].max(state.qd[joint].abs());
            }
        }
        array::from_fn(|joint| {
            let room = [
                0.9 * (home[joint] - limits[joint].lower),
                0.9 * (limits[joint].upper - home[joint]),
            ];
            let ways = [(-low[joint]).max(1e-6), high[joint].max(1e-6)];
            let slow = 0.5 * limits[joint].velocity / speed[joint];
            let most = slow.min(MOST / (ways[0] + ways[1]));
            let same = (room[0] / ways[0]).min(room[1] / ways[1]).min(most);
            let turned = (room[0] / ways[1]).min(room[1] / ways[0]).min(most);
            if same >= turned { same } else { -turned }
        })
    }

    /// Multiplies the amplitudes, and starts at home.
    fn scale(&mut self, factors: &[f32; N]) {
        for amplitude in self.amplitudes.iter_mut().flatten() {
            for (amplitude, factor) in amplitude.iter_mut().zip(factors) {
                *amplitude *= factor;
            }
        }
        let (home, start) = (scene::home(), self.at(0).q);
        self.centre = array::from_fn(|joint| self.centre[joint] + home[joint] - start[joint]);
    }
}

impl Reference<f32, N> for Excitation {
    fn at(&self, tick: u32) -> State<f32, N, N> {
        const STEP: f32 = TAU / PERIOD as f32;
        let (sine, cosine) = Real::sin_cos(STEP * (tick % PERIOD) as f32);
        let (mut s, mut c, mut w) = (sine, cosine, STEP / TICK);
        let mut state = State::at(self.centre);
        for [a, b] in &self.amplitudes {
            for joint in 0..N {
                let swing = a[joint] * s + b[joint] * c;
                state.q[joint] += swing;
                state.qd[joint] += w * (a[joint] * c - b[joint] * s);
                state.qdd[joint] -= w * w * swing;
            }
            (s, c, w) = (s * cosine + c * sine, c * cosine - s * sine, w + STEP / TICK);
        }
        state
    }

    fn ticks(&self) -> u32 {
        u32::MAX
    }
}

/// The ticks at which limits are checked.
fn times() -> impl Iterator<Item = u32> {
    (0..CHECKED).map(|k| k * (PERIOD / CHECKED))
}

/// Amplitudes of about the same velocity in all harmonics: Marsaglia, "Xorshift RNGs" (2003).
fn random() -> [[[f32; N]; 2]; HARMONICS] {
    let mut x = 0x9e37_79b9_u32;
    let mut draw = || {
        x ^= x << 13;
        x ^= x >> 17;
        x ^= x << 5;
        (x >> 8) as f32 * (2.0 / 16_777_216.0) - 1.0
    };
    array::from_fn(|h| array::from_fn(|_| array::from_fn(|_| draw() / (h + 1) as f32)))
}
