//! The shipped control loop of scene `ur5e` on the scene's plant, between wires that can be bent.

pub mod outcome;

use std::cell::Cell;
use std::rc::Rc;

use dynamics_core::Engine;
use dynamics_core::algorithms::rnea;
use dynamics_core::control::{
    Bounds, Gains, Observer, Rejoin, Speed, Supervisor, Trajectory, WayPoint,
};
use dynamics_core::effects::{Coriolis, Coulomb, Gravity, Inertia, RotorInertia, Viscous};
use dynamics_core::model::{Calibrated, Limits, model};
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use embedded_hal::digital::{self, OutputPin};
use embedded_hal::pwm::{self, SetDutyCycle};
use embedded_hal::spi::{self, Operation, SpiDevice};
use firmware_demo::control_loop::{ControlLoop, Law, Telemetry};
use firmware_demo::drive::Drive;
use firmware_demo::encoder::{Encoder, RESOLUTION};
use firmware_demo::plant::{MAX_DUTY, Plant, SimDrive, SimEncoder, Wires};

pub const TICK: f32 = 1e-3;
pub const RIDE: u32 = 5;
pub const HOLD: u32 = 100;
pub const REENTRY: u32 = 200;
const OMEGA_N: f32 = core::f32::consts::TAU * 4.0;
const H: f32 = core::f32::consts::FRAC_PI_2;
const HOME: [f32; 6] = [0.0, -H, H, -H, -H, 0.0];

type Effects = (
    Gravity,
    Inertia,
    Coriolis,
    Viscous<f32, 6>,
    Coulomb<f32, 6>,
    RotorInertia<f32, 6>,
);

const EFFECTS: Effects = (
    Gravity::EARTH,
    Inertia,
    Coriolis,
    Viscous([12.0, 12.0, 8.0, 2.0, 2.0, 1.5]),
    Coulomb {
        torque: [8.0, 8.0, 6.0, 1.5, 1.5, 1.2],
        per_width: 20.0,
    },
    RotorInertia([0.9, 0.9, 0.9, 0.25, 0.25, 0.25]),
);

/// The full model, which a test may make fail: on this thread, no number for a joint.
pub struct FullModel;

thread_local! {
    /// The joint whose feed-forward is no number, and what it is.
    pub static POISON: Cell<Option<(usize, f32)>> = const { Cell::new(None) };
}

impl Law<6> for FullModel {
    fn feedforward(reference: &State<f32, 6, 6>) -> [f32; 6] {
        let mut tau = Engine::<Ur5e>::rnea(reference, &EFFECTS);
        if let Some((joint, poison)) = POISON.get() {
            tau[joint] = poison;
        }
        tau
    }
}

/// What is wrong with a joint's wires.
#[derive(Clone, Default)]
pub struct Bent {
    /// Bits of the answers that are turned over.
    pub mask: Cell<u16>,
    /// The bus fails.
    pub bus: Cell<bool>,
    /// The drive refuses.
    pub drive: Cell<bool>,
}

#[derive(Debug)]
pub struct Broken;

impl spi::Error for Broken {
    fn kind(&self) -> spi::ErrorKind {
        spi::ErrorKind::Other
    }
}
impl pwm::Error for Broken {
    fn kind(&self) -> pwm::ErrorKind {
        pwm::ErrorKind::Other
    }
}
impl digital::Error for Broken {
    fn kind(&self) -> digital::ErrorKind {
        digital::ErrorKind::Other
    }
}

pub struct Spi(SimEncoder, Rc<Bent>);

impl spi::ErrorType for Spi {
    type Error = Broken;
}

impl SpiDevice for Spi {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), Broken> {
        if self.1.bus.get() {
            return Err(Broken);
        }
        let _ = self.0.transaction(operations);
        for operation in operations {
            if let Operation::TransferInPlace(words) = operation {
                let mask = self.1.mask.get().to_be_bytes();
                words
                    .iter_mut()
                    .zip(mask)
                    .for_each(|(word, mask)| *word ^= mask);
            }
        }
        Ok(())
    }
}

pub struct Pwm(SimDrive, Rc<Bent>);

impl pwm::ErrorType for Pwm {
    type Error = Broken;
}

impl SetDutyCycle for Pwm {
    fn max_duty_cycle(&self) -> u16 {
        MAX_DUTY
    }
    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Broken> {
        if self.1.drive.get() {
            return Err(Broken);
        }
        let _ = self.0.set_duty_cycle(duty);
        Ok(())
    }
}

/// A brake: whether it holds, and whether it fails.
#[derive(Clone, Default)]
pub struct Brake(pub Rc<(Cell<bool>, Cell<bool>)>);

impl digital::ErrorType for Brake {
    type Error = Broken;
}

impl OutputPin for Brake {
    fn set_low(&mut self) -> Result<(), Broken> {
        self.0.0.set(false);
        if self.0.1.get() { Err(Broken) } else { Ok(()) }
    }
    fn set_high(&mut self) -> Result<(), Broken> {
        self.0.0.set(true);
        if self.0.1.get() { Err(Broken) } else { Ok(()) }
    }
}

/// The arm, its firmware, and the wires in between.
pub struct Arm {
    pub wires: &'static Wires<6>,
    pub bent: [Rc<Bent>; 6],
    pub brake: Brake,
    pub plant: Plant<Ur5e, Effects, 6, 6>,
    pub trajectory: Trajectory<f32, 6, 9>,
    pub control: ControlLoop<Spi, Pwm, Brake, 6>,
    pub limits: [Limits<f32>; 6],
}

impl Arm {
    pub fn new() -> Self {
        let wires: &'static Wires<6> = Box::leak(Box::new(Wires::new()));
        let exact = model::<f32, Ur5e, 6, 6, 6>();
        let limits: [_; 6] = core::array::from_fn(|j| exact.links[j].limits);
        let torque = limits.map(|l| l.torque);
        let speeds = limits.map(|l| Speed {
            velocity: l.velocity,
            acceleration: 12.0,
        });
        let plant = Plant::new(Calibrated::nominal(), EFFECTS, torque, HOME);
        plant.publish(wires);
        let bent: [Rc<Bent>; 6] = Default::default();
        let brake = Brake::default();
        Self {
            control: ControlLoop::new(
                core::array::from_fn(|j| Encoder::new(Spi(wires.encoder(j), bent[j].clone()))),
                core::array::from_fn(|j| {
                    Drive::new(Pwm(wires.drive(j), bent[j].clone()), torque[j])
                }),
                brake.clone(),
                Gains::from_inertia(&diagonal(), OMEGA_N, 1.0),
                Observer::new(core::f32::consts::TAU * 40.0, TICK),
                supervisor(&limits),
                Rejoin::new(TICK, 1.0 * OMEGA_N, REENTRY),
            ),
            trajectory: Trajectory::new(&way_points(), TICK, &speeds).unwrap(),
            wires,
            bent,
            brake,
            plant,
            limits,
        }
    }

    /// A tick of the firmware, then of the plant, which a brake holds at once.
    pub fn tick(&mut self) -> Telemetry<6> {
        let telemetry = self.control.tick::<FullModel, 9>(&self.trajectory);
        if self.brake.0.0.get() {
            self.plant.state.qd = [0.0; 6];
            self.plant.publish(self.wires);
        } else {
            self.plant.advance(self.wires, 4, TICK / 4.0).unwrap();
        }
        telemetry
    }

    /// Ticks without anything wrong.
    pub fn run(&mut self, ticks: u32) -> Telemetry<6> {
        (1..ticks).for_each(|_| {
            self.tick();
        });
        self.tick()
    }

    pub fn corrupt(&self, joint: usize, mask: u16) {
        self.bent[joint].mask.set(mask);
    }

    /// Largest error of a joint, by what was true when the telemetry was made.
    pub fn error(reference: &[f32; 6], actual: &[f32; 6]) -> f32 {
        let apart = |(r, q): (&f32, &f32)| (r - q).abs();
        reference.iter().zip(actual).map(apart).fold(0.0, f32::max)
    }
}

fn supervisor(limits: &[Limits<f32>; 6]) -> Supervisor<f32, 6> {
    let bounds = Bounds {
        torque: limits.map(|l| l.torque),
        rate: limits.map(|l| l.torque * 0.5),
        speed: limits.map(|l| l.velocity),
        lower: limits.map(|l| l.lower),
        upper: limits.map(|l| l.upper),
    };
    Supervisor::new(bounds, TICK, HOLD, REENTRY)
        .riding(RIDE)
        .with_resolution(RESOLUTION)
}

fn diagonal() -> [f32; 6] {
    let exact = model::<f32, Ur5e, 6, 6, 6>();
    let rest = rnea(exact, &State::at(HOME), &EFFECTS);
    core::array::from_fn(|j| {
        let mut state = State::at(HOME);
        state.qdd[j] = 1.0;
        rnea(exact, &state, &EFFECTS)[j] - rest[j]
    })
}

fn way_points() -> [WayPoint<f32, 6>; 9] {
    let pass = |q, qd, ticks| WayPoint { q, qd, ticks };
    let stop = |q, ticks| pass(q, [0.0; 6], ticks);
    let above = |pan, q: [f32; 3]| [pan, q[0], q[1], q[2], -H, pan];
    [
        stop(HOME, 0),
        pass(
            above(-0.7, [-1.35, 1.75, -1.97]),
            [0.0, 0.35, 0.25, -0.6, 0.0, 0.0],
            1000,
        ),
        stop(above(-0.7, [-1.05, 1.85, -2.37]), 600),
        stop(above(-0.7, [-1.35, 1.75, -1.97]), 600),
        pass(
            above(0.3, [-1.45, 1.55, -1.67]),
            [1.9, 0.0, 0.0, 0.0, 0.0, 1.9],
            1000,
        ),
        stop(above(1.1, [-1.30, 1.70, -1.97]), 900),
        stop(above(1.1, [-0.95, 1.80, -2.42]), 600),
        stop(above(1.1, [-1.30, 1.70, -1.97]), 600),
        stop(HOME, 1400),
    ]
}
