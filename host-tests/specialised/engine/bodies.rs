//! The engine's results for named bodies and for all bodies together: against Pinocchio's
//! recorded states, and on an odd tree against the core.

use std::collections::BTreeMap;

use dynamics_core::algorithms::frame::{Frame, Local, LocalWorldAligned, World};
use dynamics_core::algorithms::{
    Kinematics, NotPositiveDefinite, OsimInverse, center_of_mass, centroidal_matrix,
    centroidal_momentum, momentum,
};
use dynamics_core::effects::{Effect, Gravity, Inertia, MovingBase, RIGID_BODY};
use dynamics_core::model::{Bodies, OnBody, Robot, Static};
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::{Matrix, Real, Vector};
use dynamics_core::spatial::{Force, Motion};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use host_tests::measured::largest;
use host_tests::recordings::{Recording, load, row};
use host_tests::stress_robot::StressRobot;
use host_tests::tolerances;

use super::matrix::{ROTORS, Random};
use super::{Aslant, payload};

/// Quantities with their numbers, at one state.
type Quantities = Vec<(&'static str, Vec<f64>)>;

fn pair<R: Real>(ang: R::Vec3, lin: R::Vec3) -> Vec<f64> {
    [ang.array(), lin.array()].as_flattened().iter().map(|x| x.to_f64()).collect()
}

fn motions<R: Real>(all: &[Motion<R>]) -> Vec<f64> {
    all.iter().flat_map(|m| pair::<R>(m.ang, m.lin)).collect()
}

/// Rows of the rotations, and positions.
fn poses<R: Real, const N: usize>(k: &Kinematics<R, N>) -> Vec<f64> {
    let pose = |pose: &dynamics_core::algorithms::Pose<R>| {
        let [x, y, z] = pose.rot.transpose().cols();
        [pair::<R>(x, y), pair::<R>(z, pose.pos)].concat()
    };
    k.poses.iter().flat_map(pose).collect()
}

/// The last body and the first one.
#[derive(Clone, Copy)]
struct Ends<const TIP: usize>;

impl<const TIP: usize> Bodies<2> for Ends<TIP> {
    const NUMBERS: [usize; 2] = [TIP, 0];
}

fn of_engine<R: Real, T, E, const B: usize, const Q: usize, const V: usize, const TIP: usize>(
    state: &State<R, Q, V>,
    scene: &E,
) -> Quantities
where
    T: Robot<B, Q, V>,
    E: Effect<R, B, V>,
{
    let all = Engine::<T>::kinematics(state, scene);
    assert_eq!(all.poses, Engine::<T>::poses(&state.q));
    let ends = Engine::<T>::kinematics_of(state, scene, Ends::<TIP>);
    for (i, body) in [TIP, 0].into_iter().enumerate() {
        assert_eq!(ends.poses[i], all.poses[body]);
        assert_eq!(ends.velocities[i], all.velocities[body]);
        assert_eq!(ends.accelerations[i], all.accelerations[body]);
    }
    assert_eq!(Engine::<T>::poses_of(&state.q, OnBody::<TIP>), [all.poses[TIP]]);
    let centre = Engine::<T>::center_of_mass(state, scene);
    let h = [Engine::<T>::momentum(state, scene), Engine::<T>::centroidal_momentum(state, scene)];
    let matrix = Engine::<T>::centroidal_matrix(&state.q, scene);
    let mut found = of_frames(
        |j| match j {
            0 => Engine::<T>::jacobian(&state.q, OnBody::<TIP>, Local),
            1 => Engine::<T>::jacobian(&state.q, OnBody::<TIP>, World),
            _ => Engine::<T>::jacobian(&state.q, OnBody::<TIP>, LocalWorldAligned),
        },
        |j| match j {
            0 => Engine::<T>::bias_acceleration(state, OnBody::<TIP>, Local),
            1 => Engine::<T>::bias_acceleration(state, OnBody::<TIP>, World),
            _ => Engine::<T>::bias_acceleration(state, OnBody::<TIP>, LocalWorldAligned),
        },
    );
    found.extend(of_bodies(&all, TIP));
    let mobility = |j| match j {
        0 => Engine::<T>::osim_inverse(&state.q, OnBody::<TIP>, Local, scene),
        _ => Engine::<T>::osim_inverse(&state.q, OnBody::<TIP>, World, scene),
    };
    found.extend([0, 1].map(|j| (MOBILITIES[j], triangle(mobility(j)))));
    found.extend([
        ("kinetic energy", vec![Engine::<T>::kinetic_energy(state, scene).to_f64()]),
        ("potential energy", vec![Engine::<T>::potential_energy(&state.q, scene).to_f64()]),
        ("centre of mass", pair::<R>(centre.position, centre.velocity)),
        ("mass", vec![centre.mass.to_f64()]),
        ("momentum", pair::<R>(h[0].ang, h[0].lin)),
        ("centroidal momentum", pair::<R>(h[1].ang, h[1].lin)),
        ("centroidal matrix", matrix.iter().flat_map(|h| pair::<R>(h.ang, h.lin)).collect()),
    ]);
    found.extend(parameters(&regressor::<R, T, E, B, Q, V, TIP>(state, scene)));
    found
}

/// The regressor, which its columns and rows repeat.
fn regressor<R: Real, T, E, const B: usize, const Q: usize, const V: usize, const TIP: usize>(
    state: &State<R, Q, V>,
    scene: &E,
) -> [[[R; 10]; B]; V]
where
    T: Robot<B, Q, V>,
    E: Effect<R, B, V>,
{
    let y = Engine::<T>::regressor(state, scene);
    let columns = Engine::<T>::regressor_columns(state, scene, OnBody::<TIP>);
    assert_eq!(columns, y.map(|row| row[TIP]));
    for (k, whole) in y.iter().enumerate() {
        let row = Engine::<T>::regressor_row(state, scene, k);
        let largest =
            |rows: &[[R; 10]; B]| largest(rows.as_flattened().iter().map(|x| x.to_f64().abs()));
        let mut difference = *whole;
        for (difference, row) in difference.iter_mut().zip(row) {
            for (difference, row) in difference.iter_mut().zip(row) {
                *difference -= row;
            }
        }
        assert!(largest(&difference) <= 16.0 * R::EPSILON.to_f64() * (largest(whole) + 1.0));
    }
    let nowhere = Engine::<T>::regressor_row(state, scene, V);
    assert_eq!(nowhere, [[R::ZERO; 10]; B]);
    y
}

const PARAMETERS: [&str; 10] = [
    "Y of m",
    "Y of h_x",
    "Y of h_y",
    "Y of h_z",
    "Y of I_xx",
    "Y of I_xy",
    "Y of I_yy",
    "Y of I_xz",
    "Y of I_yz",
    "Y of I_zz",
];

/// The entries of each parameter, which differ in their units.
fn parameters<R: Real, const B: usize, const V: usize>(y: &[[[R; 10]; B]; V]) -> Quantities {
    let of = |k: usize| y.as_flattened().iter().map(|body| body[k].to_f64()).collect();
    (0..10).map(|k| (PARAMETERS[k], of(k))).collect()
}

const JACOBIANS: [&str; 3] = ["jacobian in the body", "jacobian in the world", "jacobian, mixed"];
const DRIFTS: [&str; 3] = ["drift in the body", "drift in the world", "drift, mixed"];

const MOBILITIES: [&str; 2] = ["mobility", "mobility in the world"];

/// The upper triangle of Λ⁻¹ by rows.
fn triangle<R: Real>(mobility: Result<OsimInverse<R>, NotPositiveDefinite>) -> Vec<f64> {
    let axes = R::Mat3::IDENTITY.cols();
    let [x, y, z] = axes.map(|axis| Force::new(axis, R::Vec3::ZERO));
    let [u, v, w] = axes.map(|axis| Force::new(R::Vec3::ZERO, axis));
    let rows = mobility.expect("M is positive").along(&[x, y, z, u, v, w]);
    let rows = rows.iter().enumerate();
    rows.flat_map(|(i, row)| row[i..].iter().map(|x| x.to_f64())).collect()
}

fn of_frames<R: Real, const N: usize>(
    jacobian: impl Fn(usize) -> [Motion<R>; N],
    drift: impl Fn(usize) -> Motion<R>,
) -> Quantities {
    let jacobians = (0..3).map(|j| (JACOBIANS[j], motions(&jacobian(j))));
    let drifts = (0..3).map(|j| (DRIFTS[j], motions(&[drift(j)])));
    jacobians.chain(drifts).collect()
}

fn of_bodies<R: Real, const B: usize>(all: &Kinematics<R, B>, tip: usize) -> Quantities {
    let tip_pose = poses(all)[12 * tip..][..12].to_vec();
    vec![
        ("poses", poses(all)),
        ("velocities", motions(&all.velocities)),
        ("accelerations", motions(&all.accelerations)),
        ("tip pose", tip_pose),
        ("tip velocity", motions(&[all.velocities[tip]])),
        ("tip acceleration", motions(&[all.accelerations[tip]])),
    ]
}

fn of_core<T, E, const B: usize, const Q: usize, const V: usize>(
    state: &State<f64, Q, V>,
    scene: &E,
    tip: usize,
) -> Quantities
where
    T: Robot<B, Q, V>,
    E: Effect<f64, B, V>,
{
    fn both<F: Frame, T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>(
        state: &State<f64, Q, V>,
        tip: usize,
        frame: F,
    ) -> ([Motion<f64>; V], Motion<f64>) {
        (Core::<T>::jacobian(&state.q, tip, frame), Core::<T>::bias_acceleration(state, tip, frame))
    }
    let robot = &Static::<T>::NEW;
    let frames = [
        both::<_, T, B, Q, V>(state, tip, Local),
        both::<_, T, B, Q, V>(state, tip, World),
        both::<_, T, B, Q, V>(state, tip, LocalWorldAligned),
    ];
    let centre = center_of_mass(robot, state, scene);
    let h = [momentum(robot, state, scene), centroidal_momentum(robot, state, scene)];
    let matrix = centroidal_matrix(robot, &state.q, scene);
    let flat = |ang, lin| pair::<f64>(ang, lin);
    let mut found = of_frames(|j| frames[j].0, |j| frames[j].1);
    found.extend(of_bodies(&Core::<T>::kinematics(state, scene), tip));
    found.extend(parameters(&Core::<T>::regressor(state, scene)));
    let mobility = Core::<T>::osim_inverse(&state.q, tip, World, scene);
    found.push((MOBILITIES[1], triangle(mobility)));
    found.extend([
        ("kinetic energy", vec![Core::<T>::kinetic_energy(state, scene)]),
        ("potential energy", vec![Core::<T>::potential_energy(&state.q, scene)]),
        ("centre of mass", flat(centre.position, centre.velocity)),
        ("mass", vec![centre.mass]),
        ("momentum", flat(h[0].ang, h[0].lin)),
        ("centroidal momentum", flat(h[1].ang, h[1].lin)),
        ("centroidal matrix", matrix.iter().flat_map(|h| flat(h.ang, h.lin)).collect()),
    ]);
    found
}

/// Full scale and largest error of each quantity.
#[derive(Default)]
struct Errors(BTreeMap<&'static str, [f64; 2]>);

impl Errors {
    fn see(&mut self, got: &Quantities, want: &Quantities) {
        for (name, want) in want {
            let (_, got) = got.iter().find(|(found, _)| found == name).expect("computed");
            let [scale, error] = self.0.entry(name).or_default();
            for (got, want) in got.iter().zip(want) {
                *scale = scale.max(want.abs());
                *error = largest([*error, (got - want).abs()]);
            }
        }
    }

    /// Holds the largest error of all, relative to its full scale, against the table; that of
    /// mobilities, which grows with the condition of M, apart.
    fn judge<R>(&self, robot: &str) {
        let relative = |(name, [scale, error]): (&&str, &[f64; 2])| {
            println!("{robot} {name}: {:.1e} of {scale:.2}", error / scale);
            error / scale
        };
        let of_m = |(name, _): &(&&str, &[f64; 2])| MOBILITIES.contains(*name);
        let scalar = core::any::type_name::<R>();
        let (mobilities, bodies): (Vec<_>, Vec<_>) = self.0.iter().partition(of_m);
        for (all, quantity) in [(bodies, "engine bodies"), (mobilities, "engine mobility")] {
            let worst = largest(all.into_iter().map(relative));
            tolerances::check(robot, quantity, scalar, worst).unwrap_or_else(|e| panic!("{e}"));
        }
    }
}

/// The recorded quantities of state `i`; of the centre of mass its position alone.
fn recorded(r: &Recording, i: usize) -> Quantities {
    let mut all = [
        ("tip pose", &r.tip_pose),
        ("tip velocity", &r.tip_velocity),
        ("tip acceleration", &r.tip_acceleration),
        (JACOBIANS[0], &r.jacobian_local),
        (JACOBIANS[1], &r.jacobian_world),
        (JACOBIANS[2], &r.jacobian_mixed),
        (DRIFTS[0], &r.drift_local),
        (DRIFTS[1], &r.drift_world),
        (DRIFTS[2], &r.drift_mixed),
        ("kinetic energy", &r.kinetic_energy),
        ("potential energy", &r.potential_energy),
        ("centre of mass", &r.centre_of_mass),
        ("momentum", &r.momentum),
        ("centroidal momentum", &r.centroidal_momentum),
        ("centroidal matrix", &r.centroidal_matrix),
        (MOBILITIES[0], &r.operational_inverse),
    ]
    .map(|(name, rows)| (name, rows[i].clone()))
    .to_vec();
    // Fewer states suffice here.
    if let Some(row) = r.regressor.get(i) {
        let of = |k: usize| row.chunks(10).map(|body| body[k]).collect();
        all.extend((0..10).map(|k| (PARAMETERS[k], of(k))));
    }
    all
}

fn pinocchio<R: Real, T, const B: usize, const Q: usize, const V: usize, const TIP: usize>()
where
    T: Robot<B, Q, V>,
{
    let (r, mut errors) = (load(T::MODEL.name), Errors::default());
    for i in 0..r.first_states() {
        let cast = |rows| row::<V>(rows, i).map(R::from_f64);
        let state =
            State { q: row::<Q>(&r.q, i).map(R::from_f64), qd: cast(&r.qd), qdd: cast(&r.qdd) };
        let found = of_engine::<R, T, _, B, Q, V, TIP>(&state, &RIGID_BODY);
        errors.see(&found, &recorded(&r, i));
    }
    errors.judge::<R>(T::MODEL.name);
}

#[test]
fn bodies_agree_with_pinocchio_within_the_table() {
    pinocchio::<f64, Ur5e, 6, 6, 6, 5>();
    #[cfg(feature = "full")]
    {
        use dynamics_core::robots::{A1, A1Free, Panda};
        use host_tests::trees::{TreeA, TreeB};
        pinocchio::<f32, Ur5e, 6, 6, 6, 5>();
        pinocchio::<f64, Panda, 7, 7, 7, 6>();
        pinocchio::<f64, A1, 16, 12, 12, 15>();
        pinocchio::<f32, A1, 16, 12, 12, 15>();
        pinocchio::<f64, A1Free, 17, 19, 18, 16>();
        pinocchio::<f64, TreeA, 17, 35, 32, 16>();
        pinocchio::<f64, TreeB, 17, 35, 32, 16>();
    }
}

/// An odd tree with prismatic joints, branches and welds, with rotors and a load, on a base that
/// moves.
fn odd_tree<R: Real>() {
    fn ship<R: Real>() -> MovingBase<R> {
        let vec3 =
            |v: [f64; 3]| R::Vec3::new(R::from_f64(v[0]), R::from_f64(v[1]), R::from_f64(v[2]));
        MovingBase {
            velocity: Motion::new(vec3([0.3, -0.5, 0.7]), vec3([0.1, 0.2, -0.3])),
            acceleration: Motion::new(vec3([-1.0, 2.0, 0.5]), vec3([0.4, 1.0, -2.0])),
        }
    }
    let (mut random, mut errors) = (Random::new(), Errors::default());
    let field = Gravity::<Aslant>::new(9.81);
    for _ in 0..200 {
        let state = random.state::<R, 7>();
        let exact = State {
            q: state.q.map(R::to_f64),
            qd: state.qd.map(R::to_f64),
            qdd: state.qdd.map(R::to_f64),
        };
        let rotors = dynamics_core::effects::Armature(ROTORS.0.map(R::from_f64));
        let scene = (field, Inertia, ship::<R>(), rotors, payload::<R, 10>());
        let found = of_engine::<R, StressRobot, _, 11, 7, 7, 8>(&state, &scene);
        let scene = (field, Inertia, ship::<f64>(), ROTORS, payload::<f64, 10>());
        errors.see(&found, &of_core::<StressRobot, _, 11, 7, 7>(&exact, &scene, 8));
    }
    errors.judge::<R>("odd");
}

#[test]
fn bodies_of_an_odd_tree_are_those_of_the_core() {
    odd_tree::<f64>();
    #[cfg(feature = "full")]
    odd_tree::<f32>();
}
