//! The scenes: the one list of them.

use std::sync::LazyLock;

use clap::ValueEnum;
use clap::builder::PossibleValue;

use super::docs::Page;

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

/// A bin of `lab-target` that shows something else than how an arm tracks, on a page of its own.
#[derive(Clone, Copy, Debug)]
pub struct Trial {
    scene: Scene,
    pub page: Page<'static>,
}

#[rustfmt::skip]
const TRIALS: &[Trial] = &[
    Trial {
        scene: scene("ur5e_contact", "A UR5e without force sensors runs into a wall, finds the contact, and stops, goes back, or floats"),
        page: Page { file: "docs/contact.md", name: "contact", command: "cargo xtask demo --scene ur5e_contact --write-docs" },
    },
    Trial {
        scene: scene("so101_learn", "An SO-101 whose parameters are off by 30 % learns them, and then weighs what it carries"),
        page: Page { file: "docs/learning.md", name: "learning", command: "cargo xtask demo --scene so101_learn --write-docs" },
    },
];

impl Trial {
    pub fn all() -> &'static [Self] {
        TRIALS
    }

    /// The name on the command line and of the bins.
    pub fn name(self) -> &'static str {
        self.scene.name
    }
}

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
            let trials = TRIALS.iter().copied().map(Shown::Trial);
            let scenes = SCENES.iter().copied().map(Shown::Tracking);
            scenes.chain(trials).collect()
        });
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        match self {
            Self::Tracking(scene) | Self::Trial(Trial { scene, .. }) => Some(scene.value()),
        }
    }
}
