//! "Disturb me": the plant of a scene with its own control loop, encoders, drives and supervisor,
//! which the page pushes and whose inputs it spoils.

use std::cell::Cell;
use std::convert::Infallible;
use std::marker::PhantomData;
use std::rc::Rc;

use dynamics_core::algorithms::{frame, jacobian, poses};
use dynamics_core::effects::Effect;
use dynamics_core::model::{Robot, model};
use dynamics_core::spatial::Force;
use dynamics_core::state::State;
use embedded_hal::digital::{ErrorType, OutputPin};
use firmware_demo::plant::{Plant, Simulated};
use firmware_demo::scene::{Devices, Effects, Scene, SceneLoop, Start};
use firmware_demo::scenes::{panda_payload::Carry, scara_table::Serve, ur5e::PickAndPlace};
use firmware_demo::sim_io::{SimDrive, SimEncoder, Wires};
use glam::Vec3;
use joint_drivers::{Law, Telemetry};
use motion_control::estimate::Estimate;
use motion_control::law::{Gains, feedback};
use motion_control::limits::{Fault, Mode};
use motion_control::reference::Reference;
use motion_control::safety::{Detectors, StopCategory};
use serde::{Deserialize, Serialize};

/// The disturbances that the page applies to an arm.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub struct Disturbance {
    /// The ticks that pass, at most [`MOST`].
    pub ticks: u32,
    /// Whether the law has its feed-forward, or is PD control alone.
    pub feedforward: bool,
    /// The body that is pushed, and the force, N, in the base's frame.
    pub body: usize,
    pub force: [f32; 3],
}

/// The most ticks of a call: the page may have been asleep.
pub const MOST: u32 = 100;

/// The faults that the page can cause.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Injected {
    /// The encoder goes on answering with the position of now.
    Stale,
    /// The encoder's frames carry its error flag.
    Encoder,
    /// The law's torque is not a number.
    Nan,
    /// The law asks for a million N·m.
    OverTorque,
    /// The user presses the emergency stop.
    Stop,
}

/// An arm as the page shows it.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Shown {
    /// The poses of the bodies, as in `Computed`.
    pub poses: Vec<[f32; 12]>,
    pub torque: Vec<f32>,
    pub limits: Vec<f32>,
    pub mode: String,
    pub fault: Option<String>,
    pub brake: bool,
    pub tick: u32,
    /// The largest tracking error of a joint in each of the ticks that passed, rad.
    pub errors: Vec<f32>,
    /// Changes of mode or fault in them, and torques beyond a limit: tick, mode, fault or words.
    pub events: Vec<(u32, String, Option<String>)>,
}

/// A scene that is disturbed.
pub trait Disturbed {
    fn tick(&mut self, by: &Disturbance) -> Shown;
    /// Lets a fault last for some ticks.
    fn inject(&mut self, what: Injected, joint: usize, ticks: u32);
    /// Restarts an arm that has stopped.
    ///
    /// # Errors
    /// The controller's reason not to.
    fn reset(&mut self) -> Result<(), String>;
}

/// The scene of a robot's key.
///
/// # Errors
/// No scene, or one that does not start.
pub fn of(robot: &str) -> Result<Box<dyn Disturbed>, String> {
    Ok(match robot {
        "ur5e" => Box::new(Arm::<PickAndPlace, 6>::new()?),
        "panda" => Box::new(Arm::<Carry, 7>::new()?),
        "scara" => Box::new(Arm::<Serve, 3>::new()?),
        other => return Err(format!("`{other}` has no scene on this page")),
    })
}

/// The keys of the robots that have a scene here, with the scenes' names.
pub const SCENES: [(&str, &str); 3] =
    [("ur5e", PickAndPlace::NAME), ("panda", Carry::NAME), ("scara", Serve::NAME)];

/// A brake that says whether it holds.
#[derive(Clone, Debug, Default)]
struct Brake(Rc<Cell<bool>>);

impl ErrorType for Brake {
    type Error = Infallible;
}
impl OutputPin for Brake {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.0.set(false);
        Ok(())
    }
    fn set_high(&mut self) -> Result<(), Infallible> {
        self.0.set(true);
        Ok(())
    }
}

/// A motion again and again, with a pause.
struct Repeated<T>(T);

/// The number of ticks of the pause.
const PAUSE: u32 = 200;

impl<T: Reference<f32, N>, const N: usize> Reference<f32, N> for Repeated<T> {
    fn at(&self, tick: u32) -> State<f32, N, N> {
        self.0.at(tick % (self.0.ticks() + PAUSE))
    }
    fn ticks(&self) -> u32 {
        u32::MAX
    }
}

/// The measurements that the law reads beside the reference.
struct Input<'a, X> {
    environment: &'a X,
    /// The torques that the law asked for, before the gate limits them.
    asked: &'a Cell<[f32; MOST_JOINTS]>,
    /// A torque in place of a joint's.
    poison: Option<(usize, f32)>,
}

/// The most joints of a scene here.
const MOST_JOINTS: usize = 7;

/// The scene's law, with a torque that may be spoilt.
struct Whole<S>(PhantomData<S>);
/// PD control alone, with a torque that may be spoilt.
struct PdAlone<S>(PhantomData<S>);

fn spoilt<const N: usize>(mut tau: [f32; N], poison: Option<(usize, f32)>) -> [f32; N] {
    if let Some((joint, torque)) = poison {
        tau[joint] = torque;
    }
    tau
}

macro_rules! law {
    ($law:ident, $accelerates:expr, |$reference:ident, $environment:ident| $feedforward:expr) => {
        impl<S: Scene<N, N, N, N>, const N: usize> Law<N, Input<'_, S::Environment>> for $law<S> {
            const ACCELERATES: bool = $accelerates;

            fn feedforward(
                $reference: &State<f32, N, N>,
                Input { environment: $environment, .. }: &Input<'_, S::Environment>,
            ) -> [f32; N] {
                $feedforward
            }

            fn torque(
                gains: &Gains<f32, N>,
                reference: &State<f32, N, N>,
                estimate: &Estimate<f32, N>,
                input: &Input<'_, S::Environment>,
            ) -> [f32; N] {
                let mut tau = Self::feedforward(reference, input);
                let pd = feedback(gains, reference, estimate);
                tau.iter_mut().zip(pd).for_each(|(tau, pd)| *tau += pd);
                let tau = spoilt(tau, input.poison);
                input.asked.set(std::array::from_fn(|j| tau.get(j).copied().unwrap_or_default()));
                tau
            }
        }
    };
}
law!(Whole, true, |reference, environment| S::inverse(
    reference,
    environment,
    &S::current(environment)
));
law!(PdAlone, false, |_reference, _environment| [0.0; N]);

type SimulatedLoop<const N: usize> = SceneLoop<SimEncoder, SimDrive, Brake, N, Detectors<f32, N>>;

struct Arm<S: Scene<N, N, N, N>, const N: usize> {
    reference: Repeated<S::Reference>,
    wires: &'static Wires<N>,
    plant: S::Plant,
    brake: Brake,
    control: SimulatedLoop<N>,
    limits: [f32; N],
    /// The trajectory's tick, on which the environment depends, and the ticks of all.
    clock: u32,
    tick: u32,
    fault: Option<(Injected, usize, u32)>,
    /// The position at which an encoder is stuck.
    held: f32,
    last: (Mode, Option<Fault>),
    /// The joints that were asked for more than their limit of torque in the tick before.
    beyond: [bool; N],
    /// The plant has no forward dynamics in its state.
    broken: bool,
}

impl<S, E, X, const N: usize> Arm<S, N>
where
    S: Scene<
            N,
            N,
            N,
            N,
            Environment = X,
            Effects = E,
            Plant = Plant<<S as Scene<N, N, N, N>>::Robot, E, X, N, N, N>,
        >,
    E: Effects<S, N, N, N, N> + Effect<f32, N, N>,
{
    fn new() -> Result<Self, String> {
        let reference = S::reference().map_err(|error| error.to_string())?;
        // A session starts a handful of scenes; what they leak are some bytes each.
        let wires: &'static Wires<N> = Box::leak(Box::new(Wires::new()));
        let plant = S::plant(None);
        wires.publish(&Simulated::<X, N>::encoder_positions(&plant));
        let brake = Brake::default();
        let devices = Devices {
            encoders: std::array::from_fn(|joint| wires.encoder(joint)),
            drives: std::array::from_fn(|joint| wires.drive(joint)),
            brake: brake.clone(),
        };
        let gains = S::gains(&S::environment(&reference, 0.0));
        let control = S::control_loop(devices, gains, S::detectors(), Start::OnTrajectory)
            .map_err(|error| error.to_string())?;
        Ok(Self {
            reference: Repeated(reference),
            wires,
            plant,
            brake,
            control,
            limits: S::LIMITS.map(|limit| limit.torque),
            clock: 0,
            tick: 0,
            fault: None,
            held: 0.0,
            last: (Mode::Full, None),
            beyond: [false; N],
            broken: false,
        })
    }

    fn environment(&self, ticks: f32) -> X {
        S::environment(&self.reference.0, ticks)
    }

    /// The tick within the motion that is repeated.
    fn within(&self) -> f32 {
        (self.clock % (self.reference.0.ticks() + PAUSE)) as f32
    }

    /// A tick of the firmware, and one of the plant.
    fn one(&mut self, by: &Disturbance, shown: &mut Shown) {
        let (mut poison, mut stuck) = (None, None);
        if let Some((what, joint, left)) = self.fault {
            match what {
                Injected::Stale => stuck = Some(joint),
                Injected::Encoder => self.wires.flag(joint),
                Injected::Nan => poison = Some((joint, f32::NAN)),
                Injected::OverTorque => poison = Some((joint, 1e6)),
                Injected::Stop => {
                    let category = StopCategory::ControlledOff;
                    self.control.stop_by(Fault::External, category);
                }
            }
            self.fault = (left > 1).then_some((what, joint, left - 1));
        }
        let now = self.within();
        let environment = self.environment(now);
        let asked = Cell::default();
        let input = Input { environment: &environment, asked: &asked, poison };
        let telemetry = match by.feedforward {
            true => self.control.tick::<Whole<S>, _, _>(&self.reference, &input),
            false => self.control.tick::<PdAlone<S>, _, _>(&self.reference, &input),
        };
        self.clock = telemetry.tick;
        // The reference is that of this tick: it is compared with where the arm is now.
        self.show(&telemetry, asked.get(), shown);
        self.advance(by, now, stuck);
        self.tick += 1;
    }

    /// The plant's part of a tick: the drives' torques and the push, or the brake.
    fn advance(&mut self, by: &Disturbance, now: f32, stuck: Option<usize>) {
        let duties = self.wires.duties();
        let push = self.push(by);
        let tau: [f32; N] = std::array::from_fn(|j| duties[j] * self.limits[j] + push[j]);
        if self.brake.0.get() {
            self.plant.state.qd = [0.0; N];
        } else {
            let part = 1.0 / S::STEPS as f32;
            for step in 0..S::STEPS {
                let environment = self.environment(now + part * step as f32);
                let stepped = self.plant.step(&tau, &environment, S::TICK * part);
                self.broken |= stepped.is_err();
            }
        }
        let mut positions = Simulated::<X, N>::encoder_positions(&self.plant);
        if let Some(joint) = stuck {
            positions[joint] = self.held;
        }
        self.wires.publish(&positions);
    }

    /// Jᵀ F of the push.
    fn push(&self, by: &Disturbance) -> [f32; N] {
        let force = Vec3::from_array(by.force);
        if force == Vec3::ZERO || !force.is_finite() {
            return [0.0; N];
        }
        let robot = model::<f32, S::Robot, N, N, N>();
        let body = by.body.min(N - 1);
        let columns = jacobian(robot, &self.plant.state.q, body, frame::LocalWorldAligned);
        columns.map(|column| column.dot(Force::new(Vec3::ZERO, force)))
    }

    fn show(&mut self, telemetry: &Telemetry<N>, asked: [f32; MOST_JOINTS], shown: &mut Shown) {
        let actual = self.plant.state.q;
        let errors = telemetry.reference.iter().zip(actual);
        let worst = errors.map(|(r, q)| (r - q).abs()).fold(0.0, f32::max);
        shown.errors.push(worst);
        let status = telemetry.status;
        for (joint, (asked, limit)) in asked.into_iter().zip(self.limits).enumerate() {
            let beyond = asked.abs() > limit;
            if beyond && !self.beyond[joint] {
                let words = format!(
                    "joint {joint}: {asked} N·m or N were asked for, and {limit} are its limit"
                );
                shown.events.push((self.tick, mode(status.mode), Some(words)));
            }
            self.beyond[joint] = beyond;
        }
        if (status.mode, status.fault) != self.last {
            self.last = (status.mode, status.fault);
            let fault = status.fault.map(|fault| fault.to_string());
            shown.events.push((self.tick, mode(status.mode), fault));
        }
        shown.torque = telemetry.torque.to_vec();
        shown.mode = mode(status.mode);
        shown.fault = status.fault.map(|fault| fault.to_string());
    }
}

fn mode(mode: Mode) -> String {
    format!("{mode:?}")
}

impl<S, E, X, const N: usize> Disturbed for Arm<S, N>
where
    S: Scene<
            N,
            N,
            N,
            N,
            Environment = X,
            Effects = E,
            Plant = Plant<<S as Scene<N, N, N, N>>::Robot, E, X, N, N, N>,
        >,
    E: Effects<S, N, N, N, N> + Effect<f32, N, N>,
    S::Robot: Robot<N, N, N>,
{
    fn tick(&mut self, by: &Disturbance) -> Shown {
        let mut shown = Shown::default();
        for _ in 0..by.ticks.min(MOST) {
            if self.broken {
                shown.fault = Some(
                    "the simulated arm has no forward dynamics in this state: start again"
                        .to_owned(),
                );
                break;
            }
            self.one(by, &mut shown);
        }
        let robot = model::<f32, S::Robot, N, N, N>();
        let poses = poses(robot, &self.plant.state.q);
        shown.poses = poses
            .iter()
            .map(|pose| {
                let (p, axes) = (pose.pos.to_array(), pose.rot.to_cols_array());
                std::array::from_fn(|i| if i < 3 { p[i] } else { axes[i - 3] })
            })
            .collect();
        shown.limits = self.limits.to_vec();
        shown.brake = self.brake.0.get();
        shown.tick = self.tick;
        shown
    }

    fn inject(&mut self, what: Injected, joint: usize, ticks: u32) {
        let joint = joint.min(N - 1);
        self.held = self.plant.state.q[joint];
        self.fault = Some((what, joint, ticks.clamp(1, 10_000)));
    }

    fn reset(&mut self) -> Result<(), String> {
        self.fault = None;
        self.control.reset(&self.reference).map_err(|error| error.to_string())
    }
}
