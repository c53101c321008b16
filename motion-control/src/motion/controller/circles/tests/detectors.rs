//! Detectors at the seam.

use super::*;

#[test]
fn a_jump_is_measured_along_the_circle() {
    let rest = State::at([3.140_6, 0.0]);
    for (next, fault) in [
        (-3.140_6, None),
        (3.136, None),
        (-3.1, Some(Fault::Jump { joint: 0 })),
        (0.0, Some(Fault::Jump { joint: 0 })),
        (3.18 - 3.0 * TAU, Some(Fault::Jump { joint: 0 })),
        (3.1402 - 3.0 * TAU, None),
    ] {
        let mut bench = on_brake(FREE, [3.140_6, 0.0]);
        bench.controller.reset(&rest).expect("near");
        bench.tick(&rest);
        let measured = Ok(&[next, 0.0]);
        let command = bench.controller.tick(measured, &rest, |_, _| [0.0; 2]);
        assert_eq!(command.status.fault, fault, "{next}");
    }
}

#[test]
fn a_step_of_a_turn_of_a_circle_is_none() {
    fn faults<const C: u128>(
        mut steps: ReferenceStep<f32, 2, C>,
        q: [[f32; 2]; 3],
    ) -> [Option<Fault>; 3] {
        q.map(|q| steps.check(&State::at(q)).err())
    }
    let turn = [[3.140_6, 0.0], [3.141_3 - TAU, 0.0], [3.140_6, 0.0]];
    let steps = ReferenceStep::new([2e-3; 2]);
    let step = |joint| Some(Fault::Reference { joint });
    assert_eq!(faults(steps.on_circles::<WHEEL>(), turn), [None; 3]);
    assert_eq!(faults(steps, turn), [None, step(0), step(0)]);
    let slide = turn.map(|[q, _]| [0.0, q]);
    let moved = faults(steps.on_circles::<WHEEL>(), slide);
    assert_eq!(moved, [None, step(1), step(1)]);
    let real = [[3.140_6, 0.0], [-3.1, 0.0], [-3.1, 0.0]];
    let found = faults(steps.on_circles::<WHEEL>(), real);
    assert_eq!(found, [None, step(0), None]);
}

#[test]
fn a_joint_that_stops_on_the_seam_is_not_frozen() {
    fn run<const C: u128>(mut frozen: FrozenEncoder<f32, 2, C>, reference: f32) -> Option<Fault> {
        frozen.check(&[3.1, 0.0], &[3.1, 0.0]).ok();
        // It crosses, while the reference is of the turn before, and stays.
        let mut fault = None;
        for tick in 0..20 {
            let q = if tick < 2 { 3.141_58 } else { reference };
            fault = fault.or(frozen.check(&[-3.141_52, 0.0], &[q, 0.0]).err());
        }
        fault
    }
    let frozen = FrozenEncoder::new([0.01; 2], 4);
    assert_eq!(run(frozen.on_circles::<WHEEL>(), -3.1413), None);
    let fault = Some(Fault::Frozen { joint: 0 });
    assert_eq!(run(frozen, -3.1413), fault);
    assert_eq!(run(frozen.on_circles::<WHEEL>(), -3.12), fault);
}
