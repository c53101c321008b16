//! γ, G and Ġ ẏ of every linkage, in the tree: its loops are closed, and its rates are the
//! derivatives of its positions.

use dynamics_core::algorithms::{Pose, frame};
use dynamics_core::clusters::{
    Branch, Cluster, ClusterProblem, Clustered, ClusteredRobot, FiveBar, Stewart,
};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{JointCoordinate, Static};
use dynamics_core::scalar::Native;
use dynamics_core::spatial::Motion;
use dynamics_core::state::{RobotState, State};
use dynamics_core::{Core, Engine, algorithms};
use firmware_demo::robots::{AnkleLeg, FourBarLeg, LEGS, StewartPlatform};
use glam::{DMat3, DVec3};
use loop_tests::clusters::{
    DeltaRobot, FiveBarLeg, FloatingAnkle, Geared, UniversalAnkle, Wrist, ankle_states, apart,
    delta_states, five_bar_states, floating_states, four_bar_states, geared_states, stewart_states,
    wrist_states,
};

/// d/dt of q and of q̇ of the tree along y(t) = y + ẏ t + ÿ t²/2, by differences of sixth order.
fn derivatives<T, const B: usize, const N: usize, const Y: usize>(
    y: &State<f64, Y, Y>,
) -> [[f64; N]; 2]
where
    T: ClusteredRobot<B, N, N, Y, Y>,
{
    let h = 1e-3;
    let at = |t: f64| {
        let q = core::array::from_fn(|i| y.q[i] + t * (y.qd[i] + t * 0.5 * y.qdd[i]));
        let qd = core::array::from_fn(|i| y.qd[i] + t * y.qdd[i]);
        let y = State { q, qd, ..*y };
        let motion = Clustered::<Core<T>>::motion(&y).expect("it closes");
        [motion.state().state().q, motion.state().state().qd]
    };
    let at: [[[f64; N]; 2]; 7] = core::array::from_fn(|k| at((k as f64 - 3.0) * h));
    [0, 1].map(|order| {
        let centre = at[3][order];
        core::array::from_fn(|i| {
            let weights = [-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0];
            let term = |(weight, at): (&f64, &[[f64; N]; 2])| {
                // Angles of closed forms are within ±π.
                let (turn, change) = (core::f64::consts::TAU, at[order][i] - centre[i]);
                let turns = if order == 0 { (change / turn).round() } else { 0.0 };
                weight * (change - turn * turns)
            };
            weights.iter().zip(&at).map(term).sum::<f64>() / (60.0 * h)
        })
    })
}

/// Holds G ẏ and G ÿ + Ġ ẏ against differences.
fn rates_are_derivatives<T, const B: usize, const N: usize, const Y: usize>(
    states: &[State<f64, Y, Y>],
) where
    T: ClusteredRobot<B, N, N, Y, Y>,
{
    let mut worst = [0.0_f64; 2];
    for y in states {
        let [rate, accel] = derivatives::<T, B, N, Y>(y);
        let motion = Clustered::<Core<T>>::motion(y).expect("it closes");
        let tree = motion.state();
        let tree = tree.state();
        let scale = |row: &[f64]| loop_tests::clusters::largest(row).max(1.0);
        worst[0] = worst[0].max(apart(&rate, &tree.qd) / scale(&rate));
        worst[1] = worst[1].max(apart(&accel, &tree.qdd) / scale(&accel));
        assert_eq!(motion.singular(), None);
    }
    println!("{}: rate {:.1e}, acceleration {:.1e}", T::MODEL.name, worst[0], worst[1]);
    assert!(worst[0] < 1e-10 && worst[1] < 1e-10, "{worst:?}");
}

#[test]
fn rates_of_every_linkage_are_the_derivatives_of_its_positions() {
    rates_are_derivatives::<FourBarLeg, 5, 5, 3>(&four_bar_states());
    rates_are_derivatives::<FiveBarLeg, 5, 5, 3>(&five_bar_states());
    rates_are_derivatives::<Wrist, 6, 6, 6>(&wrist_states());
    rates_are_derivatives::<Geared, 7, 7, 4>(&geared_states());
    rates_are_derivatives::<AnkleLeg, 9, 9, 3>(&ankle_states());
    rates_are_derivatives::<DeltaRobot, 12, 12, 3>(&delta_states());
    rates_are_derivatives::<StewartPlatform, 24, 24, 6>(&stewart_states());
    rates_are_derivatives::<UniversalAnkle, 6, 9, 3>(&ankle_states());
}

/// The points of two bodies that the loop joins, in base coordinates.
fn ends<T, const B: usize, const Q: usize, const V: usize, const P: usize, const Y: usize>(
    y: &State<f64, P, Y>,
    joined: [(usize, DVec3); 2],
) -> [DVec3; 2]
where
    T: ClusteredRobot<B, Q, V, P, Y>,
{
    let motion = Clustered::<Core<T>>::motion(y).expect("it closes");
    let poses = algorithms::poses(&Static::<T>::NEW, motion.configuration());
    joined.map(|(body, point)| poses[body].point(point))
}

fn closed<T, const B: usize, const Q: usize, const V: usize, const P: usize, const Y: usize>(
    states: &[State<f64, P, Y>],
    joined: [(usize, DVec3); 2],
) where
    T: ClusteredRobot<B, Q, V, P, Y>,
{
    let gap = |y| {
        let [a, b] = ends::<T, B, Q, V, P, Y>(y, joined);
        (a - b).length()
    };
    let worst = states.iter().map(gap).fold(0.0, f64::max);
    println!("{}: gap {worst:.1e} m", T::MODEL.name);
    assert!(worst < 1e-14, "{worst:.1e}");
}

#[test]
fn loops_are_closed() {
    use firmware_demo::robots::four_bar_leg::{LEVER, ROD};
    let [rod, lever] = [DVec3::Z * -ROD, DVec3::X * LEVER];
    closed::<FourBarLeg, 5, 5, 5, 3, 3>(&four_bar_states(), [(2, rod), (3, lever)]);
    let [rod, other] = [0.22, 0.2].map(|length| DVec3::X * length);
    closed::<FiveBarLeg, 5, 5, 5, 3, 3>(&five_bar_states(), [(2, rod), (4, other)]);
    for (rod, body) in firmware_demo::robots::RODS.iter().zip([5, 8]) {
        let joined = [(2, DVec3::from_array(rod.foot)), (body, DVec3::Z * -rod.length)];
        closed::<AnkleLeg, 9, 9, 9, 3, 3>(&ankle_states(), joined);
        let universal = [(1, joined[0].1), (body - 2 - (body - 5) / 3, joined[1].1)];
        closed::<UniversalAnkle, 6, 9, 9, 3, 3>(&ankle_states(), universal);
        closed::<FloatingAnkle, 9, 15, 14, 9, 8>(&floating_states(), joined);
    }
    for (side, body) in [2, 5, 8].into_iter().enumerate() {
        let (sin, cos) = (side as f64 * core::f64::consts::TAU / 3.0).sin_cos();
        let joined = [(11, DVec3::new(0.05 * cos, 0.05 * sin, 0.0)), (body, DVec3::Z * -0.45)];
        closed::<DeltaRobot, 12, 12, 12, 3, 3>(&delta_states(), joined);
    }
    for (leg, body) in LEGS.iter().zip([8, 11, 14, 17, 20, 23]) {
        let joined = [(5, DVec3::from_array(leg.platform)), (body, DVec3::Z * 0.4)];
        closed::<StewartPlatform, 24, 24, 24, 6, 6>(&stewart_states(), joined);
    }
}

// The motion is pose, twist and acceleration.
#[test]
fn stewart_coordinates_follow_from_the_platforms_motion() {
    let mut worst = 0.0_f64;
    for y in stewart_states() {
        let motion = Clustered::<Core<StewartPlatform>>::motion(&y).expect("it closes");
        let robot = &Static::<StewartPlatform>::NEW;
        let pose = algorithms::poses(robot, motion.configuration())[5];
        // ω and v of the origin in base axes, and by differences of them ω̇ and v̇.
        let twist = |t: f64| {
            let q = core::array::from_fn(|i| y.q[i] + t * (y.qd[i] + t * 0.5 * y.qdd[i]));
            let qd = core::array::from_fn(|i| y.qd[i] + t * y.qdd[i]);
            let y = State { q, qd, ..y };
            let motion = Clustered::<Core<StewartPlatform>>::motion(&y).expect("it closes");
            let jacobian =
                algorithms::jacobian(robot, motion.configuration(), 5, frame::LocalWorldAligned);
            let qd = motion.state().state().qd;
            let columns = jacobian.iter().zip(&qd);
            columns.fold(Motion::ZERO, |sum, (&j, &qd)| sum + j * qd)
        };
        let h = 1e-5;
        let acceleration = (twist(h) - twist(-h)) * (0.5 / h);
        let back = Stewart::coordinates(&pose, twist(0.0), acceleration);
        let back = back.expect("a pitch within limits");
        worst = worst.max(apart(&back.q, &y.q)).max(apart(&back.qd, &y.qd));
        assert!(apart(&back.qdd, &y.qdd) < 1e-7, "{back:?} {y:?}");
    }
    assert!(worst < 1e-13, "{worst:.1e}");
    let still = |rot, pos| {
        let pose = Pose { rot, pos };
        Stewart::coordinates(&pose, Motion::<f64>::ZERO, Motion::ZERO)
    };
    let upright = DMat3::from_rotation_y(core::f64::consts::FRAC_PI_2);
    assert_eq!(still(upright, DVec3::Z), Err(ClusterProblem::CannotClose));
}

#[test]
fn leg_forces_of_a_nonfinite_motion_are_refused() {
    let forces = |[pos, ahead, left, above, omega, v, alpha, a]: [DVec3; 8]| {
        let rot = DMat3::from_cols(ahead, left, above);
        let of = |ang, lin| Motion::<f64> { ang, lin };
        let y = Stewart::coordinates(&Pose { rot, pos }, of(omega, v), of(alpha, a));
        let forces =
            y.map(|y| Clustered::<Engine<StewartPlatform>>::rnea_of_motors(&y, &RIGID_BODY));
        forces.map(|forces| forces.map(|forces| forces.tau).map_err(|error| error.problem))
    };
    let one = 0.1 * DVec3::ONE;
    let moving = [DVec3::Z * 0.8, DVec3::X, DVec3::Y, DVec3::Z, one, one, one, one];
    assert!(matches!(forces(moving), Ok(Ok(_))));
    for (bad, i, k) in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY]
        .into_iter()
        .flat_map(|bad| (0..8).flat_map(move |i| (0..3).map(move |k| (bad, i, k))))
        // The algorithm reads only the last component of the platform's ŷ.
        .filter(|&(_, i, k)| k == 2 || !(2..4).contains(&i))
    {
        let mut of = moving;
        of[i][k] = bad;
        let refused = forces(of);
        assert!(matches!(refused, Err(_) | Ok(Err(_))), "{bad} at {i}, {k}: {refused:?}");
    }
}

#[test]
fn five_bar_zeros_shift_only_its_coordinates() {
    const PLAIN: FiveBar = FiveBar::new(0.2, [0.1, 0.25], [0.12, 0.24], Branch::Positive);
    const ZEROS: [f64; 4] = [0.3, -0.4, 0.5, 0.7];
    let at = |linkage: FiveBar, [y0, y1]: [f64; 2]| {
        let y = [y0, y1].map(JointCoordinate::revolute);
        let motion = linkage.evaluate::<f64, Native>(&y, &[1.0, -0.5]);
        motion.expect("it closes")
    };
    let y = [1.9, 1.1];
    let plain = at(PLAIN, y);
    let shifted = at(PLAIN.zeros(ZEROS), [y[0] - ZEROS[0], y[1] - ZEROS[2]]);
    for (i, zero) in ZEROS.into_iter().enumerate() {
        let (sin, cos) = zero.sin_cos();
        let (angle, coordinate) = (&plain.q[i], &shifted.q[i]);
        assert!((angle.sin * cos - angle.cos * sin - coordinate.sin).abs() < 1e-15, "{i}");
        assert!((angle.cos * cos + angle.sin * sin - coordinate.cos).abs() < 1e-15, "{i}");
    }
    assert!(apart(plain.g.as_flattened(), shifted.g.as_flattened()) < 1e-14);
}
