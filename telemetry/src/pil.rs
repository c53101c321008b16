//! The messages of a processor in the loop: a program on the host simulates the robot, the processor controls it.
//!
//! The host sends a [`Measured`]; the processor runs one tick and replies a [`Commanded`] of the same number. A number
//! that comes twice is replied to twice and controlled once: the reply was lost. Number 0 starts from the beginning.

use heapless::Vec;
use serde::{Deserialize, Serialize};

use crate::message::Tick;

/// What the encoders of up to N joints answer in a tick.
///
/// ```
/// use telemetry::decoder::Frames;
/// use telemetry::pil::Measured;
/// let sent = Measured::<6> { number: 1, answers: [0x8123; 6].into_iter().collect() };
/// let mut bytes = [0; 64];
/// let mut frames = Frames::new();
/// let frame = telemetry::encode(&sent, &mut bytes)?;
/// let found: Vec<_> = frame.iter().filter_map(|&byte| frames.push(byte)).collect();
/// assert_eq!(found, [Ok(sent)]);
/// # Ok::<(), telemetry::EncodeError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Measured<const N: usize> {
    /// The number of the tick, from 0.
    pub number: u32,
    /// The frames on the wires of the encoders, as the encoders send them.
    pub answers: Vec<u16, N>,
}

/// What the drives of up to N joints receive in a tick.
///
/// ```
/// let commanded = telemetry::pil::Commanded::<6>::default();
/// assert!(commanded.duties.is_empty());
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Commanded<const N: usize> {
    /// The duties of the drives, in counts of their timers.
    pub duties: Vec<u16, N>,
    /// What the controller knows of the tick; its number is that of the [`Measured`].
    pub tick: Tick<N>,
}
