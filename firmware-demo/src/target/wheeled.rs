//! The scene of the robot on wheels: its trials one after the other, without an interrupt.

use cortex_m_semihosting::debug;
use dynamics_core::effects::Gravity;
use motion_control::Status;

use super::{Words, fail, leave, stack_peak};
use crate::scene::PlantModel::{self, Exact, Mismatched};
use crate::scenes::wheel_leg_balance::trial::{BOUND, Trial, tick_at};
use crate::scenes::wheel_leg_balance::{Less, TICK};

/// The runs of the whole law, of the gains of one length, and of the law less a part.
const RUNS: [(PlantModel, &str, Less); 6] = [
    (Exact, "feedforward", Less::Nothing),
    (Exact, "pd", Less::Schedule),
    (Mismatched, "feedforward", Less::Nothing),
    (Mismatched, "pd", Less::Schedule),
    (Exact, "without-Gravity", Less::Gravity),
    (Exact, "without-traction", Less::Traction),
];

/// Runs the trials to their end and leaves the emulator.
pub fn scene() -> ! {
    let ticks = Trial::of_scene(Less::Nothing, Exact).ticks;
    let microseconds = const { (TICK * 1e6 + 0.5) as u32 };
    defmt::println!(
        "scene {=str} joints {=usize} tick-us {=u32} ticks {=u32} bound {=f32}",
        "wheel_leg_balance",
        1,
        microseconds,
        ticks,
        BOUND
    );
    defmt::println!("effect Gravity {=usize}", size_of::<Gravity>());
    defmt::println!("effect traction {=usize}", size_of::<f32>());
    for (plant, law, less) in RUNS {
        run(plant, law, &Trial::of_scene(less, plant));
    }
    defmt::println!("stack {=usize}", stack_peak());
    defmt::println!("done");
    leave(debug::EXIT_SUCCESS)
}

/// Runs a trial and logs its figures: the pitch is the one joint.
fn run(plant: PlantModel, law: &str, trial: &Trial) {
    defmt::println!("run {=str} {=str} {=u32:#x}", plant.name(), law, tick_at() as u32);
    let sample = |tick: u32, _: &_, _: &_, pitch: f32| {
        if tick.is_multiple_of(super::SAMPLE) {
            defmt::println!("sample {=u32}{}{}", tick, Words(&[0.0]), Words(&[pitch]));
        }
    };
    let Some(out) = trial.run_watched(sample) else {
        fail("the simulated robot failed: it has no forward dynamics, or there is no such law");
    };
    defmt::println!("rms{}", Words(&[out.rms]));
    defmt::println!("max{}", Words(&[out.pitch]));
    defmt::println!("total {=f32}", out.rms);
    if let Some(Status { mode, fault, limited }) = out.status {
        let (mode, fault) = (defmt::Debug2Format(&mode), defmt::Debug2Format(&fault));
        defmt::println!("status mode {}, fault {}, limited {=bool}", mode, fault, limited);
    }
}
