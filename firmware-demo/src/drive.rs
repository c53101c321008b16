//! A current-controlled motor drive whose set-point is a PWM duty: 50 % is zero torque.

use embedded_hal::pwm::SetDutyCycle;

/// A drive refused its set-point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DriveError;

/// One joint's drive.
#[derive(Debug)]
pub struct Drive<Pwm> {
    pwm: Pwm,
    per_full_scale: f32,
}

impl<Pwm: SetDutyCycle> Drive<Pwm> {
    /// A drive that delivers `full_scale` N·m (or N) at a duty of 100 % and its opposite at 0 %.
    pub fn new(pwm: Pwm, full_scale: f32) -> Self {
        Self {
            pwm,
            per_full_scale: 1.0 / full_scale,
        }
    }

    /// Sets the torque, limited to the full scale; what is not a number becomes zero torque.
    ///
    /// # Errors
    /// The PWM peripheral refused.
    #[inline(always)]
    pub fn set(&mut self, torque: f32) -> Result<(), DriveError> {
        let duty = duty(torque * self.per_full_scale, self.pwm.max_duty_cycle());
        self.pwm.set_duty_cycle(duty).map_err(|_| DriveError)
    }
}

/// The duty of a torque relative to full scale.
///
/// ```
/// use firmware_demo::drive::duty;
/// assert_eq!([duty(-1.0, 8400), duty(0.0, 8400), duty(1.0, 8400)], [0, 4200, 8400]);
/// assert_eq!([duty(f32::NAN, 8400), duty(1e9, 8400)], [4200, 8400]);
/// ```
#[inline(always)]
pub fn duty(relative: f32, max: u16) -> u16 {
    let relative = if relative.is_nan() { 0.0 } else { relative };
    let half = f32::from(max) * 0.5;
    // The cast saturates at both ends.
    ((half + half * relative + 0.5) as u16).min(max)
}
