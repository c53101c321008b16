//! Configurations in plain words.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde::Deserialize;

use super::point::{Kind, Point};
use crate::table::thousands;

/// A value on an axis: see the file, whose keys are those of the firmware.
#[derive(Default, Deserialize)]
#[serde(default)]
struct Word {
    rust: Option<String>,
    name: String,
    does: String,
}

/// Words by value by axis.
static WORDS: LazyLock<BTreeMap<String, BTreeMap<String, Word>>> = LazyLock::new(|| {
    let text = include_str!("../../../firmware-demo/src/accuracy/words.toml");
    // The tests read it: it is never empty.
    toml::from_str(text).unwrap_or_default()
});

fn found(axis: &str, value: &str) -> Option<&'static Word> {
    WORDS.get(axis)?.get(value)
}

/// What the library has for the value on an axis; none if it ships nothing of the kind.
pub fn rust(axis: &str, value: &str) -> Option<&'static str> {
    found(axis, value)?.rust.as_deref()
}

/// What it is made of that the default is not: names, and what each does.
fn parts(point: &Point) -> Vec<(String, String)> {
    let owned = |word: &Word| (word.name.clone(), word.does.clone());
    let known = |axis| found(axis, point.on(axis)).map(owned);
    let mut parts = Vec::new();
    if point.kind == Kind::Simulation {
        parts.extend(known("integrator"));
        let step = match point.on("step").parse::<u64>() {
            Ok(us) if us >= 1000 => format!("{} ms", us as f64 / 1000.0),
            _ => format!("{} µs", point.on("step")),
        };
        let phrase = format!("takes steps of {step}");
        parts.push((step, phrase));
    }
    for (axis, value) in point.changes() {
        match (axis, found(axis, value)) {
            ("integrator" | "step" | "scene" | "between", _) => {}
            ("rate", Some(Word { name: nth, .. })) => {
                let (name, does) = known("between").unwrap_or_default();
                let does = format!("computes in {nth} only and {does}");
                parts.push((format!("{nth}, {name}"), does));
            }
            (_, Some(word)) => parts.push(owned(word)),
            (_, None) => parts.push((format!("{axis} {value}"), format!("has {axis} {value}"))),
        }
    }
    parts
}

/// A short name, for a plot.
pub fn name(point: &Point) -> String {
    let names: Vec<String> = parts(point).into_iter().map(|part| part.0).collect();
    match &names[..] {
        [] => "default".into(),
        names => names.join(", "),
    }
}

const DEFAULT: &str = "The default: the whole rigid-body equation in f32, by the engine, in every tick; it gives up \
                       nothing but what f32 rounds off.";

/// Of all that these are made of, what each does, once.
pub fn glossary(points: &[&Point]) -> String {
    let mut said: Vec<(String, String)> = Vec::new();
    for part in points.iter().flat_map(|point| parts(point)) {
        if !said.contains(&part) && !part.1.starts_with("takes steps") {
            said.push(part);
        }
    }
    let has_default = points.iter().any(|point| point.is_default());
    let default = has_default.then(|| format!("- {DEFAULT}\n"));
    let lines = said
        .iter()
        .map(|(name, phrase)| format!("- **{name}** {phrase}.\n"));
    lines.chain(default).collect()
}

/// What it does that the default does not, as a sentence.
pub fn sentence(point: &Point) -> String {
    let phrases: Vec<String> = parts(point).into_iter().map(|part| part.1).collect();
    match &phrases[..] {
        [] => DEFAULT.into(),
        phrases => format!("It {}.", phrases.join("; and ")),
    }
}

/// Three digits of an error, as people write it.
pub fn digits(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let exponent = x.abs().log10().floor() as i32;
    if !(-3..4).contains(&exponent) {
        return format!("{x:.1e}");
    }
    format!("{x:.*}", (2 - exponent).max(0) as usize)
}

/// An error that may be none.
pub fn stated(error: Option<f64>) -> String {
    error.map_or_else(|| "–".into(), digits)
}

/// A cost with commas.
pub fn cycles(x: f64) -> String {
    thousands(x.round() as u64)
}

#[cfg(test)]
mod tests {
    use super::super::front::tests::point;
    use super::{digits, glossary, name, sentence};

    #[test]
    fn a_configuration_reads_as_a_sentence() {
        let plain = point("default", 1.0, 1, 1.0);
        assert_eq!(name(&plain), "default");
        assert!(sentence(&plain).starts_with("The default"));
        let both = point("trig=table,rate=10,between=linearised", 1.0, 1, 1.0);
        assert_eq!(name(&both), "linear table, every 10th tick, linearised");
        let said = sentence(&both);
        assert!(
            said.starts_with("It interpolates")
                && said.contains("; and computes in every 10th tick"),
            "{said}"
        );
    }

    #[test]
    fn a_glossary_has_each_word_once() {
        let one = point("trig=table", 1.0, 1, 1.0);
        let both = point("trig=table,rate=10,between=linearised", 1.0, 1, 1.0);
        let said = glossary(&[&one, &both]);
        assert_eq!(said.matches("**linear table**").count(), 1);
        assert!(
            said.contains("- **every 10th tick, linearised** computes in every 10th tick"),
            "{said}"
        );
    }

    #[test]
    fn errors_have_three_digits() {
        assert_eq!(
            [0.01234, 14.1, 2.8e-14, 0.0].map(digits),
            ["0.0123", "14.1", "2.8e-14", "0"]
        );
    }
}
