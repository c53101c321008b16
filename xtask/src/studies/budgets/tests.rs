use super::{Budget, Budgets, DocumentMut, FIGURES, bars, hold_scene, put};
use crate::kit::docs::repository;
use crate::kit::workspace::Workspace;

/// A scene's budget of these costs.
fn budget(rustc: &str, cost: u64) -> Budget {
    Budget { rustc: rustc.into(), figures: [cost; FIGURES.len()] }
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
fn a_scene_is_held_to_its_budget_and_bar() {
    let compared = |bar: &str, measured: u64| {
        let mut budgets: Budgets =
            toml_edit::de::from_str(&format!("[bars]\n{bar}")).expect("bars");
        budgets.put("arm", budget("rustc 1", 1000));
        hold_scene(&budgets, "arm", &budget("rustc 1", measured))
    };
    let bar = |most| format!("\"arm tick\" = {{ cycles = {most} }}");
    assert!(compared("", 1000).is_ok());
    let over = compared("", 1001).expect_err("over").to_string();
    assert!(over.contains("tick_cycles 1001 > 1000"), "{over}");
    assert!(compared(&bar(1000), 1000).is_ok());
    let over = compared(&bar(999), 1000).expect_err("over").to_string();
    assert!(over.contains("bar: arm tick: cycles 1,000 > 999"), "{over}");
    assert!(hold_scene(&Budgets::default(), "arm", &budget("rustc 1", 1)).is_err());
}

#[test]
fn the_same_costs_leave_the_file_as_it_is() {
    let text = repository::read("budgets.toml");
    let budgets: Budgets = toml_edit::de::from_str(&text).expect("budgets");
    let mut file: DocumentMut = text.parse().expect("TOML");
    budgets.put_scenes(&mut file);
    assert_eq!(file.to_string(), text);
}

/// A workspace that has nothing but these budgets.
fn workspace(folder: &tempfile::TempDir, budgets: &str) -> Workspace {
    std::fs::write(folder.path().join("budgets.toml"), budgets).expect("written");
    Workspace::at(folder.path())
}

#[test]
fn a_bar_of_an_unknown_figure_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let bars = |text: &str| bars(&workspace(&folder, text));
    let known = bars("[bars]\na = { cycles = 7 }\n").expect("bars");
    assert_eq!(known["a"].most["cycles"], 7.0);
    assert!(bars("[bars]\na = { circles = 7 }\n").is_err());
}

#[test]
fn a_scenes_budget_replaces_its_old_one_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let old = "[1, 1, 1, 1, 1, 1, 1]";
    let kept = "# Why.\n[bars]\na = { cycles = 7 } # more\n\n";
    let text = format!("{kept}[scenes.\"rustc 0\"]\narm = {old}\nleg = {old}\n");
    let workspace = workspace(&folder, &text);
    let written = |scene| {
        put(&workspace, scene, budget("rustc 1", 1000)).expect("written");
        std::fs::read_to_string(folder.path().join("budgets.toml")).expect("there")
    };
    let new = "[1000, 1000, 1000, 1000, 1000, 1000, 1000]";
    let by_two =
        format!("[scenes.\"rustc 0\"]\nleg = {old}\n\n[scenes.\"rustc 1\"]\narm = {new}\n");
    assert_eq!(written("arm"), format!("{kept}{by_two}"));
    let by_one = format!("[scenes.\"rustc 1\"]\narm = {new}\nleg = {new}\n");
    assert_eq!(written("leg"), format!("{kept}{by_one}"));
}
