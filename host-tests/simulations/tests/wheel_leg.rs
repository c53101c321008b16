//! Claims about the scene `wheel_leg_balance`: it does not fall within its envelope, and beyond it
//! the supervisor lowers it.

use firmware_demo::scene::{Batch, Less, PlantModel};
use firmware_demo::scenes::wheel_leg_balance::trial::{Outcome, Push, Ride};
use firmware_demo::scenes::wheel_leg_balance::{
    Balance, GRAVITY, Order, Pitch, SCHEDULE, TRACTION_LIMIT,
};
use host_tests::everyday_or_full;
use motion_control::law::TablePlace;
use motion_control::limits::{Fault, Mode};

/// The number of runs. The claim is that of a thousand, which `BALANCE_RUNS=1000` asks for.
fn runs() -> u32 {
    let named = std::env::var("BALANCE_RUNS");
    named.map_or(everyday_or_full(100, 200), |runs| runs.parse().expect("BALANCE_RUNS is a number"))
}
/// The runs with harder pushes.
const PUSHED: u32 = 50;

/// The largest pitch of a robot that is lowered, rad; the speed at which its skids meet the ground,
/// m/s; and of everything at rest, m/s and rad/s.
const LOWERED: [f32; 3] = [0.8, 2.0, 0.2];

/// The outcomes of some runs, on all cores; a robot without forward dynamics has fallen.
fn outcomes(runs: u32, trial: impl Fn(u32) -> Ride + Sync) -> Vec<(u32, Outcome)> {
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get() as u32);
    let run = |seed| (seed, trial(seed).run(|_, _| ()).unwrap_or_default());
    std::thread::scope(|scope| {
        let parts: Vec<_> = (0..threads)
            .map(|part| (part..runs).step_by(threads as usize))
            .map(|seeds| scope.spawn(move || seeds.map(run).collect::<Vec<_>>()))
            .collect();
        parts.into_iter().flat_map(|part| part.join().expect("no panic")).collect()
    })
}

fn fallen(all: &[(u32, Outcome)]) -> Vec<u32> {
    all.iter().filter(|(_, out)| !out.stands()).map(|(seed, _)| *seed).collect()
}

/// It has sat down, and lies upright and at rest, without torque.
fn lowered(out: &Outcome) -> bool {
    let [pitch, impact, rest] = LOWERED;
    let stopped = out.status.is_some_and(|status| status.mode == Mode::Stopped);
    let upright = out.pitch < pitch && out.impact < impact;
    out.sat && stopped && upright && out.rest[1] < rest && out.torque < 1.0
}

#[test]
fn no_robot_falls_within_the_envelope() {
    let runs = runs();
    let fallen = fallen(&outcomes(runs, |seed| Ride::drawn(seed, Less::NOTHING)));
    assert!(fallen.is_empty(), "{} of {runs} have fallen: {fallen:?}", fallen.len());
}

#[test]
fn wheels_that_spin_up_in_the_air_make_robots_fall() {
    let fallen = fallen(&outcomes(40, |seed| Ride::drawn(seed, TRACTION_LIMIT)));
    assert!(!fallen.is_empty(), "the limit of traction is worth nothing");
}

#[test]
fn beyond_the_envelope_the_supervisor_lowers_it() {
    let all = outcomes(PUSHED, |seed| Ride::pushed(seed, 4.0));
    let mut sat = 0;
    for (seed, out) in &all {
        assert!(out.stands() || lowered(out), "run {seed}: {out:?}");
        sat += u32::from(lowered(out));
    }
    assert!(sat > PUSHED / 10, "{sat} of {PUSHED} were lowered: the pushes are not beyond it");
    // Nor is every fall a lowering: harder pushes turn some over.
    let over = outcomes(20, |seed| Ride::pushed(seed, 8.0));
    assert!(over.iter().any(|(_, out)| !out.stands() && !lowered(out)));
}

#[test]
fn the_scene_is_driven_to_its_end_and_its_parts_are_worth_it() {
    let run =
        |less| Ride::of_scene(less, PlantModel::Exact).run(|_, _| ()).expect("forward dynamics");
    let [all, gravity, traction] = [Less::NOTHING, GRAVITY, TRACTION_LIMIT].map(run);
    assert!(all.stands() && all.way > 1.5, "{all:?}");
    assert!(gravity.rms > 1.01 * all.rms && !traction.stands(), "{gravity:?} {traction:?}");
}

/// Whether each of six robots stands after a push forward in N, on legs of this length in m.
fn stand(less: Less, length: f32, push: f32) -> bool {
    let all = outcomes(6, |seed| {
        let mut trial =
            Ride { kerb: [100.0, 0.0], heading: 0.0, ticks: 1200, ..Ride::drawn(seed, less) };
        trial.course = [(0, Order { length, ..Order::STAND }); 8];
        trial.pushes = [[push, 0.0], [0.0; 2]].map(|force| Push { tick: 500, force });
        trial
    });
    fallen(&all).is_empty()
}

/// The gains of standing hold the shortest legs against harder pushes than their own do.
#[test]
fn the_schedule_is_worth_it_on_long_legs_and_not_on_short_ones() {
    assert!(stand(Less::NOTHING, 0.34, 105.0) && !stand(SCHEDULE, 0.34, 105.0));
    assert!(!stand(Less::NOTHING, 0.14, 105.0) && stand(SCHEDULE, 0.14, 105.0));
}

#[test]
fn a_lost_sensor_ends_in_a_lowering_without_a_number_that_is_none() {
    for (measured, pitch) in [(true, f32::NAN), (false, 0.0)] {
        let mut balance = Balance::new(Less::NOTHING).expect("limits");
        let q = balance.standing();
        let order = Order::STAND;
        let full = balance.tick(Ok(&q), &Pitch::default(), &order);
        assert_eq!(full.status.mode, Mode::Full);
        let mut last = full;
        for _ in 0..20 {
            let measured = if measured { Ok(&q) } else { Err(Fault::Encoder { joint: 2 }) };
            last = balance.tick(measured, &Pitch { angle: pitch, rate: 0.0 }, &order);
            assert!(last.torque.iter().all(|torque| torque.is_finite()), "{last:?}");
        }
        assert!(last.status.mode == Mode::Stopped && balance.sits(), "{last:?}");
    }
}

#[test]
fn a_length_beyond_the_table_is_flagged() {
    let mut balance = Balance::new(Less::NOTHING).expect("limits");
    let q = balance.standing();
    for (length, place) in [(0.3, TablePlace::Within), (0.5, TablePlace::Above)] {
        for _ in 0..400 {
            let order = Order { length, ..Order::STAND };
            let command = balance.tick(Ok(&q), &Pitch::default(), &order);
            assert!(command.torque.iter().all(|torque| torque.is_finite()));
        }
        assert_eq!(balance.place, place);
    }
}
