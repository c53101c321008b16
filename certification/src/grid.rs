//! The bound over all angles from a grid of them.
//!
//! Sines and cosines enter the code by sums and products alone. So every value and every adjoint is a trigonometric polynomial in each
//! angle, whose degree the code shows, and a quadratic one in speeds and accelerations. Riesz (1914): such a polynomial of degree n
//! falls from its greatest absolute value M no faster than M cos(n θ). With N angles on the circle, one of them within π/N, it holds that
//!
//!   max |T| ≤ max over the grid |T| / cos(π n / N),
//!
//! and for several angles one after the other (Ehlich & Zeller, Mathematische Zeitschrift 86, 1964). Of few angles a kernel says less
//! (`between`). Between the points of the grid
//! nothing has to be enclosed, so that what cancels does. The same holds of Σ |c_m| M_m over the coefficients c_m of the monomials of speeds
//! and accelerations, which is the greatest of the polynomials Σ ± c_m M_m.
//!
//! The errors are the same as in [`crate::bound`], of an exact identity in place of the mean value theorem: with the numbers v that the
//! code's literals and exact sines give, and computed ones v + d,
//!
//!   d_k = d_a + d_b + e_k of a sum,   d_k = v_a d_b + v_b d_a + (d_a d_b + e_k) of a product,
//!
//! so that the error of the result is Σ (e_k + d_a d_b) ∂τ/∂v_k with derivatives at v. The same identity, with the errors of the literals, leads
//! from v to the model's exact value.

mod between;
mod proof;

pub use between::factor as between;
pub use proof::Counted;

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use crate::bound::Bound;
use crate::graph::{Graph, Node};
use crate::state_box::{Leaf, Robot};

/// A product of at most two speeds and accelerations, the lesser number first, from one; zero stands for one.
type Monomial = (u8, u8);
/// Where a coefficient is, and whether it is negated there.
type Place = (u32, bool);
type Polynomial = BTreeMap<Monomial, Place>;

/// One step: the number at `to`, or nothing at first, plus or minus the product of those at `a` and `b`, for some points of the grid at once.
#[derive(Clone, Copy, Debug)]
struct Step {
    to: u32,
    a: u32,
    b: u32,
    is_first: bool,
    is_minus: bool,
}

const LANES: usize = 8;
const ONE: u32 = 0;

/// Values and adjoints of the function of one output, ready to be evaluated at many angles.
#[derive(Clone, Debug)]
pub struct Program {
    steps: Vec<Step>,
    /// Literals by place, and the places of cosine and sine of each angle.
    constants: Vec<(u32, f64)>,
    angles: Vec<[Option<u32>; 2]>,
    places: u32,
    /// The steps of the values, before those of the adjoints.
    forward: usize,
    /// The sums of absolute values that are wanted: place, and the monomial's greatest value; a value for each node, then an adjoint.
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
                    is_first: known.is_none(),
                    is_minus: is_negated ^ a_minus ^ b_minus ^ to_minus,
                });
            }
        }
        Some(())
    }

    fn value(&mut self, node: Node, leaf: Option<Leaf>, n: usize) -> Option<Polynomial> {
        let one = Polynomial::from([((0, 0), (ONE, false))]);
        Some(match node {
            Node::Input(_) => match leaf? {
                Leaf::Sine(joint) => self.angle(joint, 1),
                Leaf::Cosine(joint) => self.angle(joint, 0),
                // A position that is no angle would need a grid of its own.
                Leaf::Axis(axis) if axis < n => return None,
                Leaf::Axis(axis) => Polynomial::from([((0, (axis + 1) as u8), (ONE, false))]),
            },
            Node::Literal(0.0) => Polynomial::new(),
            Node::Literal(x) => {
                let place = self.place();
                self.program.constants.push((place, x.into()));
                Polynomial::from([((0, 0), (place, false))])
            }
            Node::Neg(a) => negated(&self.values[a]),
            Node::Div(..) | Node::Sqrt(_) | Node::InverseRoot(..) => return None,
            Node::Add(a, b) | Node::Sub(a, b) => {
                let (mut sum, a, b) = (
                    Polynomial::new(),
                    self.values[a].clone(),
                    self.values[b].clone(),
                );
                self.multiply_add(&mut sum, &a, &one, false)?;
                self.multiply_add(&mut sum, &b, &one, matches!(node, Node::Sub(..)))?;
                sum
            }
            Node::Mul(a, b) => {
                let (mut product, a, b) = (
                    Polynomial::new(),
                    self.values[a].clone(),
                    self.values[b].clone(),
                );
                self.multiply_add(&mut product, &a, &b, false)?;
                product
            }
        })
    }

    fn angle(&mut self, joint: usize, side: usize) -> Polynomial {
        let place = match self.program.angles[joint][side] {
            Some(place) => place,
            None => self.place(),
        };
        self.program.angles[joint][side] = Some(place);
        Polynomial::from([((0, 0), (place, false))])
    }

    /// Adds a node's adjoint to those of its operands. `uses` counts the uses of each node: an operand with one use shares its places.
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
                self.adjoints[*to] = if *is_minus {
                    negated(&adjoint)
                } else {
                    adjoint.clone()
                };
                continue;
            }
            let mut sum = std::mem::take(&mut self.adjoints[*to]);
            self.multiply_add(&mut sum, &adjoint, &one, *is_minus)?;
            self.adjoints[*to] = sum;
        }
        if let Node::Mul(a, b) = self.graph.nodes[k] {
            for (to, other) in [(a, b), (b, a)] {
                let (mut sum, value) = (
                    std::mem::take(&mut self.adjoints[to]),
                    self.values[other].clone(),
                );
                self.multiply_add(&mut sum, &adjoint, &value, false)?;
                self.adjoints[to] = sum;
            }
        }
        Some(())
    }

    fn sum(&self, of: &Polynomial) -> Vec<(u32, f64)> {
        let most = |i: u8| {
            if i == 0 {
                1.0
            } else {
                self.most[usize::from(i) - 1]
            }
        };
        of.iter()
            .map(|((i, j), (place, _))| (*place, most(*i) * most(*j)))
            .collect()
    }
}

fn negated(of: &Polynomial) -> Polynomial {
    of.iter()
        .map(|(monomial, (place, is_minus))| (*monomial, (*place, !is_minus)))
        .collect()
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
    /// Of a graph of one output; `None` if it is no such polynomial: of a joint that slides, of a higher degree in speeds, of a quotient or a root.
    pub fn new(graph: &Graph, robot: &Robot) -> Option<Self> {
        let n = robot.joints.len();
        let whole = robot.whole();
        let leaf = |node: &Node| match node {
            Node::Input(input) => robot.leaf(*input),
            _ => None,
        };
        let mut builder = Builder {
            graph,
            program: Self {
                steps: Vec::new(),
                constants: vec![(ONE, 1.0)],
                angles: vec![[None; 2]; n],
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
        for node in &graph.nodes {
            let value = builder.value(*node, leaf(node), n)?;
            builder.values.push(value);
        }
        builder.program.forward = builder.program.steps.len();
        let mut uses = vec![0; graph.nodes.len()];
        for node in &graph.nodes {
            for at in crate::graph::operands(*node).into_iter().flatten() {
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
        program.count(
            graph,
            robot,
            &whole.iter().map(|x| x.magnitude()).collect::<Vec<_>>(),
        );
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
                        ((0..n).map(|i| u8::from(i == joint)).collect(), 1.0)
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
                // Of these there is no program.
                Node::Div(..) | Node::Sqrt(_) | Node::InverseRoot(..) => continue,
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
                _ => continue,
            };
            for (to, degree, size) in propagated {
                degrees[nodes + to] = larger(&degrees[nodes + to], &degree);
                absolute[nodes + to] += size;
            }
        }
        (self.degrees, self.absolute) = (degrees, absolute);
    }
}

/// Absolute values that are added up, with their factors: places of coefficients.
type Weighted = Vec<(u32, f64)>;

/// Points that are looked at before it is decided which adjoints are added up together.
const SAMPLE: usize = 64 * LANES;

/// Adjoints that are added up before the greatest sum is taken.
#[derive(Clone, Debug)]
struct Class {
    /// The greatest degree of them in each angle.
    degrees: Vec<u8>,
    sum: Weighted,
    /// The sums at the sampled points.
    sampled: Vec<f64>,
    /// What the evaluation's roundings can have hidden.
    hidden: f64,
}

impl Class {
    /// How much more a sum may be between the points of the grid.
    fn between(degrees: &[u8], sizes: &[usize]) -> f64 {
        let factors = degrees.iter().zip(sizes);
        let each = factors.map(|(degree, size)| between::factor((*degree).into(), *size));
        each.product::<f64>() * (1.0 + 1e-12)
    }

    fn with(&self, other: &Self) -> Self {
        let added = self.sampled.iter().zip(&other.sampled).map(|(a, b)| a + b);
        Self {
            degrees: larger(&self.degrees, &other.degrees),
            sum: [self.sum.as_slice(), &other.sum].concat(),
            sampled: added.collect(),
            hidden: self.hidden + other.hidden,
        }
    }

    fn sampled_bound(&self, sizes: &[usize]) -> f64 {
        let most = self.sampled.iter().copied().fold(0.0, f64::max);
        most * Self::between(&self.degrees, sizes)
    }
}

fn larger(a: &[u8], b: &[u8]) -> Vec<u8> {
    a.iter().zip(b).map(|(a, b)| *a.max(b)).collect()
}

impl Program {
    /// The angles of the grid for each joint, at most this many points in all; `None` if these degrees ask for more.
    fn sizes(&self, of: &[Vec<u8>], most: usize) -> Option<Vec<usize>> {
        let n = self.angles.len();
        let degree = |i: usize| of.iter().map(|of| of[i]).max().unwrap_or(0);
        let degrees: Vec<usize> = (0..n).map(|i| usize::from(degree(i))).collect();
        let sizes = |share: f64| -> Vec<usize> {
            let of = |degree: &usize| ((share * *degree as f64) as usize).max(2 * degree + 1);
            degrees.iter().map(of).collect()
        };
        let fits = |sizes: &[usize]| {
            let all = sizes.iter().try_fold(1_usize, |a, b| a.checked_mul(*b));
            all.is_some_and(|all| all <= most)
        };
        let shares = (0..2000).map(|i| 2.0 + 0.05 * f64::from(i));
        shares.map(sizes).take_while(|sizes| fits(sizes)).last()
    }

    /// Sets cosines and sines to those of a point of the grid, by its number.
    fn set_angles(&self, x: &mut [[f64; LANES]], lane: usize, point: usize, sizes: &[usize]) {
        let mut rest = point;
        for (places, size) in self.angles.iter().zip(sizes) {
            let (sine, cosine) = (TAU * (rest % size) as f64 / *size as f64).sin_cos();
            rest /= size;
            for (place, value) in places.iter().zip([cosine, sine]) {
                if let Some(place) = place {
                    x[*place as usize][lane] = value;
                }
            }
        }
    }

    /// Evaluates the steps at points of the grid, `LANES` from each given number on, and passes all coefficients to `visit`.
    fn at_points(
        &self,
        steps: &[Step],
        sizes: &[usize],
        points: impl Iterator<Item = usize>,
        mut visit: impl FnMut(&[[f64; LANES]]),
    ) {
        let most: usize = sizes.iter().product();
        let mut x = vec![[0.0; LANES]; self.places as usize];
        for (place, value) in &self.constants {
            x[*place as usize] = [*value; LANES];
        }
        for first in points {
            (0..LANES).for_each(|lane| {
                self.set_angles(&mut x, lane, (first + lane).min(most - 1), sizes)
            });
            evaluate(steps, &mut x);
            visit(&x);
        }
    }

    /// The greatest sum of each on the whole grid.
    fn greatest(&self, steps: &[Step], sizes: &[usize], sums: &[&[(u32, f64)]]) -> Vec<f64> {
        let mut greatest = vec![[0.0_f64; LANES]; sums.len()];
        let points: usize = sizes.iter().product();
        self.at_points(steps, sizes, (0..points).step_by(LANES), |x| {
            for (greatest, sum) in greatest.iter_mut().zip(sums) {
                let sum = absolute(sum, x);
                (0..LANES).for_each(|i| greatest[i] = greatest[i].max(sum[i]));
            }
        });
        let most = |lanes: [f64; LANES]| lanes.into_iter().fold(0.0, f64::max);
        greatest.into_iter().map(most).collect()
    }

    /// The greatest absolute value of each node over all angles and speeds.
    fn values(&self, sizes: &[usize], rounding: f64) -> Vec<f64> {
        let nodes = self.sums.len() / 2;
        let sums: Vec<&[(u32, f64)]> = self.sums[..nodes].iter().map(Vec::as_slice).collect();
        let on_grid = self.greatest(&self.steps[..self.forward], sizes, &sums);
        let everywhere = |(k, most): (usize, f64)| {
            (most + rounding * self.absolute[k]) * Class::between(&self.degrees[k], sizes)
        };
        on_grid.into_iter().enumerate().map(everywhere).collect()
    }

    /// Adjoints by their weights, those added up together of which this gives the least bound at some points.
    fn classes(&self, weights: &[f64], sizes: &[usize], rounding: f64) -> Vec<Class> {
        let nodes = weights.len();
        let mut of_degrees = BTreeMap::<&[u8], Class>::new();
        for (k, weight) in weights.iter().enumerate().filter(|one| *one.1 > 0.0) {
            let degrees = &self.degrees[nodes + k];
            let class = of_degrees.entry(degrees).or_insert_with(|| Class {
                degrees: degrees.clone(),
                sum: Vec::new(),
                sampled: Vec::new(),
                hidden: 0.0,
            });
            let terms = self.sums[nodes + k].iter();
            class
                .sum
                .extend(terms.map(|(place, most)| (*place, weight * most)));
            class.hidden += weight * self.absolute[nodes + k] * rounding;
        }
        let mut classes: Vec<Class> = of_degrees.into_values().collect();
        self.at_points(&self.steps, sizes, sample(sizes), |x| {
            for class in &mut classes {
                class.sampled.extend(absolute(&class.sum, x));
            }
        });
        loop {
            let mut best = (0.0, None);
            for i in 0..classes.len() {
                for j in 0..i {
                    let apart = classes[i].sampled_bound(sizes) + classes[j].sampled_bound(sizes);
                    let gain = apart - classes[i].with(&classes[j]).sampled_bound(sizes);
                    if gain > best.0 {
                        best = (gain, Some((i, j)));
                    }
                }
            }
            let Some((i, j)) = best.1 else { break };
            let other = classes.swap_remove(i);
            classes[j] = classes[j].with(&other);
        }
        classes
    }

    /// A bound whose parts have the shares that they have at the sampled points together.
    fn shared(&self, graph: &Graph, weights: &[f64], sizes: &[usize], total: f64) -> Bound {
        let nodes = weights.len();
        let mut sums = [const { Weighted::new() }; 3];
        for (k, weight) in weights.iter().enumerate() {
            let kind = match graph.nodes[k] {
                Node::Input(_) => 2,
                Node::Literal(_) => 1,
                _ => 0,
            };
            let terms = self.sums[nodes + k].iter();
            sums[kind].extend(terms.map(|(place, most)| (*place, weight * most)));
        }
        let mut parts = [0.0; 3];
        self.at_points(&self.steps, sizes, sample(sizes), |x| {
            for (part, sum) in parts.iter_mut().zip(&sums) {
                *part += absolute(sum, x).iter().sum::<f64>();
            }
        });
        let all: f64 = parts.iter().sum();
        let [operations, literals, sines] =
            parts.map(|part| if all > 0.0 { total * part / all } else { 0.0 });
        Bound {
            operations,
            literals,
            sines,
        }
    }
}

/// The first of some points each, drawn at random.
fn sample(sizes: &[usize]) -> impl Iterator<Item = usize> {
    let points: usize = sizes.iter().product();
    let mut rng = fastrand::Rng::with_seed(1);
    (0..SAMPLE / LANES).map(move |_| rng.usize(..points))
}

fn absolute(sum: &[(u32, f64)], x: &[[f64; LANES]]) -> [f64; LANES] {
    let mut result = [0.0; LANES];
    for (place, most) in sum {
        let x = &x[*place as usize];
        (0..LANES).for_each(|i| result[i] += x[i].abs() * most);
    }
    result
}

/// Each place once.
fn joined(sum: &[(u32, f64)]) -> Weighted {
    let mut places = BTreeMap::<u32, f64>::new();
    for (place, weight) in sum {
        *places.entry(*place).or_default() += weight;
    }
    places.into_iter().collect()
}

fn evaluate(steps: &[Step], x: &mut [[f64; LANES]]) {
    for step in steps {
        let (a, b) = (x[step.a as usize], x[step.b as usize]);
        let to = &mut x[step.to as usize];
        match (step.is_first, step.is_minus) {
            (true, false) => (0..LANES).for_each(|i| to[i] = a[i] * b[i]),
            (true, true) => (0..LANES).for_each(|i| to[i] = -(a[i] * b[i])),
            (false, false) => (0..LANES).for_each(|i| to[i] += a[i] * b[i]),
            (false, true) => (0..LANES).for_each(|i| to[i] -= a[i] * b[i]),
        }
    }
}
