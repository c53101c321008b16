//! Each hook acts on its own, in core and engine alike; and whatever forwards effects forwards all
//! of their hooks.

use super::*;
use dynamics_core::algorithms::{kinematics, kinetic_energy, momentum, potential_energy};
use dynamics_core::effects::{
    BodyState, Effect, Implicit, JointState, LoadFactors, Once, RegroupedInertia,
    TorqueDerivatives, Viscous, hook,
};
use dynamics_core::model::Static;
use dynamics_core::scalar::{Matrix, Real, Vector};
use dynamics_core::spatial::{Force, Motion, SpatialInertia};
use dynamics_core::{Core, Engine};
use dynamics_core::{call_hook, delegate_effect};
use firmware_demo::scene::Without;
use std::cell::Cell;
use std::fmt::Debug;

/// A field, and no derivatives.
const FIELD: u32 = 1;
const ACCELERATIONS: u32 = 2;
const VELOCITY_PRODUCTS: u32 = 4;
const WRENCH: u32 = 8;
const BODY_VELOCITY: u32 = 16;
const BODY_POSE: u32 = 32;
const BASE_MOTION: u32 = 64;
const PAYLOAD: u32 = 128;
const GYROSCOPIC_ROTORS: u32 = 256;
/// The field along the x axis alone.
const ALONG_X: u32 = 512;
const ELASTICITY: u32 = 1024;
const LOAD_DEPENDENT: u32 = 2048;
/// Base parameters of another robot, so that no algorithm uses them.
const BASE_PARAMETERS: u32 = 4096;
/// The effect is of a kind that a scene contains at most once.
const ONCE: u32 = 8192;

/// Has every hook at joints, and of the others those whose bits are set.
#[derive(Clone, Copy, Debug)]
struct All<const FLAGS: u32>;

const fn has(flags: u32, flag: u32) -> bool {
    flags & flag != 0
}

impl<R: Real, const FLAGS: u32, const B: usize, const V: usize> Effect<R, B, V> for All<FLAGS> {
    const GRAVITY_FIELD: hook::Field<Self, R> = if has(FLAGS, FIELD) {
        let rest = !has(FLAGS, ALONG_X);
        hook::Field::gravity(field::<R, FLAGS>).along([true, rest, rest])
    } else {
        hook::Field::NONE
    };
    const ACCELERATIONS: bool = has(FLAGS, ACCELERATIONS);
    const VELOCITY_PRODUCTS: bool = has(FLAGS, VELOCITY_PRODUCTS);
    const ELASTICITY: bool = has(FLAGS, ELASTICITY);
    const DIFFERENTIABLE: bool = !has(FLAGS, FIELD) & !has(FLAGS, WRENCH);
    const ONCE: Once =
        if has(FLAGS, ONCE) { <Viscous<R, V> as Effect<R, B, V>>::ONCE } else { Once::NONE };
    const EXTERNAL_WRENCH: hook::Wrench<Self, R> =
        match (has(FLAGS, WRENCH), has(FLAGS, BODY_POSE), has(FLAGS, BODY_VELOCITY)) {
            (false, ..) => hook::Wrench::NONE,
            (_, false, false) => hook::Wrench::constant(|_, body, fx| {
                fx.lin += push::<R>(body);
            }),
            (_, true, false) => hook::Wrench::of_pose(|_, body, pose, fx| {
                *fx += Force::new(pose.pos, push::<R>(body));
            }),
            (_, false, true) => hook::Wrench::of_velocity(|_, body, at, fx| {
                *fx += Force::new(at.velocity.ang, push::<R>(body) - at.velocity.lin);
            }),
            (_, true, true) => hook::Wrench::of_state(|_, body, at, fx| {
                let couple = at.pose.rot * at.velocity.ang + at.pose.pos;
                *fx += Force::new(couple, push::<R>(body) - at.velocity.lin);
            }),
        };
    const BASE: hook::Base<Self, R> = if has(FLAGS, BASE_MOTION) {
        hook::Base::moving(|_, velocity, acceleration| {
            *velocity += Motion::new(vec3::<R>(0.1, 0.4, -0.2), vec3::<R>(1.0, 0.5, -0.3));
            *acceleration += Motion::new(vec3::<R>(-1.0, 0.4, 2.0), vec3::<R>(0.6, -1.5, 0.3));
        })
    } else {
        hook::Base::NONE
    };
    const ADDED_INERTIA: hook::Inertia<Self, R, B> =
        hook::Inertia::on([has(FLAGS, PAYLOAD); B], |_, body, inertia| {
            inertia.mass += of(0.5 + body as f64);
            inertia.first_moment += vec3::<R>(0.1, 0.2, -0.3);
            let (x, y) = (vec3::<R>(0.5, 0.1, 0.0), vec3::<R>(0.1, 0.6, 0.0));
            inertia.rotational += R::Mat3::from_cols(x, y, vec3::<R>(0.0, 0.0, 0.7));
        });
    const ROTOR: hook::Rotor<Self, R> = if has(FLAGS, GYROSCOPIC_ROTORS) {
        hook::Rotor::coupling(|_, joint, coupling| *coupling += of(0.05 + 0.1 * joint as f64))
    } else {
        hook::Rotor::NONE
    };
    const LOAD_FRICTION: hook::LoadFriction<Self, R> = if has(FLAGS, LOAD_DEPENDENT) {
        hook::LoadFriction::new(
            |_, joint, at, factors| {
                factors.magnitude += of::<R>(0.2 + 0.1 * joint as f64) * at.qd;
                factors.torque += of::<R>(0.1) * at.q;
            },
            |_, joint, at, slopes| {
                slopes.magnitude += of::<R>(0.2 + 0.1 * joint as f64);
                slopes.torque += of::<R>(0.3) * at.qd;
            },
        )
    } else {
        hook::LoadFriction::NONE
    };

    const REGROUPED: hook::Regrouped<Self, R> = if has(FLAGS, BASE_PARAMETERS) {
        hook::Regrouped::loaded("another", regrouped)
    } else {
        hook::Regrouped::NONE
    };

    fn torque(&self, joint: usize, at: JointState<R>, tau: &mut R) {
        *tau += of::<R>(2.0 + joint as f64) * at.q + of::<R>(0.3) * at.qd;
    }
    fn derivatives(&self, joint: usize, _: JointState<R>, derivatives: &mut TorqueDerivatives<R>) {
        derivatives.dq += of(2.0 + joint as f64);
        derivatives.dqd += of(0.3);
    }
    fn slopes(&self, joint: usize, _: JointState<R>, slopes: &mut TorqueDerivatives<R>) {
        slopes.dq += of(2.5 + joint as f64);
        slopes.dqd += of(0.4);
    }
    fn advance(&mut self, joint: usize, at: JointState<R>, h: R) {
        ADVANCED.with(|sum| sum.set(sum.get() + joint as f64 + (at.q + at.qd + h).to_f64()));
    }
    fn inertia(&self, joint: usize) -> Option<R> {
        Some(of(0.1 + joint as f64))
    }
}

fn field<R: Real, const FLAGS: u32>(_: &All<FLAGS>, g: &mut R::Vec3) {
    *g += vec3::<R>(1.0, -2.0, -9.0);
}

fn regrouped<R, const FLAGS: u32>(_: &All<FLAGS>, joint: usize, _: &mut RegroupedInertia<R>) {
    LOADED.set(joint);
}

fn push<R: Real>(body: usize) -> R::Vec3 {
    vec3::<R>(1.5, body as f64, -0.5)
}

std::thread_local! {
    /// The arguments of `advance`.
    static ADVANCED: Cell<f64> = const { Cell::new(0.0) };
    /// The joint whose base parameters were loaded last.
    static LOADED: Cell<usize> = const { Cell::new(0) };
}

fn of<R: Real>(x: f64) -> R {
    R::from_f64(x)
}

fn vec3<R: Real>(x: f64, y: f64, z: f64) -> R::Vec3 {
    R::Vec3::new(of(x), of(y), of(z))
}

/// The terms of joint hooks alone.
fn at_joints() -> [f64; 3] {
    let State { q, qd, qdd } = MOVING;
    std::array::from_fn(|i| (2.0 + i as f64) * q[i] + 0.3 * qd[i] + (0.1 + i as f64) * qdd[i])
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

/// With these hooks the same in core and engine, and only those at joints act.
#[track_caller]
fn idle<const FLAGS: u32>() {
    assert_eq!(torques(&All::<FLAGS>), at_joints());
}

/// With these hooks the same in core and engine, and more than joint hooks.
#[track_caller]
fn acting<const FLAGS: u32>() -> [f64; 3] {
    let tau = torques(&All::<FLAGS>);
    let mut more = tau.into_iter().zip(at_joints());
    assert!(more.any(|(tau, joint)| (tau - joint).abs() > 0.1), "{tau:?}");
    tau
}

#[test]
fn absent_hooks_do_nothing() {
    idle::<0>();
    idle::<ALONG_X>();
    let (none, robot) = (All::<{ ALONG_X }>, Static::<TwoHands>::NEW);
    assert_eq!(potential_energy(&robot, &MOVING.q, &none), 0.0);
    let joints: f64 = (0..3).map(|i| (0.1 + i as f64) * MOVING.qd[i].powi(2) / 2.0).sum();
    assert!(
        (kinetic_energy(&robot, &MOVING, &()) + joints - kinetic_energy(&robot, &MOVING, &none))
            .abs()
            < 1e-14
    );
    assert_eq!(momentum(&robot, &MOVING, &none), momentum(&robot, &MOVING, &()));
    let base = kinematics(&robot, &MOVING, &none);
    let rest = kinematics(&robot, &MOVING, &());
    assert_eq!(base.velocities, rest.velocities);
    assert_eq!(base.accelerations, rest.accelerations);
}

#[test]
fn each_hook_acts_alone_in_core_and_engine() {
    acting::<FIELD>();
    acting::<ACCELERATIONS>();
    acting::<VELOCITY_PRODUCTS>();
    acting::<WRENCH>();
    acting::<BASE_MOTION>();
    acting::<LOAD_DEPENDENT>();
    // A hook whose results nobody reads and inertia without acceleration give no torques.
    idle::<BODY_VELOCITY>();
    idle::<BODY_POSE>();
    idle::<PAYLOAD>();
    // Nor is the elasticity of links that do not bend.
    idle::<ELASTICITY>();
    assert_ne!(acting::<{ FIELD | ALONG_X }>(), acting::<FIELD>());
}

/// Every hook that the engine supports.
const ENGINE: u32 = FIELD
    | ACCELERATIONS
    | VELOCITY_PRODUCTS
    | WRENCH
    | BODY_VELOCITY
    | BODY_POSE
    | BASE_MOTION
    | PAYLOAD
    | LOAD_DEPENDENT;

#[test]
fn each_hook_counts_among_all_others() {
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
        core::<{ ENGINE ^ LOAD_DEPENDENT }>(),
    ];
    for less in less {
        assert!((less[0] - all[0]).abs() > 0.01, "{less:?} and {all:?}");
    }
    // Only the core has rotors that spin as bodies.
    let spinning = core::<{ ENGINE | GYROSCOPIC_ROTORS }>();
    assert!((spinning[0] - all[0]).abs() > 0.01);
}

/// The declarations of hooks, in numbers, from their text: flags, counts and the lengths of names,
/// without the addresses of functions.
fn declarations(hooks: &str) -> Vec<f64> {
    hooks
        .split(|c: char| " ,()[]{}".contains(c))
        .filter_map(|word| match word {
            "true" => Some(1.0),
            "false" => Some(0.0),
            name if name.starts_with('"') => Some(name.len() as f64),
            number => number.parse().ok(),
        })
        .collect()
}

/// The constants of a scene and the contributions of its hooks, in numbers.
fn observed<R: Real, E: Effect<R, 6, 3> + Debug>(scene: &E) -> Vec<f64> {
    let flags = [
        E::ACCELERATIONS,
        E::VELOCITY_PRODUCTS,
        E::ELASTICITY,
        E::DIFFERENTIABLE,
        E::ONCE != Once::NONE,
    ];
    let mut numbers = flags.map(|flag| f64::from(u8::from(flag))).to_vec();
    let hooks = [
        format!("{:?}", E::GRAVITY_FIELD),
        format!("{:?}", E::BASE),
        // A wrench is that of the effect itself, or of an inner one.
        format!("{:?}", E::EXTERNAL_WRENCH)
            .replace("is_own: true, ", "")
            .replace("is_own: false, ", ""),
        format!("{:?}", E::ADDED_INERTIA),
        format!("{:?}", E::ROTOR),
        format!("{:?}", E::LOAD_FRICTION),
        format!("{:?}", E::REGROUPED),
    ];
    numbers.extend(declarations(&hooks.join(" ")));
    numbers.extend(added::<R, E>(scene).into_iter().map(R::to_f64));
    numbers
}

/// The terms of a scene's hooks.
fn added<R: Real, E: Effect<R, 6, 3>>(scene: &E) -> Vec<R> {
    let mut numbers = Vec::new();
    let mut load = SpatialInertia::ZERO;
    call_hook!(E::ADDED_INERTIA.add, scene, 2, &mut load);
    numbers.push(load.mass);
    numbers.extend(load.first_moment.array());
    numbers.extend(load.rotational.cols().map(Vector::array).as_flattened());
    let mut g = R::Vec3::ZERO;
    call_hook!(E::GRAVITY_FIELD.add, scene, &mut g);
    numbers.extend(g.array());
    let (mut v, mut a, mut fx) = (Motion::ZERO, Motion::ZERO, Force::ZERO);
    call_hook!(E::BASE.add, scene, &mut v, &mut a);
    let mut at = BodyState::REST;
    at.pose.pos = vec3::<R>(0.3, 0.4, 0.5);
    at.velocity = Motion::new(vec3::<R>(0.1, 0.2, 0.3), vec3::<R>(0.4, 0.5, 0.6));
    hook::add_wrench(scene, 2, &at, &mut fx);
    numbers.extend([v.ang, v.lin, a.ang, a.lin, fx.ang, fx.lin].map(Vector::array).as_flattened());
    let at = JointState::new(of(0.3), of(-0.7));
    let (mut tau, [mut derivatives, mut slopes_of_torque]) =
        (R::ZERO, [TorqueDerivatives::default(); 2]);
    let mut coupling = R::ZERO;
    scene.torque(1, at, &mut tau);
    scene.derivatives(1, at, &mut derivatives);
    scene.slopes(1, at, &mut slopes_of_torque);
    call_hook!(E::ROTOR.add, scene, 1, &mut coupling);
    let [mut factors, mut slopes] = [LoadFactors::default(); 2];
    call_hook!(E::LOAD_FRICTION.factors, scene, 1, at, &mut factors);
    call_hook!(E::LOAD_FRICTION.slopes, scene, 1, at, &mut slopes);
    for LoadFactors { magnitude, torque } in [factors, slopes] {
        numbers.extend([magnitude, torque]);
    }
    LOADED.set(0);
    call_hook!(E::REGROUPED.load, scene, 1, &mut RegroupedInertia::default());
    numbers.push(of(LOADED.get() as f64));
    let inertia = scene.inertia(1).unwrap_or(R::ZERO);
    for TorqueDerivatives { dq, dqd } in [derivatives, slopes_of_torque] {
        numbers.extend([dq, dqd]);
    }
    numbers.extend([tau, inertia, coupling]);
    numbers
}

/// The sum of all calls of a scene's `advance`.
fn advanced<E: Effect<f32, 6, 3>>(scene: &mut E) -> f64 {
    ADVANCED.set(0.0);
    scene.advance(1, JointState::new(0.25, 0.5), 0.125);
    ADVANCED.get()
}

type Every = All<{ ENGINE | GYROSCOPIC_ROTORS | ELASTICITY | BASE_PARAMETERS | ONCE }>;
const EVERY: Every = All;

/// A wrapper of a user's own.
#[derive(Debug)]
struct Wrapper(Every);

delegate_effect! {
    impl[] Effect<f32, 6, 3> for Wrapper, |this| { Every => this.0 }, advance
}

/// A wrapper that is there or not.
#[derive(Debug)]
struct Toggle<const ON: bool>(Every);

delegate_effect! {
    if ON, impl[const ON: bool] Effect<f32, 6, 3> for Toggle<ON>, |this| { Every => this.0 }, advance
}

#[test]
fn every_forwarder_forwards_every_hook() {
    let direct = observed::<f32, _>(&EVERY);
    // All numbers differ from what is there without the effect.
    let none = observed::<f32, _>(&());
    let same = direct.iter().zip(&none).filter(|(a, b)| a == b).count();
    assert_eq!(same, 4, "{direct:?}"); // the entries of the inertia that are zero
    assert_eq!(advanced(&mut { EVERY }), 1.875);

    assert_eq!(observed::<f32, _>(&((), (EVERY,))), direct);
    assert_eq!(advanced(&mut ((), (EVERY,))), 1.875);
    assert_eq!(observed::<f32, _>(&Wrapper(EVERY)), direct);
    assert_eq!(advanced(&mut Wrapper(EVERY)), 1.875);
    assert_eq!(observed::<f32, _>(&Toggle::<true>(EVERY)), direct);
    assert_eq!(advanced(&mut Toggle::<true>(EVERY)), 1.875);
    // The effects that the demo's laws leave out, and those that they keep.
    assert_eq!(observed::<f32, _>(&Without::<_, 0>(((), EVERY))), direct);
}

#[test]
fn a_forwarder_that_is_off_forwards_nothing() {
    assert_eq!(observed::<f32, _>(&Toggle::<false>(EVERY)), observed::<f32, _>(&()));
    assert_eq!(advanced(&mut Toggle::<false>(EVERY)), 0.0);
    assert_eq!(observed::<f32, _>(&Without::<_, 1>(((), EVERY))), observed::<f32, _>(&()));
}

#[test]
fn an_implicit_step_of_no_length_forwards_every_hook() {
    let robot = Static::<TwoHands>::NEW;
    let implicit = observed::<f64, _>(&Implicit::new(&robot, &MOVING, &EVERY, 0.0));
    let direct = observed::<f64, _>(&EVERY);
    assert_eq!(implicit, direct);
}

#[test]
fn forward_dynamics_inverts_inverse_dynamics_under_every_hook() {
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
        .filter(|name| !["", "R", "fn"].contains(name))
        .collect();
    names.sort_unstable();
    names.dedup();
    names
}

#[test]
fn every_added_hook_is_forwarded_and_tested() {
    let effects = include_str!("../../../dynamics-core/src/effects/mod.rs");
    let (_, the_trait) = effects.split_once("pub trait Effect<").expect("the trait is there");
    let (the_trait, _) = the_trait.split_once("\n}\n").expect("its end");
    let all = declared(the_trait);
    assert!(all.len() >= 11, "{all:?}");
    let missing = |source: &str| -> Vec<&str> {
        let found = declared(source);
        all.iter().copied().filter(|name| !found.contains(name)).collect()
    };
    let none: [&str; 0] = [];
    let forwarding = include_str!("../../../dynamics-core/src/effects/delegate.rs");
    assert_eq!(missing(forwarding), none);
    // The effect of this test.
    assert_eq!(missing(include_str!("hooks.rs")), none);
    assert_eq!(missing("fn torque(&self) {}").len(), all.len() - 1);
}
