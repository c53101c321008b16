//! The pages of docs/ open with a question and its answer.

use std::fs::{read_dir, read_to_string};
use std::path::Path;

/// Pages whose reference part is long: the words before it have a bound.
const LONG: [&str; 3] = ["accuracy.md", "costs.md", "hard-cases.md"];

/// The parts that a page lacks.
fn lacks(name: &str, page: &str) -> Vec<String> {
    let plain = page.lines().filter(|line| !line.starts_with("<!--"));
    let plain: Vec<&str> = plain.collect();
    let page = plain.join("\n");
    let paragraphs = page.split("\n\n").map(str::trim);
    let first = paragraphs.filter(|text| !text.is_empty()).nth(1).unwrap_or_default();
    let overview = page.split("\n## Reference").next().unwrap_or_default();
    let words = |text: &str| {
        let prose = text.lines().filter(|line| !line.contains(" | "));
        prose.flat_map(str::split_whitespace).count()
    };
    let is_long = LONG.contains(&name);
    let checks = [
        (first.starts_with("**") && first.contains("?**"), "no question in its first paragraph"),
        (!is_long || overview.len() < page.len(), "no part `Reference`"),
        (!is_long || words(overview) <= 600, "more than 600 words before its reference"),
    ];
    let wrong = checks.into_iter().filter(|(holds, _)| !holds);
    wrong.map(|(_, what)| format!("{name}: {what}")).collect()
}

#[test]
fn every_page_opens_with_question_and_answer() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let pages = read_dir(docs).expect("the folder").flatten();
    let pages = pages.filter(|page| page.path().extension().is_some_and(|end| end == "md"));
    let wrong = pages.flat_map(|page| {
        let text = read_to_string(page.path()).expect("a page");
        lacks(&page.file_name().to_string_lossy(), &text)
    });
    assert_eq!(wrong.collect::<Vec<_>>(), Vec::<String>::new());
}

#[test]
fn a_page_without_them_is_found() {
    let good = "# T\n\n**Why?** So.\n\n## Reference\n\n| 1 |\n";
    assert!(lacks("costs.md", good).is_empty());
    assert_eq!(lacks("costs.md", "# T\n\nWhy.\n\n| 1 |\n").len(), 2);
    let wordy = good.replace("So.", &"So ".repeat(700));
    assert_eq!(lacks("costs.md", &wordy).len(), 1);
}
