//! A certificate: what was proven of a function over a box of states, beside the worst that was
//! observed.

use std::sync::atomic::{AtomicUsize, Ordering};

use serde::Serialize;

use crate::bodies;
use crate::bound::{Bounder, Enclosure, SineErrors};
use crate::branch::{Proven, prove};
use crate::error::{Error, Result};
use crate::exact::Exact;
use crate::factors::Factored;
use crate::forward::Forward;
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
use crate::walk::Walked;

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
    /// The bounds of forward dynamics, whose outputs are the biases and the inertia matrix.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub forward: Option<Forward>,
}

/// A function of a program, with the expressions about which something is proven.
#[derive(Clone, Debug)]
pub struct Subject {
    function: Function,
    /// The expression of its machine code.
    pub walked: Walked,
    /// The expression whose results have bounds: of a symmetric matrix the upper triangle, of
    /// forward dynamics that of [`Factored`].
    pub graph: Graph,
    /// The factors and the solution that the code of forward dynamics was recognised as.
    pub factored: Option<Factored>,
}

impl Subject {
    /// Reads a function of a program.
    ///
    /// # Errors
    /// As [`expression`], and [`Error::Factors`].
    pub fn of(image: &Image, function: Function) -> Result<Self> {
        let walked = expression(image, function)?;
        let mut graph = walked.graph.clone();
        let mut factored = None;
        if function.is_matrix() {
            let n = graph.outputs.len().isqrt();
            let is_upper = |place: usize| place / n <= place % n;
            graph.outputs.retain(|(at, _)| is_upper(*at as usize / 4));
        } else if let Some((matrix, order)) = function.matrix() {
            let apart = Factored::of(&walked, &expression(image, matrix)?.graph, order)?;
            graph = apart.graph.clone();
            factored = Some(apart);
        }
        Ok(Self { function, walked, graph, factored })
    }

    /// The name of a result, from its place among the function's results.
    fn name(&self, place: usize, joints: usize) -> String {
        let entry = |at: usize| format!("{},{}", at / joints + 1, at % joints + 1);
        match self.function {
            one if one.is_matrix() => entry(place),
            one if one.matrix().is_none() => (place + 1).to_string(),
            _ if place < joints => format!("bias {}", place + 1),
            _ => format!("M {}", entry(place - joints)),
        }
    }

    /// The share of an effort that is spent on each result.
    fn effort(&self, effort: Effort) -> Effort {
        match self.factored {
            Some(_) => Effort { children: effort.children / SHARE, ..effort },
            None => effort,
        }
    }

    /// Bounds the results, and searches the worst errors beside them.
    ///
    /// # Errors
    /// [`Error::Contradicted`], [`Error::Infinite`], [`Error::Missing`] of an input that the box
    /// does not bound.
    pub fn outputs(
        &self,
        robot: &Robot,
        exact: &Exact,
        sines: SineErrors,
        spent: Spent,
    ) -> Result<Vec<Output>> {
        let graph = &self.graph;
        let observed = search::against(exact, graph, robot, self.effort(spent.search), 1);
        let proven = in_parallel(graph.outputs.len(), |output| {
            let mut bounder = Bounder::new(graph, output, robot, sines, Enclosure::WrittenOut)?;
            let one = graph.of_output(output);
            let proven = prove(&mut bounder, &robot.whole(), spent.parts);
            let known = &proven.magnitudes;
            let program = grid::Program::new(&one, robot);
            let program = program.as_ref();
            let by_grid =
                program.and_then(|program| program.prove(&one, robot, sines, spent.points, known));
            let most =
                program.and_then(|program| program.greatest_value(spent.points, spent.points));
            Some((proven, by_grid, most))
        });
        let greatest = proven.iter().flatten().map(|one| one.0.range.magnitude());
        let slack = REFERENCE * greatest.fold(0.0, f64::max);
        let mut outputs = Vec::new();
        for (output, ((offset, _), (observed, proven))) in
            graph.outputs.iter().zip(observed.into_iter().zip(proven)).enumerate()
        {
            let name = self.name(*offset as usize / 4, robot.joints.len());
            let (proven, by_grid, most) =
                proven.ok_or_else(|| Error::Missing("an input that the box bounds".to_owned()))?;
            let Proven { bound, range, parts, .. } = proven;
            let (mut bound, proof) = match by_grid {
                Some(other) if other.total() < bound.total() => (other, Proof::Grid),
                _ => (bound, Proof::Parts),
            };
            if graph.is_constant(output) {
                // The compiler may have added literals, each rounded: the number is compared
                // itself.
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
                return Err(Error::Contradicted {
                    output: output + 1,
                    bound: total,
                    observed: error,
                });
            }
            outputs.push(Output {
                name,
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
}

/// More than the error of the exact function in f64, as a share of the greatest result of any
/// joint.
const REFERENCE: f64 = 1e-14;
/// The parts of the floor of the scaled inertia matrix.
const FLOOR_PARTS: usize = 20_000;
/// The states of the search are divided by this number for each result with which forward dynamics
/// solves.
const SHARE: usize = 8;

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
    let subject = Subject::of(&image, function)?;
    let walked = &subject.walked;
    // Forward dynamics has comparisons of pivots alone, of which the certificate itself says what
    // they are.
    if subject.factored.is_none() {
        paths::prove(walked, robot, sines, PATH_PARTS)?;
    }
    let exact = Exact::of(function, || bodies::read(&image))?;
    let outputs = subject.outputs(robot, &exact, sines, spent)?;
    let forward = subject.factored.as_ref().map(|factored| {
        let bodies = bodies::read(&image)?;
        let mut forward = Forward::prove(factored, &outputs, &bodies, robot, sines, FLOOR_PARTS)?;
        forward.search(&walked.graph, &bodies, robot, spent.search)?;
        Ok::<_, Error>(forward)
    });
    Ok(Certificate {
        robot: program.robot.clone(),
        function,
        hash: image.hash(&walked.visited),
        rustc: program.rustc.clone(),
        instructions: walked.executed,
        operations: walked.graph.operations(),
        joints: robot.joints.clone(),
        sines,
        states: subject.effort(spent.search).states(outputs.len()),
        outputs,
        target: None,
        forward: forward.transpose()?,
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
