//! A taught path, played back within the torques of the motors.

use dynamics_core::Core;
use dynamics_core::robots::Ur5e;
use dynamics_core::sim::linearly_implicit;
use dynamics_core::state::State;
use host_tests::measured::within;
use motion_control::law::{Gains, feedback};
use motion_control::limits::{Mode, SafetyLimits};
use motion_control::motion::{MotionController, MotionControllerConfig};
use motion_control::reference::{
    GeometricPath, JointFriction, PathLimits, PathSpline, Recorded, Reference, TaughtPath,
    TimedPath,
};
use motion_control::safety::SupervisorConfig;

use crate::hand_guiding::cell::TICK;
use crate::hand_guiding::plant::{Inertias, Q, SLIDING, arm, modelled, real};
use crate::taught_path::person::{STEP, guide, measured, shaken};
use crate::taught_path::ur5e::{RIGID, inverse_dynamics};
use simulation_tests::plant::VISCOUS;

const TORQUE: Q = [150.0, 150.0, 150.0, 28.0, 28.0, 28.0];
/// Share of the torques for the motion; the rest is for the feedback and stiction.
const SHARE: f64 = 0.85;
const SPACING: Q = [0.04; 6];
const N: usize = 256;
const OMEGA: f64 = 25.0;

type Path = PathSpline<f64, 6, N>;

const SAFETY: SafetyLimits<f64, 6> = SafetyLimits {
    torque: TORQUE,
    rate: [f64::INFINITY; 6], // the torques of the fastest motion jump
    speed: [3.3; 6],
    lower: [-6.2; 6],
    upper: [6.2; 6],
};

fn limits() -> PathLimits<f64, 6> {
    PathLimits {
        friction: core::array::from_fn(|j| JointFriction {
            coulomb: SLIDING[j],
            viscous: VISCOUS[j],
            certain: 0.0,
        }),
        ..PathLimits::from(SAFETY.with_speed_share(0.9)).with_torque_share(SHARE)
    }
}

/// The path near the way-points of an arm with these positions in each tick.
fn taught(positions: &[Q], tolerance: f64) -> Path {
    let mut taught = TaughtPath::<f64, 6, N>::try_new(SPACING).expect("spacings");
    for q in positions {
        let recorded = taught.record(q);
        assert!(matches!(recorded, Recorded::Stored | Recorded::Near), "{recorded:?}");
    }
    let end = positions.last().expect("some");
    assert_eq!(taught.end(end), Recorded::Stored);
    taught.spline(&[tolerance; 6]).expect("way-points")
}

fn timed(path: &Path) -> TimedPath<'_, f64, Path, 401> {
    let timed = TimedPath::new(path, TICK, &limits(), inverse_dynamics);
    timed.unwrap_or_else(|error| panic!("{error}"))
}

/// The greatest distance of the path from positions of each tick, rad.
fn off(path: &Path, positions: &[Q]) -> f64 {
    let along: Vec<Q> = (0..=8000).map(|k| path.point(f64::from(k) / 8000.0).q).collect();
    let distance = |a: &Q, b: &Q| (0..6).fold(0.0_f64, |most, j| most.max((a[j] - b[j]).abs()));
    let nearest = |q: &Q| along.iter().map(|p| distance(p, q)).fold(f64::INFINITY, f64::min);
    positions.iter().step_by(20).map(nearest).fold(0.0, f64::max)
}

#[derive(Clone, Copy, Debug)]
struct Played {
    limited: u32,
    /// The greatest share of a torque's limit.
    torque: f64,
    /// The greatest distance from the reference, rad.
    error: f64,
    ticks: u32,
}

/// The arm with friction of bristles under a controller whose model has a smooth sign.
fn play(motion: &impl Reference<f64, 6>) -> Played {
    let start = motion.at(0).q;
    let config = MotionControllerConfig {
        supervisor: SupervisorConfig {
            limits: SAFETY,
            tick: TICK,
            resolution: STEP,
            ride_through_ticks: 5,
            hold_ticks: 100,
            reentry_ticks: 200,
        },
        observer_bandwidth: 10.0 * OMEGA,
        decay_rate: OMEGA,
        restart_distance: 0.15,
    };
    let mut controller = MotionController::<f64, 6>::try_new(config).expect("good");
    let m = Core::<Ur5e>::crba(&start, &RIGID);
    let gains = Gains::from_inertia(&core::array::from_fn(|j| m.get(j, j)), OMEGA, 1.0);
    let (arm, mut at, mut friction) = (arm(Inertias::All(0.0)), State::at(start), real());
    let mut measured = start;
    let mut played = Played { limited: 0, torque: 0.0, error: 0.0, ticks: motion.ticks() };
    for tick in 0..motion.ticks() + 500 {
        let latched = core::mem::replace(&mut measured, at.q.map(|q| (q / STEP).round() * STEP));
        let command = controller.tick(Ok(&latched), motion, |reference, estimate| {
            let model = (RIGID, modelled(1.0));
            let feedforward = Core::<Ur5e>::rnea(reference, &model);
            let pd = feedback(&gains, reference, estimate);
            core::array::from_fn(|j| feedforward[j] + pd[j])
        });
        assert_eq!((command.status.mode, command.status.fault), (Mode::Full, None), "{tick}");
        played.limited += u32::from(command.status.limited);
        let reference = motion.at(tick).q;
        for j in 0..6 {
            played.torque = played.torque.max(command.torque[j].abs() / TORQUE[j]);
            played.error = played.error.max((at.q[j] - reference[j]).abs());
        }
        let mut scene = (RIGID, friction);
        for _ in 0..4 {
            linearly_implicit(&arm, &mut at, &command.torque, &mut scene, TICK / 4.0)
                .expect("an arm with mass");
        }
        friction = scene.1;
    }
    let end = motion.at(u32::MAX).q;
    let left = (0..6).fold(0.0_f64, |most, j| most.max((at.q[j] - end[j]).abs()));
    assert!(left < 2e-3, "{left} rad from the end");
    played
}

/// Tolerances of the way-points, rad.
const TOLERANCES: [f64; 4] = [0.0, 0.002, 0.005, 0.01];

#[test]
fn a_taught_path_is_played_within_motor_torques() {
    let guided = guide(1.0);
    let measured = measured(&guided);
    let mut last = f64::INFINITY;
    for tolerance in TOLERANCES {
        let path = taught(&measured, tolerance);
        let motion = timed(&path);
        let (played, planned) = (play(&motion), feedforward(&motion));
        let [seconds, off] = [f64::from(played.ticks) * TICK, off(&path, &guided)];
        println!("{tolerance}: planned {planned}, {played:?}, {off} rad");
        // Between the points of the grid, a path through every noisy way-point bends more.
        let most = if tolerance > 0.0 { 1.01 } else { 1.1 };
        assert!(planned < SHARE * most, "{tolerance}: {planned}");
        assert!(played.limited == 0 && played.torque < 0.95, "{played:?}");
        assert!(seconds < last, "a path that may be smoother is faster");
        within("tracking error, rad", played.error, 2e-3);
        within("from the person's path, rad", off, 5e-3 + 1.2 * tolerance);
        last = seconds;
    }
}

/// The greatest share of a torque's limit in the feed-forward, with friction.
fn feedforward(motion: &impl Reference<f64, 6>) -> f64 {
    let mut most = 0.0_f64;
    for tick in 0..motion.ticks() {
        let tau = Core::<Ur5e>::rnea(&motion.at(tick), &(RIGID, modelled(1.0)));
        for j in 0..6 {
            most = most.max(tau[j].abs() / TORQUE[j]);
        }
    }
    most
}

#[test]
fn encoder_noise_and_hand_tremor_cost_little_time() {
    let calm = guide(0.0);
    let shaken = shaken(&calm);
    for tolerance in TOLERANCES {
        let seconds = |positions: &[Q]| timed(&taught(positions, tolerance)).seconds();
        let least = seconds(&calm);
        let all = [measured(&calm), shaken.clone(), measured(&shaken)];
        let costs = all.map(|positions| 100.0 * (seconds(&positions) / least - 1.0));
        let worst = costs.into_iter().fold(0.0, f64::max);
        let bar = match tolerance {
            0.0 => 20.0,
            0.002 => 2.0,
            _ => 0.5,
        };
        within("cost of noise and tremor, %", worst, bar);
        println!("{tolerance}: {least} s; {costs:?}");
    }
}
