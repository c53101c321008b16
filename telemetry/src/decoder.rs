//! Frames from a stream of bytes of which some may be lost or corrupted.

use serde::de::DeserializeOwned;

use crate::message::Message;
use crate::wire::{FrameError, decode};

/// Room for the longest frame that the decoder takes, bytes.
const ROOM: usize = 1024;

/// The counts of a [`Decoder`].
///
/// ```
/// let decoder = machine_link::Decoder::<6>::new();
/// assert_eq!(decoder.counts(), machine_link::Counts::default());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Good frames.
    pub frames: u64,
    /// Frames with an error.
    pub bad: u64,
    /// Ticks that are missing between those that arrived: dropped by the machine or lost on the
    /// line.
    pub missing: u64,
    /// Those among them that the machine's queue dropped.
    pub dropped: u64,
    /// Restarts of the machine: its numbers of ticks began again.
    pub restarts: u64,
}

impl Counts {
    /// Ticks that were lost on the line.
    ///
    /// ```
    /// let counts = machine_link::Counts { missing: 5, dropped: 3, ..Default::default() };
    /// assert_eq!(counts.lost(), 2);
    /// ```
    #[must_use]
    pub fn lost(&self) -> u64 {
        self.missing.saturating_sub(self.dropped)
    }
}

/// Finds the frames of a machine with up to N joints in a stream of bytes.
///
/// It resynchronises at the next zero, and needs no heap. What arrives before the first zero is the
/// rest of a frame whose beginning nobody heard, and is not counted as bad.
///
/// ```
/// use machine_link::{Decoder, FrameError};
/// let mut decoder = Decoder::<6>::new();
/// let found: Vec<_> = [7, 7, 0, 9, 1, 0].iter().filter_map(|&byte| decoder.push(byte)).collect();
/// assert_eq!(found, [Err(FrameError::Cobs)]);
/// assert_eq!(decoder.counts().bad, 1);
/// ```
#[derive(Clone, Debug)]
pub struct Decoder<const N: usize> {
    frames: Frames,
    counts: Counts,
    /// The number and the drops of the last tick.
    last: Option<(u32, u32)>,
}

impl<const N: usize> Default for Decoder<N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize> Decoder<N> {
    /// A decoder that has received nothing.
    ///
    /// ```
    /// assert_eq!(machine_link::Decoder::<6>::new().counts().frames, 0);
    /// ```
    #[must_use]
    pub const fn new() -> Self {
        Self {
            frames: Frames::new(),
            counts: Counts { frames: 0, bad: 0, missing: 0, dropped: 0, restarts: 0 },
            last: None,
        }
    }

    /// Takes the next byte; returns the message that it completes, or why a frame holds none.
    ///
    /// ```
    /// assert_eq!(machine_link::Decoder::<6>::new().push(0), None);
    /// ```
    pub fn push(&mut self, byte: u8) -> Option<Result<Message<N>, FrameError>> {
        let found = self.frames.push(byte)?;
        match &found {
            Ok(message) => {
                self.counts.frames += 1;
                if let Message::Tick(tick) = message {
                    self.follow(tick.number, tick.dropped);
                }
            }
            Err(_) => self.counts.bad += 1,
        }
        Some(found)
    }

    /// The counts so far.
    ///
    /// ```
    /// assert_eq!(machine_link::Decoder::<6>::new().counts().lost(), 0);
    /// ```
    #[must_use]
    pub const fn counts(&self) -> Counts {
        self.counts
    }

    /// Counts what is missing before the tick of this number.
    fn follow(&mut self, number: u32, dropped: u32) {
        if let Some((last, before)) = self.last.replace((number, dropped)) {
            let step = number.wrapping_sub(last);
            // A step back is one of more than half of the range.
            if step == 0 || step > u32::MAX / 2 {
                self.counts.restarts += 1;
            } else {
                self.counts.missing += u64::from(step - 1);
                self.counts.dropped += u64::from(dropped.wrapping_sub(before));
            }
        }
    }
}

/// Cuts a stream of bytes at its zeros and decodes what lies between, of any type of message.
///
/// ```
/// use machine_link::decoder::Frames;
/// let mut buffer = [0; 16];
/// let frame = machine_link::encode(&7_u32, &mut buffer)?;
/// let mut frames = Frames::new();
/// let found: Vec<_> = frame.iter().filter_map(|&byte| frames.push(byte)).collect();
/// assert_eq!(found, [Ok(7_u32)]);
/// # Ok::<(), machine_link::EncodeError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Frames {
    bytes: [u8; ROOM],
    /// Bytes since the last zero; more than there is room for is too long a frame.
    length: usize,
    /// A zero was received.
    started: bool,
}

impl Default for Frames {
    fn default() -> Self {
        Self::new()
    }
}

impl Frames {
    /// Nothing received yet.
    ///
    /// ```
    /// assert_eq!(machine_link::decoder::Frames::new().push::<u32>(0), None);
    /// ```
    #[must_use]
    pub const fn new() -> Self {
        Self { bytes: [0; ROOM], length: 0, started: false }
    }

    /// Takes the next byte; returns the message that it completes, or why a frame holds none.
    ///
    /// ```
    /// assert_eq!(machine_link::decoder::Frames::new().push::<u32>(1), None);
    /// ```
    pub fn push<M: DeserializeOwned>(&mut self, byte: u8) -> Option<Result<M, FrameError>> {
        if byte != 0 {
            if let Some(place) = self.bytes.get_mut(self.length) {
                *place = byte;
            }
            self.length = (self.length + 1).min(ROOM + 1);
            return None;
        }
        let length = core::mem::take(&mut self.length);
        let was_started = core::mem::replace(&mut self.started, true);
        if length == 0 || !was_started {
            return None;
        }
        let bytes = self.bytes.get_mut(..length);
        Some(bytes.map_or(Err(FrameError::Long), decode))
    }
}
