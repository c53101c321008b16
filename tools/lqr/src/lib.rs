//! The discrete linear-quadratic regulator of a [`Linearisation`], and its gains as Rust source for
//! a table on the target.
//!
//! For δx⁺ = Φ δx + Γ δu of a tick, the gains K of δu = −K δx with the least Σ δxᵀ Q δx + δuᵀ R δu
//! are K = (R + Γᵀ P Γ)⁻¹ Γᵀ P Φ, P being the stabilising solution of the Riccati equation. It is
//! found by doubling: Chu, Fan, Lin & Wang, "Structure-preserving algorithms for periodic
//! discrete-time algebraic Riccati equations" (2004), algorithm 1.
#![forbid(unsafe_code)]

use dynamics_core::algorithms::Linearisation;
use nalgebra::DMatrix;

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
    /// An unstable motion that the inputs do not reach.
    #[error("no gains make the system stable: an unstable motion is out of the inputs' reach")]
    NotStabilisable,
}

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
    let (mut a, mut g, mut p) = (phi.clone(), &gamma * r_inv * gamma.transpose(), q);
    let one = DMatrix::identity(2 * V, 2 * V);
    for _ in 0..DOUBLINGS {
        let w = (&one + &g * &p).try_inverse().ok_or(LqrError::NotStabilisable)?;
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
    let k = inner.ok_or(LqrError::NotStabilisable)? * gamma.transpose() * &p * &phi;
    let closed = phi - gamma * &k;
    let stable = k.iter().all(|x| x.is_finite())
        && closed.complex_eigenvalues().iter().all(|z| z.norm() < 1.0);
    if stable { Ok(k) } else { Err(LqrError::NotStabilisable) }
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
