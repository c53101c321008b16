//! A configuration with what it costs and how far it is off.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// What is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Torques of a motion.
    Inverse,
    /// A motion, step by step.
    Simulation,
}

/// Largest, root mean square and 99th percentile of |error|, over all joints or of one.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Errors {
    pub max: f64,
    pub rms: f64,
    pub p99: f64,
}

/// A configuration of a robot: one in the JSON that `--json` prints.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Point {
    /// The robot's name.
    pub robot: String,
    /// What is computed.
    pub kind: Kind,
    /// Value by axis, those of the default too.
    pub configuration: BTreeMap<String, String>,
    /// Of the longest call, exact; for a simulation, of as many as make a simulated second.
    pub instructions: u64,
    /// Modelled cycles of the same.
    pub cycles: u64,
    /// Modelled cycles of a call in the mean, over a whole period where calls take turns.
    pub cycles_mean: f64,
    /// None has left the robot's range.
    pub error_max: Option<f64>,
    /// Root mean square.
    pub error_rms: Option<f64>,
    /// 99 % are no larger.
    pub error_p99: Option<f64>,
    /// Of the errors.
    pub unit: String,
    /// `error_max` as a share of full scale.
    pub relative_max: Option<f64>,
    /// No other one is as accurate for less, in the worst tick or in the mean.
    pub front: bool,
    /// By less in the worst tick, by less in the mean.
    #[serde(skip)]
    pub fronts: [bool; 2],
    /// Axes that are not the default's, as one word.
    pub key: String,
    /// Of what errors are shares.
    #[serde(skip)]
    pub full_scale: f64,
    /// Joint by joint; of what is recorded, only where a page shows it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub joints: Vec<Errors>,
    /// Largest error over states anywhere, as a share of full scale.
    #[serde(skip)]
    pub anywhere: Option<f64>,
    /// Largest change of the energy in a simulated second, as a share of the largest kinetic energy.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drift: Option<f64>,
}

impl Point {
    /// The value on an axis; empty if it has none of this name.
    pub fn on(&self, axis: &str) -> &str {
        self.configuration.get(axis).map_or("", String::as_str)
    }

    /// What is the same of all that are compared with it.
    pub fn group(&self) -> (&str, Kind, &str) {
        let circumstances = match self.kind {
            Kind::Inverse => self.on("plant"),
            Kind::Simulation => self.on("scene"),
        };
        (&self.robot, self.kind, circumstances)
    }

    /// The largest error, infinite if the robot has left its range.
    pub fn error(&self) -> f64 {
        self.error_max.unwrap_or(f64::INFINITY)
    }

    /// What it costs: the worst tick, the mean.
    pub fn costs(&self) -> [f64; 2] {
        [self.cycles as f64, self.cycles_mean]
    }

    /// Whether it is the library's own choice.
    pub fn is_default(&self) -> bool {
        self.kind == Kind::Inverse && self.key == "default" && self.on("plant") == "rigid"
    }
}

/// An error that nothing computed makes: of a sensor, of a parameter.
#[derive(Clone, Debug, Deserialize)]
pub struct Yardstick {
    /// The robot's name.
    pub robot: String,
    /// Its own name.
    pub key: String,
    /// What is off.
    #[serde(default)]
    pub what: String,
    /// N·m.
    pub error_max: f64,
    /// N·m.
    pub error_rms: f64,
    /// N·m.
    pub error_p99: f64,
    /// `error_max` as a share of full scale.
    pub relative_max: f64,
}

/// What leaving out velocity products loses at a speed of the joints.
#[derive(Clone, Debug, Deserialize)]
pub struct Speed {
    /// The robot's name.
    pub robot: String,
    /// rad/s: no joint is faster.
    pub speed: f64,
    /// N·m.
    pub error_max: f64,
    /// `error_max` as a share of full scale.
    pub relative_max: f64,
}
