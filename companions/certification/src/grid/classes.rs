//! A program on the points of a grid: the greatest absolute sums, and which adjoints are added up
//! before the greatest is taken.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use super::lanes::{LANES, Lanes, absolute, evaluate};
use super::{Lattice, Program, Step, larger};
use crate::bound::Bound;
use crate::graph::{Graph, Node};
use crate::interval::Interval;
use crate::state_box::{cosine, sine};

/// Absolute values that are added up, with their factors: places of coefficients.
pub(super) type Weighted = Vec<(u32, f64)>;

/// Points that are looked at before it is decided which adjoints are added up together: at most
/// these, and a share of the grid.
const SAMPLE: usize = 64 * LANES;
const SHARE: usize = 8;

/// The domain on which a program is evaluated: a grid of angles, and ranges of the other
/// coordinates.
pub(super) struct Place<'a> {
    pub(super) lattice: &'a Lattice,
    pub(super) part: &'a [Interval],
    /// More than the relative error of an evaluation, if it does not keep its own.
    pub(super) rounding: f64,
}

impl<'a> Place<'a> {
    /// With coefficients that keep their own roundings.
    pub(super) fn part(lattice: &'a Lattice, part: &'a [Interval]) -> Self {
        Self { lattice, part, rounding: 0.0 }
    }
}

/// Adjoints that are added up before the greatest sum is taken.
#[derive(Clone, Debug)]
pub(super) struct Class {
    /// The greatest degree of them in each angle.
    pub(super) degrees: Vec<u8>,
    pub(super) sum: Weighted,
    /// The sums at the sampled points.
    sampled: Vec<f64>,
    /// The most that the roundings of the evaluation can have hidden.
    pub(super) hidden: f64,
}

impl Class {
    fn with(&self, other: &Self) -> Self {
        let added = self.sampled.iter().zip(&other.sampled).map(|(a, b)| a + b);
        Self {
            degrees: larger(&self.degrees, &other.degrees),
            sum: [self.sum.as_slice(), &other.sum].concat(),
            sampled: added.collect(),
            hidden: self.hidden + other.hidden,
        }
    }

    /// The bound that follows from the sampled points alone.
    fn sampled_bound(&self, lattice: &Lattice) -> f64 {
        let most = self.sampled.iter().copied().fold(0.0, f64::max);
        most * lattice.between(&self.degrees)
    }
}

impl Program {
    /// Sets cosines and sines to those of a point of the grid, by its number.
    fn set_angles<L: Lanes>(&self, x: &mut [L], lane: usize, point: usize, sizes: &[usize]) {
        let mut rest = point;
        let joints = self.coordinates.iter().zip(sizes).zip(&self.parted);
        for ((places, size), _) in joints.filter(|(_, is_parted)| !**is_parted) {
            let (sine, cosine) = (TAU * (rest % size) as f64 / *size as f64).sin_cos();
            rest /= size;
            for (place, value) in places.iter().zip([cosine, sine]) {
                if let Some(place) = place {
                    x[*place as usize].set(lane, value);
                }
            }
        }
    }

    /// Evaluates the steps at points of the grid, `LANES` from each given number on, and passes all
    /// coefficients to `visit`.
    pub(super) fn at_points<L: Lanes>(
        &self,
        steps: &[Step],
        at: &Place<'_>,
        points: impl Iterator<Item = usize>,
        mut visit: impl FnMut(&[L]),
    ) {
        let sizes = &at.lattice.sizes;
        let last = at.lattice.points() - 1;
        let mut x = vec![L::default(); self.places as usize];
        for (place, value) in &self.constants {
            x[*place as usize] = L::within(Interval::point(*value));
        }
        let joints = self.coordinates.iter().zip(at.part).zip(&self.parted);
        for ((places, range), _) in joints.filter(|(_, is_parted)| **is_parted) {
            for (place, range) in places.iter().zip([cosine(*range), sine(*range), *range]) {
                if let Some(place) = place {
                    x[*place as usize] = L::within(range);
                }
            }
        }
        for first in points {
            (0..LANES)
                .for_each(|lane| self.set_angles(&mut x, lane, (first + lane).min(last), sizes));
            evaluate(steps, &mut x);
            visit(&x);
        }
    }

    /// The greatest sum of each on the whole grid.
    pub(super) fn greatest<L: Lanes>(
        &self,
        steps: &[Step],
        at: &Place<'_>,
        sums: &[&[(u32, f64)]],
    ) -> Vec<f64> {
        let mut greatest = vec![[0.0_f64; LANES]; sums.len()];
        let points = (0..at.lattice.points()).step_by(LANES);
        self.at_points::<L>(steps, at, points, |x| {
            for (greatest, sum) in greatest.iter_mut().zip(sums) {
                let sum = absolute(sum, x);
                (0..LANES).for_each(|i| greatest[i] = greatest[i].max(sum[i]));
            }
        });
        let most = |lanes: [f64; LANES]| lanes.into_iter().fold(0.0, f64::max);
        greatest.into_iter().map(most).collect()
    }

    /// Adjoints by their weights, those added up together of which this gives the least bound at
    /// some points.
    pub(super) fn classes<L: Lanes>(&self, weights: &[f64], at: &Place<'_>) -> Vec<Class> {
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
            class.sum.extend(terms.map(|(place, most)| (*place, weight * most)));
            class.hidden += weight * self.absolute[nodes + k] * at.rounding;
        }
        let mut classes: Vec<Class> = of_degrees.into_values().collect();
        self.at_points::<L>(&self.steps, at, sample(at.lattice), |x| {
            for class in &mut classes {
                class.sampled.extend(absolute(&class.sum, x));
            }
        });
        loop {
            let mut best = (0.0, None);
            for i in 0..classes.len() {
                for j in 0..i {
                    let bound = |one: &Class| one.sampled_bound(at.lattice);
                    let apart = bound(&classes[i]) + bound(&classes[j]);
                    let gain = apart - bound(&classes[i].with(&classes[j]));
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
    pub(super) fn shared<L: Lanes>(
        &self,
        graph: &Graph,
        weights: &[f64],
        at: &Place<'_>,
        total: f64,
    ) -> Bound {
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
        self.at_points::<L>(&self.steps, at, sample(at.lattice), |x| {
            for (part, sum) in parts.iter_mut().zip(&sums) {
                *part += absolute(sum, x).iter().sum::<f64>();
            }
        });
        let all: f64 = parts.iter().sum();
        let [operations, literals, sines] =
            parts.map(|part| if all > 0.0 { total * part / all } else { 0.0 });
        Bound { operations, literals, sines }
    }
}

/// The first of some points each, drawn at random.
fn sample(lattice: &Lattice) -> impl Iterator<Item = usize> {
    let points = lattice.points();
    let mut rng = fastrand::Rng::with_seed(1);
    let most = SAMPLE.min(points / SHARE);
    (0..most.div_ceil(LANES).max(1)).map(move |_| rng.usize(..points))
}

/// The same sum with each place listed once.
pub(super) fn joined(sum: &[(u32, f64)]) -> Weighted {
    let mut places = BTreeMap::<u32, f64>::new();
    for (place, weight) in sum {
        *places.entry(*place).or_default() += weight;
    }
    places.into_iter().collect()
}
