//! Joint compliance: motors that drive their links through springs.
//!
//! Spong, "Modeling and control of elastic joint robots" (1987), equations (12), (13). The kinetic
//! energy of a rotor is that of its rotation about its own axis only (his assumption of high gear
//! ratios). For joints of one degree of freedom.

/// The transmissions and motors of V joints, reflected to the joint.
///
/// ```text
/// M(q) q̈ + C(q, q̇)      = k (θ − q)
/// J θ̈ + b θ̇ + k (θ − q) = τ_m
/// ```
///
/// with the motors' angles θ reflected to the joints: Spong (1987), equations (12), (13).
///
/// ```
/// use dynamics_core::drivetrain::ElasticJoints;
/// // A harmonic drive of 100 and a rotor of 1e-4 kg·m²
/// let joints = ElasticJoints { stiffness: [1e4_f32; 6], rotor: [1.0; 6], friction: [5.0; 6] };
/// assert_eq!(joints.rotor[0], 100.0 * 100.0 * 1e-4);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticJoints<R, const V: usize> {
    /// Stiffness k of each transmission, N·m/rad or N/m.
    pub stiffness: [R; V],
    /// Inertia J of each rotor, reflected: ρ² I, kg·m² or kg.
    pub rotor: [R; V],
    /// Viscous friction b of each motor, reflected, N·m·s/rad or N·s/m.
    pub friction: [R; V],
}

/// Angles of the motors, reflected to the joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorState<R, const V: usize> {
    /// θ, rad or m.
    pub position: [R; V],
    /// θ̇, rad/s or m/s.
    pub velocity: [R; V],
}
