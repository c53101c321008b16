//! The relative error of reciprocal square roots by an initial estimate from the bits and Newton's
//! steps, found by evaluating every f32.
//!
//! A factor of four in x halves the guess and every number of the steps exactly, as long as no
//! number is subnormal or overflows; so that the relative error over all x is that over [1, 4), of
//! which each number of f32 is tried. The walk reads the steps one by one; here they become one
//! operation.

use std::collections::BTreeMap;
use std::sync::Mutex;

use crate::graph::{Graph, Guess, Node};

/// More than the error of the reference, two operations of f64.
const REFERENCE: f64 = 1e-15;
/// Numbers for which nothing that the steps compute is subnormal or overflows.
pub const RANGE: std::ops::RangeInclusive<f64> = 1e-30..=1e30;

/// The greatest relative error of a guess with its steps.
pub fn relative_error(guess: Guess) -> f64 {
    static KNOWN: Mutex<BTreeMap<Guess, f64>> = Mutex::new(BTreeMap::new());
    let known = KNOWN.lock().ok().and_then(|all| all.get(&guess).copied());
    known.unwrap_or_else(|| {
        let of = |bits: u32| {
            let x = f32::from_bits(bits);
            let y = f64::from(guess.inverse_root(x));
            (y * f64::from(x).sqrt() - 1.0).abs()
        };
        let numbers = 1.0_f32.to_bits()..4.0_f32.to_bits();
        // A NaN stays, whichever numbers follow.
        let worst = numbers.map(of).fold(0.0, |a: f64, b| if b.is_nan() || b > a { b } else { a });
        let error = worst + REFERENCE;
        if let Ok(mut all) = KNOWN.lock() {
            all.insert(guess, error);
        }
        error
    })
}

/// Newton's steps that follow a guess become part of it.
pub fn join_steps(graph: &mut Graph) {
    for k in 0..graph.nodes.len() {
        if let Some(joined) = step(&graph.nodes, k) {
            graph.nodes[k] = joined;
        }
    }
}

/// The reciprocal root y + y (½ − (½ x) y y), if node k is such a step from a known y.
fn step(nodes: &[Node], k: usize) -> Option<Node> {
    let half = |k: usize| nodes[k] == Node::Literal(0.5);
    // The other operand of a product or sum that one fulfils a condition.
    let beside = |pair: (usize, usize), is: &dyn Fn(usize) -> bool| {
        let (a, b) = pair;
        is(a).then_some(b).or_else(|| is(b).then_some(a))
    };
    let factors = |k: usize| match nodes[k] {
        Node::Mul(a, b) => Some((a, b)),
        _ => None,
    };
    let Node::Add(a, b) = nodes[k] else {
        return None;
    };
    [a, b].into_iter().find_map(|y| {
        let Node::InverseRoot(x, guess) = nodes[y] else {
            return None;
        };
        let product = beside((a, b), &|k| k == y)?;
        let rest = beside(factors(product)?, &|k| k == y)?;
        let Node::Sub(one, square) = nodes[rest] else {
            return None;
        };
        let once = beside(factors(square)?, &|k| k == y)?;
        let halved = beside(factors(once)?, &|k| k == y)?;
        let of = beside(factors(halved)?, &half)?;
        let steps = guess.steps.checked_add(1)?;
        (half(one) && of == x).then_some(Node::InverseRoot(x, Guess { steps, ..guess }))
    })
}
