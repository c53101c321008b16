//! A scene that runs without end and sends its telemetry over USART1, from the main loop.
//!
//! In QEMU the argument of `-semihosting-config` sets it: `arg=ticks=3000` ends the run,
//! `arg=faults=5000` injects faults, `arg=listen=0` leaves the queue full, as a port does that
//! takes no byte.

use core::sync::atomic::{AtomicU32, Ordering::Relaxed};

use cortex_m::peripheral::SYST;
use embedded_io::Write;
use machine_link::{Consumer, Message, Queue, Slots, capacity, encode, split};
use stm32f4xx_hal::gpio::GpioExt;
use stm32f4xx_hal::pac;
use stm32f4xx_hal::rcc::{Rcc, RccExt};
use stm32f4xx_hal::serial::config::{Config, InvalidConfig};
use stm32f4xx_hal::serial::{SerialExt, Tx};

use super::{CLOCK, Tick, fail, leave, microseconds, start};
use crate::scene::Scene;
use crate::sim_io::Wires;
use crate::watched::{Options, Timer, Watched, machine};

/// Ticks that wait for the port at most.
pub const QUEUE: usize = 64;
/// Rate of the port, bit/s: a frame of six joints takes about 0.6 ms.
pub const BAUD: u32 = 2_000_000;
/// Ticks from one frame with the machine's constants to the next.
pub(super) const MACHINE: u32 = 1000;

/// SysTick, whose interrupt is the tick.
#[derive(Clone, Copy, Debug)]
pub struct SysTick;

impl Timer for SysTick {
    #[inline(always)]
    fn count() -> u32 {
        SYST::get_current()
    }
}

/// A scene with its telemetry, timed by SysTick.
pub type Timed<S, const B: usize, const Q: usize, const V: usize, const N: usize> =
    Watched<S, SysTick, B, Q, V, N>;

impl<S, const B: usize, const Q: usize, const V: usize, const N: usize> Tick
    for Timed<S, B, Q, V, N>
where
    S: Scene<B, Q, V, N>,
{
    fn tick(&mut self) {
        Watched::tick(self);
    }
}

/// The slots of the ticks, and their queue.
pub type Records<const N: usize> =
    (&'static mut Slots<N, QUEUE>, &'static mut Queue<'static, N, QUEUE>);

/// Runs a scene on these wires, its state and records where `place` and the caller put them.
pub fn watch<S, const B: usize, const Q: usize, const V: usize, const N: usize>(
    wires: &'static Wires<N>,
    records: Option<Records<N>>,
    place: impl FnOnce(Timed<S, B, Q, V, N>) -> Option<&'static mut Timed<S, B, Q, V, N>>,
) -> !
where
    S: Scene<B, Q, V, N>,
    Timed<S, B, Q, V, N>: Send,
{
    static ELAPSED: AtomicU32 = AtomicU32::new(0);
    let (Some(mut core), Some(part)) = (cortex_m::Peripherals::take(), pac::Peripherals::take())
    else {
        fail("the peripherals are taken");
    };
    let period = CLOCK / 1_000_000 * microseconds::<S, B, Q, V, N>();
    let split = |(slots, queue)| split(slots, queue, period);
    let Some((records, mut ticks)) = records.map(split) else {
        fail("main ran twice");
    };
    let Ok(mut port) = port(part) else {
        fail("the serial port cannot have this rate");
    };
    let options = Options {
        ticks: argument(b"ticks").unwrap_or(0),
        faults: argument(b"faults").unwrap_or(0),
    };
    let listens = argument(b"listen") != Some(0);
    let Ok(watched) = Watched::new(wires, records, &ELAPSED, options) else {
        fail("the trajectory needs more than the arm's limits");
    };
    let Some(watched) = place(watched) else {
        fail("main ran twice");
    };
    let constants = Message::Machine(machine::<S, B, Q, V, N>(CLOCK));
    start(watched, &mut core, microseconds::<S, B, Q, V, N>());
    let mut sent = 0;
    loop {
        if listens {
            drain(&mut ticks, &mut port, &constants, &mut sent);
        }
        if options.ticks > 0 && ELAPSED.load(Relaxed) == options.ticks {
            defmt::println!("sent {=u32} of {=u32} ticks", sent, options.ticks);
            defmt::println!("done");
            leave(cortex_m_semihosting::debug::EXIT_SUCCESS);
        }
        cortex_m::asm::wfi();
    }
}

/// Sends what is in the queue, and from time to time the constants of the machine.
fn drain<const N: usize>(
    ticks: &mut Consumer<'static, 'static, N>,
    port: &mut impl Write,
    constants: &Message<N>,
    sent: &mut u32,
) {
    while let Some(tick) = ticks.pop() {
        if sent.is_multiple_of(MACHINE) {
            send(constants, port);
        }
        send(&Message::Tick(tick), port);
        *sent = sent.wrapping_add(1);
    }
}

/// Sends a message; waits for the port, not for the interrupt.
pub(super) fn send<const N: usize>(message: &Message<N>, port: &mut impl Write) {
    let mut bytes = [0; capacity(16)];
    // A message without a frame, and a port that fails, leave a gap that the listener counts.
    if let Ok(frame) = encode(message, &mut bytes) {
        write(frame, port);
    }
}

/// Writes all bytes. Not by `write_all`, which panics where the port takes none, as the HAL's does
/// while it is busy.
pub(super) fn write(mut bytes: &[u8], port: &mut impl Write) {
    while let Some(rest) = port.write(bytes).ok().and_then(|n| bytes.get(n..)) {
        if rest.is_empty() {
            return;
        }
        bytes = rest;
    }
}

/// USART1 on PA9. QEMU has no clock to set.
pub(super) fn port(part: pac::Peripherals) -> Result<Tx<pac::USART1>, InvalidConfig> {
    let mut clock = clock(part.RCC);
    let pins = part.GPIOA.split(&mut clock);
    let config = Config::default().baudrate(stm32f4xx_hal::time::Bps(BAUD));
    part.USART1.tx(pins.pa9, config, &mut clock)
}

pub(super) fn clock(rcc: pac::RCC) -> Rcc {
    rcc.constrain()
}

/// The number behind a name in the command line that the emulator gives.
pub(super) fn argument(name: &[u8]) -> Option<u32> {
    let mut text = [0_u8; 256];
    let mut block = [text.as_mut_ptr() as usize, text.len()];
    // SAFETY: the call writes a string of at most that many bytes to that address, and its length
    // over the second word; both are this function's own.
    let failed = unsafe {
        cortex_m_semihosting::syscall1(
            cortex_m_semihosting::nr::GET_CMDLINE,
            block.as_mut_ptr() as usize,
        )
    };
    let text = text.get(..block[1]).filter(|_| failed == 0)?;
    let mut words = text.split(|&byte| byte == b' ' || byte == 0);
    let value = words.find_map(|word| word.strip_prefix(name)?.strip_prefix(b"="))?;
    core::str::from_utf8(value).ok()?.parse().ok()
}
