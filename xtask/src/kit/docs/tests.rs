use expect_test::expect;

use super::{TICK, compare, compare_picture, rustc_of};
use crate::kit::workspace::Workspace;

const NOW: &str = "rustc 2";

/// A page of one table, as a compiler measured it.
fn page(head: &str, row: &str, rustc: &str) -> String {
    let rule: String = head.split('|').skip(2).map(|_| "---|").collect();
    format!("# Page\n\n{head}\n|{rule}\n{row}\n\nMeasured with {rustc}.\n")
}

/// Whether a page is accepted where another one is written.
fn is_current(written: &str, now: &str, rustc: &str) -> bool {
    compare("docs/costs.md", "cargo xtask costs", written, now, rustc).is_ok()
}

/// Whether a row is accepted in any case, from another compiler only, or never.
fn verdict(head: &str, written: &str, now: &str) -> &'static str {
    let accepted = |rustc| is_current(&page(head, written, rustc), &page(head, now, NOW), NOW);
    match [NOW, "rustc 1"].map(accepted) {
        [true, true] => "same",
        [false, true] => "close",
        [false, false] => "refused",
        [true, false] => "accepted from the same compiler only",
    }
}

/// Headings, and figures under each of them: WRITTEN → NOW / NOW; …
const FIGURES: [(&str, &str); 6] = [
    // Small figures are held as exactly.
    (
        "insn|cycles|worst tick|flash, B|RAM|µs|tick's code, B",
        "1,000 → 1,000 / 1,030 / 1,031 / 969; 6 → 7; 0.10 → 0.40; −100 → −103 / 100",
    ),
    (
        "max, N·m|error RMS, mrad|of full scale|99 %|energy drift",
        "1.1e-6 → 1.2e-6 / 1.3e-6 / NaN / –; 0.113 → 0.123 / 0.126; 0.028 → 0.030 / 0.4; \
         3.46 → 3.80 / 3.82; 0 → 1e-30",
    ),
    // Without a point, the last digit is a whole per cent.
    (
        "of 1 ms",
        "1.4 % → 1.5 % / 1.6 %; 0.33 % → 0.35 %; 72.6 % → 74.8 % / 75.0 %; 72 % → 75 % / 76 %",
    ),
    (
        "tracking error RMS, mrad",
        "9.904 (72.6 %) → 9.9 (72.6 %) / 8.8 (72.6 %) / 9.904 (82.6 %)",
    ),
    (
        "of floor|s / 3|now",
        "0.46 → 0.48 / 0.50; 1.000 → 1.059 / 1.061; 1.010× → 1.07× / 1.08×",
    ),
    ("bound|at most|bodies|joints|no.", "1000 → 1000 / 1001"),
];

// Costs are within 3 %, multiples within 6, errors within a tenth, shares within 3 % and a last digit; bounds and counts are no
// compiler's business.
#[test]
fn figures_of_another_compiler_are_as_close_as_their_heading_says() {
    let mut verdicts: Vec<(Vec<&str>, String)> = Vec::new();
    for (headings, cases) in FIGURES {
        for heading in headings.split('|') {
            let head = format!("| robot | joints | {heading} |");
            let row = |figure: &str| format!("| ur5e | 6 | {figure} |");
            let mut lines = String::new();
            for case in cases.split("; ") {
                let (written, figures) = case.split_once(" → ").expect("a case");
                let one = |now| format!(" {now} {}", verdict(&head, &row(written), &row(now)));
                let each: Vec<String> = figures.split(" / ").map(one).collect();
                lines += &format!("  {written}:{}\n", each.join(","));
            }
            match verdicts.last_mut().filter(|last| last.1 == lines) {
                Some((headings, _)) => headings.push(heading),
                None => verdicts.push((vec![heading], lines)),
            }
        }
    }
    let text =
        |(headings, lines): &(Vec<&str>, String)| format!("{}\n{lines}", headings.join(" | "));
    expect![[r#"
        insn | cycles | worst tick | flash, B | RAM | µs | tick's code, B
          1,000: 1,000 same, 1,030 close, 1,031 refused, 969 refused
          6: 7 refused
          0.10: 0.40 refused
          −100: −103 close, 100 refused
        max, N·m | error RMS, mrad | of full scale | 99 % | energy drift
          1.1e-6: 1.2e-6 close, 1.3e-6 refused, NaN refused, – refused
          0.113: 0.123 close, 0.126 refused
          0.028: 0.030 close, 0.4 refused
          3.46: 3.80 close, 3.82 refused
          0: 1e-30 refused
        of 1 ms
          1.4 %: 1.5 % close, 1.6 % refused
          0.33 %: 0.35 % refused
          72.6 %: 74.8 % close, 75.0 % refused
          72 %: 75 % close, 76 % refused
        tracking error RMS, mrad
          9.904 (72.6 %): 9.9 (72.6 %) close, 8.8 (72.6 %) refused, 9.904 (82.6 %) refused
        of floor | s / 3
          0.46: 0.48 close, 0.50 refused
          1.000: 1.059 close, 1.061 refused
          1.010×: 1.07× close, 1.08× refused
        now
          0.46: 0.48 refused, 0.50 refused
          1.000: 1.059 refused, 1.061 refused
          1.010×: 1.07× close, 1.08× refused
        bound | at most | bodies | joints | no.
          1000: 1000 same, 1001 refused
    "#]]
    .assert_eq(&verdicts.iter().map(text).collect::<String>());
    // Without a heading of its own, a column is like the one before it.
    let head = "| effect | cycles: core | engine |";
    let engine = |now| verdict(head, "| e | 9 | 1,000 |", now);
    assert_eq!(engine("| e | 9 | 1,030 |"), "close");
    assert_eq!(engine("| e | 9 | 1,031 |"), "refused");
}

#[test]
fn rows_and_words_are_those_that_are_written() {
    let head = "| robot | insn | max, N·m |";
    let row = "| ur5e | 1,234 | 1.1e-5 |";
    let two = "| a | 1 | 2 |\n| b | 1 | 2 |";
    for (written, now, expected) in [
        ("| ur5e | 1,235 | 1.1e-5 |", row, "close"),
        ("| ur5e | 1,334 | 1.1e-5 |", row, "refused"),
        ("| ur3e | 1,234 | 1.1e-5 |", row, "refused"),
        ("| ur5e | 1,234 | 1.1e-5 | 13 |", row, "refused"),
        (
            "| ur5e | 1,234 | 1.1e-5 |\n| panda | 13 | 1 |",
            row,
            "refused",
        ),
        ("| ur5e | -- | 1.1e-5 |", row, "refused"),
        ("nothing", row, "refused"),
        ("", row, "refused"),
        ("| b | 1 | 2 |\n| a | 1 | 2 |", two, "refused"),
    ] {
        for (old, new) in [(written, now), (now, written)] {
            assert_eq!(verdict(head, old, new), expected, "{old:?} {new:?}");
        }
    }
    let bar = |verdict: &str| format!("| rnea | 1,000 | 900 | {verdict} |");
    let bars = verdict("| bar | at most | now | |", &bar("met"), &bar("MISSED"));
    assert_eq!(bars, "refused");
    let [written, now] = ["| ur5e | 1,235 | 1.1e-5 |", row].map(|row| page(head, row, NOW));
    let refused = compare("docs/costs.md", "cargo xtask costs", &written, &now, NOW);
    expect![[r#"
        docs/costs.md is out of date: `cargo xtask costs` rewrites it
          there: | ur5e | 1,235 | 1.1e-5 |
          now:   | ur5e | 1,234 | 1.1e-5 |"#]]
    .assert_eq(&refused.expect_err("one digit").to_string());
}

#[test]
fn each_table_has_its_own_headings_and_rules() {
    let text = |rule: &str, bound: &str, rustc: &str| {
        let first = format!("| robot | insn |\n{rule}\n| ur5e | 1000 |");
        let second = format!("| robot | at most |\n| --- | ---: |\n| ur5e | {bound} |");
        format!("{first}\n\nThe bounds.\n\n{second}\n\nMeasured with {rustc}.\n")
    };
    let old = text("| --- | ---: |", "1000", "rustc 1");
    let now = |bound| text("| ----- | ------: |", bound, NOW);
    assert!(is_current(&old, &now("1000"), NOW));
    assert!(!is_current(&old, &now("1001"), NOW));
}

#[test]
fn a_sentence_keeps_its_words_and_its_figures() {
    let flash = "Flash 85,340 B (of which 13,072)";
    let accepted = |written: &str, now: &str| {
        let text = |said: &str, rustc| format!("{said}\nMeasured with {rustc}.");
        is_current(&text(written, "rustc 1"), &text(now, NOW), NOW)
    };
    for (written, now, is_accepted) in [
        (flash, "Flash 86,000 B (of which 13,000)", true),
        (flash, "Flash 88,000 B (of which 13,072)", false),
        (flash, "RAM 85,340 B (of which 13,072)", false),
        ("over 32 states", "over 33 states", false),
        // Behind the compiler's name there may be another one.
        (
            "exact. Measured with rustc 1.",
            "exact. Measured with rustc 3.",
            true,
        ),
    ] {
        assert_eq!(accepted(written, now), is_accepted, "{written} {now}");
    }
    assert!(!is_current(
        flash,
        &format!("{flash}\nMeasured with {NOW}."),
        NOW
    ));
    // Without a compiler only the same is accepted.
    assert!(is_current("| a | 1000 |", "| a | 1000 |", ""));
    assert!(!is_current("| a | 1000 |", "| a | 1001 |", ""));
}

#[test]
fn the_compiler_of_a_page_is_read_to_its_end() {
    let of = rustc_of("a\nb. Measured with rustc 1.95.0 (5 2026).\nc");
    assert_eq!(of, Some("rustc 1.95.0 (5 2026)"));
    assert_eq!(rustc_of("nothing"), None);
    // Not one whose name only begins so.
    let [old, new] = [("1000", "rustc 22"), ("1001", NOW)]
        .map(|(insn, rustc)| page("| robot | insn |", &format!("| a | {insn} |"), rustc));
    assert!(is_current(&old, &new, NOW));
}

#[test]
fn a_picture_of_other_figures_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let workspace = Workspace::at(folder.path());
    let svg = "<svg><circle cx=\"12\" cy=\"3.5\"/><text>RNEA 2,443</text></svg>\n";
    std::fs::write(folder.path().join("growth.svg"), svg).expect("written");
    let accepted = |fresh: &str, same| {
        compare_picture(&workspace, "growth.svg", "cargo xtask growth", fresh, same).is_ok()
    };
    let moved = svg.replace("12", "1234.25").replace("2,443", "999");
    assert!(accepted(svg, true) && !accepted(&moved, true));
    // Another compiler's figures move, but not the words and what is drawn.
    assert!(accepted(&moved, false));
    assert!(!accepted(&svg.replace("RNEA", "ABA"), false));
    assert!(!accepted(
        &svg.replace("<circle", "<circle/><circle"),
        false
    ));
    assert!(compare_picture(&workspace, "new.svg", "", svg, true).is_err());
}

#[test]
fn the_readme_is_written_between_its_markers() {
    let folder = tempfile::tempdir().expect("a folder");
    let workspace = Workspace::at(folder.path());
    let empty = "<!-- demo:begin -->\n<!-- demo:end -->\n";
    std::fs::write(folder.path().join(TICK.file), empty).expect("written");
    let check = |text| TICK.check(&workspace, text, None).is_ok();
    assert!(!check("The text."));
    TICK.write(&workspace, "The text.").expect("written");
    assert!(check("The text.") && !check("The texts."));
    assert!(TICK.split("no markers").is_err());
}
