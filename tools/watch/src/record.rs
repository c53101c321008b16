//! Ticks as CSV or MCAP.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use machine_link::PHASES;
use mcap::records::MessageHeader;
use serde::Serialize;

use crate::Tick;
use crate::error::{Error, Result};
use crate::view::mode;

/// A file that ticks are written to.
pub struct Recorder {
    path: PathBuf,
    form: Form,
    /// The period of a tick, µs, once it is known.
    period: Option<u32>,
}

enum Form {
    /// Whether the titles are written.
    Csv(Box<csv::Writer<File>>, bool),
    Mcap(Box<mcap::Writer<BufWriter<File>>>, u16),
}

/// A tick as a message of MCAP, in JSON.
#[derive(Serialize)]
struct Json<'a> {
    number: u32,
    tick: u32,
    mode: &'a str,
    fault: Option<String>,
    limited: bool,
    dropped: u32,
    joints: &'a [machine_link::Joint],
    cost: BTreeMap<&'a str, u32>,
}

/// The path of a record, if its ending names a form.
///
/// # Errors
/// [`Error::Ending`].
pub fn named(text: &str) -> Result<PathBuf> {
    let path = PathBuf::from(text);
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("csv" | "mcap") => Ok(path),
        _ => Err(Error::Ending { path }),
    }
}

impl Recorder {
    /// Creates the file; its ending names its form.
    ///
    /// # Errors
    /// It cannot be created, or its ending is neither `.csv` nor `.mcap`.
    pub fn create(path: &Path) -> Result<Self> {
        let ending = path.extension().and_then(|ending| ending.to_str());
        let open =
            || File::create(path).map_err(|source| Error::Record { path: path.to_owned(), source });
        let form = match ending {
            Some("csv") => Form::Csv(Box::new(csv::Writer::from_writer(open()?)), false),
            Some("mcap") => {
                let failed = |source| mcap_error(path, source);
                let mut writer = mcap::Writer::new(BufWriter::new(open()?)).map_err(failed)?;
                let schema = writer.add_schema("tick", "jsonschema", SCHEMA).map_err(failed)?;
                let channel = writer.add_channel(schema, "tick", "json", &BTreeMap::new());
                Form::Mcap(Box::new(writer), channel.map_err(failed)?)
            }
            _ => {
                return Err(Error::Ending { path: path.to_owned() });
            }
        };
        Ok(Self { path: path.to_owned(), form, period: None })
    }

    /// Sets the period of a tick, µs, for the times in the file.
    pub fn period(&mut self, period: u32) {
        self.period = Some(period);
    }

    /// Writes a tick.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&mut self, tick: &Tick) -> Result<()> {
        match &mut self.form {
            Form::Csv(file, titled) => {
                let failed = |error: csv::Error| Error::Record {
                    path: self.path.clone(),
                    source: error.into(),
                };
                if !std::mem::replace(titled, true) {
                    file.write_record(titles(tick.joints.len())).map_err(failed)?;
                }
                file.write_record(fields(tick, self.period)).map_err(failed)
            }
            Form::Mcap(writer, channel) => {
                let time = u64::from(tick.number) * u64::from(self.period.unwrap_or(1000)) * 1000;
                let header = MessageHeader {
                    channel_id: *channel,
                    sequence: tick.number,
                    log_time: time,
                    publish_time: time,
                };
                let json = serde_json::to_vec(&json(tick)).map_err(|error| Error::Record {
                    path: self.path.clone(),
                    source: error.into(),
                })?;
                let written = writer.write_to_known_channel(&header, &json);
                written.map_err(|source| mcap_error(&self.path, source))
            }
        }
    }

    /// Ends the file.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn finish(self) -> Result<()> {
        match self.form {
            Form::Csv(mut file, _) => {
                file.flush().map_err(|source| Error::Record { path: self.path, source })
            }
            Form::Mcap(mut writer, _) => {
                let summary = writer.finish();
                summary.map(|_| ()).map_err(|source| mcap_error(&self.path, source))
            }
        }
    }
}

fn mcap_error(path: &Path, source: mcap::McapError) -> Error {
    let path = path.to_owned();
    Error::Mcap { path, source }
}

fn json(tick: &Tick) -> Json<'_> {
    Json {
        number: tick.number,
        tick: tick.tick,
        mode: mode(tick.status.mode),
        fault: tick.status.fault.map(|fault| fault.to_string()),
        limited: tick.status.limited,
        dropped: tick.dropped,
        joints: &tick.joints,
        cost: PHASES.into_iter().zip(tick.cost).collect(),
    }
}

fn titles(joints: usize) -> Vec<String> {
    let first = "number,tick,mode,fault,limited,dropped,time_s".split(',');
    let of_joint = |j| ["reference", "estimate", "torque"].map(|what| format!("{what}_{j}"));
    let costs = PHASES.map(|phase| format!("{phase}_counts"));
    let titles = first.map(str::to_owned).chain((0..joints).flat_map(of_joint));
    titles.chain(costs).collect()
}

/// The time is that of the tick's number; it is empty until the machine has said how long a tick
/// is.
fn fields(tick: &Tick, period: Option<u32>) -> Vec<String> {
    let status = tick.status;
    let seconds = |period: u32| 1e-6 * f64::from(period) * f64::from(tick.number);
    let first = [
        tick.number.to_string(),
        tick.tick.to_string(),
        mode(status.mode).to_owned(),
        status.fault.map_or(String::new(), |fault| fault.to_string()),
        status.limited.to_string(),
        tick.dropped.to_string(),
        period.map_or(String::new(), |period| format!("{:.6}", seconds(period))),
    ];
    let joints = tick.joints.iter();
    let joints = joints.flat_map(|j| [j.reference, j.estimate, j.torque].map(|x| x.to_string()));
    let costs = tick.cost.map(|cost| cost.to_string());
    first.into_iter().chain(joints).chain(costs).collect()
}

/// The schema by which viewers of MCAP plot.
const SCHEMA: &[u8] = br#"{
  "type": "object",
  "properties": {
    "number": {"type": "integer"}, "tick": {"type": "integer"}, "mode": {"type": "string"},
    "fault": {"type": ["string", "null"]}, "limited": {"type": "boolean"}, "dropped": {"type": "integer"},
    "joints": {"type": "array", "items": {"type": "object", "properties": {
      "reference": {"type": "number"}, "estimate": {"type": "number"}, "torque": {"type": "number"}}}},
    "cost": {"type": "object", "properties": {
      "read": {"type": "integer"}, "reference": {"type": "integer"}, "dynamics": {"type": "integer"},
      "safety": {"type": "integer"}, "write": {"type": "integer"}}}
  }
}"#;
