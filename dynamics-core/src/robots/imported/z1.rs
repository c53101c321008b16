//! z1.
//!
//! # Source
//!
//! `z1.urdf`; it states no licence. Imported on 2026-11-21 by robot-import 0.1.0.
//!
//! # Changed
//!
//! - Part of body `link06`: `gripperStator`.

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
    "link01",
    "link02",
    "link03",
    "link04",
    "link05",
    "link06",
    "gripperMover",
];
/// The names of their joints.
pub const JOINTS: [&str; B] = [
    "joint1",
    "joint2",
    "joint3",
    "joint4",
    "joint5",
    "joint6",
    "jointGripper",
];

/// z1: 7 bodies on 7 degrees of freedom.
#[derive(Clone, Copy, Debug, Default)]
pub struct Z1;

impl Robot<7, 7, 7> for Z1 {
    const MODEL: ArmModel<f64, 7> = Model::new(
        "z1",
        [
            Body::new("link01", BASE, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([0.0, 0.0, 0.0585])
                .mass(0.67332551)
                .com([2.47e-6, -0.00025198, 0.02317169])
                .inertia([0.00128328, -6e-8, -4e-7, 0.00071931, 5e-7, 0.00083936])
                .limits(JointLimits {
                    lower: -2.6179938779914944,
                    upper: 2.6179938779914944,
                    velocity: 3.1415,
                    torque: 30.0,
                }),
            Body::new("link02", 0, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.0, 0.0, 0.045])
                .mass(1.19132258)
                .com([-0.11012601, 0.00240029, 0.00158266])
                .inertia([
                    0.00102138, 0.00062358, 5.13e-6, 0.02429457, -2.1e-6, 0.02466114,
                ])
                .limits(JointLimits {
                    lower: 0.0,
                    upper: 2.9670597283903604,
                    velocity: 3.1415,
                    torque: 60.0,
                }),
            Body::new("link03", 1, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([-0.35, 0.0, 0.0])
                .mass(0.83940874)
                .com([0.10609208, -0.00541815, 0.03476383])
                .inertia([
                    0.00108061,
                    -8.669e-5,
                    -0.00208102,
                    0.00954238,
                    -1.332e-5,
                    0.00886621,
                ])
                .limits(JointLimits {
                    lower: -2.8797932657906435,
                    upper: 0.0,
                    velocity: 3.1415,
                    torque: 30.0,
                }),
            Body::new("link04", 2, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.218, 0.0, 0.057])
                .mass(0.56404563)
                .com([0.04366681, 0.00364738, -0.00170192])
                .inertia([
                    0.00031576, 8.13e-5, 4.091e-5, 0.00092996, -5.96e-6, 0.00097912,
                ])
                .limits(JointLimits {
                    lower: -1.5184364492350666,
                    upper: 1.5184364492350666,
                    velocity: 3.1415,
                    torque: 30.0,
                }),
            Body::new("link05", 3, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([0.07, 0.0, 0.0])
                .mass(0.38938492)
                .com([0.03121533, 0.0, 0.00646316])
                .inertia([0.00017605, 4e-7, 5.689e-5, 0.00055896, -1.3e-7, 0.0005386])
                .limits(JointLimits {
                    lower: -1.3439035240356338,
                    upper: 1.3439035240356338,
                    velocity: 3.1415,
                    torque: 30.0,
                }),
            Body::new("link06", 4, Joint::revolute([1.0, 0.0, 0.0]))
                .xyz([0.0492, 0.0, 0.0])
                .mass(0.81479462)
                .com([
                    0.07224641626776021,
                    -0.0002927547495257148,
                    -0.002118493062097293,
                ])
                .inertia([
                    0.0005703230092387275,
                    1.9395459744603157e-7,
                    9.178026233463511e-5,
                    0.001868195845425298,
                    2.1337591549081808e-6,
                    0.0018440855472965714,
                ])
                .limits(JointLimits {
                    lower: -2.792526803190927,
                    upper: 2.792526803190927,
                    velocity: 3.1415,
                    torque: 30.0,
                }),
            Body::new("gripperMover", 5, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.1, 0.0, 0.0])
                .mass(0.27621302)
                .com([0.01320633, 0.00476708, 0.00380534])
                .inertia([
                    0.00017716, 1.683e-5, -1.786e-5, 0.00026787, 2.62e-6, 0.00035728,
                ])
                .limits(JointLimits {
                    lower: -1.5707,
                    upper: 0.0,
                    velocity: 3.1415,
                    torque: 30.0,
                }),
        ],
    );
}

// A robot with an impossible joint or a negative mass does not compile.
const _: ArmModel<f64, 7> = Z1::MODEL;

/// Viscous friction, N·m·s/rad or N·s/m.
pub const VISCOUS: Viscous<f32, V> = Viscous([1.0, 2.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
/// Coulomb friction, N·m or N, full beyond 0.02 rad/s or m/s.
pub const COULOMB: Coulomb<f32, V> = Coulomb {
    torque: [1.0, 2.0, 1.0, 1.0, 1.0, 1.0, 1.0],
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
pub const SCENE: Scene = ::dynamics_core::Core::<Z1>::scene_f32((Gravity::EARTH, FORCES));
