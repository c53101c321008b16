//! Every driver against its data sheet or protocol document, in one program.

use dynamics_core::state::State;
use joint_drivers::{EncoderMapping, JointMapping, JointRange};
use motion_control::Reference;

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
mod mit;

/// The mapping of a joint that starts near zero.
fn near_zero(mapping: JointMapping) -> EncoderMapping {
    mapping.with_range(JointRange::Near(0.0), 1e-3).unwrap()
}

fn identity() -> EncoderMapping {
    near_zero(JointMapping::IDENTITY)
}

/// A motion without an end, by a function of the tick.
struct Motion<F>(F);

impl<const V: usize, F: Fn(u32) -> State<f32, V, V>> Reference<f32, V> for Motion<F> {
    fn at(&self, tick: u32) -> State<f32, V, V> {
        self.0(tick)
    }
    fn ticks(&self) -> u32 {
        u32::MAX
    }
}
