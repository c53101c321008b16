//! The emulated board: SysTick, log, panic and fault handlers, stack painting.

use core::cell::RefCell;

use cortex_m::interrupt::Mutex;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::{ExceptionFrame, exception};
use cortex_m_semihosting::debug;
use defmt_semihosting as _;
use heapless::spsc::{Consumer, Queue};
use motion_control::limits::Status;

use crate::marker::measured;
use crate::region;
use crate::scene::{
    App, Errors, OMEGA_N, PlantModel, QUEUE, Record, Scene, StartError, Trial, ZETA,
};
use crate::sim_io::Wires;

pub mod trials;
#[cfg(feature = "telemetry")]
pub mod watch;

/// The core's clock, Hz.
const CLOCK: u32 = 168_000_000;
/// The number of ticks from one sample in the log to the next.
const SAMPLE: u32 = 20;

/// The body of the interrupt.
type Ticked = &'static mut (dyn Tick + Send);

/// Something that the interrupt runs once a tick.
pub trait Tick {
    fn tick(&mut self);
}

impl<S, const B: usize, const Q: usize, const V: usize, const N: usize> Tick for App<S, B, Q, V, N>
where
    S: Scene<B, Q, V, N>,
{
    fn tick(&mut self) {
        App::tick(self);
    }
}

/// The state that the interrupt takes over at its first tick.
static INITIAL: Mutex<RefCell<Option<Ticked>>> = Mutex::new(RefCell::new(None));

/// Interrupts are masked while it takes over what it runs, and not during a tick.
#[exception]
fn SysTick() {
    static mut TICKED: Option<Ticked> = None;
    if TICKED.is_none() {
        *TICKED = measured::<{ region::MASKED }, _>(|| {
            cortex_m::interrupt::free(|cs| INITIAL.borrow(cs).take())
        });
    }
    if let Some(app) = TICKED {
        app.tick();
    }
}

/// Starts the interrupt with this period.
fn start(app: Ticked, peripherals: &mut cortex_m::Peripherals, microseconds: u32) {
    measured::<{ region::MASKED }, _>(|| {
        cortex_m::interrupt::free(|cs| INITIAL.borrow(cs).replace(Some(app)))
    });
    let timer = &mut peripherals.SYST;
    timer.set_clock_source(SystClkSource::Core);
    timer.set_reload(CLOCK / 1_000_000 * microseconds - 1);
    timer.clear_current();
    timer.enable_counter();
    timer.enable_interrupt();
}

/// Runs a scene on these wires to its end, its state and queue where `place` and the caller put
/// them, and leaves the emulator.
pub fn scene<S, const B: usize, const Q: usize, const V: usize, const N: usize>(
    wires: &'static Wires<N>,
    queue: Option<&'static mut Queue<Record<N>, QUEUE>>,
    place: impl FnOnce(App<S, B, Q, V, N>) -> Option<&'static mut App<S, B, Q, V, N>>,
) -> !
where
    S: Scene<B, Q, V, N>,
    App<S, B, Q, V, N>: Send,
{
    let Some((records, log)) = queue.map(Queue::split) else {
        fail("main ran twice");
    };
    let app = match App::new(wires, records) {
        Ok(app) => app,
        Err(StartError::Trajectory(_)) => fail("the arm's limits do not allow the trajectory"),
        Err(StartError::Setup(_)) => fail("a limit of the scene is impossible for its devices"),
    };
    match place(app) {
        Some(app) => run(app, log),
        None => fail("main ran twice"),
    }
}

/// Starts the interrupt, logs what it reports until the last run has ended, and leaves the
/// emulator.
fn run<S, const B: usize, const Q: usize, const V: usize, const N: usize>(
    app: &'static mut App<S, B, Q, V, N>,
    mut records: Consumer<'static, Record<N>>,
) -> !
where
    S: Scene<B, Q, V, N>,
    App<S, B, Q, V, N>: Send,
{
    let Some(mut peripherals) = cortex_m::Peripherals::take() else {
        fail("the peripherals are taken");
    };
    let ticks = app.ticks();
    head::<App<S, B, Q, V, N>, N>(N, ticks);
    defmt::println!("gains {=f32} {=f32} {=str}", OMEGA_N, ZETA, S::GAIN_POSE_NAME);
    for effect in App::<S, B, Q, V, N>::TERMS {
        defmt::println!("effect {=str} {=usize}", (effect.name)(), effect.bytes);
    }
    start(app, &mut peripherals, microseconds::<S, B, Q, V, N>());

    for (number, run) in App::<S, B, Q, V, N>::runs().enumerate() {
        let law = run.less.name(App::<S, B, Q, V, N>::TERMS, run.law);
        begin(run.plant, law, run.tick as usize);
        let mut errors = Errors::default();
        while errors.count() < ticks {
            let Some(record) = records.dequeue() else {
                cortex_m::asm::wfi();
                continue;
            };
            if record.run != number || record.tick != errors.count() {
                fail("a record was lost: the queue is too short");
            }
            if record.broken {
                fail("the simulated robot failed: it has no forward dynamics");
            }
            errors.add(&record);
            if record.tick % SAMPLE == 0 {
                let (reference, actual) = (record.telemetry.reference, record.actual);
                let (reference, actual) = (Words(&reference), Words(&actual));
                defmt::println!("sample {=u32}{}{}", record.tick, reference, actual);
            }
        }
        figures(&errors.rms(), &errors.max, errors.total(), None, errors.status);
    }
    defmt::println!("stack {=usize}", stack_peak());
    defmt::println!("done");
    leave(debug::EXIT_SUCCESS)
}

/// A tick of the scene, µs.
fn microseconds<S, const B: usize, const Q: usize, const V: usize, const N: usize>() -> u32
where
    S: Scene<B, Q, V, N>,
{
    const { (S::TICK * 1e6 + 0.5) as u32 }
}

/// The log's description of a trial, before its runs.
fn head<T: Trial<N>, const N: usize>(joints: usize, ticks: u32) {
    let microseconds = const { (T::TICK * 1e6 + 0.5) as u32 };
    defmt::println!(
        "scene {=str} joints {=usize} tick-us {=u32} ticks {=u32} bound {=f32}",
        T::NAME,
        joints,
        microseconds,
        ticks,
        T::BOUND
    );
}

/// The log's line before a run, with its law's name in two parts.
fn begin(plant: PlantModel, [less, law]: [&str; 2], tick_at: usize) {
    let at = tick_at as u32;
    defmt::println!("run {=str} {=str}{=str} {=u32:#x}", plant.name(), less, law, at);
}

/// The figures of a run.
fn figures(rms: &[f32], max: &[f32], total: f32, start: Option<f32>, status: Option<Status>) {
    defmt::println!("rms{}", Words(rms));
    defmt::println!("max{}", Words(max));
    defmt::println!("total {=f32}", total);
    if let Some(start) = start {
        defmt::println!("start {=f32}", start);
    }
    if let Some(Status { mode, fault, limited }) = status {
        let (mode, fault) = (defmt::Debug2Format(&mode), defmt::Debug2Format(&fault));
        defmt::println!("status mode {}, fault {}, limited {=bool}", mode, fault, limited);
    }
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

/// The `main` of a scene: its type in [`scenes`](crate::scenes), and how many bodies, position
/// coordinates, velocity coordinates and driven joints its robot has. What lives as long as the
/// firmware lies in statics.
#[macro_export]
macro_rules! scene_main {
    ($module:ident::$scene:ident, $B:literal, $Q:literal, $V:literal, $N:literal) => {
        use $crate::sim_io::Wires;

        #[cfg(not(feature = "telemetry"))]
        #[::cortex_m_rt::entry]
        fn main() -> ! {
            use $crate::scene::{App, QUEUE, Record};

            type Scene = App<$crate::scenes::$module::$scene, $B, $Q, $V, $N>;
            type Queue = ::heapless::spsc::Queue<Record<$N>, QUEUE>;
            static WIRES: Wires<$N> = Wires::new();
            let queue = ::cortex_m::singleton!(: Queue = Queue::new());
            let place = |app| ::cortex_m::singleton!(: Scene = app);
            $crate::target::scene(&WIRES, queue, place)
        }

        #[cfg(feature = "telemetry")]
        #[::cortex_m_rt::entry]
        fn main() -> ! {
            use $crate::target::watch::{QUEUE, Timed, watch};

            type Scene = Timed<$crate::scenes::$module::$scene, $B, $Q, $V, $N>;
            type Slots = ::machine_link::Slots<$N, QUEUE>;
            type Queue = ::machine_link::Queue<'static, $N, QUEUE>;
            static WIRES: Wires<$N> = Wires::new();
            let slots = ::cortex_m::singleton!(: Slots = Slots::default());
            let queue = ::cortex_m::singleton!(: Queue = Queue::new());
            let place = |scene| ::cortex_m::singleton!(: Scene = scene);
            watch(&WIRES, slots.zip(queue), place)
        }
    };
}

/// Leaves the emulator with a message and a failure.
pub fn fail(why: &str) -> ! {
    defmt::error!("{=str}", why);
    leave(debug::EXIT_FAILURE)
}

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
