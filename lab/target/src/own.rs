//! A robot from a file.

use core::marker::PhantomData;

use dynamics_core::model::{Model, Robot};

/// The robot T under a name that is one word, which logs need; the reports put its own name in the
/// place of it.
#[derive(Clone, Copy, Debug)]
pub struct Own<T>(PhantomData<T>);

impl<T: Robot<B, N, N>, const B: usize, const N: usize> Robot<B, N, N> for Own<T> {
    const MODEL: Model<f64, B, N, N> = {
        let mut model = T::MODEL;
        model.name = "own";
        model
    };
}
