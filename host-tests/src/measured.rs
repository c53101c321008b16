//! Measured values compared with bounds; NaN and slack bounds fail.

/// The largest allowed ratio of a bound to its measured value.
const SLACK: f64 = 10.0;

/// The largest of some values: NaN as soon as one of them is NaN, which `f64::max` would drop, and
/// −∞ of none.
pub fn largest<T: Into<f64>>(values: impl IntoIterator<Item = T>) -> f64 {
    let larger = |largest: f64, value: f64| match largest.is_nan() | (value <= largest) {
        true => largest,
        false => value,
    };
    values.into_iter().map(Into::into).fold(f64::NEG_INFINITY, larger)
}

/// The larger one, or the one that is not a number.
pub fn larger(a: f64, b: f64) -> f64 {
    largest([a, b])
}

/// Holds a measured value against its bound; a bound of 0 stands for exactly 0.
///
/// # Panics
/// Names the value if it is NaN or beyond its bound, or if the bound is more than ten times the
/// value.
#[track_caller]
pub fn within(what: &str, measured: impl Into<f64>, bound: f64) {
    let measured = measured.into();
    let place = format!("{what}: {measured:.3e}, bound {bound:.1e}");
    assert!(measured <= bound, "{place}: exceeded");
    assert!(SLACK * measured >= bound, "{place}: slack by more than ten times, lower it");
}
