//! The wrench at a body from the external torques of the joints, by least squares.
//!
//! With τ = Jᵀ f, noise of the standard deviations σ_j in τ, and a wrench of the expected size s, the most probable x = f / s:
//!
//! ```text
//! (Σ_j c_j c_jᵀ + 1) x = Σ_j c_j τ_j / σ_j        c_j = s (J e_j) / σ_j
//! ```
//!
//! The matrix is positive definite at singular postures too: a wrench without a torque about any joint is estimated as zero.

use super::Fault;
use crate::algorithms::shifted_solution;
use crate::scalar::{Real, Vector};
use crate::spatial::{Force, Motion};
use crate::state::{all_finite, entry};

/// The sizes of the wrenches at a tip, and of the noise in the external torques from which they are estimated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipWrench<R, const V: usize> {
    /// The standard deviation of the noise in the external torque of each joint, N·m or N; not zero.
    pub noise: [R; V],
    /// The largest force that is expected, N: far beyond noise / lever, the estimate does not depend on it.
    pub force: R,
    /// The largest couple that is expected, N·m; zero for a contact at one point, which exerts none.
    pub couple: R,
}

impl<R: Real, const V: usize> TipWrench<R, V> {
    /// The wrench fˣ that a body's surroundings exert on it, N·m and N, in the frame and about the point of its `jacobian`.
    ///
    /// `external` are the torques of a [`MomentumObserver`](super::MomentumObserver). Of an arm of fewer than six joints, and
    /// at a singular posture, it is the smallest wrench that explains them.
    ///
    /// # Cost
    /// Constant work: 60 flops a joint, some 300 more and 6 divisions.
    ///
    /// # Errors
    /// [`Fault::NotFinite`] names the first joint with a number that is not finite, or joint 0 if their products overflow.
    ///
    /// # Source
    /// Haddadin, De Luca & Albu-Schäffer, "Robot collisions: a survey" (2017), section VI.
    ///
    /// ```
    /// use dynamics_core::{control::TipWrench, Engine, model::Robot, robots::Ur5e, spatial::Force};
    /// use glam::DVec3;
    /// const TIP: usize = Ur5e::MODEL.body("wrist_3");
    /// let jacobian = Engine::<Ur5e>::jacobian::<TIP, f64, _, _, _>(&[0.0, -1.2, 1.5, 0.3, 0.7, 0.0]);
    /// let push = Force::new(DVec3::ZERO, DVec3::new(10.0, 0.0, -20.0));
    /// let external = jacobian.map(|column| column.dot(push));
    /// let at_a_point = TipWrench { noise: [0.1; 6], force: 100.0, couple: 0.0 };
    /// let found = at_a_point.estimate(&jacobian, &external)?;
    /// assert!((found.lin - push.lin).length() < 0.01);
    /// # Ok::<(), dynamics_core::control::Fault>(())
    /// ```
    #[doc(alias = "external wrench")]
    #[doc(alias = "external force")]
    #[inline]
    pub fn estimate(
        &self,
        jacobian: &[Motion<R>; V],
        external: &[R; V],
    ) -> Result<Force<R>, Fault> {
        let (mut a, mut b) = ([[R::ZERO; 6]; 6], [R::ZERO; 6]);
        for (joint, (column, noise)) in jacobian.iter().zip(&self.noise).enumerate() {
            let tau = entry(external, joint);
            let share = R::ONE / *noise;
            let columns = [(column.ang, self.couple), (column.lin, self.force)];
            let scaled = columns.map(|(axis, size)| (axis * (size * share)).array());
            let scaled = scaled.as_flattened();
            let sum = scaled.iter().fold(tau * share, |sum, x| sum + *x);
            if !sum.is_finite() {
                return Err(Fault::NotFinite { joint });
            }
            for (i, (row, b)) in a.iter_mut().zip(&mut b).enumerate() {
                let x = entry(scaled, i);
                *b += x * (tau * share);
                for (entry, y) in row.iter_mut().zip(scaled).skip(i) {
                    *entry += x * *y;
                }
            }
        }
        let x = shifted_solution(&a, R::ONE, &b);
        if !all_finite(&x) {
            return Err(Fault::NotFinite { joint: 0 });
        }
        let [nx, ny, nz, fx, fy, fz] = x;
        let wrench = Force::new(
            R::Vec3::new(nx, ny, nz) * self.couple,
            R::Vec3::new(fx, fy, fz) * self.force,
        );
        Ok(wrench)
    }
}
