//! The distance of a configuration from a singular one of the motors, in f64 and by definition.

use dynamics_core::loops::{LoopRobot, Loops, constraints};
use dynamics_core::model::Static;
use dynamics_core::state::State;

/// The inverse of a regular matrix, by Gauss and Jordan with row pivots.
pub fn inverse(a: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let n = a.len();
    let unit = |i| (0..n).map(move |j| f64::from(u8::from(i == j)));
    let mut m: Vec<Vec<f64>> =
        (0..n).map(|i| a[i].iter().copied().chain(unit(i)).collect()).collect();
    for k in 0..n {
        let largest = (k..n).max_by(|&i, &j| m[i][k].abs().total_cmp(&m[j][k].abs()));
        m.swap(k, largest.expect("a row"));
        let pivot = m[k][k];
        m[k].iter_mut().for_each(|x| *x /= pivot);
        let row = m[k].clone();
        for (_, other) in m.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = other[k];
            other.iter_mut().zip(&row).for_each(|(x, p)| *x -= factor * p);
        }
    }
    m.into_iter().map(|row| row[n..].to_vec()).collect()
}

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

/// The products of all columns that are listed.
pub fn table(of: &[usize], entry: impl Fn(usize, usize) -> f64) -> Vec<Vec<f64>> {
    let row = |&i: &usize| of.iter().map(|&j| entry(i, j)).collect();
    of.iter().map(row).collect()
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
    let inverse = inverse(&table(&passive, product));
    let trace: f64 = (0..inverse.len()).map(|i| inverse[i][i]).sum();
    // Rounding may make an eigenvalue that is nearly zero negative, or the trace infinite.
    trace.abs().sqrt().recip()
}
