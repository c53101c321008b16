//! The tolerance of another compiler's figures against the written ones, by the kind of their column.

use crate::kit::bars::OTHER_RUSTC;

use super::{MEASURED, NO_LINE};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// A number that nothing measured: of joints, of bodies, of a bound.
    Exact,
    /// Instructions, cycles, bytes: what budgets allow another compiler.
    Cost,
    /// One cost as a multiple of another one.
    Ratio,
    /// An error, in whatever unit.
    Error,
}

/// What errors may differ by, as a share: f32 gives the same bits with every compiler, so that only what a page
/// says of the compiler's own choices, such as the order of a sum in a simulated plant, is left.
const OTHER_ERROR: f64 = 0.1;

/// What headings say of their columns, the first that is found in them; a column whose heading says nothing is of
/// the kind of the one before it.
#[rustfmt::skip]
const HEADINGS: [(Kind, &[&str]); 4] = [
    (Kind::Exact, &["bound", "at most", "bodies", "joints", "no.", "safety gate"]),
    (Kind::Ratio, &[" / ", "of floor", "of default's"]),
    (Kind::Error, &["error", "N·m", "rad", "99 %", "RMS", "of full scale", "drift", "joint "]),
    (Kind::Cost, &[
        "insn", "instructions", "cycles", "tick", "mean", "µs", "flops", "code", "stack", "RAM", "flash", "now",
    ]),
];

impl Kind {
    /// The kind that a heading names, or else that of the column before it.
    fn of(heading: &str, before: Self) -> Self {
        let says = |(_, words): &&(Self, &[&str])| words.iter().any(|word| heading.contains(word));
        HEADINGS.iter().find(says).map_or(before, |(kind, _)| *kind)
    }

    /// The largest allowed distance from a figure.
    fn slack(self, figure: f64) -> f64 {
        let share = match self {
            Self::Exact => 0.0,
            Self::Cost => OTHER_RUSTC,
            // Each of the two costs may move.
            Self::Ratio => 2.0 * OTHER_RUSTC,
            Self::Error => OTHER_ERROR,
        };
        share * figure.abs()
    }
}

/// The first lines of two texts that are not alike: but for padding, the compiler, and figures as far as their
/// columns allow. A figure in a sentence is a cost.
pub fn first_difference<'a>(old: &'a str, new: &'a str) -> Option<(&'a str, &'a str)> {
    let (mut old, mut new) = (lines(old), lines(new));
    let mut kinds: Option<Vec<Kind>> = None;
    loop {
        let (a, b) = match (old.next(), new.next()) {
            (None, None) => return None,
            (Some(a), Some(b)) => (a, b),
            (a, b) => return Some((a.unwrap_or(NO_LINE), b.unwrap_or(NO_LINE))),
        };
        let same = match (cells(a), cells(b), &kinds) {
            (None, None, _) => {
                kinds = None;
                words_alike(a, b, Kind::Cost)
            }
            // Headings are words.
            (Some(heads), Some(b), None) => {
                kinds = Some(of_headings(&heads));
                heads == b
            }
            (Some(a), Some(b), Some(kinds)) => a.len() == b.len() && rows_alike(&a, &b, kinds),
            _ => false,
        };
        if !same {
            return Some((a, b));
        }
    }
}

fn rows_alike(old: &[&str], new: &[&str], kinds: &[Kind]) -> bool {
    let mut pairs = std::iter::zip(old, new).enumerate();
    pairs.all(|(column, (a, b))| match kinds.get(column) {
        _ if is_rule(a) && is_rule(b) => true,
        Some(kind) => words_alike(a, b, *kind),
        None => a == b,
    })
}

/// The lines that say something, up to the name of the compiler.
fn lines(text: &str) -> impl Iterator<Item = &str> {
    text.lines()
        .map(|line| {
            let end = line.find(MEASURED).map(|at| at + MEASURED.len());
            line[..end.unwrap_or(line.len())].trim()
        })
        .filter(|line| !line.is_empty())
}

/// The cells of a line of a table.
pub fn cells(line: &str) -> Option<Vec<&str>> {
    let inside = line.strip_prefix('|')?.strip_suffix('|')?;
    Some(inside.split('|').map(str::trim).collect())
}

/// Whether it is a piece of the rule under the headings, which is as long as figures are wide.
fn is_rule(cell: &str) -> bool {
    cell.starts_with("--") && cell.trim_matches(['-', ':']).is_empty()
}

fn of_headings(headings: &[&str]) -> Vec<Kind> {
    let kinds = headings.iter().scan(Kind::Exact, |before, heading| {
        *before = Kind::of(heading, *before);
        Some(*before)
    });
    kinds.collect()
}

/// Whether two cells or sentences are alike, word for word.
fn words_alike(old: &str, new: &str, kind: Kind) -> bool {
    let trimmed = |word| str::trim_matches(word, ['(', ')', ',', '.', '*']);
    let words = |text| -> Vec<&str> { str::split_whitespace(text).map(trimmed).collect() };
    let (old, new) = (words(old), words(new));
    let is_share = |at: usize| old.get(at + 1).is_some_and(|word| *word == "%");
    let mut pairs = std::iter::zip(&old, &new).enumerate();
    old.len() == new.len()
        && pairs.all(|(at, (old, new))| old == new || figures_alike(old, new, kind, is_share(at)))
}

/// Whether two words are figures that are close.
fn figures_alike(old: &str, new: &str, kind: Kind, is_share: bool) -> bool {
    let figure = |word: &str| -> Option<f64> {
        let plain = word.trim_end_matches('×').replace(',', "");
        plain.replace('−', "-").parse().ok()
    };
    let (Some(from), Some(to)) = (figure(old), figure(new)) else {
        return false;
    };
    let allowed = match kind {
        // A share of the tick, printed to a tenth of a per cent, moves by more than itself.
        _ if is_share => Kind::Cost.slack(from) + last_place(old),
        // A multiple is one, whatever the column.
        Kind::Cost if old.ends_with('×') => Kind::Ratio.slack(from),
        _ => kind.slack(from),
    };
    (from - to).abs() <= allowed
}

/// The value of one unit in the last printed place of a figure.
fn last_place(figure: &str) -> f64 {
    let places = figure.split_once('.').map_or(0, |(_, after)| after.len());
    0.1_f64.powi(i32::try_from(places).unwrap_or(0))
}
