//! Shows and records the telemetry of a machine: what `cargo xtask watch` runs.
//!
//! | module | what |
//! |---|---|
//! | [`source`] | bytes from a serial port, from a program such as QEMU, or from a file |
//! | [`view`] | what is known of the machine so far |
//! | [`screen`] | the view as a screen of a terminal |
//! | [`record`] | ticks as CSV or MCAP |
//! | [`summary`] | the view as JSON and as a line of text |
//! | [`session`] | the loop that reads, records and shows |

pub mod error;
pub mod record;
pub mod screen;
pub mod session;
pub mod source;
pub mod summary;
pub mod view;

/// The most joints that a machine may have.
pub const JOINTS: usize = 32;
pub type Message = machine_link::Message<JOINTS>;
pub type Tick = machine_link::Tick<JOINTS>;
pub type Machine = machine_link::Machine<JOINTS>;
/// The decoder of any machine's frames.
pub type Decoder = machine_link::Decoder<JOINTS>;
