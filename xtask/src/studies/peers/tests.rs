//! docs/peers.md, which no step measures anew, against `budgets.toml`; its sum shows a digit that
//! was changed by hand.

use crate::kit::bars::{self, Bars, Compared};
use crate::kit::docs::repository::{read, rows_of};

const PAGE: &str = "docs/peers.md";

/// The ratios and the core's cycles that `budgets.toml` promises beside peers.
fn promised() -> Bars {
    let budgets: serde_json::Value = toml_edit::de::from_str(&read("budgets.toml")).expect("TOML");
    let part =
        |name: &str| -> Bars { serde_json::from_value(budgets[name].clone()).expect("bars") };
    let mut ratios = part("ratios");
    ratios.extend(part("bars"));
    let targets = [", m4f, ", ", gates, ", ", host "];
    ratios.retain(|key, _| targets.iter().any(|target| key.contains(target)));
    ratios
}

/// Holds the table of bars against what is promised.
fn check(page: &str, promised: &Bars) -> Result<(), String> {
    let (_, part) = page.split_once("\n## Against the bars\n").ok_or("no bars")?;
    let part = part.split("\n## ").next().unwrap_or_default();
    let compared = |cells: &Vec<&str>| {
        let (key, figure) = cells[0].rsplit_once(": ")?;
        let now = cells[2].trim_end_matches('×').replace(',', "").parse().ok()?;
        Compared::of(promised, key, figure, now)
    };
    let rows: Option<Vec<Compared>> = rows_of(part).iter().map(compared).collect();
    let rows = rows.ok_or("a row is of no bar")?;
    if let Some(wrong) = rows.iter().find_map(Compared::complaint) {
        return Err(wrong);
    }
    let figures: usize = promised.values().map(|bar| bar.most.len()).sum();
    let table = bars::table(&rows).markdown();
    match rows.len() == figures && part.contains(&table) {
        true => Ok(()),
        false => Err(format!("the bars are not\n{table}")),
    }
}

#[test]
fn the_page_has_every_bar_that_is_promised() {
    check(&read(PAGE), &promised()).expect("docs/peers.md: `cargo xtask peers` rewrites it");
}

#[test]
fn a_page_that_disagrees_is_refused() {
    let (page, promised) = (read(PAGE), promised());
    let mut lines = page.lines();
    let bar = lines
        .find(|line| line.starts_with("| ur5e rnea, m4f, engine / casadi: cycles"))
        .expect("a row");
    let now = bar.split('|').nth(3).expect("a figure");
    for other in [
        page.replace(bar, &bar.replace(now, &now.replace("0.", "9."))),
        page.replace(&format!("{bar}\n"), ""),
        page.replace(bar, &bar.replace("met", "missed")),
    ] {
        assert!(other != page && check(&other, &promised).is_err());
    }
    // Another promise than that of the page.
    let mut stricter = promised;
    let bars = stricter.values_mut().flat_map(|ratio| &mut ratio.most);
    bars.for_each(|(_, most)| *most *= 0.9);
    assert!(check(&page, &stricter).is_err());
}
