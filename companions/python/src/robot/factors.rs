//! The factors of the inertia matrix, and solutions by these.

use super::{Robot, without_rotors};
use crate::methods::methods;

methods! {
    Robot, robot => (v, nq, bodies) = (robot.counts.v, robot.counts.q, robot.counts.bodies);

    /// M(q) (…, nv, nv), kg·m² or kg, and J (…, 6, nv) of a body in its own frame, angular rows
    /// first, at once; q (…, nq).
    crba_jacobian(q: q; at body; under effects) = several(CrbaJacobian { body }): [v, v], [6, v];

    /// The factors of M = Lᵀ D L: L (…, nv, nv), lower triangular with a unit diagonal, and the
    /// reciprocals of D (…, nv), 1/(kg·m²) or 1/kg; M (…, nv, nv), kg·m² or kg, of which the
    /// entries up to the diagonal are read. L is zero wherever M is: of two coordinates on
    /// different branches.
    ///
    /// Raises NotPositiveDefinite with the joint that moves no inertia.
    ltdl(m: matrix) = several(LtdlOf): [v, v], [v];

    /// x (…, nv) with M x = τ, rad/s² or m/s², by the factors of `ltdl`: L (…, nv, nv), the
    /// reciprocals of D and τ (…, nv), N·m or N.
    solve(l: matrix, d_inv: v, tau: v) = one(Solve): [v];

    /// M⁻¹ (…, nv, nv), 1/(kg·m²) or 1/kg, by the factors of `ltdl`: L (…, nv, nv) and the
    /// reciprocals of D (…, nv).
    inverse(l: matrix, d_inv: v) = one(Inverse): [v, v];

    /// The factor of M = Lᵀ L: L (…, nv, nv), lower triangular, √kg·m or √kg, and the reciprocals
    /// of its diagonal (…, nv); M (…, nv, nv), kg·m² or kg, of which the entries up to the diagonal
    /// are read.
    ///
    /// Raises NotPositiveDefinite with the joint that moves no inertia.
    cholesky(m: matrix) = several(CholeskyOf): [v, v], [v];

    /// x (…, nv) with M x = τ, rad/s² or m/s², by the factor of `cholesky`: L (…, nv, nv), the
    /// reciprocals of its diagonal and τ (…, nv), N·m or N.
    cholesky_solve(l: matrix, l_inv: v, tau: v) = one(CholeskySolve): [v];

    /// The factors of `ltdl` without M, by the spatial operators of articulated bodies: L (…, nv,
    /// nv) and the reciprocals of D (…, nv), 1/(kg·m²) or 1/kg; q (…, nq).
    spatial_operator_ltdl(q: q; under effects without_rotors) = several(SpatialOperatorLtdl): [v, v], [v];

    /// M(q)⁻¹ (…, nv, nv), 1/(kg·m²) or 1/kg, without M, by the spatial operators of articulated
    /// bodies; q (…, nq).
    spatial_operator_inverse(q: q; under effects without_rotors) = one(SpatialOperatorInverse): [v, v];

    /// M(q)⁻¹ (…, nv, nv); q (…, nq).
    inverse_mass(q: q; under effects) = one(InverseMass): [v, v];

    /// The estimated error (…, nv), rad/s² or m/s², that rounding leaves in a solution q̈ (…, nv)
    /// of M q̈ = b: M (…, nv, nv), L and the reciprocals of D of `ltdl`, q̈, and the sums of the
    /// magnitudes of the terms of b (…, nv), N·m or N.
    acceleration_error(m: matrix, l: matrix, d_inv: v, qdd: v, terms: v) = one(AccelerationError): [v];
}
