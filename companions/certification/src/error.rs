//! Why there is no certificate.

use std::path::PathBuf;

use crate::interval::Interval;

/// The result of a step towards a certificate.
pub type Result<T> = std::result::Result<T, Error>;

/// Why there is no certificate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The program is no ELF.
    #[error("not an ELF: {0}")]
    Elf(String),
    /// The program has no such variable.
    #[error("the program has no {0}")]
    Missing(String),
    /// A page or file is of other machine code.
    #[error("{0} is not of today's machine code: run `certify --write`")]
    Stale(String),
    /// The page is not as it was written.
    #[error("certificates.md, {0}; run `certify --write`")]
    Page(String),
    /// Recorded errors of configurations are of other machine code, kernels or ranges.
    #[error(
        "docs/accuracy-proven.json is not of today's {what} of {robot}: run `certify --write configurations`"
    )]
    Unproven {
        /// The name of the robot.
        robot: String,
        /// The variable that points to a function, or `inputs`.
        what: String,
    },
    /// The code does what is not proven.
    #[error("declined at {address:#010x}, instruction {instruction:#010x}: {reason}")]
    Declined {
        /// The address of the instruction.
        address: u32,
        /// Its first halfword above its second one; the second is zero of a short instruction.
        instruction: u32,
        /// The reason why nothing is proven.
        reason: &'static str,
    },
    /// The direction of a branch depends on the state, or is not proven to be the same in the whole
    /// box.
    #[error(
        "declined at {address:#010x}: a branch depends on data; its comparison gives {ordering:?} at the zero state, which is not proven for q, q̇, q̈ in {states:.3?}: a narrower --box may exclude this part"
    )]
    Branch {
        /// The address of the comparison.
        address: u32,
        /// The order of the numbers at the state zero.
        ordering: std::cmp::Ordering,
        /// A part of the box where it may be another.
        states: Vec<Interval>,
    },
    /// The error has no bound over the box.
    #[error(
        "output {output}: no bound over the box: more --parts or a narrower --box may give one"
    )]
    Infinite {
        /// The number of the output, from 1.
        output: usize,
    },
    /// The joints have no finite box.
    #[error("joint {joint} has no {what}: --speed and --range give one")]
    Unbounded {
        /// The number of the joint, from 1.
        joint: usize,
        /// The quantity that is not finite.
        what: &'static str,
    },
    /// The proof says less than what was observed: one of them is wrong.
    #[error("output {output}: the bound {bound:e} is below the observed error {observed:e}")]
    Contradicted {
        /// The number of the output, from 1.
        output: usize,
        /// The proven bound of its error.
        bound: f64,
        /// The error of a state that was found.
        observed: f64,
    },
    /// A call took more cycles than its machine code says, or not as many although nothing branches
    /// on data.
    #[error("{function}: the bound is {bound} cycles, and {least} to {most} were measured")]
    Cycles {
        /// The name of the function.
        function: &'static str,
        /// The bound that follows from the machine code.
        bound: u64,
        /// The fewest of a call.
        least: u64,
        /// The most of a call.
        most: u64,
    },
    /// The target computed other bits than the host.
    #[error(
        "{function}: result {result} of state {state} has the bits {target:#010x} on the target and {host:#010x} on the host"
    )]
    Bits {
        /// The name of the function.
        function: &'static str,
        /// The number of the state, from 1.
        state: usize,
        /// The number of the result, from 1.
        result: usize,
        /// The bits on the target, in QEMU.
        target: u32,
        /// The bits of the expression, evaluated on the host.
        host: u32,
    },
    /// A range of `--box` is not taken.
    #[error(transparent)]
    Narrow(#[from] NarrowError),
    /// A program ended with a failure.
    #[error("{program}: {said}")]
    Program {
        /// The name of the program.
        program: String,
        /// The output that it printed.
        said: String,
    },
    /// A file cannot be read or written.
    #[error("{}: {source}", path.display())]
    File {
        /// The path of the file.
        path: PathBuf,
        /// The operating system's reason.
        source: std::io::Error,
    },
    /// A robot's file is not taken.
    #[error("{0}")]
    Robot(String),
}

/// Why a range of `--box`, or a magnitude, is not taken.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{option}: {why}")]
pub struct NarrowError {
    /// The option as the user wrote it.
    pub option: String,
    /// The reason for the refusal.
    pub why: String,
}
