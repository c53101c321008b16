//! What the page says between its markers.

use super::{Cycles, Image, List};
use crate::kit::table::{Table, thousands};

/// The tables, from the cycles of each routine of each image.
pub fn text(list: &List, cycles: &[Vec<Cycles>]) -> String {
    let mut routines = Table::new(&[
        "routine",
        "image",
        "it executes",
        "published",
        "least",
        "chosen",
        "most",
        "least, %",
        "chosen, %",
        "most, %",
    ]);
    let mut sources = Table::new(&["image", "source", "commit", "licence", "board"]);
    let (mut whole, mut sequences) = (Vec::new(), Vec::new());
    for (image, cycles) in list.image.iter().zip(cycles) {
        sources.row(image.source());
        for (routine, cycles) in image.routine.iter().zip(cycles) {
            let off = cycles.map(|cycles| 100.0 * (cycles / routine.published - 1.0));
            match image.sequences {
                true => sequences.push(off),
                false => whole.push(off),
            }
            let shown = |cycles: f64| match routine.published.fract() == 0.0 {
                true => thousands(cycles.round() as u64),
                false => format!("{cycles:.1}"),
            };
            let mut cells = [&routine.name, &image.quoted(), &routine.kind]
                .map(Clone::clone)
                .to_vec();
            cells.push(shown(routine.published));
            cells.extend(cycles.map(shown));
            cells.extend(off.map(|off| format!("{off:+.1}")));
            routines.row(cells);
        }
    }
    let (all, whole) = ([&*whole, &*sequences].concat(), whole);
    let columns = ["largest, %", "RMS, %", "mean, %"];
    let heads = [("routines", whole.len()), ("with sequences", all.len())];
    let heads = heads.map(|(of, number)| columns.map(|column| format!("{number} {of}: {column}")));
    let heads = heads.iter().flatten().map(String::as_str);
    let mut summary = Table::new(&[&["reading"], &*heads.collect::<Vec<_>>()].concat());
    for (index, reading) in ["least", "chosen", "most"].into_iter().enumerate() {
        let figures = [&whole, &all].map(|rows| figures(rows.iter().map(|off| off[index])));
        let figures = figures.concat().into_iter();
        summary.row([reading.to_owned()].into_iter().chain(figures));
    }
    [summary, routines, sources]
        .map(|table| table.markdown())
        .join("\n")
}

/// The largest deviation, the RMS and the mean.
fn figures(off: impl Iterator<Item = f64> + Clone) -> Vec<String> {
    let number = off.clone().count() as f64;
    let largest = off
        .clone()
        .fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
    let rms = (off.clone().map(|x| x * x).sum::<f64>() / number).sqrt();
    let mean = off.sum::<f64>() / number;
    vec![
        format!("{largest:+.1}"),
        format!("{rms:.1}"),
        format!("{mean:+.1}"),
    ]
}

impl Image {
    fn quoted(&self) -> String {
        format!("`{}`", self.name)
    }

    /// The row of its source.
    fn source(&self) -> [String; 5] {
        let link = format!("[{0}](https://github.com/{0})", self.repository);
        let commit = format!("`{}`", self.commit);
        [
            self.quoted(),
            link,
            commit,
            self.licence.clone(),
            self.board.clone(),
        ]
    }
}
