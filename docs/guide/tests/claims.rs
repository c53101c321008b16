//! The ledger of claims: how each claim of README and guide is shown, by what, and what that trusts. `cargo xtask claims` writes
//! the page from the entries in `docs/guide/claims/`, those of a page in a table of its path.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::read_to_string;
use std::path::Path;

use serde::Deserialize;

use crate::links::{files, root};

/// The tables of the steps of the tests, which are read as text.
const STEPS: [&str; 2] = ["xtask/src/commands/test/mod.rs", "xtask/src/studies/mod.rs"];
const README: &str = "README.md";
const GUIDE: &str = "docs/guide/src/";
const PAGE: &str = "docs/claims.md";
/// A paragraph, an item or a table of the README with one of these words, or with a digit, makes a claim.
const CLAIMING: [&str; 5] = ["never", "no", "every", "always", "all"];
/// How a claim is shown; the last one has neither tests nor anything that it trusts.
const KINDS: [&str; 5] = ["proven", "enumerated", "measured", "tested", "stated"];

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct Claim {
    /// Words of the page.
    claim: String,
    shown: String,
    /// Names of tests, `step NAME`, or paths of files.
    #[serde(default)]
    by: Vec<String>,
    /// Keys of `trusted.toml`.
    #[serde(default)]
    trusts: Vec<String>,
    /// Whether the page says so above its tables, of a claim that is only stated.
    #[serde(default)]
    important: bool,
}

struct Ledger {
    pages: BTreeMap<String, Vec<Claim>>,
    /// What a proof, a measurement or a test trusts, in words.
    trusted: BTreeMap<String, String>,
}

/// The repository, as far as claims refer to it.
struct Repository {
    tests: BTreeSet<String>,
    steps: String,
}

fn text(file: &str) -> String {
    read_to_string(root().join(file)).unwrap_or_default()
}

fn parsed<T: serde::de::DeserializeOwned>(path: &Path) -> T {
    let text = read_to_string(path).expect("an entry's file");
    toml_edit::de::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

impl Repository {
    fn read() -> Self {
        let mut tests = BTreeSet::new();
        for path in files(&root(), "rs") {
            let source = read_to_string(&path).expect("a source file");
            let after = source.split("#[test]").skip(1);
            let names = after.filter_map(|rest| rest.split_once("fn ")?.1.split_once('('));
            tests.extend(names.map(|(name, _)| name.to_owned()));
        }
        let steps = STEPS.map(text).concat();
        Self { tests, steps }
    }

    /// Whether there is what is said to show a claim.
    fn has(&self, by: &str) -> bool {
        match by.strip_prefix("step ") {
            Some(step) => {
                let rows = [format!("    (\"{step}\", "), format!("name: \"{step}\", ")];
                rows.iter().any(|row| self.steps.contains(row))
            }
            None => self.tests.contains(by) || by.contains('.') && root().join(by).is_file(),
        }
    }
}

impl Ledger {
    fn read() -> Self {
        let folder = root().join("docs/guide/claims");
        let mut entries = files(&folder, "toml");
        entries.retain(|path| !path.ends_with("trusted.toml"));
        let pages = entries
            .iter()
            .flat_map(|path| parsed::<BTreeMap<_, _>>(path));
        Self {
            pages: pages.collect(),
            trusted: parsed(&folder.join("trusted.toml")),
        }
    }

    fn all(&self) -> impl Iterator<Item = (&str, &Claim)> {
        let pages = self.pages.iter();
        pages.flat_map(|(page, claims)| claims.iter().map(move |claim| (&**page, claim)))
    }

    fn trusting(&self, key: &String) -> usize {
        let trusting = self.all().filter(|(_, claim)| claim.trusts.contains(key));
        trusting.count()
    }

    /// What does not hold of the entries.
    fn wrong(&self, repository: &Repository) -> Vec<String> {
        let mut wrong = Vec::new();
        let pages: BTreeMap<&String, String> = self
            .pages
            .keys()
            .map(|page| (page, joined(&text(page))))
            .collect();
        for (page, claims) in &self.pages {
            for claim in claims {
                let mut of =
                    |what: String| wrong.push(format!("{page}, \"{}\": {what}", claim.claim));
                if !pages[page].contains(&claim.claim) {
                    of("the page does not say so".into());
                }
                for by in claim.by.iter().filter(|by| !repository.has(by)) {
                    of(format!("there is no {by}"));
                }
                for key in claim
                    .trusts
                    .iter()
                    .filter(|key| !self.trusted.contains_key(*key))
                {
                    of(format!("trusted.toml has no {key}"));
                }
                let is_stated = claim.shown == KINDS[4];
                if [claim.by.is_empty(), claim.trusts.is_empty()] != [is_stated; 2] {
                    of("what is stated has neither `by` nor `trusts`, all else has both".into());
                }
                if !KINDS.contains(&&*claim.shown) {
                    of(format!("{} is no way to show a claim", claim.shown));
                }
            }
        }
        let idle = self.trusted.keys().filter(|key| self.trusting(key) == 0);
        wrong.extend(idle.map(|key| format!("no claim trusts {key}")));
        for path in files(&root().join(GUIDE), "md") {
            let page = format!(
                "{GUIDE}{}",
                path.file_name().expect("a name").to_string_lossy()
            );
            if !page.ends_with("SUMMARY.md") && !self.pages.contains_key(&page) {
                wrong.push(format!("{page} has no entry"));
            }
        }
        let readme = self
            .pages
            .get(README)
            .map(Vec::as_slice)
            .unwrap_or_default();
        let blocks = blocks(&text(README))
            .into_iter()
            .filter(|block| is_claim(block));
        let open = blocks.filter(|block| !readme.iter().any(|one| block.contains(&one.claim)));
        wrong.extend(open.map(|block| format!("{README} has no entry for: {block}")));
        wrong
    }

    fn page(&self) -> String {
        let counts = KINDS.map(|kind| {
            let count = self.all().filter(|(_, claim)| claim.shown == kind).count();
            format!("{count} {kind}")
        });
        let stated = self
            .all()
            .filter(|(_, claim)| claim.important && claim.shown == KINDS[4]);
        let stated = stated.map(|(page, claim)| format!("- \"{}\" ({page})\n", claim.claim));
        let trusted = self
            .trusted
            .iter()
            .map(|(key, words)| format!("- **{key}** ({}): {words}\n", self.trusting(key)));
        let pages = self.pages.iter().map(|(page, claims)| {
            let mut table =
                format!("\n## {page}\n\n| claim | shown | by | trusts |\n|---|---|---|---|\n");
            for Claim {
                claim,
                shown,
                by,
                trusts,
                ..
            } in claims
            {
                let by: Vec<String> = by.iter().map(|by| linked(by)).collect();
                let (claim, by, trusts) =
                    (claim.replace('|', "\\|"), by.join(", "), trusts.join(", "));
                table += &format!("| {claim} | {shown} | {by} | {trusts} |\n");
            }
            table
        });
        format!(
            include_str!("../claims/page.txt"),
            count = self.all().count(),
            counts = counts.join(", "),
            stated = stated.collect::<String>(),
            trusted = trusted.collect::<String>(),
            pages = pages.collect::<String>(),
        )
    }
}

/// What shows a claim, as a page of docs/ names it.
fn linked(by: &str) -> String {
    match (by.strip_prefix("docs/"), by.strip_prefix("step ")) {
        (Some(page), _) => format!("[{page}]({page})"),
        (_, Some(step)) => format!("step `{step}`"),
        _ if by.contains('.') => format!("[{by}](../{by})"),
        _ => format!("`{by}`"),
    }
}

/// The words of a text with one blank between them.
fn joined(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The paragraphs, the items of lists and the tables of a page, without headings, pictures and code.
fn blocks(page: &str) -> Vec<String> {
    let (mut blocks, mut is_code) = (vec![String::new()], false);
    for line in page.lines() {
        let is_fence = line.starts_with("```");
        is_code ^= is_fence;
        let is_left_out = is_code || is_fence || line.starts_with(['#', '!', '<']);
        let is_item = line.starts_with("- ") || line.get(1..3) == Some(". ");
        if is_left_out || is_item || line.is_empty() {
            blocks.push(String::new());
        }
        if !is_left_out {
            let begun = blocks.pop().unwrap_or_default();
            blocks.push(joined(&format!("{begun} {line}")));
        }
    }
    blocks
}

fn is_claim(block: &str) -> bool {
    let mut words = block.split(|c: char| !(c.is_alphanumeric() || c == '_'));
    words.any(|word| {
        let has_digit = word.contains(|c: char| c.is_ascii_digit());
        has_digit || CLAIMING.contains(&&*word.to_lowercase())
    })
}

#[test]
fn every_entry_holds_and_the_page_has_them() {
    let ledger = Ledger::read();
    assert_eq!(ledger.wrong(&Repository::read()), Vec::<String>::new());
    let (path, page) = (root().join(PAGE), ledger.page());
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        std::fs::write(path, page).expect("the page is written");
    } else {
        assert!(
            text(PAGE) == page,
            "{PAGE} is out of date: `cargo xtask claims` rewrites it"
        );
    }
}

#[test]
fn blocks_with_figures_or_absolute_words_are_claims() {
    let page = "# A 1\n\nTwo\nlines.\n- No heap.\n- `no_std`\n1. x\n\n```c\nint a1;\n```\n| a |\n|---|\n| 5 |\n<!-- 7 -->\n";
    let mut claims = blocks(page);
    claims.retain(|block| is_claim(block));
    assert_eq!(claims, ["- No heap.", "1. x", "| a | |---| | 5 |"]);
}

#[test]
fn an_entry_that_does_not_hold_is_found() {
    let repository = Repository::read();
    let found = |change: &dyn Fn(&mut Claim)| {
        let mut ledger = Ledger::read();
        let claims = ledger.pages.get_mut(README).expect("its entries");
        let mut claim = claims
            .iter()
            .find(|one| one.shown == "tested")
            .expect("one")
            .clone();
        change(&mut claim);
        claims.push(claim);
        ledger.wrong(&repository).join("\n")
    };
    assert_eq!(found(&|_| {}), "");
    assert!(found(&|one| one.claim = "Lose it".into()).ends_with("does not say so"));
    for by in ["step write_me", "an_untested_claim", "docs/nothing.md"] {
        assert!(found(&|one| one.by.push(by.into())).ends_with(&format!("there is no {by}")));
    }
    assert!(found(&|one| one.trusts.push("luck".into())).ends_with("has no luck"));
    assert!(found(&|one| one.trusts.clear()).ends_with("all else has both"));
    assert!(found(&|one| one.shown = "believed".into()).ends_with("no way to show a claim"));
    let mut ledger = Ledger::read();
    ledger.pages.retain(|page, _| page.ends_with("faq.md"));
    let wrong = ledger.wrong(&repository).join("\n");
    for what in [
        "faults.md has no entry",
        "README.md has no entry for",
        "no claim trusts toppra",
    ] {
        assert!(wrong.contains(what), "{what}: {wrong}");
    }
}
