//! Configurations in plain words.

use super::point::{Kind, Point};
use super::vocabulary::found;
use crate::table::thousands;

fn changed(point: &Point) -> impl Iterator<Item = (&str, &str)> {
    point.key.split(',').filter_map(|axis| axis.split_once('='))
}

/// What it is made of that the default is not: names, and what each does.
fn parts(point: &Point) -> Vec<(String, String)> {
    let mut parts = Vec::new();
    let owned = |(name, phrase): (&str, &str)| (name.to_owned(), phrase.to_owned());
    if point.kind == Kind::Simulation {
        parts.extend(found("integrator", point.on("integrator")).map(owned));
        parts.push((step(point), format!("takes steps of {}", step(point))));
    }
    for (axis, value) in changed(point) {
        match (axis, found(axis, value)) {
            ("integrator" | "step" | "scene" | "between", _) => {}
            ("rate", _) => {
                let between = point.on("between");
                let name = format!("every {} tick, {between}", nth(value));
                parts.push((name, every(value, between)));
            }
            (_, Some(words)) => parts.push(owned(words)),
            (_, None) => parts.push((format!("{axis} {value}"), format!("has {axis} {value}"))),
        }
    }
    parts
}

/// A short name, for a plot.
pub fn name(point: &Point) -> String {
    let names: Vec<String> = parts(point).into_iter().map(|part| part.0).collect();
    if names.is_empty() {
        return "default".into();
    }
    names.join(", ")
}

fn step(point: &Point) -> String {
    match point.on("step").parse::<u64>() {
        Ok(us) if us >= 1000 => format!("{} ms", us as f64 / 1000.0),
        _ => format!("{} µs", point.on("step")),
    }
}

const DEFAULT: &str = "The default: the whole rigid-body equation in f32, by the engine, in every tick; it gives up \
                       nothing but what f32 rounds off.";

/// Of all that these are made of, what each does, once.
pub fn glossary(points: &[&Point]) -> String {
    let mut told: Vec<(String, String)> = Vec::new();
    for part in points.iter().flat_map(|point| parts(point)) {
        if !told.contains(&part) {
            told.push(part);
        }
    }
    let mut text: String = told
        .into_iter()
        .map(|(name, phrase)| format!("- **{name}** {phrase}.\n"))
        .collect();
    if points.iter().any(|point| point.is_default()) {
        text += &format!("- {DEFAULT}\n");
    }
    text
}

/// What it does that the default does not, as a sentence.
pub fn sentence(point: &Point) -> String {
    let phrases: Vec<String> = parts(point).into_iter().map(|part| part.1).collect();
    match phrases.as_slice() {
        [] => DEFAULT.into(),
        [phrases @ .., last] if !phrases.is_empty() => {
            format!("It {}; and {last}.", phrases.join("; "))
        }
        [only, ..] => format!("It {only}."),
    }
}

fn every(ticks: &str, between: &str) -> String {
    let what = match between {
        "held" => "holds the torque in between, late by up to as many ticks",
        "extrapolated" => "goes on in between along the line of the last two torques",
        "interpolated" => {
            "goes straight from one torque to the next, computed ahead: what is wanted then has to be known that early"
        }
        _ => "adds M Δq̈ in between, with M, position and speed as they were then",
    };
    format!("computes in every {} tick only and {what}", nth(ticks))
}

fn nth(ticks: &str) -> String {
    let ending = if ticks == "2" { "nd" } else { "th" };
    format!("{ticks}{ending}")
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
        let told = sentence(&both);
        assert!(
            told.starts_with("It interpolates")
                && told.contains("; and computes in every 10th tick"),
            "{told}"
        );
    }

    #[test]
    fn a_glossary_tells_each_word_once() {
        let one = point("trig=table", 1.0, 1, 1.0);
        let both = point("trig=table,rate=10,between=linearised", 1.0, 1, 1.0);
        let told = glossary(&[&one, &both]);
        assert_eq!(told.matches("**linear table**").count(), 1);
        assert!(
            told.contains("- **every 10th tick, linearised** computes in every 10th tick"),
            "{told}"
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
