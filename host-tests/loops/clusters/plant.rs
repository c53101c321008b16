//! The simulated robot of a scene with kinematic loops, under its control loop.

use std::cell::RefCell;
use std::rc::Rc;

use dynamics_core::effects::{Effect, JointState};
use dynamics_core::model::Calibrated;
use dynamics_core::state::State;
use firmware_demo::plant::{ClusterPlant, Rig, Simulated};
use firmware_demo::scene::{Full, STEPS, Scene, TICK, simulated_loop};
use firmware_demo::scenes::parallel_ankle::AnkleSteps;
use firmware_demo::sim_io::Wires;
use motion_control::{limits::Mode, reference::Reference};

#[test]
fn the_motors_of_a_leg_with_rods_follow_their_reference() {
    let reference = AnkleSteps::reference().unwrap();
    let wires: &'static Wires<3> = Box::leak(Box::default());
    let torque = AnkleSteps::LIMITS.map(|limit| limit.torque);
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

/// Records which joints an internal state is advanced for.
#[derive(Clone)]
struct Recorder(Rc<RefCell<Vec<usize>>>);

impl Effect<f32, 9, 9> for Recorder {
    fn torque(&self, _: usize, _: JointState<f32>, _: &mut f32) {}

    fn advance(&mut self, joint: usize, _: JointState<f32>, _: f32) {
        self.0.borrow_mut().push(joint);
    }
}

#[test]
fn a_step_advances_the_internal_states_of_all_joints() {
    let joints = Rc::new(RefCell::new(Vec::new()));
    let effects = (AnkleSteps::EFFECTS, Recorder(joints.clone()));
    let start = AnkleSteps::reference().unwrap().at(0).q;
    let mut plant = ClusterPlant::<<AnkleSteps as Scene<9, 9, 9, 3>>::Robot, _, 9, 9, 3>::new(
        Calibrated::nominal(),
        effects,
        start,
    );
    // The environment does not matter to this plant.
    Simulated::step(&mut plant, &[0.0; 3], &(), 1e-4).unwrap();
    assert_eq!(*joints.borrow(), [0, 1, 2, 3, 4, 5, 6, 7, 8]);
}
