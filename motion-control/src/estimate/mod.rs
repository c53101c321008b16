//! Estimates of the arm: velocities, external torques, loads, parameters.
//!
//! | item | purpose | memory |
//! |---|---|---|
//! | [`Observer`] | velocity from positions | estimate |
//! | [`ContactDetector`] | external torques beyond thresholds that follow the stated errors of the model | as the observer, thresholds |
//! | [`MomentumObserver`] | external torques from the momentum of the joints | momentum, external torques |
//! | [`TipWrench`] | the wrench of a contact at the tip, from external torques | none |
//! | [`SensorLoadFit`], [`SensorLoad`] | load and offset of a force sensor, from poses at rest | sums |
//! | [`PayloadEstimator`] | mass, centre of mass and inertia of a load from the torques of the joints | information |
//! | [`ParameterEstimator`] | inertial parameters, frictions and armatures of an arm, from one joint's torque in each update | estimate, covariance |
//! | [`PhysicalParameters`] | parameters that bodies can have, near those of the estimator | the last set |

pub(crate) mod contact_detector;
pub(crate) mod momentum_observer;
pub(crate) mod observer;
pub(crate) mod parameter_estimator;
pub(crate) mod payload_estimator;
pub(crate) mod sensor_load;
#[cfg(test)]
pub(crate) mod tests;
pub(crate) mod tip_wrench;

pub use contact_detector::{ContactDetector, DetectedContact};
pub use momentum_observer::MomentumObserver;
pub use observer::{Estimate, Observer, ObserverConfig};
pub use parameter_estimator::{
    Excitation, ImpossibleParameters, ParameterEstimator, ParameterEstimatorConfig,
    PhysicalParameters, RecordError, RejectedRow, SelectedParameters,
};
pub use payload_estimator::{PayloadEstimator, PayloadEstimatorConfig, RejectedMeasurement};
pub use sensor_load::{SensorLoad, SensorLoadError, SensorLoadFit};
pub use tip_wrench::{TipWrench, TipWrenchConfig};
