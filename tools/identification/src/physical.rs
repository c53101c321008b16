//! Parameters of all bodies and joints that are possible and nearest to an estimate.
//!
//! The pseudo-inertia of a body J = L X Lᵀ, with that of the nominal body L Lᵀ, is positive
//! definite if X is. X is 1 at the nominal model, and the norm of its change is the
//! affine-invariant metric there: Lee, Wensing & Park, "Geometric robot dynamic identification: a
//! convex programming approach" (2020). The function that is minimised is convex: the squares of
//! the estimate's errors relative to its covariance and of the changes relative to their stated
//! size, over X ⪰ margin and joints' parameters ≥ margin (Sousa & Cortesão, "Physical feasibility
//! of robot base inertial parameter identification: a linear matrix inequality approach", 2014). By
//! the alternating direction method of multipliers: Boyd et al. (2011), (3.2) to (3.4).

use dynamics_core::effects::Effect;
use dynamics_core::model::RobotModel;
use nalgebra::{DMatrix, DVector, Matrix4};

use crate::columns::OF_JOINT;
use crate::{BaseModel, IdentificationError};

/// The share of the nominal pseudo-inertia and friction that remains in all directions: more than
/// that of [`PhysicalParameters`](motion_control::estimate::PhysicalParameters), so that rounding
/// to f32 leaves a set possible.
const MARGIN: f64 = 0.06;
/// No base parameter counts as known better than to this share of its nominal deviation: without
/// noise, in a simulation, rounding would decide.
const LEAST: f64 = 1e-5;
pub(crate) const STEPS: usize = 20_000;
/// The change of a step, in relative units, from which on the set is final.
const FINAL: f64 = 1e-9;
/// Offsets and asymmetries may be this times the torque of a joint, and of either sign.
const OFFSETS: f64 = 0.1;
const FREE: [usize; 2] = [3, 5];

/// Parameters that an arm can have: its bodies' pseudo-inertias are positive definite and its
/// frictions positive.
#[derive(Clone, Debug, PartialEq)]
pub struct PhysicalSet<const B: usize, const V: usize> {
    /// Ten parameters of each body, as
    /// [`inertial_parameters`](dynamics_core::algorithms::inertial_parameters).
    pub bodies: [[f64; 10]; B],
    /// Those of each joint, in the order of [`OfJoint`](crate::OfJoint).
    pub joints: [[f64; OF_JOINT]; V],
    /// The root mean square of the differences from the estimate, in standard deviations: far above
    /// one if no possible arm has the estimate, for example because the friction of the model is
    /// another one than the arm's.
    pub misfit: f64,
}

/// [`Fitted::physical`](crate::Fitted::physical) of base parameters with the covariance SᵀS, in so many steps at most.
pub(crate) fn most_probable<D, E, const B: usize, const V: usize>(
    base: &[f64],
    deviations: &DMatrix<f64>,
    arm: &BaseModel<D, E, B, V>,
    bodies: &[[f64; 10]; B],
    joints: &[[f64; OF_JOINT]; V],
    share: f64,
    steps: usize,
) -> Result<PhysicalSet<B, V>, IdentificationError>
where
    D: RobotModel<f64, B, V, V>,
    E: Effect<f64, B, V>,
{
    let mut roots = [None; B];
    for (body, (root, phi)) in roots.iter_mut().zip(bodies).enumerate() {
        let inertia = pseudo_inertia(phi);
        *root = inertia.cholesky().map(|factor| factor.l());
        if root.is_none() && phi.iter().any(|x| *x != 0.0) {
            return Err(IdentificationError::ImpossibleBody { body });
        }
    }
    let units = units(&roots, joints, &arm.limits.torque);
    let nominal = nominal(&roots, joints, &units);
    // In units of the estimate's deviations: L⁻¹ (K U x − β), with the covariance L Lᵀ.
    let mut covariance = deviations.tr_mul(deviations);
    for (k, row) in (&arm.grouping * &units).row_iter().enumerate() {
        covariance[(k, k)] += (LEAST * share * row.norm()).powi(2);
    }
    let lower = covariance.cholesky().expect("positive deviations").l();
    let factor = lower.try_inverse().expect("positive deviations");
    let explained = &factor * &arm.grouping * &units;
    let target = &factor * DVector::from_column_slice(base);
    let prior = 1.0 / (share * share);
    let squares = explained.tr_mul(&explained);
    // Between the least and the greatest curvature.
    let rho = (prior * squares.diagonal().max().max(prior)).sqrt().sqrt() * prior.sqrt();
    let n = units.ncols();
    let identity = DMatrix::identity(n, n);
    let inverse = |ridge: f64| {
        let matrix = &squares + &identity * ridge;
        matrix.cholesky().expect("positive definite").inverse()
    };
    let right = explained.tr_mul(&target) + &nominal * prior;
    let mut x = inverse(prior) * &right;
    let mut z = possible::<B>(&x);
    if z != x {
        let inverse = inverse(prior + rho);
        let mut u = &x - &z;
        for _ in 0..steps {
            x = product(&inverse, &(&right + (&z - &u) * rho));
            let next = possible::<B>(&(&x + &u));
            u += &x - &next;
            let change = (&next - &z).amax().max((&x - &next).amax());
            z = next;
            if change < FINAL {
                break;
            }
        }
    }
    let misfit = (&explained * &z - &target).norm() / (base.len() as f64).sqrt();
    let all = units * z;
    let part = |from: usize, count: usize| all.rows(from, count);
    let bodies = std::array::from_fn(|body| std::array::from_fn(|k| part(10 * body, 10)[k]));
    let joints = std::array::from_fn(|joint| {
        std::array::from_fn(|k| part(10 * B + OF_JOINT * joint, OF_JOINT)[k])
    });
    Ok(PhysicalSet { bodies, joints, misfit })
}

/// A x, whose loops are quick without an optimising compiler, too: most of the steps' time.
fn product(a: &DMatrix<f64>, x: &DVector<f64>) -> DVector<f64> {
    let (mut y, rows) = (vec![0.0; a.nrows()], a.nrows());
    for (column, x) in a.as_slice().chunks_exact(rows).zip(x.as_slice()) {
        let mut i = 0;
        while i < rows {
            y[i] += column[i] * x;
            i += 1;
        }
    }
    DVector::from_vec(y)
}

/// \[Σ h; hᵀ m\].
fn pseudo_inertia(phi: &[f64; 10]) -> Matrix4<f64> {
    let [m, x, y, z, xx, xy, yy, xz, yz, zz] = *phi;
    let half = 0.5 * (xx + yy + zz);
    #[rustfmt::skip]
    let rows = Matrix4::new(
        half - xx, -xy, -xz, x,
        -xy, half - yy, -yz, y,
        -xz, -yz, half - zz, z,
        x, y, z, m,
    );
    rows
}

fn parameters(j: &Matrix4<f64>) -> [f64; 10] {
    let trace = j[(0, 0)] + j[(1, 1)] + j[(2, 2)];
    let [xx, yy, zz] = [0, 1, 2].map(|k| trace - j[(k, k)]);
    let [xy, xz, yz] = [(0, 1), (0, 2), (1, 2)].map(|at| -j[at]);
    [j[(3, 3)], j[(0, 3)], j[(1, 3)], j[(2, 3)], xx, xy, yy, xz, yz, zz]
}

/// The places of the ten numbers of a symmetric X: those off the diagonal are times √2, so that the
/// norms are the same.
const PLACES: [(usize, usize); 10] =
    [(0, 0), (1, 1), (2, 2), (3, 3), (0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];

fn symmetric(x: impl Fn(usize) -> f64) -> Matrix4<f64> {
    let mut matrix = Matrix4::zeros();
    for (k, (i, j)) in PLACES.into_iter().enumerate() {
        let value = x(k) / if i == j { 1.0 } else { 2.0_f64.sqrt() };
        (matrix[(i, j)], matrix[(j, i)]) = (value, value);
    }
    matrix
}

fn numbers(matrix: &Matrix4<f64>) -> [f64; 10] {
    PLACES.map(|(i, j)| matrix[(i, j)] * if i == j { 1.0 } else { 2.0_f64.sqrt() })
}

/// The parameters per unit of x: of each body L X Lᵀ, of each joint its nominal number, of an
/// offset a share of the torque.
fn units<const B: usize, const V: usize>(
    roots: &[Option<Matrix4<f64>>; B],
    joints: &[[f64; OF_JOINT]; V],
    torque: &[f64; V],
) -> DMatrix<f64> {
    let n = 10 * B + OF_JOINT * V;
    let mut units = DMatrix::zeros(n, n);
    for (body, root) in roots.iter().enumerate() {
        let Some(root) = root else { continue };
        for k in 0..10 {
            let unit = symmetric(|at| f64::from(u8::from(at == k)));
            let column = parameters(&(root * unit * root.transpose()));
            for (i, value) in column.into_iter().enumerate() {
                units[(10 * body + i, 10 * body + k)] = value;
            }
        }
    }
    for (joint, (nominal, torque)) in joints.iter().zip(torque).enumerate() {
        let [viscous, coulomb, armature, _, stribeck, _] = *nominal;
        let free = OFFSETS * torque;
        let own = [viscous, coulomb, armature, free, stribeck, free];
        for (k, unit) in own.into_iter().enumerate() {
            let at = 10 * B + OF_JOINT * joint + k;
            units[(at, at)] = unit;
        }
    }
    units
}

fn nominal<const B: usize, const V: usize>(
    roots: &[Option<Matrix4<f64>>; B],
    joints: &[[f64; OF_JOINT]; V],
    units: &DMatrix<f64>,
) -> DVector<f64> {
    let one = numbers(&Matrix4::identity());
    let bodies = roots.iter().flat_map(|_| one);
    let own = joints.iter().enumerate().flat_map(|(joint, [_, _, _, offset, _, asymmetry])| {
        let at = 10 * B + OF_JOINT * joint + 3;
        let free = units[(at, at)];
        [1.0, 1.0, 1.0, offset / free, 1.0, asymmetry / free]
    });
    DVector::from_iterator(units.ncols(), bodies.chain(own))
}

/// The nearest x that a body and a joint can have.
fn possible<const B: usize>(x: &DVector<f64>) -> DVector<f64> {
    let mut nearest = x.clone();
    for body in 0..B {
        let own = symmetric(|k| x[10 * body + k]);
        if (own - Matrix4::identity() * MARGIN).cholesky().is_some() {
            continue;
        }
        let mut eigen = own.symmetric_eigen();
        if eigen.eigenvalues.min() >= MARGIN {
            continue;
        }
        eigen.eigenvalues.apply(|value| *value = value.max(MARGIN));
        let clipped = numbers(&eigen.recompose());
        nearest.rows_mut(10 * body, 10).copy_from_slice(&clipped);
    }
    for (k, value) in nearest.iter_mut().enumerate().skip(10 * B) {
        if !FREE.contains(&((k - 10 * B) % OF_JOINT)) {
            *value = value.max(MARGIN);
        }
    }
    nearest
}
