//! A record of a CSV or an MCAP by a map of its columns. Nothing in the file is believed.

use std::fs::File;
use std::io::{Cursor, Read};
use std::path::Path;

use super::error::{Error, Problem, Result};
use super::map::{Columns, Map, recognised};
use super::recorded::{LARGEST, LATEST, Recorded, Rows};
use super::{messages, table};

/// The most ticks: an hour at 1 kHz.
const MOST_TICKS: usize = 3_600_000;

impl Recorded {
    /// Reads a file of a robot with these joints; by its titles, if there is no map.
    ///
    /// # Errors
    /// [`Error`] names the line and the column, and all columns that are missing.
    pub fn read(path: &Path, joints: &[String], map: Option<&Map>) -> Result<Self> {
        let read = |source| Error::Read { path: path.to_owned(), source };
        Self::from(path, File::open(path).map_err(read)?, joints, map)
    }

    /// Reads a text that is called `path`.
    ///
    /// # Errors
    /// As [`Recorded::read`].
    pub fn from(
        path: &Path,
        mut text: impl Read,
        joints: &[String],
        map: Option<&Map>,
    ) -> Result<Self> {
        let failed = |source| Error::Read { path: path.to_owned(), source };
        let whole = |problem| Error::Recording { path: path.to_owned(), problem };
        let of = |titles: &[String]| match map {
            Some(map) => map.columns(titles, joints),
            None => recognised(titles, joints),
        };
        let mut start = Vec::new();
        text.by_ref().take(mcap::MAGIC.len() as u64).read_to_end(&mut start).map_err(failed)?;
        let is_mcap = start == mcap::MAGIC;
        let mut text = Cursor::new(start).chain(text);
        let (mut columns, mut rows): (Option<Columns>, _) = (None, Rows::default());
        if is_mcap {
            let mut bytes = Vec::new();
            text.take(messages::LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(failed)?;
            if bytes.len() as u64 > messages::LARGEST_FILE {
                return Err(whole(Problem::Mcap("the file has more than 1 GiB".to_owned())));
            }
            let topic = map.and_then(Map::topic);
            let read = messages::read(&bytes, topic, |message| {
                let found = match &mut columns {
                    Some(found) => found,
                    none => {
                        let titles: Vec<_> =
                            message.iter().map(|(title, _)| title.clone()).collect();
                        none.insert(of(&titles)?)
                    }
                };
                let field = |at: usize| {
                    let title = &found.titles[at];
                    let own = message.get(at).filter(|(own, _)| own == title);
                    let own = own.or_else(|| message.iter().find(|(own, _)| own == title));
                    own.map_or("", |(_, text)| text)
                };
                rows.add(found, field)
            });
            read.map_err(whole)?;
        } else {
            table::read(path, &mut text, |titles, fields| match (fields, &columns) {
                (Some(fields), Some(columns)) => rows.add(columns, |at| &fields[at]),
                _ => of(titles).map(|found| columns = Some(found)),
            })?;
        }
        let columns = columns.ok_or_else(|| whole(Problem::NoTick))?;
        rows.even(joints.len(), &columns).map_err(whole)
    }
}

impl Rows {
    /// Takes a row; one that lacks a number ends a stretch.
    fn add<'a>(
        &mut self,
        columns: &Columns,
        field: impl Fn(usize) -> &'a str,
    ) -> std::result::Result<(), Problem> {
        if self.times.len() + self.left_out >= MOST_TICKS {
            return Err(Problem::TooLong(MOST_TICKS));
        }
        let wrong = |at: usize, expected| Problem::Value {
            column: columns.titles[at].clone(),
            text: messages::shortened(field(at)),
            expected,
        };
        let real = |at: usize, largest: f64| match field(at) {
            "" | "nan" | "NaN" => Ok(None),
            text => match text.parse::<f64>().ok().filter(|x| x.abs() <= largest) {
                Some(number) => Ok(Some(number)),
                None => {
                    Err(wrong(at, "a number with a decimal point that is finite and below 10⁶"))
                }
            },
        };
        let time = real(columns.time.0, LATEST / columns.time.1)?;
        let mut row = (Vec::new(), Vec::new());
        for of in &columns.joints {
            let [q, tau] = [real(of.position, LARGEST)?, real(of.torque, LARGEST)?];
            row.0.extend(q.map(|q| of.angle * (q - of.zero)));
            row.1.extend(tau.map(|tau| of.unit * tau));
        }
        let counts = columns.rows.as_ref().is_none_or(|(at, is)| field(*at) == is);
        let is_whole = [&row.0, &row.1].iter().all(|all| all.len() == columns.joints.len());
        if let Some(at) = columns.follows {
            let count = field(at).parse::<i64>().map_err(|_| wrong(at, "a whole number"))?;
            if self.count.replace(count).is_some_and(|last| last.checked_add(1) != Some(count)) {
                self.breaks.push(self.times.len());
            }
        }
        match time.filter(|_| counts && is_whole) {
            Some(time) => {
                self.times.push(time * columns.time.1);
                self.rows.push(row);
            }
            None => {
                self.left_out += 1;
                // If single rows lack a number, such as one that another topic has, the rows
                // about them are a stretch all the same.
                if !counts {
                    self.breaks.push(self.times.len());
                }
            }
        }
        Ok(())
    }

    fn even(self, joints: usize, columns: &Columns) -> std::result::Result<Recorded, Problem> {
        match &columns.rows {
            Some((at, is)) if self.rows.is_empty() && self.left_out > 0 => {
                Err(Problem::NoRows { column: columns.titles[*at].clone(), is: is.clone() })
            }
            _ => self.made(joints, columns.held),
        }
    }
}
