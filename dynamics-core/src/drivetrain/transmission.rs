//! Coupled joints: motors that drive them through a constant matrix of gears, belts or cables.

use crate::algorithms::MassMatrix;
use crate::scalar::Real;
use crate::state::State;

/// A constant coupling q = G u + q₀ of V joints and M motors; u in rad or m at the motors.
///
/// ```text
/// q = G u + q₀      τ_u = Gᵀ τ      M_u = Gᵀ M G
/// ```
///
/// A mimic joint (a gripper's second finger) is a row that repeats another; a differential wrist is
/// a block of sums and differences. The power of the motors is that of the joints (Featherstone,
/// RBDA, section 3.5: G is the null space of the implicit constraint). For joints of one degree of
/// freedom. Cost: 2 M V flops per vector.
///
/// ```
/// use dynamics_core::drivetrain::Transmission;
/// // A differential wrist: both motors together pitch, against each other they roll.
/// let wrist = Transmission { matrix: [[0.5, 0.5], [0.5, -0.5]], offset: [0.0; 2] };
/// assert_eq!(wrist.position(&[1.0, 1.0]), [1.0, 0.0]);
/// assert_eq!(wrist.torque(&[2.0, 0.0]), [1.0, 1.0]); // each carries half of the pitch
/// // A gripper: one motor, two fingers.
/// let gripper = Transmission { matrix: [[0.01], [-0.01]], offset: [0.0; 2] };
/// assert_eq!(gripper.rate(&[3.0]), [0.03, -0.03]);
/// ```
///
/// A transmission of another robot's size does not compile:
///
/// ```compile_fail,E0308
/// use dynamics_core::drivetrain::Transmission;
/// let wrist = Transmission { matrix: [[0.5, 0.5], [0.5, -0.5]], offset: [0.0; 3] };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transmission<R, const M: usize, const V: usize> {
    /// G, a row for each joint.
    pub matrix: [[R; M]; V],
    /// q₀, rad or m.
    pub offset: [R; V],
}

impl<R: Real, const M: usize, const V: usize> Transmission<R, M, V> {
    /// q = G u + q₀, rad or m.
    pub fn position(&self, u: &[R; M]) -> [R; V] {
        let mut q = self.rate(u);
        for (q, &offset) in q.iter_mut().zip(&self.offset) {
            *q += offset;
        }
        q
    }

    /// G u̇, and G ü: joint rates of motor rates.
    pub fn rate(&self, u: &[R; M]) -> [R; V] {
        self.matrix.map(|row| dot(&row, u))
    }

    /// τ_u = Gᵀ τ: what the motors must supply for the joints' torques.
    pub fn torque(&self, tau: &[R; V]) -> [R; M] {
        core::array::from_fn(|m| {
            let terms = self.matrix.iter().zip(tau);
            terms.fold(R::ZERO, |sum, (row, &tau)| sum + row[m] * tau)
        })
    }

    /// The joints' state of the motors'.
    pub fn state(&self, u: &State<R, M, M>) -> State<R, V, V> {
        State { q: self.position(&u.q), qd: self.rate(&u.qd), qdd: self.rate(&u.qdd) }
    }

    /// Gᵀ M G: the inertia reflected to the motors, without their own.
    pub fn inertia(&self, m: &MassMatrix<R, V>) -> MassMatrix<R, M> {
        let columns: [[R; V]; M] = core::array::from_fn(|j| {
            let column = self.matrix.map(|row| row[j]);
            core::array::from_fn(|i| (0..V).fold(R::ZERO, |sum, k| sum + m.get(i, k) * column[k]))
        });
        MassMatrix { rows: columns.map(|column| self.torque(&column)) }
    }
}

fn dot<R: Real, const N: usize>(a: &[R; N], b: &[R; N]) -> R {
    a.iter().zip(b).fold(R::ZERO, |sum, (&a, &b)| sum + a * b)
}
