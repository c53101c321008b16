//! MIT mode: a spring, a damper and a torque in one CAN frame, as in the MIT Mini Cheetah.
//!
//! ```text
//! τ = K_p (q_d − q) + K_d (q̇_d − q̇) + τ_ff
//! ```
//!
//! The drive computes it at its own rate, 10 kHz and more. Drives differ in the scales of their
//! counts ([`Scale`]), in their identifiers and in their errors: [`damiao`], [`robstride`] and
//! [`cubemars`]. The shaft of a mapping is the output shaft of the drive.
//!
//! # Source
//! Ben Katz, *A low cost modular actuator for dynamic robots* (MIT, 2018) and his documentation of
//! the motor controller: position in 16 bits, velocity, K_p, K_d and torque in 12 each, from −most
//! to +most, or from zero to the most of a gain, over 2ᵇ − 1 counts.
//!
//! # Resolution
//! A quantity becomes the nearest count. Both ends of a scale are counts, so that none is zero:
//! zero torque is sent as +½ count, which is `torque` / 4095 N·m (2.4 mN·m of ±10 N·m), and a
//! velocity likewise. A gain of zero is exact.
//!
//! # Turns
//! After power-up a drive with an absolute encoder at its output knows its position within a turn
//! of it, and then counts the turns in its own memory. The count of a reply begins again at the
//! other end of its scale: this driver adds the whole scales. The ends themselves are refused
//! ([`CanError::Range`]), since a drive that stops its count there says nothing. Beyond the first
//! scale the gains of a command are zero: no count stands for such a position.
//!
//! The drive loses its turns with its supply. After ticks without a reply ([`Drive::missed`], which
//! [`CanJoints`](crate::CanJoints) calls) in which the shaft can have turned by half a turn, or if
//! the count fits both a drive that went on and one that began anew at another place, the position
//! is [`CanError::LostTurn`] until [`Drive::place_near`]. A joint of
//! [`JointRange::Within`](crate::JointRange) whose drive has not left its first scale is known after
//! any gap, but for the drives of CubeMars, which know a part of a turn alone. Between two replies
//! without a gap the shaft turns by less than half a turn.
//!
//! # Cost
//! | | flops | divisions |
//! |---|---|---|
//! | [`Drive::set_torque`] | 6 | 0 |
//! | [`Drive::command`] | 26 | 0 |
//! | [`Drive::command_at`] | 48 | 0 |
//! | [`Drive::reply`] | 23 | 0 |
//!
//! Comparisons and conversions are not counted; a joint on a circle has 6 more in the second and 12
//! in the third. [`Drive::new`] divides ten times.

use embedded_can::Frame;

use super::frame::{self, CanError};
use super::joint::{CanJoint, PdCanJoint, Report};
use super::turns::ShaftTurns;
use crate::encoder_mapping::within_turn;
use crate::{EncoderMapping, MappingError};

mod any;
pub mod cubemars;
pub mod damiao;
pub(crate) mod protocol;
pub mod robstride;

pub use crate::drives::pd::{Setpoint, SetpointAt};
pub use any::AnyDrive;
use protocol::{Address, Counts, Feedback, Maker, Protocol, Special};

/// The greatest quantities that the counts of a drive stand for, at its output shaft.
///
/// ```
/// use joint_drivers::mit::{Scale, damiao};
/// // A drive whose register VMAX was changed.
/// let fast = Scale { velocity: 50.0, ..damiao::DM4310 };
/// assert_eq!((fast.position, fast.torque), (12.5, 10.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// The position at the last count, rad; the first one is −`position`.
    pub position: f32,
    /// The velocity at the last count, rad/s; the first one is −`velocity`.
    pub velocity: f32,
    /// The torque at the last count, N·m; the first one is −`torque`.
    pub torque: f32,
    /// The K_p at the last count, N·m/rad; the first one is zero.
    pub kp: f32,
    /// The K_d at the last count, N·m·s/rad; the first one is zero.
    pub kd: f32,
}

/// The state of a drive, mapped to the joint.
///
/// ```
/// # use embedded_can::{Frame, StandardId};
/// # use joint_drivers::{JointMapping, JointRange, can::FdFrame};
/// use joint_drivers::mit::{Reply, cubemars::{AK80_9, CubeMars}};
/// # let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 5e-3)?;
/// # let mut drive = CubeMars::new(1, 1, AK80_9, 18.0, mapping)?;
/// # let frame = FdFrame::new(StandardId::new(1).unwrap(), &[1, 0x80, 0, 0x80, 0x08, 0, 70, 0]).unwrap();
/// let Reply::State(state) = drive.reply(&frame)? else { panic!("another message") };
/// assert_eq!(state.motor_temperature, Some(30.0));
/// assert_eq!(state.status, Some(Ok(())));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriveState {
    /// The position of the joint, rad.
    pub position: f32,
    /// The velocity of the joint, rad/s.
    pub velocity: f32,
    /// The torque of the joint, N·m.
    pub torque: f32,
    /// The temperature of the winding, °C, if the protocol has it.
    pub motor_temperature: Option<f32>,
    /// The temperature of the power stage, °C, if the protocol has it.
    pub drive_temperature: Option<f32>,
    /// Whether the drive delivers torque, or why it does not, if the protocol says so here.
    pub status: Option<Result<(), CanError>>,
}

/// A message of a drive.
///
/// ```
/// # use embedded_can::{ExtendedId, Frame};
/// # use joint_drivers::{JointMapping, JointRange, can::{CanError, FdFrame}};
/// use joint_drivers::mit::{Reply, robstride::{RS03, RobStride}};
/// # let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 5e-3)?;
/// let mut drive = RobStride::new(0x7f, 0xfd, RS03, 60.0, mapping)?;
/// // The fault frame of motor 0x7f: bit 3.
/// let frame = FdFrame::new(ExtendedId::new(0x1500_7ffd).unwrap(), &[8, 0, 0, 0, 0, 0, 0, 0]).unwrap();
/// assert_eq!(drive.reply(&frame)?, Reply::Status(Err(CanError::OverVoltage)));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Reply {
    /// The feedback.
    State(DriveState),
    /// The faults alone.
    Status(Result<(), CanError>),
}

/// One joint's drive in MIT mode, of the protocol `P`: [`damiao::Damiao`],
/// [`robstride::RobStride`], [`robstride::RobStrideMit`] and [`cubemars::CubeMars`].
///
/// ```
/// use embedded_can::{Frame, StandardId};
/// use joint_drivers::{JointMapping, JointRange, can::FdFrame};
/// use joint_drivers::mit::{Reply, Setpoint, damiao::{DM4310, Damiao}};
/// let mapping = JointMapping::IDENTITY.with_range(JointRange::Within { lower: -2.0, upper: 2.0 }, 5e-3)?;
/// let mut drive = Damiao::new(1, 0x11, DM4310, 7.0, mapping)?;
/// // Enabled, 0 rad, 0 rad/s, 1 N·m, 31 °C at the power stage and 25 °C at the winding.
/// let data = [0x11, 0x80, 0x00, 0x80, 0x08, 0xcc, 31, 25];
/// let reply = FdFrame::new(StandardId::new(0x11).unwrap(), &data).unwrap();
/// let Reply::State(state) = drive.reply(&reply)? else { panic!("another message") };
/// assert!(state.position.abs() < 2e-4 && (state.torque - 1.0).abs() < 5e-3);
/// let hold = Setpoint { position: 0.5, kp: 40.0, kd: 1.0, ..Setpoint::default() };
/// let command: FdFrame = drive.command(&hold)?;
/// assert_eq!(command.data(), [0x85, 0x1e, 0x80, 0x01, 0x48, 0x33, 0x38, 0x00]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive<P> {
    protocol: P,
    axes: Axes,
    /// The count of no velocity.
    middle: u16,
    most: f32,
    turns: ShaftTurns,
    last: Option<Place>,
    /// How many registers of the scale and the mode are right, and why the next one is not.
    checked: u8,
    differs: Option<CanError>,
}

/// The place of the joint in the last reply.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    /// rad or m at the joint.
    joint: f32,
    /// rad at the shaft, with the whole scales that the count lacks.
    shaft: f32,
}

impl<P: Maker> Drive<P> {
    /// The drive `id` that replies to `host`, whose counts stand for `scale`, and that delivers at
    /// most `most` N·m at the joint.
    ///
    /// The ranges of `id` and `host` are those of the protocol.
    ///
    /// # Errors
    /// [`CanError::Node`]. [`CanError::Torque`]: not above zero, or above the scale.
    /// [`CanError::NotFinite`]: the scale has a quantity that is not a positive number.
    pub fn new(
        id: u8,
        host: u16,
        scale: Scale,
        most: f32,
        mapping: EncoderMapping,
    ) -> Result<Self, CanError> {
        let protocol = P::new(id, host)?;
        let axes = Axes::new(&scale, P::TOP)?;
        frame::check_most(most, mapping.mapping())?;
        let at_shaft = mapping.mapping().shaft_torque(most).map_err(not_finite)?;
        // As much as rounding makes of a limit that is the scale's own.
        if at_shaft.abs() > scale.torque * (1.0 + 4.0 * f32::EPSILON) {
            return Err(CanError::Torque);
        }
        let period = P::PERIOD.unwrap_or(2.0 * scale.position);
        let turns = ShaftTurns::in_radians(mapping, period, P::START);
        let (last, checked, differs) = (None, 0, None);
        let middle = const { above_half(P::TOP) };
        Ok(Self { protocol, axes, middle, most, turns, last, checked, differs })
    }
}

impl<P: Protocol> Drive<P> {
    /// Takes the joint to be at `position` rad or m: the next reply is within half a turn of the
    /// output shaft from there.
    ///
    /// # Errors
    /// [`MappingError::Range`]; nothing is changed.
    pub fn place_near(&mut self, position: f32) -> Result<(), MappingError> {
        self.turns.place_near(position)?;
        // No command of a position before the next reply.
        self.last = None;
        Ok(())
    }

    /// Notes this many ticks without a reply: the drive may have lost its supply, and its turns.
    pub fn missed(&mut self, ticks: u32) {
        self.turns.missed(ticks);
    }

    /// The frame that lets the drive deliver torque: that of the last command, send one of zero
    /// before.
    ///
    /// # Errors
    /// [`CanError::Length`].
    pub fn enable<F: Frame>(&self) -> Result<F, CanError> {
        self.protocol.special(Special::Enable)
    }

    /// The frame that takes the torque from the drive.
    ///
    /// # Errors
    /// [`CanError::Length`].
    pub fn disable<F: Frame>(&self) -> Result<F, CanError> {
        self.protocol.special(Special::Disable)
    }

    /// The frame that makes the present position the zero of the drive. Send it while the drive is
    /// disabled, and make this driver anew: it counts from the old zero.
    ///
    /// # Errors
    /// [`CanError::Length`].
    pub fn set_zero<F: Frame>(&self) -> Result<F, CanError> {
        self.protocol.special(Special::Zero)
    }

    /// The frame that clears the faults of the drive.
    ///
    /// # Errors
    /// [`CanError::Length`]. [`CanError::Unknown`]: the protocol has no such frame.
    pub fn clear_errors<F: Frame>(&self) -> Result<F, CanError> {
        self.protocol.special(Special::Clear)
    }

    /// The frame that asks for the faults: [`Reply::Status`].
    ///
    /// # Errors
    /// [`CanError::Length`]. [`CanError::Unknown`]: the protocol has no such frame, since each
    /// reply has the faults.
    pub fn read_faults<F: Frame>(&self) -> Result<F, CanError> {
        self.protocol.special(Special::Faults)
    }

    /// A torque in N·m at the joint, limited to the greatest, with zero gains; NaN becomes zero
    /// torque.
    ///
    /// # Errors
    /// [`CanError::Length`].
    pub fn set_torque<F: Frame>(&self, torque: f32) -> Result<F, CanError> {
        self.protocol.command(&self.torque_alone(torque)?)
    }

    /// A spring, a damper and a feed-forward torque, which is limited to the greatest.
    ///
    /// Velocity and gains are limited to their scales. The gains are zero if a quantity is not
    /// finite or a gain is below zero, if the position is not within the scale, and before the first
    /// reply, since the turn of the joint is not known. A torque of NaN is zero torque with zero
    /// gains.
    ///
    /// # Errors
    /// [`CanError::Length`].
    pub fn command<F: Frame>(&self, setpoint: &Setpoint) -> Result<F, CanError> {
        let mut counts = self.torque_alone(setpoint.torque)?;
        if let Some(pd) = self.pd(setpoint) {
            counts = Counts { torque: counts.torque, ..pd };
        }
        self.protocol.command(&counts)
    }

    /// A spring and a damper, and the torque that makes the drive's sum that of the setpoint at the
    /// measured state: limited to the greatest, and exact within half a count of torque, since it
    /// is computed from the counts of the others.
    ///
    /// The gains are zero where [`Self::command`] makes them zero, and where the torque that is
    /// left is beyond the scale: a limited one would make another sum. Until the next command the
    /// sum changes with the state, by no more than the drive's own limit allows.
    ///
    /// # Errors
    /// [`CanError::Length`].
    pub fn command_at<F: Frame>(&self, setpoint: &SetpointAt) -> Result<F, CanError> {
        let alone = self.torque_alone(setpoint.sum.torque)?;
        let counts = self.pd(&setpoint.sum).and_then(|pd| self.complete(pd, setpoint));
        self.protocol.command(&counts.unwrap_or(alone))
    }

    /// The message of a frame, mapped to the joint. In the first reply the joint is where the
    /// mapping says that it can be.
    ///
    /// # Errors
    /// [`CanError`]: another drive or host, in the identifier or in the data, a remote frame, a
    /// frame of another length, a value that the protocol does not have, a position at the end of
    /// its scale, or one that is not finite. The count of turns is then unchanged.
    pub fn reply<F: Frame>(&mut self, frame: &F) -> Result<Reply, CanError> {
        let (feedback, [position, velocity, torque]) = match self.protocol.decode(frame)? {
            Feedback::Status(status) => return Ok(Reply::Status(status)),
            Feedback::State { counts, motor, drive, status } => ((motor, drive, status), counts),
        };
        let position = self.position(position)?;
        let mapping = self.turns.mapping.mapping();
        let velocity = mapping.velocity(self.axes.velocity.value(velocity)).map_err(not_finite)?;
        let torque = mapping.torque(self.axes.torque.value(torque)).map_err(not_finite)?;
        let (motor_temperature, drive_temperature, status) = feedback;
        let state =
            DriveState { position, velocity, torque, motor_temperature, drive_temperature, status };
        Ok(Reply::State(state))
    }

    /// The register of this driver's scale or mode in a reply, if its value is the same.
    fn checked<F: Frame>(&self, frame: &F) -> Result<u8, CanError> {
        let (register, value) = self.value(frame)?;
        let most = match register {
            damiao::MODE => {
                let is_it = u32::from_le_bytes(value) == 1;
                return is_it.then_some(register).ok_or(CanError::Mode(value[0]));
            }
            damiao::PMAX => self.axes.position.most,
            damiao::VMAX => self.axes.velocity.most,
            damiao::TMAX => self.axes.torque.most,
            other => return Err(CanError::Missing(other.into())),
        };
        // As a register says that was written as a decimal number.
        let off = (f32::from_le_bytes(value) - most).abs();
        if off <= 1e-6 * most { Ok(register) } else { Err(CanError::Scale(register)) }
    }

    /// The register in a reply, and its value.
    fn value<F: Frame>(&self, frame: &F) -> Result<(u8, [u8; 4]), CanError> {
        let Address { id: own, host, is_damiao, .. } = self.protocol.address();
        let host = host.filter(|_| is_damiao).ok_or(CanError::Identifier)?;
        match protocol::standard_data(frame, host)? {
            [id, 0, damiao::READ, register, value @ ..] if id == own => Ok((register, value)),
            _ => Err(CanError::Identifier),
        }
    }

    /// Whether frames of this drive and another cannot be told apart.
    pub(crate) fn clashes(&self, other: &Self) -> bool {
        let [own, other] = [self, other].map(|drive| drive.protocol.address());
        own.is_taken_by(&other) || other.is_taken_by(&own)
    }

    /// The next register of the scale and the mode to be asked for, with the reason.
    pub(crate) fn unchecked(&self) -> Result<(), (u8, CanError)> {
        let next = damiao::CHECKED.get(usize::from(self.checked));
        let Some(&next) = next.filter(|_| self.protocol.address().is_damiao) else { return Ok(()) };
        Err((next, self.differs.unwrap_or(CanError::Missing(next.into()))))
    }

    pub(crate) fn query<F: Frame>(&self, register: u8) -> Result<F, CanError> {
        let id = self.protocol.address().id;
        protocol::standard(damiao::REGISTERS, &[id, 0, damiao::READ, register, 0, 0, 0, 0])
    }

    /// The joint's position at a count, rad: with the scales and turns that the count lacks.
    #[inline]
    fn position(&mut self, count: u16) -> Result<f32, CanError> {
        if count == 0 || count == u16::MAX {
            return Err(CanError::Range);
        }
        let followed = self.turns.follow(self.axes.position.value(count));
        // Without a turn there is no count of a position to be commanded.
        self.last = followed.ok().map(|[joint, shaft]| Place { joint, shaft });
        followed.map(|[joint, _]| joint)
    }

    /// The counts of a torque with zero gains.
    fn torque_alone(&self, torque: f32) -> Result<Counts, CanError> {
        let torque = frame::limit(torque, self.most);
        let at_shaft = self.turns.mapping.mapping().shaft_torque(torque).map_err(not_finite)?;
        Ok(Counts {
            position: const { above_half(u16::MAX) },
            velocity: self.middle,
            kp: 0,
            kd: 0,
            torque: self.axes.torque.count(at_shaft),
        })
    }

    /// The counts of the spring and the damper, if they can be sent.
    fn pd(&self, setpoint: &Setpoint) -> Option<Counts> {
        let Setpoint { position, velocity, kp, kd, torque } = *setpoint;
        let mapping = self.turns.mapping.mapping();
        let position = self.shaft_at(position)?;
        let velocity = velocity * mapping.shaft_per_joint();
        let count = self.axes.position.count(position);
        // The ends of the scale are what a position beyond it becomes, and the start of the frames
        // without quantities.
        // An infinite gain has no counterpart at the shaft; NaN is not above zero.
        let is_sent = (count != 0 && count != u16::MAX)
            && (position.is_finite() && velocity.is_finite())
            && (kp >= 0.0 && kd >= 0.0 && !torque.is_nan());
        if !is_sent {
            return None;
        }
        // A gain of the joint is the square of the ratio times that of the shaft.
        let at_shaft = |gain| mapping.shaft_torque(mapping.shaft_torque(gain).ok()?).ok();
        Some(Counts {
            position: count,
            velocity: self.axes.velocity.count(velocity),
            kp: self.axes.kp.count(at_shaft(kp)?),
            kd: self.axes.kd.count(at_shaft(kd)?),
            torque: 0,
        })
    }

    /// The counts with the torque that spring and damper leave, if it is within its scale.
    fn complete(&self, counts: Counts, setpoint: &SetpointAt) -> Option<Counts> {
        let Axes { position, velocity, torque, kp, kd } = &self.axes;
        let mapping = self.turns.mapping.mapping();
        let sum = mapping.shaft_torque(frame::limit(setpoint.sum.torque, self.most)).ok()?;
        let left = SetpointAt {
            sum: Setpoint {
                position: position.value(counts.position),
                velocity: velocity.value(counts.velocity),
                kp: kp.value(counts.kp),
                kd: kd.value(counts.kd),
                torque: sum,
            },
            position: self.shaft_at(setpoint.position)?,
            velocity: setpoint.velocity * mapping.shaft_per_joint(),
        };
        let left = left.feedforward();
        // False for NaN, too.
        (left.abs() <= torque.most).then(|| Counts { torque: torque.count(left), ..counts })
    }

    /// The angle of the drive's shaft, in its own count, where the joint is at `joint`; a joint on
    /// a circle has it within half a turn from the last reply.
    fn shaft_at(&self, joint: f32) -> Option<f32> {
        let last = self.last?;
        let moved = joint - last.joint;
        let is_endless =
            self.turns.mapping.is_circle() || self.turns.mapping.turns_of_circle().is_some();
        let moved = if is_endless { within_turn(moved) } else { moved };
        Some(last.shaft + moved * self.turns.mapping.mapping().shaft_per_joint())
    }
}

impl<P> AsRef<Self> for Drive<P> {
    fn as_ref(&self) -> &Self {
        self
    }
}

impl<P: Protocol> CanJoint for Drive<P> {
    fn command<F: Frame>(&self, torque: f32) -> Result<F, CanError> {
        self.set_torque(torque)
    }

    fn missed(&mut self, ticks: u32) {
        self.missed(ticks);
    }

    fn place_near(&mut self, position: f32) -> Result<(), MappingError> {
        self.place_near(position)
    }

    fn clear_errors<F: Frame>(&self) -> Result<F, CanError> {
        self.clear_errors()
    }

    fn set_zero<F: Frame>(&mut self) -> Result<F, CanError> {
        let frame = Self::set_zero(self)?;
        self.turns.zeroed();
        self.last = None;
        Ok(frame)
    }

    #[inline]
    fn report<F: Frame>(&mut self, frame: &F) -> Result<Report, CanError> {
        Ok(match self.protocol.decode(frame)? {
            Feedback::State { counts: [position, ..], status, .. } => {
                Report { position: Some(self.position(position)?), delivers: status }
            }
            Feedback::Status(status) => Report { position: None, delivers: Some(status) },
        })
    }

    #[cold]
    fn learn<F: Frame>(&mut self, frame: &F) -> bool {
        let Ok((register, _)) = self.value(frame) else { return false };
        let checked = self.checked(frame);
        let is_asked = self.unchecked().is_err_and(|(next, _)| next == register);
        if is_asked && !matches!(checked, Err(CanError::Missing(_))) {
            self.differs = checked.err();
            self.checked += u8::from(checked.is_ok());
        }
        true
    }
}

impl<P: Protocol> PdCanJoint for Drive<P> {
    fn pd_command<F: Frame>(&self, setpoint: &SetpointAt) -> Result<F, CanError> {
        self.command_at(setpoint)
    }
}

fn not_finite(_: MappingError) -> CanError {
    CanError::NotFinite
}

/// The count of zero, of which the last is `top`: half a count above it.
const fn above_half(top: u16) -> u16 {
    top / 2 + 1
}

/// The counts of a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Axis {
    most: f32,
    per_unit: f32,
    per_count: f32,
    /// The count of zero: half of the last one, or zero for a gain.
    zero: f32,
}

impl Axis {
    fn gain(most: f32, top: u16) -> Self {
        let top = f32::from(top);
        Self { most, per_unit: top / most, per_count: most / top, zero: 0.0 }
    }

    fn signed(most: f32, top: u16) -> Self {
        let half = 0.5 * f32::from(top);
        Self { most, per_unit: half / most, per_count: most / half, zero: half }
    }

    /// The nearest count; that of the end for a quantity beyond it.
    fn count(&self, quantity: f32) -> u16 {
        // Within the range of u16: the conversion to u32 alone saturates in hardware, and makes zero
        // of what is below it.
        (frame::limit(quantity, self.most) * self.per_unit + (self.zero + 0.5)) as u32 as u16
    }

    fn value(&self, count: u16) -> f32 {
        (f32::from(count) - self.zero) * self.per_count
    }
}

/// The counts of all quantities.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Axes {
    position: Axis,
    velocity: Axis,
    torque: Axis,
    kp: Axis,
    kd: Axis,
}

impl Axes {
    fn new(scale: &Scale, top: u16) -> Result<Self, CanError> {
        let Scale { position, velocity, torque, kp, kd } = *scale;
        // Within them neither a count nor a count's share overflows.
        let is_one = |most: f32| (1e-3..=1e6).contains(&most);
        if ![position, velocity, torque, kp, kd].into_iter().all(is_one) {
            return Err(CanError::NotFinite);
        }
        Ok(Self {
            position: Axis::signed(position, u16::MAX),
            velocity: Axis::signed(velocity, top),
            torque: Axis::signed(torque, top),
            kp: Axis::gain(kp, top),
            kd: Axis::gain(kd, top),
        })
    }
}
