//! `cargo xtask claims`: the claims of README and guide, how each is shown, by what, and what that trusts.
//!
//! The entries are in the files of `claims/`, those of a page in a table of its path.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use crate::kit::error::{Error, Result, check};
use crate::kit::sources::sources;
use crate::kit::workspace::{self, Workspace};
use crate::studies::STUDIES;
use crate::studies::study::{Bench, Found};

const FOLDER: &str = "xtask/src/studies/claims";
/// The table of the steps of the tests, which is read as text: a study knows no command.
const STEPS: &str = "xtask/src/commands/test/mod.rs";
const README: &str = "README.md";
const GUIDE: &str = "docs/guide/src";
/// A paragraph, an item or a table of the README with one of these words, or with a digit, makes a claim.
const CLAIMING: [&str; 5] = ["never", "no", "every", "always", "all"];

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
enum Shown {
    Proven,
    Enumerated,
    Measured,
    Tested,
    Stated,
}

const KINDS: [(Shown, &str); 5] = [
    (Shown::Proven, "proven"),
    (Shown::Enumerated, "enumerated"),
    (Shown::Measured, "measured"),
    (Shown::Tested, "tested"),
    (Shown::Stated, "stated"),
];

#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Claim {
    /// Words of the page.
    claim: String,
    shown: Shown,
    /// Names of tests, `step NAME`, or paths of files.
    #[serde(default)]
    by: Vec<String>,
    /// Keys of `trusted.toml`.
    #[serde(default)]
    trusts: Vec<String>,
    /// Whether the page says so above the tables if it is only stated.
    #[serde(default)]
    important: bool,
}

type Pages = BTreeMap<String, Vec<Claim>>;

struct Ledger {
    pages: Pages,
    /// What a proof, a measurement or a test trusts, in words.
    trusted: BTreeMap<String, String>,
}

pub fn measure(bench: &Bench<'_>) -> Result<Found> {
    let ledger = Ledger::read(bench.workspace)?;
    let wrong = ledger.wrong(bench.workspace)?;
    Ok(Found {
        wrong,
        summary: ledger.counts(),
        ..Found::new(ledger.markdown(), &ledger.pages)?
    })
}

impl Ledger {
    fn read(workspace: &Workspace) -> Result<Self> {
        let folder = workspace.root.join(FOLDER);
        let (mut pages, mut trusted) = (Pages::new(), BTreeMap::new());
        for entry in std::fs::read_dir(&folder)
            .map_err(Error::file("read", &folder))?
            .flatten()
        {
            let (path, wrong) = (entry.path(), |e| check!("{}: {e}", entry.path().display()));
            match path.file_name().and_then(|name| name.to_str()) {
                Some("trusted.toml") => {
                    trusted = toml_edit::de::from_str(&workspace::read(&path)?).map_err(wrong)?;
                }
                Some(name) if name.ends_with(".toml") => {
                    let more: Pages =
                        toml_edit::de::from_str(&workspace::read(&path)?).map_err(wrong)?;
                    pages.extend(more);
                }
                _ => {}
            }
        }
        Ok(Self { pages, trusted })
    }

    /// What does not hold of the entries.
    fn wrong(&self, workspace: &Workspace) -> Result<Vec<String>> {
        let (root, mut wrong) = (&workspace.root, Vec::new());
        let mut tests = BTreeSet::new();
        for path in sources(root)? {
            let text = workspace::read(&path)?;
            let after = text.split("#[test]").skip(1);
            let names = after.filter_map(|rest| rest.split_once("fn ")?.1.split_once('('));
            tests.extend(names.map(|(name, _)| name.to_owned()));
        }
        let steps = workspace::read(&root.join(STEPS))?;
        let is_step = |name: &str| {
            steps.contains(&format!("    (\"{name}\", "))
                || STUDIES.iter().any(|study| study.name == name)
        };
        let exists = |by: &String| match by.strip_prefix("step ") {
            Some(step) => is_step(step),
            None => tests.contains(by) || by.contains('.') && root.join(by).is_file(),
        };
        for (page, claims) in &self.pages {
            let text = joined(&workspace::read(&root.join(page))?);
            for claim in claims {
                let of = |what: &str| format!("{page}, \"{}\": {what}", claim.claim);
                if !text.contains(&claim.claim) {
                    wrong.push(of("the page does not say so"));
                }
                let missing = claim.by.iter().filter(|by| !exists(by));
                wrong.extend(missing.map(|by| of(&format!("there is no {by}"))));
                let unknown = claim
                    .trusts
                    .iter()
                    .filter(|key| !self.trusted.contains_key(*key));
                wrong.extend(unknown.map(|key| of(&format!("trusted.toml has no {key}"))));
                let is_stated = claim.shown == Shown::Stated;
                if is_stated != claim.by.is_empty() || is_stated != claim.trusts.is_empty() {
                    wrong.push(of(
                        "what is stated has neither `by` nor `trusts`, all else both",
                    ));
                }
            }
        }
        let is_used = |key: &&String| self.all().any(|(_, claim)| claim.trusts.contains(key));
        let idle = self.trusted.keys().filter(|key| !is_used(key));
        wrong.extend(idle.map(|key| format!("no claim trusts {key}")));
        let of_guide =
            std::fs::read_dir(root.join(GUIDE)).map_err(Error::file("read", &root.join(GUIDE)))?;
        let chapters = of_guide
            .flatten()
            .map(|file| format!("{GUIDE}/{}", file.file_name().to_string_lossy()));
        let empty =
            chapters.filter(|page| !page.ends_with("SUMMARY.md") && !self.pages.contains_key(page));
        wrong.extend(empty.map(|page| format!("{page} has no entry")));
        let readme = self
            .pages
            .get(README)
            .map(Vec::as_slice)
            .unwrap_or_default();
        let blocks = blocks(&workspace::read(&root.join(README))?);
        let open = blocks.iter().filter(|block| {
            is_claim(block) && !readme.iter().any(|one| block.contains(&one.claim))
        });
        wrong.extend(open.map(|block| format!("{README} has no entry for: {block}")));
        Ok(wrong)
    }

    fn all(&self) -> impl Iterator<Item = (&String, &Claim)> {
        self.pages
            .iter()
            .flat_map(|(page, claims)| claims.iter().map(move |claim| (page, claim)))
    }

    fn counts(&self) -> String {
        let of = |kind| self.all().filter(|(_, claim)| claim.shown == kind).count();
        let counts = KINDS.map(|(kind, name)| format!("{} {name}", of(kind)));
        format!("{} claims: {}", self.all().count(), counts.join(", "))
    }

    fn markdown(&self) -> String {
        let only = |(page, claim): (&String, &Claim)| format!("- \"{}\" ({page})\n", claim.claim);
        let stated = self
            .all()
            .filter(|(_, claim)| claim.important && claim.shown == Shown::Stated);
        let trusted = self.trusted.iter().map(|(key, words)| {
            let count = self
                .all()
                .filter(|(_, claim)| claim.trusts.contains(key))
                .count();
            format!("- **{key}**, by {count} claims: {words}\n")
        });
        let pages = self.pages.iter().map(|(page, claims)| {
            let mut text =
                format!("\n## {page}\n\n| claim | shown | by | trusts |\n|---|---|---|---|\n");
            for claim in claims {
                let by: Vec<String> = claim.by.iter().map(|by| linked(by)).collect();
                let kind = KINDS
                    .iter()
                    .find(|(kind, _)| *kind == claim.shown)
                    .map_or("", |kind| kind.1);
                let (words, trusts) = (claim.claim.replace('|', "\\|"), claim.trusts.join(", "));
                text += &format!("| {words} | {kind} | {} | {trusts} |\n", by.join(", "));
            }
            text
        });
        format!(
            include_str!("claims/page.md"),
            counts = self.counts(),
            stated = stated.map(only).collect::<String>(),
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
        is_code ^= line.starts_with("```");
        let is_item = line.starts_with("- ") || line.get(1..3) == Some(". ");
        if is_code || line.is_empty() || line.starts_with(['`', '#', '!', '<']) || is_item {
            blocks.push(String::new());
        }
        if !is_code && !line.starts_with(['#', '!', '<']) && !line.starts_with("```") {
            let begun = blocks.pop().unwrap_or_default();
            blocks.push(joined(&format!("{begun} {line}")));
        }
    }
    blocks
}

fn is_claim(block: &str) -> bool {
    let mut words = block.split(|c: char| !(c.is_alphanumeric() || c == '_'));
    words.any(|word| {
        CLAIMING.contains(&&*word.to_lowercase()) || word.contains(|c: char| c.is_ascii_digit())
    })
}

#[cfg(test)]
mod tests {
    use super::{Claim, Ledger, Shown, blocks, is_claim};
    use crate::kit::docs::repository::root;
    use crate::kit::workspace::Workspace;

    #[test]
    fn blocks_with_figures_or_absolute_words_are_claims() {
        let page = "# A 1\n\nTwo\nlines.\n- No heap.\n- `no_std`\n1. x\n\n```c\nint a1;\n```\n| a |\n|---|\n| 5 |\n<!-- 7 -->\n";
        let claims: Vec<String> = blocks(page)
            .into_iter()
            .filter(|block| is_claim(block))
            .collect();
        assert_eq!(claims, ["- No heap.", "1. x", "| a | |---| | 5 |"]);
    }

    #[test]
    fn an_entry_that_does_not_hold_is_found() {
        let workspace = Workspace::at(&root());
        let found = |claim: &str, by: &str, trusts: &str| {
            let mut ledger = Ledger::read(&workspace).expect("the entries");
            let (by, trusts) = (vec![by.into()], vec![trusts.into()]);
            let claim = Claim {
                claim: claim.into(),
                shown: Shown::Tested,
                by,
                trusts,
                important: false,
            };
            ledger
                .pages
                .entry("README.md".into())
                .or_default()
                .push(claim);
            ledger.wrong(&workspace).expect("read").join("\n")
        };
        let right = ("Use it", "step readme", "examples");
        assert_eq!(found(right.0, right.1, right.2), "");
        assert!(found("Lose it", right.1, right.2).ends_with("the page does not say so"));
        for by in ["step write_me", "an_untested_claim", "docs/nothing.md"] {
            assert!(found(right.0, by, right.2).contains("there is no"), "{by}");
        }
        assert!(found(right.0, right.1, "luck").ends_with("trusted.toml has no luck"));
        let mut ledger = Ledger::read(&workspace).expect("the entries");
        ledger.pages.retain(|page, _| page.ends_with("faq.md"));
        let wrong = ledger.wrong(&workspace).expect("read").join("\n");
        assert!(
            wrong.contains("faults.md has no entry")
                && wrong.contains("README.md has no entry for")
        );
    }
}
