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
    let code: String = code.split_whitespace().collect();
    code.replace(",}", "}").replace(",)", ")").replace(",]", "]")
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
fn the_programs_on_the_pages_are_those_that_are_compiled() {
    let board = include_str!("../src/board.md");
    let balancing = include_str!("../src/balancing.md");
    for (page, program) in [
        (PAGE, include_str!("../../../firmware-demo/boards/guide/src/bin/bare.rs")),
        (PAGE, include_str!("../../../firmware-demo/boards/guide/src/bin/rtic_app.rs")),
        (PAGE, include_str!("../../../firmware-demo/boards/guide/src/bin/embassy_app.rs")),
        (board, include_str!("../../../firmware-demo/boards/guide/src/bin/board.rs")),
        (board, include_str!("../../../firmware-demo/boards/guide/src/rod.rs")),
        (balancing, include_str!("../../../tools/lqr/tests/wheel_leg/design.rs")),
        (balancing, include_str!("../../../tools/lqr/tests/wheel_leg/main.rs")),
    ] {
        let shown = shown(program);
        assert!(page.contains(&shown), "the page lacks:\n{shown}");
        assert!(page != PAGE || !page.contains(&shown.replace("arm.tick", "arm.tock")));
        assert!(page != board || shown.lines().count() <= 60);
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
    let table = read_to_string(pages.join("src/README.md")).expect("the table");
    let compiled = read_to_string(pages.join("lib.rs")).expect("the library");
    for page in files(&pages.join("src"), "md") {
        let name = page.file_name().and_then(|name| name.to_str()).expect("a name");
        let entry = format!("({name})");
        let is_listed = list.contains(&entry) && (name == "README.md" || table.contains(&entry));
        assert!(name == "SUMMARY.md" || is_listed, "{name}");
        let has_code = read_to_string(&page).expect("a page").contains("```rust\n");
        assert!(!has_code || compiled.contains(&format!("\"{name}\"")), "{name}");
    }
}
