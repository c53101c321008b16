//! The scene of an arm that is guided by hand: its trials one after the other, without an
//! interrupt.

use cortex_m_semihosting::debug;
use motion_control::Status;

use super::{Words, fail, leave, stack_peak};
use crate::scene::PlantModel::{self, Exact, Mismatched};
use crate::scenes::openarm_free_drive::TICK;
use crate::scenes::openarm_free_drive::trial::Holds::{self, Nothing, PickedUp};
use crate::scenes::openarm_free_drive::trial::{BOUND, Less, Seen, Trial, tick_at};

/// The runs of the whole law and of gravity compensation alone, and that without a tool.
const RUNS: [(PlantModel, &str, Less, Holds); 5] = [
    (Exact, "feedforward", Less::Nothing, PickedUp),
    (Exact, "pd", Less::AllButGravity, PickedUp),
    (Mismatched, "feedforward", Less::Nothing, PickedUp),
    (Mismatched, "pd", Less::AllButGravity, PickedUp),
    (Exact, "empty-hand", Less::Nothing, Nothing),
];

/// Runs the trials to their end and leaves the emulator.
pub fn scene() -> ! {
    let ticks = Trial::of_scene(Less::Nothing, Exact, PickedUp).ticks();
    let microseconds = const { (TICK * 1e6 + 0.5) as u32 };
    defmt::println!(
        "scene {=str} joints {=usize} tick-us {=u32} ticks {=u32} bound {=f32}",
        "openarm_free_drive",
        1,
        microseconds,
        ticks,
        BOUND
    );
    for (_, name, bytes) in Less::PARTS {
        defmt::println!("effect {=str} {=usize}", name, bytes);
    }
    for (plant, law, less, holds) in RUNS {
        run(plant, "", law, &Trial::of_scene(less, plant, holds));
    }
    for (less, name, _) in Less::PARTS {
        run(Exact, "without-", name, &Trial::of_scene(less, Exact, PickedUp));
    }
    defmt::println!("stack {=usize}", stack_peak());
    defmt::println!("done");
    leave(debug::EXIT_SUCCESS)
}

/// Runs a trial and logs its figures: the tip is the one joint.
fn run(plant: PlantModel, less: &str, law: &str, trial: &Trial) {
    defmt::println!("run {=str} {=str}{=str} {=u32:#x}", plant.name(), less, law, tick_at() as u32);
    let Some(out) = trial.run(Seen::default()) else {
        fail("the simulated arm failed: it has no forward dynamics, or there is no such law");
    };
    defmt::println!("rms{}", Words(&[out.rms]));
    defmt::println!("max{}", Words(&[out.drift]));
    defmt::println!("total {=f32}", out.rms);
    defmt::println!("start {=f32}", out.start.max(out.again));
    if let Some(Status { mode, fault, limited }) = out.status {
        let (mode, fault) = (defmt::Debug2Format(&mode), defmt::Debug2Format(&fault));
        defmt::println!("status mode {}, fault {}, limited {=bool}", mode, fault, limited);
    }
}
