//! Every fault at random times in random combinations: limits of torque, rate, speed and energy
//! hold, every fault has the reaction of the contract, and the arm comes back. The table of
//! `docs/guide/src/faults.md` is of its first 400 runs.

use fixtures::faults::{
    HOLD, Kind, Observed, Pendulum, Plant, RIDE, Setup, TICK, Ur5eArm, Violation, at_speed,
    controller, one,
};
use motion_control::limits::{Fault, Mode, Reaction};
use motion_control::motion::{CurrentTick, MotionController};
use motion_control::reference::{Trajectory, WayPoint};
use motion_control::safety::StopCategory;

const RUNS: u32 = if cfg!(feature = "full") { 10_000 } else { 400 };

/// The observations of a run, or the limit that did not hold and its run.
fn observed(seed: u32, setup: Setup) -> Result<Vec<Observed>, String> {
    let mut observed = Vec::new();
    let (name, outcome) = one(seed, setup, |one| observed.push(one));
    let outcome = outcome.map_err(|what| format!("run {seed}, {name}: {what}"))?;
    assert!(outcome.injected > 0);
    Ok(observed)
}

/// The part of an observation that the contract does not allow.
fn against_contract(one: &Observed) -> Option<&'static str> {
    use Kind::{Encoder, External, Missed, NotFinite, NotReady, Range, Stale};
    if !one.whole || one.latency.is_none() {
        return None;
    }
    match (one.kind, one.kind.fault(0).reaction()) {
        // Each has a category of its own.
        (External, _) => (!one.held & !one.stopped).then_some("an external stop did not stop"),
        (Missed, _) => (!one.stopped).then_some("a restarted arm was not stopped"),
        // They are faults in each of their ticks.
        (NotFinite | Range | Encoder | Stale | NotReady, Reaction::RideThrough) => {
            let wanted = (one.ticks > RIDE, one.ticks > RIDE + HOLD);
            ((one.held, one.stopped) != wanted).then_some("not ridden through, held and stopped")
        }
        (_, Reaction::RideThrough) => None,
        (_, Reaction::ControlledStop) => (!one.held).then_some("not stopped under control"),
        (_, Reaction::TorqueOff) => (one.held | !one.stopped).then_some("not switched off at once"),
        _ => Some("no such reaction"),
    }
}

// No limit is exceeded, every reaction is that of the contract, and every arm recovers.
#[test]
fn injected_faults_keep_the_contract() {
    let mut failures = Vec::new();
    for seed in 0..RUNS {
        match observed(seed, Setup::SOUND) {
            Ok(of) => {
                let against = of.iter().filter_map(|one| Some((one, against_contract(one)?)));
                failures.extend(against.map(|(one, what)| format!("run {seed}: {what}: {one:?}")));
            }
            Err(failure) => failures.push(failure),
        }
    }
    let first: Vec<_> = failures.iter().take(12).cloned().collect();
    let (count, first) = (failures.len(), first.join("\n"));
    assert!(failures.is_empty(), "{count} failures in {RUNS} runs:\n{first}");
}

#[test]
fn each_kind_of_deviation_from_the_contract_is_found() {
    let bridged = |kind, ticks| Observed {
        kind,
        ticks,
        latency: Some(0),
        held: false,
        stopped: false,
        whole: true,
    };
    assert_eq!(against_contract(&bridged(Kind::Stale, RIDE)), None);
    let wrong = [
        bridged(Kind::Stale, RIDE + 1),
        bridged(Kind::External, 1),
        bridged(Kind::Missed, 1),
        bridged(Kind::Reference, 1),
        bridged(Kind::Drive, 1),
    ];
    for one in wrong {
        assert!(against_contract(&one).is_some(), "{one:?}");
        let unseen = Observed { latency: None, ..one };
        assert_eq!(against_contract(&unseen), None);
    }
    let held = Observed { held: true, stopped: true, ..bridged(Kind::Drive, 1) };
    assert!(against_contract(&held).is_some());
}

#[test]
fn a_supervisor_with_a_wrong_limit_is_found() {
    let wrong = Setup { limits: 1.5, ..Setup::SOUND };
    let found = (0..60).filter(|&seed| observed(seed, wrong).is_err()).count();
    assert!(found > 5, "{found}");
}

#[test]
fn without_the_watchdog_a_run_exceeds_a_rated_speed() {
    const RUN: u32 = 11552;
    let (_, outcome) = one(RUN, Setup::UNWATCHED, |_| ());
    assert!(matches!(outcome, Err(Violation::Speed { .. })), "{outcome:?}");
}

#[test]
fn a_speed_beyond_the_rated_one_is_found() {
    assert_eq!(at_speed::<Pendulum, 1>(0.99), Ok(()));
    for share in [1.01, -1.01, f32::NAN] {
        let found = at_speed::<Pendulum, 1>(share).expect_err("too fast");
        assert!(matches!(found, Violation::Speed { joint: 0, .. }), "{found}");
    }
}

#[test]
fn an_unknown_position_gets_no_torque_at_power_up() {
    let mut fresh = controller::<Ur5eArm, 6>(Setup::SOUND).on_brake();
    let rest = Trajectory::new(
        &[WayPoint { q: Ur5eArm::HOME, qd: [0.0; 6], ticks: 0 }],
        TICK,
        &[Ur5eArm::MOTION; 6],
    )
    .expect("a point");
    let silent = |controller: &mut MotionController<f32, 6, CurrentTick>| {
        for measured in [Err(Fault::Stale), Ok(&[f32::NAN; 6]), Ok(&[1e30; 6])] {
            let command = controller.tick(measured, &rest, |_, _| [9.0; 6]);
            assert_eq!((command.torque, command.brake), ([0.0; 6], true));
            assert_eq!(command.status.mode, Mode::Stopped);
            let _ = controller.reset(&rest);
            controller.stop_by(Fault::External, StopCategory::ControlledHold);
        }
    };
    silent(&mut fresh);
    silent(&mut controller::<Ur5eArm, 6>(Setup::SOUND));
}
