//! The control loop of the scene `ur5e` on encoders and drives, as a hardware task of RTIC: nothing is simulated.
//!
//! | part | pins |
//! |---|---|
//! | six AS5047P on SPI 1, 10 MHz | SCK PB3, MISO PB4, MOSI PB5; select PC0, PC1, PC2, PC3, PB0, PB1 |
//! | six current-controlled drives on PWM, 20 kHz, 50 % is zero torque | PA8, PA9, PA10, PA11 (TIM 1), PC6, PC7 (TIM 8) |
//! | brake, high holds | PB12 |
//! | start and restart | the blue button, PC13 |
//! | the arm follows its trajectory | the green light, PA5 |
//!
//! The arm starts on its brake. The button starts it if every joint is near the start of the trajectory. A tick that
//! does not end within its period feeds no watchdog; 20 of them restart the processor, which sets the brake.
#![cfg_attr(target_arch = "arm", no_std, no_main)]

#[cfg(target_arch = "arm")]
use panic_halt as _;

#[cfg(target_arch = "arm")]
#[rtic::app(device = stm32f4xx_hal::pac, peripherals = true)]
mod app {
    use core::convert::Infallible;

    use embedded_hal_bus::spi::AtomicDevice;
    use embedded_hal_bus::util::AtomicCell;
    use firmware_demo::scene::{Devices, Full, Scene, SceneLoop, Start};
    use firmware_demo::scenes::ur5e::{PickAndPlace, plan};
    use motion_control::{CompletedTick, Detectors, Gains, Mode, Watchdog};
    use nucleo_f446re::clocks;
    use stm32f4xx_hal::gpio::{
        AnyPin, Input, Output, PA5, PA8, PA9, PA10, PA11, PB0, PB1, PB12, PC0, PC1, PC2, PC3, PC6,
        PC7, PC13,
    };
    use stm32f4xx_hal::hal::delay::DelayNs;
    use stm32f4xx_hal::hal::pwm::{ErrorType, SetDutyCycle};
    use stm32f4xx_hal::hal::spi::MODE_1;
    use stm32f4xx_hal::pac::{SPI1, TIM1, TIM2, TIM8};
    use stm32f4xx_hal::prelude::*;
    use stm32f4xx_hal::rcc::Rcc;
    use stm32f4xx_hal::spi::Spi;
    use stm32f4xx_hal::timer::{CounterHz, Event, Flag, pwm::ErasedChannel};
    use stm32f4xx_hal::watchdog::IndependentWatchdog;

    type Encoder = AtomicDevice<'static, Spi<SPI1>, AnyPin<Output>, Spin>;
    type Reference = <PickAndPlace as Scene<6, 6, 6, 6>>::Reference;

    /// Delays within a transaction, which the encoders do not have. The bus' own placeholder for them panics.
    #[derive(Clone, Copy)]
    pub struct Spin;

    impl DelayNs for Spin {
        fn delay_ns(&mut self, ns: u32) {
            // 168 MHz are 6 ns a cycle, rounded up.
            cortex_m::asm::delay(ns / 6 + 1);
        }
    }

    /// A PWM channel of either timer.
    pub enum Channel {
        One(ErasedChannel<TIM1>),
        Eight(ErasedChannel<TIM8>),
    }

    impl ErrorType for Channel {
        type Error = Infallible;
    }

    impl SetDutyCycle for Channel {
        fn max_duty_cycle(&self) -> u16 {
            match self {
                Self::One(channel) => channel.max_duty_cycle(),
                Self::Eight(channel) => channel.max_duty_cycle(),
            }
        }

        fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Infallible> {
            match self {
                Self::One(channel) => channel.set_duty_cycle(duty),
                Self::Eight(channel) => channel.set_duty_cycle(duty),
            }
        }
    }

    /// The watchdog of the board, which only a completed tick feeds.
    pub struct Starved(IndependentWatchdog);

    impl Watchdog for Starved {
        fn feed(&mut self, _: CompletedTick) {
            self.0.feed();
        }
    }

    #[shared]
    struct Shared {}

    type Detect = &'static mut Detectors<f32, 6>;
    type Control = SceneLoop<Encoder, Channel, PB12<Output>, 6, Detect>;

    #[local]
    struct Local {
        // In their places already: moved through the stack, they would take as much of it again.
        control: &'static mut Control,
        reference: &'static Reference,
        timer: CounterHz<TIM2>,
        watchdog: Starved,
        button: PC13<Input>,
        light: PA5<Output>,
    }

    /// The encoders on their bus. Not inlined, as all that follows: start-up then needs the stack of one of them.
    #[inline(never)]
    fn encoders(
        bus: &'static AtomicCell<Spi<SPI1>>,
        (pc0, pc1, pc2, pc3, pb0, pb1): (PC0, PC1, PC2, PC3, PB0, PB1),
    ) -> [Encoder; 6] {
        let high = true.into();
        let selects: [AnyPin<Output>; 6] = [
            pc0.into_push_pull_output_in_state(high).erase(),
            pc1.into_push_pull_output_in_state(high).erase(),
            pc2.into_push_pull_output_in_state(high).erase(),
            pc3.into_push_pull_output_in_state(high).erase(),
            pb0.into_push_pull_output_in_state(high).erase(),
            pb1.into_push_pull_output_in_state(high).erase(),
        ];
        selects.map(|select| {
            let Ok(encoder) = AtomicDevice::new(bus, select, Spin);
            encoder
        })
    }

    /// The drives, without torque.
    #[inline(never)]
    fn drives(
        (one, pa8, pa9, pa10, pa11): (TIM1, PA8, PA9, PA10, PA11),
        (eight, pc6, pc7): (TIM8, PC6, PC7),
        rcc: &mut Rcc,
    ) -> [Channel; 6] {
        let (_, (first, second, third, fourth)) = one.pwm_hz(20.kHz(), rcc);
        let (_, (fifth, sixth, ..)) = eight.pwm_hz(20.kHz(), rcc);
        let mut drives = [
            Channel::One(first.with(pa8).erase()),
            Channel::One(second.with(pa9).erase()),
            Channel::One(third.with(pa10).erase()),
            Channel::One(fourth.with(pa11).erase()),
            Channel::Eight(fifth.with(pc6).erase()),
            Channel::Eight(sixth.with(pc7).erase()),
        ];
        for drive in &mut drives {
            let Ok(()) = drive.set_duty_cycle_percent(50);
            match drive {
                Channel::One(channel) => channel.enable(),
                Channel::Eight(channel) => channel.enable(),
            }
        }
        drives
    }

    #[inline(never)]
    fn place_detectors(place: &'static mut Option<Detectors<f32, 6>>) -> Detect {
        place.insert(PickAndPlace::detectors())
    }

    #[inline(never)]
    fn place_control(
        place: &mut Option<Control>,
        devices: Devices<Encoder, Channel, PB12<Output>, 6>,
        gains: Gains<f32, 6>,
        detectors: Detect,
    ) -> Option<&mut Control> {
        let control = PickAndPlace::control_loop(devices, gains, detectors, Start::OnBrake);
        Some(place.insert(control.ok()?))
    }

    #[inline(never)]
    fn gains() -> Gains<f32, 6> {
        PickAndPlace::gains(&())
    }

    #[init(local = [
        bus: Option<AtomicCell<Spi<SPI1>>> = None,
        memory: Option<Detectors<f32, 6>> = None,
        place: Option<Control> = None,
        path: Reference = Reference::REST,
    ])]
    fn init(cx: init::Context) -> (Shared, Local) {
        let device = cx.device;
        let mut rcc = device.RCC.freeze(clocks());
        let (a, b, c) = (
            device.GPIOA.split(&mut rcc),
            device.GPIOB.split(&mut rcc),
            device.GPIOC.split(&mut rcc),
        );
        // The brake first.
        let brake = b.pb12.into_push_pull_output_in_state(true.into());

        // PB3 and PB4 are those of JTAG after a reset.
        let (clock, miso) = (b.pb3.into_floating_input(), b.pb4.into_floating_input());
        let pins = (Some(clock), Some(miso), Some(b.pb5));
        let spi = Spi::new(device.SPI1, pins, MODE_1, 10.MHz(), &mut rcc);
        let bus = cx.local.bus.insert(AtomicCell::new(spi));
        let selects = (c.pc0, c.pc1, c.pc2, c.pc3, b.pb0, b.pb1);
        let one = (device.TIM1, a.pa8, a.pa9, a.pa10, a.pa11);
        let eight = (device.TIM8, c.pc6, c.pc7);
        let devices = Devices {
            encoders: encoders(bus, selects),
            drives: drives(one, eight, &mut rcc),
            brake,
        };
        let gains = gains();
        let reference = cx.local.path;
        let detectors = place_detectors(cx.local.memory);
        let control = place_control(cx.local.place, devices, gains, detectors);
        let (Ok(()), Some(control)) = (plan(reference), control) else {
            // The brake is set, the drives have no torque, and the light stays off.
            loop {
                cortex_m::asm::wfi();
            }
        };
        let mut timer = device.TIM2.counter_hz(&mut rcc);
        let Ok(()) = timer.start(1.kHz()) else {
            loop {
                cortex_m::asm::wfi();
            }
        };
        timer.listen(Event::Update);
        let mut watchdog = IndependentWatchdog::new(device.IWDG);
        watchdog.start(20.millis());
        let local = Local {
            control,
            reference,
            timer,
            watchdog: Starved(watchdog),
            button: c.pc13.into_floating_input(),
            light: a.pa5.into_push_pull_output(),
        };
        (Shared {}, local)
    }

    #[task(
        binds = TIM2,
        local = [control, reference, timer, watchdog, button, light, count: u32 = 0],
        priority = 2
    )]
    fn tick(cx: tick::Context) {
        let local = cx.local;
        let reference: &Reference = local.reference;
        local.timer.clear_flags(Flag::Update);
        *local.count = local.count.wrapping_add(1);
        let now = *local.count;
        // A period that has ended since then is pending.
        let count = || now.wrapping_add(u32::from(local.timer.flags().contains(Flag::Update)));
        type Law = Full<PickAndPlace, 6, 6, 6>;
        let (telemetry, completed) = (local.control).tick_at::<Law, _, ()>(reference, &(), count);
        if let Some(completed) = completed {
            local.watchdog.feed(completed);
        }
        let mode = telemetry.status.mode;
        if matches!(mode, Mode::Stopped) && local.button.is_low() {
            // Too far from the trajectory, or without a measurement: the arm stays on its brake.
            let _ = local.control.reset(reference);
        }
        local.light.set_state(matches!(mode, Mode::Full).into());
    }
}

#[cfg(not(target_arch = "arm"))]
fn main() {}
