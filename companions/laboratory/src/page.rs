//! The parts of pages that the commands write, and what has changed in them.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use xtask::kit::docs::today_and_commit;
use xtask::kit::error::{Result, check};
use xtask::kit::toolchain::Toolchain;
use xtask::kit::workspace::{self, Workspace};

/// The text of a page between `<!-- NAME:begin -->` and `<!-- NAME:end -->`.
pub struct Part {
    pub file: &'static str,
    pub name: &'static str,
    pub text: String,
}

/// The part in the head of a page: its day, commit and compiler.
const HEAD: &str = "measured";
/// A figure that changes by a larger share is shown.
const SHOWN: f64 = 0.02;

/// Writes the parts, and returns what has changed, a line each.
pub fn write(workspace: &Workspace, parts: &[Part], toolchain: &Toolchain) -> Result<String> {
    let mut said = String::new();
    let head = format!("{}, with {}.", today_and_commit(workspace), toolchain.rustc_version()?);
    for part in parts {
        let path = workspace.root.join(part.file);
        let old = workspace::read(&path)?;
        let new = replaced(&old, part.name, &part.text)?;
        for change in changes(&old, &new) {
            let _ = writeln!(said, "{}: {change}", part.file);
        }
        let new = replaced(&new, HEAD, &format!("Measured on {head}\n"))?;
        workspace::write(&path, new)?;
    }
    Ok(said)
}

/// The page with a text in a part of it.
fn replaced(page: &str, name: &str, text: &str) -> Result<String> {
    let [begin, end] = ["begin", "end"].map(|which| format!("<!-- {name}:{which} -->"));
    let parts = page.split_once(&begin).and_then(|(before, rest)| {
        let (_, after) = rest.split_once(&end)?;
        Some(format!("{before}{begin}\n{}\n{end}{after}", text.trim()))
    });
    parts.ok_or_else(|| check!("the page lacks the markers {begin} and {end}"))
}

/// The rows of the tables that have changed by more than [`SHOWN`], have come or have gone.
fn changes(old: &str, new: &str) -> Vec<String> {
    let [old, new] = [old, new].map(rows);
    let mut said = Vec::new();
    for (name, was) in &old {
        match new.get(name) {
            None => said.push(format!("{name}: gone")),
            Some(now) if is_other(was, now) => {
                said.push(format!("{name}: {}, now {}", was.join(" "), now.join(" ")));
            }
            Some(_) => {}
        }
    }
    let come = new.keys().filter(|name| !old.contains_key(*name));
    said.extend(come.map(|name| format!("{name}: new")));
    said
}

/// Rows by heading, first cell, and their number among those of the same.
fn rows(page: &str) -> BTreeMap<String, Vec<&str>> {
    let (mut rows, mut heading) = (BTreeMap::new(), "");
    for line in page.lines() {
        heading =
            line.strip_prefix('#').map_or(heading, |line| line.trim_start_matches('#').trim());
        let Some(inside) = line.strip_prefix("| ").and_then(|line| line.strip_suffix(" |")) else {
            continue;
        };
        let mut cells = inside.split(" | ").map(str::trim);
        let name = format!("{heading}, {}", cells.next().unwrap_or_default());
        let again = (1..).map(|n| if n == 1 { name.clone() } else { format!("{name}, {n}") });
        let free = again.into_iter().find(|name| !rows.contains_key(name));
        rows.extend(free.map(|name| (name, cells.collect())));
    }
    rows
}

/// Whether a figure of some cells differs by more than [`SHOWN`].
fn is_other(was: &[&str], now: &[&str]) -> bool {
    let figures = |cells: &[&str]| -> Vec<f64> {
        let text = cells.join(" ").replace(',', "");
        let words = text.split(|c: char| !(c.is_ascii_digit() || ".e-".contains(c)));
        words.filter_map(|word| word.parse().ok()).collect()
    };
    let (was, now) = (figures(was), figures(now));
    let differ = |(a, b): (&f64, &f64)| (a - b).abs() > SHOWN * a.abs();
    was.len() != now.len() || was.iter().zip(&now).any(differ)
}

#[cfg(test)]
mod tests {
    use super::{changes, replaced};

    #[test]
    fn changes_above_two_percent_are_shown() {
        let page = |rows: &str| format!("## RNEA\n\n| robot | cycles |\n| --- | --: |\n{rows}");
        let old = page("| ur5e | 1,000 (1.00) |\n| a1 | 50 |\n");
        let of = |rows: &str| changes(&old, &page(rows));
        assert!(of("| ur5e | 1,019 (1.01) |\n| a1 | 51 |\n").is_empty());
        let said = of("| ur5e | 1,021 (1.01) |\n| a1 | 50 |\n");
        assert_eq!(said, ["RNEA, ur5e: 1,000 (1.00), now 1,021 (1.01)"]);
        let said = of("| ur5e | 1,000 (1.00) |\n| ur5e | 7 |\n");
        assert_eq!(said, ["RNEA, a1: gone", "RNEA, ur5e, 2: new"]);
        assert_eq!(of("| ur5e | 1,000 (1.00) |\n| a1 | – |\n").len(), 1);
    }

    #[test]
    fn a_part_is_replaced_and_nothing_else() {
        let page = "a\n<!-- b:begin -->\n1\n<!-- b:end -->\nc\n";
        let new = replaced(page, "b", "2\n").expect("the markers");
        assert_eq!(new, page.replace('1', "2"));
        replaced(page, "c", "2").expect_err("no such part");
    }
}
