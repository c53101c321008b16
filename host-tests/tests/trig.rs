//! Sine and cosine against the host's f64 library, whose own error is below 1.2·10⁻¹⁶.

use std::f64::consts::{FRAC_PI_2, PI};

use dynamics_core::scalar::Real;
use dynamics_core::trig::{sin_cos, sin_cos_near};
use host_tests::tolerances::check;

/// Points of a sweep: dense against the 50 or so intervals of a reduction, not against all of f32.
const POINTS: i32 = 2_000_000;

/// The largest error of `pair` on a sweep of ±`range` and next to every multiple of π/2 in it.
fn worst<R: Real>(pair: impl Fn(R) -> (R, R), range: f64, neighbours: impl Fn(R) -> [R; 3]) -> f64 {
    let error = |x: R| {
        let ((s, c), exact) = (pair(x), x.to_f64());
        let (s, c) = (s.to_f64() - exact.sin(), c.to_f64() - exact.cos());
        assert!(s.is_finite() && c.is_finite(), "at {exact}");
        s.abs().max(c.abs())
    };
    let sweep = (-POINTS..=POINTS).map(|i| R::from_f64(f64::from(i) / f64::from(POINTS) * range));
    let quarters = (range / FRAC_PI_2) as i32;
    let hard = (-quarters..=quarters)
        .flat_map(|k| neighbours(R::from_f64(f64::from(k) * FRAC_PI_2)))
        .chain((-2 * quarters..=2 * quarters).flat_map(|k| {
            // Where the reduction passes from one quadrant to the next.
            neighbours(R::from_f64(f64::from(k) * FRAC_PI_2 / 2.0))
        }));
    sweep.chain(hard).map(error).fold(0.0, f64::max)
}

fn single(x: f32) -> [f32; 3] {
    [x.next_down(), x, x.next_up()]
}

fn double(x: f64) -> [f64; 3] {
    [x.next_down(), x, x.next_up()]
}

#[test]
fn sine_and_cosine_are_good_to_1e_7_up_to_1e4_rad() {
    let error = worst(sin_cos, 1e4, single);
    assert!(error <= 1e-7, "{error:.3e}");
    check("trig", "sin_cos", "f32", error).unwrap();
}

#[test]
fn sine_and_cosine_in_f64_are_good_to_3e_16_up_to_1e5_rad() {
    let error = worst(<f64 as Real>::sin_cos, 1e5, double);
    assert!(error <= 3e-16, "{error:.3e}");
    check("trig", "sin_cos", "f64", error).unwrap();
}

#[test]
fn the_two_part_reduction_is_as_good_up_to_100_rad() {
    for range in [4.0 * PI, 100.0] {
        let error = worst(sin_cos_near, range, single);
        assert!(error <= 1e-7, "{error:.3e} to {range} rad");
        check("trig", "sin_cos_near", "f32", error).unwrap();
    }
}

#[test]
fn sine_is_odd_and_cosine_even_to_the_bit() {
    for i in 0..100_000 {
        let x = i as f32 * 0.1;
        let ((s, c), (s_minus, c_minus)) = (sin_cos(x), sin_cos(-x));
        assert!(s == -s_minus && c == c_minus, "{x}");
    }
}
