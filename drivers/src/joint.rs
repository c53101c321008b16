//! The traits through which the control loop reads encoders and sets drives.
//!
//! Each has one trait for a joint ([`JointEncoder`], [`JointDrive`]), which an array of devices
//! makes one for the robot ([`JointEncoders`], [`JointDrives`]). Devices that one transfer reads
//! together implement the latter themselves.

use core::convert::Infallible;
use core::error::Error;
use core::fmt;

use dynamics_core::state::State;
use embedded_hal::digital::{self, OutputPin};
use motion_control::{estimate::Estimate, limits::Fault, motion::MeasurementAge};

/// The properties of an encoder that do not depend on how it is accessed.
///
/// ```
/// use joint_drivers::{EncoderType, as5600::As5600};
/// use motion_control::motion::CurrentTick;
/// // An AS5600 answers with the angle of now: a controller that expects that of the tick before does not compile.
/// fn current<E: EncoderType<Age = CurrentTick>>(_: &E) {}
/// # use joint_drivers::{JointMapping, JointRange};
/// let mapping = JointMapping::IDENTITY.with_range(JointRange::Continuous, 5e-3)?;
/// current(&As5600::new((), mapping));
/// # Ok::<(), joint_drivers::MappingError>(())
/// ```
pub trait EncoderType {
    /// The reason why there is no position.
    type Error: Error;
    /// The age of the positions: of this tick, or of the one before.
    type Age: MeasurementAge;

    /// Notes this many ticks without a reading: an encoder whose count wraps may have lost its
    /// turn.
    fn missed(&mut self, ticks: u32) {
        let _ = ticks;
    }

    /// The fault of a controller that an error of a joint is.
    fn fault(error: &Self::Error, joint: usize) -> Fault {
        let _ = error;
        Fault::Encoder { joint }
    }
}

/// The encoder of a joint.
///
/// A reading has two steps, so that a loop can convert the angles of all joints at once after all
/// transfers: on a Cortex-M4F the conversions then fill each other's latencies.
///
/// ```
/// use core::convert::Infallible;
/// use joint_drivers::{EncoderType, JointEncoder};
/// use motion_control::motion::CurrentTick;
/// /// A potentiometer on a converter of 12 bits.
/// struct Potentiometer { counts: u16 }
/// impl EncoderType for Potentiometer {
///     type Error = Infallible;
///     type Age = CurrentTick;
/// }
/// impl JointEncoder for Potentiometer {
///     fn sample(&mut self) -> Result<(), Infallible> {
///         self.counts = 3072; // of the converter
///         Ok(())
///     }
///     fn position(&self) -> f32 {
///         (f32::from(self.counts) - 2048.0) * 1e-3
///     }
/// }
/// assert_eq!(Potentiometer { counts: 0 }.read(), Ok(1.024)); // rad
/// ```
pub trait JointEncoder: EncoderType {
    /// Prepares the first reading. Errors are those of that reading.
    fn start(&mut self) {}

    /// Takes a reading from the device.
    ///
    /// # Errors
    /// There is none; [`Self::position`] is then meaningless.
    fn sample(&mut self) -> Result<(), Self::Error>;

    /// The joint's position in the reading, rad or m, finite.
    fn position(&self) -> f32;

    /// The joint's position, rad or m: both steps.
    ///
    /// # Errors
    /// As [`Self::sample`].
    fn read(&mut self) -> Result<f32, Self::Error> {
        self.sample()?;
        Ok(self.position())
    }
}

/// The encoders of the `V` joints of a robot.
pub trait JointEncoders<const V: usize>: EncoderType {
    /// Prepares the first reading. Errors are those of that reading.
    fn start(&mut self);

    /// The joints' positions, rad or m, finite.
    ///
    /// # Errors
    /// The error of the first joint without a position. In an array all others have been read
    /// nevertheless.
    fn read(&mut self) -> Result<[f32; V], JointError<Self::Error>>;
}

/// The drive of a joint.
///
/// A command has two steps, so that a loop can convert the torques of all joints before it accesses
/// the first device.
///
/// ```
/// use joint_drivers::{DriveFault, DriveFaultKind, JointDrive};
/// /// A drive with a line that says whether it is ready.
/// struct Drive { enabled: bool, current: f32 }
/// #[derive(Debug, PartialEq)]
/// struct Disabled;
/// impl core::fmt::Display for Disabled {
///     fn fmt(&self, out: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
///         out.write_str("the drive is not enabled")
///     }
/// }
/// impl core::error::Error for Disabled {}
/// impl DriveFault for Disabled {
///     fn kind(&self) -> DriveFaultKind { DriveFaultKind::NotReady }
/// }
/// impl JointDrive for Drive {
///     type Error = Disabled;
///     type Setpoint = f32; // A
///     fn setpoint(&self, torque: f32) -> f32 { torque * 2.5 }
///     fn set(&mut self, current: f32) -> Result<(), Disabled> {
///         self.current = current;
///         if self.enabled { Ok(()) } else { Err(Disabled) }
///     }
/// }
/// let mut drive = Drive { enabled: false, current: 0.0 };
/// assert_eq!(drive.set_torque(2.0), Err(Disabled));
/// ```
pub trait JointDrive {
    /// The reason why the torque does not act.
    type Error: DriveFault;
    /// A torque in the device's own unit.
    type Setpoint: Copy + Default;

    /// A torque of the joint, N·m or N, in the device's unit, within its range; that of zero torque
    /// for NaN.
    fn setpoint(&self, torque: f32) -> Self::Setpoint;

    /// Sets the torque of the next tick.
    ///
    /// # Errors
    /// The device did not accept it, is not ready, or reports a fault of its own:
    /// [`DriveFault::kind`] says which.
    fn set(&mut self, setpoint: Self::Setpoint) -> Result<(), Self::Error>;

    /// Sets a torque of the joint, N·m or N: both steps.
    ///
    /// # Errors
    /// As [`Self::set`].
    fn set_torque(&mut self, torque: f32) -> Result<(), Self::Error> {
        self.set(self.setpoint(torque))
    }
}

/// The drives of the `V` joints of a robot.
pub trait JointDrives<const V: usize> {
    /// The reason why a torque does not act.
    type Error: DriveFault;

    /// Sets the torques of the joints, N·m or N.
    ///
    /// # Errors
    /// The error of the first joint that failed, else of the first that is not ready; the torques
    /// of all others are set.
    fn set_torques(&mut self, torques: &[f32; V]) -> Result<(), JointError<Self::Error>>;

    /// Whether a control loop calls [`Self::set_with_pd`] in full operation: for
    /// [`PdOnDrives`](crate::PdOnDrives). Other drives do not pay for it.
    const HAVE_PD: bool = false;

    /// Sets the torques of the joints at their estimated state, and by reference and gains how they
    /// change with it until the next tick.
    ///
    /// # Errors
    /// As [`Self::set_torques`].
    fn set_with_pd(
        &mut self,
        torques: &[f32; V],
        reference: &State<f32, V, V>,
        estimate: &Estimate<f32, V>,
    ) -> Result<(), JointError<Self::Error>> {
        let _ = (reference, estimate);
        self.set_torques(torques)
    }
}

/// The error of a drive, sorted by what a control loop has to do about it.
pub trait DriveFault: Error {
    /// The kind of remedy for the error.
    fn kind(&self) -> DriveFaultKind {
        DriveFaultKind::Failed
    }
}

impl DriveFault for Infallible {}

/// The remedy for the error of a drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DriveFaultKind {
    /// The drive may still apply an older torque: the brake at once, see [`Fault::Drive`].
    Failed,
    /// The drive is not enabled, not commutated or without supply, which may pass: see
    /// [`Fault::NotReady`].
    NotReady,
}

/// The error of a device, and of which joint it is.
///
/// ```
/// use joint_drivers::{JointError, as5047p::FrameError};
/// let error = JointError { joint: 2, error: FrameError::Parity };
/// assert_eq!(error.to_string(), "joint 2: the parity of the encoder's frame is odd");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JointError<E> {
    /// The number of the joint, from 0.
    pub joint: usize,
    /// The device's error.
    pub error: E,
}

impl<E: DriveFault> JointError<E> {
    /// The fault of a controller that this error of a drive is.
    pub fn drive_fault(&self) -> Fault {
        let joint = self.joint;
        match self.error.kind() {
            DriveFaultKind::Failed => Fault::Drive { joint },
            DriveFaultKind::NotReady => Fault::NotReady { joint },
        }
    }
}

impl<E: fmt::Display> fmt::Display for JointError<E> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "joint {}: {}", self.joint, self.error)
    }
}

impl<E: Error> Error for JointError<E> {}

impl<E: EncoderType, const V: usize> EncoderType for [E; V] {
    type Error = E::Error;
    type Age = E::Age;

    fn missed(&mut self, ticks: u32) {
        self.iter_mut().for_each(|encoder| encoder.missed(ticks));
    }

    fn fault(error: &E::Error, joint: usize) -> Fault {
        E::fault(error, joint)
    }
}

impl<E: JointEncoder, const V: usize> JointEncoders<V> for [E; V] {
    fn start(&mut self) {
        self.iter_mut().for_each(E::start);
    }

    #[inline(always)]
    fn read(&mut self) -> Result<[f32; V], JointError<E::Error>> {
        for joint in 0..V {
            if let Err(error) = self[joint].sample() {
                return Err(sample_others(self, JointError { joint, error }));
            }
        }
        Ok(self.each_ref().map(E::position))
    }
}

impl<D: JointDrive, const V: usize> JointDrives<V> for [D; V] {
    type Error = D::Error;

    #[inline(always)]
    fn set_torques(&mut self, torques: &[f32; V]) -> Result<(), JointError<D::Error>> {
        let mut setpoints = [D::Setpoint::default(); V];
        for ((setpoint, drive), &torque) in setpoints.iter_mut().zip(&*self).zip(torques) {
            *setpoint = drive.setpoint(torque);
        }
        let mut failed = None;
        for (joint, (drive, setpoint)) in self.iter_mut().zip(setpoints).enumerate() {
            if let Err(error) = drive.set(setpoint) {
                keep_worse(&mut failed, JointError { joint, error });
            }
        }
        failed.map_or(Ok(()), Err)
    }
}

/// Reads the encoders after one that failed, and keeps its error: in a function of its own, so that
/// a tick without errors keeps nothing for them.
#[cold]
#[inline(never)]
fn sample_others<E: JointEncoder, const V: usize>(
    encoders: &mut [E; V],
    failed: JointError<E::Error>,
) -> JointError<E::Error> {
    for encoder in encoders.iter_mut().skip(failed.joint + 1) {
        // Its reading is lost with the others of this tick, but not its turn.
        let _ = encoder.sample();
    }
    failed
}

/// Keeps the first error of those that failed, else of those that are not ready.
#[cold]
#[inline(never)]
fn keep_worse<E: DriveFault>(kept: &mut Option<JointError<E>>, other: JointError<E>) {
    let is_kept = |kept: &JointError<E>| {
        kept.error.kind() == DriveFaultKind::Failed || other.error.kind() != DriveFaultKind::Failed
    };
    if !kept.as_ref().is_some_and(is_kept) {
        *kept = Some(other);
    }
}

/// The brake of a robot without one: its joints fall when the drives have no torque.
///
/// ```
/// use embedded_hal::digital::OutputPin;
/// let Ok(()) = joint_drivers::NoBrake.set_high();
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct NoBrake;

impl digital::ErrorType for NoBrake {
    type Error = Infallible;
}

impl OutputPin for NoBrake {
    fn set_low(&mut self) -> Result<(), Infallible> {
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}
