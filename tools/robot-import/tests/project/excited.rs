//! The robot of a project along the motion that shows its parameters, of which `arm` is the
//! library.

use arm::control::{FeedForward, controller, gains};
use arm::excitation::Excitation;
use arm::scene::{JOINTS, N, home, limits, motion};
use arm::simulation::{Plant, Wires};
use joint_drivers::ControlLoop;
use motion_control::{limits::Mode, reference::Reference};

#[test]
fn it_stays_at_its_reference() {
    let motion = motion().unwrap_or_else(|error| panic!("{error}"));
    let along = Excitation::new(&motion);
    let (home, full_scale) = (home(), limits(&motion).torque);
    let wires = Wires::new();
    let encoders = wires.encoders(&motion, &home).unwrap_or_else(|error| panic!("{error}"));
    let drives = wires.drives(&full_scale);
    let controller = controller(&motion).unwrap_or_else(|error| panic!("{error}"));
    let mut control =
        ControlLoop::on_circles(encoders, drives, wires.brake(), gains(), controller, ());
    let mut plant = Plant::new(home, full_scale);
    let mut most = [0.0_f32; N];
    for tick in 0..10_000 {
        let telemetry = control.tick::<FeedForward, _, _>(&along, &());
        assert!(telemetry.status.mode == Mode::Full, "tick {tick}: {:?}", telemetry.status);
        let reference = along.at(tick).q;
        for joint in 0..N {
            let error = (plant.state.q[joint] - reference[joint]).abs();
            most[joint] = most[joint].max(error);
        }
        plant.advance(&wires).unwrap_or_else(|error| panic!("{error}"));
    }
    for (name, most) in JOINTS.iter().zip(most) {
        assert!(most < 5e-3, "{name} was {most} rad or m from its reference");
    }
}
