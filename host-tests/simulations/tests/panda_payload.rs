//! The scene `panda_payload`'s load.

use dynamics_core::effects::Payload;
use firmware_demo::scene::Scene;
use firmware_demo::scenes::panda_payload::{Carry, HAND, part};
use motion_control::reference::Reference;

/// An impossible one would be left on the table, and nothing be shown.
#[test]
fn the_part_is_possible_and_carried_between_grips() {
    let part = part().expect("a body like that");
    let job = Carry::reference().expect("within the limits");
    let mut rest: Vec<(u32, f32)> = Vec::new();
    for tick in 0..=job.ticks() {
        let held = Carry::environment(&job, tick as f32);
        assert!((0.0..=part.0.mass).contains(&held.0.mass));
        // It comes and goes while the arm stands.
        let partly = held != part && held != Payload::<_, HAND>::default();
        assert!(!partly || job.at(tick).qd == [0.0; 7], "{tick}");
        if rest.last().is_none_or(|&(_, mass)| mass != held.0.mass) && !partly {
            rest.push((tick, held.0.mass));
        }
    }
    let masses: Vec<f32> = rest.iter().map(|&(_, mass)| mass).collect();
    assert_eq!(masses, [0.0, 2.0, 0.0]);
}
