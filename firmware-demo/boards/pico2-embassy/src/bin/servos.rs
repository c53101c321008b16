//! The servo bus of an SO-101 on a serial port of Embassy, which the driver has to compile with:
//! positions of all servos, and the duties that damp them, 500 times a second.
#![cfg_attr(target_arch = "arm", no_std, no_main)]

#[cfg(target_arch = "arm")]
mod servos {
    use embassy_executor::Spawner;
    use embassy_rp::bind_interrupts;
    use embassy_rp::peripherals::UART0;
    use embassy_rp::uart::{BufferedInterruptHandler, BufferedUart, Config};
    use embassy_time::{Duration, Ticker, with_timeout};
    use joint_drivers::feetech::Servos;
    use joint_drivers::{Direction, JointMapping, JointRange};
    use panic_halt as _;

    bind_interrupts!(struct Interrupts {
        UART0_IRQ => BufferedInterruptHandler<UART0>;
    });

    const PERIOD: Duration = Duration::from_hz(500);

    #[embassy_executor::main]
    async fn main(_spawner: Spawner) {
        let chip = embassy_rp::init(embassy_rp::config::Config::default());
        let (mut sent, mut received) = ([0; 64], [0; 128]);
        let mut config = Config::default();
        config.baudrate = 1_000_000;
        let port = BufferedUart::new(
            chip.UART0,
            chip.PIN_0,
            chip.PIN_1,
            Interrupts,
            &mut sent,
            &mut received,
            config,
        );
        let Ok(middle) = JointMapping::new(core::f32::consts::PI, Direction::Forward, 1.0) else {
            return;
        };
        // Each joint is within 2 rad of its middle, and turns by 6 rad/s at most.
        let range = JointRange::Within { lower: -2.0, upper: 2.0 };
        let Ok(middle) = middle.with_range(range, 6.0 / 500.0) else {
            return;
        };
        let Ok(mut servos) = Servos::new(port, [1, 2, 3, 4, 5, 6], [middle; 6]) else {
            return;
        };
        let mut ticker = Ticker::every(PERIOD);
        let mut last = None;
        loop {
            // The port waits without a limit: a servo that does not reply costs half a period.
            let read = with_timeout(PERIOD / 2, servos.positions_async()).await;
            let now = read.ok().and_then(Result::ok);
            let duties = match (last, now) {
                (Some(last), Some(now)) => damping(&last, &now),
                _ => [0.0; 6],
            };
            last = now;
            let _ = with_timeout(PERIOD / 4, servos.set_duties_async(&duties)).await;
            ticker.next().await;
        }
    }

    fn damping(last: &[f32; 6], now: &[f32; 6]) -> [f32; 6] {
        core::array::from_fn(|joint| 2.0 * (last[joint] - now[joint]))
    }
}

#[cfg(not(target_arch = "arm"))]
fn main() {}
