//! Claims about the control layer as a whole: what reaches the drive, what is remembered, what a
//! way-point that asks too much is told.

use dynamics_core::Core;
use dynamics_core::control::{
    Bounds, Command, Estimate, Fault, Gains, Mode, Observer, Speed, Supervisor, Trajectory,
    TrajectoryError, TurnCounter, WayPoint, feedback,
};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use proptest::prelude::*;

const TICK: f32 = 1e-3;
const HOLD: u32 = 20;
const REENTRY: u32 = 50;
const HOME: [f32; 6] = [0.0, -1.57, 1.57, -1.57, -1.57, 0.0];
const BOUNDS: Bounds<f32, 6> = Bounds {
    torque: [150.0, 150.0, 150.0, 28.0, 28.0, 28.0],
    rate: [75.0, 75.0, 75.0, 14.0, 14.0, 14.0],
    speed: [3.2; 6],
    lower: [-6.3; 6],
    upper: [6.3; 6],
};

/// A control loop around the whole layer.
#[derive(Clone)]
struct Loop {
    supervisor: Supervisor<f32, 6>,
    observer: Observer<f32, 6>,
    gains: Gains<f32, 6>,
}

impl Loop {
    fn new() -> Self {
        Self {
            supervisor: Supervisor::new(BOUNDS, TICK, HOLD, REENTRY),
            observer: Observer::new(250.0, TICK),
            gains: Gains::from_inertia(&[3.0, 3.0, 1.0, 0.3, 0.3, 0.3], 25.0, 1.0),
        }
    }

    fn tick(
        &mut self,
        measured: Result<&[f32; 6], Fault>,
        reference: &State<f32, 6, 6>,
    ) -> (Command<f32, 6>, Estimate<f32, 6>) {
        let estimate = match self.supervisor.admit(measured) {
            Mode::Full => self
                .observer
                .update(self.supervisor.last_good(), &reference.qdd),
            _ => self.observer.predict(&[0.0; 6]),
        };
        let (aim, q, qd) = match self.supervisor.watch(&estimate.qd) {
            Mode::Full => (*reference, estimate.q, estimate.qd),
            _ => {
                let (q, fade) = (*self.supervisor.last_good(), self.supervisor.hold_fade());
                (State::at(q), q, estimate.qd.map(|qd| qd * fade))
            }
        };
        let mut tau = Core::<Ur5e>::rnea(&aim, &RIGID_BODY);
        for (tau, pd) in tau.iter_mut().zip(feedback(&self.gains, &aim, &q, &qd)) {
            *tau += pd;
        }
        (self.supervisor.pass(&tau), estimate)
    }
}

fn safe(command: &Command<f32, 6>) -> bool {
    let within = |(tau, bound): (&f32, &f32)| tau.abs() <= *bound;
    command.torque.iter().zip(&BOUNDS.torque).all(within)
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
    fn no_measurement_whatever_gets_past_the_limits(
        ticks in prop::collection::vec((prop::array::uniform6(any_bits()), 0..4_u8), 1..60),
    ) {
        let mut control = Loop::new();
        let reference = State::at(HOME);
        for (q, kind) in ticks {
            let measured = match kind {
                0 => Ok(&q),
                1 => Err(Fault::Stale),
                _ => Ok(&HOME),
            };
            let (command, estimate) = control.tick(measured, &reference);
            prop_assert!(safe(&command), "{command:?}");
            prop_assert!(estimate.qd.iter().chain(&estimate.q).all(|x| x.is_finite()));
            prop_assert!(control.supervisor.last_good().iter().all(|q| q.abs() <= 6.3));
            let stopped = command.status.mode == Mode::Stopped;
            prop_assert!(!stopped || (command.brake && command.torque == [0.0; 6]));
        }
    }

    #[test]
    fn no_torque_whatever_gets_past_the_limits(
        ticks in prop::collection::vec(prop::array::uniform6(any_bits()), 1..60),
        bounds in prop::array::uniform4(any_bits()),
        wild in any::<bool>(),
    ) {
        let [torque, rate, speed, upper] = bounds.map(|x| [x; 6]);
        let lower = upper.map(|x| -x);
        let bounds = if wild { Bounds { torque, rate, speed, lower, upper } } else { BOUNDS };
        let mut supervisor = Supervisor::new(bounds, TICK, HOLD, REENTRY);
        let mut last = [0.0; 6];
        for tau in ticks {
            supervisor.admit(Ok(&[0.0; 6]));
            let command = supervisor.pass(&tau);
            let whole = tau.iter().all(|tau| tau.is_finite());
            let stopped = command.status.mode == Mode::Stopped;
            let blamed = matches!(command.status.fault, Some(Fault::Torque { .. }));
            prop_assert!(stopped || !(whole && blamed));
            prop_assert!(whole || command.status.fault.is_some());
            prop_assert!(whole || command.torque == [0.0; 6]);
            for (j, (&out, last)) in command.torque.iter().zip(&mut last).enumerate() {
                prop_assert!(out.is_finite() && (out == 0.0 || out.abs() <= bounds.torque[j]));
                if whole && !stopped {
                    // The bounds are sums in f32, rounded.
                    let (now, before) = (f64::from(out), f64::from(*last));
                    let slack = f64::from(f32::EPSILON) * now.abs().max(before.abs());
                    let change = (now - before).abs();
                    prop_assert!(change == 0.0 || change <= f64::from(bounds.rate[j]) + slack);
                    *last = out;
                }
            }
        }
    }
}

#[test]
fn a_nan_measurement_never_reaches_the_drive() {
    let reference = State::at(HOME);
    for joint in 0..6 {
        for poison in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let mut control = Loop::new();
            for _ in 0..5 {
                control.tick(Ok(&HOME), &reference);
            }
            let mut q = HOME;
            q[joint] = poison;
            for tick in 0..2 * HOLD {
                let (command, _) = control.tick(Ok(&q), &reference);
                assert!(safe(&command));
                assert_eq!(command.status.fault, Some(Fault::NotFinite { joint }));
                let (mode, gravity) = (command.status.mode, command.torque[1]);
                if tick < HOLD {
                    assert_eq!((mode, command.brake), (Mode::Hold, false));
                    assert!(gravity < -20.0, "the arm is held: {gravity}");
                } else {
                    assert_eq!((mode, command.brake), (Mode::Stopped, true));
                    assert_eq!(command.torque, [0.0; 6]);
                }
            }
        }
    }
}

#[test]
fn a_rejected_value_is_never_remembered() {
    // Two loops: one sees wild values, the other hears of faults. Their memories stay the same.
    let reference = State::at(HOME);
    for wild in [f32::NAN, f32::MAX, f32::INFINITY, 100.0, HOME[2] + 0.1] {
        let (mut saw, mut heard) = (Loop::new(), Loop::new());
        for tick in 0..200 {
            let mut q = HOME;
            q[2] = wild;
            let rejected = (50..60).contains(&tick);
            let (a, b) = if rejected {
                let fault = Err(Fault::Encoder { joint: 2 });
                (saw.tick(Ok(&q), &reference), heard.tick(fault, &reference))
            } else {
                (
                    saw.tick(Ok(&HOME), &reference),
                    heard.tick(Ok(&HOME), &reference),
                )
            };
            assert_eq!(bits(&a.0.torque), bits(&b.0.torque), "{wild} {tick}");
            assert_eq!(bits(&a.1.qd), bits(&b.1.qd), "{wild} {tick}");
            assert_eq!(a.0.status.mode, b.0.status.mode);
            assert_eq!(saw.supervisor.last_good(), &HOME);
        }
    }
    // The same for torques, in the rate limiter.
    let mut supervisor = Supervisor::new(BOUNDS, TICK, HOLD, 0);
    for tau in [
        [70.0; 6],
        [f32::NAN; 6],
        [1.0, 1.0, 1.0, 1.0, 1.0, f32::INFINITY],
    ] {
        supervisor.admit(Ok(&HOME));
        supervisor.pass(&tau);
    }
    supervisor.admit(Ok(&HOME));
    assert_eq!(
        supervisor.pass(&[-150.0; 6]).torque,
        [-5.0, -5.0, -5.0, 0.0, 0.0, 0.0]
    );
}

#[test]
fn the_same_inputs_after_a_fault_give_the_same_bits() {
    let gains = Loop::new().gains;
    let law = |tick: u32| {
        let x = tick as f32 * 1e-3;
        let reference = State {
            q: HOME.map(|q| q + x),
            qd: [0.1, -0.2, 0.3, -0.1, 0.2, -0.3],
            qdd: [x, 1.0, -x, 0.5, 0.0, -0.0],
        };
        let mut tau = Core::<Ur5e>::rnea(&reference, &RIGID_BODY);
        let pd = feedback(&gains, &reference, &HOME, &[0.0; 6]);
        tau.iter_mut().zip(pd).for_each(|(tau, pd)| *tau += pd);
        tau
    };
    let [mut whole, mut hurt] = [(); 2].map(|()| Supervisor::new(BOUNDS, TICK, HOLD, REENTRY));
    for tick in 0..500 {
        let fault = (100..100 + HOLD).contains(&tick);
        let tau = law(tick);
        whole.admit(Ok(&HOME));
        hurt.admit(if fault { Err(Fault::Stale) } else { Ok(&HOME) });
        let a = whole.pass(&tau);
        let b = hurt.pass(if fault { &[f32::NAN; 6] } else { &tau });
        let back = !(100..100 + HOLD + REENTRY - 1).contains(&tick);
        assert_eq!(fault, b.status.mode == Mode::Hold);
        assert!(!back || bits(&a.torque) == bits(&b.torque), "tick {tick}");
    }
}

#[test]
fn the_observer_forgets_a_fault_but_for_rounding() {
    let [mut whole, mut hurt] = [(); 2].map(|()| Observer::<f32, 6>::new(250.0, TICK));
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
    let way = |q, ticks| WayPoint {
        q,
        qd: [0.0; 6],
        ticks,
    };
    let limits = [Speed {
        velocity: 3.0_f32,
        acceleration: 20.0,
    }; 6];
    let new = |ticks| {
        let points = [
            way(HOME, 0),
            way(HOME, 100),
            way(away, ticks),
            way(HOME, 2000),
        ];
        Trajectory::new(&points, TICK, &limits)
    };
    // A quintic from rest to rest peaks at 15/8 D/T and at 10/√3 D/T².
    assert!(new(700).is_ok());
    match new(600) {
        Err(TrajectoryError::Velocity {
            point: 2,
            joint: 3,
            needed,
            allowed,
        }) => assert!((needed - 1.875 / 0.6).abs() < 1e-5 && allowed == 3.0),
        other => panic!("{other:?}"),
    }
    let slow = [Speed {
        acceleration: 10.0,
        ..limits[0]
    }; 6];
    let points = [way(HOME, 0), way(away, 700)];
    let error = Trajectory::new(&points, TICK, &slow).unwrap_err();
    match error {
        TrajectoryError::Acceleration {
            point: 1,
            joint: 3,
            needed,
            allowed,
        } => assert!((needed - 10.0 / 3.0_f64.sqrt() / 0.49).abs() < 1e-4 && allowed == 10.0),
        other => panic!("{other:?}"),
    }
    assert_eq!(
        error.to_string(),
        "way-point 1, joint 3: needs an acceleration of 11.7827, 10.0000 allowed"
    );
}

#[test]
fn an_encoder_wrap_is_no_velocity_spike() {
    let counts_per_turn = 16_384.0;
    for direction in [1.0_f32, -1.0] {
        let mut counter = TurnCounter::<14>::new();
        let mut observer = Observer::<f32, 1>::new(250.0, TICK);
        let mut supervisor = Supervisor::new(
            Bounds {
                torque: [1.0],
                rate: [1.0],
                speed: [3.0],
                lower: [-100.0],
                upper: [100.0],
            },
            TICK,
            HOLD,
            REENTRY,
        );
        for tick in 0..10_000_u16 {
            // 2 rad/s: three turns, each with a wrap
            let turns = f32::from(tick) * (2.0 * TAU_INVERSE * TICK) * direction;
            let raw = (turns * counts_per_turn).round() as i32 & 0x3fff;
            counter.update(raw as u16);
            let q = [counter.angle()];
            assert_eq!(supervisor.admit(Ok(&q)), Mode::Full, "tick {tick}");
            let qd = observer.update(&q, &[0.0]).qd[0];
            supervisor.pass(&[0.0]);
            let settled = tick < 200 || (qd - 2.0 * direction).abs() < 0.05;
            assert!(settled, "tick {tick}: {qd} rad/s");
        }
        assert_eq!(counter.turns(), if direction > 0.0 { 3 } else { -4 });
    }
}

const TAU_INVERSE: f32 = 1.0 / core::f32::consts::TAU;

fn bits(x: &[f32; 6]) -> [u32; 6] {
    x.map(f32::to_bits)
}
