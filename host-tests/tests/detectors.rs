//! The detectors of the scene `ur5e` on its plant. The faults that each of them finds are tested
//! beside them, in `motion-control`.

use firmware_demo::plant::Rig;
use firmware_demo::scene::{Full, Noise, STEPS, Scene, TICK, simulated_loop};
use firmware_demo::scenes::ur5e::PickAndPlace;
use firmware_demo::sim_io::Wires;
use host_tests::everyday_or_full;
use motion_control::limits::Mode;

// It is watched from its first tick to the rest at its end.
#[test]
fn the_scene_has_no_false_alarm() {
    let path = PickAndPlace::reference().unwrap();
    let seeded = &mut Noise::seeded();
    let noises = [Some(seeded), None];
    for noise in noises.into_iter().take(everyday_or_full(1, 2)) {
        let wires: &'static Wires<6> = Box::leak(Box::default());
        let torque = PickAndPlace::LIMITS.map(|limit| limit.torque);
        let mut rig = Rig::new(PickAndPlace::plant(noise), torque, wires);
        let detectors = PickAndPlace::detectors();
        let control = simulated_loop::<PickAndPlace, _, 6, 6, 6, 6>(&path, wires, detectors);
        let mut control = control.unwrap();
        for tick in 0..path.ticks() + 500 {
            let status = control.tick::<Full<PickAndPlace, 6, 6, 6>, _, ()>(&path, &()).status;
            assert_eq!((status.mode, status.fault), (Mode::Full, None), "{tick}");
            rig.advance(wires, STEPS, TICK / STEPS as f32, |_| ()).unwrap();
        }
    }
}
