//! The page that prints the certificates.

use std::fmt::Write as _;

use serde::{Deserialize, Serialize};

use crate::bodies::Body;
use crate::certificate::Certificate;
use crate::digits::short;
use crate::error::{Error, Result};
use crate::forward::{Forward, Worst};
use crate::function::Function;

/// The worst states of forward dynamics, for the script that computes them in 50 digits.
///
/// # Errors
/// [`Error::Robot`] of numbers that JSON has not.
pub fn worst_states(certificates: &[Certificate]) -> Result<String> {
    let of = |one: &Certificate| {
        let forward = one.forward.as_ref()?;
        Some(RecordedForward {
            robot: one.robot.clone(),
            function: one.function,
            bodies: forward.bodies.clone(),
            worst: forward.worst.clone(),
            exact: Vec::new(),
        })
    };
    let all: Vec<RecordedForward> = certificates.iter().filter_map(of).collect();
    serde_json::to_string(&all).map_err(|e| Error::Robot(e.to_string()))
}

/// The record of forward dynamics, for a computation in more digits.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct RecordedForward {
    /// The name of the robot.
    pub robot: String,
    /// The function of forward dynamics.
    pub function: Function,
    /// The bodies of the robot.
    pub bodies: Vec<Body>,
    /// For each joint the state of its greatest error as a share of the bound, then that of the
    /// norm.
    pub worst: Vec<Worst>,
    /// The accelerations at these states, which the script adds.
    #[serde(default)]
    pub exact: Vec<Vec<f64>>,
}

/// The flags and the profile with which the target's code is compiled.
const CONFIG: &str = include_str!("../../../.cargo/config.toml");
const WORKSPACE: &str = include_str!("../Cargo.toml");
const ASSUMED: &str = "### What is assumed

- Errors: the processor rounds to nearest, even, and keeps subnormal numbers, as after a reset.
- Errors: positions, speeds and accelerations are numbers of f32 within the box.
- Errors: torques of forward dynamics are numbers of f32 with which no result overflows.
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
    let (what, unit) = match one.function {
        one if one.is_matrix() => ("entry", "kg·m² or kg"),
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
    if let Some(forward) = &one.forward {
        return text + &accelerations(one, forward) + "\n";
    }
    let _ = writeln!(
        text,
        "| {what} | proven error, {unit} | worst observed | ratio | proof | of it: operations | literals | sines | range of the result |\n|---|---|---|---|---|---|---|---|---|"
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

/// The proven errors of forward dynamics, joint by joint, and of all joints together.
fn accelerations(one: &Certificate, forward: &Forward) -> String {
    let n = forward.bias.len();
    let mut text = "| joint | bias b: proven error β, N·m or N | worst observed | M_ii: proven error μ, kg·m² or kg | worst observed | greatest h | roundings m of \
                    its row | bound of q̈ / error, at least |\n|---|---|---|---|---|---|---|---|\n"
        .to_owned();
    for (i, bias) in one.outputs.iter().take(n).enumerate() {
        let own = &one.outputs[n + i * (i + 3) / 2];
        let row = forward.roundings[i].iter();
        let (least, most) = (row.clone().min().unwrap_or(&0), row.max().unwrap_or(&0));
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {least} to {most} | {:.1} |",
            i + 1,
            short(bias.bound),
            short(bias.observed),
            short(own.bound),
            short(own.observed),
            short(forward.scales[i]),
            1.0 / forward.shares[i].error,
        );
    }
    let [rho, found] = [forward.floor.floor, forward.floor.least].map(|floor| 1.0 / floor);
    let positive = match (rho * forward.epsilon, forward.is_total) {
        (share, true) => format!("ρ ε ≤ {}, so that no state of the box is refused", short(share)),
        (share, false) if share < 1.0 => format!(
            "ρ ε ≤ {}, so that all pivots are positive; of some it is not proven that they exceed what the code wants of them, and a state may be refused",
            short(share)
        ),
        _ => "where ρ ε ≥ 1, nothing is proven".to_owned(),
    };
    let _ = writeln!(
        text,
        "\nβ_S = {}, ε = {}. ρ is at most {rho:.0} at every position, and the most that was found is {found:.0}: {positive}. At {} states that a search tried \
         no error was above its bound; that of the norm is at least {:.1} times the error.",
        short(forward.beta),
        short(forward.epsilon),
        forward.states,
        1.0 / forward.shares[n].error,
    );
    text
}

/// The box in words, joints of the same ranges together.
fn ranges(one: &Certificate) -> String {
    let of = |i: usize| {
        let joint = one.joints[i];
        let (q, unit) = (joint.position, if joint.turns { "rad" } else { "m" });
        let mut text = format!("q from {:.2} to {:.2} {unit}", q.low, q.high);
        if one.function.matrix().is_some() {
            let _ = write!(text, ", |q̇| ≤ {:.2} {unit}/s", joint.speed);
        }
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
