//! Sums as linear forms of products, so that what belongs together is bounded together.
//!
//! Interval arithmetic forgets where a number comes from: it bounds c x + s y by |x| + |y| although
//! (c, s) is a point of the circle, and p − (p − q) by three times what it is. Here a sum is
//! written out over its products; a product that occurs twice is counted once with the sum of its
//! signs, and those with the sine and the cosine of one joint make a [`Rotation`], whose range over
//! a sector of angles is known in closed form. The same holds of adjoints, which are sums over the
//! places where a value is used.

use std::collections::BTreeMap;

use crate::graph::{Graph, Node};
use crate::state_box::Leaf;

/// Nodes with their factors, small integers.
pub type Sum = Vec<(usize, f64)>;

/// c a + s b of one joint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rotation {
    /// The joint whose angle rotates.
    pub joint: usize,
    /// The sum a, which the cosine multiplies.
    pub cosine: Sum,
    /// The sum b, which the sine multiplies.
    pub sine: Sum,
}

/// A value as a sum.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Form {
    /// Numbers themselves: values, or adjoints.
    pub plain: Sum,
    /// Sums that a value multiplies.
    pub scaled: Vec<(usize, Sum)>,
    /// The terms that are rotations by a joint's angle.
    pub rotations: Vec<Rotation>,
    /// The nodes whose rounding errors the sum has beside these.
    pub errors: Sum,
    /// For adjoints: the nodes that are quotients or roots, and which operand is meant, the first
    /// or the second.
    pub steep: Vec<(usize, usize)>,
}

/// Longer sums are not written out.
const LONGEST: usize = 8;

/// The form of each sum of a graph that says more than the sum itself.
pub fn of_values(graph: &Graph, leaves: &[Option<Leaf>]) -> Vec<Option<Form>> {
    let is_sum = |k: usize| matches!(graph.nodes[k], Node::Add(..) | Node::Sub(..));
    (0..graph.nodes.len()).map(|k| if is_sum(k) { value(graph, leaves, k) } else { None }).collect()
}

fn value(graph: &Graph, leaves: &[Option<Leaf>], sum: usize) -> Option<Form> {
    let (mut atoms, mut errors) = (BTreeMap::<usize, f64>::new(), BTreeMap::<usize, f64>::new());
    let (mut open, mut occurrences) = (vec![(sum, 1.0)], 0);
    while let Some((k, factor)) = open.pop() {
        let is_short = atoms.len() + open.len() < LONGEST;
        let inner = match graph.nodes[k] {
            Node::Add(a, b) if is_short => Some([(a, factor), (b, factor)]),
            Node::Sub(a, b) if is_short => Some([(a, factor), (b, -factor)]),
            Node::Neg(a) => {
                open.push((a, -factor));
                continue;
            }
            _ => None,
        };
        let Some(inner) = inner else {
            *atoms.entry(k).or_default() += factor;
            occurrences += 1;
            continue;
        };
        open.extend(inner);
        if k != sum {
            *errors.entry(k).or_default() += factor;
        }
    }
    let merged = atoms.len() < occurrences;
    let mut turns = BTreeMap::<usize, Rotation>::new();
    for (&k, &factor) in &atoms {
        if let Some((is_sine, joint, other)) = turned(graph, leaves, k) {
            let turn = turns.entry(joint).or_default();
            turn.joint = joint;
            let side = if is_sine { &mut turn.sine } else { &mut turn.cosine };
            side.push((other, factor));
        }
    }
    turns.retain(|_, turn| !turn.sine.is_empty() && !turn.cosine.is_empty());
    if !merged && turns.is_empty() {
        return None;
    }
    let mut form = Form::default();
    for (k, factor) in atoms {
        match turned(graph, leaves, k).filter(|(_, joint, _)| turns.contains_key(joint)) {
            Some(_) => *errors.entry(k).or_default() += factor,
            None => form.plain.push((k, factor)),
        }
    }
    form.rotations = turns.into_values().collect();
    form.errors = errors.into_iter().filter(|(_, factor)| *factor != 0.0).collect();
    Some(form)
}

/// Whether a node is a product with a sine or cosine: whether with the sine, of which joint, and
/// the other factor.
fn turned(graph: &Graph, leaves: &[Option<Leaf>], k: usize) -> Option<(bool, usize, usize)> {
    let Node::Mul(a, b) = graph.nodes[k] else {
        return None;
    };
    let side = |leaf: usize, other: usize| match leaves[leaf] {
        Some(Leaf::Sine(joint)) => Some((true, joint, other)),
        Some(Leaf::Cosine(joint)) => Some((false, joint, other)),
        _ => None,
    };
    side(a, b).or_else(|| side(b, a))
}

/// The form of each node's adjoint: plain terms are adjoints, and so are those of the sums.
pub fn of_adjoints(graph: &Graph, leaves: &[Option<Leaf>]) -> Vec<Form> {
    // A term is an adjoint, times a value if there is one.
    type Terms = BTreeMap<(Option<usize>, usize), f64>;
    let mut terms: Vec<Terms> = vec![Terms::new(); graph.nodes.len()];
    let mut steep: Vec<Vec<(usize, usize)>> = vec![Vec::new(); graph.nodes.len()];
    for k in (0..graph.nodes.len()).rev() {
        let pass = |terms: &mut Vec<Terms>, to: usize, factor: f64| {
            // Short sums are passed on term by term, so that terms which cancel do so here too.
            let is_long = terms[k].len() + terms[to].len() > LONGEST;
            let passed = if terms[k].is_empty() || !steep[k].is_empty() || is_long {
                Terms::from([((None, k), 1.0)])
            } else {
                terms[k].clone()
            };
            for (term, of) in passed {
                *terms[to].entry(term).or_default() += factor * of;
            }
        };
        match graph.nodes[k] {
            Node::Add(a, b) => {
                pass(&mut terms, a, 1.0);
                pass(&mut terms, b, 1.0);
            }
            Node::Sub(a, b) => {
                pass(&mut terms, a, 1.0);
                pass(&mut terms, b, -1.0);
            }
            Node::Neg(a) => pass(&mut terms, a, -1.0),
            Node::Mul(a, b) => {
                *terms[a].entry((Some(b), k)).or_default() += 1.0;
                *terms[b].entry((Some(a), k)).or_default() += 1.0;
            }
            Node::Div(a, b) => {
                steep[a].push((k, 0));
                steep[b].push((k, 1));
            }
            Node::Sqrt(a) | Node::InverseRoot(a, _) => steep[a].push((k, 0)),
            Node::Input(_) | Node::Literal(_) => {}
        }
    }
    let both = terms.into_iter().zip(steep);
    both.map(|(terms, steep)| Form { steep, ..adjoint(terms, leaves) }).collect()
}

fn adjoint(terms: BTreeMap<(Option<usize>, usize), f64>, leaves: &[Option<Leaf>]) -> Form {
    let mut form = Form::default();
    let mut scaled = BTreeMap::<usize, Sum>::new();
    for ((value, adjoint), factor) in terms.into_iter().filter(|term| term.1 != 0.0) {
        match value {
            Some(value) => scaled.entry(value).or_default().push((adjoint, factor)),
            None => form.plain.push((adjoint, factor)),
        }
    }
    let side = |sine: bool, joint: usize| {
        leaves.iter().position(|leaf| {
            *leaf == Some(if sine { Leaf::Sine(joint) } else { Leaf::Cosine(joint) })
        })
    };
    let joints = leaves.iter().filter_map(|leaf| match leaf {
        Some(Leaf::Sine(joint)) => Some(*joint),
        _ => None,
    });
    for joint in joints {
        let (Some(sine), Some(cosine)) = (side(true, joint), side(false, joint)) else {
            continue;
        };
        if scaled.contains_key(&sine) && scaled.contains_key(&cosine) {
            let mut take = |value| scaled.remove(&value).unwrap_or_default();
            form.rotations.push(Rotation { joint, sine: take(sine), cosine: take(cosine) });
        }
    }
    form.scaled = scaled.into_iter().collect();
    form
}
