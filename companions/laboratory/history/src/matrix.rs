//! Square matrices by rows and vectors, with the costs of the published counts: a product of D × D
//! matrices takes D³ products and D²(D − 1) sums, whatever zeros it has.

use core::array::from_fn;

use crate::number::Number;

/// A matrix by rows.
pub type Mat<T, const D: usize> = [[T; D]; D];

/// aᵀ b: D products, D − 1 sums.
#[inline(always)]
pub fn dot<T: Number, const D: usize>(a: &[T; D], b: &[T; D]) -> T {
    let mut sum = a[0] * b[0];
    for i in 1..D {
        sum = sum + a[i] * b[i];
    }
    sum
}

/// A B.
#[inline(always)]
pub fn mul<T: Number, const D: usize>(a: &Mat<T, D>, b: &Mat<T, D>) -> Mat<T, D> {
    mul_transposed(a, &transposed(b))
}

/// A Bᵀ.
#[inline(always)]
pub fn mul_transposed<T: Number, const D: usize>(a: &Mat<T, D>, b: &Mat<T, D>) -> Mat<T, D> {
    from_fn(|i| from_fn(|j| dot(&a[i], &b[j])))
}

/// tr(A Bᵀ) as the published counts have it: the whole product, then D − 1 sums. A compiler may
/// omit the product's entries that the trace does not need.
#[inline(always)]
pub fn trace_of_product<T: Number, const D: usize>(a: &Mat<T, D>, b: &Mat<T, D>) -> T {
    let product = mul_transposed(a, b);
    let mut sum = product[0][0];
    for (i, row) in product.iter().enumerate().skip(1) {
        sum = sum + row[i];
    }
    sum
}

/// A v: D² products, D(D − 1) sums.
#[inline(always)]
pub fn mul_vec<T: Number, const D: usize>(a: &Mat<T, D>, v: &[T; D]) -> [T; D] {
    from_fn(|i| dot(&a[i], v))
}

/// Aᵀ v.
#[inline(always)]
pub fn transpose_mul_vec<T: Number, const D: usize>(a: &Mat<T, D>, v: &[T; D]) -> [T; D] {
    mul_vec(&transposed(a), v)
}

/// Aᵀ.
#[inline(always)]
pub fn transposed<T: Number, const D: usize>(a: &Mat<T, D>) -> Mat<T, D> {
    from_fn(|i| from_fn(|j| a[j][i]))
}

/// A s: D² products.
#[inline(always)]
pub fn scaled<T: Number, const D: usize>(a: &Mat<T, D>, s: T) -> Mat<T, D> {
    a.map(|row| row.map(|x| x * s))
}

/// A + B: D² sums.
#[inline(always)]
pub fn sum<T: Number, const D: usize>(a: &Mat<T, D>, b: &Mat<T, D>) -> Mat<T, D> {
    from_fn(|i| plus(&a[i], &b[i]))
}

/// a bᵀ: D² products.
#[inline(always)]
pub fn outer<T: Number, const D: usize>(a: &[T; D], b: &[T; D]) -> Mat<T, D> {
    from_fn(|i| from_fn(|j| a[i] * b[j]))
}

/// a + b: D sums.
#[inline(always)]
pub fn plus<T: Number, const D: usize>(a: &[T; D], b: &[T; D]) -> [T; D] {
    from_fn(|i| a[i] + b[i])
}

/// v s: D products.
#[inline(always)]
pub fn times<T: Number, const D: usize>(v: &[T; D], s: T) -> [T; D] {
    v.map(|x| x * s)
}

/// a × b: 6 products, 3 sums.
#[inline(always)]
pub fn cross<T: Number>(a: &[T; 3], b: &[T; 3]) -> [T; 3] {
    from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}

/// ∂A/∂q = Q A of a revolute joint: rotates the rows of A by a quarter turn about z; no arithmetic.
#[inline(always)]
pub fn derivative<T: Number, const D: usize>(a: &Mat<T, D>) -> Mat<T, D> {
    from_fn(|i| match i {
        0 => a[1].map(|x| -x),
        1 => a[0],
        _ => [T::ZERO; D],
    })
}
