//! Damiao: drives of the series DM-J in MIT mode, over classic CAN or CAN FD.
//!
//! The frame type decides which: a frame has 8 bytes in either. The bit rates are those of the
//! drive's register `can_br`.
//!
//! # Source
//! Damiao's manuals (dmBots/DM-J4310-2EC, V1.1; dmBots/DM-J4340-2EC, V1.0): identifiers, layout,
//! K_p to 500, K_d to 5, errors, temperatures, and that two encoders know the output shaft's
//! position within a turn after power-up. Damiao's library (dmBots/motor-control-routine, commit
//! 2a13f976): registers, the frames that query them. The frame that clears errors (0xFB), and that
//! the count begins again at the end of its scale: i2rt-robotics/i2rt; no manual says the latter.
//!
//! A reply has the identifier `host` (register MST_ID), and the low four bits of the drive's own
//! number in its first byte: drives are numbered 1 to 15, `host` is 0 to 0x7FF, from the factory 0.
//! A reply to a query of registers has a pattern that a disabled drive at 0x33, 0x55 or 0xAA counts
//! from the end of its scale has as well: such a feedback is refused.
//!
//! # Scales
//! PMAX, VMAX and TMAX are registers of the drive, of which the constants here are the usual
//! values. Public sources disagree, Damiao's own library with itself:
//!
//! | motor | here | other values |
//! |---|---|---|
//! | DM4340 | VMAX 10: `u2canfd` of Damiao's library, openarm_can, i2rt | 8: `u2can` of the same, LeRobot |
//! | DM6006 | TMAX 20: `u2can`, openarm_can, LeRobot | 12: `u2canfd` |
//! | DM8006 | TMAX 40: the same | 20: `u2canfd` |
//!
//! A TMAX that is too large here gives less torque than commanded, never more. Let the firmware
//! read the three and [`MODE`] before it enables a drive:
//! [`CanJoints::enable`](crate::CanJoints::enable) does, elsewhere [`Damiao::read_register`] and [`Damiao::check_register`].
//!
//! # Rotors and friction
//! A description of the links has neither. The table has both at the joint, for `<dynamics>` in the
//! URDF or `armature` in the MJCF, until an identification finds those of your arm:
//!
//! | motor | gear | rotor, kg·m² | Coulomb friction, N·m | viscous friction, N·m·s/rad |
//! |---|---|---|---|---|
//! | DM4310 | 10 | 1.8e-3 | 0.05 to 0.17 | 0.03 to 0.08 |
//! | DM4340 | 40 | 3.2e-2 | 0.17 to 0.4 | 0.6 to 0.8 |
//! | DM8009 | 9 | 1.58e-2 | 0.31 | 0.063 |
//!
//! Their sources are those of `dynamics_core::robots::OpenArm`; no source is known for the others.

use embedded_can::Frame;

use super::protocol::{self, Address, Feedback, Maker, Protocol};
use super::{Drive, Scale};
use crate::can::frame::{CanError, Component};

/// ±30 rad/s, ±10 N·m. The 48 V variant has ±50 rad/s.
pub const DM4310: Scale = scale(30.0, 10.0);
/// ±10 rad/s, ±28 N·m.
pub const DM4340: Scale = scale(10.0, 28.0);
/// ±45 rad/s, ±20 N·m.
pub const DM6006: Scale = scale(45.0, 20.0);
/// ±45 rad/s, ±40 N·m.
pub const DM8006: Scale = scale(45.0, 40.0);
/// ±45 rad/s, ±54 N·m.
pub const DM8009: Scale = scale(45.0, 54.0);

const fn scale(velocity: f32, torque: f32) -> Scale {
    Scale { position: 12.5, velocity, torque, kp: 500.0, kd: 5.0 }
}

/// The register of the time without a command after which the drive is disabled: a whole number of
/// 50 µs, zero for never.
pub const TIMEOUT: u8 = 9;
/// The register of the control mode, a whole number: 1 for MIT mode. In the others a drive enables
/// itself and answers, and does not obey a command of this driver.
pub const MODE: u8 = 10;
/// The register of [`Scale::position`], a float.
pub const PMAX: u8 = 21;
/// The register of [`Scale::velocity`], a float.
pub const VMAX: u8 = 22;
/// The register of [`Scale::torque`], a float.
pub const TMAX: u8 = 23;

/// The registers that are compared, in their order.
pub(super) const CHECKED: [u8; 4] = [PMAX, VMAX, TMAX, MODE];

/// The identifier of all accesses to registers.
pub(super) const REGISTERS: u16 = 0x7ff;
pub(super) const READ: u8 = 0x33;
const WRITE: u8 = 0x55;
const STORE: u8 = 0xaa;

/// A Damiao drive.
///
/// ```
/// use embedded_can::{Frame, StandardId};
/// use joint_drivers::{JointMapping, JointRange, can::{CanError, FdFrame}};
/// use joint_drivers::mit::damiao::{DM8009, Damiao, TMAX};
/// let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 5e-3)?;
/// let drive = Damiao::new(1, 0x11, DM8009, 40.0, mapping)?;
/// let query: FdFrame = drive.read_register(TMAX)?;
/// assert_eq!((query.id(), query.data()), (StandardId::new(0x7ff).unwrap().into(), &[1, 0, 0x33, 23, 0, 0, 0, 0][..]));
/// // A drive whose torques are those of another motor is refused.
/// let [t0, t1, t2, t3] = 40.0_f32.to_le_bytes();
/// let reply = FdFrame::new(StandardId::new(0x11).unwrap(), &[1, 0, 0x33, 23, t0, t1, t2, t3]).unwrap();
/// assert_eq!(drive.check_register(&reply), Err(CanError::Scale(TMAX)));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
pub type Damiao = Drive<Identity>;

/// The identifiers of a Damiao drive.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Identity {
    id: u8,
    host: u16,
}

impl Damiao {
    /// The frame that reads a register: [`PMAX`], [`VMAX`], [`TMAX`], [`TIMEOUT`] or another one.
    ///
    /// # Errors
    /// [`CanError::Length`].
    pub fn read_register<F: Frame>(&self, register: u8) -> Result<F, CanError> {
        self.query(register)
    }

    /// The register in a reply, and its value.
    ///
    /// ```
    /// # use embedded_can::{Frame, StandardId};
    /// # use joint_drivers::{JointMapping, JointRange, can::FdFrame};
    /// # use joint_drivers::mit::damiao::{DM4310, Damiao, TIMEOUT};
    /// # let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 5e-3)?;
    /// # let drive = Damiao::new(1, 0x11, DM4310, 7.0, mapping)?;
    /// let reply = FdFrame::new(StandardId::new(0x11).unwrap(), &[1, 0, 0x33, 9, 0x40, 0x1f, 0, 0]).unwrap();
    /// let (register, value) = drive.register(&reply)?;
    /// assert_eq!((register, u32::from_le_bytes(value)), (TIMEOUT, 8000)); // 0.4 s
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`CanError::Identifier`] for another drive, host or message, [`CanError::Remote`],
    /// [`CanError::Short`], [`CanError::Length`].
    pub fn register<F: Frame>(&self, frame: &F) -> Result<(u8, [u8; 4]), CanError> {
        self.value(frame)
    }

    /// The register in a reply, if its value is that of this driver's scale.
    ///
    /// # Errors
    /// As [`Self::register`]. [`CanError::Scale`]: the drive has another scale.
    /// [`CanError::Mode`]: it is not in MIT mode. [`CanError::Missing`]: none of [`PMAX`],
    /// [`VMAX`], [`TMAX`] and [`MODE`].
    pub fn check_register<F: Frame>(&self, frame: &F) -> Result<u8, CanError> {
        self.checked(frame)
    }
}

impl Maker for Identity {
    fn new(id: u8, host: u16) -> Result<Self, CanError> {
        let is_one = (1..=15).contains(&id) && host <= 0x7ff;
        is_one.then_some(Self { id, host }).ok_or(CanError::Node)
    }
}

impl Protocol for Identity {
    fn address(&self) -> Address {
        Address { is_damiao: true, ..Address::new(self.id, self.host) }
    }

    fn decode<F: Frame>(&self, frame: &F) -> Result<Feedback, CanError> {
        let [first, rest @ ..] = protocol::standard_data(frame, self.host)?;
        let is_register = matches!(rest, [0, READ | WRITE | STORE, ..]) && first >> 4 == 0;
        if first & 0x0f != self.id || is_register {
            return Err(CanError::Identifier);
        }
        let status = match first >> 4 {
            0x0 => Err(CanError::NotReady),
            0x1 => Ok(()),
            0x8 => Err(CanError::OverVoltage),
            0x9 => Err(CanError::UnderVoltage),
            0xa => Err(CanError::OverCurrent),
            0xb => Err(CanError::OverTemperature(Component::Drive)),
            0xc => Err(CanError::OverTemperature(Component::Motor)),
            0xd => Err(CanError::LostCommunication),
            0xe => Err(CanError::Overload),
            other => Err(CanError::Fault(other.into())),
        };
        let [.., drive, motor] = rest;
        Ok(Feedback::State {
            counts: protocol::unpack(rest),
            motor: Some(motor.into()),
            drive: Some(drive.into()),
            status: Some(status),
        })
    }
}
