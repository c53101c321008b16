//! The distance of a configuration from a singular one of the motors, in f64 and by definition.

use dynamics_core::loops::{LoopRobot, Loops, constraints};
use dynamics_core::model::Static;
use dynamics_core::state::State;
use nalgebra::DMatrix;

/// The passive coordinates, and the products of two columns of K, rows over the sizes of their
/// loops.
pub fn squares<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
>(
    loops: &Loops<L, C, A>,
    q: &[f64; Q],
) -> (Vec<usize>, impl Fn(usize, usize) -> f64)
where
    T: LoopRobot<B, Q, V, L, C, A>,
{
    let k = constraints(&Static::<T>::NEW, loops, &State::<f64, Q, V>::at(*q));
    let passive = (0..V).filter(|i| !loops.actuated().contains(i)).collect();
    let product = move |i: usize, j: usize| {
        let rows = k.jacobian.iter().zip(&k.size);
        rows.map(|(row, size)| row[i] * row[j] / (size * size)).sum()
    };
    (passive, product)
}

/// The inverse of the products of all columns that are listed; infinite of a singular matrix.
pub fn inverse(of: &[usize], entry: impl Fn(usize, usize) -> f64) -> DMatrix<f64> {
    let size = of.len();
    let products = DMatrix::from_fn(size, size, |i, j| entry(of[i], of[j]));
    products.try_inverse().unwrap_or(DMatrix::repeat(size, size, f64::INFINITY))
}

/// ς: the distance from a singular configuration of the motors, as `Loops::damped_below` has it.
pub fn distance<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
>(
    loops: &Loops<L, C, A>,
    q: &[f64; Q],
) -> f64
where
    T: LoopRobot<B, Q, V, L, C, A>,
{
    let (passive, product) = squares::<T, B, Q, V, L, C, A>(loops, q);
    let trace = inverse(&passive, product).trace();
    // Rounding may make an eigenvalue that is nearly zero negative, or the trace infinite.
    trace.abs().sqrt().recip()
}
