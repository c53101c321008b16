//! Claims about the wires of the simulated robot.

use dynamics_core::algorithms::NotPositiveDefinite;
use embedded_hal::spi::SpiDevice;
use firmware_demo::plant::{Rig, Simulated};
use firmware_demo::sim_io::Wires;
use joint_drivers::as5047p::{As5047p, RESOLUTION};
use joint_drivers::{JointMapping, JointRange};

/// A joint whose spring is wound: motor and link are elsewhere.
struct Wound;

impl Simulated<(), 1> for Wound {
    type Error = NotPositiveDefinite;

    fn encoder_positions(&self) -> [f32; 1] {
        [0.1]
    }
    fn actual(&self) -> [f32; 1] {
        [0.2]
    }
    fn step(&mut self, _: &[f32; 1], (): &(), _: f32) -> Result<(), NotPositiveDefinite> {
        Ok(())
    }
}

#[test]
fn encoders_measure_the_motors_not_the_joints() {
    let wires: &'static Wires<1> = Box::leak(Box::new(Wires::new()));
    let mapping = JointMapping::IDENTITY.with_range(JointRange::Continuous, 3e-3);
    let mut encoder = As5047p::new(wires.encoder(0), mapping.unwrap());
    let mut rig = Rig::new(Wound, [1.0], wires);
    let mut encoder_positions = || {
        encoder.start();
        encoder.read().unwrap()
    };
    assert!((encoder_positions() - 0.1).abs() <= 0.5001 * RESOLUTION);
    rig.advance(wires, 1, 1e-3, |_| ()).unwrap();
    assert!((encoder_positions() - 0.1).abs() <= 0.5001 * RESOLUTION);
}

/// The answer of an encoder to a frame, which it gives in the next one.
fn answer(spi: &mut impl SpiDevice, command: u16) -> u16 {
    let mut exchange = |command: u16| {
        let mut bytes = command.to_be_bytes();
        spi.transfer_in_place(&mut bytes).unwrap();
        u16::from_be_bytes(bytes)
    };
    exchange(command);
    exchange(0xffff)
}

#[test]
fn an_encoder_answers_the_register_of_the_frame_before() {
    const READ_ANGLE: u16 = 0xffff;
    const READ_ERRORS: u16 = 0x4001;
    let wires: &'static Wires<2> = Box::leak(Box::new(Wires::new()));
    // Two frames of even parity; the third has no encoder.
    wires.answer(&[0x1234 | 0x8000, 0x0003, 7]);
    let [mut first, mut second] = [wires.encoder(0), wires.encoder(1)];
    assert_eq!(answer(&mut first, READ_ANGLE), 0x9234);
    assert_eq!(answer(&mut second, READ_ANGLE), 0x0003);
    // Without an error its register is zero.
    assert_eq!(answer(&mut first, READ_ERRORS), 0);
    assert_eq!(answer(&mut first, READ_ANGLE), 0x9234);
}
