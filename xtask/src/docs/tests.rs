mod generated;
pub mod repository;

use std::path::PathBuf;

use super::{README, compare, compare_picture, rustc_of};
use crate::workspace::Workspace;

/// This compiler's name in pages.
const NOW: &str = "rustc 2";

/// A page of one table, as a compiler measured it.
fn page(head: &str, row: &str, rustc: &str) -> String {
    let rule: String = head.split('|').skip(1).map(|_| "---|").collect();
    let rule = rule.strip_suffix("---|").unwrap_or(&rule);
    format!("# Page\n\n{head}\n|{rule}\n{row}\n\nMeasured with {rustc}.\n")
}

/// Whether a row is accepted where another one is written, measured with the same compiler and with another one.
fn accepted(head: &str, written: &str, now: &str) -> [bool; 2] {
    ["rustc 2", "rustc 1"].map(|rustc| {
        let (written, now) = (page(head, written, rustc), page(head, now, NOW));
        compare("docs/costs.md", "cargo xtask costs", &written, &now, NOW).is_ok()
    })
}

const SAME: [bool; 2] = [true, true];
/// Accepted from another compiler only.
const CLOSE: [bool; 2] = [false, true];
const OTHER: [bool; 2] = [false, false];

#[test]
fn a_page_with_one_digit_changed_is_refused() {
    let head = "| robot | insn | max, N·m |";
    let row = "| ur5e | 1,234 | 1.1e-5 |";
    assert_eq!(accepted(head, row, row), SAME);
    assert_eq!(accepted(head, "| ur5e | 1,235 | 1.1e-5 |", row), CLOSE);
    assert_eq!(accepted(head, "| ur5e | 1,334 | 1.1e-5 |", row), OTHER);
    assert_eq!(accepted(head, "| ur3e | 1,234 | 1.1e-5 |", row), OTHER);
    let refused = compare(
        "docs/costs.md",
        "cargo xtask costs",
        &page(head, "| ur5e | 1,235 | 1.1e-5 |", NOW),
        &page(head, row, NOW),
        NOW,
    );
    let message = refused.expect_err("one digit").to_string();
    assert!(message.contains("there: | ur5e | 1,235") && message.contains("now:   | ur5e | 1,234"));
}

#[test]
fn a_row_too_many_or_too_few_is_refused() {
    let head = "| robot | insn |";
    let (one, two) = ("| ur5e | 12 |", "| ur5e | 12 |\n| panda | 13 |");
    assert_eq!(accepted(head, one, two), OTHER);
    assert_eq!(accepted(head, two, one), OTHER);
    assert_eq!(accepted(head, two, "| panda | 13 |\n| ur5e | 12 |"), OTHER);
    assert_eq!(accepted(head, one, "| ur5e | 12 | 13 |"), OTHER);
    assert_eq!(accepted(head, one, ""), OTHER);
}

#[test]
fn a_sentence_for_a_row_and_a_figure_for_a_rule_are_refused() {
    let head = "| robot | insn |";
    assert_eq!(accepted(head, "| ur5e | 12 |", "nothing"), OTHER);
    assert_eq!(accepted(head, "nothing", "| ur5e | 12 |"), OTHER);
    assert_eq!(accepted(head, "| ur5e | -- |", "| ur5e | 12 |"), OTHER);
    assert_eq!(accepted(head, "| ur5e | 12 |", "| ur5e | -- |"), OTHER);
}

#[test]
fn the_rule_below_the_headings_is_as_long_as_it_likes() {
    let text = |rule: &str, rustc| format!("| robot | insn |\n{rule}\n\nMeasured with {rustc}.\n");
    let (old, new) = (
        text("| --- | ---: |", "rustc 1"),
        text("| ----- | ------: |", NOW),
    );
    assert!(compare("docs/costs.md", "", &old, &new, NOW).is_ok());
}

#[test]
fn the_headings_of_a_table_are_not_those_of_the_one_before_it() {
    let text = |bound: &str, rustc| {
        let first = "| robot | insn |\n| --- | ---: |\n| ur5e | 1000 |";
        let second = format!("| robot | at most |\n| --- | ---: |\n| ur5e | {bound} |");
        format!("{first}\n\nThe bounds.\n\n{second}\n\nMeasured with {rustc}.\n")
    };
    let is_accepted = |bound| {
        let (old, new) = (text("1000", "rustc 1"), text(bound, NOW));
        compare("docs/costs.md", "", &old, &new, NOW).is_ok()
    };
    assert!(is_accepted("1000") && !is_accepted("1001"));
}

#[test]
fn a_page_that_says_something_else_is_refused_and_one_that_is_written_is_accepted() {
    let folder = tempfile::tempdir().expect("a folder");
    let workspace = Workspace {
        root: folder.path().to_owned(),
        target: PathBuf::new(),
        bins: Vec::new(),
        reports: None,
    };
    let empty = "<!-- demo:begin -->\n<!-- demo:end -->\n";
    std::fs::write(folder.path().join(README.file), empty).expect("written");
    assert!(README.check(&workspace, "The text.", None).is_err());
    README.write(&workspace, "The text.").expect("written");
    assert!(README.check(&workspace, "The text.", None).is_ok());
    assert!(README.check(&workspace, "The texts.", None).is_err());
}

#[test]
fn costs_of_another_compiler_are_within_three_per_cent() {
    for heading in [
        "insn",
        "cycles",
        "worst tick",
        "flash, B",
        "RAM",
        "µs",
        "tick's code, B",
    ] {
        let head = format!("| robot | {heading} |");
        let row = |figure: &str| format!("| ur5e | {figure} |");
        assert_eq!(
            accepted(&head, &row("1,000"), &row("1,030")),
            CLOSE,
            "{heading}"
        );
        assert_eq!(
            accepted(&head, &row("1,000"), &row("1,031")),
            OTHER,
            "{heading}"
        );
        assert_eq!(
            accepted(&head, &row("1,000"), &row("969")),
            OTHER,
            "{heading}"
        );
        // What is small is no less exact.
        assert_eq!(accepted(&head, &row("6"), &row("7")), OTHER, "{heading}");
        assert_eq!(
            accepted(&head, &row("0.10"), &row("0.40")),
            OTHER,
            "{heading}"
        );
        assert_eq!(
            accepted(&head, &row("−100"), &row("−103")),
            CLOSE,
            "{heading}"
        );
        assert_eq!(
            accepted(&head, &row("−100"), &row("100")),
            OTHER,
            "{heading}"
        );
    }
    // Without a heading of its own, a column is like the one before it.
    let head = "| effect | cycles: core | engine |";
    assert_eq!(
        accepted(head, "| e | 9 | 1,000 |", "| e | 9 | 1,030 |"),
        CLOSE
    );
    assert_eq!(
        accepted(head, "| e | 9 | 1,000 |", "| e | 9 | 1,031 |"),
        OTHER
    );
}

#[test]
fn errors_of_another_compiler_are_within_a_tenth_however_small() {
    for heading in [
        "max, N·m",
        "error RMS, mrad",
        "of full scale",
        "99 %",
        "energy drift",
    ] {
        let head = format!("| robot | insn | {heading} |");
        let row = |figure: &str| format!("| ur5e | 12 | {figure} |");
        for (written, close, other) in [
            ("1.1e-6", "1.2e-6", "1.3e-6"),
            ("0.113", "0.123", "0.126"),
            ("0.028", "0.030", "0.4"),
            ("3.46", "3.80", "3.82"),
        ] {
            assert_eq!(
                accepted(&head, &row(written), &row(close)),
                CLOSE,
                "{heading}"
            );
            assert_eq!(
                accepted(&head, &row(written), &row(other)),
                OTHER,
                "{heading}"
            );
            assert_eq!(
                accepted(&head, &row(written), &row("NaN")),
                OTHER,
                "{heading}"
            );
            assert_eq!(
                accepted(&head, &row(written), &row("–")),
                OTHER,
                "{heading}"
            );
        }
        assert_eq!(
            accepted(&head, &row("0"), &row("1e-30")),
            OTHER,
            "{heading}"
        );
    }
}

#[test]
fn shares_of_another_compiler_move_by_three_per_cent_and_a_last_digit() {
    let head = "| phase | insn | of 1 ms |";
    let row = |figure: &str| format!("| read | 12 | {figure} |");
    assert_eq!(accepted(head, &row("1.4 %"), &row("1.5 %")), CLOSE);
    assert_eq!(accepted(head, &row("1.4 %"), &row("1.6 %")), OTHER);
    assert_eq!(accepted(head, &row("0.33 %"), &row("0.35 %")), OTHER);
    assert_eq!(accepted(head, &row("72.6 %"), &row("74.8 %")), CLOSE);
    assert_eq!(accepted(head, &row("72.6 %"), &row("75.0 %")), OTHER);
    // Without a point, the last digit is a whole per cent.
    assert_eq!(accepted(head, &row("72 %"), &row("75 %")), CLOSE);
    assert_eq!(accepted(head, &row("72 %"), &row("76 %")), OTHER);
    let head = "| tracking error RMS, mrad | exact model |";
    let row = |figure: &str| format!("| PD | {figure} |");
    assert_eq!(
        accepted(head, &row("9.904 (72.6 %)"), &row("9.9 (72.6 %)")),
        CLOSE
    );
    assert_eq!(
        accepted(head, &row("9.904 (72.6 %)"), &row("8.8 (72.6 %)")),
        OTHER
    );
    assert_eq!(
        accepted(head, &row("9.904 (72.6 %)"), &row("9.904 (82.6 %)")),
        OTHER
    );
}

#[test]
fn multiples_of_another_compiler_are_within_six_per_cent() {
    for (head, written, close, other) in [
        ("| robot | insn | of floor |", "0.46", "0.48", "0.50"),
        ("| robot | insn | of floor |", "1.000", "1.059", "1.061"),
        ("| robot | cycles at s | s / 3 |", "0.998", "1.05", "1.07"),
        ("| robot | at most | now |", "1.010×", "1.07×", "1.08×"),
    ] {
        let row = |figure: &str| format!("| ur5e | 12 | {figure} |");
        assert_eq!(accepted(head, &row(written), &row(close)), CLOSE, "{head}");
        assert_eq!(accepted(head, &row(written), &row(other)), OTHER, "{head}");
    }
}

#[test]
fn bounds_and_counts_are_no_compilers_business() {
    for heading in ["bound", "at most", "joints", "no."] {
        let head = format!("| robot | {heading} |");
        assert_eq!(
            accepted(&head, "| a | 1000 |", "| a | 1001 |"),
            OTHER,
            "{heading}"
        );
    }
    assert_eq!(
        accepted("| bodies | insn |", "| 1000 | 9 |", "| 1001 | 9 |"),
        OTHER
    );
    let head = "| bar | at most | now | |";
    let row = |verdict: &str| format!("| rnea | 1,000 | 900 | {verdict} |");
    assert_eq!(accepted(head, &row("met"), &row("MISSED")), OTHER);
}

#[test]
fn a_sentence_keeps_its_words_and_its_figures() {
    let text = |said: &str, rustc: &str| format!("{said}\nMeasured with {rustc}.");
    let accepted = |written: &str, now: &str| {
        let (written, now) = (text(written, "rustc 1"), text(now, NOW));
        compare("docs/growth.md", "", &written, &now, NOW).is_ok()
    };
    assert!(accepted(
        "Flash 85,340 B (of which 13,072)",
        "Flash 86,000 B (of which 13,000)"
    ));
    assert!(!accepted("Flash 85,340 B", "Flash 88,000 B"));
    assert!(!accepted("Flash 85,340 B", "RAM 85,340 B"));
    assert!(!accepted("over 32 states", "over 33 states"));
    // Behind the compiler's name there may be another one; the line itself must be there.
    assert!(accepted(
        "exact. Measured with rustc 1.",
        "exact. Measured with rustc 3."
    ));
    let without = compare(
        "docs/growth.md",
        "",
        "Flash 85,340 B",
        &text("Flash 85,340 B", NOW),
        NOW,
    );
    assert!(without.is_err());
}

#[test]
fn without_a_compiler_nothing_but_the_same_will_do() {
    let compare = |written: &str, now: &str| compare("docs/hard-cases.md", "", written, now, "");
    assert!(compare("| a | 1000 |", "| a | 1000 |").is_ok());
    assert!(compare("| a | 1000 |", "| a | 1001 |").is_err());
}

#[test]
fn the_compiler_of_a_page_is_read_to_its_end() {
    assert_eq!(
        rustc_of("a\nb. Measured with rustc 1.95.0 (5 2026).\nc"),
        Some("rustc 1.95.0 (5 2026)")
    );
    assert_eq!(rustc_of("nothing"), None);
    // Not one whose name only begins so.
    let head = "| robot | insn |";
    let (old, new) = (
        page(head, "| a | 1000 |", "rustc 22"),
        page(head, "| a | 1001 |", NOW),
    );
    assert!(compare("docs/costs.md", "", &old, &new, NOW).is_ok());
}

#[test]
fn a_picture_of_other_figures_is_refused() {
    let workspace = Workspace {
        root: std::env::temp_dir().join(format!("pictures-{}", std::process::id())),
        target: PathBuf::new(),
        bins: Vec::new(),
        reports: None,
    };
    let file = "docs/growth.svg";
    std::fs::create_dir_all(workspace.root.join("docs")).expect("a directory");
    let svg = "<svg><circle cx=\"12\" cy=\"3.5\"/><text>RNEA 2,443</text></svg>\n";
    std::fs::write(workspace.root.join(file), svg).expect("a file");
    let accepted = |now: &str, same_figures| {
        compare_picture(&workspace, file, "cargo xtask growth", now, same_figures).is_ok()
    };
    let moved = svg.replace("cx=\"12\"", "cx=\"13\"");
    let renamed = svg.replace("RNEA", "CRBA");
    let more = svg.replace("<circle", "<circle/><circle");
    assert!(accepted(svg, true) && accepted(svg, false));
    assert!(!accepted(&moved, true) && accepted(&moved, false));
    assert!(!accepted(&renamed, true) && !accepted(&renamed, false));
    assert!(!accepted(&more, true) && !accepted(&more, false));
    assert!(compare_picture(&workspace, "docs/new.svg", "", svg, true).is_err());
    std::fs::remove_dir_all(&workspace.root).expect("removed");
    assert!(!accepted(svg, true), "a picture that is not there");
}

#[test]
fn a_readme_without_markers_is_an_error() {
    assert!(README.split("nothing").is_err());
    let text = "a<!-- demo:begin -->b<!-- demo:end -->c";
    assert!(
        README
            .split(text)
            .is_ok_and(|parts| parts == ("a", "b", "c"))
    );
}
