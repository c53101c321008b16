use crate::demand;

#[test]
fn stiff_springs_swing_as_backward_euler_says() {
    demand(31);
}

#[test]
fn damping_of_any_strength_slows_down_and_never_turns_back() {
    demand(32);
}

// This holds at any stiffness.
#[test]
fn a_flexible_joint_carries_its_links_inertial_torque() {
    demand(36);
}
