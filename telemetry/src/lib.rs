//! Telemetry of a control loop: what happened in each tick, sent over a serial line.
//!
//! The interrupt of the control tick puts a [`Tick`] into a [`Queue`]; the main loop takes it out,
//! encodes it and writes the bytes. The interrupt never waits: a full queue drops the tick and
//! counts it. On the other side of the line a [`Decoder`] finds the frames again, whatever was lost
//! or corrupted in between.
//!
//! | module | what |
//! |---|---|
//! | [`message`] | the contents of a frame: the machine, and a tick |
//! | [`wire`] | a message as bytes: postcard, CRC-32, COBS |
//! | [`queue`] | the queue between the interrupt and the main loop |
//! | [`decoder`] | frames from a stream of bytes, with counts of what is bad and of what is missing |
//!
//! # A frame
//!
//! ```text
//! 0 | COBS( version, postcard(Message), CRC-32 little-endian ) | 0
//! ```
//!
//! COBS (S. Cheshire and M. Baker, "Consistent Overhead Byte Stuffing", 1999) removes zeros from
//! the contents, so that a zero is the end of a frame and nothing else. A frame also begins with
//! one: a lost zero then merges no two frames. The checksum is CRC-32C (Castagnoli), which finds
//! each burst of up to 32 bits.
//!
//! # The two sides
//!
//! ```
//! use machine_link::{Decoder, Message, Queue, Sample, Slots, split, encode};
//!
//! let mut slots = Slots::<1, 4>::default();
//! let mut queue = Queue::new();
//! let (mut interrupt, mut main) = split(&mut slots, &mut queue, 0);
//! let sample = Sample { reference: [0.5], estimate: [0.499], torque: [12.0], ..Sample::default() };
//! *interrupt.sample() = sample; // in the control tick
//! interrupt.push();
//!
//! let mut bytes = [0; machine_link::capacity(1)];
//! let tick = main.pop().expect("what was pushed"); // in the main loop
//! let frame = encode(&Message::Tick(tick), &mut bytes)?;
//!
//! let mut decoder = Decoder::<8>::new(); // on the host
//! let found: Vec<_> = frame.iter().filter_map(|&byte| decoder.push(byte)).collect();
//! let [Ok(Message::Tick(tick))] = &found[..] else { panic!("one tick") };
//! assert_eq!((tick.number, tick.joints[0].torque), (0, 12.0));
//! # Ok::<(), machine_link::EncodeError>(())
//! ```
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod decoder;
pub mod message;
pub mod queue;
pub mod wire;

pub use decoder::{Counts, Decoder};
pub use message::{Axis, Joint, Machine, Message, PHASES, Sample, Tick};
pub use queue::{Consumer, Producer, Queue, Slots, split};
pub use wire::{EncodeError, FrameError, VERSION, capacity, decode, encode};
