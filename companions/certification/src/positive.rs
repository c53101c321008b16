//! Whether a symmetric matrix is positive definite, roundings included: by the factorisation of
//! Cholesky (Rump, 2006).

/// A matrix by rows, of which the lower triangle is read.
pub(crate) type Matrix = Vec<Vec<f64>>;

/// A direction in which a symmetric matrix, of which the lower triangle is given, may not be
/// positive; none if it is positive definite. The matrix is overwritten.
pub(crate) fn not_positive(matrix: &mut Matrix) -> Option<Vec<f64>> {
    let n = matrix.len();
    let trace: f64 = (0..n).map(|i| matrix[i][i].abs()).sum();
    // The factorisation is that of a matrix within γ/(1 − γ) of the trace, γ = (n + 1) 2⁻⁵³ / (1 −
    // (n + 1) 2⁻⁵³).
    let roundings = 2.0 * (n as f64 + 2.0) * f64::EPSILON * trace + f64::MIN_POSITIVE;
    for (i, row) in matrix.iter_mut().enumerate() {
        row[i] -= roundings;
    }
    for j in 0..n {
        for i in j..n {
            let products = (0..j).map(|k| matrix[i][k] * matrix[j][k]);
            let x = matrix[i][j] - products.sum::<f64>();
            matrix[i][j] = match i == j {
                true if x > 0.0 => x.sqrt(),
                true => return Some(direction(matrix, j)),
                false => x / matrix[j][j],
            };
        }
    }
    None
}

/// (−A⁻¹ a, 1, 0, …) of the rows before one that a factorisation ended at, and its own row a.
fn direction(factors: &Matrix, row: usize) -> Vec<f64> {
    let mut x = vec![0.0; factors.len()];
    x[row] = 1.0;
    for i in (0..row).rev() {
        let known = (i + 1..row).map(|k| factors[k][i] * x[k]);
        x[i] = (-factors[row][i] - known.sum::<f64>()) / factors[i][i];
    }
    x
}
