//! Durations and ṡ² of the package toppra, and the limits between grid points.

use dynamics_core::control::{
    GeometricPath, JointFriction, MotionLimits, PathLimits, PathSpline, TimedPath,
};
use dynamics_core::effects::Armature;
use host_tests::measured::within;
use host_tests::recordings;
use serde::Deserialize;

use crate::plant::{Q, ROTORS};
use crate::table;
use crate::ur5e::{Shares, Widened, inverse_dynamics, inverse_dynamics_f32, shares, to_f32};

/// What `host-tests/oracle/toppra_paths.py` wrote.
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
            // Of toppra all of it counts everywhere.
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

/// Of all paths, on a grid of M points.
struct Compared {
    /// Durations as shares of those of toppra.
    durations: Vec<f64>,
    /// Differences of ṡ² as shares of the greatest one.
    squares: f64,
    most: Shares,
}

fn compared<const M: usize>() -> Compared {
    let mut all = Compared {
        durations: vec![],
        squares: 0.0,
        most: Shares::default(),
    };
    for recorded in recording().paths {
        let (path, limits) = (recorded.path(), recorded.limits());
        let timed = TimedPath::<_, _, M>::new(&path, TICK, &limits, inverse_dynamics)
            .unwrap_or_else(|error| panic!("{error}"));
        all.durations.push(timed.seconds() / recorded.seconds);
        let most = recorded.squares.iter().copied().fold(0.0, f64::max);
        for (k, square) in recorded.squares.iter().enumerate() {
            let s = k as f64 / (recorded.squares.len() - 1) as f64;
            let off = (square_rate(&timed, s) - square).abs() / most;
            all.squares = all.squares.max(off);
        }
        all.most = all.most.most(shares(&timed, &limits));
    }
    all
}

/// ṡ² at s, which is linear from point to point of the grid.
fn square_rate<P, const M: usize>(timed: &TimedPath<'_, f64, P, M>, s: f64) -> f64 {
    let k = (0..M - 2).take_while(|&k| timed.grid_point(k + 1) <= s).count();
    let [from, to] = [k, k + 1].map(|k| (timed.grid_point(k), timed.square_rate(k)));
    from.1 + (to.1 - from.1) * (s - from.0) / (to.0 - from.0)
}

fn mean(x: &[f64]) -> f64 {
    x.iter().sum::<f64>() / x.len() as f64
}

fn most(x: &[f64]) -> f64 {
    x.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

fn least(x: &[f64]) -> f64 {
    x.iter().copied().fold(f64::INFINITY, f64::min)
}

#[test]
fn durations_are_those_of_toppra_and_the_limits_hold_between_grid_points() {
    let mut rows = String::from(
        "| grid points | duration against toppra, mean | worst | greatest difference of ṡ² | greatest share of a torque's limit | of a speed's | of an acceleration's |\n\
         |---:|---:|---:|---:|---:|---:|---:|\n",
    );
    let compared = [
        (51, compared::<51>()),
        (101, compared::<101>()),
        (201, compared::<201>()),
        (401, compared::<401>()),
    ];
    for (points, all) in &compared {
        let [mean, worst] = [mean(&all.durations), most(&all.durations)].map(|x| 100.0 * (x - 1.0));
        let Shares {
            torque,
            speed,
            acceleration,
        } = all.most;
        let [torque, speed, acceleration] = [torque, speed, acceleration].map(|x| 100.0 * x);
        rows += &format!(
            "| {points} | {mean:+.2} % | {worst:+.2} % | {:.1} % | {torque:.2} % | {speed:.2} % | {acceleration:.2} % |\n",
            100.0 * all.squares
        );
        println!("{points}: {:.4?} {:?}", all.durations, all.most);
    }
    println!("{rows}");
    let [_, _, (_, coarse), (_, fine)] = &compared;
    within("duration, 201 points", most(&coarse.durations) - 1.0, 0.01);
    within("duration, 401 points", most(&fine.durations) - 1.0, 0.005);
    assert!(least(&fine.durations) > 0.999);
    within("ṡ², 401 points", fine.squares, 0.05);
    within("torque, 201 points", coarse.most.torque - 1.0, 0.01);
    within("torque, 401 points", fine.most.torque - 1.0, 0.005);
    within("speed, 401 points", fine.most.speed - 1.0, 0.001);
    within("acceleration, 401 points", fine.most.acceleration - 1.0, 0.005);
    table("toppra").check(&rows);
}

#[test]
fn the_paths_have_points_of_zero_inertia() {
    // Of the joints whose torque limits the motion: M q′ of some of them changes its sign on every path.
    let mut signs = vec![];
    for recorded in recording().paths {
        let path = recorded.path();
        let inertia = |k: u32| {
            let at = path.point(f64::from(k) / 400.0);
            let state = dynamics_core::state::State {
                qdd: at.slope,
                ..dynamics_core::state::State::at(at.q)
            };
            let rest = inverse_dynamics(&dynamics_core::state::State::at(at.q));
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
    assert!(signs.iter().sum::<usize>() >= 20, "{signs:?}");
}

#[test]
fn f32_has_the_durations_of_f64_within_the_limits() {
    let (mut off, mut excess) = (0.0_f64, 0.0_f64);
    for recorded in recording().paths {
        let (path, limits) = (recorded.path(), recorded.limits());
        let timed = TimedPath::<_, _, 201>::new(&path, TICK, &limits, inverse_dynamics)
            .unwrap_or_else(|error| panic!("{error}"));
        let points: Vec<[f32; 6]> =
            recorded.points.iter().map(|q| q.map(|q| q as f32)).collect();
        let mut single = PathSpline::<f32, 6, 32>::EMPTY;
        single.fit(&points, &[0.1; 6], &[0.0; 6]).expect("way-points");
        let narrow = to_f32(&limits);
        let motion =
            TimedPath::<_, _, 201>::new(&single, TICK as f32, &narrow, inverse_dynamics_f32)
                .unwrap_or_else(|error| panic!("{error}"));
        off = off.max((f64::from(motion.seconds()) / timed.seconds() - 1.0).abs());
        let [double, single] = [shares(&timed, &limits), shares(&Widened(motion), &limits)];
        excess = excess.max(single.torque - double.torque);
    }
    within("duration of f32", off, 2e-3);
    within("more torque of f32", excess, 2e-3);
}
#[test]
fn debug_worst() {
    for (n, recorded) in recording().paths.iter().enumerate() {
        let (path, limits) = (recorded.path(), recorded.limits());
        const M: usize = 401;
        let timed = TimedPath::<_, _, M>::new(&path, TICK, &limits, inverse_dynamics).unwrap();
        let x: Vec<f64> = (0..M).map(|k| timed.square_rate(k)).collect();
        let mut worst = (0.0, 0, 0, 0.0);
        let mut over = 0;
        for k in 0..M - 1 {
            let step = timed.grid_point(k + 1) - timed.grid_point(k);
            let u = (x[k + 1] - x[k]) / (2.0 * step);
            for i in 0..=10 {
                let f = f64::from(i) / 10.0;
                let at = path.point(timed.grid_point(k) + f * step);
                let xx = x[k] + f * (x[k + 1] - x[k]);
                let st = dynamics_core::state::State { q: at.q, qd: at.slope.map(|s| s * xx.sqrt()), qdd: core::array::from_fn(|j| at.slope[j] * u + at.curvature[j] * xx) };
                let tau = inverse_dynamics(&st);
                for j in 0..6 {
                    let fr = limits.friction[j].coulomb * at.slope[j].signum();
                    let r = (tau[j] + fr).abs() / limits.torque[j];
                    if r > 1.005 { over += 1; }
                    if r > worst.0 { worst = (r, k, j, f); }
                }
            }
        }
        println!("{n} {worst:?} over {over}");
    }
}
