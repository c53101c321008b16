//! Encoders on one bus.

use embedded_hal::delay::DelayNs;
use embedded_hal_bus::spi::AtomicDevice;
use embedded_hal_bus::util::AtomicCell;

use crate::board::N;
use crate::chip::{AnyPin, Output};
use crate::pins::Bus;

/// An encoder's part of the bus.
pub type Encoder = AtomicDevice<'static, Bus, AnyPin<Output>, Spin>;

/// Delays within a transaction, which the encoders do not have. The bus' own placeholder for them
/// panics.
#[derive(Clone, Copy)]
pub struct Spin;

impl DelayNs for Spin {
    fn delay_ns(&mut self, ns: u32) {
        // At 170 MHz and below, a cycle takes more than 5 ns.
        cortex_m::asm::delay(ns / 5 + 1);
    }
}

/// The encoders on their bus. Not inlined, as all that start-up calls: it then needs the stack of
/// one function at a time.
#[inline(never)]
pub fn encoders(bus: &'static AtomicCell<Bus>, selects: [AnyPin<Output>; N]) -> [Encoder; N] {
    selects.map(|select| {
        let Ok(encoder) = AtomicDevice::new(bus, select, Spin);
        encoder
    })
}
