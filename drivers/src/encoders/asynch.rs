//! The encoders on a bus over `embedded-hal-async`: the transfers alone; state and decoding are the
//! blocking form's.

use embedded_hal_async::i2c::I2c;
use embedded_hal_async::spi::SpiDevice;

use super::as5047p::{As5047p, FrameError, READ_ANGLE, READ_ERRORS};
use super::as5600::{ADDRESS, As5600, As5600Error, RAW_ANGLE, STATUS, bus_error, decode_status};
use crate::asynch::JointEncoder;

impl<Spi: SpiDevice> JointEncoder for As5047p<Spi> {
    async fn start(&mut self) {
        self.start_async().await;
    }

    async fn sample(&mut self) -> Result<(), FrameError> {
        self.read_async().await.map(|_| ())
    }

    fn position(&self) -> f32 {
        self.angle()
    }
}

impl<Bus: I2c> JointEncoder for As5600<Bus> {
    async fn sample(&mut self) -> Result<(), As5600Error> {
        self.read_async().await.map(|_| ())
    }

    fn position(&self) -> f32 {
        self.angle()
    }
}

impl<Spi: SpiDevice> As5047p<Spi> {
    /// Does what [`Self::start`] does, over `embedded-hal-async`.
    pub async fn start_async(&mut self) {
        for command in [READ_ERRORS, READ_ANGLE] {
            let _ = self.spi.transfer_in_place(&mut command.to_be_bytes()).await;
        }
    }

    /// Does what [`Self::read`] does, over `embedded-hal-async`.
    ///
    /// # Errors
    /// [`FrameError`]; the count of turns is then unchanged.
    pub async fn read_async(&mut self) -> Result<f32, FrameError> {
        let mut frame = READ_ANGLE.to_be_bytes();
        let sent = self.spi.transfer_in_place(&mut frame).await;
        if let Err(before) = self.accept(&sent, frame) {
            let accepted = self.accept_otherwise(sent, frame, before);
            if !matches!(accepted, Ok(()) | Err(FrameError::LostTurn)) {
                self.start_async().await;
            }
            accepted?;
        }
        Ok(self.angle())
    }
}

impl<Bus: I2c> As5600<Bus> {
    /// Does what [`Self::check_magnet`] does, over `embedded-hal-async`.
    ///
    /// # Errors
    /// [`As5600Error`].
    pub async fn check_magnet_async(&mut self) -> Result<(), As5600Error> {
        let mut status = [0];
        self.bus.write_read(ADDRESS, &[STATUS], &mut status).await.map_err(bus_error)?;
        decode_status(status[0])
    }

    /// Does what [`Self::read_angle`] does, over `embedded-hal-async`.
    ///
    /// # Errors
    /// [`As5600Error::Bus`], [`As5600Error::LostTurn`]; the count of turns is then unchanged.
    pub async fn read_angle_async(&mut self) -> Result<f32, As5600Error> {
        let mut raw = [0; 2];
        let read = self.bus.write_read(ADDRESS, &[RAW_ANGLE], &mut raw).await;
        self.accept(read, raw)
    }

    /// Does what [`Self::read`] does, over `embedded-hal-async`.
    ///
    /// # Errors
    /// [`As5600Error`]; the count of turns is then unchanged.
    pub async fn read_async(&mut self) -> Result<f32, As5600Error> {
        let magnet = self.check_magnet_async().await;
        magnet.inspect_err(|_| self.turns.missed(1))?;
        self.read_angle_async().await
    }
}

#[cfg(test)]
mod tests {
    use core::convert::Infallible;
    use core::f32::consts::FRAC_PI_2;
    use std::vec;
    use std::vec::Vec;

    use dynamics_core::state::State;
    use embedded_hal_mock::eh1::{i2c, spi};
    use motion_control::law::Gains;
    use motion_control::limits::{Fault, MotionLimits, SafetyLimits};
    use motion_control::motion::{MotionController, MotionControllerConfig};
    use motion_control::reference::{Trajectory, WayPoint};
    use motion_control::safety::SupervisorConfig;

    use super::*;
    use crate::as5047p::{ERROR, RESOLUTION, encode, with_parity};
    use crate::asynch::ready;
    use crate::{ControlLoop, EncoderMapping, JointDrive, JointMapping, JointRange, Law, NoBrake};

    fn near_zero() -> EncoderMapping {
        let near = JointRange::Near(0.0);
        JointMapping::IDENTITY.with_range(near, 3e-3).unwrap()
    }

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
    fn the_async_as5047p_matches_the_blocking_one() {
        let frames = [
            (READ_ERRORS, 0),
            (READ_ANGLE, 0),
            (READ_ANGLE, encode(4096)),
            (READ_ANGLE, with_parity(ERROR)),
            (READ_ERRORS, 0),
            (READ_ANGLE, 0),
            (READ_ANGLE, encode(16_383)),
        ];
        let expected = [Ok(FRAC_PI_2), Err(FrameError::Flag), Ok(-crate::as5047p::RESOLUTION)];
        let mut encoder = As5047p::new(transfers(&frames), near_zero());
        ready(encoder.start_async());
        for angle in expected {
            assert_eq!(ready(encoder.read_async()), angle);
        }
        encoder.release().done();

        let mut encoder = As5047p::new(transfers(&frames), near_zero());
        encoder.start();
        for angle in expected {
            assert_eq!(encoder.read(), angle);
        }
        encoder.release().done();
    }

    #[test]
    fn the_async_as5600_matches_the_blocking_one() {
        let registers = |status, angle: [u8; 2]| {
            [
                i2c::Transaction::write_read(ADDRESS, vec![STATUS], vec![status]),
                i2c::Transaction::write_read(ADDRESS, vec![RAW_ANGLE], angle.to_vec()),
            ]
        };
        let absent = [i2c::Transaction::write_read(ADDRESS, vec![STATUS], vec![0])];
        let all = [&registers(0x20, [0x04, 0x00])[..], &absent, &registers(0x20, [0x04, 0x00])];
        let expected = [Ok(FRAC_PI_2), Err(As5600Error::MagnetAbsent), Ok(FRAC_PI_2)];
        let mut encoder = As5600::new(i2c::Mock::new(&all.concat()), near_zero());
        for angle in expected {
            assert_eq!(ready(encoder.read_async()), angle);
        }
        encoder.release().done();

        let mut encoder = As5600::new(i2c::Mock::new(&all.concat()), near_zero());
        for angle in expected {
            assert_eq!(encoder.read(), angle);
        }
        encoder.release().done();
    }

    /// Holds still by one N·m.
    struct One;

    impl Law<1> for One {
        fn feedforward(_: &State<f32, 1, 1>, (): &()) -> [f32; 1] {
            [1.0]
        }
    }

    struct Torque(f32);

    impl JointDrive for Torque {
        type Error = Infallible;
        type Setpoint = f32;
        fn setpoint(&self, torque: f32) -> f32 {
            torque
        }
        fn set(&mut self, torque: f32) -> Result<(), Infallible> {
            self.0 = torque;
            Ok(())
        }
    }

    #[test]
    fn the_asynchronous_loop_commands_what_the_blocking_one_does() {
        let frames = [
            (READ_ERRORS, 0),
            (READ_ANGLE, 0),
            (READ_ANGLE, encode(0)),
            (READ_ANGLE, 1),
            (READ_ERRORS, 0),
            (READ_ANGLE, 0),
            (READ_ANGLE, encode(1)),
        ];
        let buses = [(); 2].map(|()| transfers(&frames));
        let encoders = buses.clone();
        let [first, second] = encoders.map(|spi| [As5047p::new(spi, near_zero())]);
        let config = MotionControllerConfig {
            supervisor: SupervisorConfig {
                limits: SafetyLimits {
                    torque: [2.0],
                    rate: [2.0],
                    speed: [3.0],
                    lower: [-1.0],
                    upper: [1.0],
                },
                tick: 1e-3,
                resolution: RESOLUTION,
                ride_through_ticks: 5,
                hold_ticks: 5,
                reentry_ticks: 5,
            },
            observer_bandwidth: 250.0,
            decay_rate: 25.0,
            restart_distance: 0.1,
        };
        let points = [0, 100].map(|ticks| WayPoint { q: [0.0], qd: [0.0], ticks });
        let limits = MotionLimits { velocity: 1.0, acceleration: 1.0 };
        let path = Trajectory::new(&points, 1e-3, &[limits]).unwrap();
        let gains = Gains { kp: [10.0], kd: [1.0] };
        let controller = MotionController::new(config);
        let drive = || [Torque(0.0)];
        let mut other = ControlLoop::new(first, drive(), NoBrake, gains, controller, ());
        let new = ControlLoop::new_async(second, drive(), NoBrake, gains, controller, ());
        let mut control = ready(new);
        for fault in [None, Some(Fault::Encoder { joint: 0 }), None] {
            let telemetry = ready(control.tick_async::<One, _, ()>(&path, &()));
            assert_eq!(telemetry, other.tick::<One, _, ()>(&path, &()));
            assert_eq!(telemetry.status.fault, fault);
            assert_eq!(control.encoder_error(), other.encoder_error());
        }
        buses.into_iter().for_each(|mut bus| bus.done());
    }
}
