//! Every fault at random times in random combinations: limits of torque, rate, speed and energy hold, the arm comes
//! back, and the table of `docs/guide/src/faults.md` is what was observed. `FAULTS_WRITE=1` writes the table.

#[path = "fault_injection/arm.rs"]
mod arm;
#[path = "fault_injection/kinds.rs"]
mod kinds;
#[path = "fault_injection/plants.rs"]
mod plants;
#[path = "fault_injection/run.rs"]
mod run;

use arm::controller;
use dynamics_core::control::{CurrentTick, Fault, Mode, MotionController, StopCategory};
use kinds::Kind;
use plants::{Pendulum, Plant, Ur5eArm};
use run::{Observed, at_speed, run};

/// Runs of the table, which every run of this test has.
const TABLE: u32 = 400;
const RUNS: u32 = if cfg!(feature = "full") {
    10_000
} else {
    TABLE
};
/// One run of so many is a UR5e, whose dynamics take longer.
const UR5E: u32 = 8;
const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/guide/src/faults.md");
const BEGIN: &str = "<!-- faults:begin -->\n";
const END: &str = "<!-- faults:end -->\n";

fn one(seed: u32, broken: f32) -> Result<Vec<Observed>, String> {
    let (name, observed) = if seed.is_multiple_of(UR5E) {
        (Ur5eArm::NAME, run::<Ur5eArm, 6>(seed, broken))
    } else {
        (Pendulum::NAME, run::<Pendulum, 1>(seed, broken))
    };
    observed.map_err(|what| format!("run {seed}, {name}, {what}"))
}

/// A row of the table.
fn row(kind: Kind, observed: &[Observed]) -> String {
    let of: Vec<&Observed> = observed.iter().filter(|one| one.kind == kind).collect();
    let latencies = || of.iter().filter_map(|one| one.latency);
    let count = |what: fn(&Observed) -> bool| of.iter().filter(|one| what(one)).count();
    let latency = match (latencies().min(), latencies().max()) {
        (Some(least), Some(most)) if least == most => format!("{least}"),
        (Some(least), Some(most)) => format!("{least} to {most}"),
        _ => "none".to_owned(),
    };
    let [fault, detection, report] = kind.words();
    let bridged = count(|one| !one.held & !one.stopped);
    let held = count(|one| one.held & !one.stopped);
    let stopped = count(|one| one.stopped);
    let (all, reported) = (of.len(), latencies().count());
    format!(
        "| {fault} | {detection} | {report} | {all} | {reported} | {latency} | {bridged} | {held} | {stopped} |\n"
    )
}

fn table(observed: &[Observed]) -> String {
    let head = "| fault | detected by | reported as | injected | reported | latency, ticks | bridged | held | stopped |\n\
        |---|---|---|---:|---:|---:|---:|---:|---:|\n";
    let rows: String = Kind::ALL.iter().map(|&kind| row(kind, observed)).collect();
    format!(
        "<!-- written by host-tests/tests/fault_injection.rs with FAULTS_WRITE=1: do not edit -->\n\n{head}{rows}\n"
    )
}

#[test]
fn no_limit_is_exceeded_and_every_arm_recovers() {
    let (mut observed, mut failures) = (Vec::new(), Vec::new());
    for seed in 0..RUNS {
        match one(seed, 1.0) {
            Ok(of) if seed < TABLE => observed.extend(of),
            Ok(_) => {}
            Err(failure) => failures.push(failure),
        }
    }
    let first = failures
        .iter()
        .take(12)
        .cloned()
        .collect::<Vec<_>>()
        .join("\n");
    assert!(
        failures.is_empty(),
        "{} of {RUNS} runs:\n{first}",
        failures.len()
    );
    let page = std::fs::read_to_string(PAGE).expect("the page of the guide");
    let (before, rest) = page.split_once(BEGIN).expect("the begin marker");
    let (written, after) = rest.split_once(END).expect("the end marker");
    let fresh = table(&observed);
    if std::env::var_os("FAULTS_WRITE").is_some() {
        std::fs::write(PAGE, format!("{before}{BEGIN}{fresh}{END}{after}")).expect("written");
    } else {
        assert_eq!(
            written, fresh,
            "the table is not what was observed: FAULTS_WRITE=1 writes it"
        );
    }
}

#[test]
fn a_supervisor_with_a_wrong_limit_is_found() {
    let found = (0..60).filter(|&seed| one(seed, 1.5).is_err()).count();
    assert!(found > 5, "{found}");
}

#[test]
fn a_speed_beyond_the_rated_one_is_found() {
    assert_eq!(at_speed::<Pendulum, 1>(0.99), Ok(()));
    for share in [1.01, -1.01, f32::NAN] {
        let found = at_speed::<Pendulum, 1>(share).expect_err("too fast");
        assert!(found.starts_with("speed"), "{found}");
    }
}

#[test]
fn an_arm_of_unknown_position_gets_no_torque_at_power_up() {
    let mut fresh = controller::<Ur5eArm, 6>(1.0).on_brake();
    let rest = dynamics_core::control::Trajectory::new(
        &[dynamics_core::control::WayPoint {
            q: Ur5eArm::HOME,
            qd: [0.0; 6],
            ticks: 0,
        }],
        plants::TICK,
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
    silent(&mut controller::<Ur5eArm, 6>(1.0));
}
