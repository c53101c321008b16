//! Both signs of positions, steps, speeds and torques, where only one check can find them.

use super::*;
use crate::safety::StopCategory;

fn fault_at(supervisor: &mut Supervisor<f32, 2>, q: [f32; 2]) -> Option<Fault> {
    supervisor.accept_positions(&q);
    let accepted = supervisor.measurement_accepted();
    let fault = supervisor.gate(&[0.0; 2], &[0.0; 2]).status.fault;
    assert_eq!(accepted, fault.is_none(), "{q:?}");
    fault
}

#[test]
fn a_position_jumps_in_either_direction() {
    // Twice 2 rad/s for a tick are 0.04 rad.
    for (step, joint) in [
        ([0.041, 0.0], 0),
        ([-0.041, 0.0], 0),
        ([0.0, 0.041], 1),
        ([0.0, -0.041], 1),
        ([-0.041, 0.041], 0),
    ] {
        let mut arm = riding(3);
        assert_eq!(fault_at(&mut arm, [0.5, -0.5]), None);
        let q = [0.5 + step[0], -0.5 + step[1]];
        let fault = Some(Fault::Jump { joint });
        assert_eq!(fault_at(&mut arm, q), fault, "{step:?}");
        // In two ticks it may have moved as far.
        assert_eq!(fault_at(&mut arm, q), None, "{step:?}");
    }
}

#[test]
fn a_resolution_is_added_to_the_step() {
    for resolution in [0.0, 0.5, -0.5, f32::NAN] {
        let mut arm = Supervisor::new(SupervisorConfig { resolution, ..CONFIG });
        fault_at(&mut arm, [0.0; 2]);
        let counted = resolution == 0.5;
        for q in [[0.3, 0.0], [0.0, -0.3]] {
            let mut arm = arm;
            assert_eq!(fault_at(&mut arm, q).is_none(), counted, "{resolution}");
        }
    }
}

#[test]
fn positions_without_limits_are_within_ten_thousand() {
    let with = |lower: f32, upper: f32| {
        let limits = SafetyLimits { lower: [-1.0, lower], upper: [1.0, upper], ..LIMITS };
        Supervisor::new(SupervisorConfig { limits, ..CONFIG })
    };
    let (far, none) = (1e4, f32::INFINITY);
    for (lower, upper, least, greatest) in [
        (-none, none, -far, far),
        (-none, 2.0, -far, 2.0),
        (-3.0, none, -3.0, far),
        (-2e4, 2e4, -far, far),
        (-none, -500.0, -far, -500.0),
    ] {
        let mut arm = with(lower, upper);
        for q in [least - 0.001 * least.abs(), greatest + 0.001 * greatest.abs()] {
            let fault = Some(Fault::Position { joint: 1 });
            assert_eq!(fault_at(&mut arm, [0.0, q]), fault, "{lower} {upper}: {q}");
            arm.reset();
        }
        for q in [least, greatest] {
            assert_eq!(fault_at(&mut arm, [0.0, q]), None, "{lower} {upper}: {q}");
            arm.reset();
        }
    }
}

#[test]
fn a_speed_of_either_sign_is_too_fast() {
    for (qd, joint) in [
        ([2.01, 0.0], 0),
        ([-2.01, 0.0], 0),
        ([0.0, 2.01], 1),
        ([0.0, -2.01], 1),
        ([-2.01, f32::NAN], 0),
        ([0.0, f32::NAN], 1),
    ] {
        let mut arm = riding(3);
        arm.accept_positions(&[0.0; 2]);
        // It has no ride-through.
        assert_eq!(arm.check_speed(&qd), Mode::Hold, "{qd:?}");
        let fault = Some(Fault::Speed { joint });
        assert_eq!(arm.gate(&[0.0; 2], &qd).status.fault, fault);
    }
    let mut arm = supervisor();
    arm.accept_positions(&[0.0; 2]);
    assert_eq!(arm.check_speed(&[2.0, -2.0]), Mode::Full);
}

#[test]
fn torques_of_both_signs_have_both_limits() {
    // 10 and 5 N·m, and 4 N·m a tick.
    for sign in [1.0, -1.0] {
        let mut arm = supervisor();
        let mut torque = |wanted: [f32; 2]| {
            let command = good(&mut arm, wanted.map(|torque| sign * torque));
            (command.torque.map(|torque| sign * torque), command.status.limited)
        };
        assert_eq!(torque([3.0, -3.0]), ([3.0, -3.0], false));
        assert_eq!(torque([7.0, -7.0]), ([7.0, -5.0], true));
        assert_eq!(torque([12.0, 0.0]), ([10.0, -1.0], true));
        assert_eq!(torque([5.0, 3.0]), ([6.0, 3.0], true));
        assert_eq!(torque([2.0, 5.0]), ([2.0, 5.0], false));
    }
}

#[test]
fn a_small_damping_lowers_an_arm_too() {
    let damping = [0.5, 0.25];
    let mut arm = supervisor().with_stop(StopCategory::DampedLowering { damping });
    good(&mut arm, [0.0; 2]);
    arm.stop(Fault::External);
    let q = arm.last_good;
    arm.accept_positions(&q);
    assert_eq!(arm.gate(&[0.0; 2], &[-2.0, 1.0]).torque, [1.0, -0.25]);
}
