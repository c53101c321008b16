//! Checks of the page against today's machine code.

use sha2::{Digest, Sha256};

use crate::digits;
use crate::error::{Error, Result};
use crate::function::{Function, expression};
use crate::image::{Image, hexadecimal};

/// A part of the page, between its marks, or the record of configurations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Part {
    /// The proven errors of torques.
    Certificates,
    /// Those of the robot with a kinematic loop.
    Clusters,
    /// The record docs/accuracy-proven.json.
    Configurations,
}

/// The page with a part replaced.
///
/// # Errors
/// [`Error::Missing`] if the page has no place for it.
pub fn page(written: &str, part: Part, text: &str) -> Result<String> {
    let (name, begin, end) = markers(part);
    let missing = || Error::Missing(format!("place for {name} on the page"));
    let (before, rest) = written.split_once(&begin).ok_or_else(missing)?;
    let (_, after) = rest.split_once(&end).ok_or_else(missing)?;
    let block = format!("<!-- written by `certify --write`: do not edit -->\n{text}");
    Ok(format!("{before}{begin}{}{end}{after}", sealed(&block)))
}

/// The name of a part, and what stands before and after it on the page.
fn markers(part: Part) -> (String, String, String) {
    let name = clap::ValueEnum::to_possible_value(&part);
    let name = name.as_ref().map_or("", |name| name.get_name());
    let marker = |which| format!("<!-- {name}:{which} -->");
    (name.to_owned(), marker("begin") + "\n", marker("end"))
}

/// A block of the page with the sum of its text at its end.
fn sealed(block: &str) -> String {
    let block = block.trim();
    let sum = &hexadecimal(Sha256::new_with_prefix(block))[..16];
    format!("{block}\n{BEFORE_SUM}{sum} -->\n")
}

/// A block without its sum.
fn unsealed(block: &str) -> &str {
    block.rsplit_once(BEFORE_SUM).map_or(block, |(block, _)| block)
}

const BEFORE_SUM: &str = "<!-- sum of the above: ";

/// Fails unless each block of the page is as it was written and has no bound below what was
/// observed.
///
/// # Errors
/// [`Error::Page`], with the row.
pub fn numbers(page: &str) -> Result<()> {
    for part in [Part::Certificates, Part::Clusters] {
        let (name, begin, end) = markers(part);
        let block = page.split_once(&begin).and_then(|(_, rest)| rest.split_once(&end));
        let Some((block, _)) = block else {
            return Err(Error::Missing(format!("place for {name} on the page")));
        };
        let rows = block.lines().filter(|line| line.starts_with("| "));
        let mut head: Vec<&str> = Vec::new();
        for row in rows {
            let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
            if cells.first().is_some_and(|cell| cell.parse::<f64>().is_err()) {
                head = cells;
                continue;
            }
            // A bound is left of what was observed or found.
            let is_observed = |at: &usize| head.get(*at) == Some(&"worst observed");
            for at in (1..cells.len()).filter(is_observed) {
                let [bound, observed] = [at - 1, at].map(|at| digits::number(cells[at]));
                if bound.is_none_or(|bound| observed.is_none_or(|observed| bound < observed)) {
                    return Err(Error::Page(format!(
                        "{name}: a bound below what was observed: {row}"
                    )));
                }
            }
        }
        if block.trim() != sealed(unsealed(block)).trim() {
            return Err(Error::Page(format!("{name}: a number was changed: its sum is another")));
        }
    }
    Ok(())
}

/// Fails unless the certificates of these functions of a program have their hashes on the page.
///
/// # Errors
/// [`Error::Stale`], [`Error::Missing`] of a function that the program does not have.
pub fn hashes(image: &Image, functions: &[Function], robot: &str, page: &str) -> Result<()> {
    for function in functions {
        let hash = image.hash(&expression(image, *function)?.visited);
        hash_of(page, robot, *function, &hash)?;
    }
    Ok(())
}

/// Fails unless the certificate of this robot and function names this machine code.
///
/// # Errors
/// [`Error::Stale`].
pub fn hash_of(page: &str, robot: &str, function: Function, hash: &str) -> Result<()> {
    let heading = format!("### {robot}: {}\n", function.name());
    let certificate = page.split_once(&heading).map(|(_, rest)| rest);
    let certificate = certificate.and_then(|rest| rest.split("\n### ").next());
    match certificate {
        Some(text) if text.contains(&format!("machine code `{hash}`")) => Ok(()),
        _ => {
            let what = format!("the certificate of {robot}, {},", function.name());
            Err(Error::Stale(what))
        }
    }
}
