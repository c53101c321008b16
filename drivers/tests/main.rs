//! Every driver against its data sheet or protocol document, in one program.

use joint_drivers::{EncoderMapping, JointMapping, JointRange};

mod absolute;
mod arrays;
mod can;
mod can_joints;
mod control_loop;
mod drives;
mod feetech;
mod incremental;
mod lost_turn;
mod mapping;

/// The mapping of a joint that starts near zero.
fn near_zero(mapping: JointMapping) -> EncoderMapping {
    mapping.with_range(JointRange::Near(0.0), 1e-3).unwrap()
}

fn identity() -> EncoderMapping {
    near_zero(JointMapping::IDENTITY)
}
