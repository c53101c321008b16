//! Wrenches, contact and a moving base: Pinocchio's recordings, and closed forms.

use super::*;
use dynamics_core::algorithms::{frame, kinematics};
use dynamics_core::effects::{
    BodyWrench, Contact, ContactPoint, Gravity, GravityVector, Inertia, MovingBase, RIGID_BODY,
    Width, WorldWrench,
};
use dynamics_core::model::Robot;
use dynamics_core::robots::Panda;
use dynamics_core::scalar::Vector;
use dynamics_core::sim::semi_implicit;
use dynamics_core::spatial::{Force, Motion};
use dynamics_core::{Core, algorithms::rnea};
use glam::{DMat3, DVec3};
use host_tests::random::{random_numbers, within};
use host_tests::recordings::{columns, load, row};
use proptest::prelude::RngExt;

fn halves([a, b, c, d, e, f]: [f64; 6]) -> (DVec3, DVec3) {
    (DVec3::new(a, b, c), DVec3::new(d, e, f))
}

// The wrenches are in body and in world frames.
#[test]
fn wrenches_and_moving_bases_agree_with_pinocchio() {
    let r = load("panda");
    let [mut body, mut world, mut base] = [(); 3].map(|()| Worst::default());
    for i in 0..r.first_states() {
        let state = State { q: row::<7>(&r.q, i), qd: row(&r.qd, i), qdd: row(&r.qdd, i) };
        let poses = kinematics(&Panda::MODEL, &state, &()).poses;
        let f = columns::<7>(&r.wrenches, i).map(halves);
        let own = |k: usize| BodyWrench { body: k, wrench: Force::<f64>::new(f[k].0, f[k].1) };
        let turned = |k: usize| WorldWrench {
            body: k,
            wrench: Force::<f64>::new(poses[k].rot * f[k].0, poses[k].rot * f[k].1),
        };
        let want = row::<7>(&r.rnea_wrenches, i);
        let scene = (own(0), own(1), own(2), own(3), own(4), own(5), own(6));
        body.see_all(&Core::<Panda>::rnea(&state, &(RIGID_BODY, scene)), &want);
        let scene = (turned(0), turned(1), turned(2), turned(3), turned(4), turned(5), turned(6));
        world.see_all(&Core::<Panda>::rnea(&state, &(RIGID_BODY, scene)), &want);
        let [v, a] = [&r.base_velocity, &r.base_acceleration].map(|rows| halves(row(rows, i)));
        let moving = MovingBase::<f64> {
            velocity: Motion::new(v.0, v.1),
            acceleration: Motion::new(a.0, a.1),
        };
        let got = Core::<Panda>::rnea(&state, &(RIGID_BODY, moving));
        base.see_all(&got, &row::<7>(&r.rnea_moving_base, i));
        // The same from what an accelerometer at the origin would say.
        let point = MovingBase::<f64>::of_point(v.0, a.0, v.1, a.1 + v.0.cross(v.1));
        let again = Core::<Panda>::rnea(&state, &(RIGID_BODY, point));
        base.see_all(&again, &row::<7>(&r.rnea_moving_base, i));
    }
    body.check::<f64>("panda", "body wrenches");
    world.check::<f64>("panda", "world wrenches");
    base.check::<f64>("panda", "moving base");
}

#[test]
fn a_rolling_base_equals_a_prescribed_joint() {
    // A gimbal on a deck: the deck as a prescribed first joint, or as the moving base.
    let arm = |parent| {
        let (z, y) = ([0.0, 0.0, 1.0], [0.0, 1.0, 0.0]);
        let inner = if parent == BASE { 0 } else { parent + 1 };
        [
            Body::new("yoke", parent, Joint::revolute(z))
                .xyz([0.5, 0.2, 0.3])
                .mass(3.0)
                .com([0.0, 0.1, 0.1])
                .inertia([0.1, 0.0, 0.01, 0.1, 0.0, 0.08]),
            Body::new("camera", inner, Joint::revolute(y))
                .xyz([0.1, 0.0, 0.2])
                .mass(2.0)
                .com([0.1, 0.02, 0.0])
                .inertia([0.02, 0.0, 0.0, 0.03, 0.0, 0.04]),
        ]
    };
    let [yoke, camera] = arm(0);
    let deck = Body::new("deck", BASE, Joint::revolute([1.0, 0.0, 0.0]));
    let ship: ArmModel<f64, 3> = Model::new("ship", [deck, yoke, camera]);
    let gimbal: ArmModel<f64, 2> = Model::new("gimbal", arm(BASE));
    let (rng, mut worst) = (&mut random_numbers(), Worst::default());
    for _ in 0..200 {
        let [q, qd, qdd] = [2.0, 3.0, 5.0].map(|bound| within::<3>(rng, bound));
        let whole = State { q, qd, qdd };
        let want = rnea(&ship, &whole, &RIGID_BODY);
        let above = State { q: [q[1], q[2]], qd: [qd[1], qd[2]], qdd: [qdd[1], qdd[2]] };
        let roll = |rate: f64| Motion::<f64>::new(DVec3::X * rate, DVec3::ZERO);
        let base = MovingBase { velocity: roll(qd[0]), acceleration: roll(qdd[0]) };
        let tilt = DMat3::from_rotation_x(q[0]);
        let gravity = GravityVector::<f64>::tilted(tilt, DVec3::NEG_Z * 9.81);
        let (_, inertia, coriolis) = RIGID_BODY;
        let got = rnea(&gimbal, &above, &(gravity, inertia, coriolis, base));
        worst.see_all(&got, &[want[1], want[2]]);
    }
    worst.check::<f64>("gimbal", "rolling base");
}

fn ground<R: Real>(foot: [f64; 3]) -> Contact<R, 1> {
    let of = R::from_f64;
    Contact {
        points: [ContactPoint {
            body: 0,
            point: R::Vec3::new(of(foot[0]), of(foot[1]), of(foot[2])),
        }],
        normal: R::Vec3::new(R::ZERO, R::ZERO, R::ONE),
        height: R::ZERO,
        stiffness: of(2e4),
        damping: of(200.0),
        damping_depth: Width::new(of(1e-3)),
        friction: of(0.5),
        slip_tolerance: of(1e-3),
    }
}

// Its friction opposes slip.
#[test]
fn the_ground_never_pulls_nor_leaves_the_friction_cone() {
    fn holds<R: Real>() {
        let (ground, rng) = (ground::<R>([0.0; 3]), &mut random_numbers());
        for _ in 0..100_000 {
            let [x, y, z]: [f64; 3] = within(rng, 0.02);
            let fastest = 10.0_f64.powi(rng.random_range(-4..1));
            let [u, v, w]: [f64; 3] = within(rng, fastest);
            let vec = |x, y, z| R::Vec3::new(R::from_f64(x), R::from_f64(y), R::from_f64(z));
            let [fx, fy, fz] = ground.force(vec(x, y, z), vec(u, v, w)).array().map(R::to_f64);
            assert!(fz >= 0.0 && (z < 0.0 || fz == 0.0), "{fz} at {z}");
            assert!(fx.hypot(fy) <= 0.5 * fz * (1.0 + 1e-6), "{fx} {fy} {fz}");
            assert!(fx * u + fy * v <= 0.0);
            if u.hypot(v) > 0.1 && fz > 0.0 {
                assert!(fx.hypot(fy) > 0.4999 * fz, "all of it when it slides");
            }
        }
    }
    holds::<f32>();
    holds::<f64>();
}

#[test]
fn a_resting_bodys_depth_is_weight_over_stiffness() {
    let weight: ArmModel<f64, 1> = Model::new(
        "weight",
        [Body::new("weight", BASE, Joint::prismatic([0.0, 0.0, 1.0])).mass(3.0)],
    );
    let scene = (Gravity::EARTH, Inertia, ground::<f64>([0.2, 0.1, -0.4]));
    let mut state = State::at([0.6]);
    for _ in 0..200_000 {
        semi_implicit(&weight, &mut state, &[0.0], &scene, 2e-5).unwrap();
    }
    let mut worst = Worst::default();
    worst.see(0.4 - state.q[0], 3.0 * 9.81 / 2e4);
    worst.check::<f64>("weight", "depth on the ground");
}

#[test]
fn a_box_on_a_slope_follows_coulombs_law() {
    // A free body on two turned planes: 0.3 rad slides at g (sin − μ cos), 0.2 rad holds but for
    // slip_tolerance.
    let slab: Model<f64, 1, 7, 6> = Model::new(
        "slab",
        [Body::new("slab", BASE, Joint::free())
            .mass(2.0)
            .inertia([0.02, 0.0, 0.0, 0.02, 0.0, 0.03])],
    );
    let run = |slope: f64, friction: f64| {
        let flat = ground::<f64>([0.0; 3]);
        let corner = |x: f64, y: f64| ContactPoint { body: 0, point: DVec3::new(x, y, -0.02) };
        let ground = Contact::<f64, 4> {
            points: [corner(0.2, 0.2), corner(-0.2, 0.2), corner(0.2, -0.2), corner(-0.2, -0.2)],
            normal: flat.normal,
            height: 0.0,
            stiffness: flat.stiffness,
            damping: flat.damping,
            damping_depth: flat.damping_depth,
            friction,
            slip_tolerance: flat.slip_tolerance,
        };
        // The slope is level, gravity is not.
        let gravity = GravityVector::<f64>(DVec3::new(slope.sin(), 0.0, -slope.cos()) * 9.81);
        let scene = (gravity, RIGID_BODY.1, RIGID_BODY.2, ground);
        let mut state = State::at([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.02]);
        let mut speed = [0.0; 2];
        for i in 0..40_000 {
            semi_implicit(&slab, &mut state, &[0.0; 6], &scene, 5e-5).unwrap();
            if i == 19_999 {
                speed[0] =
                    kinematics(&slab, &state, &()).velocity(0, frame::LocalWorldAligned).lin.x;
            }
        }
        speed[1] = kinematics(&slab, &state, &()).velocity(0, frame::LocalWorldAligned).lin.x;
        speed
    };
    let [first, second] = run(0.4, 0.3);
    let mut worst = Worst::default();
    worst.see(second - first, 9.81 * (0.4_f64.sin() - 0.3 * 0.4_f64.cos()));
    worst.check::<f64>("slab", "sliding down a slope");
    // μ = 0.5 > tan 0.2: it creeps at w tan / √(μ² − tan²).
    let tan = 0.2_f64.tan();
    let mut worst = Worst::default();
    worst.see(run(0.2, 0.5)[1], 1e-3 * tan / (0.25 - tan * tan).sqrt());
    worst.check::<f64>("slab", "slip_tolerance on a slope");
}
