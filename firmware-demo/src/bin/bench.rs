//! Cycles of the dynamics and of a whole tick on a real STM32F405, read from DWT.CYCCNT between the markers that the
//! emulated meter uses; needs a debug probe that serves semihosting.
//!
//! 168 MHz from the 8 MHz crystal of the usual boards, five wait states, flash accelerator on.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m::Peripherals;
use cortex_m::peripheral::DWT;
use cortex_m_rt::entry;
use cortex_m_semihosting::debug;
use dynamics_core::effects::{Effect, Gravity, RIGID_BODY};
use dynamics_core::model::Robot;
use dynamics_core::robots::{A1, Iiwa14, Panda, Ur5e};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use firmware_demo::{marker::measured, target};

/// Repetitions: the least is free of interrupts and of a cold flash accelerator.
const RUNS: usize = 32;

#[entry]
fn main() -> ! {
    let Some(mut core) = Peripherals::take() else {
        target::fail("the peripherals are taken");
    };
    clock::run_at_168_mhz();
    core.DCB.enable_trace();
    core.DWT.enable_cycle_counter();
    robot::<Ur5e, 6, 6>();
    robot::<Panda, 7, 7>();
    robot::<Iiwa14, 7, 7>();
    robot::<A1, 16, 12>();
    tick::run();
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
    defmt::println!(
        "cycles {=str} rnea core {=str} {=u32}",
        name,
        inputs,
        loop_form
    );
    defmt::println!(
        "cycles {=str} rnea engine {=str} {=u32}",
        name,
        inputs,
        engine
    );
}

/// The least cycles of some runs, between the markers.
fn least<T>(mut work: impl FnMut() -> T) -> u32 {
    (0..RUNS).fold(u32::MAX, |least, _| {
        let start = DWT::cycle_count();
        black_box(measured::<0, _>(&mut work));
        least.min(DWT::cycle_count().wrapping_sub(start))
    })
}

/// The whole control loop of a UR5e on simulated wires, whose encoders stand still: the same
/// instructions as on an arm that moves.
mod tick {
    use cortex_m::peripheral::DWT;
    use dynamics_core::Engine;
    use dynamics_core::control::{
        Gains, Mode, MotionController, MotionControllerConfig, MotionLimits, SafetyLimits,
        SupervisorConfig, Trajectory, WayPoint,
    };
    use dynamics_core::effects::RIGID_BODY;
    use dynamics_core::robots::Ur5e;
    use dynamics_core::state::State;
    use firmware_demo::control_loop::{ControlLoop, Law};
    use firmware_demo::drive::Drive;
    use firmware_demo::encoder::Encoder;
    use firmware_demo::scene::{SimBrake, TICK};
    use firmware_demo::target;
    use firmware_demo::wires::{SimDrive, SimEncoder, Wires};

    const TICKS: usize = 1000;
    const TORQUE: [f32; 6] = [150.0, 150.0, 150.0, 28.0, 28.0, 28.0];

    struct RigidBody;

    impl Law<6> for RigidBody {
        fn feedforward(reference: &State<f32, 6, 6>, (): &()) -> [f32; 6] {
            Engine::<Ur5e>::rnea(reference, &RIGID_BODY)
        }
    }

    pub fn run() {
        static WIRES: Wires<6> = Wires::new();
        let Ok(trajectory) = trajectory() else {
            target::fail("the way-points need more than the arm's limits");
        };
        let mut control = control(&WIRES);
        let mut cycles = [0_u32; TICKS];
        for cycles in &mut cycles {
            let start = DWT::cycle_count();
            let telemetry = control.tick::<RigidBody, _, ()>(&trajectory, &());
            *cycles = DWT::cycle_count().wrapping_sub(start);
            if !matches!(telemetry.status.mode, Mode::Full) {
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

    fn trajectory() -> Result<Trajectory<f32, 6, 9>, impl Sized> {
        let points = core::array::from_fn(|i| WayPoint {
            q: [if i % 2 == 0 { 0.0 } else { 0.05 }; 6],
            qd: [0.0; 6],
            ticks: if i == 0 { 0 } else { 120 },
        });
        let limit = MotionLimits {
            velocity: 3.0,
            acceleration: 30.0,
        };
        Trajectory::new(&points, TICK, &[limit; 6])
    }

    fn control(wires: &'static Wires<6>) -> ControlLoop<SimEncoder, SimDrive, SimBrake, 6> {
        let limits = SafetyLimits {
            torque: TORQUE,
            rate: TORQUE,
            speed: [3.1; 6],
            lower: [-6.3; 6],
            upper: [6.3; 6],
        };
        ControlLoop::new(
            core::array::from_fn(|j| Encoder::new(wires.encoder(j))),
            core::array::from_fn(|j| Drive::new(wires.drive(j), TORQUE[j])),
            SimBrake,
            Gains::from_inertia(&[3.0, 3.0, 1.0, 0.3, 0.3, 0.3], 25.0, 1.0),
            MotionController::new(MotionControllerConfig {
                supervisor: SupervisorConfig {
                    limits,
                    tick: TICK,
                    resolution: 0.0,
                    ride_through_ticks: 5,
                    hold_ticks: 100,
                    reentry_ticks: 200,
                },
                observer_bandwidth: 250.0,
                decay_rate: 25.0,
                restart_distance: 0.15,
            }),
        )
    }
}

/// The STM32F405's clock tree (reference manual RM0090, sections 3.5 and 7.3).
mod clock {
    const RCC: usize = 0x4002_3800;
    const FLASH_ACR: usize = 0x4002_3c00;
    const CR: usize = RCC;
    const PLLCFGR: usize = RCC + 0x04;
    const CFGR: usize = RCC + 0x08;

    const HSE_ON: u32 = 1 << 16;
    const HSE_READY: u32 = 1 << 17;
    const PLL_ON: u32 = 1 << 24;
    const PLL_READY: u32 = 1 << 25;
    /// 8 MHz / 8 · 336 / 2 = 168 MHz, HSE as source, 48 MHz for USB.
    const PLL: u32 = 8 | 336 << 6 | 1 << 22 | 7 << 24;
    /// APB1 / 4, APB2 / 2.
    const BUSES: u32 = 0b101 << 10 | 0b100 << 13;
    const FROM_PLL: u32 = 0b10;
    /// Five wait states, prefetch, instruction and data cache.
    const FLASH: u32 = 5 | 1 << 8 | 1 << 9 | 1 << 10;

    /// Waits for the crystal at most this many polls; without one the part stays at 16 MHz, and
    /// cycle counts are the same but for fewer wait states than they need.
    const PATIENCE: u32 = 1_000_000;

    pub fn run_at_168_mhz() {
        change(CR, |cr| cr | HSE_ON);
        if !wait(CR, HSE_READY) {
            defmt::println!("no crystal: cycles are counted at 16 MHz");
            return;
        }
        change(FLASH_ACR, |_| FLASH);
        change(CFGR, |cfgr| cfgr | BUSES);
        change(PLLCFGR, |_| PLL);
        change(CR, |cr| cr | PLL_ON);
        if wait(CR, PLL_READY) {
            change(CFGR, |cfgr| cfgr | FROM_PLL);
        }
    }

    fn wait(register: usize, flag: u32) -> bool {
        (0..PATIENCE).any(|_| read(register) & flag != 0)
    }

    fn read(register: usize) -> u32 {
        // SAFETY: the addresses above are aligned registers of this part, always readable.
        unsafe { (register as *const u32).read_volatile() }
    }

    fn change(register: usize, f: impl FnOnce(u32) -> u32) {
        let value = f(read(register));
        // SAFETY: the same registers, written in the order that the manual asks, before anything
        // else runs.
        unsafe { (register as *mut u32).write_volatile(value) }
    }
}
