//! Contacts: external torques beyond thresholds that follow the stated errors of the model.
//!
//! The observer filters the error of the model as it filters the torque of a contact, by a filter
//! whose response is nowhere negative. With the same filter for a bound e of that error, |r| stays
//! within the filtered e as long as the stated errors hold:
//!
//! ```text
//! threshold = margin + filtered e
//! ```

use crate::entry;
use crate::estimate::momentum_observer::follow;
use crate::estimate::{MomentumObserver, ObserverConfig};
use crate::limits::{ConfigError, ConfigParameter, Fault};
use dynamics_core::scalar::Real;

#[cfg(test)]
mod tests;

/// The joint and the torque of a contact that a [`ContactDetector`] has found.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct DetectedContact<R> {
    /// The outermost joint beyond its threshold. The contact is at its link, or further out where
    /// its force has no torque about the outer joints.
    pub joint: usize,
    /// The external torque of that joint, N·m or N.
    pub torque: R,
}

/// A detector of contacts of an arm without force sensors.
///
/// The margin is for what is not an error of the model: the noise of the encoders. If that noise is
/// Gaussian with the standard deviation σ in r, a margin of 4.9 σ is exceeded in one of 10⁶ ticks
/// of each joint, one of 4.3 σ in 17.
///
/// ```
/// use motion_control::estimate::{ContactDetector, ObserverConfig};
/// let config = ObserverConfig { bandwidth: 50.0, tick: 1e-3 };
/// let mut detector: ContactDetector<f32, 1> = ContactDetector::try_new(config, [0.5])?;
/// let mut found = None;
/// for tick in 0..100 {
///     // The drive holds 10 N·m of gravity, which is modelled within 3 %. From tick 50 on, a contact adds 2 N·m.
///     let pushed = if tick > 50 { 2e-3 * (tick - 50) as f32 } else { 0.0 };
///     let contact = detector.update(&[pushed], &[-10.0], &[0.3])?;
///     found = found.or(contact.map(|contact| (tick, contact.joint)));
///     detector.drive(&[10.0]);
/// }
/// assert!(found.is_some_and(|(tick, joint)| joint == 0 && (51..65).contains(&tick)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias = "collision detection")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactDetector<R, const V: usize, const ORDER: usize = 1> {
    observer: MomentumObserver<R, V, ORDER>,
    margin: [R; V],
    errors: [R; V],
    bounds: [[R; V]; ORDER],
}

impl<R: Real, const V: usize, const ORDER: usize> ContactDetector<R, V, ORDER> {
    /// A detector without a contact, with the margin of each joint, N·m or N.
    ///
    /// # Errors
    /// [`ConfigError`], as [`ObserverConfig::check`]; also if a margin is not positive.
    pub fn try_new(config: ObserverConfig<R>, margin: [R; V]) -> Result<Self, ConfigError> {
        for margin in margin {
            ConfigParameter::ContactMargin.positive(margin)?;
        }
        Ok(Self {
            observer: MomentumObserver::try_new(config)?,
            margin,
            errors: [R::ZERO; V],
            bounds: [[R::ZERO; V]; ORDER],
        })
    }

    /// A tick with a measurement: p and β as for [`MomentumObserver::update`], and for each joint a
    /// bound of the model's error, N·m or N, such as 3 % of the torques of the rigid bodies, those
    /// of their accelerations included, and 10 % of those of friction.
    ///
    /// ```
    /// use motion_control::estimate::{ContactDetector, ObserverConfig};
    /// use motion_control::limits::Fault;
    /// let config = ObserverConfig { bandwidth: 50.0, tick: 1e-3 };
    /// let mut detector: ContactDetector<f32, 2> = ContactDetector::try_new(config, [0.5; 2])?;
    /// assert_eq!(detector.update(&[0.0; 2], &[-10.0, 2.0], &[0.3, 0.1]), Ok(None));
    /// let lost = detector.update(&[0.0; 2], &[-10.0, f32::NAN], &[0.3, 0.1]);
    /// assert_eq!(lost, Err(Fault::NotFinite { joint: 1 }));
    /// # Ok::<(), motion_control::limits::ConfigError>(())
    /// ```
    ///
    /// # Errors
    /// [`Fault::NotFinite`] names the first joint with a number that is not finite; the measurement
    /// then counts as lost.
    #[inline]
    pub fn update(
        &mut self,
        p: &[R; V],
        beta: &[R; V],
        errors: &[R; V],
    ) -> Result<Option<DetectedContact<R>>, Fault> {
        if let Some(joint) = errors.iter().position(|error| !error.is_finite()) {
            return Err(Fault::NotFinite { joint });
        }
        let share = self.observer.share();
        self.observer.update(p, beta)?;
        if let Some(share) = share {
            for i in 0..V {
                let mean = entry(errors, i).abs() + entry(&self.errors, i).abs();
                follow(&mut self.bounds, i, share, R::from_f64(0.5) * mean);
            }
        }
        self.errors = *errors;
        let joint = self.observer.outermost(&self.threshold());
        Ok(joint.map(|joint| DetectedContact {
            joint,
            torque: entry(self.observer.external_torque(), joint),
        }))
    }

    /// The torques of the drives until the next tick, N·m or N, as [`MomentumObserver::drive`].
    ///
    /// ```
    /// use motion_control::estimate::{ContactDetector, ObserverConfig};
    /// let config = ObserverConfig { bandwidth: 50.0, tick: 1e-3 };
    /// let mut detector: ContactDetector<f32, 1> = ContactDetector::try_new(config, [0.5])?;
    /// for _ in 0..200 {
    ///     detector.update(&[0.0], &[-10.0], &[0.3])?;
    ///     detector.drive(&[9.8]); // 0.2 N·m less than gravity, and the arm stands still
    /// }
    /// assert!((detector.external_torque()[0] - 0.2).abs() < 1e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline]
    pub fn drive(&mut self, tau: &[R; V]) {
        self.observer.drive(tau);
    }

    /// The external torques of the joints, N·m or N.
    pub fn external_torque(&self) -> &[R; V] {
        self.observer.external_torque()
    }

    /// The thresholds of the joints, N·m or N: the margin and the filtered bound of the model's
    /// error.
    ///
    /// ```
    /// use motion_control::estimate::{ContactDetector, ObserverConfig};
    /// let config = ObserverConfig { bandwidth: 50.0, tick: 1e-3 };
    /// let mut detector: ContactDetector<f32, 1> = ContactDetector::try_new(config, [0.5])?;
    /// assert_eq!(detector.threshold(), [0.5]);
    /// for _ in 0..200 {
    ///     detector.update(&[0.0], &[-10.0], &[0.3])?;
    ///     detector.drive(&[10.0]);
    /// }
    /// assert!((detector.threshold()[0] - 0.8).abs() < 1e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline]
    pub fn threshold(&self) -> [R; V] {
        let [.., bound] = self.bounds.as_slice() else {
            return self.margin;
        };
        core::array::from_fn(|i| entry(&self.margin, i) + entry(bound, i))
    }

    /// Forgets what was measured, as [`MomentumObserver::restart`].
    ///
    /// ```
    /// # use motion_control::estimate::{ContactDetector, ObserverConfig};
    /// # let config = ObserverConfig { bandwidth: 50.0, tick: 1e-3 };
    /// let mut detector: ContactDetector<f32, 1> = ContactDetector::try_new(config, [0.5])?;
    /// for _ in 0..2 {
    ///     detector.update(&[0.0], &[-10.0], &[0.3])?;
    ///     detector.drive(&[4.0]);
    /// }
    /// detector.restart();
    /// assert_eq!((detector.external_torque(), detector.threshold()), (&[0.0], [0.5]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn restart(&mut self) {
        self.observer.restart();
        self.bounds = [[R::ZERO; V]; ORDER];
    }
}
