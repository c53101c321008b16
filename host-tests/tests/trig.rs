//! Sine and cosine against the host's f64 library, whose own error is below 1.2·10⁻¹⁶.

use std::f64::consts::{FRAC_PI_2, PI};

use dynamics_core::scalar::Native;
use dynamics_core::scalar::Real;
use dynamics_core::state::IncrementalTrig;
use dynamics_core::trig::{Kernel, Minimax, Table, sin_cos, sin_cos_f64, sin_cos_near};
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
            // The points where the reduction passes from one quadrant to the next.
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

// This holds up to 10⁴ rad.
#[test]
fn sine_and_cosine_in_f32_are_good_to_1e_7() {
    let error = worst(sin_cos, 1e4, single);
    assert!(error <= 1e-7, "{error:.3e}");
    check("trig", "sin_cos", "f32", error).unwrap();
}

// This holds up to 10⁵ rad.
#[test]
fn sine_and_cosine_in_f64_are_good_to_3e_16() {
    let error = worst(<f64 as Real>::sin_cos, 1e5, double);
    assert!(error <= 3e-16, "{error:.3e}");
    check("trig", "sin_cos", "f64", error).unwrap();
}

// This holds up to 100 rad.
#[test]
fn the_two_part_reduction_is_as_good() {
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

/// Numbers of every size and both signs: 64 of each power of two.
fn all_sizes() -> impl Iterator<Item = f32> {
    (0..=0x7f7f_ffff)
        .step_by(0x1_f001)
        .flat_map(|bits| [f32::from_bits(bits), -f32::from_bits(bits)])
}

#[test]
fn sines_stay_within_one_for_every_input() {
    fn largest<K: Kernel<f32>>() -> f32 {
        let wild = [3e9, 1e30, 1e37, f32::MAX, -f32::MAX];
        let pairs = all_sizes().chain(wild).map(K::sin_cos);
        pairs.flat_map(|(s, c)| [s.abs(), c.abs()]).fold(0.0, |worst, x| {
            assert!(x.is_finite());
            worst.max(x)
        })
    }
    let exact = [
        largest::<Native>(),
        largest::<Table<128, 3, 4>>(),
        largest::<Table<128, 3, 2>>(),
        largest::<Table<64, 4>>(),
        largest::<Minimax<3, 2>>(),
        largest::<Minimax<5, 2>>(),
        largest::<Minimax<7, 2>>(),
        largest::<Minimax<7, 3>>(),
    ];
    assert_eq!(exact, [1.0; 8]);
    let [linear, quadratic] = [largest::<Table<256, 1>>(), largest::<Table<256, 2>>()];
    assert!(linear < 1.05 && quadratic < 1.05, "{linear} {quadratic}");
    let wild = [3e9, 1e16, 1e30, 1e300, f64::MAX, -f64::MAX];
    for x in all_sizes().map(f64::from).chain(wild) {
        let (s, c) = sin_cos_f64(x);
        assert!(s.abs() <= 1.0 && c.abs() <= 1.0, "at {x}: {s}, {c}");
    }
}

#[test]
fn nonfinite_angles_have_nan_sines() {
    for x in [f32::INFINITY, f32::NEG_INFINITY, f32::NAN] {
        let pairs = [
            Native::sin_cos(x),
            sin_cos_near(x),
            Table::<256, 1>::sin_cos(x),
            Minimax::<7, 3>::sin_cos(x),
        ];
        assert!(pairs.iter().all(|(s, c)| s.is_nan() && c.is_nan()), "{x}: {pairs:?}");
        let (s, c) = sin_cos_f64(x.into());
        assert!(s.is_nan() && c.is_nan());
    }
}

/// One number for the bits of all sines and cosines on ±`range` and next to zero.
fn digest<R: Real>(pair: impl Fn(R) -> (R, R), range: f64) -> u64 {
    let sweep = (-100_000..=100_000).map(|i| f64::from(i) * 1e-5 * range);
    let tiny = (1..100).map(|i| 0.7 * 2.0_f64.powi(-i));
    let pairs = sweep.chain(tiny).map(R::from_f64).map(pair);
    let bits = pairs.flat_map(|(s, c)| [s, c]).map(|x| x.to_f64().to_bits());
    bits.fold(0, |hash: u64, bits| (hash.rotate_left(5) ^ bits).wrapping_mul(0x9e37_79b9_7f4a_7c15))
}

/// Results within range are part of what a release promises: host and target, this version and the
/// last.
#[test]
fn sines_within_range_keep_their_recorded_bits() {
    let digests = [
        digest(sin_cos, 1e4),
        digest(sin_cos_near, 100.0),
        digest(Table::<256, 1>::sin_cos, 100.0),
        digest(Table::<256, 2>::sin_cos, 100.0),
        digest(Table::<64, 4>::sin_cos, 100.0),
        digest(Minimax::<3, 2>::sin_cos, 100.0),
        digest(Minimax::<5, 2>::sin_cos, 100.0),
        digest(Minimax::<7, 2>::sin_cos, 100.0),
        digest(Minimax::<7, 3>::sin_cos, 1e4),
    ];
    const RECORDED: [u64; 9] = [
        0x84ea_141d_f6f2_11d6,
        0x23d4_2e7a_e853_895b,
        0xdf74_f5cb_d292_2369,
        0x72e6_f194_9209_889d,
        0x904e_edd2_626f_d30a,
        0x5077_dfa7_bf7b_a2a8,
        0x29bf_c4dc_7417_faea,
        0xeed6_dacf_78b5_114f,
        0xb819_c402_5574_8eba,
    ];
    assert_eq!(digests, RECORDED, "{digests:#018x?}");
    assert_eq!(digest(sin_cos_f64, 1e5), 0x511c_49c9_80d8_839e);
}

#[test]
fn incremental_sines_recover_from_a_wrong_reading() {
    for wrong in [3e9, f32::MAX, f32::INFINITY, f32::NAN] {
        let mut turns = IncrementalTrig::at([0.3_f32]);
        let held = turns.follow(&[wrong]).coordinates[0];
        assert_eq!(held.q, 0.3);
        assert!(held.sin.abs() <= 1.0 && held.cos.abs() <= 1.0);
        let back = turns.follow(&[0.301]).coordinates[0];
        assert!((back.sin - 0.301_f32.sin()).abs() < 2e-7 && back.q == 0.301, "{wrong}: {back:?}");
    }
}
