//! The change from one law to another without a step of the torque.
//!
//! The difference δ of the two laws' torques in the tick of the change is added to the new law, and
//! goes to zero along a line: τ = τ_new + δ (1 − k/n) in the k-th tick after the change.

use crate::limits::{ConfigError, ConfigParameter};
use crate::real;
use dynamics_core::scalar::Real;

/// The difference between the torques of the last law and those of the present one.
///
/// Every torque of the laws passes through [`Self::torque`]; [`Self::begin`] announces that the
/// next one is another law's, such as that of a motion after
/// [`HandGuiding`](crate::law::HandGuiding). The torque then goes on from its last value, and the
/// difference δ decreases by δ/n in each of n ticks, whatever the laws do.
///
/// ```
/// use motion_control::law::HandOver;
/// let mut hand_over = HandOver::<f64, 1>::try_new(4)?;
/// assert_eq!(hand_over.torque(&[6.0]), [6.0]); // guided
/// hand_over.begin();
/// let torques = [(); 6].map(|()| hand_over.torque(&[2.0])[0]); // held
/// assert_eq!(torques, [6.0, 5.0, 4.0, 3.0, 2.0, 2.0]);
/// # Ok::<(), motion_control::limits::ConfigError>(())
/// ```
#[doc(alias = "bumpless transfer")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HandOver<R, const V: usize> {
    ticks: u32,
    /// Ticks until the difference is zero; one more in the tick of the change.
    left: u32,
    difference: [R; V],
    /// The last finite torques.
    last: [R; V],
}

impl<R: Real, const V: usize> HandOver<R, V> {
    /// A difference of zero; later ones take `ticks` to vanish.
    ///
    /// # Errors
    /// [`ConfigError::OutOfRange`] if there are no ticks.
    pub fn try_new(ticks: u32) -> Result<Self, ConfigError> {
        ConfigParameter::HandOverTicks.require(ticks > 0)?;
        Ok(Self { ticks, left: 0, difference: [R::ZERO; V], last: [R::ZERO; V] })
    }

    /// The next torque is that of another law.
    pub fn begin(&mut self) {
        self.left = self.ticks.saturating_add(1);
    }

    /// The torques of the present law with what is left of the difference, N·m or N.
    ///
    /// The difference is finite whatever the torques are. A torque that is not finite is returned
    /// as NaN or infinite, for the supervisor to reject it
    /// ([`Fault::Torque`](crate::limits::Fault::Torque)).
    ///
    /// # Cost
    /// By count: 3 flops a joint, and one division.
    #[must_use]
    pub fn torque(&mut self, tau: &[R; V]) -> [R; V] {
        let begins = self.left > self.ticks;
        let left = self.left.min(self.ticks);
        self.left = left.saturating_sub(1);
        let share = real::<R>(left) / real(self.ticks);
        let mut torque = *tau;
        let joints = self.difference.iter_mut().zip(&mut self.last);
        for (tau, (difference, last)) in torque.iter_mut().zip(joints) {
            if begins {
                let step = *last - *tau;
                *difference = R::either(step.is_finite(), step, R::ZERO);
            }
            *tau += share * *difference;
            *last = R::either(tau.is_finite(), *tau, *last);
        }
        torque
    }
}

#[cfg(test)]
mod tests {
    //! The line of the difference, begun anew, and numbers that are not finite.

    use super::*;
    use crate::tests::refused;

    #[test]
    fn a_change_within_a_change_goes_on_from_the_last_torque() {
        let mut hand_over = HandOver::<f64, 2>::try_new(4).expect("ticks");
        assert_eq!(hand_over.torque(&[8.0, -8.0]), [8.0, -8.0]);
        hand_over.begin();
        assert_eq!(hand_over.torque(&[0.0, 0.0]), [8.0, -8.0]);
        assert_eq!(hand_over.torque(&[0.0, 1.0]), [6.0, -5.0]);
        hand_over.begin();
        let torques = [(); 6].map(|()| hand_over.torque(&[2.0, -1.0]));
        assert_eq!(torques.map(|tau| tau[0]), [6.0, 5.0, 4.0, 3.0, 2.0, 2.0]);
        assert_eq!(torques.map(|tau| tau[1]), [-5.0, -4.0, -3.0, -2.0, -1.0, -1.0]);
        let none = refused(HandOver::<f64, 1>::try_new(0));
        assert_eq!(none, Some(ConfigParameter::HandOverTicks));
    }

    #[test]
    fn a_difference_is_finite_whatever_the_torques_are() {
        for bad in [f64::NAN, f64::INFINITY, f64::MAX] {
            for (before, after) in [(bad, 2.0), (2.0, bad), (bad, -bad)] {
                let mut hand_over = HandOver::<f64, 1>::try_new(3).expect("ticks");
                let _ = hand_over.torque(&[before]);
                hand_over.begin();
                // A torque that is none stays one, for the supervisor.
                let [tau] = hand_over.torque(&[after]);
                assert!(tau.is_finite() | !after.is_finite());
                let torques = [(); 5].map(|()| hand_over.torque(&[1.0])[0]);
                assert!(torques.iter().all(|tau| tau.is_finite()), "{before} {after}");
                assert_eq!(torques[3..], [1.0, 1.0]);
            }
        }
    }
}
