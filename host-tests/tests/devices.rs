//! Claims about the firmware's drivers and the wires of the simulated robot.

use dynamics_core::algorithms::NotPositiveDefinite;
use firmware_demo::drive::Scale;
use firmware_demo::encoder::{COUNTS, Encoder, RESOLUTION, quantise};
use firmware_demo::plant::{Rig, Simulated};
use firmware_demo::sim_io::Wires;

#[test]
fn a_duty_is_the_nearest_one() {
    // 50 of duty for 50 N·m either way: a count a newton metre.
    let scale = Scale::new(100, 50.0);
    for (torque, duty) in [
        (0.4, 50),
        (0.6, 51),
        (1.4, 51),
        (1.6, 52),
        (-0.4, 50),
        (-0.6, 49),
        (-1.4, 49),
        (-1.6, 48),
        (49.6, 100),
        (-49.6, 0),
    ] {
        assert_eq!(scale.duty(torque), duty, "{torque}");
    }
}

#[test]
fn an_angle_is_the_nearest_count_on_either_side_of_zero() {
    for count in [-8000_i16, -3, -1, 0, 1, 3, 8000] {
        for off in [-0.4, 0.0, 0.4] {
            let angle = (f32::from(count) + off) * RESOLUTION;
            let wanted = count.rem_euclid(COUNTS as i16) as u16;
            assert_eq!(quantise(angle), wanted, "{count} {off}");
        }
    }
}

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
    let mut encoder = Encoder::new(wires.encoder(0));
    let mut rig = Rig::new(Wound, [1.0], wires);
    let mut encoder_positions = || {
        encoder.start();
        encoder.read().unwrap()
    };
    assert!((encoder_positions() - 0.1).abs() <= 0.5001 * RESOLUTION);
    rig.advance(wires, 1, 1e-3, |_| ()).unwrap();
    assert!((encoder_positions() - 0.1).abs() <= 0.5001 * RESOLUTION);
}
