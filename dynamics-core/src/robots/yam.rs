//! I2RT YAM.

use super::openarm::limits;
use crate::effects::{Armature, Coulomb, Width};
use crate::model::{ArmModel, BASE, Body, Joint, Model, Robot};

/// I2RT YAM with its gripper `linear_4310` held: 6 revolute joints about x, y and z, 4.11 kg of
/// moving mass. At zero its upper arm points backwards and its forearm forwards.
///
/// The base frame has z upwards and the arm's front on the side of +x.
///
/// | joints | motor by Damiao | gear | N·m held, peak | N·m/A | rotor, kg m² | rad/s |
/// |---|---|---|---|---|---|---|
/// | 1, 2, 3 | DM4340 | 40 | 9, 27 | 4.074 | 2e-5 | 5.4454 |
/// | 4, 5, 6 | DM4310 | 10 | 3, 7 | 0.945 | 1.8e-5 | 20.944 |
///
/// The columns are those of [`OpenArm`](super::OpenArm), whose joints 3 to 7 have these motors at
/// 24 V too. The limits of torque are peaks: stretched out horizontally, the arm weighs on motor 2
/// with 15 N·m.
///
/// # Source
///
/// - Kinematics, inertias, positions: i2rt-robotics/i2rt (commit 5d47b358,
///   `i2rt/robot_models/arm/yam/yam.urdf`, MIT). MuJoCo Menagerie's `i2rt_yam` is of an earlier
///   design, whose upper arm has 1.24 kg in place of 1.47.
/// - Motors of the joints: `i2rt/robots/config/yam.yml` there; the supply of 24 V:
///   `docs/getting-started/hardware/yam.md`, commit 9a9685eb. The motors' numbers have the sources
///   that [`OpenArm`](super::OpenArm) names.
///
/// The maker's program commands 1.1 times the gravity of its model in joints 2 and 3, 1.2 times in
/// joint 4 (`yam.yml`), for what gears and cables take: gravity is not known better than that.
///
/// # Changed
///
/// - The numbers are those of `robot-import`, inertias rounded to seven digits; axes, right angles
///   and offsets below 0.5 µm are without their rounding errors, and the limits of position are
///   whole degrees. The base link is omitted since it does not move.
/// - The two fingers, 0.14 kg, are part of the hand, at half of their stroke of 47 mm. Closed or
///   open, they leave its centre of mass where it is and change its moments of inertia by at most
///   41 %.
///
/// ```
/// use dynamics_core::effects::{Coriolis, Gravity, Inertia};
/// use dynamics_core::{Engine, robots::Yam, state::State};
/// let scene = (Gravity::EARTH, Inertia, Coriolis, Yam::ARMATURE, Yam::FRICTION);
/// let half_turn = core::f32::consts::PI;
/// let mut state = State::at([0.0, half_turn, half_turn, 0.0, 0.0, 0.0]);
/// let stretched = Engine::<Yam>::rnea(&state, &scene);
/// // More than the 9 N·m that motor 2 holds for long.
/// assert!((stretched[1] + 15.06).abs() < 0.01);
/// state.qdd[1] = 1.0;
/// let swung = Engine::<Yam>::rnea(&state, &scene);
/// // The upper arm and all beyond it, of which the rotor is a part.
/// assert!(swung[1] - stretched[1] > 10.0 * Yam::ARMATURE.0[1]);
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Yam;

impl Yam {
    /// The rotors' inertias as the joints feel them, kg m²: those of the table above times the
    /// squares of the gears.
    ///
    /// MuJoCo Menagerie's `i2rt_yam/yam.xml` has the same two numbers, "provided by the
    /// manufacturer" according to its README.
    pub const ARMATURE: Armature<f32, 6> = {
        let [a, b] = [2e-5 * 1600.0, 1.8e-5 * 100.0];
        Armature([a, a, a, b, b, b])
    };

    /// Friction as the maker's program compensates it where it is asked to: `yam.yml` (MIT), which
    /// has F_c sgn q̇.
    ///
    /// The width is not of it: 0.02 rad/s, as `robot-import` takes where a description has none.
    /// The maker raises F_c until joints nearly move by themselves
    /// (`docs/guides/gravity-compensation.md`, commit 1e523b07), so that the friction is not less.
    pub const FRICTION: Coulomb<f32, 6> =
        Coulomb { torque: [0.3, 0.3, 0.3, 0.06, 0.06, 0.06], width: Width::f32(0.02) };
}

impl Robot<6, 6, 6> for Yam {
    const MODEL: ArmModel<f64, 6> = Model::new(
        "yam",
        [
            Body::new("link1", BASE, Joint::revolute([-1.0, 0.0, 0.0]))
                .xyz([0.0, 0.0, 0.068])
                .quarter_turns([0, 1, 2])
                .mass(0.101218)
                .com([-0.0233636, -0.00172503, -0.00727828])
                .inertia([1.14689e-4, -4.62759e-6, -1.3427e-5, 4.76603e-5, -2.58724e-6, 1.25996e-4])
                .limits(limits(-150.0, 180.0, 27.0, 5.4454)),
            Body::new("link2", 0, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([-0.0455, -0.0339, -0.02])
                .quarter_turns([0, 0, 2])
                .mass(1.46908)
                .com([1.34495e-4, -0.0331253, 0.129165])
                .inertia([0.0146686, -1.1067e-8, -4.33007e-7, 0.014599, 3.12564e-6, 8.00089e-4])
                .limits(limits(0.0, 210.0, 27.0, 5.4454)),
            Body::new("link3", 1, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.0, -0.0688, 0.264])
                .quarter_turns([0, 0, 2])
                .mass(0.982553)
                .com([-0.0556042, -0.0340514, -0.135083])
                .inertia([0.00758945, 4.36076e-6, -6.4069e-4, 0.00763097, -1.09984e-5, 9.37606e-4])
                .limits(limits(0.0, 180.0, 27.0, 5.4454)),
            Body::new("link4", 2, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([-0.0600003, -0.0688, -0.244999])
                .mass(0.462165)
                .com([-0.0550959, 0.032726, -0.0575534])
                .inertia([4.73594e-4, 3.00819e-5, -2.38801e-4, 7.64022e-4, 2.9261e-5, 6.04492e-4])
                .limits(limits(-97.0, 90.0, 7.0, 20.944)),
            Body::new("link5", 3, Joint::revolute([1.0, 0.0, 0.0]))
                .xyz([-0.0405003, 0.0338995, -0.0739989])
                .mass(0.403307)
                .com([0.0375847, -3.55003e-5, -8.25911e-4])
                .inertia([1.84284e-4, 2.10549e-7, 1.29173e-5, 2.19791e-4, -3.49657e-7, 1.81053e-4])
                .limits(limits(-90.0, 90.0, 7.0, 20.944)),
            Body::new("hand", 4, Joint::revolute([0.0, 0.0, -1.0]))
                .xyz([0.0404996, 0.0, -0.0356])
                .mass(0.692533)
                .com([-2.852349e-5, 1.992061e-4, -0.03941211])
                .inertia([
                    8.577349e-4,
                    -5.533845e-6,
                    9.907544e-7,
                    7.17571e-4,
                    -6.232789e-6,
                    5.421631e-4,
                ])
                .limits(limits(-120.0, 120.0, 7.0, 20.944)),
        ],
    );
}

const _: ArmModel<f64, 6> = Yam::MODEL;
