use expect_test::expect;

use super::repository::{read, root};
use super::seal::{is_sealed, sealed, unsealed};
use super::{Page, compare, compare_picture, rustc_of};
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

#[test]
fn words_of_another_compiler_are_those_that_are_written() {
    let head = "| robot | insn | max, N·m |";
    let row = "| ur5e | 1,234 | 1.1e-5 |";
    let two = "| a | 1 | 2 |\n| b | 1 | 2 |";
    for (written, expected) in [
        (row, "same"),
        ("| ur5e | 99,235 | 1e-5 |", "close"),
        ("| ur3e-b | 1,234 | 1.1e-5 |", "refused"),
        ("| ur5e | 1,234 | 1.1e-5 | 13 |", "refused"),
        ("| ur5e | 1,234 | 1.1e-5 |\n| panda | 13 | 1 |", "refused"),
        ("| ur5e | – | 1.1e-5 |", "refused"),
        ("", "refused"),
    ] {
        assert_eq!(verdict(head, written, row), expected, "{written:?}");
    }
    assert_eq!(verdict(head, "| b | 1 | 2 |\n| a | 1 | 2 |", two), "refused");
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
    // Without a compiler only the same is accepted, and so it is of a text that names none.
    for rustc in ["", NOW] {
        assert!(is_current("| a | 1000 |", "| a | 1000 |", rustc));
        assert!(!is_current("| a | 1000 |", "| a | 1001 |", rustc));
    }
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
    std::fs::write(folder.path().join("drawn.svg"), svg).expect("written");
    let accepted = |fresh: &str, same| {
        compare_picture(&workspace, "drawn.svg", "cargo xtask drawn", fresh, same).is_ok()
    };
    let moved = svg.replace("12", "1234.25").replace("2,443", "999");
    assert!(accepted(svg, true) && !accepted(&moved, true));
    // Another compiler's figures move, but not the words and what is drawn.
    assert!(accepted(&moved, false));
    assert!(!accepted(&svg.replace("RNEA", "ABA"), false));
    assert!(!accepted(&svg.replace("<circle", "<circle/><circle"), false));
    assert!(compare_picture(&workspace, "new.svg", "", svg, true).is_err());
}

#[test]
fn a_part_is_written_between_its_markers() {
    const PART: Page<'_> = Page { file: "README.md", name: "demo", command: "cargo xtask demo" };
    let folder = tempfile::tempdir().expect("a folder");
    let workspace = Workspace::at(folder.path());
    let empty = "<!-- demo:begin -->\n<!-- demo:end -->\n";
    std::fs::write(folder.path().join(PART.file), empty).expect("written");
    let check = |text| PART.check(&workspace, text, None).is_ok();
    assert!(!check("The text."));
    PART.write(&workspace, "The text.").expect("written");
    assert!(check("The text.") && !check("The texts."));
    assert!(PART.split("no markers").is_err());
}

/// Blocks that are written by tests, which compare them whole with what they observe, and where;
/// all others have their sum.
const BY_TESTS: [(&str, &str, &str); 11] = [
    (
        "docs/guide/src/contact.md",
        "contact",
        "host-tests/simulations/tests/contact_reaction/mod.rs",
    ),
    ("docs/guide/src/faults.md", "faults", "host-tests/simulations/tests/fault_injection.rs"),
    ("docs/guide/src/faults.md", "transitions", "docs/guide/tests/pages.rs"),
    ("docs/guide/src/guiding.md", "drag", "host-tests/simulations/tests/hand_guiding/mod.rs"),
    ("docs/guide/src/guiding.md", "release", "host-tests/simulations/tests/hand_guiding/mod.rs"),
    ("docs/guide/src/identification.md", "conditions", "tools/identification/tests/ur5e/main.rs"),
    ("docs/guide/src/identification.md", "results", "tools/identification/tests/ur5e/main.rs"),
    ("docs/guide/src/porting.md", "dependencies", "docs/guide/tests/pages.rs"),
    ("docs/guide/src/taught-paths.md", "noise", "host-tests/simulations/tests/taught_path/mod.rs"),
    (
        "docs/guide/src/taught-paths.md",
        "playback",
        "host-tests/simulations/tests/taught_path/mod.rs",
    ),
    ("docs/guide/src/taught-paths.md", "toppra", "host-tests/simulations/tests/taught_path/mod.rs"),
];

/// The pages of the repository that have parts which are written by commands or tests.
fn pages() -> Vec<String> {
    let mut pages = vec!["README.md".to_owned()];
    for folder in ["docs", "docs/guide/src"] {
        let entries = std::fs::read_dir(root().join(folder)).expect("a folder");
        let names = entries.flatten().map(|entry| entry.file_name());
        let names = names.map(|name| format!("{folder}/{}", name.to_string_lossy()));
        pages.extend(names.filter(|name| name.ends_with(".md")));
    }
    pages.sort();
    pages
}

/// The parts of a page between markers, by name; the whole page, without a name, if a command
/// writes it.
fn blocks(page: &str) -> Vec<(&str, &str)> {
    let begins = page.match_indices(":begin -->").map(|(end, begin)| {
        let start = page[..end].rfind("<!-- ").expect("a marker") + "<!-- ".len();
        let (name, rest) = (&page[start..end], &page[end + begin.len()..]);
        let (block, _) = rest.split_once(&format!("<!-- {name}:end -->")).expect("its end");
        (name, block)
    });
    let blocks: Vec<_> = begins.collect();
    match page.contains("<!-- written by `") && blocks.is_empty() {
        true => vec![("", page)],
        false => blocks,
    }
}

#[test]
fn a_changed_digit_of_any_generated_block_is_seen() {
    let mut by_tests = Vec::new();
    for file in pages() {
        let page = read(&file);
        for (name, block) in blocks(&page) {
            if let Some(row) = BY_TESTS.iter().find(|row| (row.0, row.1) == (&*file, name)) {
                by_tests.push(*row);
                continue;
            }
            assert!(is_sealed(block), "{file}, {name}: not what a command wrote");
            // The first digit of each figure; of long blocks, of some figures.
            let bytes = block.as_bytes();
            let is_first = |i: &usize| bytes[*i].is_ascii_digit() && !bytes[i - 1].is_ascii_digit();
            let figures: Vec<usize> = (1..bytes.len()).filter(is_first).collect();
            for &i in figures.iter().step_by(figures.len().div_ceil(60)) {
                let digit = if bytes[i] == b'7' { "8" } else { "7" };
                let other = format!("{}{digit}{}", &block[..i], &block[i + 1..]);
                assert!(!is_sealed(&other), "{file}, {name}: byte {i}");
            }
        }
    }
    by_tests.sort_unstable();
    assert_eq!(by_tests, BY_TESTS);
    for (file, name, test) in BY_TESTS {
        let source = read(test);
        let page = file.rsplit('/').next().unwrap_or_default();
        assert!(
            source.contains(page) || source.contains("BEGIN"),
            "{test} does not name {page}, {name}"
        );
    }
}

#[test]
fn a_sum_is_of_the_whole_text() {
    let text = sealed("| 759 |\n\n| 538 |");
    assert!(is_sealed(&text) && unsealed(&text) == "| 759 |\n\n| 538 |");
    assert_eq!(sealed(unsealed(&text)), text);
    for other in ["| 758 |\n\n| 538 |", "| 759 |\n\n| 538 |\n| 1 |", "| 759 || 538 |"] {
        assert!(!is_sealed(&text.replace(unsealed(&text), other)));
    }
    assert!(!is_sealed("| 759 |"));
}
