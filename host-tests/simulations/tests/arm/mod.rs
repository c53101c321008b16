//! The shipped control loop of scene `ur5e` on the scene's plant, between wires that can be bent.

pub mod outcome;

use std::cell::Cell;
use std::rc::Rc;

use dynamics_core::model::JointLimits;
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use embedded_hal::digital::{self, OutputPin};
use embedded_hal::pwm::{self, SetDutyCycle};
use embedded_hal::spi::{self, Operation, SpiDevice};
use firmware_demo::plant::{Plant, Rig};
use firmware_demo::scene::{Devices, Full, STEPS, Scene, SceneLoop, Start, TICK};
pub use firmware_demo::scene::{HOLD, REENTRY, RIDE};
use firmware_demo::scenes::ur5e::{Effects, PickAndPlace};
use firmware_demo::sim_io::{MAX_DUTY, SimDrive, SimEncoder, Wires};
use host_tests::measured::largest;
use joint_drivers::{Law, Telemetry};
use motion_control::reference::Trajectory;

/// The full model, which a test may make fail: on this thread, no number for a joint.
pub struct FullModel;

thread_local! {
    /// The joint whose feed-forward is no number, and what it is.
    pub static POISON: Cell<Option<(usize, f32)>> = const { Cell::new(None) };
}

impl Law<6> for FullModel {
    fn feedforward(reference: &State<f32, 6, 6>, (): &()) -> [f32; 6] {
        let mut tau = Full::<PickAndPlace, 6, 6, 6>::feedforward(reference, &());
        if let Some((joint, poison)) = POISON.get() {
            tau[joint] = poison;
        }
        tau
    }
}

/// The faults of a joint's wires.
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
                words.iter_mut().zip(mask).for_each(|(word, mask)| *word ^= mask);
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
    pub rig: Rig<Plant<Ur5e, Effects, (), 6, 6, 6>, 6>,
    pub trajectory: Trajectory<f32, 6, 9>,
    pub control: SceneLoop<Spi, Pwm, Brake, 6>,
    pub limits: [JointLimits<f32>; 6],
}

impl Arm {
    pub fn new() -> Self {
        let wires: &'static Wires<6> = Box::leak(Box::new(Wires::new()));
        let limits = PickAndPlace::LIMITS;
        let torque = limits.map(|l| l.torque);
        let rig = Rig::new(PickAndPlace::plant(None), torque, wires);
        let bent: [Rc<Bent>; 6] = Default::default();
        let brake = Brake::default();
        let encoders = core::array::from_fn(|j| Spi(wires.encoder(j), bent[j].clone()));
        let drives = core::array::from_fn(|j| Pwm(wires.drive(j), bent[j].clone()));
        Self {
            control: PickAndPlace::control_loop(
                Devices { encoders, drives, brake: brake.clone() },
                PickAndPlace::gains(&()),
                (),
                Start::OnTrajectory,
            )
            .unwrap(),
            trajectory: PickAndPlace::reference().unwrap(),
            wires,
            bent,
            brake,
            rig,
            limits,
        }
    }

    /// A tick of the firmware, then of the plant, which a brake holds at once.
    pub fn tick(&mut self) -> Telemetry<6> {
        self.tick_under::<FullModel>()
    }

    pub fn tick_under<L: Law<6>>(&mut self) -> Telemetry<6> {
        let telemetry = self.control.tick::<L, _, ()>(&self.trajectory, &());
        self.advance();
        telemetry
    }

    pub fn advance(&mut self) {
        if self.brake.0.0.get() {
            self.rig.plant.state.qd = [0.0; 6];
            self.wires.publish(&self.rig.plant.state.q);
        } else {
            let step = TICK / STEPS as f32;
            self.rig.advance(self.wires, STEPS, step, |_| ()).unwrap();
        }
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

    /// Largest error of a joint, by what was true when the telemetry was made; NaN if one is.
    pub fn error(reference: &[f32; 6], actual: &[f32; 6]) -> f64 {
        let apart = |(r, q): (&f32, &f32)| (r - q).abs();
        largest(reference.iter().zip(actual).map(apart))
    }
}
