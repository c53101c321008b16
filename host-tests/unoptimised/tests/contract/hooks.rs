//! Each hook acts under the constant that announces it and under no other, in core and engine alike; and whatever
//! passes effects on passes on all of them.

use super::*;
use dynamics_core::algorithms::{kinematics, kinetic_energy, momentum, potential_energy};
use dynamics_core::effects::{BodyState, Effect, Implicit, JointState, TorqueDerivatives};
use dynamics_core::model::Static;
use dynamics_core::scalar::{Matrix, Real, Vector};
use dynamics_core::spatial::{Force, Motion, SpatialInertia, Xform};
use dynamics_core::{Core, Engine};
use firmware_demo::scene::{Now, Told};

const FIELD: u32 = 1;
const ACCELERATIONS: u32 = 2;
const VELOCITY_PRODUCTS: u32 = 4;
const WRENCH: u32 = 8;
const BODY_VELOCITY: u32 = 16;
const BODY_POSE: u32 = 32;
const BASE_MOTION: u32 = 64;
const PAYLOAD: u32 = 128;
const GYROSCOPIC_ROTORS: u32 = 256;
/// Of the field the x axis alone.
const ALONG_X: u32 = 512;

/// Has every hook, and of the constants those whose bits are set.
#[derive(Clone, Copy)]
struct All<const FLAGS: u32>;

const fn has(flags: u32, flag: u32) -> bool {
    flags & flag != 0
}

impl<R: Real, const FLAGS: u32, const B: usize, const V: usize> Effect<R, B, V> for All<FLAGS> {
    const FIELD: bool = has(FLAGS, FIELD);
    const FIELD_AXES: [bool; 3] = {
        let rest = !has(FLAGS, ALONG_X);
        [true, rest, rest]
    };
    const ACCELERATIONS: bool = has(FLAGS, ACCELERATIONS);
    const VELOCITY_PRODUCTS: bool = has(FLAGS, VELOCITY_PRODUCTS);
    const WRENCH: bool = has(FLAGS, WRENCH);
    const BODY_VELOCITY: bool = has(FLAGS, BODY_VELOCITY);
    const BODY_POSE: bool = has(FLAGS, BODY_POSE);
    const BASE_MOTION: bool = has(FLAGS, BASE_MOTION);
    const PAYLOAD: [bool; B] = [has(FLAGS, PAYLOAD); B];
    const GYROSCOPIC_ROTORS: bool = has(FLAGS, GYROSCOPIC_ROTORS);

    fn payload(&self, body: usize, inertia: &mut SpatialInertia<R>) {
        inertia.mass += of(0.5 + body as f64);
        inertia.first_moment += vec3::<R>(0.1, 0.2, -0.3);
        let (x, y) = (vec3::<R>(0.5, 0.1, 0.0), vec3::<R>(0.1, 0.6, 0.0));
        inertia.inertia += R::Mat3::from_cols(x, y, vec3::<R>(0.0, 0.0, 0.7));
    }
    fn field(&self, g: &mut R::Vec3) {
        *g += vec3::<R>(1.0, -2.0, -9.0);
    }
    fn base(&self, velocity: &mut Motion<R>, acceleration: &mut Motion<R>) {
        *velocity += Motion::new(vec3::<R>(0.1, 0.4, -0.2), vec3::<R>(1.0, 0.5, -0.3));
        *acceleration += Motion::new(vec3::<R>(-1.0, 0.4, 2.0), vec3::<R>(0.6, -1.5, 0.3));
    }
    fn wrench(&self, body: usize, at: &BodyState<R>, fx: &mut Force<R>) {
        let push = vec3::<R>(1.5, body as f64, -0.5) - at.velocity.lin;
        *fx += Force::new(at.pose.rot * at.velocity.ang + at.pose.pos, push);
    }
    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        *tau += of::<R>(2.0) * at.q + of::<R>(0.3) * at.qd + of::<R>(0.1 + joint as f64) * at.qdd;
    }
    fn derivatives(&self, joint: usize, _: JointState<R>, derivatives: &mut TorqueDerivatives<R>) {
        derivatives.dq += of(2.0 + joint as f64);
        derivatives.dqd += of(0.3);
    }
    fn advance(&mut self, _: usize, _: JointState<R>, _: R) {}
    fn inertia(&self, joint: usize, diagonal: &mut R) {
        *diagonal += of(0.1 + joint as f64);
    }
    fn spin(&self, joint: usize, coupling: &mut R) {
        *coupling += of(0.05 + 0.1 * joint as f64);
    }
}

fn of<R: Real>(x: f64) -> R {
    R::from_f64(x)
}

fn vec3<R: Real>(x: f64, y: f64, z: f64) -> R::Vec3 {
    R::Vec3::new(of(x), of(y), of(z))
}

/// What joint hooks alone add, which no constant announces.
fn at_joints() -> [f64; 3] {
    let State { q, qd, qdd } = MOVING;
    std::array::from_fn(|i| 2.0 * q[i] + 0.3 * qd[i] + (0.1 + i as f64) * qdd[i])
}

/// Core and engine, which have to agree.
#[track_caller]
fn torques<E: Effect<f64, 6, 3>>(scene: &E) -> [f64; 3] {
    let core = Core::<TwoHands>::rnea(&MOVING, scene);
    let engine = Engine::<TwoHands>::rnea(&MOVING, scene);
    close(&engine, &core, 2e-15);
    core
}

fn core<const FLAGS: u32>() -> [f64; 3] {
    Core::<TwoHands>::rnea(&MOVING, &All::<FLAGS>)
}

/// Under these constants the same in core and engine, and only joint hooks act.
#[track_caller]
fn idle<const FLAGS: u32>() {
    assert_eq!(torques(&All::<FLAGS>), at_joints());
}

/// Under these constants the same in core and engine, and more than joint hooks.
#[track_caller]
fn acting<const FLAGS: u32>() -> [f64; 3] {
    let tau = torques(&All::<FLAGS>);
    let mut more = tau.into_iter().zip(at_joints());
    assert!(
        more.any(|(tau, joint)| (tau - joint).abs() > 0.1),
        "{tau:?}"
    );
    tau
}

#[test]
fn hooks_whose_constants_are_not_set_are_not_called() {
    idle::<0>();
    idle::<ALONG_X>();
    let (none, robot) = (All::<{ ALONG_X }>, Static::<TwoHands>::NEW);
    assert_eq!(potential_energy(&robot, &MOVING.q, &none), 0.0);
    let joints: f64 = (0..3)
        .map(|i| (0.1 + i as f64) * MOVING.qd[i].powi(2) / 2.0)
        .sum();
    assert!(
        (kinetic_energy(&robot, &MOVING, &()) + joints - kinetic_energy(&robot, &MOVING, &none))
            .abs()
            < 1e-14
    );
    assert_eq!(
        momentum(&robot, &MOVING, &none),
        momentum(&robot, &MOVING, &())
    );
    let base = kinematics(&robot, &MOVING, &none);
    let rest = kinematics(&robot, &MOVING, &());
    assert_eq!(base.velocities, rest.velocities);
    assert_eq!(base.accelerations, rest.accelerations);
}

#[test]
fn a_constant_alone_lets_its_own_hook_act_in_core_and_engine() {
    acting::<FIELD>();
    acting::<ACCELERATIONS>();
    acting::<VELOCITY_PRODUCTS>();
    acting::<WRENCH>();
    acting::<BASE_MOTION>();
    // What reads nothing, and inertia that nothing accelerates, are no torques.
    idle::<BODY_VELOCITY>();
    idle::<BODY_POSE>();
    idle::<PAYLOAD>();
    assert_ne!(acting::<{ FIELD | ALONG_X }>(), acting::<FIELD>());
}

/// All that the engine has.
const ENGINE: u32 = FIELD
    | ACCELERATIONS
    | VELOCITY_PRODUCTS
    | WRENCH
    | BODY_VELOCITY
    | BODY_POSE
    | BASE_MOTION
    | PAYLOAD;

#[test]
fn under_all_constants_every_one_of_them_counts() {
    let all = acting::<ENGINE>();
    // The engine agrees one constant at a time and under all of them.
    let less = [
        core::<{ ENGINE ^ FIELD }>(),
        core::<{ ENGINE ^ ACCELERATIONS }>(),
        core::<{ ENGINE ^ VELOCITY_PRODUCTS }>(),
        core::<{ ENGINE ^ WRENCH }>(),
        core::<{ ENGINE ^ BODY_VELOCITY }>(),
        core::<{ ENGINE ^ BODY_POSE }>(),
        core::<{ ENGINE ^ BASE_MOTION }>(),
        core::<{ ENGINE ^ PAYLOAD }>(),
    ];
    for less in less {
        assert!((less[0] - all[0]).abs() > 0.01, "{less:?} and {all:?}");
    }
    // GyroscopicRotors that spin are the core's alone.
    let spinning = core::<{ ENGINE | GYROSCOPIC_ROTORS }>();
    assert!((spinning[0] - all[0]).abs() > 0.01);
}

/// What a scene says of itself and what its hooks add, in numbers.
fn seen<R: Real, E: Effect<R, 6, 3>>(scene: &E) -> Vec<f64> {
    let flags = [
        E::FIELD,
        E::ACCELERATIONS,
        E::VELOCITY_PRODUCTS,
        E::WRENCH,
        E::BODY_VELOCITY,
        E::BODY_POSE,
        E::BASE_MOTION,
        E::GYROSCOPIC_ROTORS,
    ];
    let mut seen = vec![of::<R>(E::GRAVITIES as f64)];
    let flags = [&flags[..], &E::FIELD_AXES, &E::PAYLOAD].concat();
    seen.extend(
        flags
            .into_iter()
            .map(|flag| of::<R>(f64::from(u8::from(flag)))),
    );
    let mut load = SpatialInertia::ZERO;
    scene.payload(2, &mut load);
    seen.push(load.mass);
    seen.extend(load.first_moment.array());
    seen.extend(load.inertia.cols().map(Vector::array).as_flattened());
    let mut g = R::Vec3::ZERO;
    scene.field(&mut g);
    seen.extend(g.array());
    let (mut v, mut a, mut fx) = (Motion::ZERO, Motion::ZERO, Force::ZERO);
    scene.base(&mut v, &mut a);
    let at = BodyState {
        pose: Xform::IDENTITY,
        velocity: v,
        base: Some(v),
    };
    scene.wrench(2, &at, &mut fx);
    seen.extend(
        [v.ang, v.lin, a.ang, a.lin, fx.ang, fx.lin]
            .map(Vector::array)
            .as_flattened(),
    );
    let at = JointState {
        q: of(0.3),
        qd: of(-0.7),
        qdd: of(0.0),
    };
    let (mut tau, mut derivatives) = (R::ZERO, TorqueDerivatives::default());
    let (mut diagonal, mut coupling) = (R::ZERO, R::ZERO);
    scene.torque(1, at, &mut tau);
    scene.derivatives(1, at, &mut derivatives);
    scene.inertia(1, &mut diagonal);
    scene.spin(1, &mut coupling);
    seen.extend([tau, derivatives.dq, derivatives.dqd, diagonal, coupling]);
    seen.into_iter().map(R::to_f64).collect()
}

type Every = All<{ ENGINE | GYROSCOPIC_ROTORS }>;

/// A law of the demo whose effects have every hook.
struct Law;

impl Told<(), 6, 3, 3> for Law {
    type Effects = Every;

    fn told((): &()) -> Every {
        All
    }
}

#[test]
fn whatever_passes_effects_on_passes_on_every_hook() {
    let direct = seen::<f32, _>(&All::<{ ENGINE | GYROSCOPIC_ROTORS }>);
    // All numbers differ from what is there without the effect.
    let none = seen::<f32, _>(&());
    let same = direct.iter().zip(&none).filter(|(a, b)| a == b).count();
    assert_eq!(same, 4, "{direct:?}"); // the entries of the inertia that are zero
    assert_eq!(
        seen::<f32, _>(&((), (All::<{ ENGINE | GYROSCOPIC_ROTORS }>,))),
        direct
    );
    assert_eq!(seen::<f32, _>(&Now::<Law, (), 3>::of(&())), direct);

    // A step of no length changes nothing, and gives no derivatives of its own away.
    let (robot, all) = (
        Static::<TwoHands>::NEW,
        All::<{ ENGINE | GYROSCOPIC_ROTORS }>,
    );
    let mut implicit = seen::<f64, _>(&Implicit::new(&robot, &MOVING, &all, 0.0));
    let mut direct = seen::<f64, _>(&all);
    for derivatives in [&mut implicit, &mut direct] {
        let at = derivatives.len() - 4;
        derivatives[at..at + 2].fill(0.0);
    }
    assert_eq!(implicit, direct);

    // Forward dynamics takes the bias of all of them.
    let tau = Core::<TwoHands>::rnea(&MOVING, &All::<ENGINE>);
    let [core, engine] = [
        Core::<TwoHands>::forward_dynamics(&MOVING, &tau, &All::<ENGINE>),
        Engine::<TwoHands>::forward_dynamics(&MOVING, &tau, &All::<ENGINE>),
    ];
    close(&core.expect("M is positive"), &MOVING.qdd, 1e-14);
    close(&engine.expect("M is positive"), &MOVING.qdd, 1e-14);
}

/// The names of the constants and functions that a source declares, each once.
fn declared(source: &str) -> Vec<&str> {
    let mut names: Vec<&str> = source
        .lines()
        .filter_map(|line| {
            let line = line.trim_start();
            let rest = line.strip_prefix("const ").or(line.strip_prefix("fn "))?;
            let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_')?;
            Some(&rest[..end])
        })
        .filter(|name| !["R", "fn"].contains(name))
        .collect();
    names.sort_unstable();
    names.dedup();
    names
}

#[test]
fn a_hook_or_constant_that_is_added_is_passed_on_everywhere() {
    let effects = include_str!("../../../../dynamics-core/src/effects/mod.rs");
    let (_, the_trait) = effects
        .split_once("pub trait Effect<")
        .expect("the trait is there");
    let all = declared(the_trait);
    assert!(all.len() >= 20, "{all:?}");
    let missing = |source: &str| -> Vec<&str> {
        let found = declared(source);
        all.iter()
            .copied()
            .filter(|name| !found.contains(name))
            .collect()
    };
    let none: [&str; 0] = [];
    assert_eq!(
        missing(include_str!(
            "../../../../dynamics-core/src/effects/tuple.rs"
        )),
        none
    );
    // What a wrapper is there to change, and what belongs to the effects themselves.
    let own = [
        "ACCELERATIONS",
        "advance",
        "inertia",
        "derivatives",
        "torque",
    ];
    assert_eq!(
        missing(include_str!(
            "../../../../dynamics-core/src/effects/delegate.rs"
        )),
        own
    );
    // Effects that are made anew each time remember nothing.
    assert_eq!(
        missing(include_str!("../../../../firmware-demo/src/scene/now.rs")),
        ["advance"]
    );
    // The effect of this test; `GRAVITIES` follows from `FIELD`.
    assert_eq!(missing(include_str!("hooks.rs")), ["GRAVITIES"]);
    assert_eq!(missing("const FIELD: bool = true;").len(), all.len() - 1);
}
