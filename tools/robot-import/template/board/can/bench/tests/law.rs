//! A law of your own on the simulated arm: here gravity and a damper, so that the arm hangs still.

use dynamics_core::effects::Gravity;
use dynamics_core::{Engine, state::State};
use joint_drivers::Law;
use motion_control::estimate::Estimate;
use motion_control::law::Gains;
use motion_control::limits::Mode;

use crate::arm::{Bench, is_whole};
use crate::robot::board::{self, Motion};
use crate::robot::scene::{self, Arm, N, TICK, home};

struct Hang;

impl Law<N> for Hang {
    const ACCELERATES: bool = false;

    fn feedforward(reference: &State<f32, N, N>, (): &()) -> [f32; N] {
        Engine::<Arm>::rnea(reference, &Gravity::EARTH)
    }

    fn torque(
        gains: &Gains<f32, N>,
        _: &State<f32, N, N>,
        at: &Estimate<f32, N>,
        (): &(),
    ) -> [f32; N] {
        let gravity = Self::feedforward(&State::at(at.q), &());
        core::array::from_fn(|joint| gravity[joint] - gains.kd[joint] * at.qd[joint])
    }
}

#[test]
fn the_arm_hangs_still_under_its_weight() {
    if !is_whole() {
        return;
    }
    let motion = Box::leak(Box::new(Motion::REST));
    board::plan(motion).unwrap_or_else(|error| panic!("{error}"));
    // N·m·s/rad: a share of each joint's inertia, 1/s. The detectors would expect it to follow.
    let gains = Gains { kp: [0.0; N], kd: scene::inertia().map(|inertia| 10.0 * inertia) };
    let mut bench = Bench::with(motion, gains, ());
    // Where it is: the law does not pull there.
    let place = State::at(home());
    for tick in 0..(3.0 / TICK) as u32 {
        bench.tick::<Hang>(&place, tick < (1.0 / TICK) as u32);
    }
    let status = bench.status.expect("ticks");
    assert_eq!((status.mode, status.fault), (Mode::Full, None), "{:#?}", bench.said);
    for (q, home) in bench.state.q.iter().zip(home()) {
        assert!((q - home).abs() < 0.1, "{:?}", bench.state.q);
    }
}

/// The gains of the project are per inertia: in N·m·s/rad they are far too high.
#[test]
fn gains_in_another_unit_are_named() {
    if !is_whole() {
        return;
    }
    let motion = Box::leak(Box::new(Motion::REST));
    board::plan(motion).unwrap_or_else(|error| panic!("{error}"));
    let detectors = board::detectors(motion);
    let mut bench = Bench::with(motion, board::gains(), detectors);
    for _ in 0..(2.0 / TICK) as u32 {
        bench.tick::<Hang>(motion, true);
    }
    assert!(
        bench.lines.iter().any(|line| line.text.contains("in another unit")),
        "{:#?}",
        bench.said
    );
}
