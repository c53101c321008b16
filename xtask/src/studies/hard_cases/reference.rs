//! The reference part of the page: for each case a paragraph, and a table of what was measured.
//!
//! The tables have no outer bars, and what several rows have in common stands once above them: the
//! page is long even so.

use super::{Case, Row, Suite};

const HEAD: &str = "quantity | f32 (bound) | f64 (bound)\n--- | ---: | ---:\n";

/// The beginning of the oracles of most cases, which the page names once.
const USUAL_ORACLE: &str = "computation in 50 digits from the same";

/// Forms of an algorithm, whose names stand before a quantity.
const FORMS: [&str; 2] = ["clusters", "engine"];

/// Fewer rows are not worth a heading.
const GROUPED: usize = 3;

/// A row of a case's table: a quantity, κ, and its figures in f32 and in f64.
struct Line {
    quantity: String,
    condition: Option<f64>,
    figures: [String; 2],
    is_naive: bool,
}

pub fn text(suite: &Suite) -> String {
    let cases = suite.cases.iter().map(|case| {
        let Case { number, name, .. } = case;
        let (paragraph, mut lines) = (paragraph(case), lines(suite, *number));
        let condition = common(&lines);
        let condition = condition.map_or(String::new(), |k| format!(" κ is {k}."));
        if !condition.is_empty() {
            lines.iter_mut().for_each(|line| line.condition = None);
        }
        let table = table(&lines);
        format!(
            "\n<a id=\"case-{number}\"></a>\n\n### {number}. {name}\n\n\
             {paragraph}{condition}\n\n{HEAD}{table}"
        )
    });
    // A case has as many arms or linkages there as it needs.
    let mut qemu = suite.in_qemu.clone();
    qemu.dedup();
    let qemu = qemu.iter().map(u32::to_string);
    format!(
        "\nIn QEMU every algorithm gives the same bits in f32 in the cases {}.\n{}",
        qemu.collect::<Vec<_>>().join(", "),
        cases.collect::<String>().trim_end()
    )
}

fn paragraph(case: &Case) -> String {
    let mut letters = case.parameters.chars();
    let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
    let oracle = match case.oracle.starts_with(USUAL_ORACLE) {
        true => String::new(),
        false => format!(" Oracle: {}.", case.oracle),
    };
    let (rest, source, reason) = (letters.as_str(), &case.source, &case.reason);
    format!("{first}{rest}. Source: {source}.{oracle} Bound: {reason}.")
}

/// κ, if all rows that have one have the same.
fn common(lines: &[Line]) -> Option<String> {
    let mut all = lines.iter().filter_map(Line::condition);
    let first = all.next()?;
    all.all(|other| other == first).then_some(first)
}

fn lines(suite: &Suite, number: u32) -> Vec<Line> {
    let mut lines: Vec<Line> = Vec::new();
    for row in suite.rows.iter().filter(|row| row.number == number) {
        let name = row.name();
        let known = lines.iter().position(|line| line.quantity == name);
        let at = known.unwrap_or_else(|| {
            lines.push(Line {
                quantity: name,
                condition: row.condition,
                figures: Default::default(),
                is_naive: row.verdict == "shown",
            });
            lines.len() - 1
        });
        lines[at].figures[usize::from(row.scalar == "f64")] = row.figures();
    }
    with_claims(lines)
}

/// A claim about a quantity in one scalar takes the place of the figure that it has in the other
/// one alone.
fn with_claims(lines: Vec<Line>) -> Vec<Line> {
    let mut kept: Vec<Line> = Vec::new();
    let mut claims: Vec<Line> = Vec::new();
    let quantities: Vec<String> = lines.iter().map(|line| line.quantity.clone()).collect();
    for line in lines {
        let of = line.quantity.rsplit_once(": ").map(|(of, _)| of);
        match of.is_some_and(|of| quantities.iter().any(|known| known == of)) {
            true => claims.push(line),
            false => kept.push(line),
        }
    }
    for claim in claims {
        let (of, words) = claim.quantity.rsplit_once(": ").unwrap_or_default();
        let place = kept.iter().position(|line| line.quantity == of);
        let fits = |line: &Line| {
            let mut pairs = line.figures.iter().zip(&claim.figures);
            pairs.all(|(own, said)| said.is_empty() || (own.is_empty() && said == HOLDS))
        };
        match place {
            Some(at) if fits(&kept[at]) => {
                for (own, said) in kept[at].figures.iter_mut().zip(&claim.figures) {
                    if !said.is_empty() {
                        *own = words.into();
                    }
                }
            }
            Some(at) => kept.insert(at + 1, claim),
            None => kept.push(claim),
        }
    }
    kept
}

/// An error of zero where the bound is zero.
const HOLDS: &str = "holds";

impl Row {
    /// The quantity, with what is to be seen of it.
    fn name(&self) -> String {
        let quantity = &self.quantity;
        match &*self.verdict {
            "fail" => format!("**fails**: {quantity}"),
            "shown" if !quantity.starts_with("naive") => format!("naive: {quantity}"),
            _ => quantity.clone(),
        }
    }

    fn figures(&self) -> String {
        match (self.error, self.bound) {
            (Some(0.0), Some(0.0)) => HOLDS.into(),
            (error, bound) => {
                let (error, bound) = (figure(error, "no number"), figure(bound, "none"));
                format!("{error} ({bound})")
            }
        }
    }
}

impl Line {
    fn condition(&self) -> Option<String> {
        self.condition.map(|k| format!("{k:.1e}"))
    }

    /// The parts that this row may have in common with others, each with the rest of the quantity.
    fn parts(&self) -> Vec<(&str, String)> {
        if self.is_naive {
            return Vec::new();
        }
        let prefix = split(&self.quantity, ": ");
        let prefix = prefix.filter(|(first, _)| !FORMS.contains(first) && !first.contains(", "));
        let suffix = split(&self.quantity, ", ").filter(|(what, _)| {
            let form = what.split_once(": ");
            form.is_none_or(|(form, _)| FORMS.contains(&form))
        });
        let suffix = suffix.map(|(what, common)| match common.split_once(": ") {
            Some((common, claim)) => (common, format!("{what}: {claim}")),
            None => (common, what.to_owned()),
        });
        let prefix = prefix.map(|(first, rest)| (first, rest.to_owned()));
        prefix.into_iter().chain(suffix).collect()
    }

    /// The quantity without what it has in common with others, if it has that.
    fn without(&self, common: &str) -> Option<String> {
        let mut parts = self.parts().into_iter();
        parts.find_map(|(own, rest)| (own == common).then_some(rest))
    }

    fn written(&self, quantity: &str) -> String {
        let condition = self.condition().map(|k| format!(", κ {k}"));
        let (condition, [single, double]) = (condition.unwrap_or_default(), &self.figures);
        format!("{quantity}{condition} | {single} | {double}\n")
    }
}

/// The text before and after a mark that stands in no brackets.
fn split<'a>(text: &'a str, mark: &str) -> Option<(&'a str, &'a str)> {
    let outside = |at: usize| text[..at].matches('(').count() == text[..at].matches(')').count();
    let mut places = text.match_indices(mark).map(|(at, _)| at);
    let at = places.find(|at| outside(*at))?;
    Some((&text[..at], &text[at + mark.len()..]))
}

fn table(lines: &[Line]) -> String {
    let mut text = String::new();
    let measured = lines.iter().filter(|line| !line.is_naive).count();
    let mut rest = lines;
    while let [first, after @ ..] = rest {
        let run = |common: &str| {
            let with = rest.iter().take_while(|line| line.without(common).is_some());
            with.count()
        };
        let parts = first.parts().into_iter();
        let runs = parts.map(|(common, _)| (run(common), common));
        let longest = runs.filter(|(count, _)| *count >= GROUPED).max();
        let Some((count, common)) = longest else {
            text += &first.written(&first.quantity);
            rest = after;
            continue;
        };
        if count < measured {
            text += &format!("*{common}* | |\n");
        }
        for line in &rest[..count] {
            text += &line.written(&line.without(common).unwrap_or_default());
        }
        rest = &rest[count..];
    }
    text
}

fn figure(x: Option<f64>, none: &str) -> String {
    match x {
        None => none.into(),
        Some(0.0) => "0".into(),
        Some(x) => format!("{x:.1e}"),
    }
}
