//! Links in the documents lead to something that exists: files and headings.

use std::fs::read_to_string;
use std::path::{Path, PathBuf};

pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

pub fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in folder.read_dir().expect("a folder") {
        let path = entry.expect("an entry").path();
        let is_hidden = path.file_name().is_some_and(|name| name.as_encoded_bytes()[0] == b'.');
        if path.is_dir() && !is_hidden && !path.ends_with("target") {
            found.append(&mut files(&path, extension));
        } else if path.extension().is_some_and(|found| found == extension) {
            found.push(path);
        }
    }
    found
}

/// A page without its blocks of code.
pub fn prose(page: &str) -> String {
    let mut outside = true;
    let lines = page.lines().filter(|line| {
        let is_fence = line.trim_start().starts_with("```");
        outside ^= is_fence;
        outside && !is_fence
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// The text between each occurrence of `begin` and the next `end`.
pub fn between<'a>(text: &'a str, begin: &'a str, end: char) -> impl Iterator<Item = &'a str> {
    text.split(begin).skip(1).filter_map(move |rest| Some(rest.split_once(end)?.0))
}

/// The anchor of a heading.
fn slug(heading: &str) -> String {
    let kept = |c: char| c.is_alphanumeric() || "-_ ".contains(c);
    let text = heading.trim_start_matches('#').trim().to_lowercase();
    text.chars().filter(|&c| kept(c)).collect::<String>().replace(' ', "-")
}

/// The links of all pages, with their pages.
fn links() -> Vec<(PathBuf, String)> {
    // The templates of generated pages are not pages: their links are relative to `docs`.
    let is_template = |page: &PathBuf| page.starts_with(root().join("xtask"));
    let mut all = Vec::new();
    for page in files(&root(), "md").into_iter().filter(|page| !is_template(page)) {
        let text = prose(&read_to_string(&page).expect("a page"));
        all.extend(between(&text, "](", ')').map(|link| (page.clone(), link.to_owned())));
    }
    all
}

/// Whether the target of a link in `page` exists, if it is a file or a heading.
fn leads_somewhere(page: &Path, link: &str) -> bool {
    if link.contains("://") || link.starts_with("mailto:") {
        return true;
    }
    let (path, anchor) = link.split_once('#').unwrap_or((link, ""));
    let target = match path {
        "" => page.to_owned(),
        path => page.with_file_name(path),
    };
    let has_heading = || {
        let text = prose(&read_to_string(&target).expect("text"));
        let named = text.contains(&format!("<a id=\"{anchor}\"></a>"));
        let mut lines = text.lines();
        named || lines.any(|line| line.starts_with('#') && slug(line) == anchor)
    };
    target.exists() && (anchor.is_empty() || has_heading())
}

#[test]
fn every_link_resolves() {
    let links = links();
    assert!(links.len() > 50, "{} links", links.len());
    for (page, link) in &links {
        assert!(leads_somewhere(page, link), "{}: {link}", page.display());
    }
    let page = root().join("docs/guide/src/tuning.md");
    assert!(leads_somewhere(&page, "effects.md#signs"));
    for dead in ["effect.md", "effects.md#sings"] {
        assert!(!leads_somewhere(&page, dead), "{dead}");
    }
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
