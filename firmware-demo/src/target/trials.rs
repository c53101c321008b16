//! Scenes that are trials, over and over, each tick sent from the loop that runs them: they have no
//! interrupt and no timer.

use cortex_m_semihosting::debug;
use dynamics_core::model::{JointLimits, Robot};
use dynamics_core::robots::OpenArm;
use machine_link::{Axis, Message, Sample};
use stm32f4xx_hal::pac;
use stm32f4xx_hal::serial::Tx;

use super::watch::{MACHINE, argument, port, send};
use super::{fail, leave};
use crate::scene::PlantModel;
use crate::scenes::openarm_free_drive::trial::Seen;
use crate::scenes::{openarm_free_drive, wheel_leg_balance};
use crate::watched::{fill, machine_of};

/// The port, and what was sent over it.
struct Sender<const N: usize> {
    port: Tx<pac::USART1>,
    constants: Message<N>,
    sample: Sample<N>,
    /// The tick after which the program ends; 0 for none.
    last: u32,
}

impl<const N: usize> Sender<N> {
    fn new(name: &str, tick: f32, limits: [JointLimits<f32>; N]) -> Self {
        let Some(Ok(port)) = pac::Peripherals::take().map(port) else {
            fail("the serial port is taken, or cannot have this rate");
        };
        let axes = limits.into_iter().map(|limits| Axis { limits, prismatic: false });
        let constants = Message::Machine(machine_of(name, tick, 0, axes));
        let last = argument(b"ticks").unwrap_or(0);
        Self { port, constants, sample: Sample::default(), last }
    }

    /// Sends the sample.
    fn send(&mut self) {
        if self.sample.number.is_multiple_of(MACHINE) {
            send(&self.constants, &mut self.port);
        }
        send(&Message::Tick(self.sample.message(0)), &mut self.port);
        self.sample.number = self.sample.number.wrapping_add(1);
        if self.sample.number == self.last {
            defmt::println!("sent {=u32} of {=u32} ticks", self.last, self.last);
            defmt::println!("done");
            leave(debug::EXIT_SUCCESS);
        }
    }
}

/// The arm that a hand leads.
pub fn openarm_free_drive() -> ! {
    use openarm_free_drive::TICK;
    use openarm_free_drive::trial::{Holds, Less, Trial};

    let limits = OpenArm::MODEL.to_f32().links.map(|link| link.limits);
    let mut sender = Sender::new("openarm_free_drive", TICK, limits);
    let mut tick = |telemetry: &_| {
        fill(&mut sender.sample, telemetry);
        sender.send();
    };
    loop {
        let trial = Trial::of_scene(Less::Nothing, PlantModel::Exact, Holds::PickedUp);
        if trial.run(Seen::by(&mut tick)).is_none() {
            fail("the simulated arm has no forward dynamics any more");
        }
    }
}

/// The robot that balances on its wheels; its motors have no reference.
pub fn wheel_leg_balance() -> ! {
    use wheel_leg_balance::trial::Trial;
    use wheel_leg_balance::{LIMITS, Less, TICK};

    let mut sender = Sender::new("wheel_leg_balance", TICK, LIMITS);
    loop {
        let trial = Trial::of_scene(Less::Nothing, PlantModel::Exact);
        let seen = trial.run_watched(|tick, q, command, _| {
            let sample = &mut sender.sample;
            (sample.tick, sample.status) = (tick, command.status);
            (sample.reference, sample.estimate, sample.torque) = (*q, *q, command.torque);
            sender.send();
        });
        if seen.is_none() {
            fail("the simulated robot has no forward dynamics any more");
        }
    }
}
