//! The arm, its bus, and the firmware's tick.

use core::convert::Infallible;
use std::cell::{Cell, RefCell};

use dynamics_core::model::Calibrated;
use dynamics_core::sim::{Integrator, LinearlyImplicit, ModelDynamics};
use dynamics_core::state::State;
use embedded_hal::digital::{self, OutputPin};
use joint_drivers::{Direction, Law};
use motion_control::limits::{Mode, Status};
use motion_control::reference::Reference;
use motion_control::safety::Detect;

use crate::damiao_bus::{Bus, Drive, Wire};
use crate::robot::board::{
    self, Control, DRIVES, Devices, Found, Motion, Operator, SCALES, ZERO, bus,
};
use crate::robot::control::Gains;
use crate::robot::say::{Line, Memory, Said, of_refusal};
use crate::robot::scene::{Arm, EFFECTS, Effects, N, TICK, home};

/// Whether the description has rotors and friction, without which no arm of geared motors moves as
/// the simulated one does. Without them most tests say nothing.
pub fn is_whole() -> bool {
    let is_whole = bus::terms(&EFFECTS) == [true; 2];
    if !is_whole {
        println!("the description has no rotors or no friction: this says nothing");
    }
    is_whole
}

/// Steps of the simulation in a tick.
const STEPS: u8 = 4;

/// The pin of the brake; high holds the joints.
#[derive(Clone, Copy)]
pub struct Pin(&'static Cell<bool>);

impl digital::ErrorType for Pin {
    type Error = Infallible;
}

impl OutputPin for Pin {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.0.set(false);
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        self.0.set(true);
        Ok(())
    }
}

/// The written project with its parts: change them before a run, or between two.
pub struct Bench<D: Detect<f32, N> = Found> {
    control: Control<Bus<'static>, Pin, D>,
    pub motion: &'static Motion,
    operator: Operator,
    log: Memory,
    /// The bus and its drives.
    pub wire: &'static RefCell<Wire>,
    brake: &'static Cell<bool>,
    /// Holds the arm although the pin is low.
    pub is_held: Cell<bool>,
    arm: Calibrated<Arm, f32, N, N, N>,
    /// What acts on the arm beside the motors: rotors and friction are those of the description.
    pub effects: Effects,
    pub state: State<f32, N, N>,
    /// Which way each joint turns while its motor does.
    pub directions: [f64; N],
    /// The drive of each joint, by its place on the bus.
    pub motors: [usize; N],
    /// The count of the timer that begins a tick.
    pub count: u32,
    pub is_late: Cell<bool>,
    pub status: Option<Status>,
    /// What the log has said, and when, s.
    pub said: Vec<(f32, String)>,
    /// The same, as lines.
    pub lines: Vec<Line>,
}

impl Bench {
    /// The project as it is written: its arm at home, its drives without torque.
    pub fn new() -> Self {
        Self::with(board::gains(), board::detectors)
    }
}

impl<D: Detect<f32, N>> Bench<D> {
    /// With other gains and detectors, such as `()`.
    pub fn with(gains: Gains, detectors: impl FnOnce(&Motion) -> D) -> Self {
        let motion = Box::leak(Box::new(Motion::REST));
        board::plan(motion).unwrap_or_else(|error| panic!("{error}"));
        let detectors = detectors(motion);
        let way = |direction| if direction == Direction::Forward { 1.0 } else { -1.0 };
        let drives = (0..N).map(|joint| Drive {
            is_enabled: false,
            zero: -way(DRIVES[joint]) * f64::from(ZERO[joint]),
            timeout: 0.02,
            ..Drive::new(board::number(joint), SCALES[joint])
        });
        let wire: &RefCell<Wire> = Box::leak(Box::new(RefCell::new(Wire::new(drives.collect()))));
        let brake: &Cell<bool> = Box::leak(Box::new(Cell::new(true)));
        let joints = Box::leak(Box::new(None));
        let devices = Devices { bus: Bus(wire), joints, brake: Pin(brake) };
        let control = board::on_brake(devices, gains, detectors, motion);
        let mut bench = Self {
            control: control.unwrap_or_else(|error| panic!("{error}")),
            motion,
            operator: Operator::new(motion),
            log: Memory::new(),
            wire,
            brake,
            is_held: Cell::new(false),
            arm: Calibrated::nominal(),
            effects: EFFECTS,
            state: State::at(home()),
            directions: DRIVES.map(way),
            motors: core::array::from_fn(|joint| joint),
            count: 0,
            is_late: Cell::new(false),
            status: None,
            said: Vec::new(),
            lines: Vec::new(),
        };
        bench.show();
        bench
    }

    /// The drives see their joints.
    fn show(&mut self) {
        let mut wire = self.wire.borrow_mut();
        for joint in 0..N {
            let drive = &mut wire.drives[self.motors[joint]];
            drive.angle = self.directions[joint] * f64::from(self.state.q[joint]);
            drive.speed = self.directions[joint] * f64::from(self.state.qd[joint]);
        }
    }

    /// A tick of the firmware, as in `firmware.rs`, and of the arm.
    pub fn tick<L: Law<N, (), Gains>>(
        &mut self,
        reference: &impl Reference<f32, N>,
        is_pressed: bool,
    ) -> Mode {
        self.count += 1;
        let (begun, late) = (self.count, u32::from(self.is_late.get()));
        self.count += late;
        let asked = Cell::new(false);
        let count = || begun + if asked.replace(true) { late } else { 0 };
        let (telemetry, _) = self.control.tick_at::<L, _, ()>(reference, &(), count);
        let seconds = self.count as f32 * TICK;
        let (said, lines) = (RefCell::new(&mut self.said), RefCell::new(&mut self.lines));
        let print = |what: Said<'_>| {
            let text = match what {
                Said::Line(line) => {
                    lines.borrow_mut().push(line);
                    line.to_string()
                }
                Said::Mode(mode, fault) => format!("{mode:?} {fault:?}"),
                Said::Positions(q) => format!("{q:?}"),
            };
            said.borrow_mut().push((seconds, text));
        };
        let status = telemetry.status;
        self.log.tick(&telemetry, print);
        if status.mode != Mode::Full || status.fault.is_some() {
            let is_pressed = status.mode == Mode::Stopped && is_pressed;
            let (operator, control, log) = (&mut self.operator, &mut self.control, &mut self.log);
            let say = |line| log.say(line, print);
            let refused = operator.tick((begun, &status), control, self.motion, is_pressed, say);
            if let Some(reason) = refused {
                self.log.say(of_refusal(reason), print);
            }
        }
        self.status = Some(status);
        self.advance();
        status.mode
    }

    /// The arm and the drives for a tick.
    fn advance(&mut self) {
        for _ in 0..STEPS {
            let wire = self.wire.borrow();
            let tau = core::array::from_fn(|joint| {
                (self.directions[joint] * wire.drives[self.motors[joint]].torque()) as f32
            });
            drop(wire);
            if self.brake.get() || self.is_held.get() {
                self.state = State::at(self.state.q);
            } else {
                let mechanics = ModelDynamics { robot: &self.arm, tau, effects: &self.effects };
                let h = TICK / f32::from(STEPS);
                LinearlyImplicit.advance(&mechanics, &mut self.state, h).expect("inertia");
            }
            self.show();
        }
        self.wire.borrow_mut().advance(f64::from(TICK));
    }

    /// Ticks for so many seconds under the project's law.
    pub fn run(&mut self, seconds: f32, is_pressed: bool) {
        let motion = self.motion;
        for _ in 0..(seconds / TICK) as u32 {
            self.tick::<board::Law>(motion, is_pressed);
        }
    }

    /// Presses the button until the robot follows its motion, for at most a second.
    pub fn start(&mut self) -> bool {
        let motion = self.motion;
        let ticks = 0..(1.0 / TICK) as u32;
        let mut is_full = |_| self.tick::<board::Law>(motion, true) == Mode::Full;
        ticks.into_iter().any(&mut is_full)
    }
}
