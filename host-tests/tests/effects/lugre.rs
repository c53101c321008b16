//! LuGre friction: sliding and passivity; presliding is a hard case.

use super::*;
use host_tests::friction::{STICTION, STIFFNESS, lugre as friction};
use host_tests::random::random_numbers;
use proptest::prelude::RngExt;

#[test]
fn steady_sliding_has_the_stribeck_curve() {
    let mut worst = Worst::default();
    for i in 1..200 {
        let (mut friction, speed) = (friction::<f64>(), f64::from(i) * 2e-5);
        for _ in 0..2000 {
            Effect::<f64, 1, 1>::advance(&mut friction, 0, joint(0.0, speed), 0.1);
        }
        let want = 1.0 + 0.5 * (-(1000.0 * speed).powi(2)).exp() + 0.4 * speed;
        worst.see(torque(&friction, 0.0, speed), want);
    }
    worst.check::<f64>("lugre", "steady sliding");
}

#[test]
fn bristles_give_back_at_most_what_they_store() {
    let rng = &mut random_numbers();
    for _ in 0..50 {
        let (mut friction, mut absorbed, h) = (friction::<f64>(), 0.0, 1e-5);
        let waves: [[f64; 3]; 4] =
            core::array::from_fn(|_| [(); 3].map(|()| rng.random_range(0.0..1.0)));
        for i in 0..20_000 {
            let t = f64::from(i) * h;
            let wave = |[a, w, p]: &[f64; 3]| 2e-3 * a * (500.0 * w * t + 6.0 * p).sin();
            let speed = waves.iter().map(wave).sum::<f64>();
            absorbed += h * speed * torque(&friction, 0.0, speed);
            Effect::<f64, 1, 1>::advance(&mut friction, 0, joint(0.0, speed), h);
            assert!(absorbed > -1e-9, "{absorbed} at {t} s");
            assert!(friction.bristle[0].abs() <= STICTION / STIFFNESS * (1.0 + 1e-12));
        }
    }
}
