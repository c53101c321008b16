//! Polynomials of the number of joints, up to n⁴, with coefficients in twelfths.

/// Coefficients of n⁴, n³, n², n and 1, in twelfths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Polynomial(pub [i64; 5]);

/// Integer coefficients of n², n and 1.
pub const fn poly(n2: i64, n1: i64, n0: i64) -> Polynomial {
    Polynomial([0, 0, 12 * n2, 12 * n1, 12 * n0])
}

pub const NONE: Polynomial = poly(0, 0, 0);

impl Polynomial {
    pub const fn twelvefold(&self, n: i64) -> i64 {
        let [n4, n3, n2, n1, n0] = self.0;
        (((n4 * n + n3) * n + n2) * n + n1) * n + n0
    }

    pub const fn plus(&self, other: &Self) -> Self {
        let mut sum = self.0;
        let mut i = 0;
        while i < 5 {
            sum[i] += other.0[i];
            i += 1;
        }
        Self(sum)
    }
}
