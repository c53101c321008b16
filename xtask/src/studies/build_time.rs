//! The additional time of a release build for one specialised function of a robot.

use std::time::Instant;

use serde::Serialize;

use crate::kit::error::Result;
use crate::kit::progress::Spinner;
use crate::kit::setup::Tools;
use crate::kit::table::Table;
use crate::kit::workspace::Workspace;
use crate::kit::{docs, shell};
use crate::studies::study::{Bench, Found};

const BIN: &str = "build_time";
const NONE: &str = "none";
/// Builds of each, of which the fastest counts: the machine may have other work.
const BUILDS: usize = 2;
/// Robots that the bin knows, their joints, and how many seconds more were promised at most.
const ROBOTS: [(&str, usize, f64); 2] = [("panda", 7, 5.0), ("g1", 29, 60.0)];

/// A robot's line, as in the JSON.
#[derive(Debug, Serialize)]
struct Row {
    robot: &'static str,
    joints: usize,
    /// A build of the bin with one inverse dynamics by the engine, and of the same without, s.
    seconds: f64,
    without_seconds: f64,
    more_seconds: f64,
    at_most_seconds: f64,
}

pub fn measure(bench: &Bench<'_>) -> Result<Found> {
    let rows = timed(bench.workspace, bench.tools()?)?;
    let when = docs::today_and_commit(bench.workspace);
    Found::new(page(&rows, &when, &bench.rustc()?), &rows)
}

fn page(rows: &[Row], when: &str, rustc: &str) -> String {
    format!(
        include_str!("build_time.md"),
        builds = BUILDS,
        when = when,
        table = table(rows).markdown(),
        rustc = rustc
    )
}

fn timed(workspace: &Workspace, tools: &Tools) -> Result<Vec<Row>> {
    let spinner = Spinner::start("building the libraries");
    // The first build is not of this bin alone.
    build(workspace, tools, NONE)?;
    let mut fastest = [f64::INFINITY; 1 + ROBOTS.len()];
    for _ in 0..BUILDS {
        // In turns, so that each build finds that of another robot.
        let names = ROBOTS.iter().map(|(name, ..)| *name).chain([NONE]);
        for (name, fastest) in names.zip(&mut fastest) {
            spinner.say(format!("building for {name}"));
            let begin = Instant::now();
            build(workspace, tools, name)?;
            *fastest = fastest.min(begin.elapsed().as_secs_f64());
        }
    }
    let [with @ .., without_seconds] = fastest;
    let rows = ROBOTS.into_iter().zip(with);
    let row = |((robot, joints, at_most_seconds), seconds)| Row {
        robot,
        joints,
        seconds,
        without_seconds,
        more_seconds: seconds - without_seconds,
        at_most_seconds,
    };
    Ok(rows.map(row).collect())
}

fn build(workspace: &Workspace, tools: &Tools, robot: &str) -> Result<()> {
    let mut command = tools.toolchain.firmware(workspace, "build");
    command
        .args(["--release", "--features", "build-time", "--bin", BIN])
        .env("BUILD_TIME_ROBOT", robot);
    shell::capture(&mut command)?;
    Ok(())
}

fn table(rows: &[Row]) -> Table {
    let mut table = Table::new(&["robot", "joints", "with", "without", "more", "at most", ""]);
    for row in rows {
        let met = row.more_seconds <= row.at_most_seconds;
        let seconds = [row.seconds, row.without_seconds, row.more_seconds];
        let mut cells = vec![row.robot.to_owned(), row.joints.to_string()];
        cells.extend(seconds.map(|s| format!("{s:.1}")));
        cells.push(format!("{:.0}", row.at_most_seconds));
        cells.push(if met { "met" } else { "missed" }.to_owned());
        table.row(cells);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::{ROBOTS, Row, page, table};
    const PAGE: &str = "docs/build-time.md";

    use crate::kit::docs::repository::{root, rows_of};

    /// The rows of a page, whose difference is off by no more than rounding.
    fn read(page: &str) -> Vec<Row> {
        let rows = rows_of(page).into_iter().zip(ROBOTS);
        let row = |(cells, (robot, joints, at_most_seconds)): (Vec<&str>, _)| {
            let seconds = |cell: usize| cells[cell].parse::<f64>().expect("seconds");
            let [with, without, more] = [2, 3, 4].map(seconds);
            assert!((with - without - more).abs() < 0.11, "{robot}: {more}");
            Row {
                robot,
                joints,
                seconds: with,
                without_seconds: without,
                more_seconds: more,
                at_most_seconds,
            }
        };
        rows.map(row).collect()
    }

    #[test]
    fn the_page_has_todays_robots_and_bars_with_their_verdicts() {
        let page = std::fs::read_to_string(root().join(PAGE)).expect("a page");
        let rows = read(&page);
        assert_eq!(rows.len(), ROBOTS.len());
        assert!(
            page.contains(&table(&rows).markdown()),
            "{PAGE} is out of date"
        );
        for more in [5.01, f64::NAN] {
            let mut missed = read(&page);
            missed[0].more_seconds = more;
            assert!(table(&missed).text().contains("missed"));
        }
    }

    #[test]
    fn a_page_says_when_and_of_what_it_was_measured() {
        let page = page(&[], "2026-01-02 at commit 0123abc", "rustc 1");
        assert!(page.contains("on 2026-01-02 at commit 0123abc; ") && page.contains("rustc 1."));
    }
}
