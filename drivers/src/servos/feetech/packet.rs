//! The packets of the Feetech bus: their bytes, without a port.

use super::FeetechError;

/// The longest packet that this driver sends, in bytes.
const LONGEST: usize = 128;
/// The longest reply that it takes: 16 parameters.
const LONGEST_REPLY: usize = 6 + MOST_PARAMETERS;
const MOST_PARAMETERS: usize = 16;
const HEADER: u8 = 0xff;
/// The identity that all servos obey and none answers.
pub const BROADCAST: u8 = 0xfe;

/// The instruction of a packet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Instruction {
    Ping = 0x01,
    Read = 0x02,
    Write = 0x03,
    SyncRead = 0x82,
    SyncWrite = 0x83,
}

/// An instruction packet: `FF FF id length instruction parameters checksum`.
///
/// ```
/// use joint_drivers::feetech::Packet;
/// // Example 2 of the protocol manual: two bytes of the position of servo 1.
/// assert_eq!(Packet::read(1, 0x38, 2)?.bytes(), [0xff, 0xff, 0x01, 0x04, 0x02, 0x38, 0x02, 0xbe]);
/// # Ok::<(), joint_drivers::feetech::FeetechError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Packet {
    bytes: [u8; LONGEST],
    length: usize,
}

impl Packet {
    /// Whether a servo is there.
    ///
    /// # Errors
    /// [`FeetechError::TooLong`], never here.
    pub fn ping(id: u8) -> Result<Self, FeetechError> {
        Self::new(id, Instruction::Ping, [])
    }

    /// Asks for `length` bytes from `address` on.
    ///
    /// # Errors
    /// [`FeetechError::TooLong`]: more than 16 bytes.
    pub fn read(id: u8, address: u8, length: u8) -> Result<Self, FeetechError> {
        check_reply(length)?;
        Self::new(id, Instruction::Read, [address, length])
    }

    /// Writes bytes from `address` on.
    ///
    /// # Errors
    /// [`FeetechError::TooLong`].
    pub fn write(id: u8, address: u8, data: &[u8]) -> Result<Self, FeetechError> {
        let parameters = [address].into_iter().chain(data.iter().copied());
        Self::new(id, Instruction::Write, parameters)
    }

    /// `length` bytes from `address` of each of these servos, which reply one after the other.
    ///
    /// # Errors
    /// [`FeetechError::TooLong`].
    pub fn sync_read(ids: &[u8], address: u8, length: u8) -> Result<Self, FeetechError> {
        check_reply(length)?;
        let parameters = [address, length].into_iter().chain(ids.iter().copied());
        Self::new(BROADCAST, Instruction::SyncRead, parameters)
    }

    /// `L` bytes from `address` on, for each servo its own; no servo replies.
    ///
    /// # Errors
    /// [`FeetechError::TooLong`].
    pub fn sync_write<const L: usize>(
        address: u8,
        data: impl IntoIterator<Item = (u8, [u8; L])>,
    ) -> Result<Self, FeetechError> {
        let length = u8::try_from(L).map_err(|_| FeetechError::TooLong)?;
        let each = data.into_iter().flat_map(|(id, bytes)| [id].into_iter().chain(bytes));
        Self::new(BROADCAST, Instruction::SyncWrite, [address, length].into_iter().chain(each))
    }

    fn new(
        id: u8,
        instruction: Instruction,
        parameters: impl IntoIterator<Item = u8>,
    ) -> Result<Self, FeetechError> {
        let mut packet = Self { bytes: [0; LONGEST], length: 0 };
        for byte in [HEADER, HEADER, id, 0, instruction as u8] {
            packet.push(byte)?;
        }
        for byte in parameters {
            packet.push(byte)?;
        }
        // Instruction, parameters and checksum: at most LONGEST, which a byte holds.
        packet.bytes[3] = (packet.length - 3) as u8;
        packet.push(checksum(packet.bytes()))?;
        Ok(packet)
    }

    fn push(&mut self, byte: u8) -> Result<(), FeetechError> {
        let place = self.bytes.get_mut(self.length);
        *place.ok_or(FeetechError::TooLong)? = byte;
        self.length += 1;
        Ok(())
    }

    /// The bytes to send.
    pub fn bytes(&self) -> &[u8] {
        self.bytes.get(..self.length).unwrap_or_default()
    }
}

fn check_reply(length: u8) -> Result<(), FeetechError> {
    if usize::from(length) <= MOST_PARAMETERS { Ok(()) } else { Err(FeetechError::TooLong) }
}

/// The complement of the sum of all bytes after the header.
fn checksum(bytes: &[u8]) -> u8 {
    !bytes.iter().skip(2).fold(0, |sum: u8, byte| sum.wrapping_add(*byte))
}

/// A status packet: `FF FF id length status parameters checksum`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reply {
    /// The servo that replied.
    pub id: u8,
    /// A bit for each error; zero without one.
    pub status: u8,
    parameters: [u8; MOST_PARAMETERS],
    length: usize,
}

impl Reply {
    /// The bytes that were read; empty in the reply to a write.
    pub fn parameters(&self) -> &[u8] {
        self.parameters.get(..self.length).unwrap_or_default()
    }
}

/// Finds status packets among the bytes that a port receives, byte by byte.
///
/// Bytes that are no packet are skipped: after a false header the search continues at the byte
/// after it, so that a packet that follows noise is not lost.
///
/// ```
/// use joint_drivers::feetech::Parser;
/// let mut parser = Parser::new();
/// // A false header, then the reply of example 2 of the protocol manual: position 0x0518.
/// let bytes = [0xff, 0xff, 0x07, 0x05, 0xff, 0xff, 0x01, 0x04, 0x00, 0x18, 0x05, 0xdd];
/// let replies: Vec<_> = bytes.into_iter().filter_map(|byte| parser.push(byte)).collect();
/// assert_eq!((replies.len(), replies[0].id, replies[0].parameters()), (1, 1, &[0x18, 0x05][..]));
/// assert_eq!(parser.skipped(), 4);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Parser {
    bytes: [u8; LONGEST_REPLY],
    length: usize,
    skipped: usize,
    has_wrong_checksum: bool,
}

impl Default for Parser {
    fn default() -> Self {
        Self::new()
    }
}

/// The kind of the first bytes of a buffer.
enum Start {
    Incomplete,
    Noise,
    WrongChecksum,
    Packet(Reply, usize),
}

impl Parser {
    /// A parser that has received nothing.
    pub const fn new() -> Self {
        Self { bytes: [0; LONGEST_REPLY], length: 0, skipped: 0, has_wrong_checksum: false }
    }

    /// Takes a byte; the packet that it completes.
    pub fn push(&mut self, byte: u8) -> Option<Reply> {
        // Never full here: a complete packet or noise has been removed before.
        if let Some(place) = self.bytes.get_mut(self.length) {
            *place = byte;
            self.length += 1;
        }
        self.search(false)
    }

    /// The packet that is left after the last byte, if a false header before it promised more.
    pub fn finish(&mut self) -> Option<Reply> {
        self.search(true)
    }

    fn search(&mut self, is_end: bool) -> Option<Reply> {
        while self.length > 0 {
            match start(self.bytes.get(..self.length)?) {
                Start::Incomplete if !is_end => return None,
                Start::Packet(reply, length) => {
                    self.drop(length);
                    return Some(reply);
                }
                Start::WrongChecksum => self.has_wrong_checksum = true,
                Start::Incomplete | Start::Noise => {}
            }
            self.skipped += 1;
            self.drop(1);
        }
        None
    }

    /// The bytes that were skipped so far.
    pub const fn skipped(&self) -> usize {
        self.skipped
    }

    /// Whether something looked like a packet except for its checksum.
    pub const fn has_wrong_checksum(&self) -> bool {
        self.has_wrong_checksum
    }

    fn drop(&mut self, bytes: usize) {
        let bytes = bytes.min(self.length);
        self.bytes.copy_within(bytes..self.length, 0);
        self.length -= bytes;
    }
}

fn start(bytes: &[u8]) -> Start {
    let at = |place: usize| bytes.get(place).copied();
    let is_header = |place| at(place).is_none_or(|byte| byte == HEADER);
    if !is_header(0) || !is_header(1) {
        return Start::Noise;
    }
    let (Some(id), Some(length)) = (at(2), at(3).map(usize::from)) else {
        return Start::Incomplete;
    };
    // No servo has the identity of a header byte: of three in a row the packet begins one later.
    // The length counts status and checksum too.
    if id >= BROADCAST || !(2..=MOST_PARAMETERS + 2).contains(&length) {
        return Start::Noise;
    }
    let (Some(body), Some(sum)) = (bytes.get(..length + 3), at(length + 3)) else {
        return Start::Incomplete;
    };
    if checksum(body) != sum {
        return Start::WrongChecksum;
    }
    let mut reply = Reply {
        id,
        status: at(4).unwrap_or_default(),
        parameters: [0; MOST_PARAMETERS],
        length: length - 2,
    };
    let parameters = body.get(5..).unwrap_or_default();
    for (place, byte) in reply.parameters.iter_mut().zip(parameters) {
        *place = *byte;
    }
    Start::Packet(reply, length + 4)
}
