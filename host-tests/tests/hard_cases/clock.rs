use super::demand;

#[test]
fn an_encoder_wrap_is_no_velocity_spike() {
    demand(38);
}

#[test]
fn late_and_missed_ticks_leave_commands_within_limits_and_the_arm_on_its_way() {
    demand(39);
}

#[test]
fn time_does_not_stop_in_a_day() {
    demand(40);
}

#[test]
fn nothing_winds_up_while_an_arm_is_held_fast() {
    demand(41);
}
