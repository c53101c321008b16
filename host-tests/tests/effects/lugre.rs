//! LuGre friction: presliding, sliding and passivity.

use super::*;
use dynamics_core::effects::{Inertia, Lugre};
use dynamics_core::sim::linearly_implicit;
use host_tests::random::random_numbers;
use proptest::prelude::RngExt;

const STICTION: f64 = 1.5;
const STIFFNESS: f64 = 1e5;

/// The numbers of Canudas de Wit et al. (1995), table 1.
fn friction<R: Real>() -> Lugre<R, 1> {
    Lugre {
        stiffness: [R::from_f64(STIFFNESS)],
        damping: [R::from_f64(316.0)],
        viscous: [R::from_f64(0.4)],
        sliding: [R::ONE],
        excess: [R::from_f64(STICTION - 1.0)],
        per_speed: R::from_f64(1000.0),
        bristle: [R::ZERO],
    }
}

/// As in the paper: 1 kg.
const BLOCK: Arm<f64, 1> = Model::new(
    "block",
    [Body::new("block", BASE, Joint::prismatic([1.0, 0.0, 0.0])).mass(1.0)],
);

#[test]
fn a_load_below_break_away_slides_by_the_models_own_presliding_and_then_holds() {
    /// Where the block is at 1.2 s, when the swing that the ramp's end leaves has died away, and how far
    /// it creeps in ten seconds more.
    fn run<R: Real>(h: f64) -> [f64; 2] {
        let mut scene = (Inertia, friction::<R>());
        let mut block = State::at([R::ZERO]);
        let model = R::cast(&BLOCK);
        let mut presliding = 0.0;
        for i in 1..=(11.2 / h).round() as u32 {
            let t = f64::from(i) * h;
            let tau = [R::from_f64(0.9 * STICTION * t.min(1.0))];
            linearly_implicit(&model, &mut block, &tau, &mut scene, R::from_f64(h)).unwrap();
            if t <= 1.2 {
                presliding = block.q[0].to_f64();
            }
        }
        [presliding, block.q[0].to_f64() - presliding]
    }
    let unit = STICTION / STIFFNESS;
    for [presliding, creep] in [run::<f64>(1e-4), run::<f64>(1e-3), run::<f32>(1e-3)] {
        let [slid, crept] = [presliding / unit, creep.abs() / presliding];
        println!("presliding {slid:.4} F_s/σ₀, then {:.4} %", 100.0 * crept);
        assert!(slid <= 2.5 && crept < 0.01, "{slid} {crept}");
        // −ln(1 − 0.9) without inertia; the swing adds 4 %.
        assert!((slid + 0.1_f64.ln()).abs() < 0.06 * slid, "{slid}");
    }
}

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
        let (mut friction, mut taken, h) = (friction::<f64>(), 0.0, 1e-5);
        let waves: [[f64; 3]; 4] =
            core::array::from_fn(|_| [(); 3].map(|()| rng.random_range(0.0..1.0)));
        for i in 0..20_000 {
            let t = f64::from(i) * h;
            let wave = |[a, w, p]: &[f64; 3]| 2e-3 * a * (500.0 * w * t + 6.0 * p).sin();
            let speed = waves.iter().map(wave).sum::<f64>();
            taken += h * speed * torque(&friction, 0.0, speed);
            Effect::<f64, 1, 1>::advance(&mut friction, 0, joint(0.0, speed), h);
            assert!(taken > -1e-9, "{taken} at {t} s");
            assert!(friction.bristle[0].abs() <= STICTION / STIFFNESS * (1.0 + 1e-12));
        }
    }
}
