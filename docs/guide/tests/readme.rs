//! The README has few figures, each with a link to the page that has it.

use std::fs::read_to_string;
use std::path::Path;

const MOST: usize = 8;

/// Words before a number that is a name or a version.
const NAMED: [&str; 4] = ["Rust", "iiwa", "Python", "QEMU"];

/// The paragraphs, items and tables of a page without its blocks of code.
fn blocks(page: &str) -> Vec<String> {
    let (mut blocks, mut code) = (vec![String::new()], false);
    for line in page.lines() {
        code ^= line.trim_start().starts_with("```");
        let begins = line.trim().is_empty() || line.trim_start().starts_with("- ");
        blocks.extend(begins.then(String::new));
        let is_text = !code && !line.starts_with("```");
        if let Some(block) = blocks.last_mut().filter(|_| is_text) {
            *block += &format!("{line} ");
        }
    }
    blocks
}

/// The numbers of a text outside the targets of its links, each with its place; names such as
/// SO-101 and f32 are none.
fn numbers(text: &str) -> Vec<(usize, &str)> {
    let (mut found, mut before, mut at) = (Vec::new(), "", 0);
    for word in text.split([' ', '|', '(', '[']) {
        let target = text[..at].ends_with("](") || word.contains("](");
        let number = word.trim_matches(|letter: char| !letter.is_alphanumeric());
        let is_number = number.starts_with(|first: char| first.is_ascii_digit())
            && number.chars().all(|letter| letter.is_ascii_digit() || ".,e-".contains(letter));
        if is_number && !target && !NAMED.contains(&before) {
            found.push((at, number));
        }
        (before, at) = (word, at + word.len() + 1);
    }
    found
}

/// What is wrong with the figures of a README, whose pages `read` reads.
fn faults(readme: &str, read: impl Fn(&str) -> String) -> Vec<String> {
    let (mut faults, mut count) = (Vec::new(), 0);
    for block in blocks(readme) {
        for (at, figure) in numbers(&block) {
            count += 1;
            let links = block[at..].split("](").skip(1);
            let mut pages = links.filter_map(|rest| rest.split([')', '#']).next());
            match pages.find(|page| page.ends_with(".md")) {
                None => faults.push(format!("{figure}: no page is linked behind it")),
                Some(page) if !numbers(&read(page)).iter().any(|(_, there)| *there == figure) => {
                    faults.push(format!("{figure}: {page} does not have it"));
                }
                Some(_) => {}
            }
        }
    }
    if count > MOST {
        faults.push(format!("{count} figures, at most {MOST}"));
    }
    faults
}

#[test]
fn every_figure_of_the_readme_is_that_of_its_page() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    // A page that is not there has no figure.
    let read = |file: &str| read_to_string(root.join(file)).unwrap_or_default();
    let faults = faults(&read("README.md"), read);
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_figure_without_its_page_is_found() {
    let of = |readme: &str| {
        let pages = |page: &str| {
            if page == "docs/costs.md" { "| rnea | 1,025 | 1.1e-5 |\nTakes 344." } else { "" }
                .to_owned()
        };
        faults(readme, pages)
    };
    let good = "An SO-101 in f32 needs Rust 1.95.\n\n- It takes **344** cycles, within 1.1e-5 N·m \
                ([costs](docs/costs.md#so101)).\n- No number.\n\n```rust\nlet x = 7;\n```\n";
    assert!(of(good).is_empty(), "{:?}", of(good));
    let other = good.replace("344", "345");
    assert_eq!(of(&other), ["345: docs/costs.md does not have it"]);
    let unlinked = good.replace("- No number", "- No 344");
    assert_eq!(of(&unlinked), ["344: no page is linked behind it"]);
    assert_eq!(of(&good.replace("costs.md", "peers.md")).len(), 2);
    let many = "1,025 344 ".repeat(5) + "([costs](docs/costs.md))";
    assert_eq!(of(&many), ["10 figures, at most 8"]);
}
