//! Which columns of a record are the time, the positions and the torques, and in which units.

use std::collections::HashSet;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use robot_import::description::most_similar;
use serde::Deserialize;
use serde_json::{Map as Table, Value};

use super::error::{Error, Problem, Result};

/// Layouts of records that are recognised by their titles.
const LAYOUTS: &str = include_str!("layouts.toml");
/// The names of the units, and what they are in s, rad or m, and N·m or N.
const TIMES: [(&str, f64); 4] = [("s", 1.0), ("ms", 1e-3), ("us", 1e-6), ("ns", 1e-9)];
const ANGLES: [(&str, f64); 6] = [
    ("rad", 1.0),
    ("deg", std::f64::consts::PI / 180.0),
    ("turn", std::f64::consts::TAU),
    ("counts", std::f64::consts::TAU),
    ("m", 1.0),
    ("mm", 1e-3),
];
const TORQUES: [(&str, f64); 5] =
    [("Nm", 1.0), ("mNm", 1e-3), ("N", 1.0), ("A", 1.0), ("mA", 1e-3)];
/// The largest map, bytes; what is behind is not read.
const LARGEST: u64 = 1 << 20;
/// The most titles that an error lists.
const LISTED: usize = 40;

/// A map of columns.
#[derive(Clone, Debug)]
pub struct Map {
    all: OfAll,
    /// The entries of all joints, and of single ones.
    each: Table<String, Value>,
}

#[derive(Clone, Debug, Deserialize)]
struct OfAll {
    time: Option<String>,
    time_unit: Option<String>,
    topic: Option<String>,
    /// The names of the joints in the record, in the order of the robot's.
    joints: Option<Vec<String>>,
    #[serde(default)]
    joint: Table<String, Value>,
    rows: Option<Rows>,
    /// A column that counts up by one from row to row.
    follows: Option<String>,
    /// Whether a torque is held until the next row.
    #[serde(default)]
    held: bool,
}

/// The rows that count: those in which a column has this text.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Rows {
    column: String,
    is: String,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct OfJoint {
    position: Option<String>,
    position_unit: Option<String>,
    counts_per_turn: Option<f64>,
    /// The reading at the robot's zero.
    #[serde(default)]
    zero: f64,
    #[serde(default = "one")]
    position_sign: f64,
    torque: Option<String>,
    torque_unit: Option<String>,
    torque_constant: Option<f64>,
    #[serde(default = "one")]
    gear: f64,
    #[serde(default = "one")]
    sign: f64,
}

fn one() -> f64 {
    1.0
}

/// The places of columns, and their units.
#[derive(Clone, Debug)]
pub(crate) struct Columns {
    pub titles: Vec<String>,
    /// The column, and its unit in s.
    pub time: (usize, f64),
    /// The columns of each joint, the unit of the position with the reading at zero, and the unit
    /// of the torque.
    pub joints: Vec<OfColumns>,
    pub rows: Option<(usize, String)>,
    pub follows: Option<usize>,
    pub held: bool,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct OfColumns {
    pub position: usize,
    pub angle: f64,
    pub zero: f64,
    pub torque: usize,
    pub unit: f64,
}

impl Map {
    /// Reads a file.
    ///
    /// # Errors
    /// [`Error`] names the file and what is wrong in it.
    pub fn read(path: &Path) -> Result<Self> {
        let read = |source| Error::Read { path: path.to_owned(), source };
        let (mut text, file) = (String::new(), File::open(path).map_err(read)?);
        file.take(LARGEST).read_to_string(&mut text).map_err(read)?;
        let wrong =
            |reason| Error::Recording { path: path.to_owned(), problem: Problem::Map(reason) };
        Self::of(&text).map_err(wrong)
    }

    /// Reads a text.
    ///
    /// # Errors
    /// The error in it.
    pub fn of(text: &str) -> std::result::Result<Self, String> {
        Self::from(toml_edit::de::from_str(text).map_err(|error| error.to_string())?)
    }

    fn from(map: Value) -> std::result::Result<Self, String> {
        const ALL: [&str; 8] =
            ["time", "time_unit", "topic", "joints", "joint", "rows", "follows", "held"];
        let Value::Object(mut each) = map else { return Err("no table".to_owned()) };
        let all = ALL.iter().filter_map(|key| Some(((*key).to_owned(), each.remove(*key)?)));
        let all: OfAll = serde_json::from_value(Value::Object(all.collect()))
            .map_err(|error| error.to_string())?;
        let map = Self { all, each };
        map.joint("").map_err(|error| format!("{error}, or one of {}", ALL.join(", ")))?;
        Ok(map)
    }

    pub(crate) fn topic(&self) -> Option<&str> {
        self.all.topic.as_deref()
    }

    fn joint(&self, name: &str) -> std::result::Result<OfJoint, String> {
        let mut own = self.each.clone();
        if let Some(Value::Object(more)) = self.all.joint.get(name) {
            own.extend(more.clone());
        }
        serde_json::from_value(Value::Object(own)).map_err(|error| error.to_string())
    }

    /// The columns of a record with these titles, of a robot with these joints.
    pub(crate) fn columns(
        &self,
        titles: &[String],
        joints: &[String],
    ) -> std::result::Result<Columns, Problem> {
        let own = self.all.joints.as_deref().unwrap_or(joints);
        let mut found = Finder { titles, missing: Vec::new(), unstated: Vec::new() };
        if own.len() != joints.len() {
            return Err(Problem::Map(format!(
                "`joints` names {} of the robot's {} joints ({})",
                own.len(),
                joints.len(),
                joints.join(", ")
            )));
        }
        if let Some(name) = self.all.joint.keys().find(|name| !own.contains(name)) {
            let like = most_similar(name, own.iter().map(String::as_str));
            let like = like.map_or(String::new(), |like| format!("; did you mean `{like}`?"));
            return Err(Problem::Map(format!(
                "there is no joint `{name}` for [joint.{name}]{like}"
            )));
        }
        let column = found.column(self.all.time.as_deref(), "time", 0, "");
        let unit = found.unit(self.all.time_unit.as_deref(), "time_unit", &TIMES);
        let time = (column, unit);
        let mut each = Vec::new();
        for (index, name) in own.iter().enumerate() {
            let of = self.joint(name).map_err(Problem::Map)?;
            let mut angle = found.unit(of.position_unit.as_deref(), "position_unit", &ANGLES);
            if of.position_unit.as_deref() == Some("counts") {
                angle /= found.number(of.counts_per_turn, "counts_per_turn");
            }
            let mut unit = found.unit(of.torque_unit.as_deref(), "torque_unit", &TORQUES);
            if matches!(of.torque_unit.as_deref(), Some("A" | "mA")) {
                unit *= found.number(of.torque_constant, "torque_constant");
            }
            each.push(OfColumns {
                position: found.column(of.position.as_deref(), "position", index, name),
                angle: angle * of.position_sign,
                zero: of.zero,
                torque: found.column(of.torque.as_deref(), "torque", index, name),
                unit: unit * of.gear * of.sign,
            });
        }
        // A record by numbers of joints does not name the robot.
        if let Some(pattern) = self.joint("")?.torque.filter(|name| !name.contains("{joint}")) {
            let next = named(&pattern, own.len(), "");
            if titles.contains(&next) && next != named(&pattern, 0, "") {
                return Err(Problem::MoreJoints { title: next, joints: joints.join(", ") });
            }
        }
        let rows = self.all.rows.as_ref();
        let rows =
            rows.map(|rows| (found.column(Some(&rows.column), "rows", 0, ""), rows.is.clone()));
        let follows =
            self.all.follows.as_deref().map(|name| found.column(Some(name), "follows", 0, ""));
        found.problem()?;
        let (titles, held) = (titles.to_vec(), self.all.held);
        Ok(Columns { titles, time, joints: each, rows, follows, held })
    }
}

impl From<String> for Problem {
    fn from(reason: String) -> Self {
        Self::Map(reason)
    }
}

/// The layout with the most of these titles, if one has those of all joints.
pub(crate) fn recognised(
    titles: &[String],
    joints: &[String],
) -> std::result::Result<Columns, Problem> {
    let all: HashSet<&str> = titles.iter().map(String::as_str).collect();
    let maps: Table<String, Value> = toml_edit::de::from_str(LAYOUTS).expect("layouts");
    let maps = maps.into_iter().map(|(_, map)| Map::from(map).expect("a map"));
    let share = |map: &Map| -> usize {
        let of = map.joint("").expect("a layout");
        let names = [of.position, of.torque, map.all.follows.clone()].into_iter().flatten();
        let of_all = |(index, name): (usize, &String)| -> usize {
            names
                .clone()
                .filter(|pattern| all.contains(named(pattern, index, name).as_str()))
                .count()
        };
        joints.iter().enumerate().map(of_all).sum()
    };
    // The first of those with the most.
    let best = maps.map(|map| (share(&map), map)).rev().max_by_key(|(share, _)| *share);
    match best {
        Some((share, map)) if share > 0 => map.columns(titles, joints),
        _ => Err(Problem::Unknown { titles: listed(titles), joints: joints.join(", ") }),
    }
}

/// A pattern for a joint.
fn named(pattern: &str, index: usize, joint: &str) -> String {
    let number = (index + 1).to_string();
    pattern
        .replace("{index}", &index.to_string())
        .replace("{number}", &number)
        .replace("{joint}", joint)
}

fn listed(titles: &[String]) -> String {
    let more = if titles.len() > LISTED { ", …" } else { "" };
    let shown: Vec<String> =
        titles.iter().take(LISTED).map(|t| super::messages::shortened(t)).collect();
    shown.join(", ") + more
}

/// The titles that are looked for, and those that were not found.
struct Finder<'a> {
    titles: &'a [String],
    missing: Vec<String>,
    unstated: Vec<String>,
}

impl Finder<'_> {
    fn column(&mut self, pattern: Option<&str>, what: &str, index: usize, joint: &str) -> usize {
        let Some(pattern) = pattern else {
            self.state(format!("{what} = \"…\" (the title of a column; {{joint}}, {{index}} from 0 and {{number}} from 1 stand for a joint)"));
            return 0;
        };
        let name = named(pattern, index, joint);
        let mut places = self.titles.iter().enumerate().filter(|(_, title)| **title == name);
        match (places.next(), places.next()) {
            (Some((at, _)), None) => return at,
            (Some(_), Some(_)) => self.missing.push(format!("`{name}`, which is there twice")),
            _ => {
                let like = most_similar(&name, self.titles.iter().map(String::as_str));
                let like = like.map_or(String::new(), |like| format!(" (did you mean `{like}`?)"));
                self.missing.push(format!("`{name}`{like}"));
            }
        }
        0
    }

    fn unit(&mut self, unit: Option<&str>, key: &str, all: &[(&str, f64)]) -> f64 {
        let found = all.iter().find(|(name, _)| Some(*name) == unit);
        let names = || all.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
        match (found, unit) {
            (Some((_, unit)), _) => *unit,
            (None, unit) => {
                let not = unit.map_or(String::new(), |unit| format!("; not `{unit}`"));
                self.state(format!("{key} = \"{}\" (one of {}{not})", all[0].0, names()));
                1.0
            }
        }
    }

    fn number(&mut self, number: Option<f64>, key: &str) -> f64 {
        number.filter(|number| *number > 0.0).unwrap_or_else(|| {
            self.state(format!(
                "{key} = … (a positive number{})",
                match key {
                    "torque_constant" => ", N·m/A; `gear` and `sign` are beside it",
                    _ => "",
                }
            ));
            1.0
        })
    }

    fn state(&mut self, line: String) {
        if !self.unstated.contains(&line) {
            self.unstated.push(line);
        }
    }

    fn problem(self) -> std::result::Result<(), Problem> {
        if self.missing.is_empty() && self.unstated.is_empty() {
            return Ok(());
        }
        Err(Problem::Columns {
            missing: self.missing.join(", "),
            unstated: self.unstated,
            titles: listed(self.titles),
        })
    }
}
