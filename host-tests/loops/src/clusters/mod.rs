//! Robots with clusters of every kind, and what the tests of them share.

pub mod recorded;

mod delta_robot;

use dynamics_core::clusters::{
    Belt, Branch, ClusteredRobot, Differential, Driven, FiveBar, ParallelAnkle,
};
use dynamics_core::drivetrain::Transmission;
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use firmware_demo::robots::{AnkleLeg, RODS};

pub use delta_robot::DeltaRobot;

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

const fn link(
    name: &'static str,
    parent: usize,
    joint: Joint<f64>,
    at: [f64; 3],
    mass: f64,
    com: [f64; 3],
) -> Body {
    let i = 0.003 * mass;
    Body::new(name, parent, joint).xyz(at).mass(mass).com(com).inertia([
        i,
        0.1 * i,
        0.0,
        1.2 * i,
        -0.1 * i,
        0.9 * i,
    ])
}

/// A five-bar leg on a vertical slide.
pub struct FiveBarLeg;

impl Robot<5, 5, 5> for FiveBarLeg {
    const MODEL: ArmModel<f64, 5> = Model::new(
        "five_bar_leg",
        [
            link("carriage", BASE, Joint::prismatic(Z), [0.0; 3], 3.0, [0.02, 0.0, 0.1]),
            link("crank", 0, Joint::revolute(Y), [0.0; 3], 0.4, [0.05, 0.0, 0.0]),
            link("rod", 1, Joint::revolute(Y), [0.12, 0.0, 0.0], 0.3, [0.1, 0.01, 0.0]),
            link("other_crank", 0, Joint::revolute(Y), [0.05, 0.0, 0.0], 0.5, [0.05, 0.0, 0.0]),
            link("other_rod", 3, Joint::revolute(Y), [0.11, 0.0, 0.0], 0.2, [0.1, 0.0, 0.01]),
        ],
    );
}

impl ClusteredRobot<5, 5, 5, 3, 3> for FiveBarLeg {
    type Clusters = (Driven<FiveBar, 4, 2>,);
    const CLUSTERS: Self::Clusters =
        (Driven::new("leg", FiveBar::new(0.05, [0.12, 0.22], [0.11, 0.2], Branch::Positive)),);
    const COORDINATES: &'static [&'static [usize]] = &[&[1, 2, 3, 4]];
}

/// The UR5e with a differential for its last two joints.
pub struct Wrist;

impl Robot<6, 6, 6> for Wrist {
    const MODEL: ArmModel<f64, 6> = {
        let mut model = Ur5e::MODEL;
        model.name = "wrist";
        model
    };
}

impl ClusteredRobot<6, 6, 6, 6, 6> for Wrist {
    type Clusters = (Driven<Differential, 2, 2>,);
    const CLUSTERS: Self::Clusters = (Driven::new("wrist", Differential::new([1.0, 2.5])),);
    const COORDINATES: &'static [&'static [usize]] = &[&[4, 5]];
}

/// Two links, of which a spiral pulley on the first drives the second, and a hand on it by gears
/// with rotors of their own.
pub struct Geared;

impl Robot<7, 7, 7> for Geared {
    const MODEL: ArmModel<f64, 7> = Model::new(
        "geared",
        [
            link("arm", BASE, Joint::revolute(Y), [0.0; 3], 2.0, [0.2, 0.0, 0.0]),
            link("pulley", 0, Joint::revolute(Y), [0.1, 0.0, 0.0], 0.3, [0.0; 3]),
            link("forearm", 0, Joint::revolute(Y), [0.4, 0.0, 0.0], 1.0, [0.1, 0.02, 0.0]),
            link("pitch", 2, Joint::revolute(Y), [0.3, 0.0, 0.0], 0.4, [0.02, 0.0, 0.0]),
            link("roll", 3, Joint::revolute(X), [0.0; 3], 0.3, [0.05, 0.0, 0.02]),
            link("rotor", 2, Joint::revolute(X), [0.05, 0.02, 0.0], 0.1, [0.0; 3]),
            link("other_rotor", 2, Joint::revolute(X), [0.05, -0.02, 0.0], 0.1, [0.0; 3]),
        ],
    );
}

impl ClusteredRobot<7, 7, 7, 4, 4> for Geared {
    type Clusters = (Driven<Transmission<f64, 2, 4>, 4, 2>, Driven<Belt<4>, 2, 1>);
    const CLUSTERS: Self::Clusters = (
        Driven::new(
            "hand",
            Transmission {
                matrix: [[0.5, 0.5], [0.5, -0.5], [9.0, 0.0], [0.0, -9.0]],
                offset: [0.1, 0.0, 0.0, 0.2],
            },
        ),
        Driven::new("belt", Belt::new([0.1, 0.6, 0.05, -0.01])),
    );
    const COORDINATES: &'static [&'static [usize]] = &[&[3, 4, 5, 6], &[1, 2]];
}

/// The shank with its parallel ankle on a free joint.
pub struct FloatingAnkle;

impl Robot<9, 15, 14> for FloatingAnkle {
    const MODEL: Model<f64, 9, 15, 14> =
        Model::new("floating_ankle", AnkleLeg::bodies(Joint::free()));
}

impl ClusteredRobot<9, 15, 14, 9, 8> for FloatingAnkle {
    type Clusters = (Driven<ParallelAnkle, 8, 2>,);
    const CLUSTERS: Self::Clusters = <AnkleLeg as ClusteredRobot<9, 9, 9, 3, 3>>::CLUSTERS;
    const COORDINATES: &'static [&'static [usize]] = &[&[6, 7, 8, 9, 10, 11, 12, 13]];
}

/// The parallel ankle with universal joints in place of pairs of revolute ones.
pub struct UniversalAnkle;

impl Robot<6, 9, 9> for UniversalAnkle {
    const MODEL: Model<f64, 6, 9, 9> = {
        let (turn, both) = (Joint::revolute(Y), Joint::universal(Y, X));
        let [left, right] = RODS;
        let [x, y, z] = left.joint;
        let left_joint = [x, y, z - 0.35];
        let [x, y, z] = right.joint;
        let right_joint = [x, y, z - 0.35];
        Model::new(
            "universal_ankle",
            [
                link("shank", BASE, turn, [0.0; 3], 2.8, [0.0, 0.0, -0.1]),
                link("foot", 0, both, [0.0, 0.0, -0.35], 0.9, [0.04, 0.002, -0.03]),
                link("left_crank", 0, turn, left_joint, 0.2, [-0.01, 0.0, 0.0]),
                link("left_rod", 2, both, left.crank, 0.1, [0.0, 0.0, -0.08]),
                link("right_crank", 0, turn, right_joint, 0.2, [-0.01, 0.0, 0.0]),
                link("right_rod", 4, both, right.crank, 0.1, [0.0, 0.0, -0.13]),
            ],
        )
    };
}

impl ClusteredRobot<6, 9, 9, 3, 3> for UniversalAnkle {
    type Clusters = (Driven<ParallelAnkle, 8, 2>,);
    const CLUSTERS: Self::Clusters = <AnkleLeg as ClusteredRobot<9, 9, 9, 3, 3>>::CLUSTERS;
    const COORDINATES: &'static [&'static [usize]] = &[&[1, 2, 3, 4, 5, 6, 7, 8]];
}

/// Numbers from a fixed seed, exactly representable in f32.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Within ± `bound`.
    pub fn number(&mut self, bound: f64) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let unit = (self.0 >> 40) as f64 / (1_u64 << 23) as f64 - 1.0;
        f64::from((unit * bound) as f32)
    }

    pub fn numbers<const N: usize>(&mut self, bound: f64) -> [f64; N] {
        [(); N].map(|()| self.number(bound))
    }
}

/// The largest difference of two rows.
pub fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |most, (a, b)| {
        let apart = (a - b).abs();
        if apart > most || apart.is_nan() { apart } else { most }
    })
}

/// The largest number of a row.
pub fn largest(a: &[f64]) -> f64 {
    a.iter().fold(0.0, |most, a| a.abs().max(most))
}

/// 200 states with y within `reach` of `centre`; quaternions, which begin at `quaternion`, at
/// length one.
pub fn states<const P: usize, const Y: usize>(
    centre: [f64; P],
    reach: [f64; P],
    quaternion: Option<usize>,
) -> Vec<State<f64, P, Y>> {
    let mut random = Random::new(7);
    let one = |_| {
        let mut q = core::array::from_fn(|i| centre[i] + random.number(reach[i]));
        if let Some(at) = quaternion {
            let attitude = &mut q[at..at + 4];
            let length = attitude.iter().map(|x| x * x).sum::<f64>().sqrt();
            attitude.iter_mut().for_each(|x| *x /= length);
        }
        State { q, qd: random.numbers(3.0), qdd: random.numbers(10.0) }
    };
    (0..200).map(one).collect()
}

/// 200 states of the four-bar leg.
pub fn four_bar_states() -> Vec<State<f64, 3, 3>> {
    states([0.0; 3], [2.0, 0.6, 2.0], None)
}

/// 200 states of the five-bar leg.
pub fn five_bar_states() -> Vec<State<f64, 3, 3>> {
    states([0.0, 2.2, 0.9], [1.0, 0.5, 0.5], None)
}

/// 200 states of the wrist with a differential.
pub fn wrist_states() -> Vec<State<f64, 6, 6>> {
    states([0.0; 6], [2.0; 6], None)
}

/// 200 states of the arm with belt and gears.
pub fn geared_states() -> Vec<State<f64, 4, 4>> {
    states([0.0; 4], [2.0; 4], None)
}

/// 200 states of the parallel ankle.
pub fn ankle_states() -> Vec<State<f64, 3, 3>> {
    states([0.0; 3], [2.0, 0.45, 0.3], None)
}

/// 200 states of the parallel ankle on a floating shank.
pub fn floating_states() -> Vec<State<f64, 9, 8>> {
    let reach = [1.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 0.45, 0.3];
    states([0.0; 9], reach, Some(0))
}

/// 200 states of the Delta robot.
pub fn delta_states() -> Vec<State<f64, 3, 3>> {
    states([0.3; 3], [0.6; 3], None)
}

/// 200 states of the Stewart platform.
pub fn stewart_states() -> Vec<State<f64, 6, 6>> {
    let (centre, reach) = ([0.0, 0.0, 0.8, 0.0, 0.0, 0.0], [0.15, 0.15, 0.1, 0.4, 0.3, 0.3]);
    states(centre, reach, None)
}

/// Holds a measured error against a bound, which may be at most ten times as large.
///
/// # Panics
/// If the error exceeds the bound or the bound is slack.
pub fn hold(what: &str, error: f64, bound: f64) {
    println!("{what}: {error:.1e}, bound {bound:.0e}");
    assert!(error <= bound, "{what}: {error:.1e} exceeds {bound:.0e}");
    assert!(error * 10.0 > bound, "{what}: {error:.1e} makes the bound {bound:.0e} slack");
}
