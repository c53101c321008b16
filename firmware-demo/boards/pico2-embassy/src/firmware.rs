//! The control loop as a task of Embassy.
//!
//! The arm starts on its brake. The button starts it if every joint is near the start of its
//! motion. A tick that does not end within its period feeds no watchdog; 20 of them restart the
//! processor, which sets the brake.
//!
//! A PWM slice counts the millisecond, without pins, and its interrupt is at the same time the one
//! in which the executor runs: nothing has to set the next alarm, and between the period's end and
//! the tick lie no queue of timers and no second interrupt. The jitter that is left is the entry of
//! an interrupt of the highest priority and the misses of the XIP cache. Embassy's own `Ticker`
//! sets an alarm for each period, whose interrupt wakes the executor by a second one.

use board_support::encoders::encoders;
use board_support::periods::{Moment, PERIOD, Periods};
use board_support::rp2350::{Button, Channel, Line};
use cortex_m_rt::entry;
use embassy_executor::InterruptExecutor;
use embassy_rp::Peripherals;
use embassy_rp::interrupt;
use embassy_rp::interrupt::{InterruptExt, Priority};
use embassy_rp::pac;
use embassy_rp::pwm::{self, Pwm};
use embassy_rp::watchdog::Watchdog;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::signal::Signal;
use embassy_time::Duration;
use embedded_hal::digital::OutputPin;
use motion_control::{self as control, limits::Mode, safety::CompletedTick};

use crate::board::{self, Devices, Law, Motion};
use crate::log::{Log, impossible};
use crate::pins::{Connected, Encoder, MHZ, connect};

/// The slice that counts the period: that of `Connected::period`.
const SLICE: usize = 7;
/// The time that the watchdog waits for a completed tick.
const STARVED: Duration = Duration::from_millis(20);

static EXECUTOR: InterruptExecutor = InterruptExecutor::new();
static PERIOD_ENDED: Signal<CriticalSectionRawMutex, ()> = Signal::new();

/// The watchdog of the chip, which only a completed tick feeds.
struct Starved(Watchdog);

impl control::safety::Watchdog for Starved {
    fn feed(&mut self, _: CompletedTick) {
        self.0.feed(STARVED);
    }
}

struct Arm<'a> {
    control: board::Control<Encoder<'a>, Channel, Line, board::Found>,
    motion: Motion,
    periods: Periods,
    watchdog: Starved,
    button: Button,
    light: Line,
    log: Log,
}

/// The end of a period, and whatever else wakes the executor's task.
#[interrupt]
fn PWM_IRQ_WRAP_0() {
    let ended = pac::PWM.irq0_ints().read().0;
    if ended != 0 {
        pac::PWM.intr().write(|all| all.0 = ended);
        PERIOD_ENDED.signal(());
    }
    // SAFETY: this is the interrupt that the executor was started with, which `start` enables.
    unsafe { EXECUTOR.on_interrupt() };
}

#[entry]
fn main() -> ! {
    let chip = embassy_rp::init(embassy_rp::config::Config::default());
    interrupt::PWM_IRQ_WRAP_0.set_priority(Priority::P0);
    let spawner = EXECUTOR.start(interrupt::PWM_IRQ_WRAP_0);
    if let Ok(task) = follow(chip) {
        spawner.spawn(task);
    }
    // Other tasks of the application run here, in an executor of their own.
    loop {
        cortex_m::asm::wfi();
    }
}

/// Builds the control loop where it stays, and runs it.
#[embassy_executor::task]
async fn follow(chip: Peripherals) {
    let Connected { bus, selects, drives, brake, button, light, period, watchdog } = connect(chip);
    let encoders = encoders(&bus, selects);
    let mut motion = Motion::REST;
    let planned = board::plan(&mut motion).map_err(|error| impossible(&error));
    let (gains, detectors) = (board::gains(), board::detectors(&motion));
    let devices = Devices { encoders, drives, brake };
    let control = board::on_brake(devices, gains, detectors, &motion);
    let control = control.map_err(|error| impossible(&error));
    let (Ok(()), Ok(control)) = (planned, control) else {
        // The brake is set, the drives have no torque, and the light stays off.
        return;
    };

    // One count is a microsecond.
    let mut config = pwm::Config::default();
    config.divider = MHZ.into();
    config.top = PERIOD as u16 - 1;
    let _period = Pwm::new_free(period, config);
    pac::PWM.irq0_inte().write(|all| all.0 = 1 << SLICE);
    let mut arm = Arm {
        control,
        motion,
        periods: Periods::starting(moment()),
        watchdog: Starved(Watchdog::new(watchdog)),
        button,
        light,
        log: Log::new(),
    };
    arm.watchdog.0.start(STARVED);
    loop {
        PERIOD_ENDED.wait().await;
        tick(&mut arm);
    }
}

/// A tick at the count of the present period.
#[inline(never)]
fn tick(arm: &mut Arm<'_>) {
    arm.periods.advance(moment());
    let count = || arm.periods.count(moment());
    let (telemetry, completed) = arm.control.tick_at::<Law, _, ()>(&arm.motion, &(), count);
    if let Some(completed) = completed {
        control::safety::Watchdog::feed(&mut arm.watchdog, completed);
    }
    let mode = telemetry.status.mode;
    if matches!(mode, Mode::Stopped) && arm.button.is_pressed() {
        // Too far from the motion's start, or without a measurement: the arm stays on its brake.
        if let Err(reason) = arm.control.reset(&arm.motion) {
            arm.log.refused(reason);
        }
    }
    arm.log.tick(&telemetry);
    let Ok(()) = arm.light.set_state(matches!(mode, Mode::Full).into());
}

fn moment() -> Moment {
    Moment {
        micros: pac::TIMER0.timerawl().read(),
        phase: pac::PWM.ch(SLICE).ctr().read().ctr().into(),
    }
}
