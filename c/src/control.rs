//! The controller: limits, estimate, reference, law, safety gate, as `motion_control` has them.

use core::marker::PhantomData;

use dynamics_core::Core;
use dynamics_core::model::model;
use motion_control::estimate::Estimate;
use motion_control::law::{Gains, feedback};
use motion_control::limits::{Command, Fault, Mode, MotionLimits, SafetyLimits};
use motion_control::motion::{CurrentTick, MotionController, MotionControllerConfig, ResetError};
use motion_control::reference::{Reference, Trajectory, TrajectoryError};
use motion_control::safety::SupervisorConfig;

use crate::tool::Tool;
use crate::{Exports, Form, Library, State, check, field, status};

/// The parameters of a controller: `..._config` of the header.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config<const N: usize> {
    /// Length of a tick, s.
    pub tick: f32,
    /// Step of the encoders, rad or m.
    pub resolution: f32,
    /// Bandwidth of the estimate, rad/s.
    pub bandwidth: f32,
    /// Rate at which the speed of a held arm decays, 1/s.
    pub decay_rate: f32,
    /// Greatest distance from the reference at a reset, rad or m.
    pub restart_distance: f32,
    /// Ticks with a fault that are bridged.
    pub ride_through_ticks: u32,
    /// Ticks with a fault, after those, in which the arm is held.
    pub hold_ticks: u32,
    /// Ticks of the return onto the reference.
    pub reentry_ticks: u32,
    /// Least positions, rad or m.
    pub lower: [f32; N],
    /// Greatest positions, rad or m.
    pub upper: [f32; N],
    /// Greatest speeds, rad/s or m/s.
    pub speed: [f32; N],
    /// Greatest accelerations between way-points, rad/s² or m/s².
    pub acceleration: [f32; N],
    /// Greatest torques, N·m or N.
    pub torque: [f32; N],
    /// Greatest changes of a torque in a tick, N·m or N.
    pub rate: [f32; N],
    /// K_p, N·m/rad or N/m.
    pub kp: [f32; N],
    /// K_d, N·m·s/rad or N·s/m.
    pub kd: [f32; N],
}

/// The subject of a status: `..._where` of the header.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Where {
    /// A field, of those below.
    pub field: i32,
    /// The joint, or −1.
    pub joint: i32,
    /// The way-point, or −1.
    pub point: i32,
}

/// A status with what it is about.
pub type Rejected = (i32, Where);

impl Where {
    /// The place of an error that has none.
    pub const NOWHERE: Self = Self::of(field::NONE, None, None);

    pub(crate) const fn of(field: i32, joint: Option<usize>, point: Option<usize>) -> Self {
        const fn number(index: Option<usize>) -> i32 {
            match index {
                Some(index) => index as i32,
                None => -1,
            }
        }
        let (joint, point) = (number(joint), number(point));
        Self { field, joint, point }
    }
}

impl<const N: usize> Config<N> {
    /// Accepts limits of speed and acceleration that are numbers: a description states no
    /// accelerations, and not always speeds.
    ///
    /// # Errors
    /// `CONFIG` with the field and the joint.
    pub(crate) fn check_motion(&self) -> Result<(), Rejected> {
        for (field, list) in
            [(field::ACCELERATION, &self.acceleration), (field::SPEED, &self.speed)]
        {
            // False for a NaN, too. Numbers beyond this are no limits.
            if let Some(joint) = list.iter().position(|x| !(1e-9..=1e9).contains(x)) {
                return Err((status::CONFIG, Where::of(field, Some(joint), None)));
            }
        }
        Ok(())
    }

    /// Accepts a configuration that a controller can work with.
    fn check(&self) -> Result<(), Rejected> {
        let reject = |field, joint| Err((status::CONFIG, Where::of(field, joint, None)));
        let numbers = [
            (field::TICK, self.tick, self.tick > 0.0),
            (field::RESOLUTION, self.resolution, self.resolution >= 0.0),
            (field::BANDWIDTH, self.bandwidth, self.bandwidth > 0.0),
            (field::DECAY_RATE, self.decay_rate, self.decay_rate > 0.0),
            (field::RESTART_DISTANCE, self.restart_distance, self.restart_distance >= 0.0),
        ];
        for (field, number, in_range) in numbers {
            if !(in_range && number.is_finite()) {
                return reject(field, None);
            }
        }
        // A NaN is not at least zero. Torques and gains have to be finite as well.
        let lists = [
            (field::SPEED, &self.speed, false),
            (field::ACCELERATION, &self.acceleration, false),
            (field::RATE, &self.rate, false),
            (field::TORQUE, &self.torque, true),
            (field::KP, &self.kp, true),
            (field::KD, &self.kd, true),
        ];
        for (field, list, finite) in lists {
            let good = |&x: &f32| x >= 0.0 && (!finite || x.is_finite());
            if let Some(joint) = list.iter().position(|x| !good(x)) {
                return reject(field, Some(joint));
            }
        }
        for (joint, (lower, upper)) in self.lower.iter().zip(&self.upper).enumerate() {
            if lower.is_nan() {
                return reject(field::LOWER, Some(joint));
            }
            // False for a NaN, too.
            let is_range = lower <= upper;
            if !is_range {
                return reject(field::UPPER, Some(joint));
            }
        }
        Ok(())
    }

    /// The configuration of the library's controller.
    pub fn motion_controller(&self) -> MotionControllerConfig<f32, N> {
        let limits = SafetyLimits {
            torque: self.torque,
            rate: self.rate,
            speed: self.speed,
            lower: self.lower,
            upper: self.upper,
        };
        MotionControllerConfig {
            supervisor: SupervisorConfig {
                limits,
                tick: self.tick,
                resolution: self.resolution,
                ride_through_ticks: self.ride_through_ticks,
                hold_ticks: self.hold_ticks,
                reentry_ticks: self.reentry_ticks,
            },
            observer_bandwidth: self.bandwidth,
            decay_rate: self.decay_rate,
            restart_distance: self.restart_distance,
        }
    }
}

impl<L: Library<N, TOOL, POINTS>, const N: usize, const TOOL: usize, const POINTS: usize>
    Exports<L, N, TOOL, POINTS>
{
    /// The limits of the robot's description, gains for the natural frequency `omega_n` (rad/s),
    /// and the usual numbers for the rest. Limits that the description does not have are infinite.
    pub(crate) fn described(tick: f32, omega_n: f32) -> Config<N> {
        let some = |limit: f32| if limit > 0.0 { limit } else { f32::INFINITY };
        let links = &model::<f32, L::Arm, N, N, N>().links;
        let limits = |of: fn(&dynamics_core::model::JointLimits<f32>) -> f32| {
            let mut limits = [f32::INFINITY; N];
            for (limit, link) in limits.iter_mut().zip(links) {
                *limit = of(&link.limits);
            }
            limits
        };
        let torque = limits(|limits| limits.torque).map(some);
        let mut config = Config {
            tick,
            resolution: 0.0,
            bandwidth: 10.0 * omega_n,
            decay_rate: omega_n,
            restart_distance: 0.15,
            ride_through_ticks: 5,
            hold_ticks: 100,
            reentry_ticks: 200,
            lower: limits(|limits| limits.lower),
            upper: limits(|limits| limits.upper),
            speed: limits(|limits| limits.velocity).map(some),
            acceleration: [f32::INFINITY; N],
            torque,
            rate: torque.map(|torque| 0.5 * torque),
            kp: [0.0; N],
            kd: [0.0; N],
        };
        let gains = Gains::from_inertia(&Self::inertia_of_joints(&config), omega_n, 1.0);
        (config.kp, config.kd) = (gains.kp, gains.kd);
        config
    }

    /// The inertia of each joint with all others free to give way, 1/(M⁻¹)ᵢᵢ, in the middle of the
    /// joints' ranges.
    fn inertia_of_joints(config: &Config<N>) -> [f32; N] {
        let mut q = [0.0; N];
        for (q, (lower, upper)) in q.iter_mut().zip(config.lower.iter().zip(&config.upper)) {
            let middle = 0.5 * (lower + upper);
            *q = if middle.is_finite() { middle } else { 0.0_f32.max(*lower).min(*upper) };
        }
        let m = L::Form::crba(&q, L::EFFECTS);
        let factors = Core::<L::Arm>::ltdl(&m);
        let mut inertia = [0.0; N];
        for (joint, inertia) in inertia.iter_mut().enumerate() {
            let mut unit = [0.0; N];
            if let Some(place) = unit.get_mut(joint) {
                *place = 1.0;
            }
            *inertia = match &factors {
                Ok(factors) => {
                    let inverse = Core::<L::Arm>::solve(factors, &unit);
                    1.0 / inverse.get(joint).copied().unwrap_or(1.0)
                }
                // A joint that moves no mass.
                Err(_) => m.get(joint, joint),
            };
        }
        inertia
    }
}

/// The source of a tick's reference.
enum Kind {
    /// No place has been named yet.
    None,
    /// Way-points, from this tick of the controller's clock on.
    Points { start: u32 },
    /// The caller, in each tick.
    Streamed,
}

struct Source<const N: usize, const POINTS: usize> {
    kind: Kind,
    motion: Trajectory<f32, N, POINTS>,
    /// The caller's last reference, and whether it is one of this tick.
    streamed: State<N>,
    is_fresh: bool,
}

impl<const N: usize, const POINTS: usize> Reference<f32, N> for Source<N, POINTS> {
    fn at(&self, tick: u32) -> State<N> {
        match self.kind {
            Kind::Points { start } => self.motion.at(tick.saturating_sub(start)),
            Kind::None | Kind::Streamed => self.streamed,
        }
    }

    fn ticks(&self) -> u32 {
        match self.kind {
            Kind::Points { start } => start.saturating_add(self.motion.ticks()),
            Kind::None | Kind::Streamed => 0,
        }
    }
}

/// The largest distance of the first way-point from an arm's position, rad or m.
const STEP: f32 = 1e-3;

/// A controller with its reference.
pub(crate) struct Control<L, const N: usize, const TOOL: usize, const POINTS: usize> {
    pub(crate) controller: MotionController<f32, N, CurrentTick>,
    source: Source<N, POINTS>,
    gains: Gains<f32, N>,
    config: Limits<N>,
    tool: Option<Tool>,
    measured: Option<Result<[f32; N], Fault>>,
    /// Whether the last tick had a measurement, of an arm that is stopped.
    knows_position: bool,
    library: PhantomData<L>,
}

/// The limits of the configuration with which references are compared.
struct Limits<const N: usize> {
    tick: f32,
    lower: [f32; N],
    upper: [f32; N],
    speed: [f32; N],
    acceleration: [f32; N],
}

impl<L: Library<N, TOOL, POINTS>, const N: usize, const TOOL: usize, const POINTS: usize>
    Control<L, N, TOOL, POINTS>
{
    /// A controller of an arm on its brake.
    ///
    /// # Errors
    /// `CONFIG` and the field.
    #[inline(never)]
    pub fn new(config: &Config<N>) -> Result<Self, Rejected> {
        config.check()?;
        let controller = MotionController::try_new(config.motion_controller())
            .map_err(|_| (status::CONFIG, Where::NOWHERE))?;
        Ok(Self {
            controller: controller.on_brake(),
            source: Source {
                kind: Kind::None,
                motion: Trajectory::REST,
                streamed: State::at([0.0; N]),
                is_fresh: false,
            },
            gains: Gains { kp: config.kp, kd: config.kd },
            config: Limits {
                tick: config.tick,
                lower: config.lower,
                upper: config.upper,
                speed: config.speed,
                acceleration: config.acceleration,
            },
            tool: None,
            measured: None,
            knows_position: false,
            library: PhantomData,
        })
    }

    /// Replaces the tool of the feed-forward.
    pub fn set_tool(&mut self, tool: Option<Tool>) {
        self.tool = tool;
    }

    fn is_stopped(&self) -> bool {
        matches!(self.controller.mode(), Mode::Stopped)
    }

    /// Accepts a position that the arm may be at.
    fn check_position(&self, q: &[f32; N], point: Option<usize>) -> Result<(), Rejected> {
        let reject = |status, field, joint| Err((status, Where::of(field, Some(joint), point)));
        if let Some(joint) = Exports::<L, N, TOOL, POINTS>::beyond(q) {
            let is_finite = q.get(joint).is_some_and(|q| q.is_finite());
            let status = if is_finite { status::ANGLE } else { status::NOT_FINITE };
            return reject(status, field::POSITION, joint);
        }
        let bounds = self.config.lower.iter().zip(&self.config.upper);
        for (joint, (q, (lower, upper))) in q.iter().zip(bounds).enumerate() {
            if q < lower || q > upper {
                let field = if q < lower { field::LOWER } else { field::UPPER };
                return reject(status::POINT, field, joint);
            }
        }
        Ok(())
    }

    /// The joint whose position differs from `last` by more than its `step`.
    fn jump(q: &[f32; N], last: &[f32; N], step: &[f32; N]) -> Option<usize> {
        let joints = q.iter().zip(last).zip(step);
        let near = |((q, now), step): ((&f32, &f32), &f32)| (q - now).abs() <= *step;
        joints.into_iter().position(|joint| !near(joint))
    }

    /// Plans the motion through way-points, which begins with the next tick or, of a stopped arm,
    /// with the next reset.
    ///
    /// # Errors
    /// `POINT`, `ANGLE` or `NOT_FINITE` with the way-point; `STATE` while the arm moves, which takes a goal instead; `TOO_FAR`
    /// if the first way-point is not where the arm stands. The reference is then as before.
    #[inline(never)]
    pub fn plan(&mut self, count: usize, points: &[WayPoint<N>; POINTS]) -> Result<(), Rejected> {
        let used = points.get(..count).and_then(|used| Some((used, used.first()?, used.last()?)));
        let Some((used, first, last)) = used else {
            return Err((status::POINT, Where::of(field::COUNT, None, None)));
        };
        for (point, way_point) in used.iter().enumerate() {
            self.check_position(&way_point.q, Some(point))?;
        }
        if let Some(joint) = last.qd.iter().position(|&qd| qd != 0.0) {
            let at = Where::of(field::VELOCITY, Some(joint), Some(count - 1));
            return Err((status::POINT, at));
        }
        if !self.is_stopped() {
            let moves = match self.source.kind {
                Kind::Points { .. } => self.controller.trajectory_tick() <= self.source.ticks(),
                _ => self.controller.reference().qd != [0.0; N],
            };
            if moves || !matches!(self.controller.mode(), Mode::Full) {
                return Err((status::STATE, Where::NOWHERE));
            }
            if let Some(joint) = Self::jump(&first.q, &self.controller.reference().q, &[STEP; N]) {
                let at = Where::of(field::POSITION, Some(joint), Some(0));
                return Err((status::TOO_FAR, at));
            }
        }
        // After the last way-point the arm rests there for a tick at each of those that are left.
        let rest = motion_control::reference::WayPoint { q: last.q, qd: [0.0; N], ticks: 1 };
        let mut planned = [rest; POINTS];
        for (place, &WayPoint { q, qd, ticks }) in planned.iter_mut().zip(used) {
            *place = motion_control::reference::WayPoint { q, qd, ticks };
        }
        let mut limits = [MotionLimits { velocity: 0.0, acceleration: 0.0 }; N];
        let given = self.config.speed.iter().zip(&self.config.acceleration);
        for (limits, (&velocity, &acceleration)) in limits.iter_mut().zip(given) {
            *limits = MotionLimits { velocity, acceleration };
        }
        let Source { motion, .. } = &mut self.source;
        motion.plan(&planned, self.config.tick, &limits).map_err(rejected)?;
        let start = self.controller.trajectory_tick();
        self.source.kind = Kind::Points { start };
        Ok(())
    }

    /// The state from which the arm may be led to this goal: of its reference, or at rest where it is while it is held or
    /// stopped.
    ///
    /// # Errors
    /// `ANGLE`, `NOT_FINITE`, `POINT`; `NO_MEASUREMENT` if it is stopped and nobody knows where.
    pub fn departure(&self, goal: &[f32; N]) -> Result<State<N>, Rejected> {
        self.check_position(goal, None)?;
        Ok(match self.controller.mode() {
            // While the arm returns to its reference, the controller's own is elsewhere.
            Mode::Full => self.source.at(self.controller.trajectory_tick().saturating_sub(1)),
            Mode::Stopped if !self.knows_position => {
                return Err((status::NO_MEASUREMENT, Where::NOWHERE));
            }
            _ => State::at(self.controller.estimate().q),
        })
    }

    /// The torques of a motion with the tool of the feed-forward, N·m or N.
    pub fn torques(&self, state: &State<N>) -> [f32; N] {
        Exports::<L, N, TOOL, POINTS>::inverse_dynamics_of(state, self.tool.as_ref())
    }

    /// Takes the reference of the next tick.
    ///
    /// # Errors
    /// `ANGLE`, `NOT_FINITE`, `POINT`; `TOO_FAR` if it is further from the last one than the joint
    /// can move in a tick. The tick then has no reference.
    pub fn follow(&mut self, reference: &State<N>) -> Result<(), Rejected> {
        self.check_position(&reference.q, None)?;
        finite(reference)?;
        let speeds = reference.qd.iter().zip(&self.config.speed);
        for (joint, (qd, speed)) in speeds.enumerate() {
            if qd.abs() > *speed {
                return Err((status::POINT, Where::of(field::SPEED, Some(joint), None)));
            }
        }
        if matches!(self.controller.mode(), Mode::Full) {
            // Twice the step of the greatest speed: the reference before it may have been left out.
            let step = self.config.speed.map(|speed| STEP + 2.0 * speed * self.config.tick);
            // While the arm returns to the reference after a fault, the controller's own reference
            // is elsewhere.
            let last = match self.source.kind {
                Kind::Streamed => self.source.streamed.q,
                Kind::None | Kind::Points { .. } => self.controller.reference().q,
            };
            if let Some(joint) = Self::jump(&reference.q, &last, &step) {
                return Err((status::TOO_FAR, Where::of(field::POSITION, Some(joint), None)));
            }
        }
        self.source.streamed = *reference;
        (self.source.kind, self.source.is_fresh) = (Kind::Streamed, true);
        Ok(())
    }

    /// Takes the measured positions of this tick, or the fault that prevented them.
    pub fn observe(&mut self, measured: Result<[f32; N], Fault>) {
        if self.measured.replace(measured).is_some() {
            self.controller.report(Fault::Unfinished);
        }
    }

    /// Ends the tick with a command.
    #[inline(never)]
    pub fn command(&mut self) -> Command<f32, N> {
        let measured = self.measured.take().unwrap_or(Err(Fault::Stale));
        if matches!(self.source.kind, Kind::Streamed) && !self.source.is_fresh {
            self.left_out();
        }
        self.source.is_fresh = false;
        let Self { controller, source, gains, tool, .. } = self;
        let law = |reference: &State<N>, estimate: &Estimate<f32, N>| {
            let mut torque =
                Exports::<L, N, TOOL, POINTS>::inverse_dynamics_of(reference, tool.as_ref());
            for (torque, pd) in torque.iter_mut().zip(feedback(gains, reference, estimate)) {
                *torque += pd;
            }
            torque
        };
        let command = controller.tick(measured.as_ref().map_err(|&fault| fault), source, law);
        if self.is_stopped() {
            self.knows_position = matches!(&measured, Ok(q) if check::inputs([q]).is_ok());
        }
        command
    }

    /// A tick without its reference is a fault that is bridged for a while, by a reference that
    /// moves on.
    #[cold]
    fn left_out(&mut self) {
        self.controller.report(Fault::Stale);
        let State { q, qd, qdd } = &mut self.source.streamed;
        *qdd = [0.0; N];
        if matches!(self.controller.mode(), Mode::Full) {
            for (q, qd) in q.iter_mut().zip(qd.iter()) {
                *q += qd * self.config.tick;
            }
        }
    }

    /// Reacts to a fault of the caller's.
    pub fn report(&mut self, fault: Fault) {
        self.controller.react(fault);
    }

    /// Zero torque and the brake from the next tick on.
    pub fn switch_off(&mut self) {
        self.controller.stop(Fault::External);
    }

    /// Reports ticks that have passed without a call.
    pub fn missed(&mut self, ticks: u32) {
        self.controller.missed(ticks, &self.source);
    }

    /// Starts a stopped arm.
    ///
    /// # Errors
    /// `NO_REFERENCE`, `STATE`, `NO_MEASUREMENT`; `OUT_OF_BOUNDS` or `TOO_FAR` with the joint.
    pub fn reset(&mut self) -> Result<(), Rejected> {
        if matches!(self.source.kind, Kind::None) {
            return Err((status::NO_REFERENCE, Where::NOWHERE));
        }
        let at = |joint| Where::of(field::POSITION, Some(joint), None);
        self.controller.reset(&self.source).map_err(|error| match error {
            ResetError::NotStopped => (status::STATE, Where::NOWHERE),
            ResetError::OutOfBounds { joint } => (status::OUT_OF_BOUNDS, at(joint)),
            ResetError::TooFar { joint } => (status::TOO_FAR, at(joint)),
            _ => (status::NO_MEASUREMENT, Where::NOWHERE),
        })
    }

    /// The estimate, the reference of the last tick, and the ticks that are left of the way-points.
    pub fn state(&self) -> (Estimate<f32, N>, State<N>, u32) {
        let left = self.source.ticks().saturating_sub(self.controller.trajectory_tick());
        (*self.controller.estimate(), *self.controller.reference(), left)
    }
}

/// Accepts a state of finite numbers.
pub(crate) fn finite<const N: usize>(State { q, qd, qdd }: &State<N>) -> Result<(), Rejected> {
    for (field, values) in [(field::POSITION, q), (field::VELOCITY, qd), (field::ACCELERATION, qdd)]
    {
        if let Some(joint) = values.iter().position(|x| !x.is_finite()) {
            return Err((status::NOT_FINITE, Where::of(field, Some(joint), None)));
        }
    }
    Ok(())
}

/// A way-point: `..._waypoint` of the header.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WayPoint<const N: usize> {
    /// Positions, rad or m.
    pub q: [f32; N],
    /// Velocities in passing, rad/s or m/s.
    pub qd: [f32; N],
    /// Ticks since the way-point before.
    pub ticks: u32,
}

/// The reason for which a planned motion was rejected.
fn rejected(error: TrajectoryError) -> Rejected {
    let (field, joint, point) = match error {
        TrajectoryError::NotFinite { point, joint }
        | TrajectoryError::NotAtRest { point, joint } => {
            (field::VELOCITY, Some(joint), Some(point))
        }
        TrajectoryError::Ticks { point } => (field::TICKS, None, Some(point)),
        TrajectoryError::Velocity { point, joint, .. } => (field::SPEED, Some(joint), Some(point)),
        TrajectoryError::Acceleration { point, joint, .. } => {
            (field::ACCELERATION, Some(joint), Some(point))
        }
        _ => (field::NONE, None, None),
    };
    (status::POINT, Where::of(field, joint, point))
}
