//! The pages of the guide are listed and their programs are those that are compiled.

use std::fs::read_to_string;

use crate::files::{files, root};

const PAGE: &str = include_str!("../src/firmware.md");

/// The part of a program between its marks, without the indentation and the gate that a page does
/// not need.
fn shown(program: &str) -> String {
    let (_, rest) = program.split_once("// page: begin\n").expect("a begin");
    let (part, _) = rest.split_once("// page: end").expect("an end");
    let lines: Vec<&str> = part.lines().filter(|line| !line.contains("cfg(target_arch")).collect();
    let indented = |line: &&str| line.len() - line.trim_start().len();
    let margin = lines.iter().filter(|line| !line.trim().is_empty()).map(indented).min();
    let cut = |line: &&str| line.get(margin.unwrap_or(0)..).unwrap_or("").to_owned();
    lines.iter().map(cut).collect::<Vec<_>>().join("\n").trim_end().to_owned()
}

/// Words without layout, documentation and lints.
fn words(code: &str) -> String {
    let plain = |line: &&str| !line.trim_start().starts_with(['/', '#']);
    let code: String = code.lines().filter(plain).collect();
    code.split_whitespace()
        .collect::<String>()
        .replace(",}", "}")
        .replace(",)", ")")
        .replace(",]", "]")
}

/// The enumeration of the supervisor's states reads the copy.
#[test]
fn the_tables_of_transitions_are_those_of_the_enumeration() {
    let page = include_str!("../src/faults.md");
    let copy =
        include_str!("../../../motion-control/src/safety/supervisor/tests/transitions/table.md");
    let (_, rest) = page.split_once("<!-- transitions:begin -->").expect("a begin");
    let (tables, _) = rest.split_once("<!-- transitions:end -->").expect("an end");
    assert_eq!(tables.trim(), copy.trim());
}

#[test]
fn the_programs_on_the_page_are_those_that_are_compiled() {
    for program in [
        include_str!("../../../firmware-demo/boards/guide/src/bin/bare.rs"),
        include_str!("../../../firmware-demo/boards/guide/src/bin/rtic_app.rs"),
        include_str!("../../../firmware-demo/boards/guide/src/bin/embassy_app.rs"),
    ] {
        let shown = shown(program);
        assert!(PAGE.contains(&shown), "the page lacks:\n{shown}");
        assert!(!PAGE.contains(&shown.replace("arm.tick", "arm.tock")));
    }
}

#[test]
fn the_page_shows_the_board_that_is_compiled() {
    let page = include_str!("../src/board.md");
    for program in [
        include_str!("../../../firmware-demo/boards/guide/src/bin/board.rs"),
        include_str!("../../../firmware-demo/boards/guide/src/rod.rs"),
    ] {
        let shown = shown(program);
        assert!(page.contains(&shown), "the page lacks:\n{shown}");
        assert!(shown.lines().count() <= 60);
    }
}

#[test]
fn the_page_shows_the_controller_of_the_programs() {
    let library = include_str!("../../../firmware-demo/boards/guide/src/lib.rs");
    let (_, controller) = library.split_once("const TICK").expect("the constants");
    let (controller, _) = controller.split_once("/// Stands for encoders").expect("the board");
    let expected = words(controller);
    assert!(words(PAGE).contains(&expected));
    assert!(!words(PAGE).contains(&expected.replace("25.0", "26.0")));
}

#[test]
fn every_page_is_listed_and_its_code_compiled() {
    let pages = root().join("docs/guide");
    let list = read_to_string(pages.join("src/SUMMARY.md")).expect("the list");
    let compiled = read_to_string(pages.join("lib.rs")).expect("the library");
    for page in files(&pages.join("src"), "md") {
        let name = page.file_name().and_then(|name| name.to_str()).expect("a name");
        assert!(name == "SUMMARY.md" || list.contains(&format!("({name})")), "{name}");
        let has_code = read_to_string(&page).expect("a page").contains("```rust\n");
        assert!(!has_code || compiled.contains(&format!("\"{name}\"")), "{name}");
    }
}
