//! The wrench at a body from the external torques of the joints, by least squares.
//!
//! With τ = Jᵀ f, noise of the standard deviations σ_j in τ, and a wrench of the expected size s,
//! the most probable x = f / s:
//!
//! ```text
//! (Σ_j c_j c_jᵀ + 1) x = Σ_j c_j τ_j / σ_j        c_j = s (J e_j) / σ_j
//! ```
//!
//! The matrix is positive definite at singular postures too: a wrench without a torque about any
//! joint is estimated as zero.

use crate::limits::{ConfigError, ConfigParameter, Fault};
use dynamics_core::algorithms::shifted_solution;
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::{Force, Motion};
use dynamics_core::state::all_finite;

#[cfg(test)]
mod tests;

/// The roundings of the trace that the matrix is shifted by.
const ROUNDINGS: f64 = 2.0;

/// The sizes of the wrenches at a tip, and of the noise in the external torques: for
/// [`TipWrench::try_new`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipWrenchConfig<R, const V: usize> {
    /// The standard deviation of the noise in the external torque of each joint, N·m or N, from
    /// 10⁻⁶ to 10⁶.
    pub noise: [R; V],
    /// The largest force that is expected, N: far beyond noise / lever, the estimate does not
    /// depend on it.
    pub force: R,
    /// The largest couple that is expected, N·m; zero for a contact at one point, which exerts
    /// none.
    pub couple: R,
}

/// An estimator of the wrench at a body from the external torques of V joints.
///
/// ```
/// use motion_control::estimate::{TipWrench, TipWrenchConfig};
/// use dynamics_core::{Engine, algorithms::frame::LocalWorldAligned, robots::Ur5e, spatial::Force};
/// use dynamics_core::model::{OnBody, Robot};
/// use dynamics_core::glam::DVec3;
/// const TIP: usize = Ur5e::MODEL.body("wrist_3");
/// let at_a_point = TipWrench::try_new(TipWrenchConfig { noise: [0.1; 6], force: 100.0, couple: 0.0 })?;
/// let jacobian = Engine::<Ur5e>::jacobian(&[0.0_f64, -1.2, 1.5, 0.3, 0.7, 0.0], OnBody::<TIP>, LocalWorldAligned);
/// let push = Force::new(DVec3::ZERO, DVec3::new(10.0, 0.0, -20.0));
/// let external = jacobian.map(|column| column.dot(push));
/// let found = at_a_point.estimate(&jacobian, &external)?;
/// assert!((found.lin - push.lin).length() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "external wrench")]
#[doc(alias = "external force")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipWrench<R, const V: usize> {
    /// 1/σ of each joint.
    weights: [R; V],
    force: R,
    couple: R,
}

impl<R: Real, const V: usize> TipWrench<R, V> {
    /// An estimator of wrenches of these sizes.
    ///
    /// # Errors
    /// [`ConfigError::OutOfRange`] names a number that is beyond its range or not finite.
    ///
    /// ```
    /// use motion_control::estimate::{TipWrench, TipWrenchConfig};
    /// use motion_control::limits::{ConfigError, ConfigParameter};
    /// let error = TipWrench::try_new(TipWrenchConfig { noise: [0.1_f32, 0.0], force: 100.0, couple: 0.0 });
    /// assert_eq!(error, Err(ConfigError::OutOfRange { parameter: ConfigParameter::TorqueNoise }));
    /// ```
    pub fn try_new(config: TipWrenchConfig<R, V>) -> Result<Self, ConfigError> {
        let TipWrenchConfig { noise, force, couple } = config;
        let (least, most) = (R::from_f64(1e-6), R::from_f64(1e6));
        for sigma in noise {
            ConfigParameter::TorqueNoise.require((sigma >= least) & (sigma <= most))?;
        }
        ConfigParameter::WrenchSize.positive(force)?;
        ConfigParameter::WrenchSize.require((couple >= R::ZERO) & couple.is_finite())?;
        Ok(Self { weights: noise.map(|sigma| R::ONE / sigma), force, couple })
    }

    /// The wrench fˣ that a body's surroundings exert on it, N·m and N, in the frame and about the
    /// point of its `jacobian`.
    ///
    /// `external` are the torques of a [`MomentumObserver`](crate::estimate::MomentumObserver). For
    /// an arm of fewer than six joints, and at a singular posture, it is the smallest wrench that
    /// explains them.
    ///
    /// # Cost
    /// Constant work: 60 flops a joint, some 200 more and 6 divisions.
    ///
    /// # Errors
    /// [`Fault::NotFinite`] names the first joint with a number that is not finite, or joint 0 if
    /// products of finite numbers overflow.
    ///
    /// # Source
    /// Haddadin, De Luca & Albu-Schäffer, "Robot collisions: a survey" (2017), section VI.
    #[inline]
    pub fn estimate(
        &self,
        jacobian: &[Motion<R>; V],
        external: &[R; V],
    ) -> Result<Force<R>, Fault> {
        let mut scaled = [[R::ZERO; 6]; V];
        let mut b = [R::ZERO; 6];
        let joints = jacobian.iter().zip(external).zip(&self.weights);
        for (c, ((column, tau), weight)) in scaled.iter_mut().zip(joints) {
            let [ang, lin] = [(column.ang, self.couple), (column.lin, self.force)]
                .map(|(axis, size)| (axis * (size * *weight)).array());
            *c = [ang[0], ang[1], ang[2], lin[0], lin[1], lin[2]];
            b.iter_mut().zip(c).for_each(|(sum, c)| *sum += *c * (*tau * *weight));
        }
        let a = squares(scaled.into_iter().map(Some));
        // Eigenvalues below the roundings of the largest are not known: a shift of that size keeps
        // them from growing.
        let trace = (0..6).fold(R::ZERO, |sum, i| sum + a[i][i]);
        let shift = R::ONE + trace * (R::EPSILON * R::from_f64(ROUNDINGS));
        let x = shifted_solution(a, [shift; 6], b);
        if !(all_finite(&x) & shift.is_finite()) {
            let joint = first_not_finite(jacobian, external).unwrap_or(0);
            return Err(Fault::NotFinite { joint });
        }
        let [nx, ny, nz, fx, fy, fz] = x;
        Ok(Force::new(
            R::Vec3::new(nx, ny, nz) * self.couple,
            R::Vec3::new(fx, fy, fz) * self.force,
        ))
    }
}

/// The upper triangle of Σ c cᵀ, of one column or more.
#[inline(always)]
pub(crate) fn squares<R: Real>(columns: impl Iterator<Item = Option<[R; 6]>>) -> [[R; 6]; 6] {
    let mut sums = [[R::ZERO; 6]; 6];
    for (k, c) in columns.enumerate() {
        if k == 0 {
            let c = c.unwrap_or([R::ZERO; 6]);
            sums = core::array::from_fn(|i| core::array::from_fn(|j| c[i] * c[j]));
        } else if let Some(c) = c {
            for i in 0..6 {
                for j in i..6 {
                    sums[i][j] += c[i] * c[j];
                }
            }
        }
    }
    sums
}

/// The first joint with a number that is not finite.
fn first_not_finite<R: Real, const V: usize>(
    jacobian: &[Motion<R>; V],
    external: &[R; V],
) -> Option<usize> {
    let mut joints = jacobian.iter().zip(external);
    joints.position(|(column, tau)| {
        let axes = [column.ang, column.lin].map(Vector::array);
        !(tau.is_finite() && all_finite(axes.as_flattened()))
    })
}
