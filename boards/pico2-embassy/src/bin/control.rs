//! The control loop of the scene `ur5e` on encoders and drives, as a task of Embassy: nothing is simulated.
//!
//! | part | pins |
//! |---|---|
//! | six AS5047P on SPI 0, 9.4 MHz | SCK GP18, MISO GP16, MOSI GP19; select GP17, GP20, GP21, GP22, GP26, GP27 |
//! | six current-controlled drives on PWM, 20 kHz, 50 % is zero torque | GP0, GP1 (slice 0), GP2, GP3 (slice 1), GP4, GP5 (slice 2) |
//! | brake, high holds; while the chip restarts, a pull-up on the board of the brake does | GP6 |
//! | start and restart | a button from GP7 to ground |
//! | the arm follows its trajectory | the green light, GP25 |
//!
//! The arm starts on its brake. The button starts it if every joint is near the start of the trajectory. A tick that
//! does not end within its period feeds no watchdog; 20 of them restart the processor, which sets the brake.
//!
//! A further PWM slice counts the millisecond, without pins, and its interrupt is at the same time the one in which the
//! executor runs: nothing has to set the next alarm, and between the period's end and the tick lie no queue of timers and
//! no second interrupt. What is left of jitter is the entry of an interrupt of the highest priority and the misses of the
//! XIP cache. Embassy's own `Ticker` sets an alarm for each period, whose interrupt wakes the executor by a second one.
#![cfg_attr(target_arch = "arm", no_std, no_main)]

#[cfg(target_arch = "arm")]
mod firmware {
    use cortex_m_rt::entry;
    use embassy_executor::InterruptExecutor;
    use embassy_rp::Peripherals;
    use embassy_rp::gpio::Level;
    use embassy_rp::interrupt;
    use embassy_rp::interrupt::{InterruptExt, Priority};
    use embassy_rp::pac;
    use embassy_rp::peripherals::SPI0;
    use embassy_rp::pwm::{self, Pwm};
    use embassy_rp::spi::{self, Blocking, Phase, Polarity, Spi};
    use embassy_rp::watchdog::Watchdog;
    use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
    use embassy_sync::signal::Signal;
    use embassy_time::Duration;
    use embedded_hal::delay::DelayNs;
    use embedded_hal::digital::OutputPin;
    use embedded_hal_bus::spi::AtomicDevice;
    use embedded_hal_bus::util::AtomicCell;
    use firmware_demo::scene::{Devices, Full, Scene, SceneLoop, Start};
    use firmware_demo::scenes::ur5e::{PickAndPlace, plan};
    use motion_control::{self as control, CompletedTick, Detectors, Mode};
    use panic_halt as _;
    use pico2_embassy::devices::{Button, Channel, Line, Select};
    use pico2_embassy::{Moment, PERIOD, Periods};

    type Bus = Spi<'static, SPI0, Blocking>;
    type Encoder<'a> = AtomicDevice<'a, Bus, Select, Spin>;
    type Reference = <PickAndPlace as Scene<6, 6, 6, 6>>::Reference;

    /// The processor's clock after `embassy_rp::init`, MHz.
    const MHZ: u8 = 150;
    /// The slice that counts the period.
    const SLICE: usize = 7;
    /// The time that the watchdog waits for a completed tick.
    const STARVED: Duration = Duration::from_millis(20);

    static EXECUTOR: InterruptExecutor = InterruptExecutor::new();
    static PERIOD_ENDED: Signal<CriticalSectionRawMutex, ()> = Signal::new();

    /// Delays within a transaction, which the encoders do not have. The bus' own placeholder for them panics.
    #[derive(Clone, Copy)]
    struct Spin;

    impl DelayNs for Spin {
        fn delay_ns(&mut self, ns: u32) {
            // 150 MHz are 6.7 ns a cycle, rounded up.
            cortex_m::asm::delay(ns / 6 + 1);
        }
    }

    /// The watchdog of the chip, which only a completed tick feeds.
    struct Starved(Watchdog);

    impl control::Watchdog for Starved {
        fn feed(&mut self, _: CompletedTick) {
            self.0.feed(STARVED);
        }
    }

    struct Arm<'a> {
        control: SceneLoop<Encoder<'a>, Channel, Line, 6, Detectors<f32, 6>>,
        reference: Reference,
        periods: Periods,
        watchdog: Starved,
        button: Button,
        light: Line,
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
        // The brake first.
        let brake = Line::new(chip.PIN_6, Level::High);
        let light = Line::new(chip.PIN_25, Level::Low);

        let mut config = spi::Config::default();
        config.frequency = 10_000_000;
        // Mode 1.
        (config.polarity, config.phase) = (Polarity::IdleLow, Phase::CaptureOnSecondTransition);
        let bus = Spi::new_blocking(chip.SPI0, chip.PIN_18, chip.PIN_19, chip.PIN_16, config);
        let bus = AtomicCell::new(bus);
        let selects = [
            Select::new(chip.PIN_17),
            Select::new(chip.PIN_20),
            Select::new(chip.PIN_21),
            Select::new(chip.PIN_22),
            Select::new(chip.PIN_26),
            Select::new(chip.PIN_27),
        ];
        let encoders = selects.map(|select| {
            let Ok(encoder) = AtomicDevice::new(&bus, select, Spin);
            encoder
        });

        // 20 kHz, and 50 % from the start.
        let mut config = pwm::Config::default();
        config.top = 1000 * u16::from(MHZ) / 20 - 1;
        (config.compare_a, config.compare_b) = (config.top / 2 + 1, config.top / 2 + 1);
        let [one, two] = Channel::pair(chip.PWM_SLICE0, chip.PIN_0, chip.PIN_1, &config);
        let [three, four] = Channel::pair(chip.PWM_SLICE1, chip.PIN_2, chip.PIN_3, &config);
        let [five, six] = Channel::pair(chip.PWM_SLICE2, chip.PIN_4, chip.PIN_5, &config);
        let drives = [one, two, three, four, five, six];

        let devices = Devices {
            encoders,
            drives,
            brake,
        };
        let (gains, detectors) = (PickAndPlace::gains(&()), PickAndPlace::detectors());
        let control = PickAndPlace::control_loop(devices, gains, detectors, Start::OnBrake);
        let mut reference = Reference::REST;
        let (Ok(()), Ok(control)) = (plan(&mut reference), control) else {
            // The brake is set, the drives have no torque, and the light stays off.
            return;
        };

        // One count is a microsecond.
        let mut config = pwm::Config::default();
        config.divider = MHZ.into();
        config.top = PERIOD as u16 - 1;
        let _period = Pwm::new_free(chip.PWM_SLICE7, config);
        pac::PWM.irq0_inte().write(|all| all.0 = 1 << SLICE);
        let mut arm = Arm {
            control,
            reference,
            periods: Periods::starting(moment()),
            watchdog: Starved(Watchdog::new(chip.WATCHDOG)),
            button: Button::new(chip.PIN_7),
            light,
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
        type Law = Full<PickAndPlace, 6, 6, 6>;
        arm.periods.advance(moment());
        let count = || arm.periods.count(moment());
        let (telemetry, completed) =
            (arm.control).tick_at::<Law, _, ()>(&arm.reference, &(), count);
        if let Some(completed) = completed {
            control::Watchdog::feed(&mut arm.watchdog, completed);
        }
        let mode = telemetry.status.mode;
        if matches!(mode, Mode::Stopped) && arm.button.is_pressed() {
            // Too far from the trajectory, or without a measurement: the arm stays on its brake.
            let _ = arm.control.reset(&arm.reference);
        }
        let Ok(()) = arm.light.set_state(matches!(mode, Mode::Full).into());
    }

    fn moment() -> Moment {
        Moment {
            micros: pac::TIMER0.timerawl().read(),
            phase: pac::PWM.ch(SLICE).ctr().read().ctr().into(),
        }
    }
}

#[cfg(not(target_arch = "arm"))]
fn main() {}
