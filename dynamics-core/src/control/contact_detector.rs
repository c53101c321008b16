//! Contacts: external torques beyond thresholds that follow the stated errors of the model.
//!
//! The observer filters the error of the model as it filters the torque of a contact, by a filter whose response is nowhere
//! negative. With the same filter for a bound e of that error, |r| stays within the filtered e as long as the stated errors hold:
//!
//! ```text
//! threshold = margin + filtered e
//! ```

use super::{ConfigError, ConfigParameter, Fault, MomentumObserver, ObserverConfig};
use crate::scalar::Real;
use crate::state::entry;

/// The joint and the torque of a contact that a [`ContactDetector`] has found.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct DetectedContact<R> {
    /// The outermost joint beyond its threshold. The contact is at its link, or further out where its force has no torque
    /// about the outer joints.
    pub joint: usize,
    /// The external torque of that joint, N·m or N.
    pub torque: R,
}

/// A detector of contacts of an arm without force sensors.
///
/// The margin is for what is not an error of the model: the noise of the encoders. If that noise is Gaussian with the
/// standard deviation σ in r, a margin of 4.9 σ is exceeded in one of 10⁶ ticks of each joint, one of 4.3 σ in 17.
///
/// ```
/// use dynamics_core::control::{ContactDetector, ObserverConfig};
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

    /// A tick with a measurement: p and β as for [`MomentumObserver::update`], and for each joint a bound of the model's error,
    /// N·m or N, such as 3 % of the torques of the rigid bodies, those of their accelerations included, and 10 % of those of
    /// friction.
    ///
    /// # Errors
    /// [`Fault::NotFinite`] names the first joint with a number that is not finite; the measurement then counts as lost.
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
                let mut input = R::from_f64(0.5) * mean;
                for bound in &mut self.bounds {
                    if let Some(bound) = bound.get_mut(i) {
                        *bound += share * (input - *bound);
                        input = *bound;
                    }
                }
            }
        }
        self.errors = *errors;
        let joint = self.observer.outermost(&self.threshold());
        Ok(joint.map(|joint| DetectedContact {
            joint,
            torque: entry(self.observer.external_torque(), joint),
        }))
    }

    /// The torques of the drives until the next tick, as [`MomentumObserver::drive`].
    #[inline]
    pub fn drive(&mut self, tau: &[R; V]) {
        self.observer.drive(tau);
    }

    /// The external torques of the joints, N·m or N.
    pub fn external_torque(&self) -> &[R; V] {
        self.observer.external_torque()
    }

    /// The thresholds of the joints, N·m or N.
    #[inline]
    pub fn threshold(&self) -> [R; V] {
        let [.., bound] = self.bounds.as_slice() else {
            return self.margin;
        };
        core::array::from_fn(|i| entry(&self.margin, i) + entry(bound, i))
    }

    /// Forgets what was measured, as [`MomentumObserver::restart`].
    pub fn restart(&mut self) {
        self.observer.restart();
        self.bounds = [[R::ZERO; V]; ORDER];
    }
}
