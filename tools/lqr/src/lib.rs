//! The discrete linear-quadratic regulator of a [`Linearisation`], and its gains as Rust source for
//! a table on the target.
//!
//! For δx⁺ = Φ δx + Γ δu of a tick, the gains K of δu = −K δx with the least Σ δxᵀ Q δx + δuᵀ R δu
//! are K = (R + Γᵀ P Γ)⁻¹ Γᵀ P Φ, P being the stabilising solution of the Riccati equation. It is
//! found by doubling: Chu, Fan, Lin & Wang, "Structure-preserving algorithms for periodic
//! discrete-time algebraic Riccati equations" (2004), algorithm 1.
#![forbid(unsafe_code)]

use dynamics_core::algorithms::Linearisation;
use nalgebra::{Complex, ComplexField, DMatrix};

/// The largest deviations that are as bad as each other: Q and R are the inverses of their squares
/// (Bryson's rule).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviations<const V: usize, const U: usize> {
    /// Of the coordinates, rad or m.
    pub q: [f64; V],
    /// Of their velocities, rad/s or m/s.
    pub qd: [f64; V],
    /// Of the inputs, N·m or N.
    pub u: [f64; U],
}

/// Why there are no gains.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LqrError {
    /// A deviation is not positive, or a number is not finite.
    #[error("a deviation is not positive, or the linearisation is not finite")]
    NotFinite,
    /// A motion that does not decay by itself, and that no input reaches; the coordinate with the
    /// largest share of it, from 0.
    #[error(
        "no input reaches a motion that does not decay by itself, mostly of coordinate \
         {0}: drive it, or take it out of the state"
    )]
    NotReached(usize),
    /// A motion that does not decay by itself, and whose deviations are all infinite; its
    /// coordinate.
    #[error(
        "a motion that does not decay by itself, mostly of coordinate {0}, has no weight: \
         give it a finite deviation, or take it out of the state"
    )]
    NotWeighted(usize),
    /// Numbers of too different sizes for f64.
    #[error("the gains that were found do not make the system stable: its numbers differ too much")]
    NotStabilisable,
}

/// By how much less than one a motion's factor in a tick is for it to decay, twice the digits of a
/// double eigenvalue in f64, and the singular value below which nothing moves a motion.
const SMALL: f64 = 1e-7;
/// The doublings after which P has long converged: 2⁶⁰ ticks.
const DOUBLINGS: usize = 60;

/// Φ and Γ of a tick of `h` seconds in which the inputs are held: the first rows of e^([A B; 0 0] h),
/// also for friction that stops a light joint within a part of a tick.
pub fn held<const V: usize, const U: usize>(
    plant: &Linearisation<f64, V, U>,
    h: f64,
) -> [DMatrix<f64>; 2] {
    let mut rates = DMatrix::zeros(2 * V + U, 2 * V + U);
    for i in 0..V {
        rates[(i, V + i)] = h;
        let row = plant.dq[i].iter().chain(&plant.dqd[i]).chain(&plant.du[i]);
        for (j, rate) in row.enumerate() {
            rates[(V + i, j)] = h * rate;
        }
    }
    let all = rates.exp();
    [(0, 2 * V), (2 * V, U)].map(|(from, width)| all.view((0, from), (2 * V, width)).into_owned())
}

/// The motion that does not decay under Φ and is moved least by the columns of `by` (Popov,
/// Belevitch and Hautus): its singular value, and the row of its largest entry.
fn least_moved(phi: &DMatrix<f64>, by: &DMatrix<f64>) -> Option<(f64, usize)> {
    let complex = |m: &DMatrix<f64>| m.map(Complex::from);
    let rates = phi.complex_eigenvalues();
    let slow = rates.iter().filter(|rate| rate.norm() > 1.0 - SMALL);
    let each = slow.filter_map(|rate| {
        let off = complex(phi) - DMatrix::identity(phi.nrows(), phi.nrows()) * *rate;
        let columns = [off, complex(by)];
        let all: Vec<_> = columns.iter().flat_map(|m| m.column_iter()).collect();
        let found = DMatrix::from_columns(&all).svd(true, false);
        let (k, least) = found.singular_values.argmin();
        Some((least, found.u?.column(k).map(Complex::norm).argmax().0))
    });
    each.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// The reason why a system of V coordinates has no gains.
fn reason<const V: usize>(phi: &DMatrix<f64>, gamma: &DMatrix<f64>, q: &DMatrix<f64>) -> LqrError {
    let within = |found: Option<(f64, usize)>| found.filter(|(least, _)| *least < SMALL);
    let of = |found| within(found).map(|(_, row)| row % V);
    let unseen = of(least_moved(&phi.transpose(), &q.map(f64::sqrt))).map(LqrError::NotWeighted);
    let unreached = of(least_moved(phi, gamma)).map(LqrError::NotReached);
    unreached.or(unseen).unwrap_or(LqrError::NotStabilisable)
}

/// The gains K of δu = −K [δq; δq̇], U × 2 V, of a tick of `h` seconds.
///
/// ```
/// use dynamics_core::algorithms::Linearisation;
/// use lqr_gains::{Deviations, held, lqr};
/// // An inverted pendulum of 1 kg·m² that falls with 3 1/s.
/// let pendulum = Linearisation { dq: [[9.0]], dqd: [[0.0]], du: [[1.0]] };
/// let k = lqr(&pendulum, 2e-3, &Deviations { q: [0.1], qd: [1.0], u: [1.0] })?;
/// let [phi, gamma] = held(&pendulum, 2e-3);
/// assert!((phi - gamma * &k).complex_eigenvalues().iter().all(|z| z.norm() < 1.0));
/// # Ok::<(), lqr_gains::LqrError>(())
/// ```
///
/// # Errors
/// [`LqrError`].
pub fn lqr<const V: usize, const U: usize>(
    plant: &Linearisation<f64, V, U>,
    h: f64,
    deviations: &Deviations<V, U>,
) -> Result<DMatrix<f64>, LqrError> {
    let weights = |of: &[f64]| {
        let squares: Vec<_> = of.iter().map(|x| 1.0 / (x * x)).collect();
        DMatrix::from_diagonal(&nalgebra::DVector::from_vec(squares))
    };
    let Deviations { q, qd, u } = deviations;
    let (q, r) = (weights(&[*q, *qd].concat()), weights(u));
    let [phi, gamma] = held(plant, h);
    if [&q, &r, &phi, &gamma].iter().any(|m| m.iter().any(|x| !x.is_finite())) {
        return Err(LqrError::NotFinite);
    }
    let r_inv = r.map(|x| if x > 0.0 { 1.0 / x } else { 0.0 });
    let (mut a, mut g, mut p) = (phi.clone(), &gamma * r_inv * gamma.transpose(), q.clone());
    let why = || reason::<V>(&phi, &gamma, &q);
    let one = DMatrix::identity(2 * V, 2 * V);
    for _ in 0..DOUBLINGS {
        let w = (&one + &g * &p).try_inverse().ok_or_else(why)?;
        let (aw, more) = (&a * &w, a.transpose() * &p * &w * &a);
        g += &aw * &g * a.transpose();
        a = &aw * &a;
        let settled = more.norm() <= f64::EPSILON * p.norm();
        p += more;
        p = 0.5 * (&p + p.transpose());
        if settled {
            break;
        }
    }
    let inner = (r + gamma.transpose() * &p * &gamma).try_inverse();
    let k = inner.ok_or_else(why)? * gamma.transpose() * &p * &phi;
    let closed = &phi - &gamma * &k;
    let stable = k.iter().all(|x| x.is_finite())
        && closed.complex_eigenvalues().iter().all(|z| z.norm() < 1.0);
    if stable { Ok(k) } else { Err(why()) }
}

/// The rows of matrices as the Rust source of an array of arrays of arrays of `f32`, one row a
/// line: the numbers of a `GainTable` of `motion-control`.
///
/// ```
/// let k = nalgebra::DMatrix::from_row_slice(1, 2, &[0.5, -1234.5678901]);
/// assert_eq!(lqr_gains::source(&[k]), "[\n    [\n        [0.5, -1234.5679],\n    ],\n]");
/// ```
pub fn source(tables: &[DMatrix<f64>]) -> String {
    let number = |x: &f64| format!("{:?}", *x as f32);
    let row = |row: nalgebra::DMatrixView<'_, f64>| {
        format!("        [{}],\n", row.iter().map(number).collect::<Vec<_>>().join(", "))
    };
    let table = |k: &DMatrix<f64>| {
        let rows = (0..k.nrows()).map(|i| row(k.view((i, 0), (1, k.ncols()))));
        format!("    [\n{}    ],\n", rows.collect::<String>())
    };
    format!("[\n{}]", tables.iter().map(table).collect::<String>())
}
