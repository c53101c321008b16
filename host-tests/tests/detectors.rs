//! Claims about the control loop with its detectors, on the plant of the scene `ur5e`.

use std::cell::Cell;

use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use firmware_demo::plant::{Plant, Rig};
use firmware_demo::scene::{Full, Noise, STEPS, Scene, SimLoop, TICK, simulated_loop};
use firmware_demo::scenes::ur5e::{Effects, PickAndPlace};
use firmware_demo::sim_io::Wires;
use host_tests::everyday_or_full;
use joint_drivers::Law;
use motion_control::{
    Command, Detect, Detectors, Fault, Mode, Reference, Status, StopCategory, Trajectory,
};

type Path = Trajectory<f32, 6, 9>;
type FullModel = Full<PickAndPlace, 6, 6, 6>;

/// A moment of fast motion.
const FAST: u32 = 3200;

struct Arm {
    wires: &'static Wires<6>,
    rig: Rig<Plant<Ur5e, Effects, (), 6, 6, 6>, 6>,
    control: SimLoop<6, Detectors<f32, 6>>,
}

impl Arm {
    fn new(path: &Path, noise: Option<&mut Noise>) -> Self {
        let wires: &'static Wires<6> = Box::leak(Box::default());
        let torque = PickAndPlace::limits().map(|limit| limit.torque);
        let rig = Rig::new(PickAndPlace::plant(noise), torque, wires);
        let detectors = PickAndPlace::detectors();
        let control = simulated_loop::<PickAndPlace, _, 6, 6, 6, 6>(path, wires, detectors);
        let control = control.unwrap();
        Self {
            wires,
            rig,
            control,
        }
    }

    /// A tick of the firmware alone: the encoders keep what they show.
    fn tick<L: Law<6>>(&mut self, reference: &impl Reference<f32, 6>) -> Status {
        self.control.tick::<L, _, ()>(reference, &()).status
    }

    /// A tick of the firmware and of the plant.
    fn run<L: Law<6>>(&mut self, reference: &impl Reference<f32, 6>) -> Status {
        let status = self.tick::<L>(reference);
        let step = TICK / STEPS as f32;
        self.rig.advance(self.wires, STEPS, step, |_| ()).unwrap();
        status
    }
}

/// A path that is elsewhere from a moment on.
struct Stepping<'a>(&'a Path);

impl Reference<f32, 6> for Stepping<'_> {
    fn at(&self, tick: u32) -> State<f32, 6, 6> {
        let mut state = self.0.at(tick);
        if tick >= FAST {
            state.q[4] += 0.1;
        }
        state
    }
    fn ticks(&self) -> u32 {
        self.0.ticks()
    }
}

/// A law that commands more than any limit.
struct Excessive;

impl Law<6> for Excessive {
    fn feedforward(_: &State<f32, 6, 6>, (): &()) -> [f32; 6] {
        [0.0, 0.0, 0.0, 1e6, 0.0, 0.0]
    }
}

// It is watched from its first tick to the rest at its end.
#[test]
fn the_scene_has_no_false_alarm() {
    let path = PickAndPlace::reference().unwrap();
    let seeded = &mut Noise::seeded();
    let noises = [Some(seeded), None];
    for noise in noises.into_iter().take(everyday_or_full(1, 2)) {
        let mut arm = Arm::new(&path, noise);
        for tick in 0..path.ticks() + 500 {
            let status = arm.run::<FullModel>(&path);
            assert_eq!((status.mode, status.fault), (Mode::Full, None), "{tick}");
        }
    }
}

#[test]
fn encoders_that_freeze_in_motion_are_found() {
    let path = PickAndPlace::reference().unwrap();
    let mut arm = Arm::new(&path, None);
    for _ in 0..FAST {
        assert_eq!(arm.run::<FullModel>(&path).fault, None);
    }
    let faults = (0..20).find_map(|_| arm.tick::<FullModel>(&path).fault);
    assert!(matches!(faults, Some(Fault::Frozen { .. })), "{faults:?}");
}

#[test]
fn a_reference_step_stops_the_arm_and_names_the_joint() {
    let path = PickAndPlace::reference().unwrap();
    let mut arm = Arm::new(&path, None);
    for _ in 0..FAST {
        assert_eq!(arm.run::<FullModel>(&Stepping(&path)).fault, None);
    }
    let status = arm.run::<FullModel>(&Stepping(&path));
    let fault = Some(Fault::Reference { joint: 4 });
    assert_eq!((status.mode, status.fault), (Mode::Hold, fault));
}

#[test]
fn a_saturated_torque_stops_the_arm_and_names_the_joint() {
    let path = PickAndPlace::reference().unwrap();
    let mut arm = Arm::new(&path, None);
    // The encoders stand still: no speed limit is exceeded first.
    let found = (0..200).find_map(|_| {
        let status = arm.tick::<Excessive>(&path);
        (status.mode == Mode::Stopped).then_some(status.fault)
    });
    assert_eq!(found, Some(Some(Fault::Saturated { joint: 3 })));
}

/// A detector that finds nothing, and counts how often it was restarted.
struct Restarts<'a>(&'a Cell<u32>);

impl Detect<f32, 6> for Restarts<'_> {
    fn measured(&mut self, _: &[f32; 6], _: &[f32; 6]) -> Result<(), Fault> {
        Ok(())
    }
    fn referenced(&mut self, _: &State<f32, 6, 6>, _: Mode) -> Result<(), Fault> {
        Ok(())
    }
    fn commanded(&mut self, _: &Command<f32, 6>) -> Result<(), Fault> {
        Ok(())
    }
    fn restart(&mut self) {
        self.0.set(self.0.get() + 1);
    }
}

#[test]
fn a_reset_restarts_the_detectors() {
    let (path, count) = (PickAndPlace::reference().unwrap(), Cell::new(0));
    let wires: &'static Wires<6> = Box::leak(Box::default());
    let torque = PickAndPlace::limits().map(|limit| limit.torque);
    let _rig = Rig::new(PickAndPlace::plant(None), torque, wires);
    let control = simulated_loop::<PickAndPlace, _, 6, 6, 6, 6>(&path, wires, Restarts(&count));
    let mut control = control.unwrap();
    control.tick::<FullModel, _, ()>(&path, &());
    control.stop_by(Fault::External, StopCategory::TorqueOff);
    let status = control.tick::<FullModel, _, ()>(&path, &()).status;
    assert_eq!((status.mode, count.get()), (Mode::Stopped, 0));
    control.reset(&path).unwrap();
    assert_eq!(count.get(), 1);
}
