//! Random paths on random trees.

use dynamics_core::algorithms::{crba, rnea};
use dynamics_core::effects::{Gravity, RIGID_BODY};
use dynamics_core::model::{BASE, Body, Joint, Model};
use dynamics_core::state::State;
use host_tests::measured::within;
use host_tests::random::{random_body, random_numbers, within as draw};
use motion_control::{
    GeometricPath, JointFriction, MotionLimits, PathLimits, PathSpline, Reference, TimedPath,
};
use proptest::prelude::RngExt;
use proptest::test_runner::TestRng;

const N: usize = 6;

/// Revolute and prismatic joints on random parents.
fn tree(rng: &mut TestRng) -> Model<f64, N, N, N> {
    const NAMES: [&str; N] = ["a", "b", "c", "d", "e", "f"];
    let bodies = core::array::from_fn(|i| {
        let axis = draw(rng, 1.0);
        let joint = if rng.random_range(0..4) == 0 {
            Joint::prismatic(axis)
        } else {
            Joint::revolute(axis)
        };
        let parent = if i == 0 { BASE } else { rng.random_range(0..i) };
        random_body(rng, Body::new(NAMES[i], parent, joint))
    });
    Model::new("tree", bodies)
}

fn walk(rng: &mut TestRng) -> PathSpline<f64, N, 12> {
    let (mut q, mut step) = (draw::<N>(rng, 1.0), draw::<N>(rng, 0.1));
    let points: [[f64; N]; 12] = core::array::from_fn(|_| {
        let turn = draw::<N>(rng, 0.05);
        for j in 0..N {
            step[j] += turn[j];
            q[j] += step[j];
        }
        q
    });
    let mut path = PathSpline::EMPTY;
    path.fit(&points, &[0.2; N], &[0.0; N]).expect("way-points");
    path
}

// The robots are random trees.
#[test]
fn random_paths_keep_all_limits_and_reach_one() {
    let mut rng = random_numbers();
    let (mut excess, mut reached) = (0.0_f64, f64::INFINITY);
    for _ in 0..100 {
        let (robot, path) = (tree(&mut rng), walk(&mut rng));
        let gravity = |s: f64| rnea(&robot, &State::at(path.point(s).q), &Gravity::EARTH);
        let mut torque = [1.0_f64; N];
        for k in 0..=100 {
            let tau = gravity(f64::from(k) / 100.0);
            for j in 0..N {
                torque[j] = torque[j].max(1.5 * tau[j].abs());
            }
        }
        let friction = torque.map(|tau| JointFriction {
            coulomb: 0.05 * tau,
            viscous: 0.02 * tau,
            certain: 0.0,
        });
        let limits = PathLimits {
            torque,
            motion: [MotionLimits {
                velocity: 3.0,
                acceleration: 40.0,
            }; N],
            friction,
        };
        let tick = 2e-4;
        let timed = TimedPath::<_, _, 401>::new(&path, tick, &limits, |state| {
            rnea(&robot, state, &RIGID_BODY)
        })
        .unwrap_or_else(|error| panic!("{error}"));
        // Not at both ends, where only one of the limits may be reached for a part of a segment.
        let mut quietest = f64::INFINITY;
        let mut least = vec![];
        for k in 0..timed.ticks() {
            let state = timed.at(k);
            let moving = State {
                qdd: [0.0; N],
                ..state
            };
            let bias = rnea(&robot, &moving, &RIGID_BODY);
            let m = crba(&robot, &state.q, &RIGID_BODY);
            let mut most = 0.0_f64;
            for j in 0..N {
                let inertia: f64 = (0..N).map(|i| m.get(j, i) * state.qdd[i]).sum();
                let (rigid, qd) = (bias[j] + inertia, state.qd[j]);
                let against = friction[j].coulomb * qd.signum() + friction[j].viscous * qd;
                // Friction of any size up to the stated one.
                let tau = rigid.abs().max((rigid + against).abs());
                let [speed, acceleration] = [qd.abs() / 3.0, state.qdd[j].abs() / 40.0];
                most = most.max(tau / torque[j]).max(speed).max(acceleration);
            }
            excess = excess.max(most - 1.0);
            least.push(most);
        }
        least.sort_by(f64::total_cmp);
        quietest = quietest.min(least[least.len() / 10]);
        reached = reached.min(quietest);
    }
    println!("{excess} {reached}");
    within("beyond a limit", excess, 0.01);
    // A motion could be faster where no limit is reached.
    assert!(reached > 0.85, "{reached}");
}
