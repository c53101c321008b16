//! The gate that every command passes, and what detects faults.
//!
//! | item | purpose | memory |
//! |---|---|---|
//! | [`FrozenEncoder`], [`ReferenceStep`], [`Saturation`] | faults that take several ticks to show | the last ticks |
//! | [`ThermalLimit`] | torques that no winding overheats by, and how long one can be held | temperatures |
//! | [`TickCounter`], [`Watchdog`] | missed ticks, overruns, and what feeds a watchdog | a count |

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
