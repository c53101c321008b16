//! Time: encoders that wrap, ticks that come late or not at all, a day of ticks, a drive at its
//! limit.

use super::day::day;
use super::name;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use host_tests::controller::{Bench, TICK};
use host_tests::hard::{Case, Row};
use host_tests::measured::larger;
use joint_drivers::{JointMapping, JointRange, MultiTurnEncoder};
use motion_control::limits::{Mode, SafetyLimits};
use motion_control::motion::{CurrentTick, MotionController, MotionControllerConfig};
use motion_control::safety::SupervisorConfig;

pub const CASES: &[Case] = &[
    Case {
        number: 38,
        name: "encoder wrap 2π → 0",
        parameters: "14 bits, 2 rad/s, 10 s in steps of 1 ms in both directions, observer of 250 \
            rad/s",
        source: "single-turn encoders; their difference would be a velocity of −6283 rad/s",
        oracle: "the true velocity",
        reason: "an encoder's step Δ changes the velocity by ω² h Δ, 0.024 rad/s: twice that",
        run: wrap,
    },
    Case {
        number: 39,
        name: "tick jitter and missed ticks",
        parameters: "UR5e in motion; 200 ticks late by up to this multiple of a tick; 1, 2, 5, 10, \
            50 missed ticks",
        source: "interrupts delayed by a busy bus; laws that divide by a measured interval",
        oracle: "the limits; the tracking error without jitter",
        reason: "no interval divides anything. Missed ticks are counted, and the observer \
            continues without measurement: less than a tick and the delay remain, and decay with \
            the poles of the loop (a tenth after 196 ticks, a hundredth after 306)",
        run: jitter,
    },
    Case {
        number: 40,
        name: "24 h of ticks",
        parameters: "a motion after 86.4 million ticks of rest; 86.4 million ticks of an observer",
        source: "t += 0.001 in f32 stops at 32,768 s",
        oracle: "the motion without the rest; an observer that has just started",
        reason: "integers count the time: the same bits. An observer has the rounding error of its \
            last ticks, ε and ω ε",
        run: day,
    },
];

fn wrap() -> Vec<Row> {
    const COUNTS: f64 = 16_384.0;
    fn run<R: Real>(rows: &mut Vec<Row>, direction: f64) {
        let near = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 3.0 * TICK as f32);
        let near = near.expect("a joint that is slower than its encoder");
        let (mut counter, of) = (MultiTurnEncoder::<14>::new(near), R::from_f64);
        let limits = SafetyLimits {
            torque: [R::ONE],
            rate: [R::ONE],
            speed: [of(3.0)],
            lower: [of(-100.0)],
            upper: [of(100.0)],
        };
        let config = MotionControllerConfig {
            supervisor: SupervisorConfig {
                limits,
                tick: of(TICK),
                resolution: R::ZERO,
                ride_through_ticks: 0,
                hold_ticks: 20,
                reentry_ticks: 50,
            },
            observer_bandwidth: of(250.0),
            decay_rate: of(25.0),
            restart_distance: R::ZERO,
        };
        let mut controller = MotionController::<R, 1, CurrentTick>::new(config);
        let (mut worst, mut full, mut naive, mut last) = (0.0_f64, true, 0.0_f64, 0.0);
        for tick in 0..10_000 {
            let turns = f64::from(tick) * (2.0 / std::f64::consts::TAU * TICK) * direction;
            let raw = (turns * COUNTS).round() as i32 & 0x3fff;
            full &= counter.update(raw as u16).is_ok();
            let q = [counter.angle()];
            let status = controller.tick(Ok(&q), &State::at(q), |_, _| [R::ZERO]).status;
            full &= status.mode == Mode::Full;
            let qd = controller.estimate().qd;
            let angle = f64::from(raw) / COUNTS * std::f64::consts::TAU;
            if tick >= 200 {
                worst = larger(worst, (qd[0].to_f64() - 2.0 * direction).abs());
                naive = larger(naive, ((angle - last) / TICK).abs());
            }
            last = angle;
        }
        let step = std::f64::consts::TAU / COUNTS;
        let bound = 2.0 * 250.0 * 250.0 * TICK * step;
        let turned = counter.turns() == if direction > 0.0 { 3 } else { -4 };
        rows.push(Row::stated(
            format!("velocity at {} rad/s", 2.0 * direction),
            name::<R>(),
            worst,
            bound,
        ));
        rows.push(Row::claim("no fault, and the turns are counted", name::<R>(), full && turned));
        rows.push(Row::naive("a difference of angles, rad/s", name::<R>(), naive, bound));
    }
    let mut rows = Vec::new();
    for direction in [1.0, -1.0] {
        run::<f32>(&mut rows, direction);
        run::<f64>(&mut rows, direction);
    }
    rows
}

/// An arm in motion whose ticks go wrong from 300 on: the greatest
/// share of the torque allowed, the worst tracking error, and how many ticks after it was over the
/// error was beyond `settled` for the last time.
fn disturbed<R: Real>(
    settled: f64,
    wrong: impl FnOnce(&mut Bench<R>, &mut dyn FnMut(&Bench<R>)),
) -> [f64; 3] {
    let mut bench = Bench::<R>::new(0.8, 1000);
    let mut measured = [0.0_f64; 3];
    for _ in 0..300 {
        bench.tick(None);
        bench.advance(TICK);
    }
    wrong(&mut bench, &mut |bench| {
        measured = [larger(measured[0], bench.effort()), larger(measured[1], bench.error()), 0.0];
    });
    if bench.mode() == Mode::Stopped {
        bench.tick(None);
        bench.reset().expect("an arm that is stopped and measured");
    }
    for tick in 0..1000 {
        bench.tick(None);
        let error = bench.error();
        measured = [larger(measured[0], bench.effort()), larger(measured[1], error), measured[2]];
        if error > settled || bench.arm.q.iter().any(|q| !q.is_finite()) {
            measured[2] = f64::from(tick + 1);
        }
        bench.advance(TICK);
    }
    measured
}

/// 200 ticks, each late by up to this many ticks; a timer that counts tells how many were missed,
/// or nobody does.
fn lates<R: Real>(bench: &mut Bench<R>, see: &mut dyn FnMut(&Bench<R>), late: f64, counted: bool) {
    // Marsaglia's xorshift32, 2003.
    let (mut random, mut time, mut count) = (0x5eed_1234_u32, 0.0_f64, 0);
    for _ in 0..200 {
        let now = time.floor() as u32;
        let missed = (now - count).saturating_sub(1);
        bench.late_tick(if counted { missed } else { 0 });
        count = now;
        see(bench);
        random ^= random << 13;
        random ^= random >> 17;
        random ^= random << 5;
        let ticks = 1.0 + late * f64::from(random) / 4_294_967_296.0;
        time += ticks;
        bench.advance(TICK * ticks);
    }
}

fn jitter() -> Vec<Row> {
    fn run<R: Real>(rows: &mut Vec<Row>) {
        let settled = 1e-3;
        let mut push = |what: &str, [effort, off, back]: [f64; 3], [most, ticks]: [f64; 2]| {
            rows.push(Row::stated(
                format!("{what}: torque, of what is allowed"),
                name::<R>(),
                effort,
                1.0,
            ));
            rows.push(Row::stated(format!("{what}: off at most, rad"), name::<R>(), off, most));
            rows.push(Row::stated(
                format!("{what}: ticks till it tracks within 1 mrad"),
                name::<R>(),
                back,
                ticks,
            ));
        };
        for (late, most, ticks) in [
            (0.0, 1e-4, 0.0),
            (0.5, 5e-3, 196.0),
            (1.0, 5e-3, 196.0),
            (2.0, 5e-3, 196.0),
            (10.0, 5e-2, 400.0),
        ] {
            let measured = disturbed::<R>(settled, |bench, see| lates(bench, see, late, true));
            push(&format!("jitter {late} ×"), measured, [most, ticks]);
        }
        for missed in [1, 2, 5, 10, 50] {
            let measured = disturbed::<R>(settled, |bench, see| {
                bench.tick(None);
                bench.advance(TICK * f64::from(missed + 1));
                bench.late_tick(missed);
                see(bench);
                bench.advance(TICK);
            });
            push(&format!("{missed} ticks missed"), measured, [5e-3, 196.0]);
        }
        let [_, thrown, _] = disturbed::<R>(settled, |bench, see| lates(bench, see, 10.0, false));
        rows.push(Row::naive(
            "jitter 10 ×, missed ticks not counted: off, rad",
            name::<R>(),
            thrown,
            0.1,
        ));
    }
    let mut rows = Vec::new();
    run::<f32>(&mut rows);
    run::<f64>(&mut rows);
    rows
}
