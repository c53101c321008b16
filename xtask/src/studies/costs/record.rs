//! The page as the record of what each row costs: its tables are compared with what was measured.

use std::collections::BTreeMap;

use super::{COMMAND, PAGE, Report};
use crate::kit::bars::OTHER_RUSTC;
use crate::kit::docs::{self, cells, rustc_of};
use crate::kit::error::{Result, refuse_if};

/// The figures of a row, in the order of the table's columns.
const FIGURES: [&str; 13] = [
    "insn min",
    "insn median",
    "insn max",
    "cycles min",
    "cycles median",
    "cycles max",
    "G474",
    "F405",
    "µs",
    "flops",
    "of floor",
    "code",
    "stack",
];

/// Those of which another compiler's may be larger by its share, and not more.
const BOUNDED: [&str; 4] = ["insn max", "cycles max", "code", "stack"];

/// Fails unless the rows of the page are those of a report and every bar holds; else says how many
/// rows there are. The report has the rows of all robots, and then the rest of the page is compared
/// too, or those of one robot.
pub fn hold(page: &str, report: &Report, all: bool) -> Result<String> {
    let (rustc, fresh) = (&report.rustc, report.markdown());
    let first = report.rows.first().filter(|_| !all);
    let rows = differences(page, &fresh, first.map(|row| &*row.robot), rustc);
    let mut wrong = Vec::new();
    if !rows.is_empty() {
        wrong.push(format!("{PAGE} is out of date: `{COMMAND}` rewrites it"));
        wrong.extend(rows.iter().map(|row| format!("  {row}")));
    } else if all {
        let rest = docs::compare(PAGE, COMMAND, page, &fresh, rustc);
        wrong.extend(rest.err().map(|why| why.to_string()));
    }
    // A page out of date is no reason to hide what misses its bar.
    wrong.extend(report.missed().iter().map(|bar| format!("bar: {bar}")));
    refuse_if!(!wrong.is_empty(), "{}", wrong.join("\n"));
    Ok(format!("{} rows", report.rows.len()))
}

/// The differences, in words, between the rows of a page and those that were measured with the
/// compiler `rustc`; between those of one robot, if it is named. If the page names another
/// compiler, figures may be smaller, or larger by its share.
fn differences(page: &str, fresh: &str, robot: Option<&str>, rustc: &str) -> Vec<String> {
    let by_other = rustc_of(page).filter(|by| *by != rustc);
    let (there, now) = (rows(page), rows(fresh));
    let mut wrong = Vec::new();
    for (key, now) in &now {
        let Some(there) = there.get(key) else {
            wrong.push(format!("{key}: the page does not have it"));
            continue;
        };
        for (what, (there, now)) in FIGURES.iter().zip(there.iter().zip(now)) {
            match by_other {
                None if there != now => {
                    wrong.push(format!("{key}: {what} {now}, on the page {there}"));
                }
                Some(by) if BOUNDED.contains(what) && !is_close(there, now) => wrong.push(format!(
                    "{key}: {what} {now}, on the page {there}: more than {} % above that of {by}",
                    100.0 * OTHER_RUSTC
                )),
                _ => {}
            }
        }
    }
    let is_of = |key: &str| robot.is_none_or(|robot| key.split(' ').next() == Some(robot));
    let gone = there.keys().filter(|key| is_of(key) && !now.contains_key(*key));
    wrong.extend(gone.map(|key| format!("{key}: is no longer measured")));
    wrong
}

/// Whether a figure is not larger than what is allowed to another compiler.
fn is_close(there: &str, now: &str) -> bool {
    let [there, now] = [there, now].map(|figure| figure.replace(',', "").parse::<f64>());
    matches!((there, now), (Ok(there), Ok(now)) if now <= there * (1.0 + OTHER_RUSTC))
}

/// The figures of each row on a page, by the key of the row.
fn rows(page: &str) -> BTreeMap<String, [&str; FIGURES.len()]> {
    let (mut rows, mut robot) = (BTreeMap::new(), "");
    for line in page.lines() {
        if let Some(heading) = line.strip_prefix("## ") {
            robot = heading;
        }
        let cells = cells(line).unwrap_or_default();
        let [called, trig, figures @ ..] = &*cells else {
            continue;
        };
        let trig = match *trig {
            "inside" => " trig",
            "outside" => "",
            _ => continue,
        };
        // The table of opt-level s has fewer figures.
        if let Ok(figures) = figures.try_into() {
            rows.insert(format!("{robot} {called}{trig}"), figures);
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::{FIGURES, differences, hold, rows};
    use crate::kit::bars::{Bar, Bars};
    use crate::kit::docs::repository;
    use crate::kit::docs::rustc_of;
    use crate::kit::rows::Row;
    use crate::studies::costs::Report;

    fn row(robot: &str, cost: u64) -> Row {
        Row {
            trig: false,
            code_bytes: cost,
            stack_bytes: cost,
            ..Row::sample([robot, "rnea", "core", "full"], cost)
        }
    }

    /// A report of one row of each of these robots and costs.
    fn report(rows: &[(&str, u64)], rustc: &str) -> Report {
        Report {
            rows: rows.iter().map(|(robot, cost)| row(robot, *cost)).collect(),
            small: Vec::new(),
            bars: Bars::new(),
            rustc: rustc.into(),
        }
    }

    /// The outcome for a page and what is measured, in words.
    fn outcome(page: &Report, measured: &Report, all: bool) -> String {
        match hold(&page.markdown(), measured, all) {
            Ok(compared) => compared,
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn every_changed_figure_of_the_page_is_named() {
        let page = repository::read(super::PAGE);
        let rustc = rustc_of(&page).expect("a compiler");
        let found = |page: &str, fresh: &str| differences(page, fresh, None, rustc);
        assert!(found(&page, &page).is_empty());
        let recorded = rows(&page);
        assert!(recorded.len() > 200, "{} rows", recorded.len());
        // A row that has all figures.
        let key = "ur5e rnea core full";
        let is_row =
            |line: &&str| line.starts_with("| rnea core full ") && line.contains("outside");
        let row = page.lines().find(is_row).expect("a row");
        for (at, what) in FIGURES.iter().enumerate() {
            let mut parts: Vec<&str> = row.split('|').collect();
            parts[at + 3] = " 1 ";
            let changed = page.replacen(row, &parts.join("|"), 1);
            let now = recorded[key][at];
            assert_eq!(found(&changed, &page), [format!("{key}: {what} {now}, on the page 1")]);
        }
    }

    #[test]
    fn a_cost_that_is_not_that_of_the_page_is_refused_whether_more_or_less() {
        let of = |cost| report(&[("arm", cost)], "rustc 1");
        for all in [true, false] {
            assert_eq!(outcome(&of(1000), &of(1000), all), "1 rows");
            for (cost, printed) in [(1001, "1,001"), (999, "999")] {
                let said = outcome(&of(1000), &of(cost), all);
                for words in [
                    "docs/costs.md is out of date: `cargo xtask costs` rewrites it",
                    &format!("arm rnea core full: cycles max {printed}, on the page 1,000"),
                    &format!("arm rnea core full: stack {printed}, on the page 1,000"),
                ] {
                    assert!(said.contains(words), "{words}: {said}");
                }
            }
        }
    }

    #[test]
    fn another_compiler_may_cost_less_and_three_per_cent_more() {
        let by = |rustc, cost| report(&[("arm", cost)], rustc);
        let of = |cost| outcome(&by("rustc 1", 1000), &by("rustc 2", cost), true);
        for cost in [900, 1000, 1030] {
            assert_eq!(of(cost), "1 rows", "{cost}");
        }
        let said = of(1031);
        let words = "cycles max 1,031, on the page 1,000: more than 3 % above that of rustc 1";
        assert!(said.contains(words), "{said}");
    }

    #[test]
    fn rows_that_one_side_lacks_are_named_but_for_those_of_robots_that_are_not_measured() {
        let of = |rows: &[(&str, u64)]| report(rows, "rustc 1");
        // The name of the other robot begins alike.
        let (arm, both) = (of(&[("arm", 9)]), of(&[("arm", 9), ("arm2", 9)]));
        assert_eq!(outcome(&both, &arm, false), "1 rows");
        let said = outcome(&both, &arm, true);
        assert!(said.ends_with("  arm2 rnea core full: is no longer measured"), "{said}");
        let said = outcome(&arm, &both, true);
        assert!(said.ends_with("  arm2 rnea core full: the page does not have it"), "{said}");
        let other =
            Report { rows: vec![Row::sample(["arm", "aba", "core", "full"], 9)], ..of(&[]) };
        let said = outcome(&both, &other, false);
        assert!(said.contains("arm rnea core full: is no longer measured"), "{said}");
        assert!(!said.contains("arm2"), "{said}");
    }

    #[test]
    fn the_words_of_the_page_are_compared_in_a_full_run() {
        let measured = report(&[("arm", 9)], "rustc 1");
        let page = measured.markdown().replace("# Costs", "# Cost");
        assert!(hold(&page, &measured, false).is_ok());
        let why = hold(&page, &measured, true).expect_err("another title");
        assert!(why.to_string().contains("there: # Cost\n"), "{why}");
    }

    #[test]
    fn bars_hold_whatever_the_page_says() {
        let key = row("arm", 0).key();
        let compared = |bar: &str, ratio: f64, small: u64| {
            let mut bars = toml_edit::de::from_str::<Bars>(bar).expect("bars");
            let name = format!("opt-level s / 3, {key}");
            bars.insert(name, Bar::of([("cycles", ratio)]));
            let report = Report {
                small: vec![row("arm", small)],
                bars,
                ..report(&[("arm", 1000)], "rustc 1")
            };
            outcome(&report, &report, true)
        };
        let bar = |most: u64, missed: &str| {
            format!("{key:?} = {{ cycles = {most}, missed = [{missed}] }}")
        };
        assert_eq!(compared(&bar(1000, ""), 1.05, 1050), "1 rows");
        assert_eq!(compared(&bar(999, "\"cycles\""), 1.05, 1050), "1 rows");
        for (bar, small, words) in [
            (bar(999, ""), 1050, "bar: arm rnea core full: cycles 1,000 > 999"),
            (bar(1000, "\"cycles\""), 1050, "met now"),
            (bar(1000, ""), 1051, "1.051× > 1.050×"),
            ("\"no such row\" = { cycles = 1 }".into(), 1050, "no such row: there is no such row"),
        ] {
            let said = compared(&bar, 1.05, small);
            assert!(said.contains(words), "{words}: {said}");
        }
    }
}
