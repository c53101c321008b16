//! Laws that hold for every robot, and closed forms for a few: oracles that need no recording.

use dynamics_core::algorithms::{aba, rnea};
use dynamics_core::effects::{
    Coriolis, Coulomb, Effect, Gravity, Inertia, JointState, RIGID_BODY, RotorInertia, Viscous,
    smooth_sign,
};
use dynamics_core::model::{Arm, BASE, Body, Joint, JointKind, Model, Robot, model};
use dynamics_core::robots::{A1, Iiwa14, Panda, Ur5e};
use dynamics_core::scalar::Real;
use dynamics_core::spatial::{Force, Motion};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use glam::{DMat3, DVec3};
use host_tests::tolerances;
use proptest::prelude::RngExt;
use proptest::test_runner::{RngAlgorithm, TestRng};

const G: f64 = 9.81;

fn random_numbers() -> TestRng {
    TestRng::deterministic_rng(RngAlgorithm::ChaCha)
}

fn within<const N: usize>(rng: &mut TestRng, bound: f64) -> [f64; N] {
    core::array::from_fn(|_| rng.random_range(-bound..bound))
}

fn random_state<const N: usize>(rng: &mut TestRng) -> State<f64, N, N> {
    State {
        q: within(rng, std::f64::consts::PI),
        qd: within(rng, 3.0),
        qdd: within(rng, 10.0),
    }
}

fn cast<R: Real, const N: usize>(state: &State<f64, N, N>) -> State<R, N, N> {
    State {
        q: state.q.map(R::from_f64),
        qd: state.qd.map(R::from_f64),
        qdd: state.qdd.map(R::from_f64),
    }
}

/// A tree of nine bodies and seven joints, revolute and prismatic, on axes, placements and
/// inertias of any kind; welds, branches and several roots wherever they fall.
fn random_tree(rng: &mut TestRng) -> Model<f64, 9, 7, 7> {
    const NAMES: [&str; 9] = ["a", "b", "c", "d", "e", "f", "g", "h", "i"];
    let welds = [rng.random_range(0..4), rng.random_range(4..9)];
    let bodies = core::array::from_fn(|i| {
        let parent = match rng.random_range(0..=i) {
            0 => BASE,
            // Every other body prolongs a chain.
            j => {
                if i % 2 == 0 {
                    i - 1
                } else {
                    j - 1
                }
            }
        };
        let axis = within(rng, 1.0);
        let joint = match rng.random_range(0..3) {
            _ if welds.contains(&i) => Joint::fixed(),
            0 => Joint::prismatic(axis),
            _ => Joint::revolute(axis),
        };
        // The inertia of six points: nothing that could not be a body's.
        let (mut mass, mut moment, mut second) = (0.0, DVec3::ZERO, DMat3::ZERO);
        for _ in 0..6 {
            let (m, r) = (rng.random_range(0.1..0.5), DVec3::from(within(rng, 0.3)));
            mass += m;
            moment += m * r;
            second += DMat3::from_cols(r * r.x, r * r.y, r * r.z) * m;
        }
        let com = moment / mass;
        second -= DMat3::from_cols(com * com.x, com * com.y, com * com.z) * mass;
        let trace = second.x_axis.x + second.y_axis.y + second.z_axis.z;
        let about_com = DMat3::from_diagonal(DVec3::splat(trace)) - second;
        let [x, y, z] = about_com.to_cols_array_2d();
        Body::new(NAMES[i], parent, joint)
            .xyz(within(rng, 0.5))
            .rpy(within(rng, 3.0))
            .mass(mass)
            .com(com.to_array())
            .inertia([x[0], x[1], x[2], y[1], y[2], z[2]])
    });
    Model::new("tree", bodies)
}

/// The worst error of a law and the full scale of what it speaks of.
#[derive(Default)]
struct Worst {
    error: f64,
    full_scale: f64,
}

impl Worst {
    fn see(&mut self, got: f64, want: f64) {
        let error = (got - want).abs();
        assert!(error.is_finite());
        self.error = self.error.max(error);
        self.full_scale = self.full_scale.max(want.abs());
    }

    fn relative(&self) -> f64 {
        self.error / self.full_scale
    }

    fn check<R>(&self, robot: &str, law: &str) {
        tolerances::check(robot, law, std::any::type_name::<R>(), self.relative())
            .unwrap_or_else(|e| panic!("{e}"));
    }
}

/// FD(q, q̇, ID(q, q̇, q̈)) = q̈ under a scene with friction and rotors, on `states` states.
fn invert<R: Real, const B: usize, const N: usize>(
    model: &Model<R, B, N, N>,
    rng: &mut TestRng,
    states: usize,
    worst: &mut Worst,
) {
    let scene = (
        Gravity::EARTH,
        Inertia,
        Coriolis,
        Viscous([R::from_f64(0.5); N]),
        Coulomb {
            torque: [R::ONE; N],
            per_width: R::from_f64(10.0),
        },
        RotorInertia([R::from_f64(0.1); N]),
        Drag,
    );
    for _ in 0..states {
        let state = cast::<R, N>(&random_state(rng));
        let tau = rnea(model, &state, &scene);
        let qdd = aba(model, &state, &tau, &scene).expect("M is positive definite");
        for (got, want) in qdd.iter().zip(state.qdd) {
            worst.see(got.to_f64(), want.to_f64());
        }
    }
}

#[test]
fn aba_inverts_rnea() {
    fn robot<T: Robot<B, N, N>, const B: usize, const N: usize>() {
        let (mut double, mut single) = (Worst::default(), Worst::default());
        let rng = &mut random_numbers();
        invert(model::<f64, T, B, N, N>(), rng, 500, &mut double);
        invert(model::<f32, T, B, N, N>(), rng, 500, &mut single);
        double.check::<f64>(T::MODEL.name, "aba of rnea");
        single.check::<f32>(T::MODEL.name, "aba of rnea");
    }
    robot::<Ur5e, 6, 6>();
    robot::<Panda, 7, 7>();
    robot::<Iiwa14, 7, 7>();
    robot::<A1, 16, 12>();
    let (mut double, mut single) = (Worst::default(), Worst::default());
    let rng = &mut random_numbers();
    for _ in 0..100 {
        let tree = random_tree(rng);
        invert(&tree, rng, 10, &mut double);
        invert(&tree.to_f32(), rng, 10, &mut single);
    }
    double.check::<f64>("tree", "aba of rnea");
    single.check::<f32>("tree", "aba of rnea");
}

/// The columns of M, as Featherstone & Orin (9): D(q, q̇, e_i) − D(q, q̇, 0) = D(q, 0, e_i) − D(q, 0, 0).
fn mass_matrix<const B: usize, const N: usize>(
    model: &Model<f64, B, N, N>,
    q: [f64; N],
) -> [[f64; N]; N] {
    core::array::from_fn(|i| {
        let mut state = State::at(q);
        state.qdd[i] = 1.0;
        rnea(model, &state, &(Inertia,))
    })
}

/// Whether M = L Lᵀ with a positive diagonal.
fn is_positive_definite<const N: usize>(m: &[[f64; N]; N]) -> bool {
    let mut l = [[0.0_f64; N]; N];
    for i in 0..N {
        for j in 0..=i {
            let s = m[i][j] - (0..j).map(|k| l[i][k] * l[j][k]).sum::<f64>();
            if i != j {
                l[i][j] = s / l[j][j];
            } else if s > 0.0 {
                l[i][i] = s.sqrt();
            } else {
                return false;
            }
        }
    }
    true
}

/// What holds for every model in every state.
trait Law {
    fn hold<const B: usize, const N: usize>(
        model: &Model<f64, B, N, N>,
        state: &State<f64, N, N>,
        worst: &mut Worst,
    );
}

/// Holds a law on every robot and on random trees; the worst error relative to a robot's own
/// full scale.
fn worst_of_all<L: Law>() -> f64 {
    fn robot<L: Law, T: Robot<B, N, N>, const B: usize, const N: usize>() -> f64 {
        let (rng, mut worst) = (&mut random_numbers(), Worst::default());
        for _ in 0..100 {
            L::hold(&T::MODEL, &random_state(rng), &mut worst);
        }
        worst.relative()
    }
    let (rng, mut worst) = (&mut random_numbers(), Worst::default());
    for _ in 0..100 {
        let tree = random_tree(rng);
        L::hold(&tree, &random_state(rng), &mut worst);
    }
    [
        robot::<L, Ur5e, 6, 6>(),
        robot::<L, Panda, 7, 7>(),
        robot::<L, Iiwa14, 7, 7>(),
        robot::<L, A1, 16, 12>(),
        worst.relative(),
    ]
    .into_iter()
    .fold(0.0, f64::max)
}

fn check_all<L: Law>(law: &str) {
    tolerances::check("all", law, "f64", worst_of_all::<L>()).unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn the_mass_matrix_is_symmetric_and_positive_definite() {
    struct Symmetry;
    impl Law for Symmetry {
        fn hold<const B: usize, const N: usize>(
            model: &Model<f64, B, N, N>,
            state: &State<f64, N, N>,
            worst: &mut Worst,
        ) {
            let m = mass_matrix(model, state.q);
            assert!(is_positive_definite(&m), "{}: {m:?}", model.name);
            for (i, row) in m.iter().enumerate() {
                for (j, column) in m.iter().enumerate() {
                    worst.see(row[j], column[i]);
                }
            }
        }
    }
    check_all::<Symmetry>("symmetry of M");
}

#[test]
fn columns_of_the_mass_matrix_are_differences_of_inverse_dynamics() {
    struct Columns;
    impl Law for Columns {
        fn hold<const B: usize, const N: usize>(
            model: &Model<f64, B, N, N>,
            state: &State<f64, N, N>,
            worst: &mut Worst,
        ) {
            let mut state = *state;
            state.qdd = [0.0; N];
            let bias = rnea(model, &state, &RIGID_BODY);
            for (i, column) in mass_matrix(model, state.q).iter().enumerate() {
                let mut one = state;
                one.qdd[i] = 1.0;
                let tau = rnea(model, &one, &RIGID_BODY);
                for j in 0..N {
                    worst.see(bias[j] + column[j], tau[j]);
                }
            }
        }
    }
    check_all::<Columns>("columns of M");
}

/// A drag on every body: fˣ = −v/5.
struct Drag;

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Drag {
    const WRENCH: bool = true;
    const BODY_VELOCITY: bool = true;

    fn wrench(&self, _: usize, velocity: Motion<R>, fx: &mut Force<R>) {
        let k = R::from_f64(0.2);
        *fx -= Force::new(velocity.ang * k, velocity.lin * k);
    }
}

/// What positions and velocities in base coordinates say: kinetic energy, potential energy and
/// Σ |ω|² + |v|² of the bodies' origins.
fn energies<const B: usize, const N: usize>(
    model: &Model<f64, B, N, N>,
    q: &[f64; N],
    qd: &[f64; N],
) -> [f64; 3] {
    let mut poses = [(DMat3::IDENTITY, DVec3::ZERO, DVec3::ZERO, DVec3::ZERO); B];
    let mut sums = [0.0; 3];
    for (i, link) in model.links.iter().enumerate() {
        let mut pose = (DMat3::IDENTITY, DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
        if link.parent != BASE {
            pose = poses[link.parent];
        }
        let (mut rot, mut p, mut omega, mut v) = pose;
        let mut step = rot * link.placement.pos;
        rot *= link.placement.rot.transpose();
        let mut along = DVec3::ZERO;
        match link.joint.kind {
            JointKind::Revolute => {
                rot *= DMat3::from_axis_angle(link.joint.axis, q[link.q_at]);
                v += omega.cross(step);
                omega += rot * link.joint.axis * qd[link.v_at];
            }
            JointKind::Prismatic => {
                step += rot * link.joint.axis * q[link.q_at];
                along = rot * link.joint.axis * qd[link.v_at];
                v += omega.cross(step);
            }
            _ => v += omega.cross(step),
        }
        p += step;
        v += along;
        poses[i] = (rot, p, omega, v);
        let inertia = &link.inertia;
        let (h, body_omega) = (rot * inertia.moment, rot.transpose() * omega);
        sums[0] += 0.5 * inertia.mass * v.dot(v)
            + v.dot(omega.cross(h))
            + 0.5 * body_omega.dot(inertia.inertia * body_omega);
        sums[1] += G * (inertia.mass * p.z + h.z);
        sums[2] += omega.dot(omega) + v.dot(v);
    }
    sums
}

/// df/dt at 0, by a central difference of the fourth order.
fn slope(f: impl Fn(f64) -> f64) -> f64 {
    let h = 2e-4;
    (8.0 * (f(h) - f(-h)) - f(2.0 * h) + f(-2.0 * h)) / (12.0 * h)
}

/// An oracle of the velocity products, whose gyroscopic part the balance of power cannot see:
/// v · (v ×* I v) = 0.
#[test]
fn torques_are_those_of_lagranges_equations() {
    struct Lagrange;
    impl Law for Lagrange {
        fn hold<const B: usize, const N: usize>(
            model: &Model<f64, B, N, N>,
            state: &State<f64, N, N>,
            worst: &mut Worst,
        ) {
            let (q, qd, qdd) = (state.q, state.qd, state.qdd);
            let tau = rnea(model, state, &RIGID_BODY);
            for (i, tau) in tau.into_iter().enumerate() {
                let momentum = |t: f64| {
                    let q = core::array::from_fn(|j| q[j] + t * (qd[j] + 0.5 * t * qdd[j]));
                    // Exact: the kinetic energy is quadratic in the velocities.
                    let kinetic = |by: f64| {
                        let mut qd: [f64; N] = core::array::from_fn(|j| qd[j] + t * qdd[j]);
                        qd[i] += by;
                        energies(model, &q, &qd)[0]
                    };
                    0.5 * (kinetic(1.0) - kinetic(-1.0))
                };
                let lagrangian = |by: f64| {
                    let mut q = q;
                    q[i] += by;
                    let [kinetic, potential, _] = energies(model, &q, &qd);
                    kinetic - potential
                };
                worst.see(tau, slope(momentum) - slope(lagrangian));
            }
        }
    }
    check_all::<Lagrange>("Lagrange");
}

#[test]
fn motors_supply_the_change_of_energy_and_what_friction_takes() {
    struct Power;
    impl Law for Power {
        fn hold<const B: usize, const N: usize>(
            model: &Model<f64, B, N, N>,
            state: &State<f64, N, N>,
            worst: &mut Worst,
        ) {
            let scene = (Gravity::EARTH, Inertia, Coriolis, Viscous([0.7; N]), Drag);
            let tau = rnea(model, state, &scene);
            let supplied: f64 = tau.iter().zip(state.qd).map(|(tau, qd)| tau * qd).sum();
            let energy = |t: f64| {
                let qd = core::array::from_fn(|i| state.qd[i] + t * state.qdd[i]);
                let q = core::array::from_fn(|i| {
                    state.q[i] + t * (state.qd[i] + 0.5 * t * state.qdd[i])
                });
                let [kinetic, potential, _] = energies(model, &q, &qd);
                kinetic + potential
            };
            let stored = slope(energy);
            let [.., squares] = energies(model, &state.q, &state.qd);
            let lost = 0.7 * state.qd.iter().map(|x| x * x).sum::<f64>() + 0.2 * squares;
            worst.see(supplied, stored + lost);
        }
    }
    check_all::<Power>("power");
}

#[test]
fn kinetic_energy_is_half_qd_m_qd() {
    struct Kinetic;
    impl Law for Kinetic {
        fn hold<const B: usize, const N: usize>(
            model: &Model<f64, B, N, N>,
            state: &State<f64, N, N>,
            worst: &mut Worst,
        ) {
            let m = mass_matrix(model, state.q);
            let mut sum = 0.0;
            for (row, qd) in m.iter().zip(state.qd) {
                sum += 0.5 * qd * row.iter().zip(state.qd).map(|(m, qd)| m * qd).sum::<f64>();
            }
            worst.see(sum, energies(model, &state.q, &state.qd)[0]);
        }
    }
    check_all::<Kinetic>("kinetic energy");
}

#[test]
fn absent_effects_change_nothing() {
    /// An effect of defaults.
    struct Nothing;
    impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Nothing {}

    struct Absent;
    impl Law for Absent {
        fn hold<const B: usize, const N: usize>(
            model: &Model<f64, B, N, N>,
            state: &State<f64, N, N>,
            _: &mut Worst,
        ) {
            let bits = |tau: [f64; N]| tau.map(f64::to_bits);
            let want = bits(rnea(model, state, &RIGID_BODY));
            let scene = (Nothing, Gravity::EARTH, Inertia, Nothing, Coriolis, Nothing);
            assert_eq!(bits(rnea(model, state, &scene)), want);
            assert_eq!(
                bits(rnea(model, state, &(RIGID_BODY, (), (Nothing,)))),
                want
            );
            assert_eq!(
                bits(rnea(model, state, &(Coriolis, Inertia, Gravity::EARTH))),
                want
            );
            assert_eq!(rnea(model, state, &()), [0.0; N]);
            // What a scene does not name does not matter.
            let mut other = *state;
            other.qdd = [f64::NAN; N];
            let gravity = (Gravity::EARTH, Coriolis);
            let want = bits(rnea(model, state, &gravity));
            assert_eq!(bits(rnea(model, &other, &gravity)), want);
            other.qd = [f64::NAN; N];
            let want = bits(rnea(model, state, &(Gravity::EARTH,)));
            assert_eq!(bits(rnea(model, &other, &(Gravity::EARTH,))), want);
        }
    }
    worst_of_all::<Absent>();
}

#[test]
fn torques_of_the_effects_add_up() {
    struct Sum;
    impl Law for Sum {
        fn hold<const B: usize, const N: usize>(
            model: &Model<f64, B, N, N>,
            state: &State<f64, N, N>,
            worst: &mut Worst,
        ) {
            let all = rnea(model, state, &(RIGID_BODY, Drag));
            let parts = [
                rnea(model, state, &(Gravity::EARTH,)),
                rnea(model, state, &(Inertia,)),
                rnea(model, state, &(Coriolis,)),
                rnea(model, state, &(Drag,)),
            ];
            for (i, all) in all.iter().enumerate() {
                worst.see(parts.iter().map(|part| part[i]).sum(), *all);
            }
        }
    }
    check_all::<Sum>("sum of effects");
}

#[test]
fn rotor_inertia_adds_exactly_its_inertia_times_acceleration() {
    fn exactly<R: Real>() {
        let rng = &mut random_numbers();
        let rotors = [2.3, 0.1, 0.7, 0.03, 0.5, 1.1].map(R::from_f64);
        let model = model::<R, Ur5e, 6, 6, 6>();
        for _ in 0..1000 {
            let state = cast::<R, 6>(&random_state(rng));
            let without = rnea(model, &state, &RIGID_BODY);
            let with = rnea(model, &state, &(RIGID_BODY, RotorInertia(rotors)));
            for i in 0..6 {
                assert_eq!(with[i], without[i] + rotors[i] * state.qdd[i]);
            }
        }
    }
    exactly::<f32>();
    exactly::<f64>();
}

#[test]
fn coulomb_friction_is_odd_rises_and_saturates_at_its_torque() {
    fn friction<R: Real>(qd: R) -> R {
        let dry = Coulomb {
            torque: [R::from_f64(4.0)],
            per_width: R::from_f64(50.0),
        };
        let at = JointState {
            q: R::ZERO,
            qd,
            qdd: R::ZERO,
        };
        let mut tau = R::ZERO;
        Effect::<R, 1, 1>::torque(&dry, 0, at, &mut tau);
        tau
    }
    fn holds<R: Real>() {
        let width = 0.02;
        let mut last = -R::from_f64(4.0);
        for i in -3000..=3000 {
            let qd = R::from_f64(f64::from(i) * 2e-5);
            let tau = friction(qd);
            assert_eq!(friction(-qd), -tau, "odd at {qd:?}");
            assert!(tau >= last, "rises at {qd:?}");
            if qd.to_f64().abs() > width {
                let sign = qd.to_f64().signum();
                assert_eq!(tau.to_f64(), 4.0 * sign, "saturates at {qd:?}");
            }
            last = tau;
        }
        for far in [1.0, 1e3, 1e30, f64::INFINITY] {
            assert_eq!(friction(R::from_f64(far)).to_f64(), 4.0);
            assert_eq!(friction(R::from_f64(-far)).to_f64(), -4.0);
        }
        assert_eq!(friction(R::ZERO), R::ZERO);
        // The slope at rest is 3/2 F/w.
        let slope = friction(R::from_f64(1e-6)).to_f64() / 1e-6;
        assert!((slope - 1.5 * 4.0 / width).abs() < 1e-3 * slope, "{slope}");
    }
    holds::<f32>();
    holds::<f64>();
    assert_eq!(smooth_sign(0.5_f64), 0.6875);
}

/// A rod on a pivot: 2 kg, centre of mass 0.5 m below, 0.07 kg·m² about it.
struct Pendulum;

impl Robot<1, 1, 1> for Pendulum {
    const MODEL: Arm<f64, 1> = Model::new(
        "pendulum",
        [Body::new("rod", BASE, Joint::revolute([0.0, -1.0, 0.0]))
            .mass(2.0)
            .com([0.0, 0.0, -0.5])
            .inertia([0.07, 0.0, 0.0, 0.07, 0.0, 0.0])],
    );
}

#[test]
fn a_pendulum_has_its_closed_form() {
    let mut worst = Worst::default();
    let rng = &mut random_numbers();
    for _ in 0..1000 {
        let state = random_state::<1>(rng);
        let want = (0.07 + 2.0 * 0.5 * 0.5) * state.qdd[0] + 2.0 * G * 0.5 * state.q[0].sin();
        worst.see(Core::<Pendulum>::rnea(&state, &RIGID_BODY)[0], want);
        worst.see(Engine::<Pendulum>::rnea(&state, &RIGID_BODY)[0], want);
    }
    worst.check::<f64>("pendulum", "closed form");
}

/// Two links in a vertical plane, angles from the horizontal.
struct TwoLinks;

const LENGTH: f64 = 0.6;
const COM: [f64; 2] = [0.35, 0.2];
const MASS: [f64; 2] = [3.0, 1.7];
const ABOUT_COM: [f64; 2] = [0.11, 0.04];

impl Robot<2, 2, 2> for TwoLinks {
    const MODEL: Arm<f64, 2> = {
        const UP: Joint<f64> = Joint::revolute([0.0, -1.0, 0.0]);
        Model::new(
            "two links",
            [
                Body::new("upper", BASE, UP)
                    .mass(MASS[0])
                    .com([COM[0], 0.0, 0.0])
                    .inertia([0.0, 0.0, 0.0, ABOUT_COM[0], 0.0, ABOUT_COM[0]]),
                Body::new("fore", 0, UP)
                    .xyz([LENGTH, 0.0, 0.0])
                    .mass(MASS[1])
                    .com([COM[1], 0.0, 0.0])
                    .inertia([0.0, 0.0, 0.0, ABOUT_COM[1], 0.0, ABOUT_COM[1]]),
            ],
        )
    };
}

/// The two-link arm of every textbook (Spong, Hutchinson & Vidyasagar, *Robot Modeling and
/// Control*, 2006, section 7.4).
fn two_links(s: &State<f64, 2, 2>) -> [f64; 2] {
    let ([q1, q2], [w1, w2], [a1, a2]) = (s.q, s.qd, s.qdd);
    let ([m1, m2], [lc1, lc2], [i1, i2]) = (MASS, COM, ABOUT_COM);
    let d11 = m1 * lc1 * lc1
        + m2 * (LENGTH * LENGTH + lc2 * lc2 + 2.0 * LENGTH * lc2 * q2.cos())
        + i1
        + i2;
    let d12 = m2 * (lc2 * lc2 + LENGTH * lc2 * q2.cos()) + i2;
    let d22 = m2 * lc2 * lc2 + i2;
    let h = -m2 * LENGTH * lc2 * q2.sin();
    let g2 = m2 * lc2 * G * (q1 + q2).cos();
    let g1 = (m1 * lc1 + m2 * LENGTH) * G * q1.cos() + g2;
    [
        d11 * a1 + d12 * a2 + h * w2 * w1 + h * (w1 + w2) * w2 + g1,
        d12 * a1 + d22 * a2 - h * w1 * w1 + g2,
    ]
}

#[test]
fn a_two_link_arm_has_its_textbook_form() {
    let mut worst = Worst::default();
    let rng = &mut random_numbers();
    for _ in 0..1000 {
        let state = random_state::<2>(rng);
        let want = two_links(&state);
        let core = Core::<TwoLinks>::rnea(&state, &RIGID_BODY);
        let engine = Engine::<TwoLinks>::rnea(&state, &RIGID_BODY);
        for i in 0..2 {
            worst.see(core[i], want[i]);
            worst.see(engine[i], want[i]);
        }
    }
    worst.check::<f64>("two links", "closed form");
}

/// 3 kg on a rail that rises at 30°.
struct Slide;

impl Robot<1, 1, 1> for Slide {
    const MODEL: Arm<f64, 1> = Model::new(
        "slide",
        [Body::new(
            "sledge",
            BASE,
            Joint::prismatic([0.866_025_403_784_438_6, 0.0, 0.5]),
        )
        .mass(3.0)
        .com([0.1, 0.2, 0.3])
        .inertia([0.1, 0.0, 0.0, 0.1, 0.0, 0.1])],
    );
}

/// A spring of 40 N/m.
struct Spring;

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Spring {
    fn torque(&self, _: usize, at: JointState<R>, tau: &mut R) {
        *tau += at.q * R::from_f64(40.0);
    }
}

#[test]
fn a_sledge_on_a_spring_has_its_closed_form() {
    let scene = (RIGID_BODY, Spring);
    let mut worst = Worst::default();
    let rng = &mut random_numbers();
    for _ in 0..1000 {
        let state = random_state::<1>(rng);
        let want = 3.0 * state.qdd[0] + 3.0 * G * 0.5 + 40.0 * state.q[0];
        worst.see(Core::<Slide>::rnea(&state, &scene)[0], want);
        worst.see(Engine::<Slide>::rnea(&state, &scene)[0], want);
        let qdd = Core::<Slide>::aba(&state, &[0.0], &scene).expect("it has mass");
        let want = -(G * 0.5 + 40.0 / 3.0 * state.q[0]);
        worst.see(qdd[0], want);
    }
    worst.check::<f64>("slide", "closed form");
}
