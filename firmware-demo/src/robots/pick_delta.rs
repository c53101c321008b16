//! A Delta robot of a packing line.

use core::f64::consts::{PI, TAU};

use dynamics_core::clusters::{ClusteredRobot, Delta, Driven};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// The three main axes of an Autonox24 RL5-1450-6kg, a Delta robot with a working range of 1450 mm,
/// and 1 kg of gripper and part.
///
/// # Source
///
/// testbedCIIRC/delta-robot-public (Alikoc, Sustr, Zitek, Rehorik, Burget & Lomakin, *Motion
/// Modelling and Simulation of a 5-Axis Industrial Delta Robot*), whose numbers are from the
/// robot's CAD model: `Basic_3DoF_Delta_Dynamic_Param.m` (lengths, the gears' ratio) and
/// `RL5_6kg_Inertia_Mass.m` (masses, inertias). No licence is stated; these are the numbers alone.
///
/// # Changed
///
/// As in the source's basic model the shafts, the wrist and the flange of the two other axes are
/// left out. An arm is its beam of 3.47 kg with its centre 172 mm from the joint, and the pin of
/// 0.226 kg at its end; the source's inertia of both about the joint is 0.208 kg·m². A pair of rods
/// is one body, as [`Delta`] has it.
///
/// # Assumed
///
/// Gripper and part, and a centre of the platform 20 mm off its rods' plane. Of the drives the
/// ranges, the speed of 4,200 turns a minute before the gear, and the torque, of the size of a
/// servo motor of 1 kW.
#[derive(Clone, Copy, Debug, Default)]
pub struct PickDelta;

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// cos and sin of 0°, 120° and 240°.
pub const SIDES: [[f64; 2]; 3] =
    [[1.0, 0.0], [-0.5, 0.866_025_403_784_438_6], [-0.5, -0.866_025_403_784_438_6]];

/// Beam and pin, kg and m.
const BEAM: f64 = 3.47;
const BEAM_CENTRE: f64 = 0.17224;
const PIN: f64 = 0.226;
/// Inertia of both about the joint, kg·m².
const ABOUT_JOINT: f64 = 0.208218;

/// A rod, kg and kg·m² about its centre.
const BAR: f64 = 0.525;
const ACROSS: f64 = 0.043009;
const ALONG: f64 = 5.22934e-5;

/// Platform, gripper and part, kg.
const PLATFORM_MASS: f64 = 2.916;
const LOAD: f64 = 1.0;

impl PickDelta {
    pub const RATIO: f32 = 55.0;
    /// The inertia of a gear on its motor's side, kg·m².
    pub const GEAR: f32 = 2.07e-4;
    /// The motors' coordinates in the tree: the cranks.
    pub const MOTORS: [usize; 3] = [0, 3, 6];
    /// The radius of the cranks' joints, m.
    pub const BASE: f64 = 0.33;
    /// A crank, m.
    pub const CRANK: f64 = 0.42;
    /// A rod, m.
    pub const ROD: f64 = 1.055;
    /// The radius of the rods' ends on the platform, m.
    pub const PLATFORM: f64 = 0.125;
}

const CRANK_LIMITS: JointLimits<f64> =
    JointLimits { lower: -0.7, upper: 1.6, velocity: 8.0, torque: 450.0 };

/// Limits of joints without a drive.
const FREE: JointLimits<f64> = JointLimits { lower: -PI, upper: PI, velocity: 20.0, torque: 0.0 };

const fn crank(name: &'static str, side: usize) -> Body {
    let [cos, sin] = SIDES[side];
    let mass = BEAM + PIN;
    let centre = (BEAM * BEAM_CENTRE + PIN * PickDelta::CRANK) / mass;
    let about = ABOUT_JOINT - mass * centre * centre;
    Body::new(name, BASE, Joint::revolute(Y))
        .xyz([PickDelta::BASE * cos, PickDelta::BASE * sin, 0.0])
        .rpy([0.0, 0.0, side as f64 * TAU / 3.0])
        .mass(mass)
        .com([centre, 0.0, 0.0])
        .inertia([0.005, 0.0, 0.0, about, 0.0, about])
        .limits(CRANK_LIMITS)
}

/// A body without mass between the two axes of a pair of rods.
const fn cross(name: &'static str, crank: usize) -> Body {
    Body::new(name, crank, Joint::revolute(Y)).xyz([PickDelta::CRANK, 0.0, 0.0]).limits(FREE)
}

const fn rods(name: &'static str, cross: usize) -> Body {
    Body::new(name, cross, Joint::revolute(X))
        .mass(2.0 * BAR)
        .com([0.0, 0.0, -0.5 * PickDelta::ROD])
        .inertia([2.0 * ACROSS, 0.0, 0.0, 2.0 * ACROSS, 0.0, 2.0 * ALONG])
        .limits(FREE)
}

impl Robot<12, 12, 12> for PickDelta {
    const MODEL: ArmModel<f64, 12> = Model::new(
        "pick_delta",
        [
            crank("crank_a", 0),
            cross("cross_a", 0),
            rods("rods_a", 1),
            crank("crank_b", 1),
            cross("cross_b", 3),
            rods("rods_b", 4),
            crank("crank_c", 2),
            cross("cross_c", 6),
            rods("rods_c", 7),
            Body::new("along", BASE, Joint::prismatic(X)).limits(FREE),
            Body::new("across", 9, Joint::prismatic(Y)).limits(FREE),
            Body::new("platform", 10, Joint::prismatic(Z))
                .mass(PLATFORM_MASS + LOAD)
                .com([0.0, 0.0, -0.02])
                .inertia([0.01, 0.0, 0.0, 0.01, 0.0, 0.015])
                .limits(FREE),
        ],
    );
}

impl ClusteredRobot<12, 12, 12, 3, 3> for PickDelta {
    type Clusters = (Driven<Delta, 12, 3>,);
    const CLUSTERS: Self::Clusters =
        (Driven::new("arms", Delta::new(Self::BASE, Self::CRANK, Self::ROD, Self::PLATFORM)),);
    const COORDINATES: &'static [&'static [usize]] = &[&[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]];
}

const _: ArmModel<f64, 12> = PickDelta::MODEL;
