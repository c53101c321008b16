//! An arm under the library's motion controller, of whose inputs a case may spoil any, on a plant
//! whose time need not be the controller's.

use crate::measured::larger;
use dynamics_core::algorithms::{crba, rnea};
use dynamics_core::effects::{Armature, Coriolis, Gravity, Inertia};
use dynamics_core::model::{ArmModel, model};
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::Real;
use dynamics_core::sim::semi_implicit;
use dynamics_core::state::State;
use motion_control::law::{Gains, feedback};
use motion_control::limits::{Command, Fault, Mode, MotionLimits, SafetyLimits};
use motion_control::motion::{CurrentTick, MotionController, MotionControllerConfig, ResetError};
use motion_control::reference::{Trajectory, WayPoint};
use motion_control::safety::SupervisorConfig;

/// A tick, s.
pub const TICK: f64 = 1e-3;
/// The arm's first configuration, rad.
pub const HOME: [f64; 6] = [0.0, -1.57, 1.57, -1.57, -1.57, 0.0];
/// Greatest torques, N·m; half of each a tick.
pub const TORQUE: [f64; 6] = [150.0, 150.0, 150.0, 28.0, 28.0, 28.0];
/// Ticks that a fault is ridden through, held, and that the return takes.
pub const RIDE: u32 = 5;
pub const HOLD: u32 = 100;
pub const REENTRY: u32 = 200;
const OMEGA: f64 = 25.0;

/// A number that should not be where it is.
#[derive(Clone, Copy, Debug)]
pub struct Poison<R> {
    pub input: Input,
    pub joint: usize,
    pub value: R,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    Position,
    /// The reference that the law is given: position, velocity, acceleration.
    Reference(usize),
    /// The torque that the law asks for.
    Torque,
}

pub const INPUTS: [Input; 5] =
    [Input::Position, Input::Reference(0), Input::Reference(1), Input::Reference(2), Input::Torque];

/// With the rotors of scene `ur5e`, without which the wrist weighs next to nothing.
type Scene<R> = (Gravity, Inertia, Coriolis, Armature<R, 6>);

/// The controller and its arm.
#[derive(Clone, Copy)]
pub struct Bench<R: Real> {
    model: &'static ArmModel<R, 6>,
    scene: Scene<R>,
    trajectory: Trajectory<R, 6, 3>,
    gains: Gains<R, 6>,
    controller: MotionController<R, 6, CurrentTick>,
    /// The commands to the drives.
    pub command: [R; 6],
    /// Whether the brake holds the arm.
    pub brake: bool,
    /// The reference of the arm.
    pub aim: State<R, 6, 6>,
    pub arm: State<R, 6, 6>,
}

impl<R: Real> Bench<R> {
    /// An arm at home that is to move all its joints by `step` rad in `ticks`, to wait as long, and
    /// to come back.
    pub fn new(step: f64, ticks: u32) -> Self {
        let of = |x: [f64; 6]| x.map(R::from_f64);
        let stop = |q, ticks| WayPoint { q: of(q), qd: of([0.0; 6]), ticks };
        let away = HOME.map(|q| q + step);
        let speeds =
            [MotionLimits { velocity: R::from_f64(3.0), acceleration: R::from_f64(30.0) }; 6];
        let points = [stop(HOME, 0), stop(away, ticks), stop(HOME, ticks)];
        let limits = SafetyLimits {
            torque: of(TORQUE),
            rate: of(TORQUE.map(|tau| 0.5 * tau)),
            speed: of([3.2; 6]),
            lower: of([-6.3; 6]),
            upper: of([6.3; 6]),
        };
        let (model, tick) = (model::<R, Ur5e, 6, 6, 6>(), R::from_f64(TICK));
        let rotors = Armature(of([0.9, 0.9, 0.9, 0.25, 0.25, 0.25]));
        let scene = (Gravity::EARTH, Inertia, Coriolis, rotors);
        let m = crba(model, &of(HOME), &scene);
        let diagonal = core::array::from_fn(|j| m.get(j, j));
        Self {
            model,
            scene,
            trajectory: Trajectory::new(&points, tick, &speeds).expect("slow enough"),
            gains: Gains::from_inertia(&diagonal, R::from_f64(OMEGA), R::ONE),
            controller: MotionController::new(MotionControllerConfig {
                supervisor: SupervisorConfig {
                    limits,
                    tick,
                    resolution: R::ZERO,
                    ride_through_ticks: RIDE,
                    hold_ticks: HOLD,
                    reentry_ticks: REENTRY,
                },
                observer_bandwidth: R::from_f64(250.0),
                decay_rate: R::from_f64(OMEGA),
                restart_distance: R::ONE / R::ZERO,
            }),
            command: of([0.0; 6]),
            brake: false,
            aim: State::at(of(HOME)),
            arm: State::at(of(HOME)),
        }
    }

    /// A tick of the controller, with a number in it that should not be there.
    pub fn tick(&mut self, poison: Option<Poison<R>>) -> Command<R, 6> {
        let mut q = self.arm.q;
        spoil(&mut q, poison, Input::Position);
        self.tick_of(Ok(&q), poison)
    }

    /// A tick that comes after this many missed ones, which a timer has counted: time goes on, and
    /// what is expected.
    pub fn late_tick(&mut self, missed: u32) -> Command<R, 6> {
        self.controller.missed(missed, &self.trajectory);
        self.tick(None)
    }

    pub fn tick_of(
        &mut self,
        measured: Result<&[R; 6], Fault>,
        poison: Option<Poison<R>>,
    ) -> Command<R, 6> {
        let (model, scene, gains) = (self.model, &self.scene, &self.gains);
        let followed = &mut self.aim;
        let trajectory = &self.trajectory;
        let command = self.controller.tick(measured, trajectory, |reference, estimate| {
            *followed = *reference;
            let mut aim = *reference;
            spoil(&mut aim.q, poison, Input::Reference(0));
            spoil(&mut aim.qd, poison, Input::Reference(1));
            spoil(&mut aim.qdd, poison, Input::Reference(2));
            let mut tau = rnea(model, &aim, scene);
            for (tau, pd) in tau.iter_mut().zip(feedback(gains, &aim, estimate)) {
                *tau += pd;
            }
            spoil(&mut tau, poison, Input::Torque);
            tau
        });
        (self.command, self.brake) = (command.torque, command.brake);
        command
    }

    pub fn mode(&self) -> Mode {
        self.controller.mode()
    }

    /// Starts a stopped arm again, wherever it is.
    ///
    /// # Errors
    /// [`ResetError`], of an arm that is not stopped or not measured.
    pub fn reset(&mut self) -> Result<(), ResetError> {
        self.controller.reset(&self.trajectory)
    }

    /// The arm moves on by `seconds` under the last command, in steps of a quarter of a tick or
    /// less.
    pub fn advance(&mut self, seconds: f64) {
        if self.brake {
            self.arm.qd = [R::ZERO; 6];
            return;
        }
        let steps = (seconds / (0.25 * TICK)).ceil().max(1.0);
        let h = R::from_f64(seconds / steps);
        for _ in 0..steps as u32 {
            semi_implicit(self.model, &mut self.arm, &self.command, &self.scene, h)
                .expect("M is positive definite");
        }
    }

    /// The largest |τ| of the last command relative to what is allowed; infinite if one is no
    /// number.
    pub fn effort(&self) -> f64 {
        let share = |(tau, most): (&R, f64)| tau.to_f64().abs() / most;
        let shares = self.command.iter().zip(TORQUE).map(share);
        shares.fold(0.0, |worst, share| {
            if share <= worst {
                worst
            } else if share.is_finite() {
                share
            } else {
                f64::INFINITY
            }
        })
    }

    /// The largest distance of a joint from its reference, rad.
    pub fn error(&self) -> f64 {
        apart(&self.aim.q, &self.arm.q)
    }
}

pub fn apart<R: Real>(a: &[R; 6], b: &[R; 6]) -> f64 {
    let apart = |(a, b): (&R, &R)| (a.to_f64() - b.to_f64()).abs();
    a.iter().zip(b).map(apart).fold(0.0, larger)
}

fn spoil<R: Real>(values: &mut [R; 6], poison: Option<Poison<R>>, input: Input) {
    if let Some(poison) = poison.filter(|poison| poison.input == input) {
        values[poison.joint] = poison.value;
    }
}
