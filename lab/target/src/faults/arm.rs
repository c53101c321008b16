//! An arm with its firmware, of which faults spoil the inputs.

use core::marker::PhantomData;

use dynamics_core::state::State;
use motion_control::{
    Approach, ApproachError, BackOff, BackOffConfig, CurrentTick, Detect, Detectors, Estimate,
    Fault, FrozenEncoder, Gains, Mode, MotionController, MotionControllerConfig, MotionLimits,
    Reference, ReferenceStep, Saturation, StopCategory, SupervisorConfig, Trajectory,
};

use super::kinds::{Kind, Onset};
use super::plants::{Plant, TICK};

/// Ticks that a fault is ridden through.
pub const RIDE: u32 = 5;
/// Ticks of a hold before the stop.
pub const HOLD: u32 = 100;
const REENTRY: u32 = 200;
/// The most ticks that are missed at once.
const MISSED: u32 = 40;

/// The parts of the firmware that may be wrong on purpose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setup {
    /// The supervisor's limits of torque and rate, as a share of the rated ones.
    pub limits: f32,
    /// Missed ticks after which the watchdog restarts the processor: the drives keep an old torque
    /// until then.
    pub watchdog: u32,
}

impl Setup {
    /// The setup without any fault.
    pub const SOUND: Self = Self {
        limits: 1.0,
        watchdog: 20,
    };
    pub const UNWATCHED: Self = Self {
        watchdog: MISSED,
        ..Self::SOUND
    };
}

/// A claim that did not hold in a run.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Violation {
    /// A joint is faster than its rated speed.
    #[error("joint {joint}: speed {velocity} rad/s")]
    Speed {
        joint: usize,
        /// The joint's velocity, rad/s.
        velocity: f32,
    },
    /// The kinetic energy is above that at the rated speeds.
    #[error("kinetic energy {kinetic} J of {rated} J")]
    Energy {
        /// J.
        kinetic: f32,
        /// J.
        rated: f32,
    },
    /// A torque or its change in a tick is above its limit, or not finite.
    #[error("joint {joint}: torque {torque} N·m after {before} N·m")]
    Torque {
        joint: usize,
        /// N·m.
        torque: f32,
        /// The torque in the tick before, N·m.
        before: f32,
    },
    /// The arm was not on its motion at the end.
    #[error("no recovery: {mode:?} by {fault:?}")]
    NotRecovered { mode: Mode, fault: Option<Fault> },
    /// The motion itself exceeds the arm's limits.
    #[error("the motion exceeds the arm's limits")]
    Motion,
}

/// A reference that is somewhere else.
struct Offset<'a, T>(&'a T, f32);

impl<T: Reference<f32, V>, const V: usize> Reference<f32, V> for Offset<'_, T> {
    fn at(&self, tick: u32) -> State<f32, V, V> {
        let mut state = self.0.at(tick);
        state.q.iter_mut().for_each(|q| *q += self.1);
        state
    }
    fn ticks(&self) -> u32 {
        self.0.ticks()
    }
}

/// The motion, or the path to its start and the motion.
enum Path<'a, const V: usize> {
    Motion(&'a Trajectory<f32, V, 3>),
    Approach(Approach<'a, f32, V, Trajectory<f32, V, 3>>),
}

impl<const V: usize> Reference<f32, V> for Path<'_, V> {
    fn at(&self, tick: u32) -> State<f32, V, V> {
        match self {
            Self::Motion(motion) => motion.at(tick),
            Self::Approach(path) => path.at(tick),
        }
    }
    fn ticks(&self) -> u32 {
        u32::MAX
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Episode {
    pub onset: Onset,
    /// Its first tick, and the first after it.
    pub ticks: [u32; 2],
    /// The position of its joint at the begin.
    pub held: f32,
}

/// The controller of an arm of the injection.
pub type Controller<const V: usize> = MotionController<f32, V, CurrentTick>;

pub fn controller<P: Plant<V>, const V: usize>(setup: Setup) -> Controller<V> {
    // A speed is detected when it is exceeded: the reaction takes place between the supervisor's
    // limit and the rated speed.
    let mut limits = P::LIMITS.with_speed_share(0.8);
    limits.torque = limits.torque.map(|limit| limit * setup.limits);
    limits.rate = limits.rate.map(|limit| limit * setup.limits);
    MotionController::new(MotionControllerConfig {
        supervisor: SupervisorConfig {
            limits,
            tick: TICK,
            resolution: 1e-4,
            ride_through_ticks: RIDE,
            hold_ticks: HOLD,
            reentry_ticks: REENTRY,
        },
        observer_bandwidth: 250.0,
        decay_rate: P::DECAY,
        restart_distance: 0.05,
    })
    .with_stop(P::STOP)
}

fn detectors<P: Plant<V>, const V: usize>() -> Detectors<f32, V> {
    Detectors {
        frozen: FrozenEncoder::new([0.003; V], 3),
        steps: ReferenceStep::new(P::LIMITS.speed.map(|speed| 2.0 * speed * TICK)),
        saturation: Saturation::new(P::LIMITS.torque, 5),
    }
}

pub(super) struct Arm<'a, P, const V: usize> {
    gains: Gains<f32, V>,
    pub state: State<f32, V, V>,
    pub controller: Controller<V>,
    path: Path<'a, V>,
    pub back_off: Option<BackOff<f32, V>>,
    detectors: Detectors<f32, V>,
    pub torque: [f32; V],
    brake: bool,
    setup: Setup,
    plant: PhantomData<P>,
}

impl<'a, P: Plant<V>, const V: usize> Arm<'a, P, V> {
    pub fn new(motion: &'a Trajectory<f32, V, 3>, setup: Setup) -> Self {
        Self {
            gains: P::gains(),
            state: State::at(P::HOME),
            controller: controller::<P, V>(setup),
            path: Path::Motion(motion),
            back_off: None,
            detectors: detectors::<P, V>(),
            torque: [0.0; V],
            brake: false,
            setup,
            plant: PhantomData,
        }
    }

    /// A tick of the plant, whose limits must hold.
    pub fn advance(&mut self) -> Result<(), Violation> {
        if self.brake & P::BRAKE {
            self.state.qd = [0.0; V];
        } else {
            P::step(&mut self.state, &self.torque);
        }
        let [kinetic, rated] = P::kinetic(&self.state);
        for (joint, (&velocity, &limit)) in self.state.qd.iter().zip(&P::LIMITS.speed).enumerate() {
            let within = velocity.abs() <= limit;
            if !within {
                return Err(Violation::Speed { joint, velocity });
            }
        }
        if kinetic > rated || !kinetic.is_finite() {
            return Err(Violation::Energy { kinetic, rated });
        }
        Ok(())
    }

    /// A tick of the firmware with the faults of now.
    pub fn tick(
        &mut self,
        now: u32,
        episodes: &[Episode],
    ) -> Result<(Mode, Option<Fault>), Violation> {
        let begins = |episode: &Episode| episode.ticks[0] == now;
        let mut q = self.state.q;
        let (mut measured, mut poison, mut offset) = (Ok(()), None, 0.0);
        let mut external = None;
        for episode in episodes
            .iter()
            .filter(|e| (e.ticks[0]..e.ticks[1]).contains(&now))
        {
            let Onset { kind, joint, value } = episode.onset;
            let joint = joint as usize % V;
            match kind {
                Kind::NotFinite => q[joint] = f32::NAN,
                Kind::Range => q[joint] = 100.0,
                Kind::Encoder => measured = Err(Fault::Encoder { joint }),
                Kind::Stale => measured = Err(Fault::Stale),
                Kind::Frozen => q[joint] = episode.held,
                Kind::Jump => q[joint] += 0.3,
                Kind::Reference => offset = 0.3,
                Kind::NotReady => self.controller.react(Fault::NotReady { joint }),
                Kind::Torque => poison = Some((joint, f32::NAN)),
                Kind::Saturated => poison = Some((joint, 1e6)),
                _ if !begins(episode) => {}
                Kind::Drive => self.controller.react(Fault::Drive { joint }),
                Kind::Model => self.controller.react(Fault::Model),
                Kind::Overflow => self.controller.react(Fault::Overflow),
                Kind::Overrun => self.controller.react(Fault::Overrun),
                Kind::Unfinished => {
                    let _ = self.controller.observe(Ok(&q));
                    self.advance()?;
                    q = self.state.q;
                }
                Kind::Missed => {
                    let ticks = 1 + value % MISSED;
                    (0..ticks.min(self.setup.watchdog)).try_for_each(|_| self.advance())?;
                    if ticks > self.setup.watchdog {
                        self.restart();
                    } else {
                        self.controller.missed(ticks, &self.path);
                    }
                    q = self.state.q;
                }
                Kind::Restarted => self.restart(),
                Kind::External => external = Some(value % 3),
            }
        }
        let gains = self.gains;
        let law = |reference: &State<f32, V, V>, estimate: &Estimate<f32, V>| {
            let mut tau = P::law(&gains, reference, estimate);
            if let Some((joint, poison)) = poison {
                tau[joint] = poison;
            }
            tau
        };
        let measured = measured
            .and_then(|()| (self.detectors).measured(&q, &self.controller.reference().q))
            .map(|()| &q);
        if let (Some(category), Some(_)) = (external, &self.back_off) {
            self.controller
                .stop_by(Fault::External, category_of(category));
        }
        let command = if let Some(back_off) = &mut self.back_off {
            let command = back_off.tick(&mut self.controller, measured, law);
            if back_off.is_done() | (command.status.mode == Mode::Stopped) {
                self.back_off = None;
            }
            command
        } else {
            let reference = Offset(&self.path, offset);
            let mut tick = self.controller.observe(measured).reference(&reference);
            if let Err(fault) = (self.detectors).referenced(tick.reference(), tick.mode()) {
                tick.stop_by(fault, StopCategory::ControlledOff);
            }
            if let Some(category) = external {
                tick.stop_by(Fault::External, category_of(category));
            }
            let tau = law(tick.reference(), tick.estimate());
            tick.command(&tau)
        };
        if let Err(fault) = self.detectors.commanded(&command) {
            self.controller.react(fault);
        }
        let stopped = command.status.mode == Mode::Stopped;
        for joint in 0..V {
            let (tau, limits) = (command.torque[joint], &P::LIMITS);
            let step = (tau - self.torque[joint]).abs();
            // A stop may take the torque away at once; half a unit in the last place of the rate.
            let steady = step <= limits.rate[joint] * 1.0001 || stopped & (tau == 0.0);
            let within = tau.abs() <= limits.torque[joint];
            if !within || !steady {
                let before = self.torque[joint];
                return Err(Violation::Torque {
                    joint,
                    torque: tau,
                    before,
                });
            }
        }
        (self.torque, self.brake) = (command.torque, command.brake);
        self.advance()?;
        Ok((command.status.mode, command.status.fault))
    }

    /// The processor restarts: by a brown-out, or by the watchdog. Its drives have no torque.
    fn restart(&mut self) {
        self.controller = controller::<P, V>(self.setup);
        self.controller.react(Fault::Restarted);
        self.detectors = detectors::<P, V>();
        self.back_off = None;
        (self.torque, self.brake) = ([0.0; V], true);
    }

    /// Starts an arm that is stopped or held, wherever it is.
    pub fn recover(&mut self, motion: &'a Trajectory<f32, V, 3>) -> bool {
        match self
            .controller
            .approach(motion, &[P::MOTION; V], &P::LIMITS)
        {
            Ok(path) => {
                if self.controller.reset(&path).is_err() {
                    return false;
                }
                self.path = Path::Approach(path);
            }
            Err(ApproachError::Position { .. }) => {
                let limits = MotionLimits {
                    velocity: 0.5,
                    acceleration: 4.0,
                };
                let config = BackOffConfig {
                    limits,
                    margin: 0.05,
                };
                self.back_off = BackOff::start(&mut self.controller, &config).ok();
            }
            Err(_) => return false,
        }
        self.detectors.restart();
        true
    }
}

fn category_of<const V: usize>(number: u32) -> StopCategory<f32, V> {
    match number {
        0 => StopCategory::TorqueOff,
        1 => StopCategory::ControlledOff,
        _ => StopCategory::ControlledHold,
    }
}
