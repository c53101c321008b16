//! The methods for energy and momentum.

use super::{Robot, without_rotors};
use crate::methods::methods;

methods! {
    Robot, robot => (v, nq, bodies) = (robot.counts.v, robot.counts.q, robot.counts.bodies);

    /// The kinetic energy (…), J; q (…, nq), q̇ (…, nv).
    kinetic_energy(q: q, qd: v; under effects) = one(KineticEnergy): [];

    /// The potential energy in the field of gravity (…), J, zero at the base's origin; q (…, nq).
    potential_energy(q: q; under effects) = one(PotentialEnergy): [];

    /// The momentum of all bodies about the base's origin (…, 6): N·m·s, then N·s; q (…, nq), q̇
    /// (…, nv).
    momentum(q: q, qd: v; under effects) = one(Momentum): [6];

    /// The momentum of all bodies about their centre of mass (…, 6): N·m·s, then N·s; q (…, nq), q̇
    /// (…, nv).
    centroidal_momentum(q: q, qd: v; under effects) = one(CentroidalMomentum): [6];

    /// A(q) (…, 6, nv) with A q̇ the momentum about the centre of mass; q (…, nq).
    centroidal_matrix(q: q; under effects without_rotors) = one(CentroidalMatrix): [6, v];

    /// p = M q̇ and Cᵀ q̇, each (…, nv), for observers of external torques; q (…, nq), q̇ (…, nv).
    momentum_and_coriolis(q: q, qd: v; under effects) = several(MomentumAndCoriolis): [v], [v];

    /// p = M q̇ and β = Cᵀ q̇ − g − F, each (…, nv); q (…, nq), q̇ (…, nv).
    momentum_and_drift(q: q, qd: v; under effects) = several(MomentumAndDrift): [v], [v];

    /// q̇ (…, nv) with the rates of the free base for which the momentum of all bodies about the
    /// base's origin is h (…, 6); q (…, nq), q̇ (…, nv).
    base_velocity_from_momentum(q: q, qd: v, h: six; under effects) = one(BaseVelocity): [v];
}
