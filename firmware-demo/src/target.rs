//! The emulated board: SysTick, log, panic and fault handlers, stack painting.

use core::cell::RefCell;

use cortex_m::interrupt::Mutex;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::{ExceptionFrame, exception};
use cortex_m_semihosting::debug;
use defmt_semihosting as _;
use dynamics_core::control::Status;
use heapless::spsc::Consumer;

use crate::scene::{App, Errors, OMEGA_N, RUNS, Record, Scene, TICK, ZETA};

/// The core's clock, Hz.
const CLOCK: u32 = 168_000_000;
/// Every so many ticks a sample goes to the log.
const SAMPLE: u32 = 20;

/// What the interrupt runs.
type Ticked = &'static mut (dyn Tick + Send);

/// Something that the interrupt runs once a tick.
pub trait Tick {
    /// One tick.
    fn tick(&mut self);
}

impl<S: Scene<B, N, W> + Send, const B: usize, const N: usize, const W: usize> Tick
    for App<S, B, N, W>
{
    fn tick(&mut self) {
        App::tick(self);
    }
}

static TICKED: Mutex<RefCell<Option<Ticked>>> = Mutex::new(RefCell::new(None));

#[exception]
fn SysTick() {
    cortex_m::interrupt::free(|cs| {
        if let Some(app) = TICKED.borrow(cs).borrow_mut().as_mut() {
            app.tick();
        }
    });
}

/// Starts the interrupt, logs what it reports until the last run has ended, and leaves the emulator.
pub fn run<S, const B: usize, const N: usize, const W: usize>(
    app: &'static mut App<S, B, N, W>,
    mut records: Consumer<'static, Record<N>>,
) -> !
where
    S: Scene<B, N, W> + Send,
{
    let Some(mut peripherals) = cortex_m::Peripherals::take() else {
        fail("the peripherals are taken");
    };
    let ticks = app.ticks();
    let us = (TICK * 1e6 + 0.5) as u32;
    defmt::println!(
        "scene {=str} joints {=usize} tick-us {=u32} ticks {=u32}",
        S::NAME,
        N,
        us,
        ticks
    );
    let pose = S::GAIN_POSE_NAME;
    defmt::println!("gains {=f32} {=f32} {=str}", OMEGA_N, ZETA, pose);
    cortex_m::interrupt::free(|cs| TICKED.borrow(cs).replace(Some(app)));
    peripherals.SYST.set_clock_source(SystClkSource::Core);
    peripherals.SYST.set_reload(CLOCK / 1_000_000 * us - 1);
    peripherals.SYST.clear_current();
    peripherals.SYST.enable_counter();
    peripherals.SYST.enable_interrupt();

    for (run, (plant, law)) in RUNS.iter().enumerate() {
        defmt::println!("run {=str} {=str}", plant, law);
        let mut errors = Errors::default();
        while errors.count() < ticks {
            let Some(record) = records.dequeue() else {
                cortex_m::asm::wfi();
                continue;
            };
            if record.run != run || record.tick != errors.count() {
                fail("a record was lost: the queue is too short");
            }
            if record.broken {
                fail("the simulated robot failed: its mass matrix is not positive definite");
            }
            errors.add(&record);
            if record.tick % SAMPLE == 0 {
                let (reference, actual) = (record.telemetry.reference, record.actual);
                let (reference, actual) = (Words(&reference), Words(&actual));
                defmt::println!("sample {=u32}{}{}", record.tick, reference, actual);
            }
        }
        defmt::println!("rms {=str} {=str}{}", plant, law, Words(&errors.rms()));
        defmt::println!("max {=str} {=str}{}", plant, law, Words(&errors.max));
        defmt::println!("total {=str} {=str} {=f32}", plant, law, errors.total());
        if let Some(Status {
            mode,
            fault,
            limited,
        }) = errors.status
        {
            let (mode, fault) = (defmt::Debug2Format(&mode), defmt::Debug2Format(&fault));
            defmt::println!(
                "status {=str} {=str} mode {}, fault {}, limited {=bool}",
                plant,
                law,
                mode,
                fault,
                limited
            );
        }
    }
    defmt::println!("stack {=usize}", stack_peak());
    defmt::println!("done");
    leave(debug::EXIT_SUCCESS)
}

/// Numbers, each after a space.
struct Words<'a>(&'a [f32]);

impl defmt::Format for Words<'_> {
    fn format(&self, out: defmt::Formatter<'_>) {
        for number in self.0 {
            defmt::write!(out, " {=f32}", number);
        }
    }
}

/// Leaves the emulator with a message and a failure.
pub fn fail(why: &str) -> ! {
    defmt::error!("{=str}", why);
    leave(debug::EXIT_FAILURE)
}

/// Leaves the emulator.
pub fn leave(status: debug::ExitStatus) -> ! {
    loop {
        debug::exit(status);
    }
}

/// The most stack ever in use, bytes: what `cortex-m-rt` painted before `main` and nobody wrote to.
pub fn stack_peak() -> usize {
    const PAINT: u32 = 0xcccc_cccc;
    unsafe extern "C" {
        static mut _stack_start: u32;
        static mut _stack_end: u32;
    }
    let (mut at, top) = (&raw const _stack_end, &raw const _stack_start);
    // SAFETY: the linker script's symbols bound the stack's memory, which is mapped and aligned;
    // volatile reads of words that others may write are harmless here.
    while at < top && unsafe { at.read_volatile() } == PAINT {
        at = at.wrapping_add(1);
    }
    top as usize - at as usize
}

#[panic_handler]
fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
    defmt::error!("panic: {}", defmt::Display2Format(info));
    leave(debug::EXIT_FAILURE)
}

#[exception]
unsafe fn HardFault(frame: &ExceptionFrame) -> ! {
    defmt::error!("panic: hard fault at {=u32:#x}", frame.pc());
    leave(debug::EXIT_FAILURE)
}
