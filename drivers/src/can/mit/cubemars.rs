//! CubeMars: actuators of the series AK in MIT mode, over classic CAN.
//!
//! # Source
//! CubeMars, *AK Series Module Driver User Manual* V1.0.17 (12 March 2025), section 5.3: special
//! frames, layout, table of scales, temperature from −40 °C; section 5.2.1: error codes. The
//! ranges of K_p and K_d are those of its code.
//!
//! Drives are numbered 1 to 255. By the manual a reply has the identifier of the drive, which is
//! then `host`; firmware after Ben Katz's replies to another one, often 0. The first byte is the
//! drive's number. There is no frame that clears errors ([`CanError::Unknown`]), and no reply says
//! whether the drive is enabled.
//!
//! A position begins again at the end of its scale (TMotorCANControl). After power-up most of these
//! drives know the position of their rotor within a turn of it, which is a part of a turn of the
//! output: bring the joint to its zero and send [`Drive::set_zero`](super::Drive::set_zero).
//!
//! Public sources disagree:
//!
//! | what | here | other values |
//! |---|---|---|
//! | velocity of the AK60-6 | 45 rad/s: the manual since V1.0.6 | 50: TMotorCANControl |
//! | velocity of the AK80-9 | 50 rad/s: the manual | 25.64, 22.5 in older firmware: mini-cheetah-tmotor-python-can |
//! | position of the AK80-6 | ±12.5 rad: the manual | ±95.5 in firmware V1.0 |
//! | counts of a command | 2ᵇ − 1: Katz, all other drivers, the manual's reply | 2ᵇ in the manual's command, which overflows at its end |
//! | error 6 | power stage too hot: the manual | phase currents unbalanced: TMotorCANControl |

use embedded_can::Frame;

use super::protocol::{self, Address, Feedback, Maker, Protocol, Special};
use super::{Drive, Scale};
use crate::can::frame::{CanError, Component};

/// ±50 rad/s, ±65 N·m.
pub const AK10_9: Scale = scale(50.0, 65.0);
/// ±45 rad/s, ±15 N·m.
pub const AK60_6: Scale = scale(45.0, 15.0);
/// ±50 rad/s, ±25 N·m.
pub const AK70_10: Scale = scale(50.0, 25.0);
/// ±76 rad/s, ±12 N·m.
pub const AK80_6: Scale = scale(76.0, 12.0);
/// ±37.5 rad/s, ±32 N·m.
pub const AK80_8: Scale = scale(37.5, 32.0);
/// ±50 rad/s, ±18 N·m.
pub const AK80_9: Scale = scale(50.0, 18.0);
/// ±8 rad/s, ±144 N·m.
pub const AK80_64: Scale = scale(8.0, 144.0);

const fn scale(velocity: f32, torque: f32) -> Scale {
    Scale { position: 12.5, velocity, torque, kp: 500.0, kd: 5.0 }
}

/// A CubeMars actuator.
///
/// ```
/// use embedded_can::Frame;
/// use joint_drivers::{JointMapping, JointRange, can::{CanError, FdFrame}};
/// use joint_drivers::mit::cubemars::{AK70_10, CubeMars};
/// let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 5e-3)?;
/// let drive = CubeMars::new(3, 3, AK70_10, 24.8, mapping)?;
/// let enable: FdFrame = drive.enable()?;
/// assert_eq!(enable.data(), [0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xfc]);
/// assert_eq!(drive.clear_errors::<FdFrame>(), Err(CanError::Unknown(0xfb)));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub type CubeMars = Drive<Identity>;

/// The identifiers of a CubeMars actuator.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Identity {
    id: u8,
    host: u16,
}

impl Maker for Identity {
    /// A turn of the rotor of the AK80-64.
    const START: f32 = 1.0 / 64.0;

    fn new(id: u8, host: u16) -> Result<Self, CanError> {
        (id != 0 && host <= 0x7ff).then_some(Self { id, host }).ok_or(CanError::Node)
    }
}

impl Protocol for Identity {
    const LACKS: &'static [Special] = &[Special::Clear, Special::Faults];

    fn address(&self) -> Address {
        Address::new(self.id, self.host)
    }

    fn decode<F: Frame>(&self, frame: &F) -> Result<Feedback, CanError> {
        let [id, rest @ ..] = protocol::standard_data(frame, self.host)?;
        if id != self.id {
            return Err(CanError::Identifier);
        }
        let [.., temperature, error] = rest;
        let status = match error {
            0 => Ok(()),
            1 => Err(CanError::OverTemperature(Component::Motor)),
            2 => Err(CanError::OverCurrent),
            3 => Err(CanError::OverVoltage),
            4 => Err(CanError::UnderVoltage),
            5 => Err(CanError::Encoder),
            6 => Err(CanError::OverTemperature(Component::Drive)),
            7 => Err(CanError::Overload),
            other => Err(CanError::Fault(other.into())),
        };
        Ok(Feedback::State {
            counts: protocol::unpack(rest),
            motor: Some(f32::from(temperature) - 40.0),
            drive: None,
            status: Some(status),
        })
    }
}
