//! The engine's M(q) and J(q) on trees, with prismatic joints, rotors and payloads.

use dynamics_core::algorithms::NotPositiveDefinite;
use dynamics_core::algorithms::frame::LocalWorldAligned;
use dynamics_core::effects::{Armature, Coriolis, Effect, Gravity, Inertia, Payload, RIGID_BODY};
use dynamics_core::model::{BASE, Body, BodyInertia, Joint, Model, OnBody, Robot};
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine, TreeMatrix};
use host_tests::measured::largest;
use host_tests::stress_robot::StressRobot;
use host_tests::tolerances;
use proptest::prelude::RngExt;
use proptest::test_runner::{RngAlgorithm, TestRng};

pub(super) const ROTORS: Armature<f64, 7> = Armature([0.2, 0.1, 0.3, 0.05, 0.15, 0.4, 0.25]);

/// Random numbers from −1 to 1, times the requested scale.
pub(super) struct Random(TestRng);

impl Random {
    pub(super) fn new() -> Self {
        Self(TestRng::deterministic_rng(RngAlgorithm::ChaCha))
    }

    pub(super) fn array<R: Real, const N: usize>(&mut self, bound: f64) -> [R; N] {
        core::array::from_fn(|_| R::from_f64(self.0.random_range(-bound..bound)))
    }

    pub(super) fn state<R: Real, const N: usize>(&mut self) -> State<R, N, N> {
        State { q: self.array(3.0), qd: self.array(3.0), qdd: self.array(10.0) }
    }
}

fn payload<R: Real, const BODY: usize>() -> Payload<R, BODY> {
    let inertia = [0.03, -0.004, 0.002, 0.05, 0.006, 0.04].map(R::from_f64);
    Payload::from_inertia(BodyInertia {
        mass: R::from_f64(2.5),
        com: [0.1, -0.2, 0.3].map(R::from_f64),
        inertia,
    })
}

pub(super) fn check(robot: &str, quantity: &str, scalar: &str, error: f64) {
    if let Err(e) = tolerances::check(robot, quantity, scalar, error) {
        panic!("{e}");
    }
}

/// M against what the core's inverse dynamics asks for one acceleration at a time.
fn columns<T, E, const B: usize, const N: usize>(scene: &E, quantity: &str)
where
    T: Robot<B, N, N>,
    E: Effect<f64, B, N>,
{
    let (mut random, mut worst, mut scale) = (Random::new(), 0.0_f64, 0.0_f64);
    let mut tree = TreeMatrix::ZERO;
    for _ in 0..200 {
        let q = random.array(3.0);
        let m = Engine::<T>::crba(&q, scene);
        Engine::<T>::tree_crba(&q, scene, &mut tree);
        assert_eq!(tree.square(), m);
        let full = Engine::<T>::ltdl(&m).expect("M is positive");
        let factors = Engine::<T>::tree_ltdl(&mut tree).expect("M is positive");
        let found = Engine::<T>::tree_solve(&factors, &[1.0; N]);
        assert_eq!(found, Engine::<T>::solve(&full, &[1.0; N]));
        for j in 0..N {
            let mut state = State::at(q);
            state.qdd[j] = 1.0;
            let column = Core::<T>::rnea(&state, scene);
            for (i, column) in column.into_iter().enumerate() {
                worst = largest([worst, (m.get(i, j) - column).abs()]);
                scale = scale.max(column.abs());
                assert_eq!(m.get(i, j), m.get(j, i));
            }
        }
    }
    check(T::MODEL.name, quantity, "f64", worst / scale);
}

#[test]
fn columns_of_m_are_torques_of_unit_accelerations() {
    columns::<StressRobot, _, 11, 7>(&(Inertia,), "engine columns of M");
    #[cfg(feature = "full")]
    columns::<dynamics_core::robots::A1, _, 16, 12>(&(Inertia,), "engine columns of M");
}

#[test]
fn rotors_and_payload_belong_to_m() {
    let scene = (Inertia, ROTORS, payload::<_, 10>());
    columns::<StressRobot, _, 11, 7>(&scene, "engine loaded M");
}

/// The largest error of `invert` on what the core's inverse dynamics gives.
fn inverted<R: Real, T, E, const B: usize, const N: usize>(
    scene: &E,
    quantity: &str,
    invert: impl Fn(&State<R, N, N>, &[R; N], &E) -> Result<[R; N], NotPositiveDefinite>,
) where
    T: Robot<B, N, N>,
    E: Effect<R, B, N>,
{
    let (mut random, mut worst) = (Random::new(), 0.0_f64);
    for _ in 0..200 {
        let state = random.state();
        let tau = Core::<T>::rnea(&state, scene);
        let found = invert(&state, &tau, scene).expect("M is positive");
        for (found, want) in found.iter().zip(state.qdd) {
            worst = largest([worst, (found.to_f64() - want.to_f64()).abs() / 10.0]);
        }
    }
    check(T::MODEL.name, quantity, std::any::type_name::<R>(), worst);
}

// Rotors and a payload are part of the tree.
#[test]
fn forward_dynamics_inverts_rnea_on_an_odd_tree() {
    let quantity = "engine forward of rnea";
    let scene = (Gravity::EARTH, Inertia, Coriolis, ROTORS, payload::<_, 10>());
    inverted::<f64, StressRobot, _, 11, 7>(&scene, quantity, |state, tau, scene| {
        Engine::<StressRobot>::forward_dynamics(state, tau, scene)
    });
}

/// A chain of twelve joints.
struct Long;

impl Robot<12, 12, 12> for Long {
    const MODEL: Model<f64, 12, 12, 12> = {
        let joint = Joint::revolute([0.0, 0.6, 0.8]);
        let mut bodies = [Body::new("link", BASE, joint); 12];
        let mut i = 0;
        while i < 12 {
            bodies[i] = Body::new("link", if i == 0 { BASE } else { i - 1 }, joint)
                .xyz([0.1, -0.05, 0.2])
                .rpy([1.1, 0.0, 0.4 * i as f64])
                .mass(1.5)
                .com([0.02, 0.01, 0.1])
                .inertia([0.02, 0.001, -0.002, 0.03, 0.003, 0.015]);
            i += 1;
        }
        Model::new("long", bodies)
    };
}

// The bits say which way it was: those of an arm differ from those of articulated bodies.
#[test]
fn the_compiler_takes_articulated_bodies_for_long_branches_alone() {
    let mut random = Random::new();
    let state = random.state::<f64, 12>();
    let tau = Core::<Long>::rnea(&state, &RIGID_BODY);
    let found = Engine::<Long>::forward_dynamics(&state, &tau, &RIGID_BODY);
    assert_eq!(found, Engine::<Long>::aba(&state, &tau, &RIGID_BODY));
    for (found, want) in found.expect("M is positive").iter().zip(state.qdd) {
        assert!((found - want).abs() < 1e-8, "{found} {want}");
    }
    let (state, tau) = (random.state::<f64, 6>(), random.array(100.0));
    let short = Engine::<Ur5e>::forward_dynamics(&state, &tau, &RIGID_BODY);
    assert_ne!(short, Engine::<Ur5e>::aba(&state, &tau, &RIGID_BODY));
}

/// A smaller odd tree, since articulated bodies take the compiler long.
pub(super) struct Fork;

impl Robot<4, 4, 4> for Fork {
    const MODEL: Model<f64, 4, 4, 4> = Model::new(
        "fork",
        [
            Body::new("rail", BASE, Joint::revolute([1.0, 2.0, -0.5]))
                .mass(2.0)
                .com([0.1, -0.2, 0.3])
                .inertia([0.2, 0.01, -0.02, 0.3, 0.03, 0.25]),
            Body::new("quill", 0, Joint::prismatic([0.3, -0.4, 0.8]))
                .xyz([0.3, 0.5, -0.2])
                .rpy([-0.5, 1.2, 0.7])
                .mass(1.5)
                .com([-0.1, 0.2, 0.3])
                .inertia([0.1, 0.01, -0.02, 0.12, 0.03, 0.15]),
            Body::new("left", 1, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.0, 0.3, 0.3])
                .rpy([0.1, 0.2, 0.3])
                .mass(0.8)
                .com([0.15, 0.02, 0.1])
                .inertia([0.05, 0.004, 0.0, 0.06, 0.0, 0.04]),
            Body::new("right", 1, Joint::prismatic([-1.0, 0.2, 0.0]))
                .xyz([0.2, 0.1, 0.3])
                .rpy([1.1, 0.2, 0.3])
                .mass(0.9)
                .com([0.15, -0.12, 0.1])
                .inertia([0.05, 0.004, 0.0, 0.06, 0.0, 0.04]),
        ],
    );
}

// Rotors and a payload are part of the tree.
#[test]
fn aba_inverts_rnea_on_an_odd_tree() {
    let rotors = Armature([0.2, 0.1, 0.3, 0.05]);
    let scene = (Gravity::EARTH, Inertia, Coriolis, rotors, payload::<_, 3>());
    inverted::<f64, Fork, _, 4, 4>(&scene, "engine aba of rnea", |state, tau, scene| {
        Engine::<Fork>::aba(state, tau, scene)
    });
}

#[test]
fn solve_inverts_m() {
    let (mut random, mut worst) = (Random::new(), 0.0_f64);
    for _ in 0..200 {
        let m = Engine::<StressRobot>::crba(&random.array(3.0), &RIGID_BODY);
        let x: [f64; 7] = random.array(1.0);
        let tau = core::array::from_fn(|i| (0..7).map(|j| m.get(i, j) * x[j]).sum());
        let factor = Engine::<StressRobot>::ltdl(&m).expect("M is positive");
        let found: [f64; 7] = Engine::<StressRobot>::solve(&factor, &tau);
        for (found, x) in found.iter().zip(x) {
            worst = largest([worst, (found - x).abs()]);
        }
    }
    check("odd", "engine solve", "f64", worst);
}

/// J against the core's, which is compared with Pinocchio's.
fn jacobian<R: Real, T, const B: usize, const N: usize, const BODY: usize>()
where
    T: Robot<B, N, N>,
{
    let (mut random, mut worst) = (Random::new(), 0.0_f64);
    for _ in 0..200 {
        let q: [R; N] = random.array(3.0);
        let found = Engine::<T>::jacobian(&q, OnBody::<BODY>, LocalWorldAligned);
        let want = Core::<T>::jacobian(&q.map(R::to_f64), BODY, LocalWorldAligned);
        for (found, want) in found.iter().zip(want) {
            for (found, want) in [(found.ang, want.ang), (found.lin, want.lin)] {
                for (found, want) in found.array().iter().zip(want.to_array()) {
                    worst = largest([worst, (found.to_f64() - want).abs()]);
                }
            }
        }
    }
    let scalar = std::any::type_name::<R>();
    check(T::MODEL.name, "engine jacobian", scalar, worst);
}

#[test]
fn the_jacobian_is_that_of_the_users_frame() {
    jacobian::<f64, Ur5e, 6, 6, 5>();
    jacobian::<f64, Fork, 4, 4, 3>();
    #[cfg(feature = "full")]
    {
        use dynamics_core::robots::{A1, Iiwa14, Panda};
        jacobian::<f32, Panda, 7, 7, 6>();
        jacobian::<f32, Iiwa14, 7, 7, 6>();
        jacobian::<f64, A1, 16, 12, 15>();
    }
}

/// A robot on rails whose last link weighs nothing.
struct Massless;

impl Robot<3, 3, 3> for Massless {
    const MODEL: Model<f64, 3, 3, 3> = Model::new(
        "massless",
        [
            Body::new("rail", BASE, Joint::prismatic([1.0, 0.0, 0.0])).mass(2.0),
            Body::new("arm", 0, Joint::revolute([0.0, 0.0, 1.0])).mass(1.0).com([0.3, 0.0, 0.0]),
            Body::new("tip", 1, Joint::revolute([0.0, 1.0, 0.0])).xyz([0.5, 0.0, 0.0]),
        ],
    );
}

#[test]
fn a_joint_that_moves_no_inertia_is_named() {
    let (state, tau) = (State::at([0.1, 0.2, 0.3]), [1.0; 3]);
    let error = |qdd: Result<[f64; 3], _>| qdd.expect_err("a massless tip");
    // The arm's own joint moves what the tip does not: a point on its axis would be no inertia.
    let forward = error(Engine::<Massless>::forward_dynamics(&state, &tau, &RIGID_BODY));
    assert_eq!(forward, error(Engine::<Massless>::aba(&state, &tau, &RIGID_BODY)));
    assert_eq!(forward, error(Core::<Massless>::aba(&state, &tau, &RIGID_BODY)));
    assert_eq!(forward.joint, 2);
    let m = Engine::<Massless>::crba(&state.q, &RIGID_BODY);
    assert_eq!(Engine::<Massless>::ltdl(&m).map(|_| ()), Err(forward));
    // A rotor is inertia enough, and a payload that is not a number is not.
    let rotors = (Inertia, Armature([0.0, 0.0, 0.1]));
    assert!(Engine::<Massless>::forward_dynamics(&state, &tau, &rotors).is_ok());
    assert!(Engine::<Massless>::aba(&state, &tau, &rotors).is_ok());
    let broken = (
        Inertia,
        Payload::<_, 2>::from_inertia(BodyInertia {
            mass: f64::NAN,
            com: [0.0; 3],
            inertia: [0.1; 6],
        }),
    );
    assert!(Engine::<Massless>::forward_dynamics(&state, &tau, &broken).is_err());
    assert!(Engine::<Massless>::aba(&state, &tau, &broken).is_err());
}
