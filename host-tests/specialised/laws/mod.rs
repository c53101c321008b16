//! Laws that hold for every robot, and closed forms for a few: oracles that need no recording.

use dynamics_core::algorithms::{aba, rnea};
use dynamics_core::drivetrain::Transmission;
use dynamics_core::effects::{
    Armature, Coriolis, Coulomb, Effect, Gravity, Inertia, JointState, RIGID_BODY, Viscous, Width,
    hook, smooth_sign,
};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointKind, Model, Robot, model};
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::Real;
use dynamics_core::spatial::Force;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use glam::{DMat3, DVec3};
use host_tests::measured::largest;
use host_tests::tolerances;
use proptest::prelude::RngExt;
use proptest::test_runner::TestRng;

mod closed_forms;
mod effects;
mod samples;

use samples::*;

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
        Coulomb { torque: [R::ONE; N], width: Width::new(R::from_f64(0.1)) },
        Armature([R::from_f64(0.1); N]),
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
    #[cfg(feature = "full")]
    {
        use dynamics_core::robots::{A1, Iiwa14, Panda};
        robot::<Panda, 7, 7>();
        robot::<Iiwa14, 7, 7>();
        robot::<A1, 16, 12>();
    }
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

/// The columns of M, as Featherstone & Orin (9): D(q, q̇, e_i) − D(q, q̇, 0) = D(q, 0, e_i) − D(q,
/// 0, 0).
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

/// A law that holds for every model in every state.
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
    largest([
        robot::<L, Ur5e, 6, 6>(),
        #[cfg(feature = "full")]
        robot::<L, dynamics_core::robots::Panda, 7, 7>(),
        #[cfg(feature = "full")]
        robot::<L, dynamics_core::robots::Iiwa14, 7, 7>(),
        #[cfg(feature = "full")]
        robot::<L, dynamics_core::robots::A1, 16, 12>(),
        worst.relative(),
    ])
}

fn check_all<L: Law>(law: &str) {
    let worst = worst_of_all::<L>();
    // The worst of all robots may be one that is not among the few.
    let held = if cfg!(feature = "full") {
        tolerances::check("all", law, "f64", worst)
    } else {
        tolerances::within("all", law, "f64", worst).map(|_| ())
    };
    held.unwrap_or_else(|e| panic!("{e}"));
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
    const EXTERNAL_WRENCH: hook::Wrench<Self, R> = hook::Wrench::of_velocity(|_, _, at, fx| {
        let k = R::from_f64(0.2);
        *fx -= Force::new(at.velocity.ang * k, at.velocity.lin * k);
    });
}

/// The energies and momenta from positions and velocities in base coordinates: kinetic energy,
/// potential energy and Σ |ω|² + |v|² of the bodies' origins.
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
                rot *= DMat3::from_axis_angle(DVec3::Z, q[link.idx_q]);
                v += omega.cross(step);
                omega += rot * DVec3::Z * qd[link.idx_v];
            }
            JointKind::Prismatic => {
                step += rot * DVec3::Z * q[link.idx_q];
                along = rot * DVec3::Z * qd[link.idx_v];
                v += omega.cross(step);
            }
            _ => v += omega.cross(step),
        }
        p += step;
        v += along;
        poses[i] = (rot, p, omega, v);
        let inertia = &link.inertia;
        let (h, body_omega) = (rot * inertia.first_moment, rot.transpose() * omega);
        sums[0] += 0.5 * inertia.mass * v.dot(v)
            + v.dot(omega.cross(h))
            + 0.5 * body_omega.dot(inertia.rotational * body_omega);
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
fn motor_power_is_energy_rate_plus_friction_loss() {
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

/// MotorState on a differential of two joints, a mimicked pair, and gears: they feel Gᵀ M G, and
/// their power is the joints'.
#[test]
fn a_transmission_keeps_power_and_reflects_inertia() {
    let g = [
        [0.01, 0.0, 0.0, 0.0],
        [0.0, 0.5, 0.5, 0.0],
        [0.0, 0.5, -0.5, 0.0],
        [0.0, 0.0, 0.0, 0.02],
        [0.0, 0.0, 0.0, -0.02],
        [0.3, 0.1, 0.0, 0.0],
    ];
    let transmission = Transmission { matrix: g, offset: [0.1, -1.2, 1.5, 0.3, 0.0, 0.2] };
    let rng = &mut random_numbers();
    for _ in 0..100 {
        let motors = random_state::<4>(rng);
        let state = transmission.state(&motors);
        let m = Core::<Ur5e>::crba(&state.q, &RIGID_BODY);
        let felt = transmission.inertia(&m);
        // Row by row against inverse dynamics of one motor's acceleration.
        for j in 0..4 {
            let mut one = State::at(motors.q);
            one.qdd[j] = 1.0;
            let tau = Core::<Ur5e>::rnea(&transmission.state(&one), &(Inertia,));
            for (i, tau) in transmission.torque(&tau).into_iter().enumerate() {
                assert!((felt.get(i, j) - tau).abs() < 1e-14, "{i} {j}");
            }
        }
        let tau = Core::<Ur5e>::rnea(&state, &RIGID_BODY);
        let power =
            |tau: &[f64], qd: &[f64]| -> f64 { tau.iter().zip(qd).map(|(t, v)| t * v).sum() };
        let (joints, there) = (power(&tau, &state.qd), transmission.torque(&tau));
        assert!((power(&there, &motors.qd) - joints).abs() < 1e-12);
    }
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
