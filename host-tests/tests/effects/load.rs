//! Friction of gears that depends on the transmitted torque: sign, symmetry, passivity, efficiency,
//! and the forward dynamics that solve for it. The oracles are the models of Duclusaud et al.
//! (2025) as they are published, iterated, and closed forms of a hoist.

use super::*;
use dynamics_core::algorithms::{self, hybrid_dynamics, rnea};
use dynamics_core::effects::{
    Armature, Coulomb, Gravity, Implicit, Inertia, LoadFriction, RIGID_BODY, Viscous, Width,
};
use dynamics_core::model::Robot;
use dynamics_core::robots::Ur5e;
use dynamics_core::sim::linearly_implicit;
use dynamics_core::{Core, Engine};
use host_tests::measured::largest;
use host_tests::random::{random_numbers, within};
use proptest::prelude::RngExt;

/// 2 kg on a vertical rail along z, moved by a screw.
const HOIST: ArmModel<f64, 1> =
    Model::new("hoist", [Body::new("load", BASE, Joint::prismatic([0.0, 0.0, 1.0])).mass(2.0)]);
const WEIGHT: f64 = 2.0 * 9.81;

/// An XL330's gears below 2.9 rad/s, by better-actuator-models 1.0.2, params/xl330/m6.json:
/// `load_friction_motor` and `load_friction_external_stribeck`.
const XL330: [f64; 2] = [0.2667860954283698, 0.08077928978935671];

fn gears<R: Real, const N: usize>(
    driving: f64,
    backdriving: f64,
    width: f64,
) -> LoadFriction<R, N> {
    LoadFriction {
        driving: [R::from_f64(driving); N],
        backdriving: [R::from_f64(backdriving); N],
        width: Width::new(R::from_f64(width)),
    }
}

/// The force of the hoist's motor at this speed and acceleration, without gravity.
fn force(gears: &LoadFriction<f64, 1>, qd: f64, qdd: f64) -> f64 {
    let state = State { q: [0.0], qd: [qd], qdd: [qdd] };
    rnea(&HOIST, &state, &(Inertia, *gears))[0]
}

#[test]
fn load_friction_opposes_motion_and_is_odd_bit_by_bit() {
    let mut rng = random_numbers();
    for _ in 0..10_000 {
        let [driving, backdriving, width] =
            [0.0..3.0, 0.0..1.0, 1e-3..1.0].map(|range| rng.random_range(range));
        let gears = gears(driving, backdriving, width);
        let [qd, qdd] = [2.0 * width, 10.0].map(|bound| rng.random_range(-bound..bound));
        let friction = force(&gears, qd, qdd) - 2.0 * qdd;
        // One rounding of the sum may leave as much against the motion as it is long.
        let rounding = 2.0 * f64::EPSILON * (2.0 * qdd).abs();
        assert!(friction * qd.signum() >= -rounding, "{qd} {qdd}: {friction}");
        assert_eq!(force(&gears, -qd, -qdd), -force(&gears, qd, qdd));
        assert_eq!(force(&gears, 0.0, qdd), 2.0 * qdd);
        assert_eq!(force(&gears, qd, 0.0), 0.0);
    }
}

#[test]
fn load_friction_solves_the_published_directional_model() {
    // F = |k_m τ_m − k_e τ_e|, τ_e = −τ the external torque and τ_m = τ + F sgn q̇: iterated from F
    // = 0.
    let [k_m, k_e] = XL330;
    let gears = LoadFriction::of_motor_and_load([k_m], [k_e], Width::new(1e-3));
    for (load, qd) in [(3.0, 1.0), (3.0, -1.0), (-0.7, 1.0), (-0.7, -1.0)] {
        let mut motor: f64 = load;
        for _ in 0..100 {
            motor = load + (k_m * motor + k_e * load).abs() * f64::signum(qd);
        }
        let got = force(&gears, qd, load / 2.0);
        assert!((got - motor).abs() < 8.0 * f64::EPSILON * motor.abs(), "{got} {motor}");
    }
}

#[test]
fn a_hoist_accelerates_by_the_efficiency_of_its_gear() {
    // Up: m (q̈ + g) = x / (1 + μ₁); down: m (q̈ + g) = x / (1 − μ₂), at any force x of the motor.
    let scene = (RIGID_BODY, gears::<f64, 1>(0.25, 0.2, 1e-3));
    let mut worst = Worst::default();
    for x in [0.1, 0.5, 0.9, 1.1, 3.0].map(|share| share * WEIGHT) {
        for (qd, efficiency) in [(1.0, 1.0 / 1.25), (-1.0, 1.0 / 0.8)] {
            let state = State { qd: [qd], ..State::at([0.0]) };
            let got = algorithms::aba(&HOIST, &state, &[x], &scene).unwrap();
            worst.see(got[0], x * efficiency / 2.0 - 9.81);
            // Drawn down, x and the load change their signs, and with them what drives.
            let down = algorithms::aba(&HOIST, &state, &[-x], &scene).unwrap();
            let efficiency = if qd > 0.0 { 1.0 / 0.8 } else { 1.0 / 1.25 };
            worst.see(down[0], -x * efficiency / 2.0 - 9.81);
        }
    }
    worst.check::<f64>("hoist", "acceleration by efficiency");
}

#[test]
fn between_the_two_efficiencies_the_load_is_held_without_chatter() {
    // m g (1 − μ₂) < x < m g (1 + μ₁): it creeps at a speed below the width, where x = m g (1 + m s
    // + d s²).
    let (even, odd, width) = (0.225, 0.025, 1e-4);
    for share in [0.85, 0.95, 1.05, 1.2] {
        let mut scene = (RIGID_BODY, gears::<f64, 1>(0.25, 0.2, width));
        let mut state = State::at([0.0]);
        let (mut last, mut turned) = (0.0_f64, 0.0_f64);
        for _ in 0..2000 {
            linearly_implicit(&HOIST, &mut state, &[share * WEIGHT], &mut scene, 1e-3).unwrap();
            let speed = state.qd[0].abs();
            turned = largest([turned, last - speed]);
            last = speed;
        }
        let s = {
            let rest = share - 1.0;
            (-even + (even * even + 4.0 * odd * rest).sqrt()) / (2.0 * odd)
        };
        let slip = width * 2.0 * (s.asin() / 3.0).sin();
        assert!((state.qd[0] - slip).abs() < 1e-9 * width, "{share}: {:?} {slip}", state.qd);
        assert!(turned < 1e-9 * width, "{share}: {turned}");
    }
    // Beyond them it is not.
    for (share, way) in [(0.79, -1.0), (1.26, 1.0)] {
        let mut scene = (RIGID_BODY, gears::<f64, 1>(0.25, 0.2, width));
        let mut state = State::at([0.0]);
        for _ in 0..2000 {
            linearly_implicit(&HOIST, &mut state, &[share * WEIGHT], &mut scene, 1e-3).unwrap();
        }
        assert!(state.qd[0] * way > 0.1, "{share}: {:?}", state.qd);
    }
}

#[test]
fn the_implicit_step_has_the_derivative_of_the_acceleration() {
    // q̈ of the implicit step is q̈ / (1 − h ∂q̈/∂q̇), its derivative that of aba by central
    // differences.
    let gears = gears::<f64, 1>(0.4, 0.3, 0.5);
    let scene = (RIGID_BODY, gears);
    let aba = |qd: f64, x: f64| {
        let state = State { qd: [qd], ..State::at([0.0]) };
        algorithms::aba(&HOIST, &state, &[x], &scene).unwrap()[0]
    };
    let (h, step) = (1e-2, 1e-5);
    for (qd, x) in [(0.1, 30.0), (0.1, -30.0), (-0.3, 10.0), (-0.2, -25.0), (0.7, 20.0)] {
        let slope = (aba(qd + step, x) - aba(qd - step, x)) / (2.0 * step);
        let state = State { qd: [qd], ..State::at([0.0]) };
        let implicit = Implicit::under(&HOIST, &state, &scene, &[x], h);
        let got = algorithms::aba(&HOIST, &state, &[x], &implicit).unwrap()[0];
        let want = aba(qd, x) / (1.0 - h * slope);
        assert!((got - want).abs() < 1e-8 * want.abs(), "{qd} {x}: {got} {want}");
    }
}

/// A scene of every kind of friction, widths such that the smooth sign is in between.
fn scene<R: Real>() -> impl Effect<R, 6, 6> {
    let of = R::from_f64;
    (
        RIGID_BODY,
        Viscous([of(1.5); 6]),
        Coulomb { torque: [of(3.0); 6], width: Width::new(of(0.5)) },
        Armature([of(0.7); 6]),
        gears::<R, 6>(0.4, 0.3, 1.5),
    )
}

#[test]
fn forward_dynamics_of_core_and_engine_solve_for_load_friction() {
    let (scene, mut rng) = (scene::<f64>(), random_numbers());
    let mut worst = Worst::default();
    for _ in 0..1000 {
        let [q, qd, qdd] = [3.1, 3.0, 10.0].map(|bound| within::<6>(&mut rng, bound));
        let state = State { q, qd, qdd };
        let tau = Core::<Ur5e>::rnea(&state, &scene);
        let engine = Engine::<Ur5e>::rnea(&state, &scene);
        for (engine, core) in engine.iter().zip(tau) {
            assert!((engine - core).abs() < 1e-12, "{engine} {core}");
        }
        let all = [
            Core::<Ur5e>::aba(&state, &tau, &scene),
            Core::<Ur5e>::forward_dynamics(&state, &tau, &scene),
            Engine::<Ur5e>::aba(&state, &tau, &scene),
            Engine::<Ur5e>::forward_dynamics(&state, &tau, &scene),
        ];
        for got in all {
            worst.see_all(&got.unwrap(), &qdd);
        }
        // With every second joint's motion given.
        let given: [_; 6] = std::array::from_fn(|i| {
            if i % 2 == 0 {
                algorithms::Prescribed::Torque(tau[i])
            } else {
                algorithms::Prescribed::Acceleration(qdd[i])
            }
        });
        let hybrid = hybrid_dynamics(&Ur5e::MODEL, &state, &given, &scene).unwrap();
        worst.see_all(&hybrid.qdd, &qdd);
        for (got, want) in hybrid.tau.iter().zip(tau) {
            assert!((got - want).abs() < 1e-9 * (1.0 + want.abs()), "{got} {want}");
        }
    }
    worst.check::<f64>("ur5e", "forward dynamics under load friction");
}

#[test]
fn gears_take_power_from_every_joint_of_an_arm() {
    // The power that motors spend beyond what all else takes, joint by joint.
    let mut rng = random_numbers();
    let gears = gears::<f64, 6>(0.4, 0.3, 0.5);
    for _ in 0..1000 {
        let [q, qd, qdd] = [3.1, 3.0, 10.0].map(|bound| within::<6>(&mut rng, bound));
        let state = State { q, qd, qdd };
        let without = Core::<Ur5e>::rnea(&state, &RIGID_BODY);
        let with = Core::<Ur5e>::rnea(&state, &(RIGID_BODY, gears));
        for joint in 0..6 {
            let (more, load) = (with[joint] - without[joint], without[joint].abs());
            assert!(more * qd[joint] >= -4.0 * f64::EPSILON * load * qd[joint].abs());
            // Beyond the width no less than the smaller share of the load.
            if qd[joint].abs() > 0.5 {
                assert!(more.abs() >= 0.3 * load * (1.0 - 1e-12), "{more} {load}");
            }
        }
    }
}

#[test]
fn a_self_locking_gear_has_no_forward_dynamics() {
    // A worm gear held by friction: no smooth sign has the torque that it takes.
    let scene = (Gravity::EARTH, Inertia, gears::<f64, 1>(1.5, 1.0, 1e-3));
    let down = State { qd: [-1.0], ..State::at([0.0]) };
    let got = algorithms::aba(&HOIST, &down, &[5.0], &scene);
    assert!(got.is_ok_and(|qdd| !qdd[0].is_finite()));
    assert!(rnea(&HOIST, &down, &scene)[0].is_finite());
    // While the motor drives it down, it has.
    let qdd = algorithms::aba(&HOIST, &down, &[-50.0], &scene).expect("a mass");
    let [tau] = rnea(&HOIST, &State { qdd, ..down }, &scene);
    assert!((tau + 50.0).abs() < 1e-12, "{tau}");
}
