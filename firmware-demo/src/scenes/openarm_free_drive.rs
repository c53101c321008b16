//! `openarm_free_drive`: a hand leads an OpenArm, whose Damiao drives are on CAN, lets it go, and
//! it stays. Its gripper then closes on a tool of 1 kg, and it is led back with it and stays again.
//!
//! While the gripper closes, the tool's weight goes over to the arm within 0.2 s, and the
//! law has the same share of it 20 ms later, since [`FreeDrive::tool`] is set between two ticks: no
//! torque has a step. A law without this payload drops the arm.
//!
//! The torque of a tick is that of gravity and the tool, [`HandGuiding`]'s on top of it, and
//! [`Breakaway`]'s push and dither. It has no trajectory of its own: the reference of the loop is
//! the place where the arm begins, and the law does not read it: it cannot be a
//! [`Scene`](crate::scene::Scene), which compares laws along a trajectory. Its runs are
//! [trials](trial) of a [plant] in the hand.
//!
//! # Sources
//!
//! - Motors, limits of torque and position, viscous friction: [`OpenArm`].
//! - Positions have 16 bits over ±12.5 rad ([`RESOLUTION`]); a command and its reply are two frames
//!   of 130 µs at 1 Mbit/s, 1.8 ms for seven drives: the tick is 2 ms.
//! - Stiction of 2.4 to 3.3 N·m at a shoulder with such motors, whose model has 0.65 N·m of sliding
//!   friction: almond-bot/axol, pull request 317. [`STICTION`] is its lower end at joints 1 to 4.
//!
//! The rest is chosen: friction of the wrist in the ratio of the peak torques of DM4310 and DM4340,
//! speeds that a hand needs, friction of the gears per load, the tool, and the numbers of push and
//! dither.

use core::cell::{Cell, RefCell};

use dynamics_core::Engine;
use dynamics_core::effects::{Coulomb, Gravity, LoadFriction, Payload, Viscous, Width};
use dynamics_core::model::{BodyInertia, Robot};
use dynamics_core::robots::OpenArm;
use dynamics_core::spatial::SpatialInertia;
use dynamics_core::state::State;
use glam::Vec3;
use joint_drivers::can::{CanError, ClassicFrame};
use joint_drivers::mit::Scale;
use joint_drivers::mit::damiao::{DM4310, DM4340, DM8009, Damiao};
use joint_drivers::{
    CanJoints, EncoderType, JointEncoders, JointError, JointMapping, JointRange, Law, Outbox,
};
use motion_control::estimate::Estimate;
use motion_control::law::{Breakaway, BreakawayConfig, Gains, HandGuiding, HandGuidingConfig};
use motion_control::limits::{ConfigError, Fault, SafetyLimits};
use motion_control::motion::MotionControllerConfig;
use motion_control::safety::SupervisorConfig;

pub mod plant;
pub mod trial;

/// s.
pub const TICK: f32 = 2e-3;
/// A step of the positions, rad.
pub const RESOLUTION: f32 = 25.0 / 65_535.0;
/// The motor of each joint.
pub const MOTORS: [Scale; 7] = [DM8009, DM8009, DM4340, DM4340, DM4310, DM4310, DM4310];
/// The bandwidth of the observer, rad/s.
pub const BANDWIDTH: f32 = 30.0;
/// The friction of the wrist's motors per that of the others.
pub const WRIST: f32 = 7.0 / 27.0;
/// The least static friction that is expected, N·m.
pub const STICTION: [f32; 7] = with_wrist(2.4);
/// The sliding friction of the model, N·m; the true one is within 30 % of it.
pub const SLIDING: [f32; 7] = with_wrist(0.65);
/// How far the torques of gravity may be off, as a share.
pub const GRAVITY_ERROR: f32 = 0.02;
/// Friction of the gears per torque, of one stage (9 or 10 to 1) and of two (40 to 1).
pub const GEARS: [f32; 7] = [0.05, 0.05, 0.1, 0.1, 0.05, 0.05, 0.05];

/// The body that is led, and the place of its grip in it, m.
pub const HAND: usize = OpenArm::MODEL.body("hand");
pub const GRIP: Vec3 = Vec3::new(0.0, 0.0, -0.12);
pub type Tool = Payload<f32, HAND>;
pub const NO_TOOL: Tool = Payload(SpatialInertia::ZERO);
/// 1 kg at the grip.
pub const TOOL: Tool = Payload::f32(BodyInertia {
    mass: 1.0,
    com: [0.0, 0.0, -0.12],
    inertia: [1e-3, 0.0, 0.0, 1e-3, 0.0, 1e-3],
});

/// An inertia times a factor.
fn times(inertia: &mut SpatialInertia<f32>, factor: f32) {
    inertia.mass *= factor;
    inertia.first_moment *= factor;
    inertia.rotational *= factor;
}

/// This share of a tool.
pub fn borne(mut tool: Tool, share: f32) -> Tool {
    times(&mut tool.0, share);
    tool
}

const fn with_wrist(x: f32) -> [f32; 7] {
    [x, x, x, x, WRIST * x, WRIST * x, WRIST * x]
}

/// The robot's, with speeds that are enough for a hand.
pub fn limits() -> SafetyLimits<f32, 7> {
    let limits = SafetyLimits::from(OpenArm::MODEL.to_f32().links.map(|link| link.limits));
    SafetyLimits { speed: [2.5, 2.5, 2.5, 2.5, 4.0, 4.0, 4.0], ..limits }.with_rate_share(0.5)
}

/// The configuration of the loop's controller. One of a thousand frames is lost, so that a tick in
/// seventy lacks a position: ten good ticks are enough to forget it.
pub fn controller() -> MotionControllerConfig<f32, 7> {
    MotionControllerConfig {
        supervisor: SupervisorConfig {
            limits: limits(),
            tick: TICK,
            resolution: RESOLUTION,
            ride_through_ticks: 10,
            hold_ticks: 100,
            reentry_ticks: 10,
        },
        observer_bandwidth: BANDWIDTH,
        decay_rate: 5.0,
        restart_distance: 0.1,
    }
}

/// The configuration of hand guiding, from the robot's limits. The largest diagonal of M, with
/// rotors and tool, is less than these inertias. The model may exceed the friction by 3/7: it is
/// off by 30 %. The light wrist has four times the damping: a joint of it that slips as the hand
/// lets go, under a dither that is above its sliding friction, coasts less far.
///
/// # Errors
/// If there were no such law.
pub fn guiding() -> Result<HandGuidingConfig<f32, 7>, ConfigError> {
    let inertia = [0.9, 0.9, 0.3, 0.4, 0.02, 0.04, 0.04];
    let config = HandGuidingConfig::from_limits(limits(), &inertia, BANDWIDTH)?;
    let mut damping = config.damping;
    damping.iter_mut().skip(4).for_each(|damping| *damping *= 4.0);
    Ok(HandGuidingConfig { error: 3.0 / 7.0, share: 0.7, damping, ..config })
}

/// A slower dither than the guide's, 10 Hz, and less push: at 21 Hz, with 0.78 and 0.6 of the
/// least stiction, one of three released arms moved by more than 2 mm, and the tank, which pays for
/// each change of the torque, ended the dither after half the time. A push of 0.3 accelerates a joint
/// that slips as the hand lets go, and starts no motion with less force than one of 0.1.
pub fn breakaway() -> BreakawayConfig<f32, 7> {
    BreakawayConfig {
        tick: TICK,
        resolution: RESOLUTION,
        late: true,
        stiction: STICTION,
        push: 0.1,
        dither: 0.74,
        window: 50,
        push_ticks: 100,
        dither_ticks: 25,
        energy: with_wrist(1.0),
        friction: SLIDING.map(|sliding| 0.7 * sliding),
        share: 0.7,
        speed: limits().speed,
    }
}

/// The drives on their bus.
pub type Joints = CanJoints<Outbox<ClassicFrame, 7>, Damiao, 7>;

/// Drives 1 to 7, which reply to hosts 0x11 to 0x17, of joints that are near these positions.
///
/// # Errors
/// A position that is not finite.
pub fn joints(near: &[f32; 7]) -> Result<Joints, CanError> {
    let limits = limits();
    let drive = |i: usize| {
        let range = JointRange::Near(near[i]);
        let mapping = JointMapping::IDENTITY.with_range(range, limits.speed[i] * TICK);
        let mapping = mapping.map_err(|_| CanError::NotFinite)?;
        Damiao::new(i as u8 + 1, i as u16 + 0x11, MOTORS[i], limits.torque[i], mapping)
    };
    let joints = [drive(0)?, drive(1)?, drive(2)?, drive(3)?, drive(4)?, drive(5)?, drive(6)?];
    Ok(CanJoints::new(Outbox::new(), joints))
}

/// Encoders that keep the last positions for [`FreeDrive`].
#[derive(Clone, Copy, Debug)]
pub struct Kept<'a, E>(pub E, pub &'a FreeDrive);

impl<E: EncoderType> EncoderType for Kept<'_, E> {
    type Error = E::Error;
    type Age = E::Age;

    fn missed(&mut self, ticks: u32) {
        self.0.missed(ticks);
    }

    fn fault(error: &E::Error, joint: usize) -> Fault {
        E::fault(error, joint)
    }
}

impl<E: JointEncoders<7>> JointEncoders<7> for Kept<'_, E> {
    fn start(&mut self) {
        self.0.start();
    }

    fn read(&mut self) -> Result<[f32; 7], JointError<E::Error>> {
        let read = self.0.read();
        if let Ok(q) = read {
            self.1.measured.set(q);
        }
        read
    }
}

/// The friction that is compensated.
pub type Friction = (Viscous<f32, 7>, Coulomb<f32, 7>, LoadFriction<f32, 7>);

/// The effects that the law compensates, and its parts: the input of [`Free`] beside the reference.
#[derive(Clone, Debug)]
pub struct FreeDrive {
    pub gravity: Gravity,
    /// What the hand bears, to be set between two ticks.
    pub tool: Cell<Tool>,
    pub friction: Friction,
    pub guiding: HandGuiding<f32, 7>,
    pub breakaway: RefCell<Breakaway<f32, 7>>,
    /// The torque that [`Breakaway`] added in the last tick, N·m.
    pub added: Cell<[f32; 7]>,
    /// The last positions that were read. Without a new one [`Breakaway`] takes the joints to be
    /// where they were: its account is then off by the change of its torque times the step, less
    /// than 2 mJ, instead of ending push and dither for a window.
    measured: Cell<[f32; 7]>,
}

impl FreeDrive {
    /// The law of these parts, with all friction of the model.
    ///
    /// # Errors
    /// [`ConfigError`].
    pub fn new(
        guiding: HandGuidingConfig<f32, 7>,
        breakaway: BreakawayConfig<f32, 7>,
    ) -> Result<Self, ConfigError> {
        let width = Width::new(0.01);
        let gears = LoadFriction { driving: GEARS, backdriving: GEARS, width };
        Ok(Self {
            gravity: Gravity::EARTH,
            tool: Cell::new(NO_TOOL),
            friction: (OpenArm::FRICTION.1, Coulomb { torque: SLIDING, width }, gears),
            guiding: HandGuiding::try_new(guiding)?,
            breakaway: RefCell::new(Breakaway::try_new(breakaway)?),
            added: Cell::new([0.0; 7]),
            measured: Cell::new([f32::NAN; 7]),
        })
    }
}

/// The law.
#[derive(Clone, Copy, Debug)]
pub struct Free;

impl Law<7, FreeDrive> for Free {
    const ACCELERATES: bool = false;

    fn feedforward(at: &State<f32, 7, 7>, drive: &FreeDrive) -> [f32; 7] {
        Engine::<OpenArm>::rnea(at, &(drive.gravity, drive.tool.get()))
    }

    fn torque(
        _: &Gains<f32, 7>,
        _: &State<f32, 7, 7>,
        estimate: &Estimate<f32, 7>,
        drive: &FreeDrive,
    ) -> [f32; 7] {
        let at = State { qd: estimate.qd, ..State::at(estimate.q) };
        let mut torque = Self::feedforward(&at, drive);
        let mut friction = Engine::<OpenArm>::motor_torque(&at, &torque, &drive.friction);
        for (friction, gravity) in friction.iter_mut().zip(&torque) {
            *friction -= gravity;
        }
        let guide = drive.guiding.torque(estimate, &friction, &torque.map(|g| GRAVITY_ERROR * g));
        // Nobody else holds it: the law is not called within itself.
        let added = drive
            .breakaway
            .try_borrow_mut()
            .map(|mut breakaway| breakaway.torque(&drive.measured.get()));
        let added = added.unwrap_or([0.0; 7]);
        drive.added.set(added);
        for (torque, (guide, added)) in torque.iter_mut().zip(guide.iter().zip(&added)) {
            *torque += guide + added;
        }
        torque
    }
}
