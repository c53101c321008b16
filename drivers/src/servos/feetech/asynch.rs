//! The servo bus over `embedded-io-async`: the transfers alone; packets and replies are the
//! blocking form's.

use embedded_io::ReadReady;
use embedded_io_async::{Read, Write};

use crate::JointError;
use crate::asynch::JointEncoders;

use super::error::port_error;
use super::{
    FeetechError, MOST_NOISE, Packet, Parser, Servos, TORQUE_ENABLE, next_reply, parameters,
};

/// No reading of the servos that come after one that did not reply.
impl<Port: Read + Write + ReadReady, const N: usize> JointEncoders<N> for Servos<Port, N> {
    async fn start(&mut self) {}

    async fn read(&mut self) -> Result<[f32; N], JointError<FeetechError>> {
        self.read_all_async().await
    }
}

impl<Port: Read + Write + ReadReady, const N: usize> Servos<Port, N> {
    /// Does what [`Self::positions`] does, over `embedded-io-async`.
    ///
    /// # Errors
    /// [`FeetechError`] of the first servo that did not reply as it should.
    pub async fn positions_async(&mut self) -> Result<[f32; N], FeetechError> {
        self.read_all_async().await.map_err(|failed| failed.error)
    }

    async fn read_all_async(&mut self) -> Result<[f32; N], JointError<FeetechError>> {
        let mut sent = match self.request() {
            Ok(request) => self.send_async(&request).await,
            Err(error) => Err(error),
        };
        let mut positions = [0.0; N];
        let mut parser = Parser::new();
        for (joint, position) in positions.iter_mut().enumerate() {
            let register = match core::mem::replace(&mut sent, Ok(())) {
                Ok(()) => self.receive_async(self.ids[joint], &mut parser).await,
                Err(error) => Err(error),
            };
            *position = self.accept(joint, register)?;
        }
        Ok(positions)
    }

    /// Does what [`Self::set_positions`] does, over `embedded-io-async`.
    ///
    /// # Errors
    /// [`FeetechError`]; nothing is sent after [`FeetechError::Goal`].
    pub async fn set_positions_async(&mut self, positions: &[f32; N]) -> Result<(), FeetechError> {
        self.send_async(&self.goal_positions(positions)?).await
    }

    /// Does what [`Self::set_duties`] does, over `embedded-io-async`.
    ///
    /// # Errors
    /// [`FeetechError`].
    pub async fn set_duties_async(&mut self, duties: &[f32; N]) -> Result<(), FeetechError> {
        self.send_async(&self.goal_duties(duties)?).await
    }

    /// Does what [`Self::enable_torque`] does, over `embedded-io-async`.
    ///
    /// # Errors
    /// [`FeetechError`] of the first servo that did not; to switch off, the others are tried
    /// nevertheless.
    pub async fn enable_torque_async(&mut self, is_on: bool) -> Result<(), FeetechError> {
        let mut result = Ok(());
        for id in self.ids {
            result = result.and(self.write_async(id, TORQUE_ENABLE, &[is_on.into()]).await);
            if is_on {
                result?;
            }
        }
        result
    }

    /// Does what [`Self::write`] does, over `embedded-io-async`.
    ///
    /// # Errors
    /// [`FeetechError`].
    pub async fn write_async(
        &mut self,
        id: u8,
        address: u8,
        data: &[u8],
    ) -> Result<(), FeetechError> {
        self.send_async(&Packet::write(id, address, data)?).await?;
        let received = self.receive_async::<0>(id, &mut Parser::new()).await;
        received.map(|[]| ())
    }

    /// Does what [`Self::read`] does, over `embedded-io-async`.
    ///
    /// # Errors
    /// [`FeetechError`].
    pub async fn read_async<const L: usize>(
        &mut self,
        id: u8,
        address: u8,
    ) -> Result<[u8; L], FeetechError> {
        let length = u8::try_from(L).map_err(|_| FeetechError::TooLong)?;
        self.send_async(&Packet::read(id, address, length)?).await?;
        self.receive_async(id, &mut Parser::new()).await
    }

    async fn send_async(&mut self, packet: &Packet) -> Result<(), FeetechError> {
        for _ in 0..MOST_NOISE {
            if !self.port.read_ready().map_err(port_error)? || self.byte_async().await?.is_none() {
                break;
            }
        }
        let sent = self.port.write_all(packet.bytes()).await;
        sent.map_err(port_error)?;
        self.port.flush().await.map_err(port_error)?;
        if self.has_echo {
            for sent in packet.bytes() {
                if self.byte_async().await? != Some(*sent) {
                    return Err(FeetechError::Echo);
                }
            }
        }
        Ok(())
    }

    async fn receive_async<const L: usize>(
        &mut self,
        id: u8,
        parser: &mut Parser,
    ) -> Result<[u8; L], FeetechError> {
        loop {
            if let Some(reply) = next_reply(self.byte_async().await, parser, id)? {
                return parameters(&reply, id);
            }
        }
    }

    async fn byte_async(&mut self) -> Result<Option<u8>, FeetechError> {
        let mut byte = [0];
        let read = self.port.read(&mut byte).await.map_err(port_error)?;
        Ok((read > 0).then_some(byte[0]))
    }
}

#[cfg(test)]
mod tests {
    use std::collections::VecDeque;
    use std::vec::Vec;

    use embedded_io::{ErrorKind, ErrorType};

    use super::*;
    use crate::asynch::ready;
    use crate::{Direction, JointMapping, JointRange};

    /// A port whose bytes and errors are written down.
    #[derive(Clone, Debug, Default, PartialEq)]
    struct Script {
        sent: Vec<u8>,
        answers: VecDeque<Result<u8, ErrorKind>>,
        stale: usize,
    }

    impl ErrorType for Script {
        type Error = ErrorKind;
    }

    impl ReadReady for Script {
        fn read_ready(&mut self) -> Result<bool, ErrorKind> {
            Ok(self.stale > 0)
        }
    }

    impl embedded_io::Read for Script {
        fn read(&mut self, bytes: &mut [u8]) -> Result<usize, ErrorKind> {
            self.stale = self.stale.saturating_sub(1);
            let answer = self.answers.pop_front();
            bytes[0] = answer.unwrap_or(Err(ErrorKind::TimedOut))?;
            Ok(1)
        }
    }

    impl embedded_io::Write for Script {
        fn write(&mut self, bytes: &[u8]) -> Result<usize, ErrorKind> {
            self.sent.extend(bytes);
            Ok(bytes.len())
        }
        fn flush(&mut self) -> Result<(), ErrorKind> {
            Ok(())
        }
    }

    impl Read for Script {
        async fn read(&mut self, bytes: &mut [u8]) -> Result<usize, ErrorKind> {
            embedded_io::Read::read(self, bytes)
        }
    }

    impl Write for Script {
        async fn write(&mut self, bytes: &[u8]) -> Result<usize, ErrorKind> {
            embedded_io::Write::write(self, bytes)
        }
        async fn flush(&mut self) -> Result<(), ErrorKind> {
            Ok(())
        }
    }

    /// The servos 1 and 2 on a port with these answers, the first `stale` of which are there
    /// already.
    fn servos(answers: &[&[u8]], stale: usize) -> Servos<Script, 2> {
        let port = Script {
            answers: answers.concat().into_iter().map(Ok).collect(),
            stale,
            ..Script::default()
        };
        let reverse = JointMapping::new(3.0, Direction::Reverse, 2.0).unwrap();
        let range = JointRange::Within { lower: -1.0, upper: 1.0 };
        let reverse = reverse.with_range(range, 0.01).unwrap();
        Servos::new(port, [1, 2], [reverse; 2]).unwrap()
    }

    const FIRST: [u8; 8] = [0xff, 0xff, 1, 4, 0, 0, 0x0c, 0xee];
    const SECOND: [u8; 8] = [0xff, 0xff, 2, 4, 0, 0, 0x08, 0xf1];

    // It fails like the blocking one as well.
    #[test]
    fn the_async_bus_reads_like_the_blocking_one() {
        let wrong_sum = [0xff, 0xff, 1, 4, 0, 0, 0x0c, 0xef];
        let faulty = [0xff, 0xff, 1, 4, 0x20, 0, 0x0c, 0xce];
        let noise = [0x55; 200];
        let answers: [(&[&[u8]], usize, bool); 8] = [
            (&[&FIRST, &SECOND], 0, true),
            (&[&[1, 2, 3], &FIRST, &SECOND], 3, true),
            (&[&SECOND, &FIRST], 0, false),
            (&[&FIRST], 0, false),
            (&[&wrong_sum], 0, false),
            (&[&faulty], 0, false),
            (&[&noise], 0, false),
            (&[], 0, false),
        ];
        for (answers, stale, is_good) in answers {
            let (mut here, mut there) = (servos(answers, stale), servos(answers, stale));
            let found = ready(here.positions_async());
            assert_eq!(found.is_ok(), is_good, "{found:?}");
            assert_eq!(found, there.positions());
            assert_eq!(here.release(), there.release());
        }
    }

    #[test]
    fn an_echo_that_another_device_spoils_is_found() {
        let request = servos(&[], 0).request().unwrap();
        let spoilt: Vec<u8> = request.bytes().iter().map(|byte| byte ^ 4).collect();
        let mut servos = servos(&[&spoilt], 0).with_echo();
        assert_eq!(ready(servos.positions_async()), Err(FeetechError::Echo));
    }

    #[test]
    fn a_silent_servo_ends_enabling_but_not_disabling_torque() {
        for is_on in [true, false] {
            let (mut here, mut there) = (servos(&[], 0), servos(&[], 0));
            let found = ready(here.enable_torque_async(is_on));
            assert_eq!(found, Err(FeetechError::NoReply { id: 1 }));
            assert_eq!(found, there.enable_torque(is_on));
            let (here, there) = (here.release(), there.release());
            let packets = if is_on { 1 } else { 2 };
            assert_eq!(here.sent.len() % packets, 0);
            assert_eq!(here, there);
        }
    }

    #[test]
    fn the_asynchronous_bus_sends_what_the_blocking_one_does() {
        let confirmed = [0xff, 0xff, 1, 2, 0, 0xfc];
        let (mut here, mut there) = (servos(&[&confirmed], 0), servos(&[&confirmed], 0));
        // Servo 2 does not confirm; both are switched off nevertheless.
        let found = ready(here.enable_torque_async(false));
        assert_eq!(found, Err(FeetechError::NoReply { id: 2 }));
        assert_eq!(found, there.enable_torque(false));
        for goals in [[0.1, -0.2], [f32::NAN, 1e9]] {
            let found = ready(here.set_positions_async(&goals));
            assert_eq!(found, there.set_positions(&goals));
            let found = ready(here.set_duties_async(&goals));
            assert_eq!(found, there.set_duties(&goals));
        }
        let found = ready(here.read_async::<1>(1, 0x21));
        assert_eq!(found, there.read::<1>(1, 0x21));
        let (here, there) = (here.release(), there.release());
        assert!(!here.sent.is_empty());
        assert_eq!(here, there);
    }
}
