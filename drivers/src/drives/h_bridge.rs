//! H-bridges of which a PWM duty sets the torque of a current-controlled drive, or the voltage of a
//! plain bridge.
//!
//! # Source
//! No data sheet: the two modes are those of bridges with the inputs PHASE and ENABLE. In sign and
//! magnitude the PWM is at ENABLE and a pin at PHASE: the duty is the magnitude, the pin the sign,
//! and zero torque is a duty of zero. In locked antiphase the PWM is at PHASE and drives both
//! diagonals in turn: zero torque is a duty of 50 %.

use core::fmt;

use embedded_hal::digital::{self, OutputPin, PinState};
use embedded_hal::pwm::{self, SetDutyCycle};

use crate::{Direction, DriveFault, JointDrive};

/// The reason why a drive did not accept its torque.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DriveError {
    /// The PWM peripheral did not accept the duty.
    Pwm(pwm::ErrorKind),
    /// The direction pin did not accept its level.
    Pin(digital::ErrorKind),
    /// The full scale is not above zero, or not finite.
    FullScale,
}

impl fmt::Display for DriveError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pwm(kind) => write!(out, "a drive refused its duty: {kind}"),
            Self::Pin(kind) => write!(out, "a drive refused its direction: {kind}"),
            Self::FullScale => out.write_str("a drive's full scale is not a number above zero"),
        }
    }
}

impl core::error::Error for DriveError {}

impl DriveFault for DriveError {}

fn pwm_error<E: pwm::Error>(error: E) -> DriveError {
    DriveError::Pwm(error.kind())
}

/// The torque of a drive at a duty of 100 %.
///
/// ```
/// use joint_drivers::h_bridge::{DriveError, FullScale};
/// assert!(FullScale::new(150.0).is_ok()); // N·m
/// assert_eq!(FullScale::new(0.0), Err(DriveError::FullScale));
/// assert_eq!(FullScale::of([1.0, f32::NAN]), Err(DriveError::FullScale));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FullScale {
    /// 2³¹ per full scale: beyond it the conversion to an integer saturates.
    slope: f32,
}

impl FullScale {
    /// A full scale of `torque` N·m (or N).
    ///
    /// # Errors
    /// [`DriveError::FullScale`].
    pub const fn new(torque: f32) -> Result<Self, DriveError> {
        let slope = 2_147_483_648.0 / torque;
        if torque > 0.0 && torque.is_finite() && slope.is_finite() {
            Ok(Self { slope })
        } else {
            Err(DriveError::FullScale)
        }
    }

    /// The setpoints of `N` drives.
    ///
    /// # Errors
    /// [`DriveError::FullScale`] of any.
    pub fn of<const N: usize>(torques: [f32; N]) -> Result<[Self; N], DriveError> {
        let mut all = [Self { slope: 0.0 }; N];
        for (scale, torque) in all.iter_mut().zip(torques) {
            *scale = Self::new(torque)?;
        }
        Ok(all)
    }
}

/// From torques to shares of the full scale, in integers.
#[derive(Clone, Copy, Debug)]
struct Scale {
    /// 2³¹ per full scale, signed.
    slope: f32,
    /// The greatest duty of the timer.
    max: u16,
}

impl Scale {
    fn new(max: u16, full_scale: FullScale, direction: Direction) -> Self {
        let slope = direction.sign() * full_scale.slope;
        Self { slope, max }
    }

    /// The torque in 2⁻³¹ of the full scale, limited to it; zero for NaN.
    #[inline(always)]
    fn share(&self, torque: f32) -> i64 {
        i64::from((self.slope * torque) as i32)
    }
}

/// A drive of which 50 % duty is zero torque, 100 % the full scale and 0 % its opposite.
///
/// ```
/// use embedded_hal_mock::eh1::pwm::{Mock, Transaction};
/// use joint_drivers::{Direction, h_bridge::{FullScale, LockedAntiphase}};
/// let pwm = Mock::new(&[Transaction::max_duty_cycle(8400), Transaction::set_duty_cycle(6300)]);
/// let mut drive = LockedAntiphase::new(pwm, FullScale::new(150.0)?, Direction::Forward);
/// assert_eq!([-150.0, 0.0, 150.0].map(|tau| drive.duty(tau)), [0, 4200, 8400]);
/// assert_eq!([f32::NAN, 1e9, -1e9].map(|tau| drive.duty(tau)), [4200, 8400, 0]);
/// drive.set_torque(75.0)?;
/// drive.release().done();
/// # Ok::<(), joint_drivers::h_bridge::DriveError>(())
/// ```
#[derive(Debug)]
pub struct LockedAntiphase<Pwm> {
    pwm: Pwm,
    scale: Scale,
}

impl<Pwm: SetDutyCycle> LockedAntiphase<Pwm> {
    /// A drive that delivers `full_scale` at a duty of 100 %.
    ///
    /// The greatest duty is read once: a timer whose period changes needs a new drive. If it is
    /// odd, zero torque is half a count below 50 %. The duty is not set: before the first torque it
    /// is that of the peripheral.
    pub fn new(pwm: Pwm, full_scale: FullScale, direction: Direction) -> Self {
        let scale = Scale::new(pwm.max_duty_cycle(), full_scale, direction);
        Self { pwm, scale }
    }

    /// The duty of a torque, to the nearest, limited to the full scale; NaN becomes zero torque.
    ///
    /// Cost: the same instructions for all torques.
    #[inline(always)]
    pub fn duty(&self, torque: f32) -> u16 {
        // To the nearest: one multiplication that keeps the upper half.
        let relative = (self.scale.share(torque) * i64::from(self.scale.max) + (1 << 31)) >> 32;
        (i32::from(self.scale.max >> 1)).wrapping_add(relative as i32) as u16
    }

    /// Sets a duty of [`Self::duty`]. The two calls are separate, so that the arithmetic of all
    /// joints need not wait for the peripherals.
    ///
    /// # Errors
    /// [`DriveError::Pwm`].
    #[inline(always)]
    pub fn set(&mut self, duty: u16) -> Result<(), DriveError> {
        self.pwm.set_duty_cycle(duty).map_err(pwm_error)
    }

    /// Sets a torque in N·m, limited to the full scale; NaN becomes zero torque.
    ///
    /// # Errors
    /// [`DriveError::Pwm`].
    pub fn set_torque(&mut self, torque: f32) -> Result<(), DriveError> {
        self.set(self.duty(torque))
    }

    /// Returns the PWM channel to its owner.
    pub fn release(self) -> Pwm {
        self.pwm
    }
}

impl<Pwm: SetDutyCycle> JointDrive for LockedAntiphase<Pwm> {
    type Error = DriveError;
    /// The setpoint is the duty.
    type Setpoint = u16;

    #[inline(always)]
    fn setpoint(&self, torque: f32) -> u16 {
        self.duty(torque)
    }

    #[inline(always)]
    fn set(&mut self, duty: u16) -> Result<(), DriveError> {
        LockedAntiphase::set(self, duty)
    }
}

/// A drive with a PWM for the magnitude of the torque and a pin for its sign, high for torques
/// above zero.
///
/// ```
/// use embedded_hal_mock::eh1::{digital, pwm};
/// use joint_drivers::{Direction, h_bridge::{FullScale, SignMagnitude}};
/// let pwm = pwm::Mock::new(&[
///     pwm::Transaction::max_duty_cycle(1000),
///     pwm::Transaction::set_duty_cycle(0), // the sign changes while the bridge is off
///     pwm::Transaction::set_duty_cycle(250),
/// ]);
/// let pin = digital::Mock::new(&[digital::Transaction::set(digital::State::Low)]);
/// let mut drive = SignMagnitude::new(pwm, pin, FullScale::new(2.0)?, Direction::Forward);
/// drive.set_torque(-0.5)?;
/// let (mut pwm, mut pin) = drive.release();
/// pwm.done();
/// pin.done();
/// # Ok::<(), joint_drivers::h_bridge::DriveError>(())
/// ```
#[derive(Debug)]
pub struct SignMagnitude<Pwm, Pin> {
    pwm: Pwm,
    pin: Pin,
    scale: Scale,
    /// The level of the pin, if it is known.
    sign: Option<PinState>,
}

impl<Pwm: SetDutyCycle, Pin: OutputPin> SignMagnitude<Pwm, Pin> {
    /// A drive that delivers `full_scale` at a duty of 100 %.
    ///
    /// The greatest duty is read once: a timer whose period changes needs a new drive. Nothing is
    /// set: before the first torque, duty and sign are those of the peripherals.
    pub fn new(pwm: Pwm, pin: Pin, full_scale: FullScale, direction: Direction) -> Self {
        let scale = Scale::new(pwm.max_duty_cycle(), full_scale, direction);
        Self { pwm, pin, scale, sign: None }
    }

    /// The sign and the duty of a torque, to the nearest, limited to the full scale; NaN becomes
    /// zero torque.
    pub fn sign_and_duty(&self, torque: f32) -> (PinState, u16) {
        let share = self.scale.share(torque);
        let magnitude = share.unsigned_abs();
        let duty = (magnitude * u64::from(self.scale.max) + (1 << 30)) >> 31;
        (PinState::from(share > 0), duty as u16)
    }

    /// Sets a torque in N·m, limited to the full scale; NaN becomes zero torque.
    ///
    /// Zero torque is a duty of zero, with the sign unchanged. A change of sign first sets the duty
    /// to zero, so that the magnitude of one sign is never applied with the other.
    ///
    /// # Errors
    /// [`DriveError`]. If the pin fails, the duty is zero.
    pub fn set_torque(&mut self, torque: f32) -> Result<(), DriveError> {
        let (sign, duty) = self.sign_and_duty(torque);
        if duty == 0 {
            return self.set(0);
        }
        if self.sign != Some(sign) {
            self.set(0)?;
            self.sign = None;
            self.pin
                .set_state(sign)
                .map_err(|error| DriveError::Pin(digital::Error::kind(&error)))?;
            self.sign = Some(sign);
        }
        self.set(duty)
    }

    fn set(&mut self, duty: u16) -> Result<(), DriveError> {
        self.pwm.set_duty_cycle(duty).map_err(pwm_error)
    }

    /// The PWM channel and the pin.
    pub fn release(self) -> (Pwm, Pin) {
        (self.pwm, self.pin)
    }
}

impl<Pwm: SetDutyCycle, Pin: OutputPin> JointDrive for SignMagnitude<Pwm, Pin> {
    type Error = DriveError;
    /// N·m or N: the sign and the duty follow when it is set.
    type Setpoint = f32;

    fn setpoint(&self, torque: f32) -> f32 {
        torque
    }

    fn set(&mut self, torque: f32) -> Result<(), DriveError> {
        self.set_torque(torque)
    }
}
