//! The scenes: the one list of them.

use clap::ValueEnum;

/// A bin of `firmware-demo` that moves an arm and reports what it costs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Scene {
    /// A UR5e picks and places, its encoders on SPI and its drives on PWM.
    #[default]
    Ur5e,
    /// An iiwa 14 whose transmissions give way, told so or not.
    #[value(name = "flexible_joint")]
    FlexibleJoint,
    /// An arm on a satellite that floats free, with the satellite's recoil in its feed-forward.
    #[value(name = "space_arm")]
    SpaceArm,
    /// A gimbal on a rolling ship holds its camera level and sweeps the horizon.
    #[value(name = "gimbal_ship")]
    GimbalShip,
}

impl Scene {
    /// All of them.
    pub const ALL: &[Self] = &[
        Self::Ur5e,
        Self::FlexibleJoint,
        Self::SpaceArm,
        Self::GimbalShip,
    ];

    /// The name on the command line, of the bin, and in every generated file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ur5e => "ur5e",
            Self::FlexibleJoint => "flexible_joint",
            Self::SpaceArm => "space_arm",
            Self::GimbalShip => "gimbal_ship",
        }
    }
}
