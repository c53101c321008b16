//! The gate that every command passes, and what detects faults.

pub(crate) mod detectors;
pub(crate) mod stop_category;
pub(crate) mod supervisor;
pub(crate) mod thermal;
pub(crate) mod tick_counter;

pub use detectors::{Detect, Detectors, FrozenEncoder, ReferenceStep, Saturation};
pub use stop_category::StopCategory;
pub use supervisor::SupervisorConfig;
pub use thermal::{ThermalConfig, ThermalLimit, ThermalState, ThermalStatus};
pub use tick_counter::{CompletedTick, CountedTick, TickCounter, Watchdog};
