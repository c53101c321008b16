//! Encoders on one bus.

use core::convert::Infallible;

use embedded_hal::delay::DelayNs;
use embedded_hal::digital::OutputPin;
use embedded_hal_bus::spi::AtomicDevice;
use embedded_hal_bus::util::AtomicCell;

/// An encoder's part of the bus.
pub type Encoder<'a, Bus, Select> = AtomicDevice<'a, Bus, Select, Spin>;

/// Delays within a transaction, which the encoders do not have. The bus' own placeholder for them
/// panics.
#[derive(Clone, Copy, Debug)]
pub struct Spin;

impl DelayNs for Spin {
    fn delay_ns(&mut self, ns: u32) {
        // At 200 MHz and below, a cycle takes at least 5 ns.
        cortex_m::asm::delay(ns / 5 + 1);
    }
}

/// The encoders on their bus. Not inlined, as all that start-up calls: it then needs the stack of
/// one function at a time.
#[inline(never)]
pub fn encoders<Bus, Select: OutputPin<Error = Infallible>, const N: usize>(
    bus: &AtomicCell<Bus>,
    selects: [Select; N],
) -> [Encoder<'_, Bus, Select>; N] {
    selects.map(|select| {
        let Ok(encoder) = AtomicDevice::new(bus, select, Spin);
        encoder
    })
}
