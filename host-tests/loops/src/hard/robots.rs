//! The parallel robots near and in their singular postures.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use dynamics_core::loops::{LoopRobot, Moving};
use dynamics_core::state::State;

use super::setup::Setup;
use crate::machines::{Delta, FlatDelta, Machine, SimilarStewart, Stewart};

pub type OfDelta = Setup<10, 22, 21, 6, 18, 3>;
/// A Stewart platform in a state.
pub type OfStewart = Setup<13, 25, 24, 6, 18, 6>;

/// Factors of the angles of the cranks, so that nothing is symmetric.
const SIDES: [f64; 3] = [1.0, 1.25, 0.75];

fn delta<T: LoopRobot<10, 22, 21, 6, 18, 3>>(
    name: &'static str,
    cranks: [f64; 3],
    rods: [f64; 3],
    height: f64,
) -> OfDelta {
    let mut start = State { qd: [0.0; 21], qdd: [0.0; 21], ..State::at([0.0; 22]) };
    (start.q[3], start.q[6]) = (1.0, height);
    let motion = [[1.5, 4.0], [-1.0, 2.5], [2.0, -6.0]];
    for (side, [rate, accel]) in motion.into_iter().enumerate() {
        let first = 7 + 5 * side;
        start.q[first] = cranks[side];
        (start.q[first + 1], start.q[first + 3]) = (rods[side], rods[side]);
        (start.qd[first - 1], start.qdd[first - 1]) = (rate, accel);
    }
    Setup {
        case: 53,
        name,
        tree: T::MODEL,
        single: T::MODEL.to_f32(),
        loops: T::LOOPS,
        held: &[6, 11, 16],
        moving: Moving::Passive,
        starts: vec![start],
    }
}

/// The Deltas of which the oracle has results.
pub fn deltas() -> Vec<OfDelta> {
    let flat = |name, angle: f64| {
        let cranks = SIDES.map(|side| side * angle);
        // The rods are level but for as much as the cranks.
        let rods = cranks.map(|crank| FRAC_PI_2 - crank - 0.8 * angle);
        delta::<FlatDelta>(name, cranks, rods, -0.4 * angle)
    };
    // With all three arms stretched, the cranks are at 1.8037 rad.
    let stretched = [1.8125, 1.796875, 1.8046875];
    vec![
        delta::<Delta>("arms stretched", stretched, [-FRAC_PI_2; 3], -0.6328125),
        flat("rods 2⁻³ rad from coplanar", 0.125),
        flat("rods 2⁻⁵ rad from coplanar", 0.03125),
        flat("rods 2⁻¹⁰ rad from coplanar", 1.0 / 1024.0),
    ]
}

/// The Delta whose rods are in one plane, in numbers that close it but for rounding.
pub fn coplanar() -> OfDelta {
    delta::<FlatDelta>("rods coplanar", [0.0; 3], [FRAC_PI_2; 3], 0.0)
}

fn stewart<T: LoopRobot<13, 25, 24, 6, 18, 6>>(
    name: &'static str,
    yaw: f64,
    to: [f64; 3],
) -> OfStewart {
    let mut start = State { qd: [0.0; 24], qdd: [0.0; 24], ..State::at(Stewart::HOME) };
    (start.q[2], start.q[3]) = (0.5 * yaw).sin_cos();
    start.q[4..7].copy_from_slice(&to);
    start.qd[..6].copy_from_slice(&[0.5, -0.25, 0.75, 0.125, -0.5, 0.25]);
    start.qdd[..6].copy_from_slice(&[2.0, 1.5, -3.0, 4.0, -1.0, 2.5]);
    Setup {
        case: 54,
        name,
        tree: T::MODEL,
        single: T::MODEL.to_f32(),
        loops: T::LOOPS,
        held: &[0, 1, 2, 3, 4, 5],
        moving: Moving::All,
        starts: vec![start],
    }
}

pub fn stewarts() -> Vec<OfStewart> {
    let turned = |name, off: f64| stewart::<Stewart>(name, FRAC_PI_2 - off, [0.0, 0.0, 0.75]);
    let mut quarter = turned("turned by 90°", 0.0);
    let half = FRAC_PI_4.sin();
    (quarter.starts[0].q[2], quarter.starts[0].q[3]) = (half, half);
    let mut back = turned("turned by −90°", 0.0);
    (back.starts[0].q[2], back.starts[0].q[3]) = (-half, half);
    vec![
        turned("2⁻³ rad from 90°", 0.125),
        turned("2⁻⁵ rad from 90°", 1.0 / 32.0),
        turned("2⁻¹⁰ rad from 90°", 1.0 / 1024.0),
        quarter,
        back,
        stewart::<SimilarStewart>("platform similar to the base", 0.25, [0.0625, -0.125, 0.75]),
    ]
}
