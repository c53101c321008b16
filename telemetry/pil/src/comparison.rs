//! Two motions side by side, and the bounds of their difference.

use serde::Serialize;

use crate::motion::Motion;
use crate::{Error, JOINTS};

/// The most that a joint of the one may be from the other at any tick, mrad.
pub const DIFFERENCE: f64 = 0.6;
/// The most by which the RMS of a joint's tracking errors may differ, mrad.
pub const RMS: f64 = 0.01;

#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Joint {
    /// The RMS of its tracking errors with the robot outside, mrad.
    pub rms_outside_mrad: f64,
    /// The same with the robot inside, mrad.
    pub rms_inside_mrad: f64,
    /// The largest difference of its positions at the same tick, mrad.
    pub max_difference_mrad: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// Ticks of both.
    pub ticks: usize,
    pub joints: [Joint; JOINTS],
    /// The largest difference of a position that is allowed, mrad.
    pub difference_bound_mrad: f64,
    /// The largest difference of an RMS that is allowed, mrad.
    pub rms_bound_mrad: f64,
}

impl Comparison {
    /// Compares the motions with the robot outside and with the robot inside.
    #[must_use]
    pub fn of(outside: &Motion, inside: &Motion) -> Self {
        let pairs = || outside.estimates.iter().zip(&inside.estimates);
        let joints = core::array::from_fn(|joint| {
            let difference = pairs().map(|(a, b)| f64::from(a[joint]) - f64::from(b[joint]));
            let largest = difference.map(f64::abs).fold(0.0, larger);
            Joint {
                rms_outside_mrad: rms(outside, joint),
                rms_inside_mrad: rms(inside, joint),
                max_difference_mrad: 1e3 * largest,
            }
        });
        Self {
            ticks: pairs().count(),
            joints,
            difference_bound_mrad: DIFFERENCE,
            rms_bound_mrad: RMS,
        }
    }

    /// The largest difference of a position, mrad, and that of an RMS, mrad.
    #[must_use]
    pub fn largest(&self) -> (f64, f64) {
        let joints = self.joints.iter();
        let rms = |joint: &Joint| (joint.rms_outside_mrad - joint.rms_inside_mrad).abs();
        (
            joints
                .clone()
                .map(|joint| joint.max_difference_mrad)
                .fold(0.0, larger),
            joints.map(rms).fold(0.0, larger),
        )
    }

    /// Fails if the motions differ by more than stated.
    ///
    /// # Errors
    /// [`Error::Differs`] with the figures.
    pub fn check(&self) -> Result<(), Error> {
        let (difference, rms) = self.largest();
        // Written so that no number fails.
        if difference <= DIFFERENCE && rms <= RMS && self.ticks > 0 {
            return Ok(());
        }
        Err(Error::Differs(format!(
            "over {} ticks a joint is up to {difference:.3} mrad from where it is with the robot inside (at most \
             {DIFFERENCE}), and its RMS error differs by {rms:.3} mrad (at most {RMS})",
            self.ticks
        )))
    }
}

/// The larger of two numbers; what is not a number stays.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

/// The RMS of a joint's tracking errors, mrad.
fn rms(motion: &Motion, joint: usize) -> f64 {
    let ticks = motion.references.iter().zip(&motion.estimates);
    let errors = ticks.map(|(d, q)| f64::from(d[joint]) - f64::from(q[joint]));
    let squares: f64 = errors.map(|error| error * error).sum();
    1e3 * (squares / motion.estimates.len().max(1) as f64).sqrt()
}
