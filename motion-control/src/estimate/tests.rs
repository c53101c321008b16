//! Linear equations by elimination, for the tests of the estimators: as few lines as there can be.

/// x of A x = b, of symmetric positive definite A.
pub(crate) fn solved<const M: usize>(mut a: [[f64; M]; M], mut b: [f64; M]) -> [f64; M] {
    for k in 0..M {
        let (pivot, right) = (a[k], b[k]);
        for i in (0..M).filter(|i| *i != k) {
            let share = a[i][k] / pivot[k];
            for (x, p) in a[i].iter_mut().zip(pivot) {
                *x -= share * p;
            }
            b[i] -= share * right;
        }
    }
    core::array::from_fn(|k| b[k] / a[k][k])
}

/// The inverse of a symmetric positive definite matrix.
pub(crate) fn inverse<const M: usize>(a: [[f64; M]; M]) -> [[f64; M]; M] {
    core::array::from_fn(|i| solved(a, core::array::from_fn(|j| f64::from(u8::from(i == j)))))
}

/// Numbers from −1 to 1 that are the same each time.
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    pub(crate) fn next(&mut self) -> f64 {
        let next = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = next.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / f64::from(1_u32 << 30) - 1.0
    }
}

/// The ticks after which a mean of 1/64 passes a bound, from a level towards a target.
pub(crate) fn ticks(mut level: f64, target: f64, passed: impl Fn(f64) -> bool) -> u32 {
    let mut ticks = 0;
    while !passed(level) {
        level += (target - level) / 64.0;
        ticks += 1;
    }
    ticks
}
