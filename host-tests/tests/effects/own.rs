//! A user's own effect, written as a user would, in core, engine and plant; and every effect in the
//! engine.

use super::*;
use dynamics_core::algorithms::kinetic_energy;
use dynamics_core::effects::{
    AsymmetricCoulomb, BodyWrench, Cogging, Contact, ContactPoint, Coriolis, EndStops,
    GravityVector, Inertia, LoadFriction, Lugre, MovingBase, RIGID_BODY, Spring, Stribeck, Width,
    WorldWrench, hook,
};
use dynamics_core::model::Robot;
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::Vector;
use dynamics_core::sim::linearly_implicit;
use dynamics_core::spatial::{Force, Motion};
use dynamics_core::{Core, Engine};
use glam::DVec3;
use host_tests::everyday_or_full;
use host_tests::measured::largest;
use host_tests::random::{random_numbers, within};
use host_tests::stress_robot::StressRobot;

/// A cable pack tied to one point of a link and dragged along behind it: fˣ = −c v of that point.
#[derive(Clone, Copy, Debug)]
struct CableDrag<R: Real> {
    body: usize,
    point: R::Vec3,
    drag: R,
}

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for CableDrag<R> {
    const EXTERNAL_WRENCH: hook::Wrench<Self, R> =
        hook::Wrench::of_velocity(|cable, body, at, fx| {
            if body == cable.body {
                let v = at.velocity.lin + at.velocity.ang.cross(cable.point);
                let f = v * -cable.drag;
                *fx += Force::new(cable.point.cross(f), f);
            }
        });
}

fn cable<R: Real>() -> CableDrag<R> {
    let of = R::from_f64;
    CableDrag { body: 3, point: R::Vec3::new(of(0.05), of(-0.1), of(0.02)), drag: of(7.0) }
}

#[test]
fn a_cables_drag_acts_as_the_same_wrench() {
    use dynamics_core::algorithms::{frame, kinematics};
    let (cable, rng) = (cable::<f64>(), &mut random_numbers());
    for _ in 0..100 {
        let [q, qd, qdd] = [3.0, 3.0, 10.0].map(|bound| within::<6>(rng, bound));
        let state = State { q, qd, qdd };
        let v = kinematics(&Ur5e::MODEL, &state, &()).velocity(3, frame::Local);
        let f = (v.lin + v.ang.cross(cable.point)) * -7.0;
        let same = BodyWrench { body: 3, wrench: Force::<f64>::new(cable.point.cross(f), f) };
        let got = Core::<Ur5e>::rnea(&state, &(RIGID_BODY, cable));
        let want = Core::<Ur5e>::rnea(&state, &(RIGID_BODY, same));
        for (got, want) in got.iter().zip(want) {
            assert!((got - want).abs() < 1e-12);
        }
    }
}

#[test]
fn a_cable_dissipates_energy_in_the_plant() {
    let (mut arm, h) = (State::at([0.3, -1.2, 1.0, 0.2, 0.4, 0.0]), 1e-4);
    arm.qd = [2.0, 1.0, -2.0, 1.0, 2.0, 3.0];
    let mut scene = (Inertia, Coriolis, cable::<f64>());
    let energy = |arm: &State<f64, 6, 6>| kinetic_energy(&Ur5e::MODEL, arm, &(Inertia,));
    let (start, mut last) = (energy(&arm), energy(&arm));
    for _ in 0..everyday_or_full(2_000, 4_000) {
        linearly_implicit(&Ur5e::MODEL, &mut arm, &[0.0; 6], &mut scene, h).unwrap();
        let now = energy(&arm);
        assert!(now < last + 1e-4 * start, "{now} after {last}");
        last = now;
    }
    assert!(last < 0.8 * start, "{last} of {start}");
}

/// Every effect that the engine takes and that its other tests do not.
// One of them is a user's own.
#[test]
fn engine_equals_core_under_the_remaining_effects() {
    fn ulps<R: Real>(ulp: f64) -> f64 {
        let of = R::from_f64;
        let scene = (
            (GravityVector(R::Vec3::new(of(1.0), of(-2.0), of(-9.5))), Inertia, Coriolis),
            AsymmetricCoulomb {
                forward: [of(4.0); 6],
                backward: [of(3.0); 6],
                width: Width::new(of(0.5)),
            },
            Stribeck {
                excess: [of(1.5); 6],
                stribeck_speed: Width::new(of(1.4)),
                width: Width::new(of(0.5)),
            },
            Lugre {
                stiffness: [of(300.0); 6],
                damping: [of(2.0); 6],
                viscous: [of(0.4); 6],
                sliding: [of(2.0); 6],
                excess: [of(1.0); 6],
                stribeck_speed: Width::new(of(2.0)),
                bristle: [of(0.003); 6],
            },
            Spring { stiffness: [of(5.0); 6], rest: [of(0.5); 6] },
            EndStops {
                lower: [of(-2.5); 6],
                upper: [of(2.5); 6],
                stiffness: of(40.0),
                damping: of(3.0),
                damping_depth: Width::new(of(0.1)),
            },
            Cogging { per_turn: [of(6.0); 6], cos: [[of(0.1)]; 6], sin: [[of(0.2)]; 6] },
            BodyWrench {
                body: 4,
                wrench: Force::new(
                    R::Vec3::new(of(1.0), of(2.0), of(3.0)),
                    R::Vec3::new(of(-3.0), of(5.0), of(4.0)),
                ),
            },
            cable::<R>(),
            LoadFriction {
                driving: [of(0.4); 6],
                backdriving: [of(0.3); 6],
                width: Width::new(of(0.5)),
            },
        );
        let rng = &mut random_numbers();
        let (mut worst, mut full_scale) = (0.0_f64, 0.0_f64);
        for _ in 0..everyday_or_full(2_000, 4_000) {
            let [q, qd, qdd] = [3.1, 3.0, 10.0].map(|bound| within::<6>(rng, bound));
            let state = cast::<R, 6>(&State { q, qd, qdd });
            let core = Core::<Ur5e>::rnea(&state, &scene);
            let engine = Engine::<Ur5e>::rnea(&state, &scene);
            for (core, engine) in core.into_iter().zip(engine) {
                worst = largest([worst, (core - engine).to_f64().abs()]);
                full_scale = full_scale.max(core.to_f64().abs());
            }
        }
        worst / (ulp * full_scale)
    }
    let (single, double) = (ulps::<f32>(f64::from(f32::EPSILON)), ulps::<f64>(f64::EPSILON));
    assert!(largest([single, double]) <= 4.0, "{single:.2}, {double:.2} ulp");
}

/// A base that moves, and what asks where bodies stand, on a tree with slides, welds and two roots.
#[test]
fn engine_equals_core_on_a_moving_base() {
    fn ulps<R: Real>(ulp: f64) -> [f64; 2] {
        let vec = |x, y, z| R::Vec3::new(R::from_f64(x), R::from_f64(y), R::from_f64(z));
        let of = R::from_f64;
        let base = MovingBase {
            velocity: Motion::new(vec(0.5, -0.3, 0.8), vec(0.2, 0.4, -0.6)),
            acceleration: Motion::new(vec(-1.0, 2.0, 0.7), vec(1.5, -2.0, 0.9)),
        };
        let foot = |body, x| ContactPoint { body, point: vec(x, -0.1, 0.2) };
        let ground = Contact {
            points: [foot(6, 0.1), foot(8, -0.2), foot(3, 0.3)],
            normal: vec(0.0, 0.6, 0.8),
            height: of(0.5),
            stiffness: of(60.0),
            damping: of(5.0),
            damping_depth: Width::new(of(0.3)),
            friction: of(0.4),
            slip_tolerance: of(0.5),
        };
        let wind =
            WorldWrench { body: 5, wrench: Force::new(vec(1.0, 2.0, -3.0), vec(5.0, -4.0, 2.0)) };
        let all = (RIGID_BODY, base, ground, wind);
        let slow = (RIGID_BODY.0, Inertia, base, wind);
        let rng = &mut random_numbers();
        let (mut worst, mut full_scale) = ([0.0_f64; 2], [0.0_f64; 2]);
        for _ in 0..everyday_or_full(2_000, 4_000) {
            let [q, qd, qdd] = [3.1, 3.0, 10.0].map(|bound| within::<7>(rng, bound));
            let state = cast::<R, 7>(&State { q, qd, qdd });
            let core =
                [Core::<StressRobot>::rnea(&state, &all), Core::<StressRobot>::rnea(&state, &slow)];
            let engine = [
                Engine::<StressRobot>::rnea(&state, &all),
                Engine::<StressRobot>::rnea(&state, &slow),
            ];
            for k in 0..2 {
                for (core, engine) in core[k].into_iter().zip(engine[k]) {
                    worst[k] = largest([worst[k], (core - engine).to_f64().abs()]);
                    full_scale[k] = full_scale[k].max(core.to_f64().abs());
                }
            }
        }
        [0, 1].map(|k| worst[k] / (ulp * full_scale[k]))
    }
    let (single, double) = (ulps::<f32>(f64::from(f32::EPSILON)), ulps::<f64>(f64::EPSILON));
    println!("{single:.2?} {double:.2?} ulp");
    // Friction of the ground is of the difference of two velocities, a body's and the base's, both
    // larger than it.
    for (ulps, most) in single.into_iter().chain(double).zip([6.0, 4.0, 6.0, 4.0]) {
        assert!(ulps <= most, "{single:.2?} {double:.2?} ulp");
    }
}

#[test]
fn effects_in_any_order_and_nesting_are_the_same_scene() {
    let state = State { q: [0.3; 6], qd: [0.5; 6], qdd: [1.0; 6] };
    let lift = BodyWrench { body: 5, wrench: Force::<f64>::new(DVec3::X, DVec3::Z) };
    let one = Core::<Ur5e>::rnea(&state, &(RIGID_BODY, (lift, (cable::<f64>(),))));
    let other = Core::<Ur5e>::rnea(&state, &(RIGID_BODY, lift, cable::<f64>()));
    assert_eq!(one, other);
}
