//! The control loop in the documentation of `motion_control`, on a simulated arm: it keeps what the
//! firmware's loop promises.

use dynamics_core::model::Static;
use dynamics_core::robots::Ur5e;
use dynamics_core::sim::linearly_implicit;
use dynamics_core::state::State;
use firmware_demo::scene::Scene;
use firmware_demo::scenes::ur5e::PickAndPlace;
use host_tests::measured::{largest, within};
use motion_control::limits::{Fault, Mode, SafetyLimits};

#[path = "../../motion-control/src/example.rs"]
mod example;

use example::{EFFECTS, HOLD, OMEGA_N, REENTRY, RIDE_THROUGH as RIDE, TICK};

/// The fastest moment of the trajectory: 1.9 rad/s.
const FAST: u32 = 3200;
const STEPS: u32 = 4;

/// The effect of some ticks without measurements on the arm.
struct Outcome {
    /// The largest error of a joint against the reference, rad.
    error: f64,
    /// The most that a joint that moved one way moved back, rad/s.
    reversal: f64,
    /// Ticks until the error stays below 1 mrad on the trajectory.
    back: u32,
    /// The largest speed of a joint at the fault's begin and end, rad/s.
    speeds: [f64; 2],
}

/// The arm on its way, without measurements for `lost` ticks from the tick `at` on.
fn lost_frames(at: u32, lost: u32) -> Outcome {
    let limits = SafetyLimits::from(PickAndPlace::LIMITS).with_rate_share(0.5);
    let way = PickAndPlace::reference().unwrap();
    let mut arm = State::at(way.at(0).q);
    let mut controller = example::controller(limits).unwrap();
    let gains = example::gains(&arm.q);
    let mut before = arm.q;
    let mut step = |arm: &mut State<f32, 6, 6>, measured: bool| {
        let fault = Fault::Encoder { joint: 0 };
        let measured = if measured { Ok(&before) } else { Err(fault) };
        let mut followed = [0.0; 6];
        let command = controller.tick(measured, &way, |reference, estimate| {
            followed = reference.q;
            example::law(&gains, reference, estimate)
        });
        before = arm.q;
        let apart = |(r, q): (&f32, &f32)| (r - q).abs();
        let error = largest(followed.iter().zip(&arm.q).map(apart));
        for _ in 0..STEPS {
            let h = TICK / STEPS as f32;
            linearly_implicit(&Static::<Ur5e>::NEW, arm, &command.torque, &mut { EFFECTS }, h)
                .unwrap();
        }
        (error, command)
    };
    for _ in 0..at {
        let (error, command) = step(&mut arm, true);
        assert!(error < 1e-3 && command.status.fault.is_none());
    }
    let moving: Vec<_> = (0..6).filter(|&j| arm.qd[j].abs() > 0.3).collect();
    let direction = arm.qd.map(f32::signum);
    let (mut errors, mut reversals, mut back) = (vec![], vec![], 0);
    let mut speeds = [largest(arm.qd.map(f32::abs)), f64::NAN];
    for tick in 0..lost + REENTRY + 200 {
        let (error, command) = step(&mut arm, tick >= lost);
        let mode = match tick {
            _ if tick < RIDE.min(lost) => Mode::Full,
            _ if tick < lost => Mode::Hold,
            _ => Mode::Full,
        };
        assert_eq!(command.status.mode, mode, "{tick}: {:?}", command.status);
        errors.push(error);
        if tick < lost + REENTRY {
            reversals.extend(moving.iter().map(|&j| -arm.qd[j] * direction[j]));
        }
        if tick + 1 == lost {
            speeds[1] = largest(arm.qd.map(f32::abs));
        }
        if tick >= lost && error > 1e-3 {
            back = tick - lost + 1;
        }
    }
    Outcome { error: largest(errors), reversal: largest(reversals), back, speeds }
}

// No joint turns back.
#[test]
fn the_documented_loop_stops_and_resumes_a_fast_arm() {
    let mut back = vec![];
    for (lost, bound) in [(20, 1e-3), (50, 2e-3), (100, 4e-3), (RIDE + HOLD, 4e-3)] {
        let held = lost_frames(FAST, lost);
        within(&format!("error after {lost}, rad"), held.error, bound);
        assert!(held.reversal < 0.0, "{lost}: {} rad/s", held.reversal);
        // q̈ = −λ q̇ from the tick on that is not ridden through.
        let decay = (-f64::from((lost - RIDE) as f32 * OMEGA_N * TICK)).exp();
        let [fast, slow] = held.speeds;
        within(&format!("speed after {lost}, rad/s"), slow, 1.1 * fast * decay);
        back.push(held.back);
    }
    within("ticks until back", largest(back), 100.0);
}
