//! Certificates as a page.

use std::fmt::Write as _;

use crate::certificate::{Certificate, Function};

/// A number in three digits, its power of ten written out.
pub(crate) fn short(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let text = format!("{x:.2e}");
    let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
    let power: String = power
        .chars()
        .map(|digit| {
            if digit == '-' {
                '⁻'
            } else {
                SUPERSCRIPTS[digit.to_digit(10).unwrap_or(0) as usize]
            }
        })
        .collect();
    format!("{digits} · 10{power}")
}

const SUPERSCRIPTS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

/// The tables of some certificates.
pub fn tables(certificates: &[Certificate]) -> String {
    let mut page = String::new();
    for one in certificates {
        let _ = write!(page, "{}", table(one));
    }
    page
}

fn table(one: &Certificate) -> String {
    let (what, unit) = match one.function {
        Function::Crba => ("entry", "kg·m² or kg"),
        _ => ("joint", "N·m or N"),
    };
    let mut text = format!(
        "### {}: {}\n\n{} instructions, {} of them rounded operations; SHA-256 of the machine code `{}`; {}.\n\nThe box: {}.\n\n",
        one.robot,
        one.function.name(),
        one.instructions,
        one.operations,
        one.hash,
        one.rustc,
        ranges(one),
    );
    if let Some(target) = &one.target {
        let _ = write!(text, "{}\n\n", target.sentence());
    }
    let _ = writeln!(
        text,
        "| {what} | proven error, {unit} | worst observed | ratio | proof | of it: operations | literals | sines | range of the result |\n|---|---|---|---|---|---|---|---|---|"
    );
    for output in &one.outputs {
        let ratio = if output.observed > 0.0 {
            format!("{:.1}", output.ratio())
        } else {
            "–".to_owned()
        };
        let _ = writeln!(
            text,
            "| {} | {} | {} | {ratio} | {} | {} | {} | {} | {:.3} to {:.3} |",
            output.name,
            short(output.bound),
            short(output.observed),
            output.proof.name(),
            short(output.of.operations),
            short(output.of.literals),
            short(output.of.sines),
            output.range.low,
            output.range.high,
        );
    }
    text + "\n"
}

/// The box in words, joints of the same ranges together.
pub(crate) fn ranges(one: &Certificate) -> String {
    let of = |i: usize| {
        let joint = one.joints[i];
        let (q, unit) = (joint.position, if joint.turns { "rad" } else { "m" });
        let mut text = format!("q from {:.2} to {:.2} {unit}", q.low, q.high);
        if one.function.is_inverse_dynamics() {
            let _ = write!(
                text,
                ", |q̇| ≤ {:.2} {unit}/s, |q̈| ≤ {:.2} {unit}/s²",
                joint.speed, joint.acceleration
            );
        }
        text
    };
    let mut groups: Vec<(String, Vec<String>)> = Vec::new();
    for i in 0..one.joints.len() {
        let (text, number) = (of(i), (i + 1).to_string());
        match groups.iter_mut().find(|group| group.0 == text) {
            Some(group) => group.1.push(number),
            None => groups.push((text, vec![number])),
        }
    }
    let group = |(text, joints): (String, Vec<String>)| {
        format!(
            "joint{} {}: {text}",
            if joints.len() > 1 { "s" } else { "" },
            joints.join(", ")
        )
    };
    groups.into_iter().map(group).collect::<Vec<_>>().join("; ")
}
