//! Estimates of the arm: velocities, external torques, loads, parameters.

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
