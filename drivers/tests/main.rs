//! Every driver against its data sheet or protocol document, in one program.

use dynamics_core::state::State;
use joint_drivers::{EncoderMapping, JointMapping, JointRange};
use motion_control::reference::Reference;

mod absolute;
mod arrays;
mod can;
mod can_joints;
mod control_loop;
mod damiao_bus;
mod drives;
mod feetech;
mod incremental;
mod lost_supply;
mod lost_turn;
mod mapping;
mod mit;
mod starts;

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

/// The output of a future of mocks, which are ready at once.
fn ready<F: Future>(future: F) -> F::Output {
    use core::task::{Context, Poll, Waker};
    match core::pin::pin!(future).poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(output) => output,
        Poll::Pending => panic!("a mock is never pending"),
    }
}
