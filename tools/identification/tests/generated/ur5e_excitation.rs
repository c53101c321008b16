//! Written by `identification::FourierMotion::rust_source`.

use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use motion_control::reference::Reference;

/// An excitation of 6 joints: period 5 s, 6 periods.
#[derive(Clone, Copy, Debug)]
pub struct Ur5eExcitation;

/// Ticks of a period.
const PERIOD: u32 = 2500;
/// 2π/PERIOD, and the angular velocity, rad/s.
const ANGLE: f32 = 0.002513274;
const RATE: f32 = 1.2566371;
/// The centre of the positions, rad or m.
#[rustfmt::skip]
pub const CENTRE: [f32; 6] = [-1.3861748, -1.5413502, -1.4511473, -0.58927673, 1.4392335, 0.046259608];
/// Amplitudes of the sines by harmonics, rad or m.
#[rustfmt::skip]
pub const SINES: [[f32; 6]; 5] = [
    [0.05734949, -0.14995396, 0.16454335, -1.108123, -0.24508011, -0.6084194],
    [-0.05390339, 0.03751979, -0.15481934, 0.26261884, 0.039763186, 0.41031033],
    [-0.09597345, 0.044291824, 0.11088265, 0.005522622, -0.15007743, 0.028088465],
    [-0.013382691, -0.023991285, 0.03732193, -0.03323614, 0.09452296, 0.0701235],
    [0.07838168, 0.00760081, -0.06736806, 0.1398524, 0.04753884, -0.11539214],
];
/// Amplitudes of the cosines by harmonics, rad or m.
#[rustfmt::skip]
pub const COSINES: [[f32; 6]; 5] = [
    [-0.18806307, -0.76746553, 0.13112076, 0.087941565, 0.6128768, 0.96747947],
    [-0.09242447, -0.00800111, 0.21635695, -0.04337839, 0.065065116, -0.0014271778],
    [0.051800735, -0.015748614, -0.11614391, -0.0031187371, -0.1636956, -0.18935321],
    [-0.0062068715, -0.0039999224, -0.0006132939, 0.107938476, 0.15106401, 0.089974046],
    [0.0076345713, 0.04020825, 0.0023423731, -0.064535, -0.07267603, -0.027887063],
];

impl Reference<f32, 6> for Ur5eExcitation {
    fn at(&self, tick: u32) -> State<f32, 6, 6> {
        let ended = tick >= Reference::<f32, 6>::ticks(self);
        let within = if ended { 0 } else { tick % PERIOD };
        let (sine, cosine) = Real::sin_cos(ANGLE * within as f32);
        let (mut s, mut c, mut w) = (sine, cosine, RATE);
        let mut state = State::at(CENTRE);
        for (a, b) in SINES.iter().zip(&COSINES) {
            let State { q, qd, qdd } = &mut state;
            let joints = q.iter_mut().zip(qd).zip(qdd).zip(a.iter().zip(b));
            for (((q, qd), qdd), (a, b)) in joints {
                let swing = a * s + b * c;
                *q += swing;
                *qd += w * (a * c - b * s);
                *qdd -= w * w * swing;
            }
            (s, c, w) = (s * cosine + c * sine, c * cosine - s * sine, w + RATE);
        }
        if ended {
            return State::at(state.q);
        }
        state
    }

    fn ticks(&self) -> u32 {
        PERIOD * 6
    }
}
