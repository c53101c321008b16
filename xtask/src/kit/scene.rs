//! The scenes: the one list of them.

use clap::ValueEnum;
use clap::builder::PossibleValue;

/// A bin of `firmware-demo` that moves an arm and reports what it costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scene {
    name: &'static str,
    help: &'static str,
}

/// Each with its name and what `--help` says of it; the first one is the default.
#[rustfmt::skip]
const SCENES: &[Scene] = &[
    scene("ur5e", "A UR5e picks and places, its encoders on SPI and its drives on PWM"),
    scene("panda_payload", "A Panda carries a load that it picks up along its path, known to the model or not"),
    scene("scara_table", "A SCARA serves a table: three vertical axes, on which gravity does no work"),
    scene("space_arm", "An arm on a satellite that floats free, with the satellite's recoil in its feed-forward"),
    scene("leg_hop", "A leg of a quadruped hops on a vertical rail"),
    scene("flexible_joint", "An iiwa 14 with elastic transmissions, known to the model or not"),
    scene("gimbal_ship", "A gimbal on a rolling ship holds its camera level and sweeps the horizon"),
    scene("direct_drive", "An arm of low gear ratios, whose motors' rotors are gyroscopes"),
    scene("parallel_ankle", "A humanoid's leg steps in the air; two motors tilt its foot by rods, a closed loop"),
    scene("delta_pick", "A Delta robot picks 120 parts a minute; three closed loops"),
    scene("flexible_link", "A light arm whose links bend, with feed-forward that knows their modes and a shaper"),
    scene("so101_teach", "An SO-101 follows a taught path; its servos take duties over a bus at 500 Hz"),
    scene("jog", "A joystick moves a UR5e: the end of its reach, a straight wrist, a limit; inverse kinematics in the tick"),
    scene("openarm_free_drive", "An OpenArm is led by hand over the frames of its CAN drives, let go, picks a tool up, and stays"),
    scene("wheel_leg_balance", "A robot on two wheels with five-bar legs balances, drives over a kerb, squats, is pushed; LQR from its model"),
];

const fn scene(name: &'static str, help: &'static str) -> Scene {
    Scene { name, help }
}

impl Scene {
    pub fn all() -> &'static [Self] {
        SCENES
    }

    /// The name on the command line, of the bin, and in every generated file.
    pub fn name(self) -> &'static str {
        self.name
    }

    fn value(self) -> PossibleValue {
        PossibleValue::new(self.name).help(self.help)
    }
}

impl Default for Scene {
    fn default() -> Self {
        SCENES[0]
    }
}

impl ValueEnum for Scene {
    fn value_variants<'a>() -> &'a [Self] {
        SCENES
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(self.value())
    }
}
