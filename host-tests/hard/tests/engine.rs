use crate::demand;

#[test]
fn the_engine_agrees_with_the_core_on_hard_arms() {
    demand(47);
}
