//! The proofs by a grid: errors with one kernel of sines or with several at once, and the greatest value of a function.

use super::{Class, Program, Weighted, joined};
use crate::bound::{Bound, SineErrors};
use crate::graph::{Graph, Node};
use crate::interval::half_ulp;
use crate::state_box::{Leaf, Robot};

/// Which errors count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Counted {
    /// Of operations, literals and sines.
    All,
    /// All but those of literals: against the function that has the code's literals.
    WithoutLiterals,
    /// Those of literals alone: how far that function is from the model's.
    LiteralsAlone,
}

impl Program {
    /// Bounds the error over all angles, from a grid of at most so many points; `None` if they are too few. Of what the values are known to be
    /// at most in the box, the lesser bounds count.
    pub fn prove(
        &self,
        graph: &Graph,
        robot: &Robot,
        sines: SineErrors,
        points: usize,
        known: &[f64],
    ) -> Option<Bound> {
        self.proven(graph, robot, (&[sines], known), Counted::All, points)?
            .pop()
    }

    /// The same with each of some kernels of sines: the values of the function are evaluated once for all of them.
    pub fn prove_each(
        &self,
        graph: &Graph,
        robot: &Robot,
        sines: &[SineErrors],
        counted: Counted,
        points: usize,
    ) -> Option<Vec<Bound>> {
        self.proven(graph, robot, (sines, &[]), counted, points)
    }

    fn proven(
        &self,
        graph: &Graph,
        robot: &Robot,
        (sines, known): (&[SineErrors], &[f64]),
        counted: Counted,
        points: usize,
    ) -> Option<Vec<Bound>> {
        let sizes = self.sizes(&self.degrees, points)?;
        let nodes = graph.nodes.len();
        let rounding = rounding(nodes);
        let mut values = self.values(&sizes, rounding);
        for (value, known) in values.iter_mut().zip(known) {
            *value = value.min(*known);
        }
        let weights = sines
            .iter()
            .map(|sines| weights(graph, robot, &values, *sines, counted));
        let weights: Vec<Vec<f64>> = weights.collect();
        let classes = weights
            .iter()
            .map(|weights| self.classes(weights, &sizes, rounding));
        let classes: Vec<Vec<Class>> = classes.collect();
        let sums: Vec<Weighted> = classes
            .iter()
            .flatten()
            .map(|class| joined(&class.sum))
            .collect();
        let sums: Vec<&[(u32, f64)]> = sums.iter().map(Vec::as_slice).collect();
        let mut on_grid = self.greatest(&self.steps, &sizes, &sums).into_iter();
        let mut bounds = Vec::new();
        for (classes, weights) in classes.iter().zip(&weights) {
            let of_class = |(class, most): (&Class, f64)| {
                (most * (1.0 + rounding) + class.hidden) * Class::between(&class.degrees, &sizes)
            };
            let total = classes.iter().zip(&mut on_grid).map(of_class).sum();
            bounds.push(self.shared(graph, weights, &sizes, total));
        }
        Some(bounds)
    }

    /// At least the greatest absolute value of the function, from a grid of at most so many points.
    pub fn greatest_value(&self, points: usize) -> Option<f64> {
        let last = (self.sums.len() / 2).checked_sub(1)?;
        let sizes = self.sizes(&self.degrees[last..=last], points)?;
        let sum: &[(u32, f64)] = &self.sums[last];
        let on_grid = self.greatest(&self.steps[..self.forward], &sizes, &[sum]);
        let most = on_grid[0] + rounding(last + 1) * self.absolute[last];
        Some(most * Class::between(&self.degrees[last], &sizes))
    }
}

/// More than the relative error of an evaluation in f64, of so many operations after each other.
fn rounding(nodes: usize) -> f64 {
    4.0 * f64::EPSILON * nodes as f64
}

/// What each node adds to the error of the result, for an adjoint of one.
fn weights(
    graph: &Graph,
    robot: &Robot,
    values: &[f64],
    sines: SineErrors,
    counted: Counted,
) -> Vec<f64> {
    let nodes = graph.nodes.len();
    let rounds = counted != Counted::LiteralsAlone;
    let (mut errors, mut weights) = (vec![0.0; nodes], vec![0.0; nodes]);
    for (k, node) in graph.nodes.iter().enumerate() {
        let (propagated, second_order) = match *node {
            Node::Input(_) | Node::Literal(_) => (0.0, 0.0),
            Node::Div(..) | Node::Sqrt(_) | Node::InverseRoot(..) => (f64::INFINITY, 0.0),
            Node::Neg(a) => (errors[a], 0.0),
            Node::Add(a, b) | Node::Sub(a, b) => (errors[a] + errors[b], 0.0),
            Node::Mul(a, b) => (
                values[a] * errors[b] + values[b] * errors[a],
                errors[a] * errors[b],
            ),
        };
        let most = (values[k] + propagated + second_order) * (1.0 + 1e-12);
        let own = match *node {
            Node::Input(input) => match robot.leaf(input).filter(|_| rounds) {
                Some(Leaf::Sine(_)) => sines.sine,
                Some(Leaf::Cosine(_)) => sines.cosine,
                _ => 0.0,
            },
            Node::Literal(0.0) | Node::Neg(_) => 0.0,
            Node::Literal(_) if counted == Counted::WithoutLiterals => 0.0,
            Node::Literal(x) => half_ulp(f64::from(x).abs()),
            _ if most == 0.0 || !rounds => 0.0,
            _ => half_ulp(most),
        };
        errors[k] = (propagated + second_order + own) * (1.0 + 1e-12);
        weights[k] = (own + second_order) * (1.0 + 1e-12);
    }
    weights
}
