//! The ticks of a CSV that `cargo xtask watch` has recorded. Nothing in the file is believed.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use csv::{ErrorKind, ReaderBuilder, StringRecord};

use crate::TickRecording;

use super::MOST_JOINTS;
use super::error::{Error, Problem, Result};

/// The longest line that is read in any case, bytes; one of twice as many is refused.
const LONGEST: usize = 16 * 1024;
/// The most ticks: an hour at 1 kHz.
const MOST_TICKS: usize = 3_600_000;
/// The largest number that a position or a torque of an arm may be.
const LARGEST: f64 = 1e6;
/// By how much of a tick a time may be off: it has six digits after the point.
const OFF: f64 = 0.01;

/// The ticks of a file in which the controller made the torque.
#[derive(Clone, Debug, PartialEq)]
pub struct Recorded {
    /// The number of joints.
    pub joints: usize,
    /// The length of a tick, s.
    pub tick: f64,
    /// Positions and torques of consecutive ticks, joint by joint.
    pub stretches: Vec<Vec<Row>>,
    /// Ticks that were left out: on hold, stopped, or before the machine had said how long a tick
    /// is.
    pub left_out: usize,
    /// Gaps between ticks: dropped ones and restarts of the trajectory.
    pub gaps: usize,
}

/// Estimated positions and commanded torques of a tick.
pub type Row = (Vec<f64>, Vec<f64>);

/// The places of the columns.
struct Columns {
    names: Vec<String>,
    number: usize,
    tick: usize,
    mode: usize,
    time: usize,
    estimates: Vec<usize>,
    torques: Vec<usize>,
}

/// A tick of the file.
struct Line {
    number: u32,
    tick: u32,
    full: bool,
    time: Option<f64>,
    row: Row,
}

impl Recorded {
    /// Reads a file.
    ///
    /// # Errors
    /// [`Error`] names the line and the column.
    pub fn read(path: &Path) -> Result<Self> {
        let read = |source| Error::Read { path: path.to_owned(), source };
        Self::from(path, File::open(path).map_err(read)?)
    }

    /// Reads a text that is called `path`.
    ///
    /// # Errors
    /// As [`Recorded::read`].
    pub fn from(path: &Path, text: impl Read) -> Result<Self> {
        let whole = |problem| Error::Recording { path: path.to_owned(), problem };
        let mut rows =
            ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text.take(0));
        let mut line = 0;
        let mut next = || {
            line += 1;
            rows.get_mut().set_limit(2 * LONGEST as u64);
            let mut fields = StringRecord::new();
            let read = rows.read_record(&mut fields);
            let problem = match read.map_err(csv::Error::into_kind) {
                _ if rows.get_ref().limit() == 0 => Problem::LongLine(LONGEST),
                Ok(is_row) => return Ok(is_row.then_some(fields)),
                Err(ErrorKind::Io(source)) => {
                    let path = path.to_owned();
                    return Err(Error::Read { path, source });
                }
                Err(_) => Problem::NoText,
            };
            let path = path.to_owned();
            Err(Error::Line { path, line, problem })
        };
        let titles = next()?.ok_or_else(|| whole(Problem::Empty))?;
        let columns = Columns::of(&titles).map_err(whole)?;
        let mut found = Self {
            joints: columns.estimates.len(),
            tick: 0.0,
            stretches: Vec::new(),
            left_out: 0,
            gaps: 0,
        };
        let (mut before, mut timed): (Option<Line>, Option<(u32, f64)>) = (None, None);
        let (mut ticks, mut number) = (0, 1);
        while let Some(fields) = next()? {
            number += 1;
            let wrong = |problem| Error::Line { path: path.to_owned(), line: number, problem };
            let line = columns.line(&fields).map_err(wrong)?;
            ticks += 1;
            if ticks > MOST_TICKS {
                return Err(wrong(Problem::TooLong(MOST_TICKS)));
            }
            if let Some(before) = before.as_ref().filter(|last| last.number >= line.number) {
                let (number, before) = (line.number, before.number);
                return Err(wrong(Problem::Order { number, before }));
            }
            if let Some(time) = line.time {
                found.time(line.number, time, &mut timed).map_err(wrong)?;
            }
            found.take(&line, before.as_ref());
            before = Some(line);
        }
        if found.tick <= 0.0 {
            return Err(whole(Problem::NoTick));
        }
        match found.stretches.is_empty() {
            true => Err(whole(Problem::NoTicks)),
            false => Ok(found),
        }
    }

    /// The length of a tick by the first two times, and that the others agree with it.
    fn time(
        &mut self,
        number: u32,
        time: f64,
        timed: &mut Option<(u32, f64)>,
    ) -> std::result::Result<(), Problem> {
        let (first, start) = *timed.get_or_insert((number, time));
        let ticks = f64::from(number - first);
        if number > first && self.tick == 0.0 {
            self.tick = (time - start) / ticks;
        }
        let tick = self.tick;
        let expected = start + ticks * tick;
        let is_off = (time - expected).abs() > OFF * tick.max(1e-4) * (1.0 + 1e-3 * ticks);
        if is_off || (number > first && tick <= 0.0) {
            return Err(Problem::Time { found: time, expected, tick });
        }
        Ok(())
    }

    fn take(&mut self, line: &Line, before: Option<&Line>) {
        if !line.full || line.time.is_none() {
            self.left_out += 1;
            return;
        }
        // When the trajectory begins again, a simulated arm is put back.
        let follows = before.is_some_and(|before| {
            let taken = before.full && before.time.is_some();
            taken && line.number == before.number + 1 && line.tick == before.tick.wrapping_add(1)
        });
        if !follows {
            self.gaps += usize::from(!self.stretches.is_empty());
            self.stretches.push(Vec::new());
        }
        if let Some(stretch) = self.stretches.last_mut() {
            stretch.push(line.row.clone());
        }
    }

    /// As a recording of V joints.
    ///
    /// # Errors
    /// [`Error::Identification`].
    pub fn ticks<const V: usize>(&self, path: &Path) -> Result<TickRecording<V>> {
        let array = |values: &[f64]| std::array::from_fn(|j| values[j]);
        let each = self.stretches.iter().map(|rows| {
            let pairs = rows.iter().map(|(q, tau)| (array(q), array(tau)));
            pairs.unzip()
        });
        TickRecording::try_new(each.collect(), self.tick)
            .map_err(|source| Error::Identification { path: path.to_owned(), source })
    }
}

impl Columns {
    fn of(titles: &StringRecord) -> std::result::Result<Self, Problem> {
        let names: Vec<String> = titles.iter().map(str::to_owned).collect();
        let find = |name: &str| -> std::result::Result<usize, Problem> {
            let mut places = (0..names.len()).filter(|&at| names[at] == name);
            match (places.next(), places.next()) {
                (Some(at), None) => Ok(at),
                (Some(_), Some(_)) => Err(Problem::Twice(name.to_owned())),
                _ => Err(Problem::NoColumn(name.to_owned())),
            }
        };
        let joints = names.iter().filter(|name| name.starts_with("torque_")).count();
        if joints > MOST_JOINTS {
            return Err(Problem::TooManyJoints(joints));
        }
        let all = |what: &str| {
            let each = (0..joints.max(1)).map(|joint| find(&format!("{what}_{joint}")));
            each.collect::<std::result::Result<Vec<_>, _>>()
        };
        Ok(Self {
            number: find("number")?,
            tick: find("tick")?,
            mode: find("mode")?,
            time: find("time_s")?,
            estimates: all("estimate")?,
            torques: all("torque")?,
            names,
        })
    }

    fn line(&self, fields: &StringRecord) -> std::result::Result<Line, Problem> {
        let (found, expected) = (fields.len(), self.names.len());
        if found != expected {
            return Err(Problem::Columns { found, expected });
        }
        let wrong = |at: usize, expected| Problem::Value {
            column: self.names[at].clone(),
            text: shortened(&fields[at]),
            expected,
        };
        let whole = |at: usize| {
            let number = fields[at].parse::<u32>();
            number.map_err(|_| wrong(at, "a whole number"))
        };
        let real = |at: usize| {
            let number = fields[at].parse::<f64>().ok();
            let number = number.filter(|x| x.abs() <= LARGEST);
            number.ok_or_else(|| wrong(at, "a number that is finite and below 10⁶"))
        };
        let reals = |places: &[usize]| -> std::result::Result<Vec<f64>, Problem> {
            places.iter().map(|&at| real(at)).collect()
        };
        let full = match &fields[self.mode] {
            "full" => true,
            "hold" | "stopped" => false,
            _ => return Err(wrong(self.mode, "`full`, `hold` or `stopped`")),
        };
        let time = match &fields[self.time] {
            "" => None,
            _ => Some(real(self.time)?),
        };
        Ok(Line {
            number: whole(self.number)?,
            tick: whole(self.tick)?,
            full,
            time,
            row: (reals(&self.estimates)?, reals(&self.torques)?),
        })
    }
}

/// A field for a message.
fn shortened(field: &str) -> String {
    robot_import::text::visible(&field.chars().take(40).collect::<String>())
}
