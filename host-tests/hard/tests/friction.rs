use crate::demand;

// It creeps as its smooth sign says, or it holds.
#[test]
fn friction_at_rest_never_chatters() {
    demand(33);
}

#[test]
fn stick_slip_has_the_textbook_period() {
    demand(34);
}

#[test]
fn friction_is_odd_and_takes_energy_at_every_speed() {
    demand(35);
}
