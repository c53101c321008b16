//! The simulated robot of a scene with kinematic loops, under its control loop.

use dynamics_core::control::{Mode, Reference};
use dynamics_core::state::State;
use firmware_demo::plant::{Rig, Simulated};
use firmware_demo::scene::{Full, STEPS, Scene, TICK, simulated_loop};
use firmware_demo::scenes::parallel_ankle::AnkleSteps;
use firmware_demo::sim_io::Wires;

#[test]
fn the_motors_of_a_leg_with_rods_follow_their_reference() {
    let reference = AnkleSteps::reference().unwrap();
    let wires: &'static Wires<3> = Box::leak(Box::default());
    let torque = AnkleSteps::limits().map(|limit| limit.torque);
    let mut rig = Rig::new::<State<f32, 3, 3>>(AnkleSteps::plant(None), torque, wires);
    let control = simulated_loop::<AnkleSteps, _, 9, 9, 9, 3>(&reference, wires, ());
    let mut control = control.unwrap();
    let start = reference.at(0).q;
    let (mut error, mut moved) = (0.0_f32, 0.0_f32);
    for tick in 0..1500 {
        let environment = AnkleSteps::environment(&reference, tick as f32);
        let telemetry = control.tick::<Full<AnkleSteps, 9, 9, 9>, _, _>(&reference, &environment);
        assert_eq!(telemetry.status.mode, Mode::Full, "{tick}");
        let motors = Simulated::<State<f32, 3, 3>, 3>::encoder_positions(&rig.plant);
        for (motor, (wanted, start)) in motors.iter().zip(telemetry.reference.iter().zip(start)) {
            error = error.max((wanted - motor).abs());
            moved = moved.max((motor - start).abs());
        }
        let step = TICK / STEPS as f32;
        rig.advance(wires, STEPS, step, |_| environment).unwrap();
    }
    assert!(moved > 0.3 && error < 5e-3, "moved {moved}, error {error}");
}
