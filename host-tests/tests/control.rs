//! Claims about the control layer as a whole: the command that reaches the drive, the memory, and
//! the error for a way-point beyond the limits.

use dynamics_core::Core;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use motion_control::estimate::{Estimate, Observer, ObserverConfig};
use motion_control::law::{Gains, feedback};
use motion_control::limits::{Fault, Mode, MotionLimits, SafetyLimits};
use motion_control::motion::{MotionController, MotionControllerConfig};
use motion_control::reference::{Trajectory, TrajectoryError, WayPoint};
use motion_control::safety::SupervisorConfig;
use proptest::prelude::*;

const TICK: f32 = 1e-3;
const HOLD: u32 = 20;
const REENTRY: u32 = 50;
const HOME: [f32; 6] = [0.0, -1.57, 1.57, -1.57, -1.57, 0.0];
const LIMITS: SafetyLimits<f32, 6> = SafetyLimits {
    torque: [150.0, 150.0, 150.0, 28.0, 28.0, 28.0],
    rate: [75.0, 75.0, 75.0, 14.0, 14.0, 14.0],
    speed: [3.2; 6],
    lower: [-6.3; 6],
    upper: [6.3; 6],
};

/// A controller of an arm within these limits that rides through this many ticks.
fn controller(limits: SafetyLimits<f32, 6>, ride_through_ticks: u32) -> MotionController<f32, 6> {
    MotionController::new(MotionControllerConfig {
        supervisor: SupervisorConfig {
            limits,
            tick: TICK,
            resolution: 0.0,
            ride_through_ticks,
            hold_ticks: HOLD,
            reentry_ticks: REENTRY,
        },
        observer_bandwidth: 250.0,
        decay_rate: 25.0,
        restart_distance: 0.1,
    })
}

fn observer() -> Observer<f32, 6> {
    Observer::new(ObserverConfig { bandwidth: 250.0, tick: TICK })
}

/// Any bits: NaN, infinities and subnormals among them.
fn any_bits() -> impl Strategy<Value = f32> {
    prop_oneof![
        any::<u32>().prop_map(f32::from_bits),
        -7.0_f32..7.0,
        Just(f32::NAN),
        Just(f32::INFINITY),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_wild_measurement_passes_the_gate(
        ticks in prop::collection::vec((prop::array::uniform6(any_bits()), 0..4_u8), 1..60),
    ) {
        let mut controller = controller(LIMITS, 5);
        for (q, kind) in ticks {
            let measured = match kind {
                0 => Ok(&q),
                1 => Err(Fault::Stale),
                _ => Ok(&HOME),
            };
            let command = controller.tick(measured, &State::at(HOME), |_, _| [1.0; 6]);
            let estimate = controller.estimate();
            prop_assert!(estimate.qd.iter().chain(&estimate.q).all(|x| x.is_finite()));
            let inside = measured.is_ok_and(|q| q.iter().all(|q| q.abs() <= 6.3));
            prop_assert!(inside || command.status.fault.is_some());
            let stopped = command.status.mode == Mode::Stopped;
            prop_assert!(!stopped || (command.brake && command.torque == [0.0; 6]));
        }
    }

    #[test]
    fn no_wild_torque_passes_the_limits(
        ticks in prop::collection::vec(prop::array::uniform6(any_bits()), 1..60),
        bounds in prop::array::uniform4(any_bits()),
        wild in any::<bool>(),
    ) {
        let [torque, rate, speed, upper] = bounds.map(|x| [x; 6]);
        let lower = upper.map(|x| -x);
        let limits = if wild { SafetyLimits { torque, rate, speed, lower, upper } } else { LIMITS };
        let mut controller = controller(limits, 0);
        let mut last = [0.0; 6];
        for tau in ticks {
            let command = controller.tick(Ok(&[0.0; 6]), &State::at([0.0; 6]), |_, _| tau);
            let whole = tau.iter().all(|tau| tau.is_finite());
            let mode = command.status.mode;
            let (stopped, held) = (mode == Mode::Stopped, mode == Mode::Hold);
            let blamed = matches!(command.status.fault, Some(Fault::Torque { .. }));
            // A hold may answer a torque of the tick before.
            prop_assert!(stopped || held || !(whole && blamed));
            prop_assert!(whole || command.status.fault.is_some());
            prop_assert!(whole || command.torque == last || command.torque == [0.0; 6]);
            for (j, (&out, last)) in command.torque.iter().zip(&mut last).enumerate() {
                prop_assert!(out.is_finite() && (out == 0.0 || out.abs() <= limits.torque[j]));
                if whole && !stopped {
                    // The bounds are sums in f32, rounded.
                    let (now, before) = (f64::from(out), f64::from(*last));
                    let slack = f64::from(f32::EPSILON) * now.abs().max(before.abs());
                    let change = (now - before).abs();
                    prop_assert!(change == 0.0 || change <= f64::from(limits.rate[j]) + slack);
                }
                *last = out;
            }
        }
    }
}

#[test]
fn a_rejected_torque_is_never_remembered() {
    let mut controller = controller(LIMITS, 5);
    for tau in [[70.0; 6], [f32::NAN; 6], [1.0, 1.0, 1.0, 1.0, 1.0, f32::INFINITY]] {
        controller.tick(Ok(&HOME), &State::at(HOME), |_, _| tau);
    }
    let command = controller.tick(Ok(&HOME), &State::at(HOME), |_, _| [-150.0; 6]);
    assert_eq!(command.torque, [-5.0, -5.0, -5.0, 0.0, 0.0, 0.0]);
}

#[test]
fn the_same_inputs_after_a_fault_give_the_same_bits() {
    let gains = Gains::from_inertia(&[3.0, 3.0, 1.0, 0.3, 0.3, 0.3], 25.0, 1.0);
    let law = |tick: u32| {
        let x = tick as f32 * 1e-3;
        let reference = State {
            q: HOME.map(|q| q + x),
            qd: [0.1, -0.2, 0.3, -0.1, 0.2, -0.3],
            qdd: [x, 1.0, -x, 0.5, 0.0, -0.0],
        };
        let mut tau = Core::<Ur5e>::rnea(&reference, &RIGID_BODY);
        let rest = Estimate { q: HOME, qd: [0.0; 6] };
        let pd = feedback(&gains, &reference, &rest);
        tau.iter_mut().zip(pd).for_each(|(tau, pd)| *tau += pd);
        tau
    };
    let [mut whole, mut hurt] = [(); 2].map(|()| controller(LIMITS, 0));
    for tick in 0..500 {
        let fault = (100..100 + HOLD).contains(&tick);
        let tau = law(tick);
        let a = whole.tick(Ok(&HOME), &State::at(HOME), |_, _| tau);
        let held = tau.map(|tau| 0.9 * tau);
        let measured = if fault { Err(Fault::Stale) } else { Ok(&HOME) };
        let answer = if fault { held } else { tau };
        let b = hurt.tick(measured, &State::at(HOME), |_, _| answer);
        assert_eq!(fault, b.status.mode == Mode::Hold);
        assert!(fault || bits(&a.torque) == bits(&b.torque), "tick {tick}");
    }
}

#[test]
fn the_observer_forgets_a_fault_but_for_rounding() {
    let [mut whole, mut hurt] = [(); 2].map(|()| observer());
    for tick in 0..500 {
        let q = HOME.map(|q| q + tick as f32 * 1e-3);
        let a = whole.update(&q, &[0.0; 6]);
        let b = if (100..120).contains(&tick) {
            hurt.update(&[f32::NAN; 6], &[0.0; 6])
        } else {
            hurt.update(&q, &[0.0; 6])
        };
        for (a, b) in a.qd.iter().zip(b.qd) {
            assert!(tick >= 100 || a.to_bits() == b.to_bits());
            assert!(tick < 250 || (a - b).abs() < 1e-4, "tick {tick}: {a} {b}");
        }
    }
}

#[test]
fn too_fast_way_points_name_joint_and_need() {
    let mut away = HOME;
    away[3] += 1.0;
    let way = |q, ticks| WayPoint { q, qd: [0.0; 6], ticks };
    let limits = [MotionLimits { velocity: 3.0_f32, acceleration: 20.0 }; 6];
    let new = |ticks| {
        let points = [way(HOME, 0), way(HOME, 100), way(away, ticks), way(HOME, 2000)];
        Trajectory::new(&points, TICK, &limits)
    };
    // A quintic from rest to rest peaks at 15/8 D/T and at 10/√3 D/T².
    assert!(new(700).is_ok());
    match new(600) {
        Err(TrajectoryError::Velocity { point: 2, joint: 3, needed, allowed }) => {
            assert!((needed - 1.875 / 0.6).abs() < 1e-5 && allowed == 3.0)
        }
        other => panic!("{other:?}"),
    }
    let slow = [MotionLimits { acceleration: 10.0, ..limits[0] }; 6];
    let points = [way(HOME, 0), way(away, 700)];
    let error = Trajectory::new(&points, TICK, &slow).unwrap_err();
    match error {
        TrajectoryError::Acceleration { point: 1, joint: 3, needed, allowed } => {
            assert!((needed - 10.0 / 3.0_f64.sqrt() / 0.49).abs() < 1e-4 && allowed == 10.0)
        }
        other => panic!("{other:?}"),
    }
    assert_eq!(
        error.to_string(),
        "way-point 1, joint 3: needs an acceleration of 11.7827, 10.0000 allowed"
    );
}

fn bits(x: &[f32; 6]) -> [u32; 6] {
    x.map(f32::to_bits)
}
