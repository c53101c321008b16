//! The worst error that a search finds: the graph in f32, as the target computes it, against the
//! exact function in f64 ([`crate::exact`]), or against the same graph in f64 with exact sines.
//!
//! No gradients: rounding errors have none. Random states first, then for each output the worst of
//! them, changed at random by less and less.

use fastrand::Rng;

use crate::exact::Exact;
use crate::graph::{Graph, Input};
use crate::sines;
use crate::state_box::{Leaf, Robot};

/// The effort of a search, in states.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// The number of states drawn at random.
    pub random: usize,
    /// The number of generations for each output.
    pub generations: usize,
    /// The number of states of a generation.
    pub children: usize,
}

impl Effort {
    /// The states that a search of so many outputs tries.
    pub fn states(self, outputs: usize) -> usize {
        self.random + outputs * self.generations * self.children
    }
}

/// The worst error of one output that was found, and where.
#[derive(Clone, Debug, Default)]
pub struct Observed {
    /// The error |f32 − exact|.
    pub error: f64,
    /// q, q̇, q̈ of it, numbers of f32.
    pub state: Vec<f64>,
}

/// Evaluates a graph in both precisions.
pub struct Evaluation<'a> {
    graph: &'a Graph,
    robot: &'a Robot,
    leaves: std::collections::HashMap<Input, Leaf>,
    single: Vec<f32>,
    double: Vec<f64>,
}

impl<'a> Evaluation<'a> {
    /// An evaluation of a graph whose inputs are the robot's.
    pub fn new(graph: &'a Graph, robot: &'a Robot) -> Self {
        let inputs = graph.nodes.iter().filter_map(|node| match node {
            crate::graph::Node::Input(input) => Some((*input, robot.leaf(*input)?)),
            _ => None,
        });
        Self { graph, robot, leaves: inputs.collect(), single: Vec::new(), double: Vec::new() }
    }

    /// The outputs in f32 and in f64 at a state whose numbers are those of f32.
    pub fn at(&mut self, state: &[f64]) -> impl Iterator<Item = (f32, f64)> {
        let n = self.robot.joints.len();
        let pairs: Vec<((f32, f32), (f64, f64))> = state[..n]
            .iter()
            .zip(&self.robot.joints)
            .map(|(q, joint)| (sines::pair(joint, *q as f32), q.sin_cos()))
            .collect();
        let Self { leaves, .. } = self;
        let leaf = |input: Input| leaves.get(&input).copied();
        let single = |input| match leaf(input) {
            Some(Leaf::Sine(joint)) => pairs[joint].0.0,
            Some(Leaf::Cosine(joint)) => pairs[joint].0.1,
            Some(Leaf::Axis(axis)) => state[axis] as f32,
            None => f32::NAN,
        };
        let double = |input| match leaf(input) {
            Some(Leaf::Sine(joint)) => pairs[joint].1.0,
            Some(Leaf::Cosine(joint)) => pairs[joint].1.1,
            Some(Leaf::Axis(axis)) => state[axis],
            None => f64::NAN,
        };
        self.graph.evaluate(single, &mut self.single);
        self.graph.evaluate(double, &mut self.double);
        let (single, double) = (&self.single, &self.double);
        self.graph.outputs.iter().map(|(_, node)| (single[*node], double[*node]))
    }
}

/// A number of a range, on the grid of f32.
fn on_grid(x: f64, low: f64, high: f64) -> f64 {
    let x = f64::from(x.clamp(low, high) as f32);
    // Rounding must not leave the range.
    if x < low || x > high { f64::from((x * (1.0 - 1e-7)) as f32) } else { x }
}

/// The ranges that states are drawn from: those of the box, but of angles the joint's own.
fn ranges(robot: &Robot) -> Vec<(f64, f64)> {
    let q = robot.joints.iter().map(|joint| (joint.position.low, joint.position.high));
    let rest = robot.whole().into_iter().skip(robot.joints.len()).map(|x| (x.low, x.high));
    q.chain(rest).collect()
}

/// The worst states kept from one generation to the next.
const KEPT: usize = 100;

/// Searches the worst error of each output against the exact function, errors of literals included.
pub fn against(
    exact: &Exact,
    graph: &Graph,
    robot: &Robot,
    effort: Effort,
    seed: u64,
) -> Vec<Observed> {
    let mut evaluation = Evaluation::new(graph, robot);
    worst(robot, graph.outputs.len(), effort, seed, |state| {
        let places = graph.outputs.iter().map(|(offset, _)| *offset as usize / 4);
        let exact = exact.at(state, places);
        let computed = evaluation.at(state);
        let errors =
            computed.zip(exact).map(|((single, _), exact)| (f64::from(single) - exact).abs());
        errors.collect()
    })
}

/// Searches the worst error of each output by the graph alone, its literals taken as they are.
pub fn search(graph: &Graph, robot: &Robot, effort: Effort, seed: u64) -> Vec<Observed> {
    let mut evaluation = Evaluation::new(graph, robot);
    let error = |(a, b): (f32, f64)| (f64::from(a) - b).abs();
    worst(robot, graph.outputs.len(), effort, seed, |state| {
        evaluation.at(state).map(error).collect()
    })
}

/// Searches the states at which each of so many numbers is the greatest.
fn worst(
    robot: &Robot,
    numbers: usize,
    effort: Effort,
    seed: u64,
    mut errors: impl FnMut(&[f64]) -> Vec<f64>,
) -> Vec<Observed> {
    let ranges = ranges(robot);
    let mut rng = Rng::with_seed(seed);
    let mut kept: Vec<Vec<(f64, Vec<f64>)>> = vec![Vec::new(); numbers];
    for number in 0..effort.random {
        // Every other state has speeds and accelerations at their limits, where errors are largest.
        let draw = |(axis, (low, high)): (usize, &(f64, f64))| {
            let share = if number % 2 == 0 && axis >= robot.joints.len() {
                f64::from(u8::from(rng.bool()))
            } else {
                rng.f64()
            };
            on_grid(low + share * (high - low), *low, *high)
        };
        let state: Vec<f64> = ranges.iter().enumerate().map(draw).collect();
        for (kept, error) in kept.iter_mut().zip(errors(&state)) {
            keep(kept, error, &state);
        }
    }
    for (output, kept) in kept.iter_mut().enumerate() {
        evolve(kept, output, &mut errors, &ranges, effort, &mut rng);
    }
    let best = |kept: Vec<(f64, Vec<f64>)>| kept.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
    kept.into_iter()
        .map(|kept| {
            best(kept).map_or_else(Observed::default, |(error, state)| Observed { error, state })
        })
        .collect()
}

fn evolve(
    kept: &mut Vec<(f64, Vec<f64>)>,
    output: usize,
    errors: &mut impl FnMut(&[f64]) -> Vec<f64>,
    ranges: &[(f64, f64)],
    effort: Effort,
    rng: &mut Rng,
) {
    for generation in 0..effort.generations {
        // From half of the range down to the grid of f32.
        let reach = 0.5 * 0.7_f64.powi((generation % 48) as i32);
        for _ in 0..effort.children {
            let parent = &kept[rng.usize(..kept.len())].1;
            let mut state = parent.clone();
            for (x, (low, high)) in state.iter_mut().zip(ranges) {
                if rng.u8(..4) == 0 {
                    let step = (rng.f64() + rng.f64() + rng.f64() - 1.5) * reach * (high - low);
                    *x = on_grid(*x + step, *low, *high);
                }
            }
            keep(kept, errors(&state)[output], &state);
        }
    }
}

/// Keeps a state if it is among the worst.
fn keep(kept: &mut Vec<(f64, Vec<f64>)>, error: f64, state: &[f64]) {
    if kept.len() == KEPT {
        let (least, at) = kept
            .iter()
            .enumerate()
            .map(|(at, one)| (one.0, at))
            .fold((f64::INFINITY, 0), |a, b| if b.0 < a.0 { b } else { a });
        if error <= least {
            return;
        }
        kept.swap_remove(at);
    }
    kept.push((error, state.to_vec()));
}
