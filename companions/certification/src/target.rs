//! The cycles, the stack and the bits of a call on the target, against the machine code and the
//! host.

use clap::ValueEnum;
use serde::{Serialize, Serializer};

use crate::cycles::{self, Declined};
use crate::emulation::Emulation;
use crate::error::{Error, Result};
use crate::function::{self, Function};
use crate::image::Image;
use crate::search::Evaluation;
use crate::stack::{self, INTERRUPT_FRAME};
use crate::state_box::Robot;

/// The cycles and the stack of a call of a function on the target.
#[derive(Clone, Debug, Serialize)]
pub struct Target {
    /// The fewest and the most cycles of the calls in QEMU, or why there were none.
    #[serde(serialize_with = "untagged")]
    pub measured: std::result::Result<[u64; 2], String>,
    /// The number of these calls.
    pub states: usize,
    /// The most cycles of any call by the machine code, or why they have no bound.
    #[serde(serialize_with = "untagged")]
    pub bound: std::result::Result<u64, Declined>,
    /// The branches on data in it.
    pub branches: Vec<u32>,
    /// The most stack with the frame of an interrupt, or why it has no bound.
    #[serde(serialize_with = "untagged")]
    pub stack: std::result::Result<u64, Declined>,
}

/// A result as JSON: what it is, or why it is not.
fn untagged<T: Serialize, E: Serialize, S: Serializer>(
    one: &std::result::Result<T, E>,
    to: S,
) -> std::result::Result<S::Ok, S::Error> {
    match one {
        Ok(value) => value.serialize(to),
        Err(why) => why.serialize(to),
    }
}

impl Target {
    /// Measures a function of a program that was run, or that was not run for the given reason. The
    /// calls must take what the machine code says, and results must have the bits that the host
    /// computes.
    ///
    /// # Errors
    /// [`Error::Cycles`], [`Error::Bits`], [`Error::Missing`].
    pub fn of(
        image: &Image,
        function: Function,
        robot: &Robot,
        emulation: &std::result::Result<Emulation, String>,
    ) -> Result<Self> {
        let key = function.to_possible_value();
        let key = key.as_ref().map_or("", |value| value.get_name());
        let address = function::address(image, function)?;
        let calls: Vec<_> = emulation.iter().flat_map(|run| run.of(key)).collect();
        let cycles = calls.iter().map(|(sample, _)| sample.cycles);
        let measured = match (emulation, cycles.clone().min(), cycles.max()) {
            (_, Some(least), Some(most)) => Ok([least, most]),
            (Err(why), ..) => Err(why.clone()),
            _ => Err("the program does not call it".to_owned()),
        };
        let region = calls.first().map(|(sample, _)| sample.at);
        let region = region.and_then(|at| cycles::region(image, at, Some(address)));
        let bound = region.unwrap_or_else(|| cycles::function(image, address));
        let target = Self {
            measured,
            states: calls.len(),
            bound: bound.cycles,
            branches: bound.branches,
            stack: stack::stack(image, address),
        };
        target.check(function)?;
        if let Ok(run) = emulation {
            let results = calls.iter().map(|(_, bits)| *bits);
            same_bits(image, function, robot, &run.states, results)?;
        }
        Ok(target)
    }

    fn check(&self, function: Function) -> Result<()> {
        let (Ok([least, most]), Ok(bound)) = (&self.measured, self.bound) else {
            return Ok(());
        };
        let is_loose = self.branches.is_empty() && (bound != *most || bound != *least);
        if bound < *most || is_loose {
            return Err(Error::Cycles {
                function: function.name(),
                bound,
                least: *least,
                most: *most,
            });
        }
        Ok(())
    }

    /// The bound and the measured cycles as a sentence.
    pub fn sentence(&self) -> String {
        let states = self.states;
        let measured = match &self.measured {
            Ok([least, most]) => format!("{least} to {most} in QEMU at {states} states"),
            Err(why) => format!("not measured ({why})"),
        };
        let of = match states {
            0 => ", from its first instruction to its return",
            _ => "",
        };
        let bound = match self.bound {
            Ok(cycles) if self.branches.is_empty() => {
                format!("{cycles} of every call{of}: the code has no branch on data")
            }
            Ok(cycles) => {
                format!("at most {cycles}{of}, with {} branches on data", self.branches.len())
            }
            Err(declined) => format!("none: {declined}"),
        };
        let stack = match self.stack {
            Ok(bytes) => format!("at most {bytes} B, of them {INTERRUPT_FRAME} B for an interrupt"),
            Err(declined) => format!("no bound: {declined}"),
        };
        let bits = match states {
            0 => "not compared".to_owned(),
            _ => {
                format!("QEMU's at {states} states are those of the proven expression on the host")
            }
        };
        format!("Cycles: {measured}; static bound: {bound}. Stack: {stack}. Bits: {bits}.")
    }
}

/// Fails unless each result has the bits of the function's expression on the host.
fn same_bits<'a>(
    image: &Image,
    function: Function,
    robot: &Robot,
    states: &[Vec<f64>],
    results: impl Iterator<Item = &'a [u32]>,
) -> Result<()> {
    let graph = function::expression(image, function)?.graph;
    let mut evaluation = Evaluation::new(&graph, robot);
    for (number, (state, bits)) in states.iter().zip(results).enumerate() {
        let host = evaluation.at(state).map(|(single, _)| single.to_bits());
        for ((offset, _), host) in graph.outputs.iter().zip(host) {
            let result = *offset as usize / 4;
            let target = bits.get(result).copied();
            let target = target.ok_or_else(|| Error::Missing(format!("result {}", result + 1)))?;
            if target != host {
                return Err(Error::Bits {
                    function: function.name(),
                    state: number + 1,
                    result: result + 1,
                    target,
                    host,
                });
            }
        }
    }
    Ok(())
}
