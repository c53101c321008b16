//! Cycles of the dynamics and of a whole tick on a real STM32F405, read from DWT.CYCCNT between the
//! markers that the emulated meter uses; needs a debug probe that serves semihosting.
//!
//! 168 MHz from the 8 MHz crystal of the usual boards, five wait states, flash accelerator on; a
//! board without a crystal stops before the first figure. It is built for a board alone:
//!
//! ```text
//! cargo build --release -p lab-firmware --features board --bin bench --target thumbv7em-none-eabihf
//! ```
#![no_std]
#![no_main]

use core::array::from_fn;
use core::hint::black_box;

use cortex_m::peripheral::DWT;
use cortex_m_rt::entry;
use cortex_m_semihosting::debug;
use dynamics_core::effects::{Effect, Gravity, RIGID_BODY};
use dynamics_core::model::Robot;
use dynamics_core::robots::{A1, Iiwa14, Panda, Ur5e};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use firmware_demo::marker::measured;
use firmware_demo::plant::Rig;
use firmware_demo::scene::{Full, STEPS, Scene, TICK, simulated_loop};
use firmware_demo::scenes::ur5e::PickAndPlace;
use firmware_demo::sim_io::Wires;
use firmware_demo::target;
use motion_control::Mode;
use stm32f4xx_hal::prelude::*;
use stm32f4xx_hal::{pac, rcc};

/// Repetitions: the least is free of interrupts and of a cold flash accelerator.
const RUNS: usize = 32;
/// Ticks of the control loop.
const TICKS: usize = 1000;

#[entry]
fn main() -> ! {
    let (Some(mut core), Some(part)) = (cortex_m::Peripherals::take(), pac::Peripherals::take())
    else {
        target::fail("the peripherals are taken");
    };
    let clocks = rcc::Config::hse(8.MHz()).sysclk(168.MHz());
    part.RCC.freeze(clocks);
    core.DCB.enable_trace();
    core.DWT.enable_cycle_counter();
    robot::<Ur5e, 6, 6>();
    robot::<Panda, 7, 7>();
    robot::<Iiwa14, 7, 7>();
    robot::<A1, 16, 12>();
    tick();
    defmt::println!("done");
    target::leave(debug::EXIT_SUCCESS)
}

fn robot<T: Robot<B, N, N>, const B: usize, const N: usize>() {
    scene::<T, _, B, N>("full", &RIGID_BODY);
    scene::<T, _, B, N>("gravity", &(Gravity::EARTH,));
}

fn scene<T: Robot<B, N, N>, E: Effect<f32, B, N>, const B: usize, const N: usize>(
    inputs: &str,
    effects: &E,
) {
    let state = black_box(State {
        q: [0.3_f32; N],
        qd: [0.5; N],
        qdd: [1.0; N],
    });
    let empty = least(|| ());
    let loop_form = least(|| Core::<T>::rnea(black_box(&state), effects)) - empty;
    let engine = least(|| Engine::<T>::rnea(black_box(&state), effects)) - empty;
    let name = T::MODEL.name;
    for (form, cycles) in [("core", loop_form), ("engine", engine)] {
        defmt::println!(
            "cycles {=str} rnea {=str} {=str} {=u32}",
            name,
            form,
            inputs,
            cycles
        );
    }
}

/// The least cycles of some runs, between the markers.
fn least<T>(mut work: impl FnMut() -> T) -> u32 {
    (0..RUNS).fold(u32::MAX, |least, _| {
        let start = DWT::cycle_count();
        black_box(measured::<0, _>(&mut work));
        least.min(DWT::cycle_count().wrapping_sub(start))
    })
}

/// The whole control loop of the scene `ur5e`, on simulated wires.
fn tick() {
    static WIRES: Wires<6> = Wires::new();
    let Ok(reference) = PickAndPlace::reference() else {
        target::fail("the way needs more than the arm's limits");
    };
    let Ok(mut control) = simulated_loop::<PickAndPlace, _, 6, 6, 6, 6>(&reference, &WIRES, ())
    else {
        target::fail("a drive has no full scale");
    };
    let torque = PickAndPlace::limits().map(|limits| limits.torque);
    let mut rig = Rig::new(PickAndPlace::plant(None), torque, &WIRES);
    let mut cycles = [0_u32; TICKS];
    for cycles in &mut cycles {
        let start = DWT::cycle_count();
        let telemetry = control.tick::<Full<PickAndPlace, 6, 6, 6>, _, ()>(&reference, &());
        *cycles = DWT::cycle_count().wrapping_sub(start);
        let moved = rig.advance(&WIRES, STEPS, TICK / STEPS as f32, |_| ());
        if moved.is_err() || !matches!(telemetry.status.mode, Mode::Full) {
            target::fail("the loop did not run as it should: nothing was measured");
        }
    }
    cycles.sort_unstable();
    let [min, .., max] = cycles;
    let median = cycles[TICKS / 2];
    defmt::println!(
        "cycles ur5e tick min {=u32} median {=u32} max {=u32}",
        min,
        median,
        max
    );
}
