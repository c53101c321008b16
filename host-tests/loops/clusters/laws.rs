//! Laws of inverse and forward dynamics with clusters, on 200 random states of every robot.

use dynamics_core::algorithms::MassMatrix;
use dynamics_core::clusters::{Clustered, ClusteredRobot};
use dynamics_core::effects::{Armature, Effect, Gravity, JointState, RIGID_BODY, Viscous};
use dynamics_core::model::Static;
use dynamics_core::scalar::Real;
use dynamics_core::state::{RobotState, State};
use dynamics_core::{Core, Engine, algorithms};
use firmware_demo::robots::{AnkleLeg, FourBarLeg, StewartPlatform};
use loop_tests::clusters::{
    DeltaRobot, FiveBarLeg, FloatingAnkle, Geared, UniversalAnkle, Wrist, ankle_states, apart,
    delta_states, five_bar_states, floating_states, four_bar_states, geared_states, hold, largest,
    stewart_states, wrist_states,
};

/// x with M x = τ, by elimination: M is positive definite.
fn solved<const N: usize>(m: &MassMatrix<f64, N>, tau: &[f64; N]) -> [f64; N] {
    let mut a: [[f64; N]; N] = core::array::from_fn(|i| core::array::from_fn(|j| m.get(i, j)));
    let mut x = *tau;
    for k in 0..N {
        let (above, rest) = a.split_at_mut(k + 1);
        for (row, i) in rest.iter_mut().zip(k + 1..) {
            let l = row[k] / above[k][k];
            for (a, &above) in row.iter_mut().zip(&above[k]) {
                *a -= l * above;
            }
            x[i] -= l * x[k];
        }
    }
    for k in (0..N).rev() {
        for j in k + 1..N {
            x[k] -= a[k][j] * x[j];
        }
        x[k] /= a[k][k];
    }
    x
}

/// Errors of the laws on a robot, relative to full scale.
#[derive(Debug, Default)]
struct Errors {
    /// ÿ of FD of the torques of ID.
    inverse: f64,
    /// ÿ of the algorithm by clusters, and of M ÿ = τ − bias.
    solved: f64,
    /// τ·ẏ, and the tree's power: rate of its energy, and what friction takes.
    power: f64,
    /// ½ ẏᵀ M ẏ, and the tree's kinetic energy.
    energy: f64,
    /// M, and the differences of ID.
    columns: f64,
}

/// The laws on every state, under friction and rotors.
fn laws<T, const B: usize, const Q: usize, const V: usize, const P: usize, const Y: usize>(
    states: &[State<f64, P, Y>],
) -> Errors
where
    T: ClusteredRobot<B, Q, V, P, Y>,
{
    let scene = (RIGID_BODY, Viscous([0.3; V]), Armature([0.02; V]));
    let mut worst = Errors::default();
    for y in states {
        let motion = Clustered::<Core<T>>::motion(y).expect("it closes");
        let tau = Clustered::<Core<T>>::rnea(y, &scene).expect("it closes");
        let again = Clustered::<Core<T>>::aba(y, &tau, &scene).expect("it moves inertia");
        worst.inverse = worst.inverse.max(apart(&again, &y.qdd) / 10.0);

        let still = State { qdd: [0.0; Y], ..*y };
        let bias = Clustered::<Core<T>>::rnea(&still, &scene).expect("it closes");
        let m = motion.inertia(&Core::<T>::crba(motion.configuration(), &scene));
        let given: [f64; Y] = core::array::from_fn(|i| 1.0 + 0.5 * i as f64);
        let by_matrix = solved(&m, &core::array::from_fn(|i| given[i] - bias[i]));
        let by_clusters = Clustered::<Core<T>>::aba(y, &given, &scene).expect("it moves inertia");
        let error = apart(&by_clusters, &by_matrix) / largest(&by_matrix);
        worst.solved = worst.solved.max(error);

        // The tree's own torques do the same work: what the loops transmit does none.
        let tree = *motion.state().state();
        let of_tree = algorithms::rnea(&Static::<T>::NEW, motion.state(), &scene);
        let power =
            |tau: &[f64], qd: &[f64]| tau.iter().zip(qd).map(|(tau, qd)| tau * qd).sum::<f64>();
        let (mine, its) = (power(&tau, &y.qd), power(&of_tree, &tree.qd));
        let size = of_tree.iter().zip(&tree.qd).map(|(tau, qd)| (tau * qd).abs()).sum::<f64>();
        worst.power = worst.power.max((mine - its).abs() / size);
        let energy = algorithms::kinetic_energy(&Static::<T>::NEW, motion.state(), &scene);
        let mine = 0.5 * power(&m.mul_vec(&y.qd), &y.qd);
        worst.energy = worst.energy.max((mine - energy).abs() / energy);
        let rows: [_; Y] = core::array::from_fn(|i| *m.row(i).expect("a row"));
        let size = largest(rows.as_flattened());
        for (i, row) in rows.iter().enumerate() {
            let unit = State { qdd: core::array::from_fn(|k| f64::from(i == k)), ..*y };
            let column = Clustered::<Core<T>>::rnea(&unit, &scene).expect("it closes");
            let difference: [f64; Y] = core::array::from_fn(|k| column[k] - bias[k]);
            worst.columns = worst.columns.max(apart(&difference, row) / (size + largest(&bias)));
        }
    }
    println!("{}: {worst:?}", T::MODEL.name);
    worst
}

#[test]
fn laws_hold_for_every_robot() {
    let all = [
        laws::<FourBarLeg, 5, 5, 5, 3, 3>(&four_bar_states()),
        laws::<FiveBarLeg, 5, 5, 5, 3, 3>(&five_bar_states()),
        laws::<Wrist, 6, 6, 6, 6, 6>(&wrist_states()),
        laws::<Geared, 7, 7, 7, 4, 4>(&geared_states()),
        laws::<AnkleLeg, 9, 9, 9, 3, 3>(&ankle_states()),
        laws::<DeltaRobot, 12, 12, 12, 3, 3>(&delta_states()),
        laws::<StewartPlatform, 24, 24, 24, 6, 6>(&stewart_states()),
        laws::<FloatingAnkle, 9, 15, 14, 9, 8>(&floating_states()),
        laws::<UniversalAnkle, 6, 9, 9, 3, 3>(&ankle_states()),
    ];
    let worst = |of: fn(&Errors) -> f64| all.iter().map(of).fold(0.0, f64::max);
    hold("ID of FD", worst(|e| e.inverse), 1e-13);
    hold("FD by M", worst(|e| e.solved), 3e-14);
    hold("power", worst(|e| e.power), 2e-15);
    hold("kinetic energy", worst(|e| e.energy), 4e-14);
    hold("columns of M", worst(|e| e.columns), 5e-15);
}

/// A spring, a damper and a rotor at every joint.
#[derive(Clone, Copy)]
struct AtJoints;

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for AtJoints {
    fn torque(&self, _: usize, at: JointState<R>, tau: &mut R) {
        *tau += at.q * R::from_f64(30.0) + at.qd * R::from_f64(0.3);
    }

    fn inertia(&self, _: usize) -> Option<R> {
        Some(R::from_f64(0.02))
    }
}

/// The largest difference of the engine's torques and the core's, relative to the largest torque;
/// and the core's in f32.
fn engine_and_single<T, E, const B: usize, const N: usize, const Y: usize>(
    states: &[State<f64, Y, Y>],
    scene: &E,
) -> [f64; 2]
where
    T: ClusteredRobot<B, N, N, Y, Y>,
    E: Effect<f64, B, N> + Effect<f32, B, N>,
{
    let (mut size, mut worst) = (0.0_f64, [0.0_f64; 2]);
    for y in states {
        let core = Clustered::<Core<T>>::rnea(y, scene).expect("it closes");
        let engine = Clustered::<Engine<T>>::rnea(y, scene).expect("it closes");
        let single = State {
            q: y.q.map(|x| x as f32),
            qd: y.qd.map(|x| x as f32),
            qdd: y.qdd.map(|x| x as f32),
        };
        let single = Clustered::<Engine<T>>::rnea(&single, scene).expect("it closes");
        size = size.max(largest(&core));
        worst[0] = worst[0].max(apart(&core, &engine));
        worst[1] = worst[1].max(apart(&core, &single.map(f64::from)));
    }
    let worst = worst.map(|error| error / size);
    println!("{}: engine {:.1e}, f32 {:.1e}", T::MODEL.name, worst[0], worst[1]);
    worst
}

#[test]
fn the_engine_agrees_with_the_core_and_f32_with_f64() {
    let joints = (RIGID_BODY, AtJoints);
    let all = [
        engine_and_single::<FourBarLeg, _, 5, 5, 3>(&four_bar_states(), &RIGID_BODY),
        engine_and_single::<FourBarLeg, _, 5, 5, 3>(&four_bar_states(), &Gravity::EARTH),
        engine_and_single::<AnkleLeg, _, 9, 9, 3>(&ankle_states(), &RIGID_BODY),
        engine_and_single::<DeltaRobot, _, 12, 12, 3>(&delta_states(), &joints),
        engine_and_single::<StewartPlatform, _, 24, 24, 6>(&stewart_states(), &joints),
    ];
    host_tests::in_full! {
        let further = [
            engine_and_single::<FiveBarLeg, _, 5, 5, 3>(&five_bar_states(), &RIGID_BODY),
            engine_and_single::<AnkleLeg, _, 9, 9, 3>(&ankle_states(), &Gravity::EARTH),
            engine_and_single::<StewartPlatform, _, 24, 24, 6>(&stewart_states(), &RIGID_BODY),
        ];
        let all = [&all[..], &further].concat();
    }
    let worst = |k: usize| all.iter().map(|errors| errors[k]).fold(0.0, f64::max);
    hold("engine", worst(0), 2e-14);
    hold("f32", worst(1), 1e-5);
}

/// The largest errors of the engine's ÿ: of FD of the torques of ID, and of the core's articulated
/// bodies.
fn engine_forward<T, const B: usize, const N: usize, const Y: usize>(
    states: &[State<f64, Y, Y>],
) -> f64
where
    T: ClusteredRobot<B, N, N, Y, Y>,
{
    let scene = (RIGID_BODY, AtJoints);
    let error = |y: &State<f64, Y, Y>| {
        let tau = Clustered::<Core<T>>::rnea(y, &scene).expect("it closes");
        let engine = Clustered::<Engine<T>>::forward_dynamics(y, &tau, &scene);
        let engine = engine.expect("it moves inertia");
        let core = Clustered::<Core<T>>::aba(y, &tau, &scene).expect("it moves inertia");
        (apart(&engine, &y.qdd).max(apart(&engine, &core))) / 10.0
    };
    states.iter().map(error).fold(0.0, f64::max)
}

#[test]
fn the_engines_forward_dynamics_invert_inverse_dynamics() {
    let all = [
        engine_forward::<FourBarLeg, 5, 5, 3>(&four_bar_states()),
        engine_forward::<AnkleLeg, 9, 9, 3>(&ankle_states()),
        engine_forward::<DeltaRobot, 12, 12, 3>(&delta_states()),
    ];
    hold("engine's FD", all.iter().copied().fold(0.0, f64::max), 2e-13);
}
