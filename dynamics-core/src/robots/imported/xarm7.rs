//! xarm7.
//!
//! # Source
//!
//! `xarm7.urdf`; it states no licence. Imported on 2026-11-21 by robot-import 0.1.0.
//!
//! # Changed
//!
//! - Part of body `link7`: `link_eef`.
//! - Joint `joint2`: roll `-1.5708` is -π/2.
//! - Joint `joint3`: roll `1.5708` is π/2.
//! - Joint `joint4`: roll `1.5708` is π/2.
//! - Joint `joint5`: roll `1.5708` is π/2.
//! - Joint `joint6`: roll `1.5708` is π/2.
//! - Joint `joint7`: roll `-1.5708` is -π/2.
//! - A gear of 100 on `joint1`, `joint2`, `joint3`, `joint4`, `joint5`, `joint6`, `joint7`, and the file has no inertia of the motor's rotor: J·N² of it is not in ARMATURE; state it by `armature` of \<dynamics>, kg·m².
//! - The \<ros2_control> `uf_robot_hardware/UFRobotSystemHardware`: the parameters `default_gripper_baud`, `dof`, `max`, `min` are left out.

#![allow(
    dead_code,
    reason = "not every program uses every constant of its robot"
)]
#![allow(clippy::approx_constant, reason = "numbers are those of the file")]

use ::dynamics_core::effects::{Armature, Coriolis, Coulomb, Gravity, Inertia, Viscous, Width};
use ::dynamics_core::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// The number of bodies.
pub const B: usize = 7;
/// The number of position coordinates.
pub const Q: usize = 7;
/// The number of velocity coordinates.
pub const V: usize = 7;
/// The number of joints.
pub const N: usize = V;

/// The names of the bodies.
pub const BODIES: [&str; B] = [
    "link1", "link2", "link3", "link4", "link5", "link6", "link7",
];
/// The names of their joints.
pub const JOINTS: [&str; B] = [
    "joint1", "joint2", "joint3", "joint4", "joint5", "joint6", "joint7",
];

/// xarm7: 7 bodies on 7 degrees of freedom.
#[derive(Clone, Copy, Debug, Default)]
pub struct XArm7;

impl Robot<7, 7, 7> for XArm7 {
    const MODEL: ArmModel<f64, 7> = Model::new(
        "xarm7",
        [
            Body::new("link1", BASE, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([0.0, 0.0, 0.267])
                .mass(2.382)
                .com([-0.0002, 0.02905, -0.01233])
                .inertia([
                    0.0056905,
                    -1.579e-5,
                    5.125e-6,
                    0.0049566,
                    -0.000873378,
                    0.003316654,
                ])
                .limits(JointLimits {
                    lower: -6.283185307179586,
                    upper: 6.283185307179586,
                    velocity: 3.14,
                    torque: 50.0,
                }),
            Body::new("link2", 0, Joint::revolute([0.0, 0.0, 1.0]))
                .quarter_turns([-1, 0, 0])
                .mass(1.869)
                .com([0.00022, -0.12856, 0.01735])
                .inertia([
                    0.0095989,
                    1.541e-6,
                    5.56e-6,
                    0.00382472,
                    -0.00317156,
                    0.007565669,
                ])
                .limits(JointLimits {
                    lower: -2.059,
                    upper: 2.0944,
                    velocity: 3.14,
                    torque: 50.0,
                }),
            Body::new("link3", 1, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([0.0, -0.293, 0.0])
                .quarter_turns([1, 0, 0])
                .mass(1.6383)
                .com([0.0466, -0.02463, -0.00768])
                .inertia([
                    0.00310955,
                    0.00030837,
                    -0.00058453,
                    0.00264483,
                    0.000338893,
                    0.0026624,
                ])
                .limits(JointLimits {
                    lower: -6.283185307179586,
                    upper: 6.283185307179586,
                    velocity: 3.14,
                    torque: 30.0,
                }),
            Body::new("link4", 2, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([0.0525, 0.0, 0.0])
                .quarter_turns([1, 0, 0])
                .mass(1.7269)
                .com([0.07047, -0.11575, 0.012])
                .inertia([
                    0.005889,
                    0.00137112,
                    0.00088143,
                    0.00359703,
                    -0.001762155,
                    0.00543244,
                ])
                .limits(JointLimits {
                    lower: -0.19198,
                    upper: 3.927,
                    velocity: 3.14,
                    torque: 30.0,
                }),
            Body::new("link5", 3, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([0.0775, -0.3425, 0.0])
                .quarter_turns([1, 0, 0])
                .mass(1.3203)
                .com([-0.00032, 0.01604, -0.026])
                .inertia([
                    0.00534665,
                    1.5117e-5,
                    -3.69e-7,
                    0.0049779,
                    -0.00022132,
                    0.0013624,
                ])
                .limits(JointLimits {
                    lower: -6.283185307179586,
                    upper: 6.283185307179586,
                    velocity: 3.14,
                    torque: 30.0,
                }),
            Body::new("link6", 4, Joint::revolute([0.0, 0.0, 1.0]))
                .quarter_turns([1, 0, 0])
                .mass(1.325)
                .com([0.06469, 0.03278, 0.02141])
                .inertia([
                    0.0014745, -0.000488, 0.0002953, 0.0019037, 0.00014749, 0.0023652,
                ])
                .limits(JointLimits {
                    lower: -1.69297,
                    upper: 3.141592653589793,
                    velocity: 3.14,
                    torque: 20.0,
                }),
            Body::new("link7", 5, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([0.076, 0.097, 0.0])
                .quarter_turns([-1, 0, 0])
                .mass(0.17)
                .com([0.0, -0.00677, -0.01098])
                .inertia([9.3e-5, 0.0, 0.0, 5.87e-5, -3.6e-6, 0.000132])
                .limits(JointLimits {
                    lower: -6.283185307179586,
                    upper: 6.283185307179586,
                    velocity: 3.14,
                    torque: 20.0,
                }),
        ],
    );
}

// A robot with an impossible joint or a negative mass does not compile.
const _: ArmModel<f64, 7> = XArm7::MODEL;

/// Viscous friction, N·m·s/rad or N·s/m.
pub const VISCOUS: Viscous<f32, V> = Viscous([10.0, 10.0, 5.0, 5.0, 5.0, 2.0, 2.0]);
/// Coulomb friction, N·m or N, full beyond 0.02 rad/s or m/s.
pub const COULOMB: Coulomb<f32, V> = Coulomb {
    torque: [1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0],
    width: Width::f32(0.02),
};
/// Inertia of the rotors at the joints, kg·m² or kg.
pub const ARMATURE: Armature<f32, V> = Armature([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);

/// The rigid body's forces of inertia, and those effects that the description states.
pub type Forces = (Inertia, Coriolis, Viscous<f32, V>, Coulomb<f32, V>);
/// With their parameters.
pub const FORCES: Forces = (Inertia, Coriolis, VISCOUS, COULOMB);
/// All that acts on the robot.
pub type Scene = (Gravity, Forces);
/// On Earth, checked at this line.
pub const SCENE: Scene = ::dynamics_core::Core::<XArm7>::scene_f32((Gravity::EARTH, FORCES));
