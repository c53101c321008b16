//! The hard cases hold: a test per case.

use hard_cases::{NUMBERS, attitude, day, nan_injection, pendulum};

fn demand(number: u32) {
    hard_cases::demand(number).unwrap_or_else(|wrong| panic!("{wrong}"));
}

// A part of a case that takes long is named beside it; `cargo xtask test hard-cases` demands the
// whole case.
host_tests::demanded! {
    a_tip_a_million_times_too_heavy = 1;
    a_tip_a_million_times_too_light_costs_nothing = 2;
    a_base_a_million_times_too_heavy_costs_nothing = 3;
    massless_links_in_between_need_no_inertia = 4;
    a_massless_last_link_is_named = 5;
    an_armature_of_any_size_is_enough = 6;
    chains_of_8 = 7;
    chains_of_16 = 8;
    chains_of_32 = 9;
    chains_of_64_state_their_lost_digits = 10;
    a_zigzag_of_condition_725 = 11;
    a_weight_on_a_light_chain = 12;
    where_the_base_stands_changes_no_bit = 13;
    an_offset_in_the_placement_leaves_the_stroke_its_digits = 14;
    high_speed_costs_no_digits = 15;
    a_million_rad_is_refused_and_reduced_exactly = 16;
    quarter_turns_are_as_accurate_as_other_angles = 17;
    a_stretched_elbow_is_damped_and_exact_to_the_damping = 18;
    a_sweep_through_the_singularity_does_not_jump = 19;
    coincident_axes_are_named_whatever_their_direction = 20;
    parallel_axes_give_the_planar_closed_form = 21;
    impossible_inertias_are_named_and_still_computed = 22;
    asymmetric_and_indefinite_inertias_are_named = 23;
    an_axis_of_any_length_but_zero_is_a_direction = 24;
    // It keeps its length and its attitude.
    a_quaternion_survives_millions_of_steps = 25, attitude::half_a_million_steps;
    // It keeps them within the order of its integrator.
    a_tumbling_body_keeps_energy_and_momentum = 26, attitude::one_integrator;
    a_heavy_top_precesses_as_its_closed_form = 27;
    a_double_pendulum_keeps_its_energy = 28, pendulum::pendulum_for_seconds;
    a_falling_tree_does_not_move_its_joints = 29;
    what_rests_without_gravity_stays_exactly_at_rest = 30;
    stiff_springs_swing_as_backward_euler_says = 31;
    damping_of_any_strength_slows_down_and_never_turns_back = 32;
    // It creeps as its smooth sign says, or it holds.
    friction_at_rest_never_chatters = 33;
    stick_slip_has_the_textbook_period = 34;
    friction_is_odd_and_takes_energy_at_every_speed = 35;
    // This holds at any stiffness.
    a_flexible_joint_carries_its_links_inertial_torque = 36;
    injected_nan_reaches_no_drive_and_is_forgotten = 37, nan_injection::in_single_precision;
    an_encoder_wrap_is_no_velocity_spike = 38;
    // The arm stays on its way.
    late_and_missed_ticks_keep_the_command_limits = 39;
    time_advances_exactly_over_a_day = 40, day::quarter_of_an_hour;
    a_blocked_arm_recovers_without_windup = 41;
    scaling_a_robot_changes_no_significand = 42;
    general_frames_are_as_good_as_quarter_turns = 43;
    frame_gravity_and_root_do_not_matter = 44;
    numbering_does_not_matter = 45;
    payloads_up_to_ten_times_the_arm = 46;
    the_engine_agrees_with_the_core_on_hard_arms = 47;
    rounded_rotations_separate_crba_and_aba_within_kappa = 48;
    // It stays within its limits.
    an_arm_pulled_straight_rests_and_returns = 70;
}

#[test]
fn derivatives_are_accurate_where_differences_are_not() {
    (95..=104).for_each(demand);
}

#[test]
fn no_number_is_given_twice() {
    let mut numbers = NUMBERS;
    numbers.sort_unstable();
    assert!(numbers.windows(2).all(|pair| pair[0] < pair[1]));
}
