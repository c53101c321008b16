//! Singularities, and what cannot be: a status or an error that names the cluster, never a NaN.

use core::f64::consts::{FRAC_PI_2, PI};

use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::clusters::{
    Belt, Branch, Cluster, ClusterError, ClusterProblem, Clustered, ClusteredRobot, DEAD_POINT,
    Driven, FiveBar, ForwardError, FourBar, NEAR_SINGULAR, ParallelAnkle, Rod,
};
use dynamics_core::effects::{Gravity, RIGID_BODY};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointCoordinate, Model, Robot};
use dynamics_core::scalar::{Native, Real};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use firmware_demo::robots::{AnkleLeg, FourBarLeg, StewartPlatform};
use loop_tests::clusters::{DeltaRobot, Random, ankle_states, apart, hold};

/// The follower's motion at a crank angle, in the scalar R.
fn at<R: Real, C: Cluster<M, 1>, const M: usize>(
    linkage: &C,
    y: f64,
) -> Result<dynamics_core::clusters::ClusterMotion<R, M, 1>, ClusterProblem> {
    let y = JointCoordinate::revolute(R::from_f64(y));
    linkage.evaluate::<R, Native>(&[y], &[R::from_f64(2.0)])
}

/// A parallelogram, which is flat at 0 and π.
const FLAT: FourBar = FourBar::new(0.3, 0.1, 0.3, 0.1, Branch::Positive);
/// Its crank does not turn all around: ground + crank > coupler + rocker.
const ROCKING: FourBar = FourBar::new(0.3, 0.2, 0.25, 0.1, Branch::Positive);
/// Grashof's change point: shortest + longest = the other two.
const CHANGING: FourBar = FourBar::new(0.4, 0.1, 0.3, 0.2, Branch::Positive);

fn named_and_bounded<R: Real>() {
    for (linkage, y) in [(FLAT, 0.0), (FLAT, PI), (CHANGING, PI)] {
        let near = [0.0, 1e-9, -1e-9, 1e-7].map(|off| at::<R, _, 3>(&linkage, y + off));
        for motion in near {
            let motion = motion.expect("it closes");
            assert!(motion.singular && motion.is_finite(), "{motion:?}");
            // |G| ≤ crank · coupler … / (h damped), h ≥ 0 and h⁻¹ ≤ 1 / √σ of the longer link.
            let bound = 2.0 / R::select(1e-9, 256.0 * f32::EPSILON).to_f64().sqrt();
            assert!(motion.g.iter().all(|[g]| g.to_f64().abs() < bound), "{motion:?}");
        }
        // Away from it there is no status, and the loop is closed by its rates.
        let away = at::<R, _, 3>(&linkage, y + 0.05).expect("it closes");
        assert!(!away.singular);
    }
}

#[test]
fn flat_parallelograms_and_change_points_are_named_and_bounded() {
    named_and_bounded::<f32>();
    named_and_bounded::<f64>();
}

#[test]
fn damping_and_singular_status_end_together() {
    let mut before: Option<(bool, f64)> = None;
    let mut step = 0.0_f64;
    // h of the crank's angle near π grows with it: from the damped range to the other in fine
    // steps.
    for i in 0..20_000 {
        let motion = at::<f64, _, 3>(&FLAT, PI - 1e-8 * f64::from(i)).expect("it closes");
        let g = motion.g[2][0];
        if let Some((singular, last)) = before
            && singular != motion.singular
        {
            step = (g - last).abs() / g.abs().max(last.abs());
        }
        before = Some((motion.singular, g));
    }
    assert_eq!(before.map(|at| at.0), Some(false));
    hold("step of G at the end of the damping", step, 1e-3);
}

/// The largest errors of G and of Ġ ẏ per ẏ² just beyond the damped range, and the angle at which
/// that ends.
fn beyond_the_damping<R: Real>() -> [f64; 3] {
    let turned = |y| at::<R, _, 3>(&FLAT, y).expect("it closes");
    let (mut inside, mut beyond) = (1e-9, 0.1);
    while beyond - inside > 1e-6 * beyond {
        let middle = 0.5 * (inside + beyond);
        if turned(middle).singular {
            inside = middle;
        } else {
            beyond = middle;
        }
    }
    let mut worst = [0.0_f64; 2];
    for i in 0..2000 {
        let motion = turned(beyond * (1.0 + 5e-5 * f64::from(i)));
        assert!(i < 100 || !motion.singular);
        // The coupler of a parallelogram keeps its direction, and the rocker turns as the crank.
        let [_, [coupler], [rocker]] = motion.g.map(|row| row.map(R::to_f64));
        let [_, b1, b2] = motion.bias.map(|b| b.to_f64().abs() / 4.0);
        worst[0] = worst[0].max((coupler + 1.0).abs()).max((rocker - 1.0).abs());
        worst[1] = worst[1].max(b1).max(b2);
    }
    [worst[0], worst[1], beyond]
}

#[test]
fn beyond_the_damping_errors_are_small() {
    let [g, bias, angle] = beyond_the_damping::<f64>();
    hold("error of G beyond the damping, f64", g, 5e-7);
    hold("error of Ġ ẏ beyond the damping, f64", bias, 1e-2);
    hold("angle at which the status ends, f64", angle, 1e-4);
    let [g, bias, angle] = beyond_the_damping::<f32>();
    hold("error of G beyond the damping, f32", g, 2e-2);
    hold("error of Ġ ẏ beyond the damping, f32", bias, 1.0);
    hold("angle at which the status ends, f32", angle, 2e-2);
}

fn cannot_close<R: Real>() {
    let problem = |y| at::<R, _, 3>(&ROCKING, y).map(|_| ());
    assert_eq!(problem(3.0), Err(ClusterProblem::CannotClose));
    assert_eq!(problem(0.9), Ok(()));
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(problem(bad), Err(ClusterProblem::NotFinite));
    }
    // A finite reading that is far beyond any angle is no NaN.
    for y in [1e6, 1e18, 1e30, -1e30] {
        if let Ok(motion) = at::<R, _, 3>(&ROCKING, y) {
            assert!(motion.is_finite());
        }
    }
    let belt = Belt::new([0.0, 1.0, 0.0, 1.0]);
    assert_eq!(
        at::<R, _, 2>(&belt, 1e30).is_err(),
        R::EPSILON == R::from_f64(f64::from(f32::EPSILON))
    );
    assert_eq!(at::<R, _, 2>(&belt, f64::NAN).map(|_| ()), Err(ClusterProblem::NotFinite));

    const FIVE: FiveBar = FiveBar::new(0.1, [0.1, 0.1], [0.1, 0.1], Branch::Positive);
    let apart = [PI, 0.0].map(|y| JointCoordinate::revolute(R::from_f64(y)));
    let problem = FIVE.evaluate::<R, Native>(&apart, &[R::ONE; 2]).map(|_| ());
    assert_eq!(problem, Err(ClusterProblem::CannotClose));
}

#[test]
fn a_linkage_that_cannot_close_is_an_error() {
    cannot_close::<f32>();
    cannot_close::<f64>();
}

#[test]
fn errors_name_the_cluster() {
    let bent = |y: f64| State { q: [0.1, y, 0.0], qd: [1.0; 3], qdd: [1.0; 3] };
    let expected: ClusterError =
        Clustered::<Core<FourBarLeg>>::rnea(&bent(2.0), &RIGID_BODY).expect_err("too far");
    assert_eq!((expected.cluster, expected.problem), ("knee", ClusterProblem::CannotClose));
    assert_eq!(expected.to_string(), "cluster `knee`: the links do not reach each other");
    assert_eq!(Clustered::<Engine<FourBarLeg>>::rnea(&bent(2.0), &RIGID_BODY), Err(expected));
    let forward = Clustered::<Core<FourBarLeg>>::aba(&bent(2.0), &[0.0; 3], &RIGID_BODY);
    assert_eq!(forward, Err(ForwardError::Cluster(expected)));
    let nan =
        Clustered::<Core<FourBarLeg>>::rnea(&bent(f64::NAN), &RIGID_BODY).expect_err("no number");
    assert_eq!((nan.cluster, nan.problem), ("knee", ClusterProblem::NotFinite));
}

/// A four-bar whose links have no mass but the rocker's.
struct Light<const MASS: u8>;

impl<const MASS: u8> Robot<4, 4, 4> for Light<MASS> {
    const MODEL: ArmModel<f64, 4> = {
        let z = Joint::revolute([0.0, 0.0, 1.0]);
        Model::new(
            "light",
            [
                Body::new("turret", BASE, Joint::revolute([1.0, 0.0, 0.0]))
                    .mass(1.0)
                    .com([0.0, 0.1, 0.0]),
                Body::new("crank", 0, z),
                Body::new("coupler", 1, z).xyz([0.1, 0.0, 0.0]),
                Body::new("rocker", 0, z)
                    .xyz([0.3, 0.0, 0.0])
                    .mass(MASS as f64)
                    .com([0.1, 0.0, 0.0]),
            ],
        )
    };
}

impl<const MASS: u8> ClusteredRobot<4, 4, 4, 2, 2> for Light<MASS> {
    type Clusters = (Driven<FourBar, 3, 1>,);
    const CLUSTERS: Self::Clusters = (Driven::new("parallelogram", FLAT).actuated([2]),);
    const COORDINATES: &'static [&'static [usize]] = &[&[1, 2, 3]];
}

/// A four-bar whose crank does not turn all around.
struct Rocking;

impl Robot<3, 3, 3> for Rocking {
    const MODEL: ArmModel<f64, 3> = {
        let z = Joint::revolute([0.0, 0.0, 1.0]);
        Model::new(
            "rocking",
            [
                Body::new("crank", BASE, z).mass(1.0).com([0.1, 0.0, 0.0]),
                Body::new("coupler", 0, z).xyz([0.2, 0.0, 0.0]).mass(1.0).com([0.1, 0.0, 0.0]),
                Body::new("rocker", BASE, z).xyz([0.3, 0.0, 0.0]).mass(1.0).com([0.05, 0.0, 0.0]),
            ],
        )
    };
}

impl ClusteredRobot<3, 3, 3, 1, 1> for Rocking {
    type Clusters = (Driven<FourBar, 3, 1>,);
    const CLUSTERS: Self::Clusters = (Driven::new("rocker", ROCKING),);
    const COORDINATES: &'static [&'static [usize]] = &[&[0, 1, 2]];
}

#[test]
fn torques_near_a_singularity_come_with_their_conditioning() {
    // Coupler and rocker in line: the law of cosines in the triangle of 0.3, 0.2 and 0.25 + 0.1.
    let end = ((0.3_f64 * 0.3 + 0.2 * 0.2 - 0.35 * 0.35) / (2.0 * 0.3 * 0.2)).acos();
    let at = |off: f64| {
        let y = State { q: [end - off], qd: [2.0], qdd: [10.0] };
        let found = Clustered::<Core<Rocking>>::rnea_with_status(&y, &RIGID_BODY);
        let found = found.expect("it closes");
        assert_eq!(Clustered::<Core<Rocking>>::rnea(&y, &RIGID_BODY), Ok(found.tau));
        (y, found)
    };
    let (mut largest, mut errors) = (0.0_f64, Vec::new());
    for k in 0..=40 {
        let (y, found) = at(10_f64.powf(-0.25 * f64::from(k)));
        largest = largest.max(found.tau[0].abs());
        let motion = Clustered::<Core<Rocking>>::motion(&y).expect("it closes");
        assert_eq!(found.conditioning, motion.conditioning());
        assert_eq!(found.conditioning.cluster, "rocker");
        // The rates of coupler and rocker by the sine rule of the velocity polygon.
        let q = motion.configuration().coordinates.map(|q| q.q);
        let [crank, coupler, rocker] = [q[0], q[0] + q[1], q[2]];
        let of_coupler = 0.2 * (rocker - crank).sin() / (0.25 * (coupler - rocker).sin());
        let of_rocker = 0.2 * (crank - coupler).sin() / (0.1 * (rocker - coupler).sin());
        let want = (of_coupler - 1.0).abs().max(of_rocker.abs()).max(1.0);
        let transmission = found.conditioning.transmission;
        match found.regular(NEAR_SINGULAR) {
            Ok(tau) => {
                assert_eq!(tau, found.tau);
                errors.push((transmission / want - 1.0).abs());
                assert!(tau[0].abs() < 1e6, "{tau:?}");
            }
            Err(error) => {
                assert_eq!(error.cluster, "rocker");
                assert!(error.damped || want > 0.99 * NEAR_SINGULAR, "{error} {want}");
            }
        }
    }
    assert!(largest > 1e10, "a torque that no motor has: {largest:e} N·m");
    let error = errors.iter().fold(0.0, |a: f64, &b| a.max(b));
    hold("transmission of a four-bar against the sine rule", error, 1e-13);
    let (_, damped) = at(1e-12);
    let error = damped.regular(NEAR_SINGULAR).expect_err("it is damped");
    assert!(error.damped && error.to_string().contains("at a singular configuration"));
}

#[test]
fn massless_links_are_accepted_but_massless_clusters_are_not() {
    let y = State { q: [0.2, 1.0], qd: [1.0, 2.0], qdd: [3.0, 4.0] };
    let tau = Clustered::<Core<Light<1>>>::rnea(&y, &RIGID_BODY).expect("it closes");
    let again =
        Clustered::<Core<Light<1>>>::aba(&y, &tau, &RIGID_BODY).expect("the rocker has mass");
    assert!(apart(&again, &y.qdd) < 1e-12);
    let none =
        Clustered::<Core<Light<0>>>::aba(&y, &[0.0; 2], &RIGID_BODY).expect_err("no inertia");
    let engine = Clustered::<Engine<Light<0>>>::forward_dynamics(&y, &[0.0; 2], &RIGID_BODY);
    assert_eq!(engine, Err(none));
    let ForwardError::Cluster(error) = none else { panic!("{none:?}") };
    assert_eq!((error.cluster, error.problem), ("parallelogram", ClusterProblem::NoInertia));
}

#[test]
fn torque_at_a_singularity_is_finite_and_bounded() {
    let swinging = |off| State { q: [0.2, off], qd: [0.0, 2.0], qdd: [0.0, 10.0] };
    for off in [0.0, 1e-9, PI, PI + 1e-9] {
        let y = swinging(off);
        let motion = Clustered::<Core<Light<1>>>::motion(&y).expect("it closes");
        assert_eq!(motion.singular(), Some("parallelogram"));
        let tau = Clustered::<Core<Light<1>>>::rnea(&y, &RIGID_BODY).expect("it closes");
        assert!(tau.iter().all(|tau| tau.is_finite()), "{tau:?}");
    }
    // The motor at the rocker is at a dead point there, and nowhere else.
    let motors = |off, tau| {
        let motion = Clustered::<Core<Light<1>>>::motion(&swinging(off)).expect("it closes");
        motion.to_motors(&[1.0, tau])
    };
    let dead = motors(0.0, 2.0).expect("finite");
    assert_eq!(dead.singular, Some("parallelogram"));
    assert!(dead.tau[0] == 1.0 && dead.tau[1].abs() < 2.0 / DEAD_POINT);
    let away = motors(1.0, 2.0).expect("finite");
    assert_eq!((away.tau[0], away.singular), (1.0, None));
    for bad in [f64::NAN, f64::INFINITY] {
        let error = motors(1.0, bad).expect_err("no number");
        assert_eq!((error.cluster, error.problem), ("parallelogram", ClusterProblem::NotFinite));
    }
}

#[test]
fn the_four_bar_obeys_its_closed_form_and_virtual_work() {
    // Freudenstein: K₁ cos ψ − K₂ cos φ + K₃ = cos(φ − ψ) of crank φ and rocker ψ, and dψ/dφ from
    // its derivative.
    let (ground, crank, coupler, rocker) = (0.3, 0.12, 0.28, 0.2);
    let linkage = FourBar::new(ground, crank, coupler, rocker, Branch::Positive);
    let k = [
        ground / crank,
        ground / rocker,
        (ground * ground + crank * crank + rocker * rocker - coupler * coupler)
            / (2.0 * crank * rocker),
    ];
    let (mut random, mut worst) = (Random::new(3), [0.0_f64; 2]);
    for _ in 0..200 {
        let phi = random.number(PI);
        let motion = at::<f64, _, 3>(&linkage, phi).expect("a crank that turns all around");
        let psi = motion.q[2].q;
        let rest = k[0] * psi.cos() - k[1] * phi.cos() + k[2] - (phi - psi).cos();
        let difference = (phi - psi).sin();
        let slope = (k[1] * phi.sin() + difference) / (k[0] * psi.sin() + difference);
        worst[0] = worst[0].max(rest.abs());
        worst[1] = worst[1].max((motion.g[2][0] - slope).abs() / slope.abs().max(1.0));
    }
    hold("Freudenstein's equation", worst[0], 1e-14);
    hold("its derivative", worst[1], 2e-15);

    // A weight on the rocker of a linkage without other masses: τ = m g·dc/dφ.
    let y = State { q: [0.0, 1.1], qd: [0.0; 2], qdd: [0.0; 2] };
    let [_, tau] = Clustered::<Core<Light<2>>>::rnea(&y, &Gravity::EARTH).expect("it closes");
    assert!(tau.abs() < 1e-15); // in a horizontal plane
    let y = State { q: [FRAC_PI_2, 1.1], ..y };
    let [_, tau] = Clustered::<Core<Light<2>>>::rnea(&y, &Gravity::EARTH).expect("it closes");
    // The plane's y is up: the rocker of a parallelogram turns as its crank.
    let expected = 2.0 * 9.81 * 0.1 * 1.1_f64.cos();
    assert!((tau - expected).abs() < 1e-14, "{tau} {expected}");
}

#[test]
fn motor_torques_have_the_power_of_joint_torques() {
    let mut worst = 0.0_f64;
    for y in ankle_states() {
        let motion = Clustered::<Core<AnkleLeg>>::motion(&y).expect("it closes");
        let tau = Clustered::<Core<AnkleLeg>>::rnea(&y, &RIGID_BODY).expect("it closes");
        let found = motion.to_motors(&tau).expect("finite");
        assert_eq!(found.singular, None);
        let motors = found.tau;
        worst = worst.max(apart(&motion.from_motors(&motors), &tau));
        let tree = motion.state();
        let qd = dynamics_core::state::RobotState::state(&tree).qd;
        let power: f64 = tau.iter().zip(&y.qd).map(|(tau, yd)| tau * yd).sum();
        let of_motors = motors[0] * qd[0] + motors[1] * qd[3] + motors[2] * qd[6];
        worst = worst.max((power - of_motors).abs() / 100.0);
    }
    hold("torque of motors", worst, 5e-16);

    let still = [0.0; 2].map(JointCoordinate::revolute);
    let dead = DEAD.evaluate::<f64, Native>(&still, &[1.0; 2]);
    assert!(dead.expect("it closes").singular);
}

/// Cranks and rods in line at rest.
const DEAD: ParallelAnkle = {
    const fn rod(side: f64) -> Rod {
        Rod {
            joint: [-0.04, side, 0.2],
            crank: [0.0, 0.0, -0.05],
            foot: [-0.04, side, 0.0],
            length: 0.15,
            branch: Branch::Positive,
        }
    }
    ParallelAnkle::new([rod(0.03), rod(-0.03)])
};

/// A joint that moves nothing, in no cluster.
struct Idle;

impl Robot<5, 5, 5> for Idle {
    const MODEL: ArmModel<f64, 5> = {
        let z = Joint::revolute([0.0, 0.0, 1.0]);
        Model::new(
            "idle",
            [
                Body::new("crank", BASE, z),
                Body::new("coupler", 0, z).xyz([0.1, 0.0, 0.0]).mass(1.0),
                Body::new("rocker", BASE, z).xyz([0.3, 0.0, 0.0]).mass(1.0).com([0.1, 0.0, 0.0]),
                Body::new("arm", 2, z).mass(1.0).com([0.1, 0.0, 0.0]),
                Body::new("nothing", 3, z).xyz([0.1, 0.0, 0.0]),
            ],
        )
    };
}

impl ClusteredRobot<5, 5, 5, 3, 3> for Idle {
    type Clusters = (Driven<FourBar, 3, 1>,);
    const CLUSTERS: Self::Clusters = (Driven::new("parallelogram", FLAT),);
    const COORDINATES: &'static [&'static [usize]] = &[&[0, 1, 2]];
}

#[test]
fn a_joint_that_moves_nothing_is_named() {
    let y = State::at([1.0, 0.3, 0.2]);
    let error = Clustered::<Core<Idle>>::aba(&y, &[0.0; 3], &RIGID_BODY).expect_err("no inertia");
    let ForwardError::Joint(NotPositiveDefinite { joint, .. }) = error else { panic!("{error:?}") };
    assert_eq!(joint, 4);
}

/// A number that is not finite in y, ẏ, ÿ or τ is an error of every function, and no NaN.
fn not_finite<T, const B: usize, const N: usize, const Y: usize>(y: State<f32, Y, Y>)
where
    T: ClusteredRobot<B, N, N, Y, Y>,
{
    let is_error = |result: Result<[f32; Y], ClusterError>| {
        assert_eq!(result.map_err(|e| e.problem), Err(ClusterProblem::NotFinite));
    };
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for k in 0..Y {
            let mut all = [y; 3];
            (all[0].q[k], all[1].qd[k], all[2].qdd[k]) = (bad, bad, bad);
            for y in &all {
                is_error(Clustered::<Core<T>>::rnea(y, &RIGID_BODY));
                is_error(Clustered::<Engine<T>>::rnea(y, &RIGID_BODY));
                let motors = Clustered::<Engine<T>>::rnea_of_motors(y, &RIGID_BODY);
                is_error(motors.map(|found| found.tau));
            }
            let mut tau = [1.0; Y];
            tau[k] = bad;
            for (y, tau) in [(&all[0], &[1.0; Y]), (&all[1], &[1.0; Y]), (&y, &tau)] {
                let found = Clustered::<Core<T>>::aba(y, tau, &RIGID_BODY);
                assert!(found.is_err(), "{found:?}");
            }
        }
    }
    assert!(Clustered::<Engine<T>>::rnea(&y, &RIGID_BODY).is_ok());
}

#[test]
fn numbers_that_are_not_finite_are_errors() {
    let at = |q| State { q, qd: [1.0; 3], qdd: [1.0; 3] };
    not_finite::<FourBarLeg, 5, 5, 3>(at([0.1, 0.2, 0.3]));
    not_finite::<AnkleLeg, 9, 9, 3>(at([0.1, 0.2, 0.1]));
    not_finite::<DeltaRobot, 12, 12, 3>(at([0.1, 0.2, 0.3]));
    not_finite::<StewartPlatform, 24, 24, 6>(State {
        q: [0.0, 0.0, 0.8, 0.1, 0.1, 0.1],
        qd: [1.0; 6],
        qdd: [1.0; 6],
    });
}
