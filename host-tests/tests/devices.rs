//! A claim about the wires of the simulated robot.

use dynamics_core::algorithms::NotPositiveDefinite;
use firmware_demo::plant::{Rig, Simulated};
use firmware_demo::sim_io::Wires;
use joint_drivers::JointMapping;
use joint_drivers::as5047p::{As5047p, RESOLUTION};

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
fn encoders_sit_on_the_motors() {
    let wires: &'static Wires<1> = Box::leak(Box::new(Wires::new()));
    let mut encoder = As5047p::new(wires.encoder(0), JointMapping::IDENTITY);
    let mut rig = Rig::new(Wound, [1.0], wires);
    let mut encoder_positions = || {
        encoder.start();
        encoder.read().unwrap()
    };
    assert!((encoder_positions() - 0.1).abs() <= 0.5001 * RESOLUTION);
    rig.advance(wires, 1, 1e-3, |_| ()).unwrap();
    assert!((encoder_positions() - 0.1).abs() <= 0.5001 * RESOLUTION);
}
