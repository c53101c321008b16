//! The library of a project for a board on this computer: it starts on its brake, follows its
//! motion after a reset, and notices that encoders which always read zero do not move.

use core::convert::Infallible;

use embedded_hal::digital::{self, OutputPin};
use embedded_hal::pwm::{self, SetDutyCycle};
use embedded_hal::spi::{self, Operation, SpiDevice};
use motion_control::limits::{Fault, Mode};
use on_host::board::{Devices, Law, Motion, N, detectors, gains, on_brake, plan};

/// An encoder whose frames are zero, a drive, a brake.
struct Device(bool);

impl spi::ErrorType for Device {
    type Error = Infallible;
}
impl SpiDevice for Device {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), Infallible> {
        for operation in operations {
            if let Operation::TransferInPlace(words) = operation {
                words.fill(0);
            }
        }
        Ok(())
    }
}
impl pwm::ErrorType for Device {
    type Error = Infallible;
}
impl SetDutyCycle for Device {
    fn max_duty_cycle(&self) -> u16 {
        8_400
    }
    fn set_duty_cycle(&mut self, _: u16) -> Result<(), Infallible> {
        Ok(())
    }
}
impl digital::ErrorType for Device {
    type Error = Infallible;
}
impl OutputPin for Device {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.0 = false;
        Ok(())
    }
    fn set_high(&mut self) -> Result<(), Infallible> {
        self.0 = true;
        Ok(())
    }
}

fn main() {
    let mut motion = Motion::REST;
    plan(&mut motion).expect("a motion");
    let devices = Devices {
        encoders: [const { Device(false) }; N],
        drives: [const { Device(false) }; N],
        brake: Device(true),
    };
    let control = on_brake(devices, gains(), detectors(&motion), &motion);
    let mut control = control.unwrap_or_else(|error| panic!("{error}"));
    for _ in 0..10 {
        let status = control.tick::<Law, _, _>(&motion, &()).status;
        assert_eq!(status.mode, Mode::Stopped);
    }
    control.reset(&motion).expect("at the start of its motion");
    let mut found = None;
    for tick in 0..motion.ticks() {
        let status = control.tick::<Law, _, _>(&motion, &()).status;
        if tick == 0 {
            assert_eq!(status.mode, Mode::Full);
        }
        found = found.or(status.fault);
    }
    assert!(matches!(found, Some(Fault::Frozen { .. })), "{found:?}");
    println!("good");
}
