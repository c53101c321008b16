//! The feedback on the drive: a spring and a damper there, with what they leave of the gate's
//! torque as feed-forward.
//!
//! In each tick a drive gets q_d, q̇_d, K_p, K_d and
//!
//! ```text
//! τ_ff = τ_gate − K_p (q_d − q̂) − K_d (q̇_d − q̇̂)
//! ```
//!
//! so that its sum is τ_gate at the estimated state; between two ticks the arm is stiff at the
//! drive's rate instead of the loop's. Limits, faults and fallbacks remain those of the gate.

use dynamics_core::state::State;
use motion_control::{estimate::Estimate, law::Gains};

use crate::joint::{JointDrives, JointError};

/// A spring, a damper and a torque, at the joint.
///
/// ```
/// use joint_drivers::mit::Setpoint;
/// // Only a torque: both gains are zero.
/// let torque = Setpoint { torque: 2.0, ..Setpoint::default() };
/// assert_eq!((torque.kp, torque.kd), (0.0, 0.0));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Setpoint {
    /// q_d, rad.
    pub position: f32,
    /// q̇_d, rad/s.
    pub velocity: f32,
    /// K_p, N·m/rad.
    pub kp: f32,
    /// K_d, N·m·s/rad.
    pub kd: f32,
    /// The torque, N·m.
    pub torque: f32,
}

/// A setpoint whose torque is the sum of all three at a measured state: [`Drive::command_at`](crate::mit::Drive::command_at).
///
/// ```
/// use joint_drivers::mit::{Setpoint, SetpointAt};
/// let sum = Setpoint { position: 1.0, kp: 50.0, torque: 2.0, ..Setpoint::default() };
/// // The spring has 50 × 0.1 N·m at 0.9 rad: −3 N·m are left for the feed-forward.
/// let at = SetpointAt { sum, position: 0.9, velocity: 0.0 };
/// assert!((at.feedforward() + 3.0).abs() < 1e-5);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SetpointAt {
    /// The spring and the damper, and the torque of the sum.
    pub sum: Setpoint,
    /// q, rad.
    pub position: f32,
    /// q̇, rad/s.
    pub velocity: f32,
}

impl SetpointAt {
    /// The torque that the spring and the damper leave, N·m: τ − K_p (q_d − q) − K_d (q̇_d − q̇).
    pub fn feedforward(&self) -> f32 {
        let Setpoint { position, velocity, kp, kd, torque } = self.sum;
        torque - kp * (position - self.position) - kd * (velocity - self.velocity)
    }
}

/// Drives of the `V` joints of a robot that have a spring and a damper of their own.
///
/// Drives that only take torques do not have them, and are refused:
///
/// ```compile_fail,E0277
/// use joint_drivers::{JointDrives, PdOnDrives};
/// # use joint_drivers::JointError;
/// # use motion_control::law::Gains;
/// struct Torques;
/// impl JointDrives<1> for Torques {
///     type Error = core::convert::Infallible;
///     fn set_torques(&mut self, _: &[f32; 1]) -> Result<(), JointError<Self::Error>> { Ok(()) }
/// }
/// fn drives<D: JointDrives<1>>(_: D) {}
/// drives(PdOnDrives::new(Torques, Gains { kp: [50.0], kd: [2.0] }));
/// ```
pub trait PdDrives<const V: usize>: JointDrives<V> {
    /// Sets the springs, the dampers, and the sums at the measured states. If a drive reports a
    /// fault, all get their torque with zero gains.
    ///
    /// # Errors
    /// As [`JointDrives::set_torques`].
    fn set_sums(&mut self, sums: &[SetpointAt; V]) -> Result<(), JointError<Self::Error>>;
}

/// Drives on which a spring and a damper act while the arm is in full operation.
///
/// A [`ControlLoop`](crate::ControlLoop) over them gives them its reference and its estimate. In
/// every other tick the gains are zero and the drives have the torque alone: in a tick with a
/// fault, during a ride-through, while the arm is held or stopped, and on the brake.
///
/// The gains are those of the joints; each is limited to the scale of its drive. They act beside
/// the law, whose torque at the estimated state remains what it was.
///
/// ```
/// use embedded_can::Frame;
/// use joint_drivers::can::FdFrame;
/// use joint_drivers::mit::damiao::{DM4310, Damiao};
/// use joint_drivers::{CanJoints, JointDrives, JointMapping, JointRange, Outbox, PdOnDrives};
/// use motion_control::law::Gains;
/// let mapping = JointMapping::IDENTITY.with_range(JointRange::Near(0.0), 5e-3)?;
/// let joints = CanJoints::new(Outbox::<FdFrame, 1>::new(), [Damiao::new(1, 0x11, DM4310, 7.0, mapping)?]);
/// let mut drives = PdOnDrives::new(&joints, Gains { kp: [50.0], kd: [2.0] });
/// // Torques alone, as in a tick with a fault.
/// drives.set_torques(&[0.0])?;
/// let [frame] = joints.commands();
/// assert_eq!(frame.unwrap().data(), [0x80, 0, 0x80, 0, 0, 0, 0x08, 0]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct PdOnDrives<D, const V: usize> {
    drives: D,
    gains: Gains<f32, V>,
}

impl<D, const V: usize> PdOnDrives<D, V> {
    /// The drives with these gains, N·m/rad and N·m·s/rad at the joints.
    pub const fn new(drives: D, gains: Gains<f32, V>) -> Self {
        Self { drives, gains }
    }
}

impl<D: PdDrives<V>, const V: usize> JointDrives<V> for PdOnDrives<D, V> {
    type Error = D::Error;

    const HAVE_PD: bool = true;

    fn set_torques(&mut self, torques: &[f32; V]) -> Result<(), JointError<D::Error>> {
        self.drives.set_torques(torques)
    }

    fn set_with_pd(
        &mut self,
        torques: &[f32; V],
        reference: &State<f32, V, V>,
        estimate: &Estimate<f32, V>,
    ) -> Result<(), JointError<D::Error>> {
        let mut sums = [SetpointAt::default(); V];
        let desired = reference.q.iter().zip(&reference.qd);
        let actual = estimate.q.iter().zip(&estimate.qd);
        let gains = self.gains.kp.iter().zip(&self.gains.kd);
        let all = torques.iter().zip(desired).zip(actual).zip(gains);
        for (sum, (((&torque, desired), actual), gains)) in sums.iter_mut().zip(all) {
            let (&position, &velocity) = desired;
            let (&kp, &kd) = gains;
            let wanted = Setpoint { position, velocity, kp, kd, torque };
            *sum = SetpointAt { sum: wanted, position: *actual.0, velocity: *actual.1 };
        }
        self.drives.set_sums(&sums)
    }
}
