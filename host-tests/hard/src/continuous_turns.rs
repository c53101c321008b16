//! A drive at its limit: nothing winds up.

use super::name;
use dynamics_core::scalar::Real;
use host_tests::controller::{Bench, TICK};
use host_tests::hard::{Case, Row};
use host_tests::measured::larger;

pub const CASES: &[Case] = &[Case {
    number: 41,
    name: "saturation without wind-up",
    parameters: "UR5e blocked for 100 … 6400 ticks, 0.11 rad from its reference, torques at their \
        limits; then released",
    source: "integrators that wind up at a limit: Åström & Hägglund (1995), section 3.5",
    oracle: "the same recovery after any time at the limit, without overshoot: the poles are \
        critically damped",
    reason: "no integrator: the same bits after any time in which the observer has settled (400 \
        ticks)",
    run: saturation,
}];

/// The distance from the reference, rad.
const HELD_OFF: f64 = 0.11;

/// An arm that was held fast for this many ticks: the greatest share of its torque while it was,
/// ticks till it is within 1 mrad for good, overshoot of the return, and where it is a second
/// after.
fn recover<R: Real>(held: u32) -> ([f64; 3], [R; 6]) {
    let mut bench = Bench::<R>::new(0.0, 1);
    let off = R::from_f64(HELD_OFF);
    bench.arm.q = bench.arm.q.map(|q| q + off);
    let (fast, mut measured) = (bench.arm, [0.0_f64; 3]);
    for _ in 0..held {
        bench.tick(None);
        measured[0] = larger(measured[0], bench.effort());
        bench.arm = fast;
    }
    for tick in 1..=1000 {
        bench.tick(None);
        bench.advance(TICK);
        if bench.error() > 1e-3 {
            measured[1] = f64::from(tick);
        }
        let beyond = |(aim, q): (&R, &R)| (aim.to_f64() - q.to_f64()) / HELD_OFF;
        measured[2] = bench.aim.q.iter().zip(&bench.arm.q).map(beyond).fold(measured[2], larger);
    }
    (measured, bench.arm.q)
}

/// The overshoot of a joint of 1 kg·m² under the same poles, limited to 30 N·m, and an integrator.
fn wound_up(held: u32) -> f64 {
    let (mut q, mut qd, mut sum, mut beyond) = (HELD_OFF, 0.0_f64, 0.0, 0.0_f64);
    for tick in 0..held + 3000 {
        sum -= q * TICK;
        let tau = (-625.0 * q - 50.0 * qd + 2000.0 * sum).clamp(-30.0, 30.0);
        if tick >= held {
            qd += TICK * tau;
            q += TICK * qd;
        }
        beyond = larger(beyond, -q / HELD_OFF);
    }
    beyond
}

fn saturation() -> Vec<Row> {
    const OVERSHOOT: f64 = 0.05;
    fn run<R: Real>(rows: &mut Vec<Row>) {
        let (first, place) = recover::<R>(400);
        rows.push(Row::claim(
            "a torque is at its limit while the arm is held",
            name::<R>(),
            first[0] > 0.999,
        ));
        rows.push(Row::measured("ticks till within 1 mrad", name::<R>(), first[1], 400.0));
        rows.push(Row::stated("overshoot", name::<R>(), first[2], OVERSHOOT));
        let same =
            [1600, 6400].map(recover::<R>).iter().all(|other| (other.0, other.1) == (first, place));
        rows.push(Row::claim(
            "after 1600 and 6400 ticks at the limit: the same bits",
            name::<R>(),
            same,
        ));
        let soon = (recover::<R>(100).0[1] - first[1]).abs();
        rows.push(Row::stated(
            "after 100 ticks at the limit: ticks more or less",
            name::<R>(),
            soon,
            1.0,
        ));
    }
    let mut rows = Vec::new();
    run::<f32>(&mut rows);
    run::<f64>(&mut rows);
    rows.push(Row::naive(
        "an integrator, overshoot after 400 ticks",
        "f64",
        wound_up(400),
        OVERSHOOT,
    ));
    rows.push(Row::naive(
        "an integrator, overshoot after 6400 ticks",
        "f64",
        wound_up(6400),
        OVERSHOOT,
    ));
    rows
}
