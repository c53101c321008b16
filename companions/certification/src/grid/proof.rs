//! The proofs by a grid: errors with one kernel of sines or with several at once, and the greatest
//! value of a function.

use std::collections::BinaryHeap;

use super::classes::{Class, Place, Weighted, joined};
use super::lanes::{Ball, Lanes, Plain};
use super::{Lattice, Program};
use crate::bound::{Bound, SineErrors};
use crate::graph::{Graph, Node};
use crate::interval::{Interval, half_ulp};
use crate::parts::Part;
use crate::roots;
use crate::state_box::{Leaf, Robot};

/// The errors that count in a proof.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Counted {
    /// The errors of operations, literals and sines.
    All,
    /// All but those of literals: against the function that has the code's literals.
    WithoutLiterals,
    /// Those of literals alone: how far that function is from the model's.
    LiteralsAlone,
}

/// The power of all points that each part has: with more of them the lattice loses less and a part
/// more.
const PER_PART: f64 = 0.375;

/// The function whose error is bounded, and the errors that count.
#[derive(Clone, Copy)]
struct Subject<'a> {
    graph: &'a Graph,
    robot: &'a Robot,
    counted: Counted,
    /// An upper bound of each value's magnitude, where one is known.
    known: &'a [f64],
}

impl Program {
    /// Bounds the error over all angles, from a grid of at most so many points; `None` if they are
    /// too few. If `known` has a lesser bound of a value in the box, that one counts.
    pub fn prove(
        &self,
        graph: &Graph,
        robot: &Robot,
        sines: SineErrors,
        points: usize,
        known: &[f64],
    ) -> Option<Bound> {
        let counted = Counted::All;
        let subject = Subject { graph, robot, counted, known };
        self.proven(subject, &[sines], points)?.pop()
    }

    /// The same with each of some kernels of sines: the values of the function are evaluated once
    /// for all of them.
    pub fn prove_each(
        &self,
        graph: &Graph,
        robot: &Robot,
        sines: &[SineErrors],
        counted: Counted,
        points: usize,
    ) -> Option<Vec<Bound>> {
        let subject = Subject { graph, robot, counted, known: &[] };
        self.proven(subject, sines, points)
    }

    fn proven(
        &self,
        subject: Subject<'_>,
        sines: &[SineErrors],
        points: usize,
    ) -> Option<Vec<Bound>> {
        let graph = subject.graph;
        if self.parted.contains(&true) {
            let each = sines.iter();
            return each.map(|sines| self.by_parts(subject, *sines, points)).collect();
        }
        let lattice = Lattice::best(&self.highest(&self.degrees), points)?;
        let at = Place { lattice: &lattice, part: &[], rounding: rounding(graph.nodes.len()) };
        let bounds = self.over::<Plain>(subject, sines, &at).into_iter();
        let shared =
            bounds.map(|(total, weights)| self.shared::<Plain>(graph, &weights, &at, total));
        Some(shared.collect())
    }

    /// The bound of each kernel over a part, with the errors that the nodes add.
    fn over<L: Lanes>(
        &self,
        subject: Subject<'_>,
        sines: &[SineErrors],
        at: &Place<'_>,
    ) -> Vec<(f64, Vec<f64>)> {
        let mut values = self.values::<L>(at);
        for ([value, _], known) in values.iter_mut().zip(subject.known) {
            *value = value.min(*known);
        }
        let weights = sines.iter().map(|sines| self.weights(subject, &values, *sines));
        let weights: Vec<Vec<f64>> = weights.collect();
        if weights.iter().flatten().any(|weight| !weight.is_finite()) {
            // A quotient or a root has no bound over so large a part.
            return weights.into_iter().map(|weights| (f64::INFINITY, weights)).collect();
        }
        let classes = weights.iter().map(|weights| self.classes::<L>(weights, at));
        let classes: Vec<Vec<Class>> = classes.collect();
        let sums: Vec<Weighted> =
            classes.iter().flatten().map(|class| joined(&class.sum)).collect();
        let sums: Vec<&[(u32, f64)]> = sums.iter().map(Vec::as_slice).collect();
        let mut on_grid = self.greatest::<L>(&self.steps, at, &sums).into_iter();
        let up = 1.0 + rounding(values.len());
        let total = |classes: &Vec<Class>| {
            let of_class = |(class, most): (&Class, f64)| {
                (most * up + class.hidden) * at.lattice.between(&class.degrees)
            };
            classes.iter().zip(&mut on_grid).map(of_class).sum()
        };
        let totals: Vec<f64> = classes.iter().map(total).collect();
        totals.into_iter().zip(weights).collect()
    }

    /// Branch and bound over the coordinates without a grid: so many points in all.
    fn by_parts(&self, subject: Subject<'_>, sines: SineErrors, points: usize) -> Option<Bound> {
        let lattice =
            Lattice::best(&self.highest(&self.degrees), (points as f64).powf(PER_PART) as usize)?;
        let whole = subject.robot.whole();
        let bounded = |positions: Vec<Interval>| {
            let at = Place::part(&lattice, &positions);
            let (bound, _) = self.over::<Ball>(subject, &[sines], &at).remove(0);
            let parted = (0..positions.len()).filter(|joint| self.parted[*joint]);
            let share = |joint: &usize| positions[*joint].width() / whole[*joint].width();
            Part { bound, axis: parted.max_by(|a, b| share(a).total_cmp(&share(b))), positions }
        };
        let mut queue = BinaryHeap::from([bounded(whole[..self.parted.len()].to_vec())]);
        for _ in 0..points / lattice.points() / 2 {
            let halves = queue.peek().and_then(Part::halves);
            let Some(halves) = halves else { break };
            queue.pop();
            queue.extend(halves.map(bounded));
        }
        let Part { bound, positions, .. } = queue.pop()?;
        let at = Place::part(&lattice, &positions);
        let (_, weights) = self.over::<Ball>(subject, &[sines], &at).remove(0);
        bound.is_finite().then(|| self.shared::<Ball>(subject.graph, &weights, &at, bound))
    }

    /// The greatest of some degrees in each angle.
    pub(super) fn highest(&self, of: &[Vec<u8>]) -> Vec<usize> {
        let degree = |i: usize| of.iter().map(|of| usize::from(of[i])).max().unwrap_or(0);
        (0..self.parted.len()).map(degree).collect()
    }

    /// The greatest absolute value of each node over all angles and speeds, and of the reciprocals
    /// of quotients and roots.
    fn values<L: Lanes>(&self, at: &Place<'_>) -> Vec<[f64; 2]> {
        let nodes = self.inverses.len();
        let inverses: Vec<Weighted> = self
            .inverses
            .iter()
            .map(|place| place.map(|place| (place, 1.0)).into_iter().collect())
            .collect();
        let sums = self.sums[..nodes].iter().chain(&inverses);
        let sums: Vec<&[(u32, f64)]> = sums.map(Vec::as_slice).collect();
        let on_grid = self.greatest::<L>(&self.steps[..self.forward], at, &sums);
        let everywhere = |k: usize| {
            let most = on_grid[k] * (1.0 + 1e-12) + at.rounding * self.absolute[k];
            [most * at.lattice.between(&self.degrees[k]), on_grid[nodes + k] * (1.0 + 1e-12)]
        };
        (0..nodes).map(everywhere).collect()
    }

    /// The contribution of each node to the error of the result, for an adjoint of one.
    fn weights(&self, subject: Subject<'_>, values: &[[f64; 2]], sines: SineErrors) -> Vec<f64> {
        let Subject { graph, robot, counted, .. } = subject;
        let nodes = graph.nodes.len();
        let rounds = counted != Counted::LiteralsAlone;
        let (mut errors, mut weights) = (vec![0.0; nodes], vec![0.0; nodes]);
        for (k, node) in graph.nodes.iter().enumerate() {
            let [value, inverse] = values[k];
            // The factors 1/b of a quotient and 1/√a of a root are at most `inverse`; the terms of
            // higher order grow without bound as t nears one.
            let higher = |t: f64, of: f64| if t < 1.0 { of } else { f64::INFINITY };
            let (propagated, second_order) = match *node {
                Node::Input(_) | Node::Literal(_) => (0.0, 0.0),
                Node::Neg(a) => (errors[a], 0.0),
                Node::Add(a, b) | Node::Sub(a, b) => (errors[a] + errors[b], 0.0),
                Node::Mul(a, b) => {
                    (values[a][0] * errors[b] + values[b][0] * errors[a], errors[a] * errors[b])
                }
                // d = (d_a − v d_b)/b · 1/(1 + d_b/b)
                Node::Div(a, b) => {
                    let first = (errors[a] + value * errors[b]) * inverse;
                    let t = errors[b] * inverse;
                    (first, higher(t, first * t / (1.0 - t)))
                }
                // √(1 + u) = 1 + u/2 − u²/8 (1 + ξ)^(−3/2), and 1/√(1 + u) = 1 − u/2 + 3/8 u² (1 +
                // ξ)^(−5/2)
                Node::Sqrt(a) | Node::InverseRoot(a, _) => {
                    let t = errors[a] * inverse * inverse;
                    let rest = match node {
                        Node::Sqrt(_) => t * t / 8.0 * (1.0 - t).powf(-1.5),
                        _ => 0.375 * t * t * (1.0 - t).powf(-2.5),
                    };
                    (0.5 * t * value, higher(t, rest * value))
                }
            };
            let most = (value + propagated + second_order) * (1.0 + 1e-12);
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
                Node::InverseRoot(a, guess) => {
                    let least = (inverse * inverse).recip() - errors[a];
                    let is_tried = *roots::RANGE.start() < least
                        && values[a][0] + errors[a] < *roots::RANGE.end();
                    higher(f64::from(u8::from(!is_tried)), roots::relative_error(guess) * most)
                }
                _ => half_ulp(most),
            };
            errors[k] = (propagated + second_order + own) * (1.0 + 1e-12);
            weights[k] = (own + second_order) * (1.0 + 1e-12);
        }
        weights
    }
}

/// More than the relative error of an evaluation in f64, of so many operations after each other and
/// of sums of what they give.
pub(super) fn rounding(nodes: usize) -> f64 {
    64.0 * f64::EPSILON * nodes as f64
}
