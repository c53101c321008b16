//! A current-controlled motor drive whose set-point is a PWM duty: 50 % is zero torque.

use core::fmt;

use embedded_hal::pwm::{Error, ErrorKind, SetDutyCycle};

/// A drive did not accept its set-point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DriveError {
    /// The error of its PWM peripheral.
    pub kind: ErrorKind,
}

impl fmt::Display for DriveError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "a drive refused its set-point: {}", self.kind)
    }
}

impl core::error::Error for DriveError {}

/// One joint's drive.
#[derive(Debug)]
pub struct Drive<Pwm> {
    pwm: Pwm,
    scale: Scale,
}

impl<Pwm: SetDutyCycle> Drive<Pwm> {
    /// A drive that delivers `full_scale` N·m (or N) at a duty of 100 % and its opposite at 0 %.
    ///
    /// The greatest duty is read once: a timer whose period changes needs a new drive.
    pub fn new(pwm: Pwm, full_scale: f32) -> Self {
        let scale = Scale::new(pwm.max_duty_cycle(), full_scale);
        Self { pwm, scale }
    }

    /// The duty of a torque, limited to the full scale; NaN becomes zero torque.
    #[inline(always)]
    pub fn duty(&self, torque: f32) -> u16 {
        self.scale.duty(torque)
    }

    /// Sets a duty of [`Self::duty`]. The two calls are separate, so that the arithmetic of all joints does not wait
    /// for the peripherals.
    ///
    /// # Errors
    /// The PWM peripheral did not accept the duty.
    #[inline(always)]
    pub fn set(&mut self, duty: u16) -> Result<(), DriveError> {
        self.pwm
            .set_duty_cycle(duty)
            .map_err(|error| DriveError { kind: error.kind() })
    }
}

/// From torques to duties.
///
/// ```
/// use firmware_demo::drive::Scale;
/// let scale = Scale::new(8400, 150.0);
/// assert_eq!([-150.0, 0.0, 150.0].map(|tau| scale.duty(tau)), [0, 4200, 8400]);
/// assert_eq!([f32::NAN, 1e9, -1e9].map(|tau| scale.duty(tau)), [4200, 8400, 0]);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    /// 2³¹ per full scale: beyond it the conversion to an integer saturates.
    slope: f32,
    /// The greatest duty.
    max: i32,
}

impl Scale {
    /// Full scale at `max`, zero at half of it.
    pub fn new(max: u16, full_scale: f32) -> Self {
        Self {
            slope: 2_147_483_648.0 / full_scale,
            max: i32::from(max),
        }
    }

    /// The duty of a torque, to the nearest. Cost: the same instructions for all torques.
    #[inline(always)]
    pub fn duty(&self, torque: f32) -> u16 {
        // 2³¹ of full scale; what is not a number converts to zero.
        let share = i64::from((self.slope * torque) as i32);
        // To the nearest: one multiplication that keeps the upper half.
        let relative = (share * i64::from(self.max) + (1 << 31)) >> 32;
        (self.max >> 1).wrapping_add(relative as i32) as u16
    }
}
