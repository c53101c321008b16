//! The bus of an SO-101: the request that the page sends, and the positions in what the servos
//! reply, by the library's own driver. The page moves the bytes.

use std::convert::Infallible;

use embedded_io::{ErrorType, Read, ReadReady, Write};
use joint_drivers::feetech::{FeetechError, PRESENT_POSITION, Packet, Servos};
use joint_drivers::{Direction, JointMapping, JointRange};

/// The servos of an SO-101, from its base to its jaw.
const IDS: [u8; 6] = [1, 2, 3, 4, 5, 6];

/// The bytes that ask all servos for their positions.
///
/// # Errors
/// As [`Packet::sync_read`].
pub fn request() -> Result<Vec<u8>, FeetechError> {
    Ok(Packet::sync_read(&IDS, PRESENT_POSITION, 2)?.bytes().to_vec())
}

/// Bytes that were received, as a port without more of them.
struct Received<'a>(&'a [u8]);

impl ErrorType for Received<'_> {
    type Error = Infallible;
}
impl Read for Received<'_> {
    fn read(&mut self, into: &mut [u8]) -> Result<usize, Infallible> {
        let count = into.len().min(self.0.len());
        into[..count].copy_from_slice(&self.0[..count]);
        self.0 = &self.0[count..];
        Ok(count)
    }
}
impl ReadReady for Received<'_> {
    fn read_ready(&mut self) -> Result<bool, Infallible> {
        // All bytes here are the reply to this request: the page drops what came before it.
        Ok(false)
    }
}
impl Write for Received<'_> {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
        Ok(bytes.len())
    }
    fn flush(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

/// The positions of the servos, rad from the middle of each, in the bytes that they replied.
///
/// # Errors
/// The driver's: a servo that did not answer, a wrong checksum, an error that a servo reports.
pub fn positions(received: &[u8]) -> Result<[f32; 6], String> {
    // Within half a turn of the middle: each reply is of a bus that is new.
    let middle = JointMapping::new(std::f32::consts::PI, Direction::Forward, 1.0)
        .and_then(|middle| middle.with_range(JointRange::Near(0.0), 0.1))
        .map_err(|error| format!("{error:?}"))?;
    let words = |error: FeetechError| error.to_string();
    let mut servos = Servos::new(Received(received), IDS, [middle; 6]).map_err(words)?;
    servos.positions().map_err(|error| error.to_string())
}
