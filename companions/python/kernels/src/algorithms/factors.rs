//! M, its factors, and solutions by these.

use dynamics_core::algorithms::{self, Cholesky, Ltdl, MassMatrix, jacobian_rows};
use dynamics_core::model::RobotModel;
use dynamics_core::scalar::Real;

use super::*;

/// A matrix of a row of numbers, with ones on the diagonal beyond the robot's.
#[inline(always)]
fn matrix<R: Real, const V: usize>(row: &impl Row<R>, input: usize, counts: Counts) -> [[R; V]; V] {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| match i.max(j) < counts.v {
            true => row.get(input, i * counts.v + j),
            false if i == j => R::ONE,
            false => R::ZERO,
        })
    })
}

/// The reciprocals of a diagonal, with ones beyond the robot's.
#[inline(always)]
fn diagonal<R: Real, const V: usize>(row: &impl Row<R>, input: usize, counts: Counts) -> [R; V] {
    let mut values = filled(row, input, counts.v);
    values[counts.v..].fill(R::ONE);
    values
}

#[inline(always)]
fn put_ltdl<R: Real, const V: usize>(row: &mut impl Row<R>, factors: &Ltdl<R, V>, counts: Counts) {
    for i in 0..counts.v {
        for j in 0..counts.v {
            row.put(0, i * counts.v + j, factors.get(i, j));
        }
    }
    put(row, 1, 0, &factors.d_inv()[..counts.v]);
}

algorithm! {
    /// L and D⁻¹ of M.
    LtdlOf, none, |this, robot, counts, scene, row| {
        let m = MassMatrix::from_rows(matrix(row, 0, counts));
        put_ltdl(row, &algorithms::ltdl(robot, &m)?, counts);
    }
}

algorithm! {
    /// x of L, D⁻¹ and τ.
    Solve, none, |this, robot, counts, scene, row| {
        let factors = Ltdl::from_rows(matrix(row, 0, counts), diagonal(row, 1, counts));
        let x = algorithms::solve(robot, &factors, &filled(row, 2, counts.v));
        put(row, 0, 0, &x[..counts.v]);
    }
}

algorithm! {
    /// M⁻¹ of L and D⁻¹.
    Inverse, none, |this, robot, counts, scene, row| {
        let factors = Ltdl::from_rows(matrix(row, 0, counts), diagonal(row, 1, counts));
        put_inverse(robot, &factors, (row, 0), counts);
    }
}

algorithm! {
    /// L and the reciprocals of its diagonal, M = Lᵀ L.
    CholeskyOf, none, |this, robot, counts, scene, row| {
        let m = MassMatrix::from_rows(matrix(row, 0, counts));
        let factor = algorithms::cholesky(robot, &m)?;
        for i in 0..counts.v {
            for j in 0..counts.v {
                let l = if i == j { R::ONE / factor.l_inv()[i] } else { factor.get(i, j) };
                row.put(0, i * counts.v + j, l);
            }
        }
        put(row, 1, 0, &factor.l_inv()[..counts.v]);
    }
}

algorithm! {
    /// x of L, the reciprocals of its diagonal, and τ.
    CholeskySolve, none, |this, robot, counts, scene, row| {
        let factor = Cholesky::from_rows(matrix(row, 0, counts), diagonal(row, 1, counts));
        let x = factor.solve(robot, &filled(row, 2, counts.v));
        put(row, 0, 0, &x[..counts.v]);
    }
}

algorithm! {
    /// L and D⁻¹ of q, without M.
    SpatialOperatorLtdl, machine, |this, robot, counts, scene, row| {
        let q = filled::<R, Q>(row, 0, counts.q);
        put_ltdl(row, &algorithms::spatial_operator_ltdl(robot, &q, scene)?, counts);
    }
}

algorithm! {
    /// M⁻¹ of q, without M.
    SpatialOperatorInverse, machine, |this, robot, counts, scene, row| {
        let q = filled::<R, Q>(row, 0, counts.q);
        let m_inv = algorithms::spatial_operator_inverse(robot, &q, scene)?;
        put_matrix(row, 0, &m_inv, counts.v);
    }
}

algorithm! {
    /// The inverse M(q)⁻¹ of the inertia matrix.
    InverseMass, factored, |this, robot, counts, scene, row| {
        let q = filled::<R, Q>(row, 0, counts.q);
        let factors = factors::<R, D, B, Q, V, X>(robot, &q, parts_of(scene), counts)?;
        put_inverse(robot, &factors, (row, 0), counts);
    }
}

/// The columns of M⁻¹ of the robot's own coordinates.
#[inline(always)]
pub(super) fn put_inverse<R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    factors: &Ltdl<R, V>,
    (row, output): (&mut impl Row<R>, usize),
    counts: Counts,
) where
    D: RobotModel<R, B, Q, V>,
{
    for j in 0..counts.v {
        let mut unit = [R::ZERO; V];
        unit[j] = R::ONE;
        let column = algorithms::solve(robot, factors, &unit);
        for (i, &x) in column.iter().enumerate().take(counts.v).skip(j) {
            row.put(output, i * counts.v + j, x);
            row.put(output, j * counts.v + i, x);
        }
    }
}

algorithm! {
    /// M, and J of a body along its own axes.
    CrbaJacobian { body: usize }, rigid, |this, robot, counts, scene, row| {
        let q = filled::<R, Q>(row, 0, counts.q);
        let (m, columns) = algorithms::crba_jacobian(robot, &q, this.body, scene);
        put_matrix(row, 0, &m, counts.v);
        put_rows(row, 1, &jacobian_rows(&columns), counts.v);
    }
}

algorithm! {
    /// q̈ of q, q̇ and τ, and the error that rounding leaves in it.
    ForwardWithError, estimated, |this, robot, counts, scene, row| {
        let (state, tau) = (state(row, counts, 2), filled(row, 2, counts.v));
        let parts = parts_of(scene);
        let bias = bias::<R, D, B, Q, V, C, X>(robot, &state, (parts, false));
        let mut rest = algorithms::transmitted_torque(robot, &state, &tau, scene);
        let mut terms = rest.map(R::abs);
        for ((rest, terms), bias) in rest.iter_mut().zip(&mut terms).zip(bias) {
            *rest -= bias;
            *terms += bias.abs();
        }
        let m = inertia::<R, D, B, Q, V, X>(robot, &state.q, parts);
        let m = m.plus_diagonal(&fillers(counts));
        let factors = algorithms::ltdl(robot, &m)?;
        let qdd = algorithms::solve(robot, &factors, &rest);
        let error = algorithms::acceleration_error(robot, (&m, &factors), &qdd, &terms);
        put(row, 0, 0, &qdd[..counts.v]);
        put(row, 1, 0, &error[..counts.v]);
    }
}

algorithm! {
    /// The error of a solution: of M, L, D⁻¹, the solution, and the sums of the magnitudes of the
    /// terms of τ.
    AccelerationError, none, |this, robot, counts, scene, row| {
        let m = MassMatrix::from_rows(matrix(row, 0, counts));
        let factors = Ltdl::from_rows(matrix(row, 1, counts), diagonal(row, 2, counts));
        let (qdd, terms) = (filled(row, 3, counts.v), filled(row, 4, counts.v));
        let error = algorithms::acceleration_error(robot, (&m, &factors), &qdd, &terms);
        put(row, 0, 0, &error[..counts.v]);
    }
}
