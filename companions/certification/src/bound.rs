//! A bound of a function's rounding error over a box of states.
//!
//! Every operation k of the machine code adds its own error e_k, |e_k| ≤ ½ ulp of the largest value
//! that it has in the box; a literal differs by half an ulp from the number that it stands for, a
//! sine by the error of its kernel. By the mean value theorem the error of the result is Σ e_k
//! ∂τ/∂v_k, with derivatives at some point between the exact values and the computed ones.
//! Intervals that hold both hold that point, so that
//!
//!   |error| ≤ Σ ½ulp(max |v_k|) max |∂τ/∂v_k|,
//!
//! without a term of second order that would be left out. The derivatives are adjoints in reverse
//! mode: Griewank & Walther, Evaluating Derivatives (2008), chapter 3, over intervals.

use serde::{Deserialize, Serialize};

use crate::forms::{self, Form, Rotation, Sum};
use crate::graph::{Graph, Node};
use crate::interval::{Interval, half_ulp};
use crate::roots;
use crate::state_box::{Leaf, Robot, Sector, cosine, sine};

/// The error of a kernel of sines: the most by which a sine or cosine differs from the true one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SineErrors {
    /// The error of the sine.
    pub sine: f64,
    /// The error of the cosine.
    pub cosine: f64,
}

/// A bound, and what it is made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Bound {
    /// The part caused by rounded operations.
    pub operations: f64,
    /// The part caused by the rounding of literals.
    pub literals: f64,
    /// The part caused by the errors of sines and cosines.
    pub sines: f64,
}

impl Bound {
    /// The whole bound: the sum of its three parts.
    pub fn total(self) -> f64 {
        // Three terms: an ulp of the sum more than makes up for two roundings.
        (self.operations + self.literals + self.sines) * (1.0 + 4.0 * f64::EPSILON)
    }
}

/// The function of one output, ready to be bounded over many boxes.
#[derive(Clone, Debug)]
pub struct Bounder {
    graph: Graph,
    /// The coordinate that each input node stands for; `None` for other nodes.
    leaves: Vec<Option<Leaf>>,
    sines: SineErrors,
    /// Sums that are bounded better when they are written out, and all adjoints.
    sums: Vec<Option<Form>>,
    uses: Vec<Form>,
    /// The sectors of the joints' angles.
    sectors: Vec<Sector>,
    /// The derivatives of quotients and roots by their operands.
    slopes: Vec<[Interval; 2]>,
    /// The relative errors of reciprocal roots.
    relative: Vec<f64>,
    /// The values and the adjoints of the nodes, and the greatest error of each.
    pub values: Vec<Interval>,
    /// The range of each node's adjoint.
    pub adjoints: Vec<Interval>,
    /// The greatest error of each node.
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
        let leaves: Vec<Option<Leaf>> = graph.nodes.iter().map(leaf).collect::<Option<_>>()?;
        let zero = vec![Interval::default(); graph.nodes.len()];
        let sums = forms::of_values(&graph, &leaves);
        let uses = forms::of_adjoints(&graph, &leaves);
        let sectors = vec![Sector::default(); robot.joints.len()];
        let relative = |node: &Node| match *node {
            Node::InverseRoot(_, guess) => roots::relative_error(guess),
            _ => 0.0,
        };
        Some(Self {
            slopes: vec![[Interval::default(); 2]; graph.nodes.len()],
            relative: graph.nodes.iter().map(relative).collect(),
            leaves,
            sines,
            sums,
            uses,
            sectors,
            values: zero.clone(),
            adjoints: zero,
            errors: vec![0.0; graph.nodes.len()],
            graph,
        })
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
        if !self.is_finite() {
            // A quotient or a root has no bound over so large a part.
            return Bound { operations: f64::INFINITY, ..Bound::default() };
        }
        self.reverse()
    }

    /// The range of each node, exact and computed, and the error that it adds.
    fn forward(&mut self, states: &[Interval]) {
        for (sector, angles) in self.sectors.iter_mut().zip(states) {
            *sector = Sector::new(*angles);
        }
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
                Node::InverseRoot(a, _) => {
                    let exact = Interval::point(1.0) / values[a].root();
                    let is_tried = roots::RANGE.contains(&values[a].low)
                        && roots::RANGE.contains(&values[a].high);
                    let relative = if is_tried { self.relative[k] } else { f64::INFINITY };
                    (exact, relative * exact.magnitude())
                }
                _ => {
                    let exact = match *node {
                        Node::Div(a, b) => values[a] / values[b],
                        Node::Sqrt(a) => values[a].root(),
                        Node::Add(a, b) => values[a] + values[b],
                        Node::Sub(a, b) => values[a] - values[b],
                        Node::Mul(a, b) if a == b => values[a].square(),
                        Node::Mul(a, b) => values[a] * values[b],
                        _ => Interval::default(),
                    };
                    let written_out = self.sums[k].as_ref().map(|form| self.evaluate(form, values));
                    let exact = written_out.map_or(exact, |other| exact.and(other));
                    // An exact zero has no rounding error.
                    let error = if exact.is_zero() { 0.0 } else { half_ulp(exact.magnitude()) };
                    (exact, error)
                }
            };
            self.values[k] = if error > 0.0 { exact.widened(error) } else { exact };
            self.errors[k] = error;
            self.slopes[k] = self.slopes_of(k);
        }
    }

    /// The derivatives of a quotient or a root by its operands, at any point between exact and
    /// computed values.
    fn slopes_of(&self, k: usize) -> [Interval; 2] {
        let (values, one) = (&self.values, Interval::point(1.0));
        let first = match self.graph.nodes[k] {
            Node::Div(_, b) => return [one / values[b], -(values[k] / values[b])],
            Node::Sqrt(a) => one / values[a].root().times(2.0),
            Node::InverseRoot(a, _) => -(one / (values[a] * values[a].root()).times(2.0)),
            _ => Interval::default(),
        };
        [first, Interval::default()]
    }

    /// Whether every computed number is one of f32, neither infinite nor NaN.
    pub fn is_finite(&self) -> bool {
        self.values.iter().all(|x| x.magnitude() <= f64::from(f32::MAX))
            && self.errors.iter().all(|error| error.is_finite())
    }

    /// The range of a form over values or adjoints.
    fn evaluate(&self, form: &Form, of: &[Interval]) -> Interval {
        let mut range = sum(&form.plain, of);
        for (value, scaled) in &form.scaled {
            range = range + self.values[*value] * sum(scaled, of);
        }
        for rotation in &form.rotations {
            range = range + self.rotation(rotation, of);
        }
        for (k, operand) in &form.steep {
            range = range + self.slopes[*k][*operand] * of[*k];
        }
        if form.errors.is_empty() {
            return range;
        }
        let errors: f64 =
            form.errors.iter().map(|(k, factor)| self.errors[*k] * factor.abs()).sum();
        range.widened(errors * (1.0 + 1e-12))
    }

    /// The range of c a + s b, whose sine and cosine have errors.
    fn rotation(&self, rotation: &Rotation, of: &[Interval]) -> Interval {
        let (a, b) = (sum(&rotation.cosine, of), sum(&rotation.sine, of));
        let errors = self.sines.cosine * a.magnitude() + self.sines.sine * b.magnitude();
        self.sectors[rotation.joint].rotated(a, b).widened(errors * (1.0 + 1e-12))
    }

    /// The derivatives of the output by each node, and the sum of the errors that they carry to it.
    fn reverse(&mut self) -> Bound {
        let mut bound = Bound::default();
        for k in (0..self.graph.nodes.len()).rev() {
            let is_last = k + 1 == self.graph.nodes.len();
            let adjoint = if is_last {
                Interval::point(1.0)
            } else {
                self.evaluate(&self.uses[k], &self.adjoints)
            };
            self.adjoints[k] = adjoint;
            // Rounded up: each sum has a relative error of 2⁻⁵³, which the factor exceeds for all
            // of them.
            let term = self.errors[k] * adjoint.magnitude() * (1.0 + 1e-12);
            match self.graph.nodes[k] {
                Node::Input(_) => bound.sines += term,
                Node::Literal(_) => bound.literals += term,
                _ => bound.operations += term,
            }
        }
        bound
    }
}

fn sum(of: &Sum, values: &[Interval]) -> Interval {
    let term = |(k, factor): &(usize, f64)| match *factor {
        1.0 => values[*k],
        -1.0 => -values[*k],
        factor => values[*k].times(factor),
    };
    let mut terms = of.iter().map(term);
    let first = terms.next().unwrap_or_default();
    terms.fold(first, |sum, term| sum + term)
}
