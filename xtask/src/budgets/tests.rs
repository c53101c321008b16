use super::{Budget, Budgets, hold_costs, hold_scene};
use crate::bars::{Ratio, Ratios};
use crate::costs::{self, Bars};
use crate::meter::Spread;

fn budget(rustc: &str, cost: u64) -> Budget {
    Budget {
        rustc: rustc.into(),
        tick_instructions: cost,
        tick_cycles: cost,
        dynamics_instructions: cost,
        dynamics_cycles: cost,
        flash_bytes: cost,
        ram_bytes: cost,
        stack_bytes: cost,
    }
}

fn row(cost: u64) -> costs::Row {
    let spread = Spread {
        min: cost,
        median: cost,
        max: cost,
    };
    costs::Row {
        robot: "arm".into(),
        algorithm: "rnea".into(),
        form: "core".into(),
        inputs: "full".into(),
        trig: false,
        joints: 6,
        instructions: spread,
        cycles: spread,
        cycles_mean: 0.0,
        flops: 0,
        code_bytes: cost,
        stack_bytes: cost,
        address: 0,
    }
}

/// A report of one row of these costs, at opt-level s with those, and of these bars.
fn report(cost: u64, small: u64, bars: &str, ratios: Ratios) -> costs::Report {
    costs::Report {
        rows: vec![row(cost)],
        small: vec![row(small)],
        bars: toml::from_str::<Bars>(bars).expect("bars"),
        ratios,
        rustc: "rustc 1".into(),
    }
}

/// Budgets whose only row of costs is that of this report.
fn budgets_of(report: &costs::Report) -> Budgets {
    Budgets {
        costs: Some(costs::Budget::measured(report)),
        ..Budgets::default()
    }
}

fn told(result: crate::error::Result<String>) -> String {
    match result {
        Ok(seen) => seen,
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
fn a_row_that_costs_one_cycle_more_than_its_budget_is_refused() {
    let plain = |cost| report(cost, cost, "", Ratios::new());
    let budgets = budgets_of(&plain(1000));
    assert_eq!(told(hold_costs(&budgets, &plain(1000))), "1 rows");
    let over = told(hold_costs(&budgets, &plain(1001)));
    assert!(over.contains("cycles 1001 > 1000"), "{over}");
    assert!(hold_costs(&Budgets::default(), &plain(1)).is_err());
}

#[test]
fn a_bar_of_the_costs_is_held_whatever_the_budget_allows() {
    let key = row(0).key();
    let held = |bar: &str, ratio: f64, small: u64| {
        let ratio = Ratio {
            cycles: Some(ratio),
            ..Ratio::default()
        };
        let ratios = Ratios::from([(format!("opt-level s / 3, {key}"), ratio)]);
        let report = report(1000, small, bar, ratios);
        told(hold_costs(&budgets_of(&report), &report))
    };
    let bar =
        |most: u64, missed: &str| format!("{key:?} = {{ cycles = {most}, missed = [{missed}] }}");
    assert_eq!(held(&bar(1000, ""), 1.05, 1050), "1 rows");
    let missed = held(&bar(999, ""), 1.05, 1050);
    assert!(
        missed.contains("bar: ") && missed.contains("cycles 1,000 > 999"),
        "{missed}"
    );
    assert_eq!(held(&bar(999, "\"cycles\""), 1.05, 1050), "1 rows");
    let met = held(&bar(1000, "\"cycles\""), 1.05, 1050);
    assert!(met.contains("met now"), "{met}");
    let larger = held(&bar(1000, ""), 1.05, 1051);
    assert!(larger.contains("1.051× > 1.050×"), "{larger}");
    let unknown = held("\"no such row\" = { cycles = 1 }", 1.05, 1050);
    assert!(
        unknown.contains("no such row: there is no such row"),
        "{unknown}"
    );
}

#[test]
fn a_scene_is_held_to_its_budget_and_to_its_bar() {
    let text = |bar: &str| {
        let budget = toml::to_string(&budget("rustc 1", 1000)).expect("TOML");
        format!("[bars]\n{bar}\n[arm]\n{budget}")
    };
    let held = |bar: &str, taken: u64| {
        let budgets: Budgets = toml::from_str(&text(bar)).expect("budgets");
        hold_scene(&budgets, "arm", &budget("rustc 1", taken))
    };
    assert!(held("", 1000).is_ok());
    assert!(held("", 1001).is_err());
    assert!(held("\"arm tick\" = { cycles = 1000 }", 1000).is_ok());
    let missed = told(held("\"arm tick\" = { cycles = 999 }", 1000));
    assert!(
        missed.contains("bar: arm tick: cycles 1,000 > 999"),
        "{missed}"
    );
    assert!(
        held(
            "\"arm tick\" = { cycles = 999, missed = [\"cycles\"] }",
            1000
        )
        .is_ok()
    );
    assert!(
        held(
            "\"arm tick\" = { cycles = 1000, missed = [\"cycles\"] }",
            1000
        )
        .is_err()
    );
    assert!(hold_scene(&Budgets::default(), "arm", &budget("rustc 1", 1)).is_err());
}
