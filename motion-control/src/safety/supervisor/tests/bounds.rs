//! Values that are exactly at a bound, ranges that are not centred on zero, and the configuration.

use super::*;

/// Ranges whose middles are not zero, and a speed whose double is not its sum with two.
const OFFSET: SupervisorConfig<f32, 2> = SupervisorConfig {
    limits: SafetyLimits { speed: [3.0, 3.0], lower: [-1.0, 0.5], upper: [0.5, 1.0], ..LIMITS },
    ..CONFIG
};
/// Twice the greatest speed for a tick.
const STEP: f32 = 2.0 * 3.0 * TICK;

/// A supervisor that has accepted these positions.
fn at(q: [f32; 2]) -> Supervisor<f32, 2> {
    let mut supervisor = Supervisor::new(OFFSET);
    assert_eq!(supervisor.accept_measurement(Ok(&q)), Mode::Full);
    supervisor.gate(&[0.0; 2], &[0.0; 2]);
    supervisor
}

fn fault_at(mut supervisor: Supervisor<f32, 2>, q: [f32; 2]) -> Option<Fault> {
    supervisor.accept_measurement(Ok(&q));
    supervisor.gate(&[0.0; 2], &[0.0; 2]).status.fault
}

#[test]
fn positions_at_their_bounds_are_within_them() {
    for q in [[-1.0, 0.5], [0.5, 1.0]] {
        let supervisor = at(q);
        assert!(supervisor.measurement_accepted());
        assert_eq!(supervisor.outside(&q), None);
    }
    let supervisor = Supervisor::new(OFFSET);
    for none in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let fault = Some(Fault::NotFinite { joint: 1 });
        assert_eq!(fault_at(supervisor, [0.0, none]), fault, "{none}");
    }
    for (q, joint) in [([0.51, 0.7], 0), ([-1.01, 0.7], 0), ([0.0, 0.49], 1), ([0.0, 1.01], 1)] {
        assert_eq!(supervisor.outside(&q), Some(joint), "{q:?}");
        assert_eq!(fault_at(supervisor, q), Some(Fault::Position { joint }));
        assert_eq!(fault_at(at([0.0, 0.7]), q), Some(Fault::Position { joint }));
    }
}

#[test]
fn replaced_bounds_are_restored_to_the_bit() {
    let before = at([0.0, 0.7]);
    assert_eq!(before.bounds(), [[-1.0, 0.5], [0.5, 1.0]]);
    let mut supervisor = before;
    let other = [[-0.1, 0.3], [0.6, 0.9]];
    let ranges = supervisor.replace_bounds(&other);
    for (bounds, other) in supervisor.bounds().as_flattened().iter().zip(other.as_flattened()) {
        assert!((bounds - other).abs() < 1e-6, "{bounds} {other}");
    }
    supervisor.restore_bounds(ranges);
    assert_eq!(supervisor, before);
}

#[test]
fn a_jump_beside_a_joint_at_its_bound_is_named() {
    let joint = 1;
    let jump = Some(Fault::Jump { joint });
    assert_eq!(fault_at(at([-1.0, 0.5]), [-1.0, 0.9]), jump);
    assert_eq!(fault_at(at([0.5, 0.5]), [0.5, 0.9]), jump);
    // The first joint moves as far as it may.
    assert_eq!(fault_at(at([0.0, 0.5]), [STEP, 0.9]), jump);
    let mut supervisor = at([0.0, 0.5]);
    supervisor.missed(2);
    assert_eq!(fault_at(supervisor, [3.0 * STEP, 0.9]), jump);
    // And where it is far from zero.
    assert_eq!(fault_at(at([-0.9, 0.5]), [-0.9, 0.9]), jump);
}

#[test]
fn the_plausible_step_is_twice_the_greatest_speed() {
    let supervisor = at([0.0, 0.7]);
    assert_eq!(*supervisor.plausible_step(), [STEP; 2]);
    assert_eq!(fault_at(supervisor, [STEP, 0.7]), None);
    let jump = Some(Fault::Jump { joint: 0 });
    assert_eq!(fault_at(supervisor, [1.01 * STEP, 0.7]), jump);
}

#[test]
fn a_torque_as_large_as_the_type_allows_is_limited() {
    let mut supervisor = at([0.0, 0.7]);
    let q = supervisor.last_good;
    supervisor.accept_measurement(Ok(&q));
    let command = supervisor.gate(&[f32::MAX, -f32::MAX], &[0.0; 2]);
    assert_eq!(command.torque, [4.0, -4.0]);
    let status = command.status;
    assert_eq!((status.fault, status.limited), (None, true));
}

#[test]
fn an_arm_at_the_slowest_speed_is_at_rest() {
    let supervisor = at([0.0, 0.7]);
    let slowest = 1e-2 * 3.0 + 1e-3;
    assert!(supervisor.at_rest(&[slowest, -slowest]));
    let fast = 1.01 * slowest;
    for qd in [[0.0, fast], [-fast, 0.0], [0.0, f32::NAN]] {
        assert!(!supervisor.at_rest(&qd), "{qd:?}");
    }
}

#[test]
fn every_joint_of_a_sinking_arm_moves_plausibly() {
    let damping = [1.0; 2];
    let stop = crate::safety::StopCategory::DampedLowering { damping };
    // The category also counts for an arm that is stopped already.
    let sinking = Supervisor::new(OFFSET).on_brake().with_stop(stop);
    assert!(sinking.lowers(&[0.0; 2], &[STEP, -STEP]));
    assert!(!sinking.lowers(&[0.0; 2], &[0.0, 1.01 * STEP]));
    assert!(!at([0.0, 0.7]).lowers(&[0.0; 2], &[0.0; 2]));
}

#[test]
fn a_tick_that_is_not_a_positive_time_is_refused() {
    for tick in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let refused = SupervisorConfig { tick, ..CONFIG }.check();
        let parameter = ConfigParameter::Tick;
        assert_eq!(refused, Err(ConfigError::OutOfRange { parameter }));
    }
}

#[test]
fn the_greatest_number_of_reentry_ticks_can_be_counted() {
    let reentry_ticks = u32::MAX;
    let mut supervisor = Supervisor::new(SupervisorConfig { reentry_ticks, ..CONFIG });
    for _ in 0..3 {
        let command = good(&mut supervisor, [0.0; 2]);
        assert_eq!(command.status.mode, Mode::Full);
    }
    assert_eq!(supervisor.authority(), 1.0);
}

#[test]
fn a_torque_that_is_none_repeats_none_above_the_limit_of_its_tick() {
    let mut supervisor = at([0.0, 0.7]);
    let tick = |supervisor: &mut Supervisor<f32, 2>, tau: [f32; 2]| {
        supervisor.accept_measurement(Ok(&[0.0, 0.7]));
        supervisor.gate(&tau, &[0.0; 2]).torque
    };
    let most = LIMITS.torque;
    let last = (0..1000).map(|_| tick(&mut supervisor, most)).last();
    assert_eq!(last, Some(most));
    let less = most.map(|torque| torque - 0.5 * LIMITS.rate[0]);
    supervisor.limit_torques(&less);
    assert_eq!(tick(&mut supervisor, [f32::NAN; 2]), less);
    // A limit that is no number allows no torque.
    supervisor.limit_torques(&[f32::NAN, 0.0]);
    assert_eq!(supervisor.torque_limit(), &[0.0; 2]);
}
