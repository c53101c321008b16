//! A person who guides the arm: smooth motions of the tip with a tremor of the hand, and encoders with noise.

use core::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::cell::{Cell, Setup, TICK, config};
use crate::plant::{Hand, Inertias, Q};

pub const START: Q = [0.0, -1.57, 1.57, -1.57, -1.57, 0.0];
/// The place of the tip from its start, m, and the time of each motion, s.
const STOPS: [(DVec3, f64); 4] = [
    (DVec3::new(0.05, 0.30, 0.10), 3.0),
    (DVec3::new(-0.20, 0.25, -0.10), 2.5),
    (DVec3::new(-0.15, -0.20, 0.05), 3.0),
    (DVec3::new(0.10, -0.25, 0.20), 2.5),
];
/// Of the hand, m and Hz.
const TREMOR: [(f64, f64); 3] = [(0.8e-3, 8.7), (0.6e-3, 9.6), (0.7e-3, 11.3)];
/// A step of an encoder of 14 bits, rad; its noise is uniform and as large.
const STEP: f64 = TAU / 16_384.0;

/// What the joints were, and what the encoders measured, in each tick.
pub struct Guided {
    pub exact: Vec<Q>,
    pub measured: Vec<Q>,
}

/// The velocity of the hand at a time, m/s: from stop to stop by minimum jerk, so that it slows down at each of them.
fn velocity(t: f64, tremor: f64) -> DVec3 {
    let (mut from, mut begin, mut velocity) = (DVec3::ZERO, 0.0, DVec3::ZERO);
    for (to, seconds) in STOPS {
        let x = (t - begin) / seconds;
        if (0.0..1.0).contains(&x) {
            velocity = (to - from) * (30.0 * x * x * (1.0 - x) * (1.0 - x) / seconds);
        }
        (from, begin) = (to, begin + seconds);
    }
    let end = begin;
    let shake = TREMOR.map(|(size, frequency)| {
        let omega = TAU * frequency;
        // It sets in and ends smoothly.
        let rise = (PI * t / end).sin().powi(2);
        tremor * rise * size * omega * (omega * t).cos()
    });
    velocity + DVec3::from(shake)
}

/// A person who guides the arm; the tremor as a share of the usual one.
pub fn guide(tremor: f64) -> Guided {
    let setup = Setup {
        config: config(0.1, 0.87),
        over: 0.0,
        inertias: Inertias::All(0.0),
        gravity_error: 0.03,
    };
    let mut cell = Cell::new(START, &setup);
    let (mut place, mut random) = (cell.tip(), 0x1357_9bdf_u32);
    let mut guided = Guided {
        exact: vec![],
        measured: vec![],
    };
    let seconds: f64 = STOPS.iter().map(|(_, seconds)| seconds).sum();
    for tick in 0..(seconds / TICK) as u32 {
        let velocity = velocity(f64::from(tick) * TICK, tremor);
        cell.hand = Hand::Lead(place, velocity);
        cell.tick();
        place += TICK * velocity;
        guided.exact.push(cell.at.q);
        guided.measured.push(cell.at.q.map(|q| {
            random ^= random << 13;
            random ^= random >> 17;
            random ^= random << 5;
            let noise = f64::from(random) / f64::from(u32::MAX) * 2.0 - 1.0;
            ((q + STEP * noise) / STEP).round() * STEP
        }));
    }
    guided
}
