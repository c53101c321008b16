//! A floor of the least eigenvalue of the inertia matrix M(q) over all positions of the joints.
//!
//! Over a part of the box, M = A(d) + R with A affine in d ∈ [−1, 1]ⁿ and |R_ij| ≤ r_ij
//! ([`crate::taylor`]). For any positive s,
//!
//!   2 |R_ij x_i x_j| ≤ r_ij (s_j/s_i x_i² + s_i/s_j x_j²),
//!
//! so that M − A(d) + D is positive semidefinite with the diagonal D_i = Σ_j r_ij s_j/s_i: a
//! congruence of R by diag(s) and Gershgorin's circles. The least eigenvalue is a concave function
//! of a symmetric matrix (Horn & Johnson, Matrix Analysis, 4.3), so that that of A(d) − D is least
//! at a corner of the part. There it is above μ if the factorisation of Cholesky of A − D − (μ + c)
//! I succeeds in f64, with c for its roundings (Rump, BIT Numerical Mathematics 46, 2006). If it
//! fails, it gives a direction x in which A − D is too small, and the part is halved along the
//! coordinate that changes M most in that direction.

use fastrand::Rng;
use serde::{Deserialize, Serialize};

use crate::bodies::{Body, Position, inertia_matrix};
use crate::error::{Error, Result};
use crate::interval::Interval;
use crate::parts::{WIDE, somewhere, wide};
use crate::peel;
use crate::positive::{Matrix, not_positive};
use crate::taylor::{SLOPES, Taylor};

/// The proven lower bound of the least eigenvalue.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Floor {
    /// It is above this everywhere, kg·m² (of joints that slide, kg).
    pub floor: f64,
    /// The least that was found.
    pub least: f64,
    /// The position that has it.
    pub q: Vec<f64>,
    /// The parts of the box that the proof took.
    pub parts: usize,
}

impl Floor {
    /// The floor as a share of the least that was found.
    pub fn ratio(&self) -> f64 {
        self.floor / self.least
    }

    /// Fails if something was found that the proof excludes.
    ///
    /// # Errors
    /// [`Error::Floor`].
    pub fn check(&self) -> Result<()> {
        match self.least < self.floor {
            true => Err(Error::Floor { proven: self.floor, found: self.least }),
            false => Ok(()),
        }
    }
}

/// Shares of the least value seen that are tried directly, in this order.
const SHARES: [f64; 12] = [0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95];
/// Shares that joints keep when the next one is added.
const KEPT: [f64; 2] = [0.6, 0.85];
/// Joints of an arm whose floor is proven directly before further joints are added.
const FIRST: [usize; 3] = [1, 3, 4];

/// Proves a floor x over these positions, M ⪰ x diag(scales), with at most so many parts for each
/// value that is tried: joint by joint from the base on by [`crate::peel`], and directly.
pub fn prove(bodies: &[Body], positions: &[Interval], scales: &[f64], most: usize) -> Floor {
    let mut arms = vec![peel::welded(bodies)];
    while let Some(next) = arms.last().filter(|arm| arm.len() > 1) {
        arms.push(peel::without_last(next));
    }
    arms.reverse();
    let Some(arm) = arms.last().filter(|arm| arm.len() == positions.len()) else {
        return Floor::default();
    };
    // The first joints' floors are in the ratio of the scales, or of inertias at one position,
    // which keep more for the joints beyond.
    let middle = positions.iter().map(|x| Position::at(0.5 * (x.low + x.high)));
    let matrix = inertia_matrix(arm, positions.len(), &middle.collect::<Vec<_>>());
    let inertias: Vec<f64> =
        (0..positions.len()).map(|i| matrix[i][i].max(f64::MIN_POSITIVE)).collect();
    let firsts = FIRST.into_iter().filter(|first| *first < arms.len());
    // One joint has no ratio.
    let starts = firsts.flat_map(|first| [(first, scales), (first, &inertias)]);
    let starts = starts.filter(|(first, ratio)| *first > 1 || *ratio == scales);
    let mut floor = 0.0_f64;
    for (first, ratio) in starts {
        let (first, rest) = arms.split_at(first);
        let known =
            first.last().map(|arm| directly(arm, &positions[..arm.len()], ratio, 0.0, most).floor);
        let known = known.into_iter().flat_map(|floor| ratio.iter().map(move |x| x * floor));
        let floors: Vec<f64> = known.take(first.len()).collect();
        for kept in KEPT {
            floor = floor.max(by_joints(rest, floors.clone(), positions, (kept, scales), most));
        }
    }
    directly(arm, positions, scales, floor, most)
}

/// The floor of an arm by parts of its positions, above one that is known.
fn directly(
    arm: &[Body],
    positions: &[Interval],
    scales: &[f64],
    known: f64,
    most: usize,
) -> Floor {
    let (least, q) = search(arm, positions, scales);
    let (mut floor, mut parts) = (known, 0);
    for share in SHARES.into_iter().filter(|share| share * least > known) {
        let tried = scales[..arm.len()].iter().map(|x| x * share * least);
        let tried: Vec<f64> = tried.collect();
        let Some(taken) = is_above(arm, positions, &tried, most) else {
            break;
        };
        (floor, parts) = (share * least, taken);
    }
    Floor { floor, least, q, parts }
}

/// The floor of the last of some arms, each with a joint more than the one before, of which the
/// joints keep a share of their own floors.
fn by_joints(
    arms: &[Vec<Body>],
    mut floors: Vec<f64>,
    positions: &[Interval],
    (kept, scales): (f64, &[f64]),
    parts: usize,
) -> f64 {
    // Nothing follows from joints of which nothing is known.
    if !floors.iter().all(|floor| *floor > 0.0) {
        return 0.0;
    }
    for (number, arm) in arms.iter().enumerate() {
        let own = peel::own(arm) * (1.0 - 1e-12);
        let coupling = peel::coupling(arm, &positions[..arm.len()], &floors, parts);
        let before = scaled(&floors, scales);
        let last = scales[floors.len()];
        let lowest = |share: f64| (share * before).min(peel::least(own, coupling, share) / last);
        let shares = (1..100).map(|percent| 0.01 * f64::from(percent));
        // The last joint added is to have as much as the others.
        let best = shares.max_by(|a, b| lowest(*a).total_cmp(&lowest(*b)));
        let share = match number + 1 == arms.len() {
            true => best.unwrap_or(kept),
            false => kept,
        };
        floors.iter_mut().for_each(|floor| *floor *= share);
        floors.push(peel::least(own, coupling, share));
    }
    scaled(&floors, scales)
}

/// The least of some numbers by their scales.
fn scaled(of: &[f64], scales: &[f64]) -> f64 {
    let each = of.iter().zip(scales).map(|(x, scale)| x / scale);
    each.fold(f64::MAX, f64::min)
}

/// The number of parts by which it is proven that M is above the diagonal matrix of these numbers;
/// none if they are not enough.
pub fn is_above(
    bodies: &[Body],
    positions: &[Interval],
    floors: &[f64],
    most: usize,
) -> Option<usize> {
    let depends = |part: &[Interval]| Enclosure::of(bodies, part).slopes;
    let axes: Vec<usize> = depends(&somewhere(positions)).iter().map(|slope| slope.0).collect();
    let mut open = vec![positions.to_vec()];
    let mut parts = 0;
    while let Some(part) = open.pop() {
        parts += 1;
        if parts + open.len() > most {
            return None;
        }
        let enclosure = Enclosure::of(bodies, &part);
        let Some(weak) = enclosure.weak(floors) else {
            continue;
        };
        let axis = wide(&axes, &part, WIDE).or_else(|| enclosure.widest(&weak, &part))?;
        let Interval { low, high } = part[axis];
        let middle = 0.5 * (low + high);
        if !(low < middle && middle < high) {
            return None;
        }
        for half in [Interval::new(low, middle), Interval::new(middle, high)] {
            let mut states = part.clone();
            states[axis] = half;
            open.push(states);
        }
    }
    Some(parts)
}

/// A coordinate is not split if it has less than this share of the widest.
const NARROW: f64 = 0.2;

/// M over a part: the centre, slopes and remainders, each by the lower triangle.
struct Enclosure {
    centre: Matrix,
    slopes: Vec<(usize, Matrix)>,
    rest: Matrix,
    /// The roots of the centre's diagonal entries, which set the scale of each coordinate.
    scale: Vec<f64>,
}

impl Enclosure {
    fn of(bodies: &[Body], part: &[Interval]) -> Self {
        let at: Vec<Position<Taylor>> =
            part.iter().enumerate().map(|(joint, range)| Position::over(joint, *range)).collect();
        let matrix = inertia_matrix(bodies, part.len(), &at);
        let map = |of: &dyn Fn(&Taylor) -> f64| -> Matrix {
            let row = |row: &Vec<Taylor>| row.iter().map(of).collect();
            matrix.iter().map(row).collect()
        };
        let centre = map(&|x| x.centre);
        let scale = (0..part.len()).map(|i| centre[i][i].max(f64::MIN_POSITIVE).sqrt());
        let slopes = (0..SLOPES.min(part.len())).map(|k| (k, map(&|x| x.slopes[k])));
        let is_some = |slope: &(usize, Matrix)| slope.1.iter().flatten().any(|x| *x != 0.0);
        Self {
            scale: scale.collect(),
            slopes: slopes.filter(is_some).collect(),
            rest: map(&|x| x.rest),
            centre,
        }
    }

    /// The size of a slope in a direction.
    fn size(&self, of: &Matrix, weak: &[f64]) -> f64 {
        let mut size = 0.0;
        for (i, row) in of.iter().enumerate() {
            for (j, x) in row.iter().enumerate() {
                size += x.abs() * (weak[i] * weak[j]).abs() * if i == j { 1.0 } else { 2.0 };
            }
        }
        size
    }

    /// The coordinate along which M changes most in a direction, of those that are not much
    /// narrower than others: a slope says nothing of how it changes.
    fn widest(&self, weak: &[f64], part: &[Interval]) -> Option<usize> {
        let width = |k: usize| part[k].high - part[k].low;
        let most = self.slopes.iter().map(|(k, _)| width(*k)).fold(0.0, f64::max);
        let open = self.slopes.iter().filter(|(k, _)| width(*k) > NARROW * most);
        let sizes = open.map(|(k, slope)| (*k, self.size(slope, weak)));
        sizes.max_by(|a, b| a.1.total_cmp(&b.1)).map(|most| most.0)
    }

    /// A direction in which M may not be above the floors; none if it is everywhere.
    fn weak(&self, floors: &[f64]) -> Option<Vec<f64>> {
        let n = self.centre.len();
        // Slopes that hardly count join the remainder: each other one doubles the corners.
        let even: Vec<f64> = self.scale.iter().map(|scale| 1.0 / scale).collect();
        let sizes = self.slopes.iter().map(|(_, slope)| self.size(slope, &even));
        let most = sizes.fold(0.0, f64::max);
        let (large, small): (Vec<_>, Vec<_>) =
            self.slopes.iter().partition(|(_, slope)| self.size(slope, &even) > 1e-3 * most);
        let mut diagonal = vec![0.0; n];
        for i in 0..n {
            for j in 0..=i {
                let given = small.iter().map(|(_, slope)| slope[i][j].abs());
                let mut rest = self.rest[i][j] + given.sum::<f64>();
                // The roundings of the corners below.
                let all = large.iter().map(|(_, slope)| slope[i][j].abs());
                rest += 1e-14 * (self.centre[i][j].abs() + all.sum::<f64>());
                rest *= 1.0 + 1e-12;
                if i == j {
                    diagonal[i] += rest;
                } else {
                    let ratio = self.scale[i] / self.scale[j];
                    diagonal[i] += rest * ratio;
                    diagonal[j] += rest / ratio;
                }
            }
        }
        let mut corner = self.centre.clone();
        (0..1_usize << large.len()).find_map(|signs| {
            for (i, row) in corner.iter_mut().enumerate() {
                for (j, x) in row.iter_mut().enumerate() {
                    *x = self.centre[i][j];
                    for (bit, (_, slope)) in large.iter().enumerate() {
                        let sign = if signs >> bit & 1 == 0 { 1.0 } else { -1.0 };
                        *x += sign * slope[i][j];
                    }
                }
                row[i] -= (diagonal[i] + floors[i]) * (1.0 + 1e-12);
            }
            not_positive(&mut corner)
        })
    }
}

/// The least eigenvalue of M at a position, scaled as for [`prove`], to about ten digits: by
/// halving.
pub fn least_eigenvalue(bodies: &[Body], q: &[f64], scales: &[f64]) -> f64 {
    let at: Vec<Position<f64>> = q.iter().map(|q| Position::at(*q)).collect();
    let matrix = inertia_matrix(bodies, q.len(), &at);
    let is_above = |x: f64| {
        let mut shifted = matrix.clone();
        for (i, row) in shifted.iter_mut().enumerate() {
            row[i] -= x * scales[i];
        }
        not_positive(&mut shifted).is_none()
    };
    let (mut low, mut high) =
        (0.0, (0..q.len()).map(|i| matrix[i][i] / scales[i]).fold(f64::MAX, f64::min));
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if is_above(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// Positions that are tried at random, and steps from the least of them.
const TRIED: usize = 20_000;

fn search(bodies: &[Body], positions: &[Interval], scales: &[f64]) -> (f64, Vec<f64>) {
    let mut rng = Rng::with_seed(1);
    let mut best = (f64::INFINITY, Vec::new());
    let keep = |q: Vec<f64>, best: &mut (f64, Vec<f64>)| {
        let value = least_eigenvalue(bodies, &q, scales);
        if value < best.0 {
            *best = (value, q);
        }
    };
    for _ in 0..TRIED {
        let q = positions.iter().map(|x| x.low + rng.f64() * (x.high - x.low));
        keep(q.collect(), &mut best);
    }
    for step in 0..TRIED {
        let reach = 0.5_f64.powi((step % 24) as i32);
        let q = best.1.iter().zip(positions).map(|(q, x)| {
            let moved = q + (rng.f64() - 0.5) * reach * (x.high - x.low);
            moved.clamp(x.low, x.high)
        });
        keep(q.collect(), &mut best);
    }
    best
}
