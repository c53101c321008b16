//! A person who guides the arm: smooth motions of the tip with a tremor of the hand, and encoders
//! with noise.

use core::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::hand_guiding::cell::{Cell, Setup, TICK, config};
use crate::hand_guiding::plant::{Hand, Inertias, Q};

pub const START: Q = [0.0, -1.57, 1.57, -1.57, -1.57, 0.0];
/// The time of the motion, s.
const SECONDS: f64 = 10.0;
/// Tremor of the hand, m and Hz.
const TREMOR: [(f64, f64); 3] = [(0.8e-3, 8.7), (0.6e-3, 9.6), (0.7e-3, 11.3)];
/// A step of an encoder of 14 bits, rad; its noise is uniform and as large.
pub const STEP: f64 = TAU / 16_384.0;

/// The velocity of the hand at a time, m/s: once along a bent eight, slower at both ends.
fn velocity(t: f64, tremor: f64) -> DVec3 {
    let x = t / SECONDS;
    let phase = TAU * x * x * x * (10.0 - 15.0 * x + 6.0 * x * x);
    let rate = TAU * 30.0 * x * x * (1.0 - x) * (1.0 - x) / SECONDS;
    let slope = DVec3::new(-0.10 * phase.sin(), 0.30 * phase.cos(), 0.24 * (2.0 * phase).cos());
    let shake = TREMOR.map(|(size, frequency)| {
        let omega = TAU * frequency;
        // It sets in and ends smoothly.
        let rise = (PI * x).sin().powi(2);
        tremor * rise * size * omega * (omega * t).cos()
    });
    rate * slope + DVec3::from(shake)
}

/// The positions in each tick of an arm that a person guides; the tremor as a share of the usual
/// one.
pub fn guide(tremor: f64) -> Vec<Q> {
    let setup = Setup {
        config: config(0.1, 0.87),
        over: 0.0,
        inertias: Inertias::All(0.0),
        gravity_error: 0.03,
    };
    let mut cell = Cell::new(START, &setup);
    let mut place = cell.tip();
    let ticks = 0..(SECONDS / TICK) as u32;
    let positions = ticks.map(|tick| {
        let velocity = velocity(f64::from(tick) * TICK, tremor);
        cell.hand = Hand::Lead(place, velocity);
        cell.tick();
        place += TICK * velocity;
        cell.at.q
    });
    positions.collect()
}

/// The measurement of encoders with noise.
pub fn measured(positions: &[Q]) -> Vec<Q> {
    let mut random = 0x1357_9bdf_u32;
    let mut measure = |q: f64| {
        random ^= random << 13;
        random ^= random >> 17;
        random ^= random << 5;
        let noise = f64::from(random) / f64::from(u32::MAX) * 2.0 - 1.0;
        ((q + STEP * noise) / STEP).round() * STEP
    };
    positions.iter().map(|q| q.map(&mut measure)).collect()
}

/// The same motion with a tremor of 1 mrad in each joint.
pub fn shaken(positions: &[Q]) -> Vec<Q> {
    let shake = |(tick, q): (usize, &Q)| {
        let t = tick as f64 * TICK;
        core::array::from_fn(|j| q[j] + 1e-3 * (TAU * (8.5 + 0.6 * j as f64) * t).sin())
    };
    positions.iter().enumerate().map(shake).collect()
}
