//! Dry friction: closed forms of a pendulum and a sledge, stick-slip on a belt; more among the hard
//! cases.

use super::*;
use dynamics_core::effects::{
    AsymmetricCoulomb, Coulomb, Gravity, Inertia, RIGID_BODY, Spring, Stribeck, Width,
};
use dynamics_core::sim::linearly_implicit;
use host_tests::friction::{Belt, Cycle};

/// Steps until the velocity changes sign `turns` times; where it does.
fn turning_points<E: Effect<f64, 1, 1>>(
    model: &ArmModel<f64, 1>,
    start: f64,
    scene: &mut E,
    h: f64,
    turns: usize,
) -> Vec<f64> {
    let (mut state, mut points, mut sign) = (State::at([start]), vec![], -start.signum());
    while points.len() < turns {
        linearly_implicit(model, &mut state, &[0.0], scene, h).unwrap();
        if state.qd[0] * sign < 0.0 {
            points.push(state.q[0]);
            sign = -sign;
        }
    }
    points
}

#[test]
fn a_pendulums_energy_loss_is_frictions_work() {
    // m g l (cos θ₁ − cos θ₀) = F (θ₀ + θ₁) between turning points θ₀ and −θ₁, however far it
    // swings.
    const PENDULUM: ArmModel<f64, 1> = Model::new(
        "pendulum",
        [Body::new("rod", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(2.0).com([0.0, 0.0, -0.5])],
    );
    let (weight, friction) = (2.0 * 9.81 * 0.5, 0.4);
    let dry = Coulomb { torque: [friction], width: Width::new(1e-4) };
    let mut scene = (RIGID_BODY, dry);
    let points = turning_points(&PENDULUM, 2.5, &mut scene, 2e-5, 8);
    let (mut worst, mut from) = (Worst::default(), 2.5_f64);
    for to in points.into_iter().map(f64::abs) {
        worst.see(weight * (to.cos() - from.cos()), friction * (from + to));
        from = to;
    }
    worst.check::<f64>("pendulum", "loss to friction");
}

#[test]
fn coulomb_friction_shortens_each_swing_equally() {
    let dry = Coulomb { torque: [3.0], width: Width::new(1e-5) };
    let spring = Spring { stiffness: [200.0], rest: [0.0] };
    let points = turning_points(&SLEDGE, 0.5, &mut (Inertia, dry, spring), 1e-5, 12);
    let mut worst = Worst::default();
    for (i, x) in points.into_iter().enumerate() {
        worst.see(x.abs(), 0.5 - 2.0 * 3.0 / 200.0 * (i + 1) as f64);
    }
    worst.check::<f64>("sledge", "turning points");
}

const BELT: f64 = Belt::SPEED;
const STIFFNESS: f64 = Belt::STIFFNESS;
const SLIDING: f64 = 4.0;
const EXCESS: f64 = 3.0;
const SPEED: f64 = 0.05;
const WIDTH: f64 = 1e-3;

/// By Runge and Kutta's method of the fourth order, on the equation itself.
fn reference(t_end: f64, h: f64, mut see: impl FnMut(f64, f64)) {
    let rate = |t: f64, [x, v]: [f64; 2]| {
        let u = (v / WIDTH).clamp(-1.0, 1.0);
        let sign = 0.5 * u * (3.0 - u * u);
        let friction = (SLIDING + EXCESS * (-(v / SPEED).powi(2)).exp()) * sign;
        [v, (-STIFFNESS * (x + BELT * t) - friction) / 2.0]
    };
    let (mut y, mut t) = ([0.0; 2], 0.0);
    while t < t_end {
        let along = |k: [f64; 2], by: f64| [y[0] + by * k[0], y[1] + by * k[1]];
        let a = rate(t, y);
        let b = rate(t + h / 2.0, along(a, h / 2.0));
        let c = rate(t + h / 2.0, along(b, h / 2.0));
        let d = rate(t + h, along(c, h));
        for i in 0..2 {
            y[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
        }
        t += h;
        see(t, y[0] + BELT * t);
    }
}

#[test]
fn stick_slip_has_the_limit_cycle_of_the_reference() {
    let mut fine = Cycle::default();
    reference(15.0, 1e-5, |t, stretch| fine.see(t, stretch));
    let want = fine.period_and_height();
    assert!(fine.peaks.len() > 8 && want[1] > 1.2 * SLIDING / STIFFNESS, "{want:?}");

    let belt = Belt { sliding: SLIDING, excess: EXCESS, speed: SPEED, width: WIDTH };
    let got = belt.run::<f64>().period_and_height();
    let names = ["period of stick-slip", "stretch of stick-slip"];
    for ((got, want), name) in got.into_iter().zip(want).zip(names) {
        let mut worst = Worst::default();
        worst.see(got, want);
        worst.check::<f64>("block on a belt", name);
    }
}

// Each direction of motion has its own torque.
#[test]
fn asymmetric_friction_with_equal_ends_is_coulombs() {
    let dry = |forward: f64, backward: f64| AsymmetricCoulomb {
        forward: [forward],
        backward: [backward],
        width: Width::new(0.02),
    };
    let coulomb = Coulomb { torque: [4.0], width: Width::new(0.02) };
    for i in -100..=100 {
        let qd = f64::from(i) * 3e-4;
        let (got, want) = (torque(&dry(4.0, 4.0), 0.0, qd), torque(&coulomb, 0.0, qd));
        assert!((got - want).abs() < 1e-14, "{qd}: {got} {want}");
    }
    for qd in [0.02, 1.0, f64::INFINITY] {
        let ends = [qd, -qd].map(|qd| torque(&dry(5.0, 3.0), 0.0, qd));
        assert_eq!(ends, [5.0, -3.0]);
    }
    assert_eq!(torque(&dry(5.0, 3.0), 0.0, 0.0), 0.0);
}

#[test]
fn stribeck_friction_has_its_formula() {
    fn worst<R: Real>() -> Worst {
        let stribeck = Stribeck {
            excess: [R::from_f64(2.5)],
            stribeck_speed: Width::new(R::from_f64(0.0625)),
            width: Width::new(R::from_f64(1.0 / 1024.0)),
        };
        let mut worst = Worst::default();
        for i in -4000..4000 {
            let qd = f64::from(i) / 16384.0;
            let u = (qd * 1024.0).clamp(-1.0, 1.0);
            let want = 2.5 * (-(16.0 * qd).powi(2)).exp() * 0.5 * u * (3.0 - u * u);
            worst.see(torque::<R, _>(&stribeck, 0.0, qd), want);
        }
        worst
    }
    worst::<f64>().check::<f64>("stribeck", "closed form");
    worst::<f32>().check::<f32>("stribeck", "closed form");
}

#[test]
fn gravity_directions_by_type_and_by_value_agree() {
    use dynamics_core::effects::{Direction, GravityVector};
    use dynamics_core::{Core, robots::Panda};
    struct Aslant;
    impl Direction for Aslant {
        const UNIT: [f64; 3] = [0.48, 0.6, -0.64];
    }
    let at = State::at([0.3, -0.4, 0.2, -2.0, 0.3, 1.9, 0.5]);
    let g = glam::DVec3::from(Aslant::UNIT) * 9.81;
    let number = Core::<Panda>::rnea(&at, &(GravityVector::<f64>(g),));
    assert_eq!(number, Core::<Panda>::rnea(&at, &(Gravity::<Aslant>::new(9.81),)));
}
