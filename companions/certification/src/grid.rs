//! The bound over all angles from a grid of them.
//!
//! Sines and cosines enter the code by sums and products alone. So every value and every adjoint is
//! a trigonometric polynomial in each angle, whose degree the code shows, and a quadratic one in
//! speeds and accelerations. Riesz (1914): such a polynomial of degree n falls from its greatest
//! absolute value M no faster than M cos(n θ), so that a grid of enough angles bounds it everywhere
//! (`lattice`). Between the points nothing has to be enclosed, so that what cancels does. The same
//! holds of Σ |c_m| M_m over the coefficients c_m of the monomials of speeds and accelerations,
//! which is the greatest of the polynomials Σ ± c_m M_m.
//!
//! The errors are the same as in [`crate::bound`], of an exact identity in place of the mean value
//! theorem: with the numbers v that the code's literals and exact sines give, and computed ones v +
//! d,
//!
//!   d_k = d_a + d_b + e_k of a sum,   d_k = v_a d_b + v_b d_a + (d_a d_b + e_k) of a product,
//!
//! so that the error of the result is Σ (e_k + d_a d_b) ∂τ/∂v_k with derivatives at v. The same
//! identity, with the errors of the literals, leads from v to the model's exact value.

//!
//! A quotient or a root is no polynomial in the angles that its divisor or operand depends on, and
//! neither is the position of a joint that slides. The box is split into parts along those
//! coordinates, and over each part a coefficient is a number within a radius; over the other angles
//! it stays the same polynomial. The identity has a term of second order for a quotient too, and
//! Lagrange's remainder for a root.

mod classes;
mod lanes;
mod lattice;
mod proof;
mod waves;

use lattice::Lattice;
pub use lattice::between;
pub use proof::Counted;

use std::collections::BTreeMap;

use crate::graph::{Graph, Node, operands};
use crate::state_box::{Leaf, Robot};

/// A product of at most two speeds and accelerations, the lesser number first, from one; zero
/// stands for one.
type Monomial = (u8, u8);
/// The place of a coefficient, and whether it is negated there.
type Place = (u32, bool);
type Polynomial = BTreeMap<Monomial, Place>;

/// The operation of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// The present value, or nothing at first, plus or minus the product of both operands.
    Product { is_first: bool, is_minus: bool },
    /// The reciprocal of the first operand.
    Reciprocal,
    /// The root of the first operand.
    Root,
}

/// One step, for some points of the grid at once.
#[derive(Clone, Copy, Debug)]
struct Step {
    to: u32,
    a: u32,
    b: u32,
    kind: Kind,
}

const ONE: u32 = 0;

/// Values and adjoints of the function of one output, ready to be evaluated at many angles.
#[derive(Clone, Debug)]
pub struct Program {
    steps: Vec<Step>,
    /// Literals by place, and the places of cosine, sine and position of each joint.
    constants: Vec<(u32, f64)>,
    coordinates: Vec<[Option<u32>; 3]>,
    /// The joints whose range is split into parts: those with a grid are the others.
    parted: Vec<bool>,
    /// For a quotient or root, the place of the reciprocal of its divisor, or of the root.
    inverses: Vec<Option<u32>>,
    places: u32,
    /// The steps of the values, before those of the adjoints.
    forward: usize,
    /// The sums of absolute values that are wanted: place, and the monomial's greatest value; a
    /// value for each node, then an adjoint.
    sums: Vec<Vec<(u32, f64)>>,
    /// The degree of each node's value and adjoint in each angle.
    degrees: Vec<Vec<u8>>,
    /// The greatest value of each node's absolute terms, and of its adjoint's.
    absolute: Vec<f64>,
}

struct Builder<'a> {
    graph: &'a Graph,
    program: Program,
    values: Vec<Polynomial>,
    adjoints: Vec<Polynomial>,
    most: Vec<f64>,
}

impl Builder<'_> {
    /// A step of one operand, which must have no speeds.
    fn apply(&mut self, kind: Kind, of: &Polynomial) -> Option<Polynomial> {
        let mut terms = of.iter();
        let (((0, 0), (a, false)), None) = (terms.next()?, terms.next()) else {
            return None;
        };
        let to = self.place();
        let (a, b) = (*a, ONE);
        self.program.steps.push(Step { to, a, b, kind });
        Some(Polynomial::from([((0, 0), (to, false))]))
    }

    /// 1/x or 1/√x of a quotient's divisor or a root's operand, of which node k has the place; with
    /// √x of a root.
    fn inverse(&mut self, k: usize, of: usize, is_root: bool) -> Option<[Polynomial; 2]> {
        let mut x = self.values[of].clone();
        if x.values().any(|(_, is_minus)| *is_minus) {
            // The opposite, as a number of its own.
            let (own, one) = (std::mem::take(&mut x), constant(ONE));
            self.multiply_add(&mut x, &own, &one, false)?;
        }
        if is_root {
            x = self.apply(Kind::Root, &x)?;
        }
        let inverse = self.apply(Kind::Reciprocal, &x)?;
        self.program.inverses[k] = inverse.values().next().map(|(place, _)| *place);
        Some([inverse, x])
    }

    fn literal(&mut self, x: f64) -> Polynomial {
        let place = self.place();
        self.program.constants.push((place, x));
        constant(place)
    }

    fn product(&mut self, a: &Polynomial, b: &Polynomial, is_negated: bool) -> Option<Polynomial> {
        let mut product = Polynomial::new();
        self.multiply_add(&mut product, a, b, is_negated)?;
        Some(product)
    }

    fn place(&mut self) -> u32 {
        self.program.places += 1;
        self.program.places - 1
    }

    /// Adds a polynomial's product with another to a third.
    fn multiply_add(
        &mut self,
        to: &mut Polynomial,
        a: &Polynomial,
        b: &Polynomial,
        is_negated: bool,
    ) -> Option<()> {
        for (m, (a, a_minus)) in a {
            for (n, (b, b_minus)) in b {
                let monomial = times(*m, *n)?;
                let known = to.get(&monomial).copied();
                let (place, to_minus) = known.unwrap_or_else(|| (self.place(), false));
                to.insert(monomial, (place, to_minus));
                self.program.steps.push(Step {
                    to: place,
                    a: *a,
                    b: *b,
                    kind: Kind::Product {
                        is_first: known.is_none(),
                        is_minus: is_negated ^ a_minus ^ b_minus ^ to_minus,
                    },
                });
            }
        }
        Some(())
    }

    fn value(&mut self, k: usize, leaf: Option<Leaf>, n: usize) -> Option<Polynomial> {
        let one = constant(ONE);
        let node = self.graph.nodes[k];
        Some(match node {
            Node::Input(_) => match leaf? {
                Leaf::Cosine(joint) => self.coordinate(joint, 0),
                Leaf::Sine(joint) => self.coordinate(joint, 1),
                Leaf::Axis(axis) if axis < n => self.coordinate(axis, 2),
                Leaf::Axis(axis) => Polynomial::from([((0, (axis + 1) as u8), (ONE, false))]),
            },
            Node::Literal(0.0) => Polynomial::new(),
            Node::Literal(x) => self.literal(x.into()),
            Node::Neg(a) => negated(&self.values[a]),
            Node::Add(a, b) | Node::Sub(a, b) => {
                let (a, b) = (self.values[a].clone(), self.values[b].clone());
                let mut sum = self.product(&a, &one, false)?;
                self.multiply_add(&mut sum, &b, &one, matches!(node, Node::Sub(..)))?;
                sum
            }
            Node::Mul(a, b) => {
                let (a, b) = (self.values[a].clone(), self.values[b].clone());
                self.product(&a, &b, false)?
            }
            Node::Div(a, b) => {
                let [inverse, _] = self.inverse(k, b, false)?;
                let a = self.values[a].clone();
                self.product(&a, &inverse, false)?
            }
            Node::Sqrt(a) => self.inverse(k, a, true).map(|[_, root]| root)?,
            Node::InverseRoot(a, _) => self.inverse(k, a, true).map(|[inverse, _]| inverse)?,
        })
    }

    fn coordinate(&mut self, joint: usize, side: usize) -> Polynomial {
        let place = match self.program.coordinates[joint][side] {
            Some(place) => place,
            None => self.place(),
        };
        self.program.coordinates[joint][side] = Some(place);
        constant(place)
    }

    /// Adds a node's adjoint to those of its operands. `uses` counts the uses of each node: an
    /// operand with one use shares its places.
    fn propagate(&mut self, k: usize, uses: &[usize]) -> Option<()> {
        let one = Polynomial::from([((0, 0), (ONE, false))]);
        let adjoint = self.adjoints[k].clone();
        let plain: &[(usize, bool)] = match self.graph.nodes[k] {
            Node::Add(a, b) => &[(a, false), (b, false)],
            Node::Sub(a, b) => &[(a, false), (b, true)],
            Node::Neg(a) => &[(a, true)],
            _ => &[],
        };
        for (to, is_minus) in plain {
            if uses[*to] == 1 {
                self.adjoints[*to] = if *is_minus { negated(&adjoint) } else { adjoint.clone() };
                continue;
            }
            let mut sum = std::mem::take(&mut self.adjoints[*to]);
            self.multiply_add(&mut sum, &adjoint, &one, *is_minus)?;
            self.adjoints[*to] = sum;
        }
        for (to, slope) in self.slopes(k)?.into_iter().flatten() {
            let mut sum = std::mem::take(&mut self.adjoints[to]);
            self.multiply_add(&mut sum, &adjoint, &slope, false)?;
            self.adjoints[to] = sum;
        }
        Some(())
    }

    /// The operands of a product, a quotient or a root, and the derivatives by them.
    fn slopes(&mut self, k: usize) -> Option<[Option<(usize, Polynomial)>; 2]> {
        let value = self.values[k].clone();
        let inverse = self.program.inverses[k].map(constant).unwrap_or_default();
        Some(match self.graph.nodes[k] {
            Node::Mul(a, b) => {
                [Some((a, self.values[b].clone())), Some((b, self.values[a].clone()))]
            }
            // 1/b and −(a/b)/b
            Node::Div(a, b) => {
                let by_divisor = self.product(&value, &inverse, true)?;
                [Some((a, inverse)), Some((b, by_divisor))]
            }
            // ½/√a
            Node::Sqrt(a) => {
                let half = self.literal(0.5);
                [Some((a, self.product(&inverse, &half, false)?)), None]
            }
            // −½ (1/√a)³
            Node::InverseRoot(a, _) => {
                let half = self.literal(0.5);
                let square = self.product(&value, &value, false)?;
                let cube = self.product(&square, &value, false)?;
                [Some((a, self.product(&cube, &half, true)?)), None]
            }
            _ => [None, None],
        })
    }

    fn sum(&self, of: &Polynomial) -> Vec<(u32, f64)> {
        let most = |i: u8| {
            if i == 0 { 1.0 } else { self.most[usize::from(i) - 1] }
        };
        of.iter()
            .map(|((i, j), (place, _))| (*place, most(*i) * most(*j)))
            .filter(|(_, most)| *most > 0.0)
            .collect()
    }
}

fn constant(place: u32) -> Polynomial {
    Polynomial::from([((0, 0), (place, false))])
}

/// The joints of whose position the function is no trigonometric polynomial.
fn parted(graph: &Graph, leaves: &[Option<Leaf>], joints: usize) -> Vec<bool> {
    let mut parted = vec![false; joints];
    let mut depends: Vec<Vec<bool>> = Vec::new();
    for (node, leaf) in graph.nodes.iter().zip(leaves) {
        let mut on = vec![false; joints];
        for a in operands(*node).into_iter().flatten() {
            on.iter_mut().zip(&depends[a]).for_each(|(on, a)| *on |= a);
        }
        match leaf {
            Some(Leaf::Sine(joint) | Leaf::Cosine(joint)) => on[*joint] = true,
            Some(Leaf::Axis(axis)) if *axis < joints => {
                on[*axis] = true;
                parted[*axis] = true;
            }
            _ => {}
        }
        let (Node::Div(_, of) | Node::Sqrt(of) | Node::InverseRoot(of, _)) = *node else {
            depends.push(on);
            continue;
        };
        let all = parted.iter_mut().zip(&depends[of]);
        all.for_each(|(parted, of)| *parted |= of);
        depends.push(on);
    }
    parted
}

fn negated(of: &Polynomial) -> Polynomial {
    of.iter().map(|(monomial, (place, is_minus))| (*monomial, (*place, !is_minus))).collect()
}

fn times(m: Monomial, n: Monomial) -> Option<Monomial> {
    match (m, n) {
        ((0, 0), n) => Some(n),
        (m, (0, 0)) => Some(m),
        ((0, i), (0, j)) => Some((i.min(j), i.max(j))),
        _ => None,
    }
}

impl Program {
    /// Translates a graph of one output; `None` if it is no such polynomial, since it has a higher
    /// degree in speeds, a quotient by speeds, or a root of them.
    pub fn new(graph: &Graph, robot: &Robot) -> Option<Self> {
        let n = robot.joints.len();
        let whole = robot.whole();
        let leaf = |node: &Node| match node {
            Node::Input(input) => robot.leaf(*input),
            _ => None,
        };
        let leaves: Vec<Option<Leaf>> = graph.nodes.iter().map(leaf).collect();
        let mut builder = Builder {
            graph,
            program: Self {
                steps: Vec::new(),
                constants: vec![(ONE, 1.0)],
                coordinates: vec![[None; 3]; n],
                parted: parted(graph, &leaves, n),
                inverses: vec![None; graph.nodes.len()],
                places: ONE + 1,
                forward: 0,
                sums: Vec::new(),
                degrees: Vec::new(),
                absolute: Vec::new(),
            },
            values: Vec::new(),
            adjoints: vec![Polynomial::new(); graph.nodes.len()],
            most: whole.iter().map(|x| x.magnitude()).collect(),
        };
        for (k, leaf) in leaves.iter().enumerate() {
            let value = builder.value(k, *leaf, n)?;
            builder.values.push(value);
        }
        builder.program.forward = builder.program.steps.len();
        let mut uses = vec![0; graph.nodes.len()];
        for node in &graph.nodes {
            for at in operands(*node).into_iter().flatten() {
                uses[at] += 1;
            }
        }
        *builder.adjoints.last_mut()? = Polynomial::from([((0, 0), (ONE, false))]);
        for k in (0..graph.nodes.len()).rev() {
            builder.propagate(k, &uses)?;
        }
        let all = builder.values.iter().chain(&builder.adjoints);
        let sums = all.map(|of| builder.sum(of)).collect();
        let mut program = builder.program;
        program.sums = sums;
        program.count(graph, robot, &whole.iter().map(|x| x.magnitude()).collect::<Vec<_>>());
        Some(program)
    }

    /// Degrees, and absolute values without any cancellation.
    fn count(&mut self, graph: &Graph, robot: &Robot, most: &[f64]) {
        let (n, nodes) = (robot.joints.len(), graph.nodes.len());
        let (mut degrees, mut absolute) = (vec![vec![0; n]; 2 * nodes], vec![0.0; 2 * nodes]);
        let both =
            |a: &[u8], b: &[u8]| -> Vec<u8> { a.iter().zip(b).map(|(a, b)| a + b).collect() };
        for (k, node) in graph.nodes.iter().enumerate() {
            (degrees[k], absolute[k]) = match *node {
                Node::Input(input) => match robot.leaf(input) {
                    Some(Leaf::Sine(joint) | Leaf::Cosine(joint)) => {
                        let is_polynomial = !self.parted[joint];
                        let degree = |i: usize| u8::from(is_polynomial && i == joint);
                        ((0..n).map(degree).collect(), 1.0)
                    }
                    Some(Leaf::Axis(axis)) => (vec![0; n], most[axis]),
                    None => (vec![0; n], 0.0),
                },
                Node::Literal(x) => (vec![0; n], f64::from(x).abs()),
                Node::Neg(a) => (degrees[a].clone(), absolute[a]),
                Node::Add(a, b) | Node::Sub(a, b) => {
                    (larger(&degrees[a], &degrees[b]), absolute[a] + absolute[b])
                }
                Node::Mul(a, b) => (both(&degrees[a], &degrees[b]), absolute[a] * absolute[b]),
                // Absolute values are those of whole circles alone.
                Node::Div(a, _) => (degrees[a].clone(), 0.0),
                Node::Sqrt(_) | Node::InverseRoot(..) => (vec![0; n], 0.0),
            };
        }
        absolute[2 * nodes - 1] = 1.0;
        for k in (0..nodes).rev() {
            let (degree, size) = (degrees[nodes + k].clone(), absolute[nodes + k]);
            let propagated = match graph.nodes[k] {
                Node::Neg(a) => vec![(a, degree, size)],
                Node::Add(a, b) | Node::Sub(a, b) => {
                    vec![(a, degree.clone(), size), (b, degree, size)]
                }
                Node::Mul(a, b) => vec![
                    (a, both(&degree, &degrees[b]), size * absolute[b]),
                    (b, both(&degree, &degrees[a]), size * absolute[a]),
                ],
                Node::Div(a, b) => vec![(b, both(&degree, &degrees[k]), 0.0), (a, degree, 0.0)],
                Node::Sqrt(a) | Node::InverseRoot(a, _) => vec![(a, degree, 0.0)],
                Node::Input(_) | Node::Literal(_) => continue,
            };
            for (to, degree, size) in propagated {
                degrees[nodes + to] = larger(&degrees[nodes + to], &degree);
                absolute[nodes + to] += size;
            }
        }
        (self.degrees, self.absolute) = (degrees, absolute);
    }
}

fn larger(a: &[u8], b: &[u8]) -> Vec<u8> {
    a.iter().zip(b).map(|(a, b)| *a.max(b)).collect()
}
