//! The rows in print.

use super::record::{Record, Recorded};
use crate::kit::meter::{CHIPS, IN_FLASH, MODEL};
use crate::kit::rows::Row;
use crate::kit::table::{Table, thousands};

/// The part of the page between its markers: a table for each robot.
pub fn markdown(record: &Record) -> String {
    let robots = record.rows.chunk_by(|a, b| a.robot == b.robot);
    let robots = robots.map(|rows| format!("## {}\n\n{}\n", rows[0].robot, table(rows).markdown()));
    let (robots, rustc) = (robots.collect::<String>(), &record.rustc);
    format!("{MODEL}. {IN_FLASH}.\n\n{robots}Measured with {rustc}.")
}

/// The rows of one robot, for a terminal.
pub fn of_robot(rows: &[Row]) -> String {
    let name = rows.first().map_or("", |row| &row.robot);
    let rows: Vec<Recorded> = rows.iter().map(Recorded::of).collect();
    let table = table(&rows).markdown();
    format!("{name}; {MODEL}. {IN_FLASH}.\n\n{table}")
}

/// A row with sines and cosines inside, and beside it the cycles of the one without, if there is
/// one.
fn table(rows: &[Recorded]) -> Table {
    let called = |row: &Recorded| format!("{} {} {}", row.algorithm, row.form, row.inputs);
    let with = |of: &Recorded, trig| {
        rows.iter().find(move |row| row.trig == trig && called(row) == called(of))
    };
    let is_shown = |row: &&Recorded| row.trig || with(row, true).is_none();
    let shown: Vec<&Recorded> = rows.iter().filter(is_shown).collect();
    let cycles =
        |of: &Recorded, trig| with(of, trig).map_or("–".into(), |row| thousands(row.cycles));
    Table::of(
        &shown,
        &[
            ("algorithm, form, inputs", &|row| called(row)),
            ("cycles", &|row| cycles(row, true)),
            ("sin/cos given", &|row| cycles(row, false)),
            (CHIPS[0], &|row| thousands(row.in_flash[0])),
            ("code, B", &|row| thousands(row.code_bytes)),
            ("stack, B", &|row| thousands(row.stack_bytes)),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::of_robot;
    use crate::kit::docs::cells;
    use crate::kit::rows::Row;

    #[test]
    fn a_row_has_the_cycles_with_and_without_sines() {
        let row =
            |name, cycles, trig| Row { trig, ..Row::sample(["arm", name, "core", "full"], cycles) };
        let rows = [row("rnea", 1500, true), row("rnea", 1200, false), row("solve", 9, false)];
        let text = of_robot(&rows);
        let found: Vec<_> =
            text.lines().filter_map(cells).skip(2).map(|row| row[..3].join(" ")).collect();
        assert_eq!(found, ["rnea core full 1,500 1,200", "solve core full – 9"]);
    }
}
