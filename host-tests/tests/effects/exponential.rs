//! e⁻ˣ against the host's f64 library.

use super::*;
use dynamics_core::scalar::exp_neg;
use host_tests::measured::largest;

// This holds down to the least normal numbers.
#[test]
fn the_exponential_is_good_to_2e_7() {
    let mut worst = 0.0_f64;
    let sweep = (0..2_000_000).map(|i| i as f32 * (87.0 / 2e6));
    // The points where the reduction passes from one power of two to the next, and next to zero.
    let hard = (0..125).map(|k| ((f64::from(k) + 0.5) * core::f64::consts::LN_2) as f32);
    let hard = hard.flat_map(|x| [x.next_down(), x, x.next_up()]);
    let tiny = (0..40).map(|k| 2.0_f32.powi(-k));
    for x in sweep.chain(hard).chain(tiny) {
        let want = (-f64::from(x)).exp();
        worst = largest([worst, (f64::from(exp_neg(x)) / want - 1.0).abs()]);
    }
    assert!(worst <= 2e-7, "{worst:.3e}");
    tolerances::check("exponential", "exp_neg", "f32", worst).unwrap();
}

#[test]
fn the_exponential_falls_from_one_to_zero_for_every_input() {
    fn holds<R: Real>() {
        let e = |x: f64| R::from_f64(x).exp_neg().to_f64();
        assert_eq!((e(0.0), e(-3.0), e(f64::NAN), e(f64::NEG_INFINITY)), (1.0, 1.0, 1.0, 1.0));
        assert_eq!((e(1e3), e(1e30), e(f64::INFINITY)), (0.0, 0.0, 0.0));
        let mut last = 1.0;
        for i in 0..200_000 {
            let now = e(f64::from(i) * 1e-3);
            assert!((0.0..=last * (1.0 + 2e-7)).contains(&now), "{i}");
            last = now;
        }
    }
    holds::<f32>();
    holds::<f64>();
}
