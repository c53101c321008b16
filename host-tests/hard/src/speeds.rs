//! Large speeds and angles.

use super::measure::{ErrorBounds, against_oracle, by_joints};
use super::setup::list::arm;
use super::setup::turning;
use dynamics_core::algorithms::rnea;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use fixtures::hard::{N, counts, scene};
use host_tests::hard::{Case, Row};
use joint_drivers::{JointMapping, JointRange, MultiTurnEncoder};
use motion_control::limits::{Fault, SafetyLimits};
use motion_control::motion::{MotionController, MotionControllerConfig};
use motion_control::safety::SupervisorConfig;

const ORACLE: &str = "computation in 50 digits from the same f32 bits (oracle/hard.py)";

pub const CASES: &[Case] = &[
    Case {
        number: 15,
        name: "1000 rad/s",
        parameters: "UR5e, every joint at ±1000 rad/s, accelerations up to 10⁶ rad/s²",
        source: "spindles and rotors as joints; a simulation that diverges",
        oracle: ORACLE,
        reason: "velocity products are homogeneous of degree two: no magnitude of q̇ loses digits \
            short of an overflow",
        run: || against_oracle(&arm(15, "1000 rad/s"), &FAST),
    },
    Case {
        number: 16,
        name: "a million rad",
        parameters: "UR5e, every joint at ±10⁶ rad (6.5·10⁸ counts of 12 bits), where adjacent f32 \
            numbers differ by 1/16 rad",
        source: "a continuous joint that has turned for a day",
        oracle: "50 digits at the counts modulo whole turns",
        reason: "a supervisor without position limits rejects angles that f32 cannot reduce; \
            integers subtract whole turns without losing a digit",
        run: million,
    },
    Case {
        number: 17,
        name: "quarter turns ± 1 ulp",
        parameters: "UR5e, joints at k π/2 rounded to f32 and at the two adjacent f32 numbers, |k| \
            ≤ 5",
        source: "Cody & Waite (1980): argument reduction loses all digits there if π/2 has too few",
        oracle: ORACLE,
        reason: "the error of sine and cosine is at most 10⁻⁷, as at any angle",
        run: || against_oracle(&arm(17, "k π/2 ± 1 ulp"), &QUARTERS),
    },
];

fn million() -> Vec<Row> {
    let setup = arm(16, "remainder of 10⁶ rad");
    let mut rows = against_oracle(&setup, &REMAINDERS);

    let counters: [[MultiTurnEncoder<12>; N]; 4] =
        std::array::from_fn(|k| std::array::from_fn(|i| counter(counts(k, i))));
    let far = counters.map(|counters| counters.map(|counter| counter.angle()));
    let same = setup.states.iter().enumerate().all(|(k, state)| {
        let joints = state.q.iter().enumerate();
        joints.into_iter().all(|(i, q)| counters[k][i].within_turn::<f32>() == *q)
    });
    rows.push(Row::claim("encoder: the remainder, to the bit", "f32", same));
    rows.push(Row::claim("gate without limits: out of range", "f32", refused(1e6_f32)));
    rows.push(Row::claim("gate without limits: out of range", "f64", refused(1e6_f64)));

    let truth = setup.truth();
    let scene = scene(&setup.extras);
    let found = far.iter().zip(&setup.states).map(|(q, state)| {
        let state = State { q: *q, ..*state };
        Ok(rnea(&turning(&setup.single), &state, &scene))
    });
    let error = by_joints(found, &truth.states, |t| Some(&t.rnea));
    let name = "naive: RNEA at the whole angle";
    rows.push(Row::naive(name, "f32", error, REMAINDERS.single[0]));
    rows
}

/// An encoder that has counted so far.
fn counter(counts: i32) -> MultiTurnEncoder<12> {
    let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 3e-3);
    let mut counter = MultiTurnEncoder::new(mapping.expect("slower than its encoder"));
    // Less than half a turn from one reading to the next.
    for count in (0..counts.abs()).step_by(2047).chain([counts.abs()]) {
        let _ = counter.update(((count * counts.signum()) & 0xfff) as u16);
    }
    counter
}

/// Whether a gate of a joint without limits refuses a position as out of bounds.
fn refused<R: Real>(q: R) -> bool {
    let (far, some) = (R::ONE / R::ZERO, R::from_f64(100.0));
    let limits =
        SafetyLimits { torque: [some], rate: [some], speed: [some], lower: [-far], upper: [far] };
    let mut controller = MotionController::<R, 1>::new(MotionControllerConfig {
        supervisor: SupervisorConfig {
            limits,
            tick: R::from_f64(1e-3),
            resolution: R::ZERO,
            ride_through_ticks: 0,
            hold_ticks: 1,
            reentry_ticks: 4,
        },
        observer_bandwidth: some,
        decay_rate: some,
        restart_distance: R::ZERO,
    });
    let command = controller.tick(Ok(&[q]), &State::at([q]), |_, _| [R::ZERO]);
    command.status.fault == Some(Fault::Position { joint: 0 })
}

const FAST: ErrorBounds = ErrorBounds {
    single: [5e-7, 6e-6, 5e-6, 6e-7, 4e-7],
    double: [2e-15, 6e-15, 1e-14, 6e-16, 6e-16],
};

const REMAINDERS: ErrorBounds = ErrorBounds {
    single: [5e-7, 5e-6, 4e-6, 5e-7, 4e-7],
    double: [5e-16, 8e-15, 6e-15, 8e-16, 8e-16],
};

const QUARTERS: ErrorBounds = ErrorBounds {
    single: [2e-7, 3e-6, 3e-6, 3e-7, 3e-7],
    double: [8e-16, 4e-15, 3e-15, 5e-16, 8e-16],
};
