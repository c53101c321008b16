//! The error of forward dynamics, relative to the condition of the inertia matrix.
//!
//! The machine code computes M̂ and b̂, of which |M̂ − M| ≤ μ and |b̂ − b| ≤ β are proven over the
//! box as torques are, and solves with the factors of M̂, so that (M̂ + E) q̈̂ = τ − b̂ with |E_ij|
//! ≤ γ_m Σ_k d_k |l_ki l_kj| ([`crate::factors`]). Pivots d are positive, so that this sum is at
//! most √(h_i h_j) by the inequality of Cauchy and Schwarz, with h_i = Σ_k d_k l_ki² ≤ M̂_ii / (1 −
//! γ). Therefore, at each state,
//!
//!   |q̈̂ − q̈| ≤ |M⁻¹| (β + Φ |q̈̂|),   Φ_ij = μ_ij + γ_m √(h_i h_j),
//!
//! entry by entry (Higham 2002, section 7.2), and with S = diag(√h_i) of the greatest h_i of the
//! box and ρ = ‖(S⁻¹ M S⁻¹)⁻¹‖₂
//!
//!   ‖S (q̈̂ − q̈)‖₂ ≤ ρ (β_S + ε ‖S q̈̂‖₂),   β_S = ‖S⁻¹ β‖₂,   ε = ‖S⁻¹ Φ S⁻¹‖₂.
//!
//! ρ is the condition number κ of S⁻¹ M S⁻¹ by its norm, which is at most n: scaled so that the
//! diagonal is at most one, M is nearly as well conditioned as it can be (van der Sluis, Numerische
//! Mathematik 14, 1969; Demmel, LAPACK Working Note 14, 1989).
//!
//! Pivots are positive wherever ρ ε < 1. Let every rounding be 1 + t δ, 0 ≤ t ≤ 1. At t = 0 the
//! pivots are those of M̂, which is positive definite, and they are continuous in t while they are
//! positive. So long, M̂ + E is above (1/ρ − ε) S², and so is each pivot above (1/ρ − ε) h_k: none
//! reaches zero.
//!
//! A number below 2⁻¹²⁶ has an absolute error of 2⁻¹⁵⁰ besides. Such errors of all operations, with
//! factors of at most n h, are less than `TINY`.

use serde::{Deserialize, Serialize};

use crate::bodies::{Body, Position, inertia_matrix};
use crate::bound::{Bounder, Enclosure, SineErrors};
use crate::error::{Error, Result};
use crate::exact::torques;
use crate::factors::{Factored, Noise};
use crate::floor::{self, Floor};
use crate::graph::Graph;
use crate::output::Output;
use crate::search::{Effort, Evaluation, Observed, worst};
use crate::state_box::Robot;

/// The unit roundoff of f32.
const UNIT: f64 = 1.0 / (1 << 24) as f64;
/// A bound of the sum of all errors of subnormal numbers, for robots whose inertias are at most
/// [`HEAVIEST`].
const TINY: f64 = 1e-30;
/// The greatest inertia for which [`TINY`] holds, kg·m².
const HEAVIEST: f64 = 1e6;
/// A factor that exceeds the relative errors of the sums in this file, which are in f64.
const UP: f64 = 1.0 + 1e-12;

type Matrix = Vec<Vec<f64>>;

/// The proven errors of forward dynamics.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Forward {
    /// β: of the bias of each joint, N·m or N.
    pub bias: Vec<f64>,
    /// μ: of the inertia matrix, kg·m², kg·m or kg.
    pub matrix: Matrix,
    /// The count m of roundings, for each entry.
    pub roundings: Vec<Vec<u32>>,
    /// The squares of S: the greatest h of each joint.
    pub scales: Vec<f64>,
    /// The norm ε = ‖S⁻¹ Φ S⁻¹‖₂ above.
    pub epsilon: f64,
    /// The norm β_S = ‖S⁻¹ β‖₂ above.
    pub beta: f64,
    /// The floor of the least eigenvalue of S⁻¹ M S⁻¹, which is 1/ρ.
    pub floor: Floor,
    /// Whether it follows that each state of the box has accelerations: no pivot is too small for
    /// the code.
    pub is_total: bool,
    /// The states that were tried.
    pub states: usize,
    /// For each joint, the greatest error of its acceleration as a share of the bound at the same
    /// state; then that of the norm.
    pub shares: Vec<Observed>,
    /// The same states, for a computation in more digits.
    pub worst: Vec<Worst>,
    /// The bodies of the robot, for that computation.
    pub bodies: Vec<Body>,
}

/// Accelerations of the machine code at a state, and how far they are off.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Worst {
    /// Positions, rad or m.
    pub q: Vec<f64>,
    /// Speeds, rad/s or m/s.
    pub qd: Vec<f64>,
    /// Torques, N·m or N, numbers of f32.
    pub tau: Vec<f64>,
    /// Accelerations of the machine code, rad/s² or m/s².
    pub computed: Vec<f64>,
    /// Their errors, computed in f64.
    pub errors: Vec<f64>,
    /// The error of this joint, or of the norm, as a share of its bound.
    pub share: f64,
}

/// The number γ_m = m u / (1 − m u) of a count m of roundings, for the unit roundoff u.
fn gamma(roundings: u32) -> f64 {
    let sum = f64::from(roundings) * UNIT;
    sum / (1.0 - sum) * UP
}

impl Forward {
    /// Derives the errors from the bounds of the results of [`Factored::graph`], for sines of these
    /// errors and a robot of these bodies. The floor is proven by at most so many parts.
    ///
    /// # Errors
    /// [`Error::Factors`] of inertias beyond what f32 is taken for, [`Error::Floor`].
    pub fn prove(
        factored: &Factored,
        outputs: &[Output],
        bodies: &[Body],
        robot: &Robot,
        sines: SineErrors,
        parts: usize,
    ) -> Result<Self> {
        let n = robot.joints.len();
        let of = |i: usize, j: usize| &outputs[n + i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
        let matrix = |i: usize| (0..n).map(|j| of(i, j).bound).collect();
        let mut forward = Self {
            bias: outputs[..n].iter().map(|output| output.bound + TINY).collect(),
            matrix: (0..n).map(matrix).collect(),
            roundings: factored.roundings.clone(),
            ..Self::default()
        };
        let greatest: Vec<f64> = (0..n).map(|i| of(i, i).range.high).collect();
        forward.scales = forward.sizes(&greatest);
        if !forward.scales.iter().all(|h| (0.0..HEAVIEST).contains(h)) {
            let what = format!("inertias of {:?}", forward.scales);
            return Err(Error::Factors { what });
        }
        let phi = forward.backward(&forward.scales);
        let scaled =
            |i: usize, j: usize| phi[i][j] / (forward.scales[i] * forward.scales[j]).sqrt();
        let row = |i: usize| (0..n).map(|j| scaled(i, j)).collect();
        forward.epsilon = norm(&(0..n).map(row).collect());
        let squares = forward.bias.iter().zip(&forward.scales);
        forward.beta = squares.map(|(b, h)| b * b / h).sum::<f64>().sqrt() * UP;
        let positions = &robot.whole()[..n];
        forward.floor = floor::prove(bodies, positions, &forward.scales, parts);
        forward.floor.check()?;
        let above = (forward.floor.floor - forward.epsilon) * (1.0 - 4.0 * UNIT);
        let exceeds = |(noise, h): (&Option<Noise>, &f64)| {
            let noise = noise.unwrap_or_default();
            above * h > noise.least && above > noise.share
        };
        let mut pivots = factored.noise.iter().zip(&forward.scales);
        let exceeds_others = |(joint, node): &(usize, usize)| {
            above * forward.scales[*joint] > greatest_over(&factored.graph, *node, robot, sines)
        };
        forward.is_total = pivots.all(exceeds) && factored.others.iter().all(exceeds_others);
        Ok(forward)
    }

    /// h of a diagonal of M̂.
    fn sizes(&self, diagonal: &[f64]) -> Vec<f64> {
        let most = self.roundings.iter().flatten().max().copied().unwrap_or(0);
        let size = |m: &f64| m / (1.0 - gamma(most)) * UP;
        diagonal.iter().map(size).collect()
    }

    /// The matrix Φ of the backward error, from the sizes of the scaled entries.
    fn backward(&self, sizes: &[f64]) -> Matrix {
        let entry = |i: usize, j: usize| {
            self.matrix[i][j] + gamma(self.roundings[i][j]) * (sizes[i] * sizes[j]).sqrt() + TINY
        };
        let n = sizes.len();
        (0..n).map(|i| (0..n).map(|j| entry(i, j) * UP).collect()).collect()
    }

    /// |M⁻¹| (β + Φ |q̈|) for M, its lower triangle, its inverse, and computed accelerations.
    pub fn bound(&self, matrix: &Matrix, inverse: &Matrix, accelerations: &[f64]) -> Vec<f64> {
        let diagonal = (0..self.bias.len()).map(|i| matrix[i][i] + self.matrix[i][i]);
        let phi = self.backward(&self.sizes(&diagonal.collect::<Vec<_>>()));
        let residual =
            phi.iter().zip(&self.bias).map(|(row, bias)| bias + magnitude(row, accelerations));
        let residual: Vec<f64> = residual.collect();
        inverse.iter().map(|row| magnitude(row, &residual)).collect()
    }

    /// Searches the greatest shares, at states of which accelerations are drawn too: torques are
    /// those that they need.
    ///
    /// # Errors
    /// [`Error::Contradicted`] if an error is above its bound.
    pub fn search(
        &mut self,
        code: &Graph,
        bodies: &[Body],
        robot: &Robot,
        effort: Effort,
    ) -> Result<()> {
        let n = robot.joints.len();
        let mut exact = Exact { bodies, evaluation: Evaluation::new(code, robot) };
        let shares = worst(robot, n + 1, effort, 1, |state| {
            let Some(trial) = exact.at(state) else {
                return vec![0.0; n + 1];
            };
            self.shares_of(&trial)
        });
        self.states = effort.states(n + 1);
        self.bodies = bodies.to_vec();
        let worst =
            |share: &Observed| Some(Worst { share: share.error, ..exact.at(&share.state)?.of });
        self.worst = shares.iter().filter_map(worst).collect();
        for (number, share) in shares.iter().enumerate() {
            if share.error.is_nan() || share.error > 1.0 {
                return Err(Error::Contradicted {
                    output: number + 1,
                    bound: 1.0,
                    observed: share.error,
                });
            }
        }
        self.shares = shares;
        Ok(())
    }

    /// For each joint, the error as a share of its bound, and the same of the norm; zero where
    /// nothing is proven.
    fn shares_of(&self, trial: &Trial) -> Vec<f64> {
        let rho = self.inverse_norm(&trial.inverse);
        if rho * self.epsilon >= 1.0 {
            return vec![0.0; trial.of.errors.len() + 1];
        }
        let bounds = self.bound(&trial.matrix, &trial.inverse, &trial.of.computed);
        let shares = trial.of.errors.iter().zip(&bounds);
        let mut shares: Vec<f64> = shares.map(|(error, bound)| error.abs() / bound).collect();
        let size = |x: &[f64]| {
            let squares = x.iter().zip(&self.scales).map(|(x, h)| x * x * h);
            squares.sum::<f64>().sqrt()
        };
        let bound = rho * (self.beta + self.epsilon * size(&trial.of.computed));
        shares.push(size(&trial.of.errors) / bound);
        shares
    }

    /// ρ by the power method from M⁻¹, of which each step is at most ρ.
    fn inverse_norm(&self, inverse: &Matrix) -> f64 {
        let root: Vec<f64> = self.scales.iter().map(|h| h.sqrt()).collect();
        let (mut x, mut length) = (vec![1.0; root.len()], 0.0);
        for _ in 0..STEPS {
            let unscaled: Vec<f64> = x.iter().zip(&root).map(|(x, s)| x * s).collect();
            let moved = inverse.iter().zip(&root);
            let moved: Vec<f64> = moved.map(|(row, s)| s * dot(row, &unscaled)).collect();
            length = dot(&moved, &moved).sqrt();
            x = moved.iter().map(|x| x / length).collect();
        }
        length * (1.0 - 1e-12)
    }
}

/// At least the greatest number that a node has over the box, as it is computed.
pub fn greatest_over(graph: &Graph, node: usize, robot: &Robot, sines: SineErrors) -> f64 {
    let graph = Graph { nodes: graph.nodes.clone(), outputs: vec![(0, node)] };
    let Some(mut bounder) = Bounder::new(&graph, 0, robot, sines, Enclosure::Plain) else {
        return f64::INFINITY;
    };
    bounder.bound(&robot.whole());
    match bounder.is_finite() {
        true => bounder.range().high,
        false => f64::INFINITY,
    }
}

/// The quantities of a state, exact but for the roundings of f64.
struct Trial {
    matrix: Matrix,
    inverse: Matrix,
    of: Worst,
}

struct Exact<'a> {
    bodies: &'a [Body],
    evaluation: Evaluation<'a>,
}

impl Exact<'_> {
    /// At positions, speeds and accelerations, for the torques of f32 that are next to those that
    /// these need.
    fn at(&mut self, state: &[f64]) -> Option<Trial> {
        let n = state.len() / 3;
        let [q, qd, qdd] = [0, 1, 2].map(|i| &state[i * n..(i + 1) * n]);
        let needed = torques(self.bodies, q, qd, qdd);
        let given: Vec<f64> = needed.iter().map(|tau| f64::from(*tau as f32)).collect();
        let more: Vec<f64> = given.iter().zip(&needed).map(|(a, b)| a - b).collect();
        let at: Vec<Position<f64>> = q.iter().map(|q| Position::at(*q)).collect();
        let matrix = inertia_matrix(self.bodies, n, &at);
        let inverse = inverse(&matrix)?;
        let input = [q, qd, &given].concat();
        let computed: Vec<f64> = self.evaluation.at(&input).map(|one| one.0.into()).collect();
        let error = |i: usize| computed[i] - (qdd[i] + dot(&inverse[i], &more));
        let of = Worst {
            errors: (0..n).map(error).collect(),
            q: q.to_vec(),
            qd: qd.to_vec(),
            tau: given,
            computed,
            share: 0.0,
        };
        Some(Trial { matrix, inverse, of })
    }
}

/// Steps of the power method.
const STEPS: usize = 20;

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The product of two rows' magnitudes.
fn magnitude(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a * b).abs()).sum()
}

/// A bound of the greatest singular value of a matrix without negative entries: the root of its
/// greatest sums of a row and of a column.
fn norm(of: &Matrix) -> f64 {
    let row = of.iter().map(|row| row.iter().sum()).fold(0.0, f64::max);
    let columns = (0..of.len()).map(|j| of.iter().map(|row| row[j]).sum());
    (row * columns.fold(0.0, f64::max)).sqrt() * UP
}

/// The inverse of a symmetric positive definite matrix, of which the lower triangle is given: by
/// Gauss and Jordan, in place.
pub fn inverse(of: &Matrix) -> Option<Matrix> {
    let n = of.len();
    let mut a: Matrix = (0..n).map(|i| (0..n).map(|j| of[i.max(j)][i.min(j)]).collect()).collect();
    for k in 0..n {
        let pivot = a[k][k];
        if pivot.is_nan() || pivot <= 0.0 {
            return None;
        }
        a[k][k] = 1.0;
        a[k].iter_mut().for_each(|x| *x /= pivot);
        let row = a[k].clone();
        for (_, other) in a.iter_mut().enumerate().filter(|one| one.0 != k) {
            let factor = std::mem::take(&mut other[k]);
            other.iter_mut().zip(&row).for_each(|(x, y)| *x -= factor * y);
        }
    }
    Some(a)
}
