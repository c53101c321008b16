//! Durations and ṡ² of the package toppra, and the limits between grid points.

use dynamics_core::effects::Armature;
use dynamics_core::state::State;
use host_tests::measured::within;
use host_tests::recordings;
use motion_control::limits::MotionLimits;
use motion_control::reference::{GeometricPath, JointFriction, PathLimits, PathSpline, TimedPath};
use serde::Deserialize;

use crate::hand_guiding::plant::{Q, ROTORS};
use crate::taught_path::ur5e::{Shares, inverse_dynamics, shares};

/// The output of `host-tests/oracle/toppra_paths.py`.
#[derive(Deserialize)]
struct Recording {
    armature: Q,
    paths: Vec<Recorded>,
}

#[derive(Deserialize)]
struct Recorded {
    points: Vec<Q>,
    torque: Q,
    velocity: Option<Q>,
    acceleration: Option<Q>,
    coulomb: Q,
    seconds: f64,
    coarse: f64,
    squares: Vec<f64>,
}

/// Some twelve moments in a segment of the finest grid, s.
const TICK: f64 = 1e-4;

impl Recorded {
    fn limits(&self) -> PathLimits<f64, 6> {
        let any = [f64::INFINITY; 6];
        let (speed, acceleration) =
            (self.velocity.unwrap_or(any), self.acceleration.unwrap_or(any));
        PathLimits {
            torque: self.torque,
            motion: core::array::from_fn(|j| MotionLimits {
                velocity: speed[j],
                acceleration: acceleration[j],
            }),
            // In toppra the whole friction counts everywhere.
            friction: self.coulomb.map(|coulomb| JointFriction {
                coulomb,
                viscous: 0.0,
                certain: 1.0,
            }),
        }
    }

    fn path(&self) -> PathSpline<f64, 6, 32> {
        let mut path = PathSpline::EMPTY;
        let fitted = path.fit(&self.points, &[0.1; 6], &[0.0; 6]);
        fitted.expect("way-points");
        path
    }
}

fn recording() -> Recording {
    let recording: Recording = recordings::read("toppra_ur5e");
    let Armature(rotors) = ROTORS;
    assert_eq!(recording.armature, rotors);
    recording
}

/// The comparison over all paths, on a grid of M points.
struct Compared {
    /// Durations as shares of those of toppra.
    durations: Vec<f64>,
    most: Shares,
}

fn compared<const M: usize>() -> Compared {
    let mut all = Compared { durations: vec![], most: Shares::default() };
    for recorded in recording().paths {
        let (path, limits) = (recorded.path(), recorded.limits());
        let timed = TimedPath::<_, _, M>::new(&path, TICK, &limits, inverse_dynamics)
            .unwrap_or_else(|error| panic!("{error}"));
        all.durations.push(timed.seconds() / recorded.seconds);
        all.most = all.most.most(shares(&timed, &limits));
    }
    all
}

fn most(x: &[f64]) -> f64 {
    x.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

fn least(x: &[f64]) -> f64 {
    x.iter().copied().fold(f64::INFINITY, f64::min)
}

// The limits hold between the grid points too.
#[test]
fn durations_agree_with_toppra_within_the_limits() {
    let compared = [
        (51, compared::<51>()),
        (101, compared::<101>()),
        (201, compared::<201>()),
        (401, compared::<401>()),
    ];
    for (points, all) in &compared {
        println!("{points}: {:.4?} {:?}", all.durations, all.most);
    }
    let [_, _, (_, coarse), (_, fine)] = &compared;
    within("duration, 201 points", most(&coarse.durations) - 1.0, 0.025);
    within("duration, 401 points", most(&fine.durations) - 1.0, 0.01);
    assert!(least(&fine.durations) > 1.0);
    within("torque, 201 points", coarse.most.torque - 1.0, 0.02);
    within("torque, 401 points", fine.most.torque - 1.0, 0.005);
    within("acceleration, 401 points", fine.most.acceleration - 1.0, 0.002);
    within("speed, 401 points", fine.most.speed - 1.0, 1e-3);
}

#[test]
fn square_rates_agree_with_toppra_on_its_grid() {
    let (mut times, mut squares, mut reversals) = (0.0_f64, 0.0_f64, 0.0_f64);
    for recorded in recording().paths {
        let (path, limits) = (recorded.path(), recorded.limits());
        let timed = TimedPath::<_, _, 401>::new(&path, TICK, &limits, inverse_dynamics)
            .unwrap_or_else(|error| panic!("{error}"));
        let time = timed.seconds() / recorded.coarse - 1.0;
        // toppra has the sign of Coulomb friction at the grid points; here it has both in a segment
        // where a joint reverses.
        let torque_with_friction = recorded.coulomb[0] > 0.0 && recorded.velocity.is_none();
        if torque_with_friction {
            assert!(time > 0.0, "{time:e}");
            reversals = reversals.max(time);
            continue;
        }
        times = times.max(time.abs());
        let largest = most(&recorded.squares);
        for (k, square) in recorded.squares.iter().enumerate() {
            squares = squares.max((timed.square_rate(k) - square).abs() / largest);
        }
    }
    within("duration", times, 1e-7);
    within("ṡ²", squares, 1e-6);
    within("duration with reversals", reversals, 5e-3);
}

#[test]
fn the_paths_have_points_of_zero_inertia() {
    // M q′ of some joints changes its sign on every path.
    let mut signs = vec![];
    for recorded in recording().paths {
        let path = recorded.path();
        let inertia = |k: u32| {
            let at = path.point(f64::from(k) / 400.0);
            let state = State { qdd: at.slope, ..State::at(at.q) };
            let rest = inverse_dynamics(&State::at(at.q));
            let tau = inverse_dynamics(&state);
            core::array::from_fn::<f64, 6, _>(|j| tau[j] - rest[j])
        };
        let changes = (0..400).flat_map(|k| {
            let [from, to] = [inertia(k), inertia(k + 1)];
            (0..6).filter(move |&j| from[j] * to[j] < 0.0)
        });
        signs.push(changes.count());
    }
    println!("{signs:?}");
    assert!(signs.iter().all(|&signs| signs >= 5), "{signs:?}");
}
