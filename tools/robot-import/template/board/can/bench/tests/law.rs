//! A law of your own on the simulated arm: here gravity and a damper, so that the arm hangs still.

use dynamics_core::effects::{Gravity, Inertia};
use dynamics_core::{Engine, state::State};
use joint_drivers::Law;
use motion_control::estimate::Estimate;
use motion_control::limits::Mode;

use crate::arm::{Bench, is_whole};
use crate::robot::board;
use crate::robot::control::Gains;
use crate::robot::say::Line;
use crate::robot::scene::{Arm, N, TICK, home};

struct Hang;

impl Law<N, (), Gains> for Hang {
    const ACCELERATES: bool = false;

    fn feedforward(reference: &State<f32, N, N>, (): &()) -> [f32; N] {
        Engine::<Arm>::rnea(reference, &(Gravity::EARTH, Inertia))
    }

    fn torque(gains: &Gains, _: &State<f32, N, N>, at: &Estimate<f32, N>, (): &()) -> [f32; N] {
        let qdd = core::array::from_fn(|joint| -gains.kd[joint] * at.qd[joint]);
        Self::feedforward(&State { q: at.q, qd: [0.0; N], qdd }, &())
    }
}

#[test]
fn the_arm_hangs_still_under_its_weight() {
    if !is_whole() {
        return;
    }
    // 1/s. The detectors would expect it to follow.
    let gains = Gains { kp: [0.0; N], kd: [10.0; N] };
    let mut bench = Bench::with(gains, |_| ());
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

#[test]
fn gains_that_are_far_too_high_are_named() {
    if !is_whole() {
        return;
    }
    let mut bench = Bench::with(Gains::new(2000.0, 1.0), board::detectors);
    bench.run(2.0, true);
    let is_it = |line: &Line| line.text.contains("gains too high");
    assert!(bench.lines.iter().any(is_it), "{:#?}", bench.said);
}
