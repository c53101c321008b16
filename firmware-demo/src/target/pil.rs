//! A scene's controller, its robot simulated by a program on the host, over USART1.

use stm32f4xx_hal::gpio::GpioExt;
use stm32f4xx_hal::hal_02::serial::Read;
use stm32f4xx_hal::nb::block;
use stm32f4xx_hal::pac;
use stm32f4xx_hal::serial::SerialExt;
use stm32f4xx_hal::serial::config::Config;
use telemetry::decoder::Frames;
use telemetry::encode;

use super::fail;
use super::watch::{BAUD, clock, write};
use crate::pil::Controlled;
use crate::scene::Scene;
use crate::sim_io::Wires;

/// Replies to encoder frames by duties, without end and without an interrupt: the host is the clock.
pub fn control<S, const B: usize, const Q: usize, const V: usize, const N: usize>(
    wires: &'static Wires<N>,
) -> !
where
    S: Scene<B, Q, V, N>,
{
    let Some(part) = pac::Peripherals::take() else {
        fail("the peripherals are taken");
    };
    let mut clock = clock(part.RCC);
    let pins = part.GPIOA.split(&mut clock);
    let config = Config::default().baudrate(stm32f4xx_hal::time::Bps(BAUD));
    let Ok(port) = (part.USART1).serial::<u8>((pins.pa9, pins.pa10), config, &mut clock) else {
        fail("the serial port cannot have this rate");
    };
    let (mut out, mut input) = port.split();
    let Ok(mut controlled) = Controlled::<S, B, Q, V, N>::new(wires) else {
        fail("the trajectory needs more than the arm's limits");
    };
    let mut frames = Frames::new();
    let mut bytes = [0; 512];
    loop {
        // A byte that the port could not read is missing in its frame; the checksum finds that, and the host sends it again.
        let Ok(byte) = block!(input.read()) else {
            continue;
        };
        if let Some(Ok(measured)) = frames.push(byte)
            && let Ok(frame) = encode(controlled.tick(&measured), &mut bytes)
        {
            write(frame, &mut out);
        }
    }
}
