use super::demand;

#[test]
fn a_spring_of_any_stiffness_swings_as_backward_eulers() {
    demand(31);
}

#[test]
fn damping_of_any_strength_slows_down_and_never_turns_back() {
    demand(32);
}

#[test]
fn a_flexible_joint_of_any_stiffness_carries_what_accelerates_its_link() {
    demand(36);
}
