//! Devices at a count.

use std::rc::Rc;

use embedded_hal::{i2c, spi};
use embedded_io::ErrorType;

use joint_drivers::as5047p::encode;

use super::*;

/// A count that a device reads while a test sets it.
pub(super) type Count = Rc<Cell<u16>>;

pub(super) fn count(count: u16) -> Count {
    Rc::new(Cell::new(count))
}

/// An AS5047P or an AS5600 whose magnet is at a count; without an answer at `GONE`.
#[derive(Debug)]
pub(super) struct Magnet(pub Count);

/// The register of an AS5600 that says whether its magnet is well placed.
const STATUS: u8 = 0x0b;

/// The count of an encoder that does not answer.
pub(super) const GONE: u16 = u16::MAX;

impl spi::ErrorType for Magnet {
    type Error = spi::ErrorKind;
}

impl spi::SpiDevice for Magnet {
    fn transaction(&mut self, all: &mut [spi::Operation<'_, u8>]) -> Result<(), spi::ErrorKind> {
        for operation in all {
            if let spi::Operation::TransferInPlace(words) = operation {
                words.copy_from_slice(&encode(self.0.get()).to_be_bytes());
            }
        }
        match self.0.get() {
            GONE => Err(spi::ErrorKind::Other),
            _ => Ok(()),
        }
    }
}

impl embedded_hal_async::spi::SpiDevice for Magnet {
    async fn transaction(
        &mut self,
        all: &mut [spi::Operation<'_, u8>],
    ) -> Result<(), spi::ErrorKind> {
        spi::SpiDevice::transaction(self, all)
    }
}

impl i2c::ErrorType for Magnet {
    type Error = i2c::ErrorKind;
}

impl i2c::I2c for Magnet {
    fn transaction(&mut self, _: u8, all: &mut [i2c::Operation<'_>]) -> Result<(), i2c::ErrorKind> {
        let mut register = 0;
        for operation in all {
            match operation {
                i2c::Operation::Write(bytes) => register = bytes[0],
                i2c::Operation::Read(into) if register == STATUS => into[0] = 0x20,
                i2c::Operation::Read(into) => into.copy_from_slice(&self.0.get().to_be_bytes()),
            }
        }
        match self.0.get() {
            GONE => Err(i2c::ErrorKind::Other),
            _ => Ok(()),
        }
    }
}

impl embedded_hal_async::i2c::I2c for Magnet {
    async fn transaction(
        &mut self,
        address: u8,
        all: &mut [i2c::Operation<'_>],
    ) -> Result<(), i2c::ErrorKind> {
        i2c::I2c::transaction(self, address, all)
    }
}

/// A bus with servo 1 at a count, which replies to requests of positions; silent at `GONE`.
#[derive(Debug, Default)]
pub(super) struct Bus {
    pub count: Count,
    pub reply: VecDeque<u8>,
    pub sent: Vec<u8>,
}

impl Bus {
    pub fn at(count: u16) -> Self {
        Self { count: self::count(count), ..Self::default() }
    }
}

impl ErrorType for Bus {
    type Error = Infallible;
}

impl embedded_io::ReadReady for Bus {
    fn read_ready(&mut self) -> Result<bool, Infallible> {
        Ok(!self.reply.is_empty())
    }
}

impl embedded_io::Read for Bus {
    fn read(&mut self, into: &mut [u8]) -> Result<usize, Infallible> {
        let next = self.reply.pop_front();
        Ok(next.map_or(0, |byte| {
            into[0] = byte;
            1
        }))
    }
}

impl embedded_io::Write for Bus {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
        self.sent = bytes.to_vec();
        if bytes.get(4) == Some(&0x82) && self.count.get() != GONE {
            let [low, high] = self.count.get().to_le_bytes();
            let body = [1_u8, 4, 0, low, high];
            let sum = body.iter().fold(0_u8, |sum, byte| sum.wrapping_add(*byte));
            self.reply.extend([0xff, 0xff]);
            self.reply.extend(body);
            self.reply.push_back(!sum);
        }
        Ok(bytes.len())
    }
    fn flush(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

impl embedded_io_async::Read for Bus {
    async fn read(&mut self, into: &mut [u8]) -> Result<usize, Infallible> {
        embedded_io::Read::read(self, into)
    }
}

impl embedded_io_async::Write for Bus {
    async fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
        embedded_io::Write::write(self, bytes)
    }
    async fn flush(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}
