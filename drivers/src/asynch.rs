//! The traits of encoders whose bus is awaited.
//!
//! Drives have no such form: `embedded-hal-async` has no PWM and no output pins.

use crate::{EncoderType, JointError};

/// As [`JointEncoder`](crate::JointEncoder), without waiting for the bus.
#[expect(async_fn_in_trait, reason = "a loop's future stays on its core")]
pub trait JointEncoder: EncoderType {
    /// Prepares the first reading. Errors are those of that reading.
    async fn start(&mut self) {}

    /// Takes a reading from the device.
    ///
    /// # Errors
    /// There is none; [`Self::position`] is then meaningless.
    async fn sample(&mut self) -> Result<(), Self::Error>;

    /// The joint's position in the reading, rad or m, finite.
    fn position(&self) -> f32;
}

/// As [`JointEncoders`](crate::JointEncoders), without waiting for the bus.
#[expect(async_fn_in_trait, reason = "a loop's future stays on its core")]
pub trait JointEncoders<const V: usize>: EncoderType {
    /// Prepares the first reading. Errors are those of that reading.
    async fn start(&mut self);

    /// The joints' positions, rad or m, finite.
    ///
    /// # Errors
    /// The error of the first joint without a position. In an array all others have been read
    /// nevertheless.
    async fn read(&mut self) -> Result<[f32; V], JointError<Self::Error>>;
}

impl<E: JointEncoder, const V: usize> JointEncoders<V> for [E; V] {
    async fn start(&mut self) {
        for encoder in self {
            encoder.start().await;
        }
    }

    async fn read(&mut self) -> Result<[f32; V], JointError<E::Error>> {
        let mut failed = None;
        for (joint, encoder) in self.iter_mut().enumerate() {
            if let Err(error) = encoder.sample().await {
                failed = failed.or(Some(JointError { joint, error }));
            }
        }
        failed.map_or_else(|| Ok(self.each_ref().map(E::position)), Err)
    }
}

/// The output of a future of mocks, which are ready at once.
#[cfg(test)]
pub(crate) fn ready<F: Future>(future: F) -> F::Output {
    use core::task::{Context, Poll, Waker};
    match core::pin::pin!(future).poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(output) => output,
        Poll::Pending => panic!("a mock is never pending"),
    }
}
