//! The page that prints the certificates.

use std::fmt::Write as _;

use crate::certificate::Certificate;
use crate::digits::short;

/// The flags and the profile with which the target's code is compiled.
const CONFIG: &str = include_str!("../../../.cargo/config.toml");
const WORKSPACE: &str = include_str!("../Cargo.toml");
const ASSUMED: &str = "### What is assumed

- Errors: the processor rounds to nearest, even, and keeps subnormal numbers, as after a reset.
- Errors: positions, speeds and accelerations are numbers of f32 within the box.
- Errors: the exact function is that of the model in f64.
- Errors: the host's `sin` and `cos` in f64 are off by less than 10⁻¹⁵.
- Cycles and stack: a Cortex-M4F without wait states, by the model of the cycle meter; code and
  constants are in flash at 0x08000000, stack and variables in RAM at 0x20000000.
- Cycles and stack: no interrupt within the cycles; one, with the state of the FPU, within the stack.
- Cycles and stack: no division is pending at the call.
- Cycles and stack: a pointer that the caller gives reaches no word of the stack that the compiler
  keeps for itself; what is copied and cleared at once, by `memcpy` and its kin, lies at multiples of four.
";

/// A sheet: the tables of some certificates, how they were compiled, and what is assumed.
pub fn sheet(certificates: &[Certificate]) -> String {
    let between = |text: &'static str, begin: &str, end: &str| {
        let rest = text.split_once(begin).map_or("", |(_, rest)| rest);
        rest.split(end).next().unwrap_or_default()
    };
    let target = between(CONFIG, "[target.thumbv7em-none-eabihf]", "\n]");
    let flags = between(target, "rustflags = [", "\n]").split('"').skip(1);
    let flags: Vec<&str> = flags.step_by(2).collect();
    let profile = between(WORKSPACE, "[profile.release]\n", "\n\n").trim();
    format!(
        "{}Compiled with {} and `{}`.\n\n{ASSUMED}",
        tables(certificates),
        profile.replace('\n', ", "),
        flags.join(" ")
    )
}

/// The tables of some certificates.
pub fn tables(certificates: &[Certificate]) -> String {
    let mut page = String::new();
    for one in certificates {
        let _ = write!(page, "{}", table(one));
    }
    page
}

fn table(one: &Certificate) -> String {
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
        "| joint | proven error, N·m or N | worst observed | ratio | proof | of it: operations | literals | sines | range of the result |\n|---|---|---|---|---|---|---|---|---|"
    );
    for output in &one.outputs {
        let ratio =
            if output.observed > 0.0 { format!("{:.1}", output.ratio()) } else { "–".to_owned() };
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
fn ranges(one: &Certificate) -> String {
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
        format!("joint{} {}: {text}", if joints.len() > 1 { "s" } else { "" }, joints.join(", "))
    };
    groups.into_iter().map(group).collect::<Vec<_>>().join("; ")
}
