//! The sheet of a robot: the tables of its functions, how they were compiled, and what is assumed.

use std::fmt::Write as _;

use serde::Serialize;

use crate::certificate::Certificate;
use crate::page::tables;
use crate::preconditions::{PRECONDITIONS, Preconditions};
pub use crate::target::Target;

/// How the target's code is compiled.
const CONFIG: &str = include_str!("../../../.cargo/config.toml");
const WORKSPACE: &str = include_str!("../Cargo.toml");
/// What the proven errors assume; cycles and stack have preconditions of their own.
const ASSUMED: [&str; 5] = [
    "the processor rounds to nearest, even, and keeps subnormal numbers, as after a reset",
    "positions, speeds and accelerations are numbers of f32 within the box",
    "torques of forward dynamics are numbers of f32 with which no result overflows",
    "the exact function is that of the model in f64",
    "the host's `sin` and `cos` in f64 are off by less than 10⁻¹⁵",
];

/// The sheet of a robot.
#[derive(Serialize)]
pub struct Sheet<'a> {
    flags: Vec<&'static str>,
    profile: Vec<&'static str>,
    preconditions: Preconditions,
    assumed: [&'static str; 5],
    functions: &'a [Certificate],
}

impl<'a> Sheet<'a> {
    /// Of some certificates.
    pub fn of(functions: &'a [Certificate]) -> Self {
        Self {
            flags: flags(),
            profile: profile(),
            preconditions: PRECONDITIONS,
            assumed: ASSUMED,
            functions,
        }
    }

    /// As a page.
    pub fn markdown(&self) -> String {
        let (profile, flags) = (self.profile.join(", "), self.flags.join(" "));
        let mut text = tables(self.functions);
        let _ = write!(
            text,
            "Compiled with {profile} and `{flags}`.\n\n### What is assumed\n\n"
        );
        for one in self.assumed {
            let _ = writeln!(text, "- Errors: {one}.");
        }
        for (what, one) in self.preconditions.named() {
            let _ = writeln!(text, "- Cycles and stack: {what}: {one}.");
        }
        text
    }
}

/// The flags of the compiler for the target.
fn flags() -> Vec<&'static str> {
    let section = CONFIG.split("[target.thumbv7em-none-eabihf]").nth(1);
    let list = section.and_then(|text| text.split("rustflags = [").nth(1));
    let list = list.and_then(|text| text.split("\n]").next());
    list.unwrap_or_default()
        .split('"')
        .skip(1)
        .step_by(2)
        .collect()
}

/// The settings of the profile `release`.
fn profile() -> Vec<&'static str> {
    let section = WORKSPACE.split("[profile.release]\n").nth(1);
    let lines = section.unwrap_or_default().lines();
    lines.take_while(|line| !line.is_empty()).collect()
}
