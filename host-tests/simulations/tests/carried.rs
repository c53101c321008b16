//! Carried sines and cosines over hours.

use host_tests::carried;
use host_tests::everyday_or_full;
use host_tests::tolerances::check;

#[test]
fn carried_sines_are_as_accurate_after_hours_as_at_first() {
    let ticks = everyday_or_full(1_000_000, 10_000_000);
    let errors = carried::motions().into_iter().map(|(name, first, mut motion)| {
        let error = carried::worst_error::<7>(ticks, first, &mut motion);
        (error, name)
    });
    let (worst, name) = errors.max_by(|(a, _), (b, _)| a.total_cmp(b)).expect("motions");
    check("trig", "carried, seven joints", "f32", worst)
        .unwrap_or_else(|why| panic!("{name}: {why}"));
}
