//! Why an identification has no result.

/// The reason for which there is no estimate.
///
/// ```
/// let error = identification::IdentificationError::NotFinite { sample: 13, joint: 4 };
/// assert_eq!(error.to_string(), "sample 13: the position or the torque of joint 4 is not finite");
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum IdentificationError {
    /// There are not as many torques as positions.
    #[error("{samples} positions, but {torques} torques")]
    Lengths {
        /// Positions.
        samples: usize,
        /// Torques.
        torques: usize,
    },
    /// The interval between samples is not a positive time.
    #[error("the interval between samples is not a positive time")]
    Interval,
    /// A position or a torque is not finite.
    #[error("sample {sample}: the position or the torque of joint {joint} is not finite")]
    NotFinite {
        /// The sample.
        sample: usize,
        /// The joint.
        joint: usize,
    },
    /// The frequency up to which torques are compared is not positive, or too high for the ticks.
    #[error(
        "torques cannot be compared up to {cutoff} Hz: the ticks of the recording allow at most \
         {most:.1} Hz; a lower --cutoff, or none, which takes the highest up to 10 Hz"
    )]
    Cutoff {
        /// The frequency, Hz.
        cutoff: f64,
        /// The highest one, Hz.
        most: f64,
    },
    /// A recording of ticks has fewer samples than the parameters need.
    #[error("{seconds:.1} s without a gap are too few to identify from")]
    TooShort {
        /// Its duration, s.
        seconds: f64,
    },
    /// A body of the nominal model has a pseudo-inertia that is not positive definite, and is not
    /// without mass either.
    #[error("body {body}: its nominal pseudo-inertia is not positive definite")]
    ImpossibleBody {
        /// The body.
        body: usize,
    },
}
