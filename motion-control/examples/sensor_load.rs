//! The load and the offset of a force sensor between the wrist of a UR5e and its tool, and a
//! contact that the sensor shows while the arm moves.
//!
//! `cargo run -p motion-control --example sensor_load`

use dynamics_core::algorithms::Kinematics;
use dynamics_core::model::{OnBody, Robot};
use dynamics_core::spatial::{Force, Motion};
use dynamics_core::{Engine, glam::Vec3, robots::Ur5e, state::State};
use motion_control::estimate::{SensorLoad, SensorLoadError, SensorLoadFit};

const WRIST: usize = Ur5e::MODEL.body("wrist_3");
const GRAVITY: Vec3 = Vec3::new(0.0, 0.0, -9.81);

/// The wrench of a load on the wrist: f = I (a − g) + v ×* I v, in the frame of the wrist.
fn of_load(load: &SensorLoad<f32>, arm: &State<f32, 6, 6>) -> Force<f32> {
    let Kinematics { velocities: [v], accelerations: [a], .. } =
        Engine::<Ur5e>::kinematics_of(arm, &(), OnBody::<WRIST>);
    load.inertia().force(a - Motion::new(Vec3::ZERO, gravity(&arm.q)), v)
}

/// Gravity in the frame of the wrist, m/s².
fn gravity(q: &[f32; 6]) -> Vec3 {
    let [pose] = Engine::<Ur5e>::poses_of(q, OnBody::<WRIST>);
    pose.rot.transpose() * GRAVITY
}

fn main() -> Result<(), SensorLoadError> {
    // The load and the offset to be found, in place of a real sensor.
    let offset = Force::new(Vec3::new(0.2, -0.1, 0.0), Vec3::new(3.0, -2.0, 5.0));
    let tool = SensorLoad { mass: 1.2, first_moment: Vec3::new(0.01, 0.0, 0.1), offset };
    let shown = |arm: &State<f32, 6, 6>| of_load(&tool, arm) + tool.offset;

    let mut fit = SensorLoadFit::new();
    for wrist in [[-1.6, 0.0], [0.0, 1.6], [1.6, 0.0], [1.6, 1.6], [0.4, -1.6], [-0.8, 0.8]] {
        let at_rest = State::at([0.0, -1.2, 1.5, wrist[0], 0.3, wrist[1]]);
        fit.add(gravity(&at_rest.q), &shown(&at_rest));
    }
    let load = fit.load()?;
    println!("{:.3} kg, offset {:.2} N", load.mass, load.offset.lin);
    assert!((load.mass - tool.mass).abs() < 1e-3);

    // In a motion, what remains is the contact.
    let arm =
        State { qd: [0.5_f32; 6], qdd: [2.0; 6], ..State::at([0.0, -1.2, 1.5, 0.2, 0.3, 0.1]) };
    let pushed = shown(&arm) + Force::new(Vec3::ZERO, Vec3::new(0.0, 0.0, -7.0));
    let contact = pushed - (of_load(&load, &arm) + load.offset);
    println!("contact {:.2} N", contact.lin);
    assert!((contact.lin.z + 7.0).abs() < 1e-2);
    Ok(())
}
