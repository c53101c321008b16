//! A bound of a function's rounding error over a box of states.
//!
//! Every operation k of the machine code adds its own error e_k, |e_k| ≤ ½ ulp of the largest value that it has in the box; a literal
//! differs by half an ulp from the number that it stands for, a sine by the error of its kernel. By the mean value theorem the error of
//! the result is Σ e_k ∂τ/∂v_k, with derivatives at some point between the exact values and the computed ones. Intervals that hold
//! both hold that point, so that
//!
//!   |error| ≤ Σ ½ulp(max |v_k|) max |∂τ/∂v_k|,
//!
//! without a term of second order that would be left out. The derivatives are adjoints in reverse mode: Griewank & Walther, Evaluating
//! Derivatives (2008), chapter 3, over intervals.

use serde::{Deserialize, Serialize};

use crate::graph::{Graph, Node};
use crate::interval::{Interval, half_ulp};
use crate::state_box::{Leaf, Robot, cosine, sine};

/// The error of a kernel of sines: the most by which a sine or cosine differs from the true one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SineErrors {
    /// Of the sine.
    pub sine: f64,
    /// Of the cosine.
    pub cosine: f64,
}

/// A bound, and what it is made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Bound {
    /// By rounded operations.
    pub operations: f64,
    /// By literals.
    pub literals: f64,
    /// By sines and cosines.
    pub sines: f64,
}

impl Bound {
    /// The whole bound.
    pub fn total(self) -> f64 {
        // Three terms: an ulp of the sum more than makes up for two roundings.
        (self.operations + self.literals + self.sines) * (1.0 + 4.0 * f64::EPSILON)
    }
}

/// The function of one output, ready to be bounded over many boxes.
#[derive(Clone, Debug)]
pub struct Bounder {
    graph: Graph,
    /// What each input is, by node.
    leaves: Vec<Option<Leaf>>,
    sines: SineErrors,
    /// The values and the adjoints of the nodes, and the greatest error of each.
    pub values: Vec<Interval>,
    /// See `values`.
    pub adjoints: Vec<Interval>,
    /// See `values`.
    pub errors: Vec<f64>,
}

impl Bounder {
    /// The bounder of a graph's output, whose inputs are the robot's; `None` if one is not.
    pub fn new(graph: &Graph, output: usize, robot: &Robot, sines: SineErrors) -> Option<Self> {
        let graph = graph.of_output(output);
        let leaf = |node: &Node| match node {
            Node::Input(input) => robot.leaf(*input).map(Some),
            _ => Some(None),
        };
        let leaves = graph.nodes.iter().map(leaf).collect::<Option<_>>()?;
        let zero = vec![Interval::default(); graph.nodes.len()];
        Some(Self { leaves, sines, values: zero.clone(), adjoints: zero, errors: vec![0.0; graph.nodes.len()], graph })
    }

    /// The graph of the output alone.
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// What a node is, if it is an input.
    pub fn leaf(&self, node: usize) -> Option<Leaf> {
        self.leaves[node]
    }

    /// The coordinates that the output depends on.
    pub fn axes(&self) -> Vec<usize> {
        let axis = |leaf: &Leaf| match *leaf {
            Leaf::Sine(axis) | Leaf::Cosine(axis) | Leaf::Axis(axis) => axis,
        };
        let mut axes: Vec<usize> = self.leaves.iter().flatten().map(axis).collect();
        axes.sort_unstable();
        axes.dedup();
        axes
    }

    /// The range of the computed output, after a bound was computed.
    pub fn range(&self) -> Interval {
        self.values.last().copied().unwrap_or_default()
    }

    /// The bound over a box of the robot's coordinates.
    pub fn bound(&mut self, states: &[Interval]) -> Bound {
        self.forward(states);
        self.reverse()
    }

    /// The range of each node, exact and computed, and the error that it adds.
    fn forward(&mut self, states: &[Interval]) {
        for (k, node) in self.graph.nodes.iter().enumerate() {
            let values = &self.values;
            let (exact, error) = match *node {
                Node::Input(_) => match self.leaves[k] {
                    Some(Leaf::Sine(axis)) => (sine(states[axis]), self.sines.sine),
                    Some(Leaf::Cosine(axis)) => (cosine(states[axis]), self.sines.cosine),
                    Some(Leaf::Axis(axis)) => (states[axis], 0.0),
                    None => (Interval::default(), 0.0),
                },
                // Zero is no rounded number.
                Node::Literal(0.0) => (Interval::default(), 0.0),
                Node::Literal(x) => (Interval::point(x.into()), half_ulp(f64::from(x).abs())),
                Node::Neg(a) => (-values[a], 0.0),
                _ => {
                    let exact = match *node {
                        Node::Add(a, b) => values[a] + values[b],
                        Node::Sub(a, b) => values[a] - values[b],
                        Node::Mul(a, b) if a == b => values[a].square(),
                        Node::Mul(a, b) => values[a] * values[b],
                        _ => Interval::default(),
                    };
                    (exact, half_ulp(exact.magnitude()))
                }
            };
            self.values[k] = if error > 0.0 { exact.widened(error) } else { exact };
            self.errors[k] = error;
        }
    }

    /// The derivatives of the output by each node, and the sum of the errors that they carry to it.
    fn reverse(&mut self) -> Bound {
        let Self { graph, values, adjoints, errors, .. } = self;
        adjoints.fill(Interval::default());
        if let Some(last) = adjoints.last_mut() {
            *last = Interval::point(1.0);
        }
        let mut bound = Bound::default();
        for (k, node) in graph.nodes.iter().enumerate().rev() {
            let adjoint = adjoints[k];
            // Rounded up: each sum has a relative error of 2⁻⁵³, which the factor exceeds for all of them.
            let term = errors[k] * adjoint.magnitude() * (1.0 + 1e-12);
            match *node {
                Node::Input(_) => bound.sines += term,
                Node::Literal(_) => bound.literals += term,
                Node::Neg(a) => adjoints[a] = adjoints[a] - adjoint,
                Node::Add(a, b) => {
                    adjoints[a] = adjoints[a] + adjoint;
                    adjoints[b] = adjoints[b] + adjoint;
                }
                Node::Sub(a, b) => {
                    adjoints[a] = adjoints[a] + adjoint;
                    adjoints[b] = adjoints[b] - adjoint;
                }
                Node::Mul(a, b) => {
                    adjoints[a] = adjoints[a] + adjoint * values[b];
                    adjoints[b] = adjoints[b] + adjoint * values[a];
                }
            }
            if matches!(node, Node::Add(..) | Node::Sub(..) | Node::Mul(..)) {
                bound.operations += term;
            }
        }
        bound
    }
}
