//! Enactic OpenArm 2.0.

use crate::effects::{Armature, ConstantTorque, Coulomb, Viscous, Width};
use crate::model::{ArmModel, BASE, Body, Joint, JointLimits, Model, Robot};

/// Enactic OpenArm 2.0, the right arm with its gripper held: 7 revolute joints about x, y and z,
/// 4.99 kg of moving mass. At zero it hangs straight down.
///
/// The base frame is that of the shoulder, z upwards and the arm on the side of −y.
///
/// | joints | motor by Damiao | gear | N·m held, peak | N·m/A | rotor, kg m² | rad/s |
/// |---|---|---|---|---|---|---|
/// | 1, 2 | DM-J8009P-2EC | 9 | 20, 40 | 1.2616 | 1.95e-4 | 16.755 |
/// | 3, 4 | DM-J4340P-2EC, DM-J4340-2EC | 40 | 9, 27 | 4.074 | 2e-5 | 5.4454 |
/// | 5, 6, 7 | DM-J4310-2EC V1.1 | 10 | 3, 7 | 0.945 | 1.8e-5 | 20.944 |
///
/// Torque constants are at the joint, per ampere of phase current and without losses of the gear;
/// rotors are before the gear. The limits of torque are peaks, and those of speed the speeds
/// without load at 24 V, so that no motor reaches both at once.
///
/// # Source
///
/// - Kinematics, inertias, positions, torques: enactic/openarm_mujoco 2.1.0 (commit 396c88d8,
///   `v2/openarm_bimanual.xml`, Apache-2.0).
/// - Torques and speeds of motors: the maker's manuals in enactic/openarm (commit 1080ae9a,
///   `website/static/file/hardware/specification/motor`): `dm8009.pdf`, page 8; `dm4340.pdf`, page
///   8; `dm4310.pdf`, page 9. The project takes the DM-J8009's for the DM-J8009P.
/// - Torque constants and rotors, which the manuals do not have: the table of Seeed, who sells
///   these motors, wiki.seeedstudio.com/damiao_series of 2025-06-01.
///
/// # Changed
///
/// - The numbers are those of `robot-import`, inertias rounded to seven digits or 1e-12 kg m², and
///   the limits of position are whole degrees. The base link is omitted since it does not move.
/// - The two fingers, 0.24 kg, are part of the hand, at half of their stroke of 0.7854 rad. Closed
///   or open, they move the centre of mass of hand and fingers by less than 2 mm and change their
///   moments of inertia by at most 25 %.
///
/// ```
/// use dynamics_core::effects::{Coriolis, Gravity, Inertia};
/// use dynamics_core::{Engine, robots::OpenArm, state::State};
/// let scene = (Gravity::EARTH, Inertia, Coriolis, OpenArm::ARMATURE, OpenArm::FRICTION);
/// let mut state = State::at([0.0_f32; 7]);
/// let hanging = Engine::<OpenArm>::rnea(&state, &scene);
/// state.qd[3] = 0.5;
/// let moving = Engine::<OpenArm>::rnea(&state, &scene);
/// // The elbow's friction, of which two thirds grow with speed.
/// assert!((moving[3] - hanging[3] - (0.166 + 0.813 * 0.5)).abs() < 0.01);
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct OpenArm;

impl OpenArm {
    /// The rotors' inertias as the joints feel them, kg m²: those of the table above times the
    /// squares of the gears.
    ///
    /// The source of the links has 1e-4 kg m² before the gear for each of these motors, large or
    /// small: 0.0081, 0.16 and 0.01 kg m² at the joint.
    pub const ARMATURE: Armature<f32, 7> = {
        let [a, b, c] = [1.95e-4 * 81.0, 2e-5 * 1600.0, 1.8e-5 * 100.0];
        Armature([a, a, b, b, c, c, c])
    };

    /// Friction as the project compensates it: enactic/openarm_teleop (commit a0ca06ab,
    /// `config/follower.yaml`, Apache-2.0), which fits F_c tanh(k q̇) + F_v q̇ + F_o.
    ///
    /// The width is 1.5/k of joints 1 to 3, where the slopes at rest agree; k is 130, 152, 242 and
    /// 8 s/rad in the others, and the project's code uses a tenth of each. It has the same F_o for
    /// its left and its right arm, so that their signs are not certain. Stiction is not in the fit.
    pub const FRICTION: (Coulomb<f32, 7>, Viscous<f32, 7>, ConstantTorque<f32, 7>) = (
        Coulomb {
            torque: [0.306, 0.306, 0.4, 0.166, 0.05, 0.093, 0.172],
            width: Width::f32(0.053),
        },
        Viscous([0.063, 0.063, 0.604, 0.813, 0.029, 0.072, 0.084]),
        ConstantTorque([0.088, 0.088, 0.008, -0.058, 0.005, 0.009, -0.059]),
    );
}

/// kg m² of kg mm².
const fn micro(mut inertia: [f64; 6]) -> [f64; 6] {
    let mut i = 0;
    while i < 6 {
        inertia[i] *= 1e-6;
        i += 1;
    }
    inertia
}

/// Degrees, N·m, rad/s.
pub(super) const fn limits(lower: f64, upper: f64, torque: f64, velocity: f64) -> JointLimits<f64> {
    let [lower, upper] = [lower.to_radians(), upper.to_radians()];
    JointLimits { lower, upper, velocity, torque }
}

impl Robot<7, 7, 7> for OpenArm {
    const MODEL: ArmModel<f64, 7> = Model::new(
        "openarm",
        [
            Body::new("link_1", BASE, Joint::revolute([0.0, -1.0, 0.0]))
                .xyz([0.0, -0.0625, 0.0])
                .mass(1.14167)
                .com([0.00090035, -0.044466, 2.88441e-5])
                .inertia(micro([1094.326, 9.416377, 0.045343, 759.1993, 0.066675, 670.6591]))
                .limits(limits(-80.0, 200.0, 40.0, 16.755)),
            Body::new("link_2", 0, Joint::revolute([-1.0, 0.0, 0.0]))
                .xyz([0.0, -0.06, 0.0])
                .mass(0.277509)
                .com([-0.0247185, 0.0, -0.0312643])
                .inertia(micro([153.5892, -0.000294, 5.210584, 113.062, 0.000376, 82.29993]))
                .limits(limits(-10.0, 190.0, 40.0, 16.755)),
            Body::new("link_3", 1, Joint::revolute([0.0, 0.0, -1.0]))
                .xyz([0.0, 0.0, -0.06625])
                .mass(1.07386)
                .com([-0.00300862, -0.000514813, -0.109368])
                .inertia(micro([1289.393, -0.229972, -67.61588, 1140.192, -10.62605, 559.7657]))
                .limits(limits(-90.0, 90.0, 27.0, 5.4454)),
            Body::new("link_4", 2, Joint::revolute([0.0, -1.0, 0.0]))
                .xyz([0.0, 0.0, -0.15375])
                .mass(0.634853)
                .com([-0.00310326, -0.00136539, -0.0574601])
                .inertia(micro([469.0039, 5.636289, -1.778799, 433.9264, 3.417705, 245.2117]))
                .limits(limits(0.0, 140.0, 27.0, 5.4454)),
            Body::new("link_5", 3, Joint::revolute([0.0, 0.0, -1.0]))
                .xyz([0.0, 0.0, -0.0955])
                .mass(0.615659)
                .com([-0.000737189, -0.000412407, -0.0470938])
                .inertia(micro([279.6537, 3.317425, 0.768098, 334.5994, -0.149934, 176.6629]))
                .limits(limits(-90.0, 90.0, 7.0, 20.944)),
            Body::new("link_6", 4, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.0, 0.0, -0.1205])
                .mass(0.475203)
                .com([2.27438e-5, 0.000686496, 5.44e-5])
                .inertia(micro([179.2759, 0.065869, -0.03371, 136.2479, 0.033255, 135.3402]))
                .limits(limits(-45.0, 45.0, 7.0, 20.944)),
            Body::new("hand", 5, Joint::revolute([1.0, 0.0, 0.0]))
                .mass(0.768019)
                .com([0.005095035, 0.006061044, -0.06917247])
                .inertia(micro([669.7859, -31.3882, -128.5322, 518.1219, -48.54419, 545.6163]))
                .limits(limits(-90.0, 90.0, 7.0, 20.944)),
        ],
    );
}

const _: ArmModel<f64, 7> = OpenArm::MODEL;
