//! Dry friction at rest and through zero.

use super::name;
use dynamics_core::effects::{
    AsymmetricCoulomb, Coulomb, Effect, Inertia, JointState, Stribeck, Viscous, Width,
};
use dynamics_core::scalar::Real;
use dynamics_core::sim::linearly_implicit;
use dynamics_core::state::State;
use host_tests::friction::{STICTION, STIFFNESS, lugre, sledge};
use host_tests::hard::{Case, Row};
use host_tests::measured::larger;
use host_tests::random::random_numbers;
use proptest::prelude::RngExt;

pub const CASES: &[Case] = &[
    Case {
        number: 33,
        name: "friction at rest, 0.9 of break-away",
        parameters: "2 kg, a force of 3.6 N and friction of 4 N, widths 1e-2 … 1e-6 m/s, 2 s in \
            steps of 1 ms; the LuGre model of Canudas de Wit (1995), loaded within 1 s, then 10 s",
        source: "brakes and wrists that creep or chatter under a regularised sign",
        oracle: "closed form: the smooth sign u (3 − u²)/2 is 0.9 at u = 2 sin(asin(0.9)/3); the \
            deflection of LuGre is −ln(0.1) F_s/σ₀",
        reason: "speed: the balance of two forces rounds by 30 ε, and without chatter the speed \
            decreases by no more. LuGre: the requirement is 2.5 F_s/σ₀ and 1 %",
        run: rest,
    },
    Case {
        number: 35,
        name: "friction through zero",
        parameters: "every power of two in f32 and f64 with 16 mantissas, both signs",
        source: "signs that jump at zero; friction tables with an offset, which drives the joint",
        oracle: "τ(−v) = −τ(v) bit by bit, τ v ≥ 0",
        reason: "a claim: no rounding error depends on a sign",
        run: through_zero,
    },
];

/// The motor's torque at one joint that moves so.
fn torque<R: Real, E: Effect<R, 1, 1>>(effect: &E, qd: R) -> R {
    let (mut tau, q) = (R::ZERO, R::ZERO);
    effect.torque(0, JointState::new(q, qd), &mut tau);
    tau
}

fn rest() -> Vec<Row> {
    let mut rows = Vec::new();
    for width in [1e-2, 1e-4, 1e-6] {
        creep::<f32>(&mut rows, width);
        creep::<f64>(&mut rows, width);
    }
    holds::<f64>(&mut rows, 1e-4);
    holds::<f64>(&mut rows, 1e-3);
    holds::<f32>(&mut rows, 1e-3);
    rows
}

/// Smooth Coulomb friction creeps.
fn creep<R: Real>(rows: &mut Vec<Row>, width: f64) {
    let of = R::from_f64;
    let dry = Coulomb { torque: [of(4.0)], width: Width::new(of(width)) };
    let (mut state, mut back) = (State::at([R::ZERO]), 0.0_f64);
    for _ in 0..2000 {
        let before = state.qd[0].to_f64();
        linearly_implicit(&sledge(2.0), &mut state, &[of(3.6)], &mut (Inertia, dry), of(1e-3))
            .expect("M is positive definite");
        back = larger(back, before - state.qd[0].to_f64());
    }
    let want = width * 2.0 * (0.9_f64.asin() / 3.0).sin();
    let (error, bound) = (state.qd[0].to_f64() / want - 1.0, 30.0 * R::EPSILON.to_f64());
    rows.push(Row::stated(format!("width {width:.0e}: creep"), name::<R>(), error.abs(), bound));
    rows.push(Row::stated(
        format!("width {width:.0e}: chatter, of the creep"),
        name::<R>(),
        back / want,
        bound,
    ));
}

/// LuGre's friction preslides and holds.
fn holds<R: Real>(rows: &mut Vec<Row>, h: f64) {
    let (mut scene, block) = ((Inertia, lugre::<R>()), sledge(1.0));
    let (mut state, mut presliding) = (State::at([R::ZERO]), 0.0);
    for i in 1..=(11.2 / h).round() as u32 {
        let t = f64::from(i) * h;
        let tau = [R::from_f64(0.9 * STICTION * t.min(1.0))];
        linearly_implicit(&block, &mut state, &tau, &mut scene, R::from_f64(h))
            .expect("M is positive definite");
        // The swing that the ramp's end leaves has died away.
        if t <= 1.2 {
            presliding = state.q[0].to_f64();
        }
    }
    let slid = presliding * STIFFNESS / STICTION;
    let crept = (state.q[0].to_f64() - presliding).abs() / presliding;
    let what = |what: &str| format!("LuGre, h = {h:.0e}: {what}");
    rows.push(Row::stated(what("presliding, F_s/σ₀"), name::<R>(), slid, 2.5));
    // Without inertia; the swing adds 4 %.
    let off = (slid + 0.1_f64.ln()).abs() / slid;
    rows.push(Row::measured(what("presliding against −ln 0.1"), name::<R>(), off, 0.06));
    rows.push(Row::stated(what("creep in 10 s, of the presliding"), name::<R>(), crept, 0.01));
}

fn through_zero() -> Vec<Row> {
    fn run<R: Real>(rows: &mut Vec<Row>, powers: std::ops::Range<i32>) {
        let of = R::from_f64;
        let dry = Coulomb { torque: [of(4.0)], width: Width::new(of(0.02)) };
        let stribeck = Stribeck {
            excess: [of(2.0)],
            stribeck_speed: Width::new(of(0.05)),
            width: Width::new(of(0.02)),
        };
        let mut bent = lugre::<R>();
        bent.bristle = [of(0.9 * STICTION / STIFFNESS)];
        let mut other = bent;
        other.bristle = bent.bristle.map(|z| -z);
        let rng = &mut random_numbers();
        let (mut odd, mut dissipative, mut continuous) = (true, true, true);
        for (power, sixteenth) in powers.flat_map(|p| (16..32).map(move |m| (p, m))) {
            let v = of(f64::from(sixteenth) / 16.0 * 2.0_f64.powi(power));
            let viscous = Viscous([of(0.5)]);
            let both = |v| [torque(&viscous, v), torque(&dry, v), torque(&stribeck, v)];
            let (ahead, behind) = (both(v), both(-v));
            odd &= ahead == behind.map(|tau| -tau) && torque(&bent, v) == -torque(&other, -v);
            let one_way = AsymmetricCoulomb {
                forward: [of(rng.random_range(0.0..5.0))],
                backward: [of(if sixteenth % 5 == 0 { 0.0 } else { 3.0 })],
                width: Width::new(of(0.02)),
            };
            let of_one_way = torque(&one_way, v) >= R::ZERO && torque(&one_way, -v) <= R::ZERO;
            dissipative &= of_one_way && ahead.iter().all(|&tau| tau >= R::ZERO);
            // 3/2 F/w is the steepest slope there is.
            let steepest = [0.5, 4.0 * 75.0, 2.0 * 75.0]
                .map(|slope| slope * v.to_f64() * (1.0 + 1e-6) + 1e-44);
            continuous &= ahead.iter().zip(steepest).all(|(tau, most)| tau.to_f64() <= most);
        }
        let still =
            [torque(&dry, R::ZERO), torque(&stribeck, R::ZERO), torque(&lugre::<R>(), R::ZERO)];
        rows.push(Row::claim("odd: viscous, Coulomb, Stribeck, LuGre", name::<R>(), odd));
        rows.push(Row::claim(
            "dissipative: these and Coulomb of two directions",
            name::<R>(),
            dissipative,
        ));
        rows.push(Row::claim(
            "continuous, and nothing at rest",
            name::<R>(),
            continuous && still == [R::ZERO; 3],
        ));
    }
    let mut rows = Vec::new();
    run::<f32>(&mut rows, -149..100);
    run::<f64>(&mut rows, -1074..900);
    rows
}
