//! Configurations in plain words.

use super::point::{Kind, Point};
use crate::table::thousands;

/// What a value on an axis is, and what it gives up: names for a plot, phrases for a sentence. The default's values
/// have none.
const WORDS: &[(&str, &str, &str, &str)] = &[
    (
        "arith",
        "f64",
        "f64",
        "computes in f64, which this processor does in software",
    ),
    (
        "arith",
        "compensated",
        "compensated f32",
        "carries the rounding errors of f32 along (two-sum, two-product)",
    ),
    (
        "arith",
        "q31",
        "Q31",
        "computes in fixed point, Q31, in units in which nothing exceeds ±2",
    ),
    (
        "trig",
        "minimax3",
        "degree 3",
        "takes sines and cosines from polynomials of the third degree and gives up four of f32's seven digits",
    ),
    (
        "trig",
        "minimax5",
        "degree 5",
        "takes sines and cosines from polynomials of the fifth degree and gives up one of f32's seven digits",
    ),
    (
        "trig",
        "minimax7",
        "degree 7",
        "takes sines and cosines from polynomials of the seventh degree, angles reduced in two parts",
    ),
    (
        "trig",
        "minimax7x3",
        "3-part reduction",
        "reduces angles by π/2 in three parts, for angles of very many turns",
    ),
    (
        "trig",
        "table",
        "linear table",
        "interpolates sines and cosines linearly in a table (256 entries, 2 KB of flash), gives up three of f32's seven digits, and reads flash, which wait states make slower",
    ),
    (
        "trig",
        "table2",
        "quadratic table",
        "interpolates sines and cosines to second order in a table (256 entries, 2 KB of flash) and reads flash, which wait states make slower",
    ),
    (
        "trig",
        "table4",
        "quartic table",
        "interpolates sines and cosines to fourth order in a table (64 entries, 512 bytes of flash) and reads flash, which wait states make slower",
    ),
    (
        "trig",
        "incremental",
        "carried sines",
        "carries sines and cosines on from tick to tick by small rotations, and gives up that a tick depends on its inputs alone",
    ),
    (
        "trig",
        "libm",
        "libm",
        "takes sines and cosines from the crate libm, which computes in f64 inside",
    ),
    (
        "trig",
        "micromath",
        "micromath",
        "takes sines and cosines from the crate micromath and gives up four of f32's seven digits",
    ),
    (
        "model",
        "no_coriolis",
        "no Coriolis",
        "leaves out Coriolis and centrifugal torques: right at rest, and worse with the square of the joints' speed",
    ),
    (
        "model",
        "gravity",
        "gravity only",
        "holds the weight only and leaves out inertia, Coriolis and centrifugal torques: right at rest",
    ),
    (
        "model",
        "rigid",
        "taken for rigid",
        "takes joints that give way for rigid ones",
    ),
    (
        "model",
        "compliant",
        "compliant",
        "computes motors and links of joints that give way",
    ),
    (
        "model",
        "params6",
        "6-bit model",
        "rounds lengths, masses and inertias to 6 bits",
    ),
    (
        "model",
        "params8",
        "8-bit model",
        "rounds lengths, masses and inertias to 8 bits, those of bf16",
    ),
    (
        "model",
        "params11",
        "11-bit model",
        "rounds lengths, masses and inertias to 11 bits, those of f16",
    ),
    (
        "form",
        "core",
        "core",
        "uses the core, whose code serves any robot",
    ),
    (
        "opt",
        "s",
        "opt s",
        "is compiled for size (opt-level \"s\")",
    ),
    (
        "opt",
        "z",
        "opt z",
        "is compiled for the smallest size (opt-level \"z\")",
    ),
    (
        "integrator",
        "euler",
        "Euler",
        "steps by explicit Euler, of first order, which gains energy",
    ),
    (
        "integrator",
        "semi_implicit",
        "semi-implicit Euler",
        "steps by semi-implicit Euler, of first order, whose energy stays bounded",
    ),
    (
        "integrator",
        "rk4",
        "RK4",
        "steps by Runge and Kutta's rule of fourth order, four evaluations a step",
    ),
    (
        "integrator",
        "energy",
        "energy-preserving",
        "steps so that the energy stays what it was",
    ),
    (
        "integrator",
        "implicit_damping",
        "implicit damping",
        "takes friction as it will be at the end of the step",
    ),
    (
        "state",
        "compensated",
        "compensated sums",
        "adds up angles and speeds with their rounding errors carried along",
    ),
];

fn found(axis: &str, value: &str) -> Option<(&'static str, &'static str)> {
    let known = WORDS.iter().find(|word| (word.0, word.1) == (axis, value));
    known.map(|word| (word.2, word.3))
}

fn changed(point: &Point) -> impl Iterator<Item = (&str, &str)> {
    point.key.split(',').filter_map(|axis| axis.split_once('='))
}

/// A short name, for a plot.
pub fn name(point: &Point) -> String {
    let mut names = Vec::new();
    if point.kind == Kind::Simulation {
        names.extend(found("integrator", point.on("integrator")).map(|words| words.0.to_owned()));
        names.push(step(point));
    }
    for (axis, value) in changed(point) {
        match (axis, found(axis, value)) {
            ("integrator" | "step" | "scene" | "between", _) => {}
            ("rate", _) => names.push(format!(
                "every {} tick, {}",
                nth(value),
                point.on("between")
            )),
            (_, Some((name, _))) => names.push(name.to_owned()),
            (_, None) => names.push(format!("{axis} {value}")),
        }
    }
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

/// What it does that the default does not, as a sentence.
pub fn sentence(point: &Point) -> String {
    let mut phrases: Vec<String> = Vec::new();
    if point.kind == Kind::Simulation {
        phrases.extend(found("integrator", point.on("integrator")).map(|words| words.1.to_owned()));
        phrases.push(format!("takes steps of {}", step(point)));
    }
    for (axis, value) in changed(point) {
        match (axis, found(axis, value)) {
            ("integrator" | "step" | "scene" | "between", _) => {}
            ("rate", _) => phrases.push(every(value, point.on("between"))),
            ("arith", Some((_, phrase))) if value != "f32" => phrases.push(phrase.to_owned()),
            (_, Some((_, phrase))) => phrases.push(phrase.to_owned()),
            (_, None) => phrases.push(format!("has {axis} {value}")),
        }
    }
    match phrases.as_slice() {
        [] => "The default: the whole rigid-body equation in f32, by the engine, in every tick; it gives up nothing \
               but what f32 rounds off."
            .into(),
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
    use super::{digits, name, sentence};

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
    fn errors_have_three_digits() {
        assert_eq!(
            [0.01234, 14.1, 2.8e-14, 0.0].map(digits),
            ["0.0123", "14.1", "2.8e-14", "0"]
        );
    }
}
