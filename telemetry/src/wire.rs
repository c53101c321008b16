//! A message as bytes: the version of the format, postcard, CRC-32C, and COBS between zeros.

use crc::{CRC_32_ISCSI, Crc, Table};
use postcard::ser_flavors::crc::CrcModifier;
use postcard::ser_flavors::{Cobs, Slice};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// The version of the format: the first byte of each frame. Another one is refused, not misread.
pub const VERSION: u8 = 1;

static CRC: Crc<u32, Table<1>> = Crc::<u32, Table<1>>::new(&CRC_32_ISCSI);

/// Why a message has no frame.
///
/// ```
/// use machine_link::{EncodeError, Message, Tick, encode};
/// let tick = Message::Tick(Tick::<6>::default());
/// assert_eq!(encode(&tick, &mut [0; 8]), Err(EncodeError::Full));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum EncodeError {
    /// The buffer is shorter than the frame; see [`capacity`].
    #[error("the buffer is shorter than the frame")]
    Full,
}

/// Why a frame holds no message.
///
/// ```
/// use machine_link::{FrameError, Message, decode};
/// assert_eq!(decode::<Message<6>>(&mut [3, 1, 2]), Err(FrameError::Short));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FrameError {
    /// The bytes between two zeros are not COBS.
    #[error("the bytes between two zeros are not COBS")]
    Cobs,
    /// It has fewer bytes than a version and a checksum.
    #[error("it is shorter than a version and a checksum")]
    Short,
    /// It has more bytes than the decoder has room for.
    #[error("it is longer than any frame")]
    Long,
    /// The checksum is not that of the contents.
    #[error("its checksum is wrong")]
    Checksum,
    /// It is of another version of the format.
    #[error("it has version {found} of the format, not {VERSION}")]
    Version {
        /// Its version.
        found: u8,
    },
    /// The contents are whole but not a message: more joints than there is room for, or another
    /// program's frame.
    #[error("it is whole but not a message")]
    Contents,
}

/// The bytes that any frame of a machine with this many joints fits into.
///
/// ```
/// assert_eq!(machine_link::capacity(6), 166);
/// ```
#[must_use]
pub const fn capacity(joints: usize) -> usize {
    let contents = 61 + 17 * joints;
    // Two zeros, and COBS's overhead.
    contents + 3 + contents / 254
}

/// The frame of a message, in the buffer: its bytes from zero to zero.
///
/// # Cost
/// Linear in the number of bytes.
///
/// # Errors
/// [`EncodeError`].
///
/// ```
/// use machine_link::{Message, Tick, encode};
/// let mut buffer = [0; machine_link::capacity(6)];
/// let frame = encode(&Message::Tick(Tick::<6>::default()), &mut buffer)?;
/// assert_eq!((frame[0], frame.last()), (0, Some(&0)));
/// # Ok::<(), machine_link::EncodeError>(())
/// ```
pub fn encode<'b, M: Serialize>(
    message: &M,
    buffer: &'b mut [u8],
) -> Result<&'b [u8], EncodeError> {
    let full = |_| EncodeError::Full;
    let (start, rest) = buffer.split_first_mut().ok_or(EncodeError::Full)?;
    *start = 0;
    let cobs = Cobs::try_new(Slice::new(rest)).map_err(full)?;
    let checked = CrcModifier::new(cobs, CRC.digest());
    let written = postcard::serialize_with_flavor(&(VERSION, message), checked).map_err(full)?;
    let end = 1 + written.len();
    Ok(&buffer[..end])
}

/// The message of a frame without its zeros; the bytes are decoded in place.
///
/// # Cost
/// Linear in the number of bytes.
///
/// # Errors
/// [`FrameError`].
///
/// ```
/// use machine_link::{Message, Tick, decode, encode};
/// let mut buffer = [0; machine_link::capacity(6)];
/// let message = Message::Tick(Tick::<6>::default());
/// let length = encode(&message, &mut buffer)?.len();
/// assert_eq!(decode::<Message<6>>(&mut buffer[1..length - 1]), Ok(message));
/// # Ok::<(), machine_link::EncodeError>(())
/// ```
pub fn decode<M: DeserializeOwned>(bytes: &mut [u8]) -> Result<M, FrameError> {
    let length = cobs::decode_in_place(bytes).map_err(|_| FrameError::Cobs)?;
    let contents = &bytes[..length];
    let (contents, checksum) = contents.split_last_chunk::<4>().ok_or(FrameError::Short)?;
    let (&version, message) = contents.split_first().ok_or(FrameError::Short)?;
    if CRC.checksum(contents) != u32::from_le_bytes(*checksum) {
        return Err(FrameError::Checksum);
    }
    if version != VERSION {
        return Err(FrameError::Version { found: version });
    }
    match postcard::take_from_bytes(message) {
        Ok((message, [])) => Ok(message),
        _ => Err(FrameError::Contents),
    }
}
