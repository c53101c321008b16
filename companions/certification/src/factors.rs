//! The check that machine code of forward dynamics factors M = Lᵀ D L and solves with the factors,
//! and the count of its roundings.
//!
//! The recursion (RBDA, tables 6.3 and 6.4) is written down here once more, over expressions: of
//! the entries of M, which are those of the engine's `crba`, and of torques less biases it makes
//! the accelerations. They must be the expressions of the machine code, operation by operation.
//! Compared are normal forms, in which operands of sums and products have no order, signs are
//! carried outwards and what is known to the compiler is computed: rounding to nearest knows no
//! order and no sign, so that all expressions of a normal form have one value.
//!
//! With the unit roundoff u = 2⁻²⁴ and 1 + θ_m for a product of m factors (1 + δ)^±1, |δ| ≤ u,
//! |θ_m| ≤ γ_m = m u / (1 − m u) (Higham, Accuracy and Stability of Numerical Algorithms, 2002,
//! lemma 3.1), let d_k be the exact reciprocal of the computed 1/D_k. Each entry of M̂ is a sum of
//! what was subtracted from it and what is left,
//!
//!   M̂_ij = Σ_k d_k l_ki l_kj (1 + θ_f),   (τ − b̂)_i = Σ_j Σ_k d_k l_ki l_kj (1 + θ_s) q̈_j,
//!
//! as in his theorems 10.3 and 10.4 of Cholesky, so that (M̂ + E) q̈ = τ − b̂ of the computed q̈,
//! with |E_ij| ≤ γ_m Σ_k d_k |l_ki l_kj| where m = f + s is the number of roundings that
//! [`Factored::roundings`] has.

use std::cmp::Ordering;
use std::collections::HashMap;

use crate::error::{Error, Result};
use crate::graph::{Graph, Guess, Input, Node, operands};
use crate::walk::Walked;

/// A value up to its sign: what it is computed from, by number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Key {
    Input(Input),
    /// The bits of a number that is not negative.
    Literal(u32),
    /// The first and the second, or less the second.
    Sum(usize, usize, bool),
    Product(usize, usize),
    Quotient(usize, usize),
    Absolute(usize),
    Root(Term),
    InverseRoot(Term, Guess),
}

/// A value: its number, and whether it is negated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Term {
    key: usize,
    minus: bool,
}

impl Term {
    fn negated_if(self, minus: bool) -> Self {
        Self { minus: self.minus != minus, ..self }
    }
}

/// All values so far, each once.
#[derive(Default)]
struct Terms {
    numbers: HashMap<Key, usize>,
    keys: Vec<Key>,
}

impl Terms {
    fn of(&mut self, key: Key, minus: bool) -> Term {
        let keys = &mut self.keys;
        let number = *self.numbers.entry(key).or_insert_with(|| {
            keys.push(key);
            keys.len() - 1
        });
        Term { key: number, minus }
    }

    fn literal(&mut self, x: f32) -> Term {
        self.of(Key::Literal(x.abs().to_bits()), x < 0.0)
    }

    /// The number that a term is, if it is one.
    fn number(&self, term: Term) -> Option<f32> {
        match self.keys[term.key] {
            Key::Literal(bits) if term.minus => Some(-f32::from_bits(bits)),
            Key::Literal(bits) => Some(f32::from_bits(bits)),
            _ => None,
        }
    }

    /// The number by which a term is a multiple of another, if it is one.
    fn share(&self, term: Term, of: Term) -> Option<f32> {
        let Key::Product(a, b) = self.keys[term.key] else {
            return None;
        };
        let other = if a == of.key { b } else { a };
        let minus = term.minus != of.minus;
        let number = self.number(Term { key: other, minus });
        number.filter(|_| a == of.key || b == of.key)
    }

    fn is_zero(&self, term: Term) -> bool {
        self.number(term) == Some(0.0)
    }

    fn sum(&mut self, a: Term, b: Term) -> Term {
        match (self.number(a), self.number(b)) {
            (Some(a), Some(b)) => return self.literal(a + b),
            (Some(0.0), _) => return b,
            (_, Some(0.0)) => return a,
            _ if a == b.negated_if(true) => return self.literal(0.0),
            _ => {}
        }
        let (a, b) = if a.key <= b.key { (a, b) } else { (b, a) };
        self.of(Key::Sum(a.key, b.key, a.minus != b.minus), a.minus)
    }

    fn difference(&mut self, a: Term, b: Term) -> Term {
        self.sum(a, b.negated_if(true))
    }

    fn product(&mut self, a: Term, b: Term) -> Term {
        for (a, b) in [(a, b), (b, a)] {
            match (self.number(a), self.number(b)) {
                (Some(a), Some(b)) => return self.literal(a * b),
                (Some(0.0), _) => return a,
                (Some(one), _) if one.abs() == 1.0 => return b.negated_if(a.minus),
                _ => {}
            }
        }
        let (low, high) = (a.key.min(b.key), a.key.max(b.key));
        self.of(Key::Product(low, high), a.minus != b.minus)
    }

    fn quotient(&mut self, a: Term, b: Term) -> Term {
        if let (Some(a), Some(b)) = (self.number(a), self.number(b)) {
            return self.literal(a / b);
        }
        self.of(Key::Quotient(a.key, b.key), a.minus != b.minus)
    }

    /// The terms of a graph's nodes.
    fn all(&mut self, graph: &Graph) -> Vec<Term> {
        let mut terms: Vec<Term> = Vec::new();
        for node in &graph.nodes {
            let term = match *node {
                Node::Input(input) => self.of(Key::Input(input), false),
                Node::Literal(x) => self.literal(x),
                Node::Neg(a) => terms[a].negated_if(true),
                Node::Add(a, b) => self.sum(terms[a], terms[b]),
                Node::Sub(a, b) => self.difference(terms[a], terms[b]),
                Node::Mul(a, b) => self.product(terms[a], terms[b]),
                Node::Div(a, b) => self.quotient(terms[a], terms[b]),
                Node::Abs(a) => match self.number(terms[a]) {
                    Some(x) => self.literal(x.abs()),
                    None => self.of(Key::Absolute(terms[a].key), false),
                },
                Node::Sqrt(a) => self.of(Key::Root(terms[a]), false),
                Node::InverseRoot(a, guess) => self.of(Key::InverseRoot(terms[a], guess), false),
            };
            terms.push(term);
        }
        terms
    }
}

/// The results of the recursion, from M and from the torques less the biases.
struct Solved {
    accelerations: Vec<Term>,
    /// D, not yet its reciprocals.
    pivots: Vec<Term>,
    roundings: Vec<Vec<u32>>,
}

/// In which order the last substitution subtracts from an acceleration the products with those of
/// the joint's ancestors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// From the base's joint to the parent, as the engine.
    Outward,
    /// From the parent to the base's joint, as the core.
    Inward,
}

/// The recursion on the lower triangle of M, by rows.
fn solve(terms: &mut Terms, mut m: Vec<Vec<Term>>, mut x: Vec<Term>, order: Order) -> Solved {
    let (n, one) = (x.len(), terms.literal(1.0));
    let mut pivots = vec![one; n];
    let mut inverse = vec![one; n];
    // By which of the subtractions from row i, from one on, row k has its share.
    let mut turns = vec![vec![None; n]; n];
    let mut subtracted = vec![0; n];
    for k in (0..n).rev() {
        pivots[k] = m[k][k];
        inverse[k] = terms.quotient(one, m[k][k]);
        for i in (0..k).rev() {
            if terms.is_zero(m[k][i]) {
                continue;
            }
            let l = terms.product(m[k][i], inverse[k]);
            let of_k = m[k].clone();
            for (entry, other) in m[i].iter_mut().zip(of_k) {
                let share = terms.product(l, other);
                *entry = terms.difference(*entry, share);
            }
            m[k][i] = l;
            subtracted[i] += 1;
            turns[k][i] = Some(subtracted[i]);
        }
    }
    for k in (0..n).rev() {
        for i in 0..k {
            let share = terms.product(m[k][i], x[k]);
            x[i] = terms.difference(x[i], share);
        }
    }
    for k in 0..n {
        x[k] = terms.product(x[k], inverse[k]);
        for place in 0..k {
            let i = match order {
                Order::Outward => place,
                Order::Inward => k - 1 - place,
            };
            let share = terms.product(m[k][i], x[i]);
            x[k] = terms.difference(x[k], share);
        }
    }
    Solved { accelerations: x, pivots, roundings: roundings(&turns, &subtracted, order) }
}

/// f + s of each entry, the most of any k.
fn roundings(turns: &[Vec<Option<u32>>], subtracted: &[u32], order: Order) -> Vec<Vec<u32>> {
    let n = subtracted.len();
    // The product with l_ki and the subtractions from row i, or from torque i, before its own;
    // without such a product all of them.
    let inward = |k: usize, i: usize| match k == i {
        true => Some(subtracted[i]),
        false => turns[k][i],
    };
    // The same of acceleration k, from which products with the accelerations of its ancestors are
    // subtracted.
    let outward = |k: usize, j: usize| {
        let before = match order {
            _ if k == j => 0..n,
            Order::Outward => 0..j + 1,
            Order::Inward => j..n,
        };
        inward(k, j)?;
        Some(turns[k][before].iter().flatten().count() as u32)
    };
    let of = |i: usize, j: usize| {
        let by = |k: usize| {
            // The roundings of l, or of 1/D; then those of y, of D⁻¹ y and of torque less bias.
            let factors = inward(k, i.max(j))? + 1;
            Some(factors + inward(k, i)? + 1 + outward(k, j)? + 1)
        };
        (i.max(j)..n).filter_map(by).max().unwrap_or(0)
    };
    (0..n).map(|i| (0..n).map(|j| of(i, j)).collect()).collect()
}

/// The threshold that a pivot must exceed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Noise {
    /// A number, kg·m² or kg: infinity if it depends on torques.
    pub least: f64,
    /// A share of the entry of M in which the pivot begins.
    pub share: f64,
}

/// The factors and the solution that machine code of forward dynamics computes.
#[derive(Clone, Debug)]
pub struct Factored {
    /// Its results are the biases b and the lower triangle of M, by rows: offsets 4 i and 4 (n + n
    /// i + j).
    pub graph: Graph,
    /// The count m of roundings, as above, for each entry of M.
    pub roundings: Vec<Vec<u32>>,
    /// The greatest threshold that each pivot is compared with; `None` if it is not compared.
    pub noise: Vec<Option<Noise>>,
    /// The joints whose pivots are compared with what depends on the state in another way than M,
    /// and the nodes of the graph that this is.
    pub others: Vec<(usize, usize)>,
}

/// The argument that torques are.
const TORQUES: u8 = 3;

fn other(what: String) -> Error {
    Error::Factors { what }
}

impl Factored {
    /// Recognises the recursion in the machine code of forward dynamics, with that of the inertia
    /// matrix.
    ///
    /// # Errors
    /// [`Error::Factors`] of what is not that of the recursion.
    pub fn of(forward: &Walked, matrix: &Graph, order: Order) -> Result<Self> {
        let (code, n) = (&forward.graph, forward.graph.outputs.len());
        let mut terms = Terms::default();
        let (mine, entries) = (terms.all(code), terms.all(matrix));
        let entry = |i: usize, j: usize| {
            let offset = 4 * (n * i + j) as u32;
            let found = matrix.outputs.iter().find(|output| output.0 == offset);
            let found = found.map(|output| output.1);
            found.ok_or_else(|| other(format!("entry {}, {} of M", i + 1, j + 1)))
        };
        let rows = |i: usize| (0..=i).map(move |j| (i, j));
        let lower = (0..n).map(|i| rows(i).map(|(i, j)| Ok(entries[entry(i, j)?])).collect());
        let lower = lower.collect::<Result<Vec<Vec<Term>>>>()?;
        let mut graph = code.clone();
        graph.outputs.clear();
        let mut rest = Vec::new();
        let depends = on_torques(code);
        for i in 0..n {
            let (left, bias) = remaining(&mut terms, code, (&mine, &depends), i);
            rest.push(left);
            let bias = match bias {
                Bias::At(node) => node,
                Bias::Negated(node) => pushed(&mut graph, Node::Neg(node)),
                Bias::None => pushed(&mut graph, Node::Literal(0.0)),
            };
            graph.outputs.push((4 * i as u32, bias));
        }
        let moved = graph.nodes.len();
        let nodes = matrix.nodes.iter().map(|node| node.moved(|a| a + moved));
        graph.nodes.extend(nodes);
        for (i, j) in (0..n).flat_map(rows) {
            let offset = 4 * (n + n * i + j) as u32;
            graph.outputs.push((offset, moved + entry(i, j)?));
        }
        let diagonal: Vec<Term> = (0..n).map(|k| lower[k][k]).collect();
        let solved = solve(&mut terms, lower, rest, order);
        for (i, acceleration) in solved.accelerations.iter().enumerate() {
            if code.outputs[i].0 != 4 * i as u32 || mine[code.outputs[i].1] != *acceleration {
                return Err(other(format!("acceleration {}", i + 1)));
            }
        }
        let (mut noise, mut others) = (vec![None; n], Vec::new());
        for one in &forward.comparisons {
            let [a, b] = one.nodes;
            let (pivot, node) = match one.ordering {
                Ordering::Less => (b, a),
                _ => (a, b),
            };
            let (pivot, least) = (mine[pivot], mine[node]);
            let joint = solved.pivots.iter().position(|known| *known == pivot);
            let Some(joint) = joint.filter(|_| one.ordering != Ordering::Equal) else {
                return Err(other(format!("comparison at {:#010x}", one.address)));
            };
            let known: &mut Noise = noise[joint].get_or_insert_default();
            if let Some(share) = terms.share(least, diagonal[joint]) {
                known.share = known.share.max(share.into());
            } else if let Some(number) = terms.number(least) {
                known.least = known.least.max(number.into());
            } else if depends[node] {
                // The box does not bound torques.
                known.least = f64::INFINITY;
            } else {
                others.push((joint, node));
            }
        }
        Ok(Self { graph, roundings: solved.roundings, noise, others })
    }
}

fn pushed(graph: &mut Graph, node: Node) -> usize {
    graph.nodes.push(node);
    graph.nodes.len() - 1
}

/// The place of a bias in the expression, if there is one, and its sign.
enum Bias {
    None,
    At(usize),
    Negated(usize),
}

/// Whether each node depends on torques.
fn on_torques(code: &Graph) -> Vec<bool> {
    let mut depends: Vec<bool> = Vec::new();
    for node in &code.nodes {
        let is_torque = matches!(node, Node::Input(input) if input.argument == TORQUES);
        let mut by = operands(*node).into_iter().flatten();
        depends.push(is_torque || by.any(|a| depends[a]));
    }
    depends
}

/// The torque of a joint less what does not depend on torques, which is its bias if the result is
/// that of the recursion.
fn remaining(
    terms: &mut Terms,
    code: &Graph,
    (mine, depends): (&[Term], &[bool]),
    joint: usize,
) -> (Term, Bias) {
    let input = Input { argument: TORQUES, offset: 4 * joint as u32 };
    let torque = terms.of(Key::Input(input), false);
    let own = |a: usize, b: usize| (mine[a].key == torque.key && !depends[b]).then_some(b);
    let found = code.nodes.iter().enumerate().find_map(|(k, node)| match *node {
        Node::Add(a, b) | Node::Sub(a, b) => Some((k, own(a, b).or(own(b, a))?)),
        _ => None,
    });
    let Some((k, bias)) = found else {
        return (torque, Bias::None);
    };
    let less = terms.difference(torque, mine[bias]);
    if less.key == mine[k].key {
        return (less, Bias::At(bias));
    }
    (terms.sum(torque, mine[bias]), Bias::Negated(bias))
}
