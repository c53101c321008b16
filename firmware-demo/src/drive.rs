//! A current-controlled motor drive whose set-point is a PWM duty: 50 % is zero torque.

use embedded_hal::pwm::SetDutyCycle;

/// A drive refused its set-point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DriveError;

/// One joint's drive.
#[derive(Debug)]
pub struct Drive<Pwm> {
    pwm: Pwm,
    scale: Scale,
}

impl<Pwm: SetDutyCycle> Drive<Pwm> {
    /// A drive that delivers `full_scale` N·m (or N) at a duty of 100 % and its opposite at 0 %.
    ///
    /// The greatest duty is asked for once: a timer whose period changes needs a new drive.
    pub fn new(pwm: Pwm, full_scale: f32) -> Self {
        let scale = Scale::new(pwm.max_duty_cycle(), full_scale);
        Self { pwm, scale }
    }

    /// Sets the torque, limited to the full scale; what is not a number becomes zero torque.
    ///
    /// # Errors
    /// The PWM peripheral refused.
    #[inline(always)]
    pub fn set(&mut self, torque: f32) -> Result<(), DriveError> {
        let duty = self.scale.duty(torque);
        self.pwm.set_duty_cycle(duty).map_err(|_| DriveError)
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
    /// Duty of one N·m (or N).
    slope: f32,
    /// Duty of zero torque.
    zero: f32,
}

impl Scale {
    /// Full scale at `max`, zero at half of it.
    pub fn new(max: u16, full_scale: f32) -> Self {
        let zero = f32::from(max) * 0.5;
        Self {
            slope: zero / full_scale,
            zero,
        }
    }

    /// The duty of a torque, to the nearest.
    #[inline(always)]
    pub fn duty(&self, torque: f32) -> u16 {
        // Beyond 2²³ a float's last bit is worth one: its low bits are the integer, without the
        // comparisons of a saturating conversion.
        const TO_INTEGER: f32 = 12_582_912.0;
        let relative = self.slope * torque;
        let relative = if relative.abs() <= self.zero {
            relative
        } else {
            self.beyond(relative)
        };
        ((relative + self.zero) + TO_INTEGER).to_bits() as u16
    }

    /// Full scale, or zero for what is not a number.
    #[cold]
    fn beyond(&self, relative: f32) -> f32 {
        if relative > 0.0 {
            self.zero
        } else if relative < 0.0 {
            -self.zero
        } else {
            0.0
        }
    }
}
