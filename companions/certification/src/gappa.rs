//! The proof over one part of the box as a script for Gappa, which checks it without knowing of
//! this crate.
//!
//! Gappa (de Dinechin, Lauter, Melquiond, 2011) proves intervals of expressions with rounded
//! operations. Its own way to an error of the result, forward along the operations, loses what the
//! adjoints keep: that errors cancel. So the script is a chain of small statements: for each
//! instruction the range of its result and the size of its rounding error, for each value the range
//! of its adjoint, and at last the sum. Each takes the ranges of what it uses as given, and is
//! given by those before it. Two things are left to trust: the mean value theorem that joins the
//! statements, and that the instructions are those of the program.

use std::collections::BTreeSet;
use std::io::Write as _;
use std::process::{Command, Stdio};

use crate::bound::Bounder;
use crate::error::{Error, Result};
use crate::forms::Sum;
use crate::graph::Node;
use crate::interval::Interval;

/// A number of f64 as Gappa reads it exactly: an integer times a power of two.
fn exact(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let bits = x.abs().to_bits();
    let exponent = (bits >> 52) as i32;
    let mantissa = bits & ((1 << 52) - 1) | if exponent > 0 { 1 << 52 } else { 0 };
    let sign = if x < 0.0 { "-" } else { "" };
    format!("{sign}{mantissa}b{}", exponent.max(1) - 1075)
}

fn range(of: &str, x: Interval) -> String {
    format!("{of} in [{},{}]", exact(x.low), exact(x.high))
}

/// The statements of a part of the box.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Script {
    /// The ranges that are given: inputs and literals by what they are, results by the statements
    /// before.
    pub given: Vec<String>,
    /// The statements that are to be proven.
    pub proven: Vec<String>,
}

/// The script of what a bounder has just computed.
pub fn script(bounder: &Bounder) -> Script {
    let graph = bounder.graph();
    let mut script = Script::default();
    for (k, node) in graph.nodes.iter().enumerate() {
        let v = format!("v{k}");
        let (operation, rounds) = match *node {
            Node::Input(_) | Node::Literal(_) => (None, false),
            Node::Div(a, b) => (Some(format!("v{a} / v{b}")), true),
            Node::Sqrt(a) => (Some(format!("sqrt(v{a})")), true),
            // Its error was found by trying every number, as that of a sine.
            Node::InverseRoot(a, _) => (Some(format!("1 / sqrt(v{a}) + e{k}")), false),
            Node::Neg(a) => (Some(format!("-v{a}")), false),
            Node::Abs(a) => (Some(format!("|v{a}|")), false),
            Node::Add(a, b) => (Some(format!("v{a} + v{b}")), true),
            Node::Sub(a, b) => (Some(format!("v{a} - v{b}")), true),
            Node::Mul(a, b) => (Some(format!("v{a} * v{b}")), true),
        };
        let error = bounder.errors[k];
        if let Node::Abs(_) = node {
            let slope = range(&format!("s{k}"), Interval::new(-1.0, 1.0));
            script.given.push(slope);
        }
        script.given.push(range(&v, bounder.values[k]));
        script.given.push(range(&format!("w{k}"), bounder.adjoints[k]));
        if error > 0.0 {
            script.given.push(range(&format!("e{k}"), Interval::new(-error, error)));
        }
        if let Node::Literal(x) = *node {
            script.proven.push(range(&format!("{} + e{k}", exact(x.into())), bounder.values[k]));
            if error == 0.0 {
                script.proven.pop();
            }
        }
        let Some(operation) = operation else { continue };
        if rounds {
            script.proven.push(range(&format!("r({operation})"), bounder.values[k]));
            let rounding = format!("r({operation}) - ({operation})");
            script.proven.push(range(&rounding, Interval::new(-error, error)));
        } else {
            script.proven.push(range(&format!("({operation})"), bounder.values[k]));
        }
    }
    for k in 0..graph.nodes.len() {
        let form = bounder.adjoint_form(k);
        let mut terms = Vec::new();
        if !form.plain.is_empty() {
            terms.push(weighted(&form.plain));
        }
        terms.extend(
            form.scaled.iter().map(|(value, sum)| format!("v{value} * ({})", weighted(sum))),
        );
        terms.extend(form.steep.iter().map(|steep| slope(graph.nodes[steep.0], *steep)));
        // The output's own adjoint is one, by its range.
        if !terms.is_empty() {
            script.proven.push(range(&format!("({})", terms.join(" + ")), bounder.adjoints[k]));
        }
    }
    script
}

/// The adjoint of a quotient or root times its derivative by an operand.
fn slope(node: Node, (k, operand): (usize, usize)) -> String {
    match (node, operand) {
        (Node::Div(_, b), 0) => format!("w{k} / v{b}"),
        (Node::Div(a, b), _) => format!("(-w{k}) * ((v{a} / v{b}) / v{b})"),
        (Node::Abs(_), _) => format!("w{k} * s{k}"),
        (Node::Sqrt(a), _) => format!("w{k} / (2 * sqrt(v{a}))"),
        (Node::InverseRoot(a, _), _) => format!("(-w{k}) / (2 * (v{a} * sqrt(v{a})))"),
        _ => "0".to_owned(),
    }
}

/// A sum of adjoints with their factors.
fn weighted(sum: &Sum) -> String {
    let term = |(k, factor): &(usize, f64)| match *factor {
        1.0 => format!("w{k}"),
        -1.0 => format!("(-w{k})"),
        factor => format!("({} * w{k})", exact(factor)),
    };
    sum.iter().map(term).collect::<Vec<_>>().join(" + ")
}

impl Script {
    /// With the bound of the whole error as the last statement.
    #[must_use]
    pub fn bounded(mut self, bounder: &Bounder, bound: f64) -> Self {
        let errors = (0..bounder.errors.len()).filter(|k| bounder.errors[*k] > 0.0);
        let terms: Vec<String> = errors.map(|k| format!("e{k} * w{k}")).collect();
        if !terms.is_empty() {
            self.proven
                .push(range(&format!("({})", terms.join(" + ")), Interval::new(-bound, bound)));
        }
        self
    }

    /// The text of some statements, with the ranges of what they name.
    fn text(&self, proven: &[String]) -> String {
        let names: BTreeSet<&str> =
            proven.iter().flat_map(|one| one.split(|c: char| !c.is_ascii_alphanumeric())).collect();
        let named =
            |given: &&String| given.split(' ').next().is_some_and(|name| names.contains(name));
        let given: Vec<&str> = self.given.iter().filter(named).map(String::as_str).collect();
        let arrow = if given.is_empty() { "" } else { "\n->\n" };
        format!(
            "@r = float<ieee_32, ne>;\n{{\n{}{arrow}{}\n}}\n",
            given.join(" /\\\n"),
            proven.join(" /\\\n")
        )
    }

    /// The scripts: some tens of statements each, since Gappa's time grows with their square.
    pub fn texts(&self) -> impl Iterator<Item = String> {
        self.proven.chunks(BLOCK).map(|block| self.text(block))
    }

    /// Whether Gappa proves all of them.
    ///
    /// # Errors
    /// [`Error::Program`] if Gappa cannot be started.
    pub fn is_proven(&self) -> Result<bool> {
        for text in self.texts() {
            if !is_accepted(&text)? {
                return Ok(false);
            }
        }
        Ok(!self.proven.is_empty())
    }
}

/// The number of statements in a script.
const BLOCK: usize = 40;

fn is_accepted(text: &str) -> Result<bool> {
    Ok(run(&[], text)?.is_some())
}

/// Gappa's proof of a text's statements for Coq; `None` if it has none.
///
/// # Errors
/// [`Error::Program`] if Gappa cannot be started.
pub fn proof(text: &str) -> Result<Option<String>> {
    run(&["-Bcoq"], text)
}

/// The output of Gappa for a text that it accepts.
fn run(options: &[&str], text: &str) -> Result<Option<String>> {
    let mut gappa = Command::new("gappa")
        .args(options)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .map_err(failed("gappa"))?;
    let written = gappa.stdin.take().map_or(Ok(()), |mut stdin| stdin.write_all(text.as_bytes()));
    let output = gappa.wait_with_output().map_err(failed("gappa"))?;
    // One that stops reading has refused what it read.
    let is_accepted = written.is_ok() && output.status.success();
    Ok(is_accepted.then(|| String::from_utf8_lossy(&output.stdout).into_owned()))
}

fn failed(program: &'static str) -> impl Fn(std::io::Error) -> Error {
    move |e| Error::Program { program: program.to_owned(), said: e.to_string() }
}

/// Whether Coq, with Flocq's theory of floating-point numbers, accepts a proof of Gappa's.
///
/// # Errors
/// [`Error::Program`] if Coq cannot be started, [`Error::File`].
pub fn is_checked_by_coq(proof: &str) -> Result<bool> {
    let folder = tempfile::tempdir().map_err(failed("coqc"))?;
    crate::program::write(&folder.path().join("part.v"), proof)?;
    let mut coq = Command::new("coqc");
    coq.arg("part.v").current_dir(folder.path());
    let status = coq.stdout(Stdio::null()).stderr(Stdio::null()).status();
    status.map(|status| status.success()).map_err(failed("coqc"))
}

/// A proof for Coq in which the greatest rounding error of one operation is said to be half of what
/// it is.
pub fn corrupted(proof: &str) -> Option<String> {
    // The statement is BND(round(a op b) - (a op b), interval): first the interval's name, then its
    // ends.
    let statement = proof.lines().find(|line| {
        line.starts_with("Notation") && line.contains("BND(float<") && line.contains(" - ")
    })?;
    let interval = statement.split(')').next()?.rsplit(' ').next()?;
    let ends = proof
        .lines()
        .find_map(|line| line.strip_prefix(&format!("Definition {interval} := makepairF ")))?;
    let mut wrong = proof.to_owned();
    for end in ends.trim_end_matches('.').split(' ') {
        let start = wrong.find(&format!("Definition {end} := Float2 ("))?;
        let line = wrong.get(start..)?.lines().next()?.to_owned();
        let (before, power) = line.rsplit_once('(')?;
        let power: i32 = power.trim_end_matches(").").parse().ok()?;
        wrong = wrong.replacen(&line, &format!("{before}({}).", power - 1), 1);
    }
    Some(wrong)
}
