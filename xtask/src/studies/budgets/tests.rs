use super::{
    Budget, Budgets, DocumentMut, Rows, bars, check_costs, hold_costs, hold_scene, write_costs,
};
use crate::kit::bars::{Bar, Bars};
use crate::kit::rows::Row;
use crate::kit::workspace::Workspace;
use crate::studies::costs;

/// A scene's budget of these costs.
fn budget(rustc: &str, cost: u64) -> Budget {
    let figures = [
        "tick_instructions",
        "tick_cycles",
        "dynamics_instructions",
        "dynamics_cycles",
        "flash_bytes",
        "ram_bytes",
        "stack_bytes",
    ];
    Budget {
        rustc: rustc.into(),
        figures: figures.map(|figure| (figure.to_owned(), cost)).into(),
    }
}

fn row(cost: u64) -> Row {
    Row {
        trig: false,
        code_bytes: cost,
        stack_bytes: cost,
        ..Row::sample(["arm", "rnea", "core", "full"], cost)
    }
}

/// A report of one row of these costs, at opt-level s with those, and of these bars.
fn report(cost: u64, small: u64, bars: &str, ratios: Bars) -> costs::Report {
    let mut all = toml_edit::de::from_str::<Bars>(bars).expect("bars");
    all.extend(ratios);
    costs::Report {
        rows: vec![row(cost)],
        small: vec![row(small)],
        bars: all,
        rustc: "rustc 1".into(),
    }
}

/// Budgets whose only row of costs is that of this report.
fn budgets_of(report: &costs::Report) -> Budgets {
    Budgets {
        costs: Some(Rows::measured(report)),
        ..Budgets::default()
    }
}

fn outcome(result: crate::kit::error::Result<String>) -> String {
    match result {
        Ok(compared) => compared,
        Err(error) => error.to_string(),
    }
}

#[test]
fn another_compiler_gets_three_per_cent_and_no_more() {
    let ours = budget("rustc 1", 1000);
    assert!(ours.exceeded_by(&budget("rustc 1", 1000)).is_empty());
    assert_eq!(ours.exceeded_by(&budget("rustc 1", 1001)).len(), 7);
    assert!(ours.exceeded_by(&budget("rustc 2", 1030)).is_empty());
    assert_eq!(ours.exceeded_by(&budget("rustc 2", 1031)).len(), 6);
    assert_eq!(ours.exceeded_by(&budget("rustc 2", 1061)).len(), 7);
}

#[test]
fn one_cycle_beyond_the_budget_of_a_row_is_refused() {
    let plain = |cost| report(cost, cost, "", Bars::new());
    let budgets = budgets_of(&plain(1000));
    assert_eq!(outcome(hold_costs(&budgets, &plain(1000))), "1 rows");
    let over = outcome(hold_costs(&budgets, &plain(1001)));
    assert!(over.contains("cycles 1001 > 1000"), "{over}");
    assert!(hold_costs(&Budgets::default(), &plain(1)).is_err());
}

#[test]
fn bars_of_the_costs_hold_whatever_the_budget_allows() {
    let key = row(0).key();
    let compared = |bar: &str, ratio: f64, small: u64| {
        let ratio = Bar::of([("cycles", ratio)]);
        let ratios = Bars::from([(format!("opt-level s / 3, {key}"), ratio)]);
        let report = report(1000, small, bar, ratios);
        outcome(hold_costs(&budgets_of(&report), &report))
    };
    let bar =
        |most: u64, missed: &str| format!("{key:?} = {{ cycles = {most}, missed = [{missed}] }}");
    assert_eq!(compared(&bar(1000, ""), 1.05, 1050), "1 rows");
    let missed = compared(&bar(999, ""), 1.05, 1050);
    assert!(
        missed.contains("bar: ") && missed.contains("cycles 1,000 > 999"),
        "{missed}"
    );
    assert_eq!(compared(&bar(999, "\"cycles\""), 1.05, 1050), "1 rows");
    let met = compared(&bar(1000, "\"cycles\""), 1.05, 1050);
    assert!(met.contains("met now"), "{met}");
    let larger = compared(&bar(1000, ""), 1.05, 1051);
    assert!(larger.contains("1.051× > 1.050×"), "{larger}");
    let unknown = compared("\"no such row\" = { cycles = 1 }", 1.05, 1050);
    assert!(
        unknown.contains("no such row: there is no such row"),
        "{unknown}"
    );
}

#[test]
fn a_scene_is_held_to_its_budget_and_bar() {
    let compared = |bar: &str, measured: u64| {
        let Budget { rustc, figures } = budget("rustc 1", 1000);
        let figures = toml_edit::ser::to_string(&figures).expect("TOML");
        let text = format!("[bars]\n{bar}\n[arm]\nrustc = {rustc:?}\n{figures}");
        let budgets: Budgets = toml_edit::de::from_str(&text).expect("budgets");
        hold_scene(&budgets, "arm", &budget("rustc 1", measured))
    };
    let bar = |most, missed| format!("\"arm tick\" = {{ cycles = {most}, missed = [{missed}] }}");
    assert!(compared("", 1000).is_ok());
    assert!(compared("", 1001).is_err());
    assert!(compared(&bar(1000, ""), 1000).is_ok());
    let missed = outcome(compared(&bar(999, ""), 1000));
    assert!(
        missed.contains("bar: arm tick: cycles 1,000 > 999"),
        "{missed}"
    );
    assert!(compared(&bar(999, "\"cycles\""), 1000).is_ok());
    assert!(compared(&bar(1000, "\"cycles\""), 1000).is_err());
    assert!(hold_scene(&Budgets::default(), "arm", &budget("rustc 1", 1)).is_err());
}

fn rows(rustc: &str, key: &str, cycles: u64) -> Rows {
    let text = format!(
        "rustc = {rustc:?}\n[rows]\n{key:?} = {{ instructions = 9, cycles = {cycles}, \
         code_bytes = 9, stack_bytes = 9 }}\n"
    );
    toml_edit::de::from_str(&text).expect("TOML")
}

#[test]
fn the_same_costs_leave_the_file_as_it_is() {
    let text = crate::kit::docs::repository::read("budgets.toml");
    let budgets: Budgets = toml_edit::de::from_str(&text).expect("budgets");
    let mut file: DocumentMut = text.parse().expect("TOML");
    budgets.costs.expect("costs").put(&mut file);
    assert_eq!(file.to_string(), text);
}

#[test]
fn rows_and_figures_over_budget_are_named() {
    let row = |rustc, key, cycles| rows(rustc, key, cycles);
    let of_arm = || row("rustc 1", "ur5e rnea core full", 9).only("ur5e");
    let other_robot = || row("rustc 1", "ur5e10 rnea core full", 9).only("ur5e");
    let aba = || row("rustc 1", "ur5e aba core full", 9);
    let ours = || row("rustc 1", "a", 1000);
    for (ours, theirs, wrong) in [
        (ours(), row("rustc 1", "a", 1000), &[][..]),
        (ours(), row("rustc 2", "a", 1030), &[]),
        (
            ours(),
            row("rustc 1", "a", 1001),
            &["a: cycles 1001 > 1000"],
        ),
        (
            ours(),
            row("rustc 1", "b", 1),
            &["b: has no budget", "a: is no longer measured"],
        ),
        // The budget of one robot misses no row of another, whose name begins alike.
        (
            of_arm(),
            aba(),
            &[
                "ur5e aba core full: has no budget",
                "ur5e rnea core full: is no longer measured",
            ],
        ),
        (other_robot(), aba(), &["ur5e aba core full: has no budget"]),
    ] {
        assert_eq!(ours.exceeded_by(&theirs), wrong);
    }
    let figure = |name| -> Budget {
        toml_edit::de::from_str(&format!("rustc = \"rustc 1\"\n{name} = 1")).expect("TOML")
    };
    let wrong = figure("bytes").exceeded_by(&figure("cycles"));
    assert_eq!(wrong, ["cycles has no budget", "bytes is no figure"]);
}

/// A workspace that has nothing but these budgets.
fn workspace(folder: &tempfile::TempDir, budgets: &str) -> Workspace {
    std::fs::write(folder.path().join("budgets.toml"), budgets).expect("written");
    Workspace::at(folder.path())
}

#[test]
fn the_budgets_of_a_workspace_are_written_and_then_kept() {
    let folder = tempfile::tempdir().expect("a folder");
    let workspace = workspace(&folder, "# Why.\n[costs]\nrustc = \"\"\nrows = {}\n");
    let plain = |cost| report(cost, cost, "", Bars::new());
    let refused = outcome(check_costs(&workspace, &plain(1000), None));
    assert!(refused.contains("has no budget"), "{refused}");
    write_costs(&workspace, &plain(1000)).expect("written");
    let kept = |cost| outcome(check_costs(&workspace, &plain(cost), None));
    assert_eq!(kept(1000), "1 rows");
    assert!(kept(1001).contains("cycles 1001 > 1000"));
    let text = std::fs::read_to_string(folder.path().join("budgets.toml")).expect("there");
    assert!(text.starts_with("# Why.\n"), "{text}");
}

#[test]
fn a_report_of_one_robot_is_held_to_its_budgets() {
    let folder = tempfile::tempdir().expect("a folder");
    let workspace = workspace(&folder, "[costs]\n");
    let mut both = report(1000, 1000, "", Bars::new());
    let other = Row {
        robot: "leg".into(),
        ..row(1000)
    };
    both.rows.push(other);
    write_costs(&workspace, &both).expect("written");
    let arm = report(1000, 1000, "", Bars::new());
    let gone = outcome(check_costs(&workspace, &arm, None));
    assert!(
        gone.contains("leg rnea") && gone.contains("is no longer measured"),
        "{gone}"
    );
    assert_eq!(
        outcome(check_costs(&workspace, &arm, Some("arm"))),
        "1 rows"
    );
}

#[test]
fn bars_are_those_of_rows_and_of_pairs_of_rows() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = "[bars]\na = { cycles = 7 }\n[ratios]\n\"a / b\" = { cycles = 0.5 }\n";
    let bars = bars(&workspace(&folder, text)).expect("bars");
    assert_eq!(bars["a"].most["cycles"], 7.0);
    assert_eq!(bars["a / b"].most["cycles"], 0.5);
}

#[test]
fn a_scenes_budget_replaces_its_old_one_alone() {
    let mut file: DocumentMut = "[leg]\nrustc = \"rustc 0\"\n[arm]\ntick_cycles = 1 # less\n"
        .parse()
        .expect("TOML");
    budget("rustc 1", 1000).put("arm", &mut file);
    let budgets: Budgets = toml_edit::de::from_str(&file.to_string()).expect("budgets");
    assert_eq!(budgets.scenes["arm"].rustc, "rustc 1");
    assert_eq!(
        budgets.scenes["arm"].figures,
        budget("rustc 1", 1000).figures
    );
    assert_eq!(budgets.scenes["leg"].rustc, "rustc 0");
}
