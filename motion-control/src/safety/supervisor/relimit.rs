//! Limits that change while the arm moves.

use super::{Ranges, Supervisor, step};
use crate::limits::{Circles, ConfigError, ConfigParameter, SafetyLimits, SafetyLimitsError};
use dynamics_core::scalar::Real;

impl<R: Real, const V: usize> Supervisor<R, V> {
    /// Replaces the limits; those of speed fall by `fall` in a tick of `tick` seconds. Whether they
    /// are there.
    ///
    /// A limit of torque that falls is reached at the rate of the torque; none rises above that of
    /// the configuration. The plausible step is that
    /// of the present limit of speed, and none where that was infinite. Circles may be in any turn.
    pub(crate) fn relimit(
        &mut self,
        limits: &SafetyLimits<R, V>,
        fall: R,
        tick: R,
        qd: &[R; V],
        circles: Circles,
    ) -> Result<bool, ConfigError> {
        limits.check()?;
        ConfigParameter::Deceleration.require(fall > R::ZERO)?;
        let Ranges { middle, half } = Ranges::of(limits);
        let ranges = middle.iter().zip(&half);
        let centres = Circles::centres(&middle, &half, &self.last_good);
        let q = circles.near(&self.last_good, &centres);
        let mut joints = q.iter().zip(ranges);
        let outside = |(q, (middle, half)): (&R, (&R, &R))| (*q - *middle).abs() > *half;
        if let (true, Some(joint)) = (self.known, joints.position(outside)) {
            let position = q.get(joint).map_or(0.0, |x| x.to_f64());
            return Err(SafetyLimitsError::Outside { joint, position }.into());
        }
        (self.middle, self.half) = (middle, half);
        self.limits_torque = Self::least(&limits.torque, &self.configured_torque);
        self.rate_limit = limits.rate;
        // Those of the motors, which are given in each tick, let a limit rise.
        self.torque_limit = match self.is_thermal {
            true => Self::least(&self.limits_torque, &self.torque_limit),
            false => self.limits_torque,
        };
        let mut there = true;
        let joints = self.speed_limit.iter_mut().zip(&mut self.plausible_step);
        for ((bound, plausible), (&goal, &qd)) in joints.zip(limits.speed.iter().zip(qd)) {
            // A bound that is infinite falls from twice the present speed on.
            let from = if bound.is_finite() { *bound } else { qd.abs() + qd.abs() };
            let next = from - fall;
            let next = if next > goal { next } else { goal };
            // An infinite step remains one: the resolution that it contains is lost in it.
            if plausible.is_finite() {
                *plausible += step(next, tick) - step(*bound, tick);
            }
            *bound = next;
            there &= *bound <= goal;
        }
        Ok(there)
    }
}
