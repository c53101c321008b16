use super::demand;

#[test]
fn friction_at_rest_creeps_as_its_sign_says_or_holds_and_never_chatters() {
    demand(33);
}

#[test]
fn a_block_on_a_belt_sticks_and_slips_with_the_textbooks_period() {
    demand(34);
}

#[test]
fn friction_is_odd_and_takes_energy_at_every_speed() {
    demand(35);
}
