//! A certificate: what was proven of a function over a box of states, beside the worst that was
//! observed.

use std::sync::atomic::{AtomicUsize, Ordering};

use serde::Serialize;

use crate::bodies;
use crate::bound::{Bounder, SineErrors};
use crate::branch::{Proven, prove};
use crate::error::{Error, Result};
use crate::exact::Exact;
pub use crate::function::{Function, address, expression};
use crate::graph::Graph;
use crate::grid;
use crate::image::Image;
use crate::interval::Interval;
pub use crate::output::{Output, Proof};
use crate::paths;
use crate::program::Program;
use crate::search::{self, Effort};
use crate::state_box::{Joint, Robot};
use crate::target::Target;

/// The effort that is spent on a certificate.
#[derive(Clone, Copy, Debug)]
pub struct Spent {
    /// The parts that the box of each output is split into.
    pub parts: usize,
    /// The most points of a grid of angles.
    pub points: usize,
    /// The search of observed errors.
    pub search: Effort,
}

/// The parts by which it is proven of each branch that the whole box takes it.
const PATH_PARTS: usize = 20_000;

/// A certificate: the proven bounds of one function of one robot.
#[derive(Clone, Debug, Serialize)]
pub struct Certificate {
    /// The name of the robot.
    pub robot: String,
    /// The function whose results are bounded.
    pub function: Function,
    /// SHA-256 of its machine code.
    pub hash: String,
    /// The version of the compiler.
    pub rustc: String,
    /// The number of instructions of one call.
    pub instructions: usize,
    /// The number of rounded operations of one call.
    pub operations: usize,
    /// The box of states: the ranges of each joint.
    pub joints: Vec<Joint>,
    /// The error of the sines over the joints' ranges.
    pub sines: SineErrors,
    /// The number of states that the search tried.
    pub states: usize,
    /// The proven bound of each output and the worst error found.
    pub outputs: Vec<Output>,
    /// The cycles and the stack of a call on the target.
    pub target: Option<Target>,
}

/// Bounds the results, and searches the worst errors beside them.
///
/// # Errors
/// [`Error::Contradicted`], [`Error::Infinite`], [`Error::Missing`] of an input that the box does
/// not bound.
pub fn outputs(
    graph: &Graph,
    robot: &Robot,
    exact: &Exact,
    sines: SineErrors,
    spent: Spent,
) -> Result<Vec<Output>> {
    let observed = search::against(exact, graph, robot, spent.search, 1);
    let proven = in_parallel(graph.outputs.len(), |output| {
        let mut bounder = Bounder::new(graph, output, robot, sines)?;
        let one = graph.of_output(output);
        let proven = prove(&mut bounder, &robot.whole(), spent.parts);
        let known = &proven.magnitudes;
        let program = grid::Program::new(&one, robot);
        let program = program.as_ref();
        let by_grid =
            program.and_then(|program| program.prove(&one, robot, sines, spent.points, known));
        let most = program.and_then(|program| program.greatest_value(spent.points, spent.points));
        Some((proven, by_grid, most))
    });
    let greatest = proven.iter().flatten().map(|one| one.0.range.magnitude());
    let slack = REFERENCE * greatest.fold(0.0, f64::max);
    let mut outputs = Vec::new();
    for (output, ((offset, _), (observed, proven))) in
        graph.outputs.iter().zip(observed.into_iter().zip(proven)).enumerate()
    {
        let (proven, by_grid, most) =
            proven.ok_or_else(|| Error::Missing("an input that the box bounds".to_owned()))?;
        let Proven { bound, range, parts, .. } = proven;
        let (mut bound, proof) = match by_grid {
            Some(other) if other.total() < bound.total() => (other, Proof::Grid),
            _ => (bound, Proof::Parts),
        };
        if graph.is_constant(output) {
            // The compiler may have added literals, each rounded: the number is compared itself.
            bound.literals = bound.literals.max(observed.error + slack);
        }
        let total = bound.total();
        // By the grid the function is at most so much, and computed by at most the error more.
        let most = most.map_or(f64::INFINITY, |most| most + total);
        let range = Interval::new(range.low.max(-most), range.high.min(most));
        if !total.is_finite() {
            return Err(Error::Infinite { output: output + 1 });
        }
        let error = (observed.error - slack).max(0.0);
        if total < error {
            return Err(Error::Contradicted { output: output + 1, bound: total, observed: error });
        }
        outputs.push(Output {
            name: (offset / 4 + 1).to_string(),
            bound: total,
            of: bound,
            observed: error,
            state: observed.state,
            range,
            parts: parts.len(),
            proof,
        });
    }
    Ok(outputs)
}

/// More than the error of the exact function in f64, as a share of the greatest result of any
/// joint.
const REFERENCE: f64 = 1e-14;

/// Proves the bounds of a function, and searches the worst errors beside them.
///
/// # Errors
/// [`Error::Declined`] of code that is not followed, [`Error::Branch`] of a branch that states of
/// the box may take otherwise, [`Error::Contradicted`] if the search finds more than the bound,
/// [`Error::Infinite`] if there is none.
pub fn certify(
    program: &Program,
    function: Function,
    robot: &Robot,
    sines: SineErrors,
    spent: Spent,
) -> Result<Certificate> {
    let image = Image::read(&program.elf)?;
    let walked = expression(&image, function)?;
    paths::prove(&walked, robot, sines, PATH_PARTS)?;
    let exact = Exact::of(function, || bodies::read(&image))?;
    let outputs = outputs(&walked.graph, robot, &exact, sines, spent)?;
    Ok(Certificate {
        robot: program.robot.clone(),
        function,
        hash: image.hash(&walked.visited),
        rustc: program.rustc.clone(),
        instructions: walked.executed,
        operations: walked.graph.operations(),
        joints: robot.joints.clone(),
        sines,
        states: spent.search.states(outputs.len()),
        outputs,
        target: None,
    })
}

/// The results of some tasks, on all cores.
pub(crate) fn in_parallel<T: Send>(
    tasks: usize,
    run: impl Fn(usize) -> Option<T> + Sync,
) -> Vec<Option<T>> {
    let (next, threads) =
        (AtomicUsize::new(0), std::thread::available_parallelism().map_or(1, usize::from));
    let mut results: Vec<Option<T>> = (0..tasks).map(|_| None).collect();
    std::thread::scope(|scope| {
        let work = || {
            let mine = std::iter::from_fn(|| {
                Some(next.fetch_add(1, Ordering::Relaxed)).filter(|task| *task < tasks)
            });
            mine.map(|task| (task, run(task))).collect::<Vec<_>>()
        };
        let threads: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        for (task, result) in
            threads.into_iter().flat_map(|thread| thread.join().unwrap_or_default())
        {
            results[task] = result;
        }
    });
    results
}
