//! The scenes: the one list of them.

use std::sync::LazyLock;

use clap::ValueEnum;
use clap::builder::PossibleValue;

/// A bin of `firmware-demo` that moves an arm and reports what it costs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub enum Scene {
    /// A UR5e picks and places, its encoders on SPI and its drives on PWM.
    #[default]
    Ur5e,
    /// A Panda carries a load that it picks up along its path, known to the model or not.
    PandaPayload,
    /// A SCARA serves a table: three vertical axes, on which gravity does no work.
    ScaraTable,
    /// An arm on a satellite that floats free, with the satellite's recoil in its feed-forward.
    SpaceArm,
    /// A leg of a quadruped hops on a vertical rail.
    LegHop,
    /// An iiwa 14 with elastic transmissions, known to the model or not.
    FlexibleJoint,
    /// A gimbal on a rolling ship holds its camera level and sweeps the horizon.
    GimbalShip,
    /// An arm of low gear ratios, whose motors' rotors are gyroscopes.
    DirectDrive,
    /// A humanoid's leg steps in the air; two motors tilt its foot by rods, a closed loop.
    ParallelAnkle,
    /// A Delta robot picks 120 parts a minute; three closed loops.
    DeltaPick,
    /// A light arm whose links bend, with feed-forward that knows their modes and a shaper.
    FlexibleLink,
    /// An SO-101 follows a taught path; its servos take duties over a bus at 500 Hz.
    So101Teach,
}

impl Scene {
    /// All of them.
    pub fn all() -> &'static [Self] {
        Self::value_variants()
    }

    /// The name on the command line, of the bin, and in every generated file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ur5e => "ur5e",
            Self::PandaPayload => "panda_payload",
            Self::ScaraTable => "scara_table",
            Self::FlexibleJoint => "flexible_joint",
            Self::LegHop => "leg_hop",
            Self::DirectDrive => "direct_drive",
            Self::SpaceArm => "space_arm",
            Self::GimbalShip => "gimbal_ship",
            Self::ParallelAnkle => "parallel_ankle",
            Self::DeltaPick => "delta_pick",
            Self::FlexibleLink => "flexible_link",
            Self::So101Teach => "so101_teach",
        }
    }
}

/// A bin of `lab-target` that shows something else than how an arm tracks, on a page of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub enum Trial {
    /// A UR5e without force sensors runs into a wall, finds the contact, and stops, goes back, or floats.
    Ur5eContact,
    /// An SO-101 whose parameters are off by 30 % learns them, and then weighs what it carries.
    So101Learn,
}

impl Trial {
    /// All of them.
    pub fn all() -> &'static [Self] {
        Self::value_variants()
    }

    /// The name on the command line and of the bins.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ur5eContact => "ur5e_contact",
            Self::So101Learn => "so101_learn",
        }
    }
}

/// A scene of the demo.
#[derive(Clone, Copy, Debug)]
pub enum Shown {
    Tracking(Scene),
    Trial(Trial),
}

impl Default for Shown {
    fn default() -> Self {
        Self::Tracking(Scene::default())
    }
}

impl ValueEnum for Shown {
    fn value_variants<'a>() -> &'a [Self] {
        static ALL: LazyLock<Vec<Shown>> = LazyLock::new(|| {
            let trials = Trial::all().iter().copied().map(Shown::Trial);
            let scenes = Scene::all().iter().copied().map(Shown::Tracking);
            scenes.chain(trials).collect()
        });
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        match self {
            Self::Tracking(scene) => scene.to_possible_value(),
            Self::Trial(trial) => trial.to_possible_value(),
        }
    }
}
