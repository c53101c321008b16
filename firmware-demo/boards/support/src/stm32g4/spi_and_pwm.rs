//! PWM channels and the bus of encoders.
//!
//! The bus of the HAL can panic, and each of its channels is a type of its own: here are their
//! registers.

use core::convert::Infallible;

use stm32g4xx_hal::hal::pwm::{self, SetDutyCycle};
use stm32g4xx_hal::hal::spi::{self, ErrorKind, SpiBus};
use stm32g4xx_hal::hal_02::PwmPin;
use stm32g4xx_hal::pac::SPI1;
use stm32g4xx_hal::pac::tim1::CCR;
use stm32g4xx_hal::rcc::Rcc;
use stm32g4xx_hal::spi::{MODE_1, Pins, SpiExt};

/// A PWM channel of either timer: its register, and the duty of 100 %.
pub struct Channel(&'static CCR, u16);

// SAFETY: nothing else uses the register, from whichever interrupt the channel is used.
unsafe impl Send for Channel {}

impl Channel {
    /// The channel with its pin, as a drive that is set to no torque.
    pub fn new(mut pwm: impl PwmPin<Duty = u16>, register: &'static CCR) -> Self {
        let most = pwm.get_max_duty();
        pwm.set_duty(most / 2);
        pwm.enable();
        Self(register, most)
    }
}

impl pwm::ErrorType for Channel {
    type Error = Infallible;
}

impl SetDutyCycle for Channel {
    #[inline]
    fn max_duty_cycle(&self) -> u16 {
        self.1
    }

    #[inline]
    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Infallible> {
        // SAFETY: every duty is one for this register, which nothing else writes.
        self.0.write(|w| unsafe { w.ccr().bits(duty.into()) });
        Ok(())
    }
}

/// The bus of the encoders, in mode 1.
pub struct Bus(SPI1);

impl Bus {
    /// The bus on its pins.
    pub fn new(spi: SPI1, pins: impl Pins<SPI1>, rcc: &mut Rcc) -> Self {
        // A 32nd of the clock: a 16th is beyond the 10 MHz of the encoders.
        let rate = rcc.clocks.apb2_clk / 32;
        Self(spi.spi(pins, MODE_1, rate, rcc).release().0)
    }

    /// Sends a byte, and returns the one that comes meanwhile.
    #[inline]
    fn exchange(&mut self, byte: u8) -> Result<u8, ErrorKind> {
        self.0.dr8().write(|w| w.dr().set(byte));
        loop {
            let status = self.0.sr().read();
            if status.rxne().bit() {
                return Ok(self.0.dr8().read().dr().bits());
            }
            if status.modf().bit() {
                return Err(ErrorKind::ModeFault);
            }
        }
    }
}

impl spi::ErrorType for Bus {
    type Error = ErrorKind;
}

impl SpiBus for Bus {
    fn read(&mut self, words: &mut [u8]) -> Result<(), ErrorKind> {
        self.transfer(words, &[])
    }

    fn write(&mut self, words: &[u8]) -> Result<(), ErrorKind> {
        self.transfer(&mut [], words)
    }

    fn transfer(&mut self, read: &mut [u8], write: &[u8]) -> Result<(), ErrorKind> {
        for at in 0..read.len().max(write.len()) {
            let byte = self.exchange(write.get(at).copied().unwrap_or_default())?;
            if let Some(place) = read.get_mut(at) {
                *place = byte;
            }
        }
        Ok(())
    }

    #[inline]
    fn transfer_in_place(&mut self, words: &mut [u8]) -> Result<(), ErrorKind> {
        for word in words {
            *word = self.exchange(*word)?;
        }
        Ok(())
    }

    #[inline]
    fn flush(&mut self) -> Result<(), ErrorKind> {
        while self.0.sr().read().bsy().bit() {}
        Ok(())
    }
}
