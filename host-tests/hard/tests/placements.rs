//! Far away, tiny, giant, and in other frames.

use crate::demand;

#[test]
fn where_the_base_stands_changes_no_bit() {
    demand(13);
}

#[test]
fn an_offset_in_the_placement_leaves_the_stroke_its_digits() {
    demand(14);
}

#[test]
fn scaling_a_robot_changes_no_significand() {
    demand(42);
}

#[test]
fn general_frames_are_as_good_as_quarter_turns() {
    demand(43);
}
