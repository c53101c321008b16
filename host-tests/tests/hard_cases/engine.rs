use super::demand;

#[test]
fn the_engine_is_the_core_on_every_hard_arm() {
    demand(47);
}
