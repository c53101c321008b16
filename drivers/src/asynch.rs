//! The encoders on a bus over `embedded-hal-async`: the transfers alone; state and decoding are the blocking form's.

use embedded_hal_async::i2c::I2c;
use embedded_hal_async::spi::SpiDevice;

use crate::as5047p::{As5047p, FrameError, READ_ANGLE, READ_ERRORS};
use crate::as5600::{ADDRESS, As5600, As5600Error, RAW_ANGLE, STATUS, bus_error, decode_status};

impl<Spi: SpiDevice> As5047p<Spi> {
    /// As [`Self::start`], over `embedded-hal-async`.
    pub async fn start_async(&mut self) {
        for command in [READ_ERRORS, READ_ANGLE] {
            let _ = self.spi.transfer_in_place(&mut command.to_be_bytes()).await;
        }
    }

    /// As [`Self::read`], over `embedded-hal-async`.
    ///
    /// # Errors
    /// [`FrameError`]; the count of turns is then unchanged.
    pub async fn read_async(&mut self) -> Result<f32, FrameError> {
        let mut frame = READ_ANGLE.to_be_bytes();
        let sent = self.spi.transfer_in_place(&mut frame).await;
        match self.accept(sent, frame) {
            Ok(()) => Ok(self.angle()),
            Err(error) => {
                self.start_async().await;
                Err(error)
            }
        }
    }
}

impl<Bus: I2c> As5600<Bus> {
    /// As [`Self::check_magnet`], over `embedded-hal-async`.
    ///
    /// # Errors
    /// [`As5600Error`].
    pub async fn check_magnet_async(&mut self) -> Result<(), As5600Error> {
        let mut status = [0];
        self.bus
            .write_read(ADDRESS, &[STATUS], &mut status)
            .await
            .map_err(bus_error)?;
        decode_status(status[0])
    }

    /// As [`Self::read_angle`], over `embedded-hal-async`.
    ///
    /// # Errors
    /// [`As5600Error::Bus`]; the count of turns is then unchanged.
    pub async fn read_angle_async(&mut self) -> Result<f32, As5600Error> {
        let mut raw = [0; 2];
        self.bus
            .write_read(ADDRESS, &[RAW_ANGLE], &mut raw)
            .await
            .map_err(bus_error)?;
        Ok(self.accept(raw))
    }

    /// As [`Self::read`], over `embedded-hal-async`.
    ///
    /// # Errors
    /// [`As5600Error`]; the count of turns is then unchanged.
    pub async fn read_async(&mut self) -> Result<f32, As5600Error> {
        self.check_magnet_async().await?;
        self.read_angle_async().await
    }
}

/// The output of a future of mocks, which are ready at once.
#[cfg(test)]
pub(crate) fn ready<F: Future>(future: F) -> F::Output {
    use core::task::{Context, Poll, Waker};
    match core::pin::pin!(future).poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(output) => output,
        Poll::Pending => panic!("a mock is never pending"),
    }
}

#[cfg(test)]
mod tests {
    use core::f32::consts::FRAC_PI_2;
    use std::vec;
    use std::vec::Vec;

    use embedded_hal_mock::eh1::{i2c, spi};

    use super::*;
    use crate::JointMapping;
    use crate::as5047p::{ERROR, encode, with_parity};

    fn transfers(frames: &[(u16, u16)]) -> spi::Mock<u8> {
        let of = |&(command, answer): &(u16, u16)| {
            let bytes = |frame: u16| frame.to_be_bytes().to_vec();
            [
                spi::Transaction::transaction_start(),
                spi::Transaction::transfer_in_place(bytes(command), bytes(answer)),
                spi::Transaction::transaction_end(),
            ]
        };
        spi::Mock::new(&frames.iter().flat_map(of).collect::<Vec<_>>())
    }

    #[test]
    fn the_asynchronous_as5047p_sends_and_decodes_what_the_blocking_one_does() {
        let frames = [
            (READ_ERRORS, 0),
            (READ_ANGLE, 0),
            (READ_ANGLE, encode(4096)),
            (READ_ANGLE, with_parity(ERROR)),
            (READ_ERRORS, 0),
            (READ_ANGLE, 0),
            (READ_ANGLE, encode(16_383)),
        ];
        let expected = [
            Ok(FRAC_PI_2),
            Err(FrameError::Flag),
            Ok(-crate::as5047p::RESOLUTION),
        ];
        let mut encoder = As5047p::new(transfers(&frames), JointMapping::IDENTITY);
        ready(encoder.start_async());
        for angle in expected {
            assert_eq!(ready(encoder.read_async()), angle);
        }
        encoder.release().done();

        let mut encoder = As5047p::new(transfers(&frames), JointMapping::IDENTITY);
        encoder.start();
        for angle in expected {
            assert_eq!(encoder.read(), angle);
        }
        encoder.release().done();
    }

    #[test]
    fn the_asynchronous_as5600_sends_and_decodes_what_the_blocking_one_does() {
        let registers = |status, angle: [u8; 2]| {
            [
                i2c::Transaction::write_read(ADDRESS, vec![STATUS], vec![status]),
                i2c::Transaction::write_read(ADDRESS, vec![RAW_ANGLE], angle.to_vec()),
            ]
        };
        let absent = [i2c::Transaction::write_read(ADDRESS, vec![STATUS], vec![0])];
        let all = [
            &registers(0x20, [0x04, 0x00])[..],
            &absent,
            &registers(0x20, [0x04, 0x00]),
        ];
        let expected = [Ok(FRAC_PI_2), Err(As5600Error::MagnetAbsent), Ok(FRAC_PI_2)];
        let mut encoder = As5600::new(i2c::Mock::new(&all.concat()), JointMapping::IDENTITY);
        for angle in expected {
            assert_eq!(ready(encoder.read_async()), angle);
        }
        encoder.release().done();

        let mut encoder = As5600::new(i2c::Mock::new(&all.concat()), JointMapping::IDENTITY);
        for angle in expected {
            assert_eq!(encoder.read(), angle);
        }
        encoder.release().done();
    }
}
