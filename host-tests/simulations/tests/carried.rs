//! Carried sines and cosines over hours.

use host_tests::carried;
use host_tests::everyday_or_full;
use host_tests::tolerances::check;

#[test]
fn carried_sines_are_as_accurate_after_hours_as_at_first() {
    let ticks = everyday_or_full(1_000_000, 10_000_000);
    for (name, first, mut motion) in carried::motions() {
        let error = carried::worst_error::<7>(ticks, first, &mut motion);
        check("trig", "carried, seven joints", "f32", error)
            .unwrap_or_else(|why| panic!("{name}: {why}"));
    }
}
