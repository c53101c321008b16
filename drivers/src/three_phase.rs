//! The duties of three half-bridges for a voltage along the d and q axes of a three-phase motor.
//!
//! # Source
//! H. W. van der Broeck, H.-C. Skudelny, G. V. Stanke, "Analysis and realization of a pulsewidth
//! modulator based on voltage space vectors", IEEE Trans. Ind. Appl. 24(1), 1988; in the form that
//! adds −(max + min)/2 to the three phases, J. Holtz, "Pulsewidth modulation: a survey", IEEE
//! Trans. Ind. Electron. 39(5), 1992. Transforms of constant amplitude:
//!
//! vα = v_d cos θ − v_q sin θ, vβ = v_d sin θ + v_q cos θ (inverse Park);
//! v_a = vα, v_b, v_c = −vα/2 ± (√3/2) vβ (inverse Clarke).
//!
//! A current controller is not part of this module: its output is (v_d, v_q), of which v_q produces
//! torque.

use core::fmt;

use dynamics_core::scalar::Real;
use dynamics_core::trig::sin_cos;
use embedded_hal::pwm::{Error, ErrorKind, SetDutyCycle};

use crate::JointMapping;

/// √3/2.
const HALF_SQRT_3: f32 = 0.866_025_4;
/// The longest voltage that three phases deliver in every direction, as a share of the supply:
/// 1/√3.
pub const LONGEST: f32 = 0.577_350_26;
/// Beyond it a share of the supply is an error of the caller, not a voltage; its square does not
/// overflow.
const ABSURD: f32 = 1e9;

/// The duties of three phases, each 0 to 1.
///
/// ```
/// use joint_drivers::three_phase::Duties;
/// let duties = Duties::new(0.0, 12.0, 0.0, 24.0); // 12 V along q, at an electrical angle of 0
/// let [a, b, c] = duties.phases;
/// assert!((a - 0.5).abs() < 1e-6 && ((b - c) * 24.0 - 12.0 * 3.0_f32.sqrt()).abs() < 1e-4);
/// assert!(!duties.is_saturated);
/// assert_eq!(Duties::new(0.0, f32::NAN, 0.0, 24.0), Duties::ZERO);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Duties {
    /// Duties of the phases a, b and c.
    pub phases: [f32; 3],
    /// Whether the voltage was shortened to the longest that the supply delivers in every
    /// direction.
    pub is_saturated: bool,
}

impl Duties {
    /// No voltage between the phases: 50 % each.
    pub const ZERO: Self = Self { phases: [0.5; 3], is_saturated: false };

    /// The duties for `v_d` and `v_q` in V at an electrical angle in rad, from a supply of `v_dc`
    /// V.
    ///
    /// A vector longer than `v_dc`/√3 is shortened to that length; its direction is kept. If an
    /// input is not finite or the supply is not above zero, the duties are [`Self::ZERO`].
    /// Accuracy: 10⁻⁶ of the supply for electrical angles up to 10⁴ rad; beyond 2·10⁵ rad the
    /// direction is meaningless. Cost: a sine and a cosine, about 25 flops and two divisions;
    /// Newton's iteration for 1/√x when it saturates.
    pub fn new(v_d: f32, v_q: f32, electrical_angle: f32, v_dc: f32) -> Self {
        let (mut d, mut q) = (v_d / v_dc, v_q / v_dc);
        let is_voltage = d.abs() <= ABSURD && q.abs() <= ABSURD;
        let is_supply = v_dc > 0.0 && v_dc.is_finite();
        if !(is_voltage && is_supply && electrical_angle.is_finite()) {
            return Self::ZERO;
        }
        let square = d * d + q * q;
        let is_saturated = square > LONGEST * LONGEST;
        if is_saturated {
            let shorten = LONGEST * square.rsqrt();
            (d, q) = (d * shorten, q * shorten);
        }
        let (sin, cos) = sin_cos(electrical_angle);
        let (alpha, beta) = (d * cos - q * sin, d * sin + q * cos);
        let across = HALF_SQRT_3 * beta;
        let phases = [alpha, across - 0.5 * alpha, -across - 0.5 * alpha];
        // Comparisons: `f32::max` is a call on a Cortex-M4F, which has no instruction for it.
        let [a, b, c] = phases;
        let (high, low) = if a > b { (a, b) } else { (b, a) };
        let highest = if c > high { c } else { high };
        let lowest = if c < low { c } else { low };
        let centre = 0.5 - 0.5 * (highest + lowest);
        Self {
            // Rounding alone exceeds the range.
            phases: phases.map(|phase| (phase + centre).clamp(0.0, 1.0)),
            is_saturated,
        }
    }
}

/// A phase did not accept its duty.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct PhaseError {
    /// 0 for a, 1 for b, 2 for c.
    pub phase: usize,
    /// The error of its PWM peripheral.
    pub kind: ErrorKind,
}

impl fmt::Display for PhaseError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "phase {} refused its duty: {}", self.phase, self.kind)
    }
}

impl core::error::Error for PhaseError {}

/// Three half-bridges and the angle of the rotor between them.
///
/// ```
/// use embedded_hal_mock::eh1::pwm::{Mock, Transaction};
/// use joint_drivers::{Direction, JointMapping, three_phase::ThreePhase};
/// let phase = |duty| Mock::new(&[Transaction::max_duty_cycle(1000), Transaction::set_duty_cycle(duty)]);
/// // 7 pole pairs; the d axis lies along phase a where the encoder reads 0.3 rad.
/// let commutation = JointMapping::new(0.3, Direction::Forward, 1.0 / 7.0)?;
/// let mut motor = ThreePhase::new([phase(500), phase(644), phase(356)], commutation);
/// let is_saturated = motor.set_voltage(0.0, 4.0, 0.3, 24.0)?;
/// assert!(!is_saturated);
/// motor.release().iter_mut().for_each(Mock::done);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct ThreePhase<Pwm> {
    pwms: [Pwm; 3],
    max: [u16; 3],
    commutation: JointMapping,
}

impl<Pwm: SetDutyCycle> ThreePhase<Pwm> {
    /// The half-bridges of phases a, b and c.
    ///
    /// `commutation` maps the angle of the rotor to the electrical angle: its zero is the angle at
    /// which the d axis lies along phase a, its ratio is one divided by the pole pairs, and its
    /// direction is reverse if the phases are in the opposite order. The greatest duties are read
    /// once.
    pub fn new(pwms: [Pwm; 3], commutation: JointMapping) -> Self {
        let max = pwms.each_ref().map(SetDutyCycle::max_duty_cycle);
        Self { pwms, max, commutation }
    }

    /// Sets `v_d` and `v_q` in V while the rotor is at `angle` rad and the supply at `v_dc` V, as
    /// [`Duties::new`]; whether the voltage was shortened.
    ///
    /// The angle is that within one turn of the rotor: over many turns f32 loses the electrical
    /// angle.
    ///
    /// # Errors
    /// [`PhaseError`]; all phases that accept it are then set to 50 %, no voltage.
    pub fn set_voltage(
        &mut self,
        v_d: f32,
        v_q: f32,
        angle: f32,
        v_dc: f32,
    ) -> Result<bool, PhaseError> {
        let electrical_angle = self.commutation.joint_position(angle);
        let duties = Duties::new(v_d, v_q, electrical_angle, v_dc);
        self.set(duties.phases)
            .inspect_err(|_| {
                // The first error is the one that is reported.
                let _ = self.set_zero();
            })
            .map(|()| duties.is_saturated)
    }

    /// Sets all phases to 50 %: no voltage between them, and the windings shorted.
    ///
    /// # Errors
    /// The first [`PhaseError`]; the other phases are set nevertheless.
    pub fn set_zero(&mut self) -> Result<(), PhaseError> {
        let results = [0, 1, 2].map(|phase| self.set_phase(phase, 0.5));
        results.into_iter().collect()
    }

    fn set(&mut self, duties: [f32; 3]) -> Result<(), PhaseError> {
        (0..3).try_for_each(|phase| self.set_phase(phase, duties[phase]))
    }

    fn set_phase(&mut self, phase: usize, duty: f32) -> Result<(), PhaseError> {
        let counts = (duty * f32::from(self.max[phase]) + 0.5) as u16;
        self.pwms[phase]
            .set_duty_cycle(counts)
            .map_err(|error| PhaseError { phase, kind: error.kind() })
    }

    /// Returns the PWM channels to their owner.
    pub fn release(self) -> [Pwm; 3] {
        self.pwms
    }
}
