//! A configuration with what it costs and how far it is off.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// The kind of a computation, or of a line of the host.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    #[default]
    Inverse,
    /// A motion, step by step.
    Simulation,
    /// Torques by the code that is printed as generated code.
    Generated,
    Yardstick,
    /// The error of the reference itself.
    Oracle,
}

/// A configuration of a robot: one in the JSON that `--json` prints.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Point {
    pub robot: String,
    pub kind: Kind,
    /// Value by axis, those of the default too.
    pub configuration: BTreeMap<String, String>,
    /// Instructions of the longest call, exact; for a simulation, of a simulated second.
    pub instructions: u64,
    /// Modelled cycles of the same.
    pub cycles: u64,
    /// Modelled cycles of a call in the mean, over a whole period where calls take turns.
    pub cycles_mean: f64,
    /// The largest |error| of any joint; none if the robot has left its range.
    pub error_max: Option<f64>,
    /// Root mean square.
    pub error_rms: Option<f64>,
    /// 99 % are no larger.
    pub error_p99: Option<f64>,
    pub unit: String,
    /// `error_max` as a share of full scale.
    pub relative_max: Option<f64>,
    /// The largest |error| in random states of the joints' box of a robot from a file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error_box: Option<f64>,
    /// The bound that no joint's |error| exceeds in any state of the joints' box.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proven: Option<f64>,
    /// No other one is as accurate for less, in the worst tick or in the mean.
    pub front: bool,
    /// By less in the worst tick, by less in the mean.
    #[serde(skip)]
    pub fronts: [bool; 2],
    /// Axes that are not the default's, as one word.
    pub key: String,
    /// Largest change of the energy in a simulated second, as a share of the largest kinetic
    /// energy.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drift: Option<f64>,
    /// The name of the type and the number of joints of a robot from a file.
    #[serde(skip)]
    pub own: Option<[String; 2]>,
}

impl Point {
    /// The value on an axis; empty if it has none of this name.
    pub fn on(&self, axis: &str) -> &str {
        self.configuration.get(axis).map_or("", String::as_str)
    }

    /// Axes and values that are not the default's.
    pub fn changes(&self) -> impl Iterator<Item = (&str, &str)> {
        let axes = self.key.split(',');
        axes.filter_map(|axis| axis.split_once('='))
    }

    /// Robot, kind and scene, which are the same for all points that are compared with each other.
    pub fn group(&self) -> (&str, Kind, &str) {
        (&self.robot, self.kind, self.on("scene"))
    }

    /// The largest error, infinite if the robot has left its range.
    pub fn error(&self) -> f64 {
        self.error_max.unwrap_or(f64::INFINITY)
    }

    /// The largest error, that of 99 %, the RMS, and the largest as a share of full scale.
    pub fn errors(&self) -> [Option<f64>; 4] {
        let [max, p99, rms] = [self.error_max, self.error_p99, self.error_rms];
        [max, p99, rms, self.relative_max]
    }

    /// The cycles of the worst tick and of the mean.
    pub fn costs(&self) -> [f64; 2] {
        [self.cycles as f64, self.cycles_mean]
    }

    /// The position in a picture: the cost of the worst tick, and the largest error.
    pub fn place(&self) -> (f64, f64) {
        (self.cycles as f64, self.error())
    }

    /// Whether it is the library's own choice.
    pub fn is_default(&self) -> bool {
        self.kind == Kind::Inverse && self.key == "default"
    }
}

pub fn of_group<'a>(points: &'a [Point], group: (&str, Kind, &str)) -> Vec<&'a Point> {
    let own = points.iter().filter(|point| point.group() == group);
    own.collect()
}
