//! docs/peers.md, which no step measures anew, against itself, `budgets.toml` and what a decision
//! says of it.

use super::bars::compared;
use super::report::{HOST, M4F, Report, Row};
use super::{ALGORITHMS, PRECISIONS};
use crate::kit::bars::{self, Bars, Compared};
use crate::kit::docs::repository::{read, rows_of};

/// The rounding error of a ratio of figures that are printed with at least three digits.
const ROUNDING: f64 = 0.005;

const PAGE: &str = "docs/peers.md";

/// The ratios that `budgets.toml` promises of peers.
fn promised() -> Bars {
    let budgets: serde_json::Value = toml_edit::de::from_str(&read("budgets.toml")).expect("TOML");
    let mut ratios: Bars = serde_json::from_value(budgets["ratios"].clone()).expect("ratios");
    ratios.retain(|key, _| key.contains(", m4f, ") || key.contains(", host "));
    ratios
}

/// The part of a page under a heading.
fn under<'a>(page: &'a str, heading: &str) -> &'a str {
    let (_, after) = page
        .split_once(&format!("\n## {heading}\n"))
        .unwrap_or_else(|| panic!("there is no {heading:?}"));
    after.split_once("\n## ").map_or(after, |(part, _)| part)
}

fn number<T: std::str::FromStr>(cell: &str) -> Option<T> {
    cell.replace(',', "").parse().ok()
}

/// The measurements that the page shows, robot by robot.
fn measured(page: &str) -> Vec<Row> {
    let mut rows = Vec::new();
    for algorithm in ALGORITHMS {
        let row = |target, cells: &[&str]| {
            let (robot, peer) = cells[0].split_once(", ").expect("robot and code");
            Row {
                target,
                robot: robot.into(),
                algorithm: algorithm.into(),
                peer: peer.into(),
                precision: "f32".into(),
                ..Row::default()
            }
        };
        for cells in rows_of(under(page, &format!("Cortex-M4F: {algorithm}"))) {
            rows.push(Row {
                instructions: number(cells[1]),
                cycles: number(cells[2]),
                code_bytes: number(cells[3]),
                ..row(M4F, &cells)
            });
        }
        for cells in rows_of(under(page, &format!("Host: {algorithm}"))) {
            // Columns of f64 and f32: times, ratios of the engine, ratios of the core.
            for (at, precision) in [2, 1].into_iter().zip(PRECISIONS) {
                rows.push(Row {
                    precision: precision.into(),
                    ns: number(cells[at]),
                    ratios: [number(cells[at + 2]), number(cells[at + 4])],
                    ..row(HOST, &cells)
                });
            }
        }
    }
    let mut robots: Vec<String> = Vec::new();
    // All of them are measured on the host.
    for row in rows.iter().filter(|row| row.target == HOST) {
        if !robots.contains(&row.robot) {
            robots.push(row.robot.clone());
        }
    }
    rows.sort_by_key(|row| robots.iter().position(|robot| *robot == row.robot));
    rows
}

/// Holds a page against its own figures and what is promised.
fn check(page: &str, promised: &Bars) -> Result<(), String> {
    let rows = measured(page);
    let mut of_rows = compared(promised, &rows);
    let bars = rows_of(under(page, "Against the bars"));
    if bars.len() != of_rows.len() {
        return Err(format!("{} bars of {}", bars.len(), of_rows.len()));
    }
    for (compared, cells) in of_rows.iter_mut().zip(&bars) {
        let now: f64 = number(cells[2].trim_end_matches('×')).ok_or("no figure")?;
        let off = (now / compared.measured - 1.0).abs();
        // NaN is off as well.
        if off.is_nan() || off > ROUNDING {
            return Err(format!(
                "{}: {now}, by the tables {:.4}",
                compared.what, compared.measured
            ));
        }
        compared.measured = now;
    }
    if let Some(wrong) = of_rows.iter().find_map(Compared::complaint) {
        return Err(wrong);
    }
    let table = bars::table(&of_rows).markdown();
    if !under(page, "Against the bars").contains(&table) {
        return Err(format!("the bars are not\n{table}"));
    }
    let report = Report {
        rows,
        builds: Vec::new(),
        compared: of_rows,
        versions: Vec::new(),
        date: String::new(),
    };
    let text = report.markdown();
    for algorithm in ALGORITHMS {
        for target in ["Cortex-M4F", "Host"] {
            let heading = format!("{target}: {algorithm}");
            if under(page, &heading) != under(&text, &heading) {
                return Err(format!("{heading} is not as its figures make it"));
            }
        }
    }
    Ok(())
}

#[test]
fn the_page_agrees_with_itself_and_with_what_is_promised() {
    let (page, promised) = (read(PAGE), promised());
    check(&page, &promised).expect("docs/peers.md: `cargo xtask peers` rewrites it");
    let figures: usize = promised.values().map(|bar| bar.most.len()).sum();
    assert_eq!(
        compared(&promised, &measured(&page)).len(),
        figures,
        "a bar has no figures"
    );
}

#[test]
fn a_page_that_disagrees_is_refused() {
    let (page, promised) = (read(PAGE), promised());
    let line = |begin: &str| {
        page.lines()
            .find(|line| line.starts_with(begin))
            .expect("a row")
    };
    let bar = line("| ur5e rnea, m4f, engine / casadi: cycles");
    let now = bar.split('|').nth(3).expect("a figure");
    // Cycles of the engine, in the table that the ratio is taken from.
    let row = line("| ur5e, engine ");
    let cycles = row.split('|').nth(3).expect("cycles").trim();
    for other in [
        page.replace(bar, &bar.replace(now, &now.replace("0.", "0.1"))),
        page.replace(&format!("{bar}\n"), ""),
        page.replace(bar, &bar.replace("met", "missed")),
        page.replacen(row, &row.replace(cycles, "999"), 1),
    ] {
        assert!(other != page && check(&other, &promised).is_err());
    }
    // Another promise than that of the page.
    let mut stricter = promised;
    let bars = stricter.values_mut().flat_map(|ratio| &mut ratio.most);
    bars.for_each(|(_, most)| *most *= 0.9);
    assert!(check(&page, &stricter).is_err());
}

/// The figures of a row of the decision's table by robot, and in how many digits; none without the
/// row.
fn decided(name: &str) -> Vec<(String, f64, usize)> {
    let text = read("docs/decisions/0002-bars.md");
    let rows = rows_of(&text);
    let row = rows.iter().find(|cells| cells[0] == name);
    let figures = row.map(|row| row[2].split([';', ',']).map(str::trim));
    let read = |text: &str| {
        let (robot, figure) = text.rsplit_once(' ').expect("robot and figure");
        let robot = robot.replace(' ', "").to_lowercase();
        let digits = figure.split_once('.').map_or(0, |(_, after)| after.len());
        (robot, figure.parse().expect("a figure"), digits)
    };
    figures.into_iter().flatten().map(read).collect()
}

#[test]
fn the_decision_on_missed_bars_quotes_the_page() {
    let page = read(PAGE);
    let bars = rows_of(under(&page, "Against the bars"));
    let missed = |of: &str| -> usize {
        let all = bars.iter().filter(|cells| cells[0].ends_with(of));
        all.filter(|cells| cells[3].starts_with("missed")).count()
    };
    for (row, of) in [
        (
            "engine against Pinocchio on the host, f64",
            "rnea, host f64, engine / pinocchio: ns",
        ),
        ("the same in f32", "rnea, host f32, engine / pinocchio: ns"),
    ] {
        let quoted = decided(row);
        assert_eq!(quoted.len(), missed(of), "{row}");
        for (robot, figure, digits) in quoted {
            let what = format!("{robot} {of}");
            let cells = bars.iter().find(|cells| cells[0] == what);
            let now: f64 =
                number(cells.expect("a bar")[2].trim_end_matches('×')).expect("a figure");
            let close = (now - figure).abs() <= 0.51 * 0.1_f64.powi(digits as i32);
            assert!(
                close,
                "{row}, {robot}: {figure} in the decision, {now} on the page"
            );
        }
    }
}
