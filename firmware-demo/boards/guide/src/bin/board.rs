//! A rod on a bearing, moved by a Nucleo-F446RE: encoder, drive, brake and button around the
//! control loop.
#![cfg_attr(target_arch = "arm", no_std, no_main)]

#[cfg(target_arch = "arm")]
mod program {
    // page: begin
    use cortex_m_rt::entry;
    use guide_firmware::rod::{CONFIG, Rod, gains, path};
    use joint_drivers::h_bridge::{FullScale, SignMagnitude};
    use joint_drivers::{ControlLoop, Direction, JointMapping, JointRange, as5600::As5600};
    use motion_control::{limits::Mode, motion::MotionController};
    use panic_halt as _;
    use stm32f4xx_hal::{i2c::I2c, nb, pac, prelude::*, rcc::Config};

    #[entry]
    fn main() -> ! {
        let chip = pac::Peripherals::take().expect("called only once");
        let mut rcc = chip.RCC.freeze(Config::hsi().sysclk(168.MHz()));
        let (a, b) = (chip.GPIOA.split(&mut rcc), chip.GPIOB.split(&mut rcc));
        let button = chip.GPIOC.split(&mut rcc).pc13.into_floating_input();
        // High holds the joint, from here on.
        let brake = b.pb12.into_push_pull_output_in_state(true.into());

        // The encoder reads 1.5 rad where the joint is at zero, and turns the other way round.
        let mapping = JointMapping::new(1.5, Direction::Reverse, 1.0).expect("within its range");
        // It is between ±3 rad at power-up, and moves by 5 rad/s at most.
        let range = JointRange::Within {
            lower: -3.0,
            upper: 3.0,
        };
        let mapping = mapping
            .with_range(range, 5.0 * 1e-3)
            .expect("less than a turn");
        let bus = I2c::new(chip.I2C1, (b.pb8, b.pb9), 400.kHz(), &mut rcc);
        let encoder = As5600::new(bus, mapping);

        // The bridge delivers 20 N·m at a duty of 100 %.
        let scale = FullScale::new(20.0).expect("above zero");
        let (_, (channel, ..)) = chip.TIM1.pwm_hz(20.kHz(), &mut rcc);
        let mut pwm = channel.with(a.pa8);
        pwm.enable();
        let sign = a.pa9.into_push_pull_output();
        let drive = SignMagnitude::new(pwm, sign, scale, Direction::Forward);

        let path = path().expect("within its limits");
        let controller = MotionController::new(CONFIG).on_brake();
        let mut control = ControlLoop::new([encoder], [drive], brake, gains(), controller, ());

        let mut timer = chip.TIM2.counter_hz(&mut rcc);
        timer.start(1.kHz()).expect("within its range");
        loop {
            let _ = nb::block!(timer.wait());
            let status = control.tick::<Rod, _, _>(&path, &()).status;
            if status.mode == Mode::Stopped && button.is_low() {
                // Refused while the joint is too far from its path: it stays on its brake.
                let _ = control.reset(&path);
            }
        }
    }
    // page: end
}

#[cfg(not(target_arch = "arm"))]
fn main() {}
