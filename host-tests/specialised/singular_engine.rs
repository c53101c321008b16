//! Robots whose M is singular across bodies without inertia are refused by the engine as by the
//! core.

use core::f64::consts::FRAC_PI_2;

use dynamics_core::Engine;
use dynamics_core::effects::{Effect, Payload, RIGID_BODY};
use dynamics_core::model::{BASE, Body, BodyInertia, Joint, Model, Robot};
use dynamics_core::robots::{Panda, Ur5e};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use host_tests::random::{random_numbers, within};

const ARM: Body = Body::new("arm", BASE, Joint::revolute([0.1, 0.9, -0.3]))
    .xyz([0.1, 0.2, 0.3])
    .rpy([0.3, 0.2, 0.1])
    .mass(2.0)
    .com([0.1, 0.03, -0.1])
    .inertia([0.1, 0.01, 0.02, 0.12, 0.03, 0.11]);

/// An oblique axis, and where its joint stands on the arm.
const AXIS: [f64; 3] = [0.3, -0.2, 1.0];

const fn on_arm(joint: Joint<f64>) -> Body {
    Body::new("carrier", 0, joint).xyz([0.3, 0.1, 0.2]).rpy([0.7, -0.4, 0.9])
}

const fn solid(body: Body) -> Body {
    body.mass(1.0).com([0.1, 0.0, 0.2]).inertia([0.1, 0.0, 0.01, 0.12, 0.0, 0.1])
}

/// Two turns on one axis, and a plate without mass between them.
struct Far;
impl Robot<4, 3, 3> for Far {
    const MODEL: Model<f64, 4, 3, 3> = Model::new(
        "far",
        [
            ARM,
            on_arm(Joint::revolute(AXIS)),
            Body::new("plate", 1, Joint::fixed()).xyz([0.03, -0.02, 0.1]),
            solid(Body::new("hand", 2, Joint::revolute(AXIS))),
        ],
    );
}

/// The same with a slide along the axis instead of the plate.
struct Telescope;
impl Robot<4, 4, 4> for Telescope {
    const MODEL: Model<f64, 4, 4, 4> = Model::new(
        "telescope",
        [
            ARM,
            on_arm(Joint::revolute(AXIS)),
            Body::new("tube", 1, Joint::prismatic(AXIS)),
            solid(Body::new("hand", 2, Joint::revolute(AXIS))),
        ],
    );
}

/// A turn between two slides on one axis.
struct Slides;
impl Robot<4, 4, 4> for Slides {
    const MODEL: Model<f64, 4, 4, 4> = Model::new(
        "slides",
        [
            ARM,
            on_arm(Joint::prismatic(AXIS)),
            Body::new("turn", 1, Joint::revolute(AXIS)),
            solid(Body::new("quill", 2, Joint::prismatic(AXIS))),
        ],
    );
}

/// A wrist without mass about z, y and x, which is in gimbal lock where its second joint is at
/// ±π/2.
struct Wrist;
impl Robot<4, 4, 4> for Wrist {
    const MODEL: Model<f64, 4, 4, 4> = Model::new(
        "wrist",
        [
            ARM,
            on_arm(Joint::revolute([0.0, 0.0, 1.0])),
            Body::new("pitch", 1, Joint::revolute([0.0, 1.0, 0.0])),
            solid(Body::new("roll", 2, Joint::revolute([1.0, 0.0, 0.0]))),
        ],
    );
}

/// In 1,000 states every way of the engine names coordinate `joint`.
fn named<R: Real, T, E, const N: usize>(
    scene: &E,
    joint: usize,
    pose: impl Fn([f64; N]) -> [f64; N],
) where
    T: Robot<4, N, N>,
    E: Effect<R, 4, N>,
{
    let (rng, mut named) = (&mut random_numbers(), [0; 3]);
    for _ in 0..1000 {
        let state = State {
            qd: within(rng, 3.0).map(R::from_f64),
            ..State::at(pose(within(rng, 3.0)).map(R::from_f64))
        };
        let tau = within(rng, 10.0).map(R::from_f64);
        let verdicts = [
            Engine::<T>::forward_dynamics(&state, &tau, scene).err(),
            Engine::<T>::aba(&state, &tau, scene).err(),
            Engine::<T>::ltdl(&Engine::<T>::crba(&state.q, scene)).err(),
        ];
        for (named, verdict) in named.iter_mut().zip(verdicts) {
            *named += usize::from(verdict.is_some_and(|error| error.joint == joint));
        }
    }
    let what = format!("{}, {}", T::MODEL.name, std::any::type_name::<R>());
    println!("{what}: {named:?}");
    assert_eq!(named, [1000; 3], "{what}: forward_dynamics, aba, factor");
}

#[test]
fn the_engine_refuses_coaxial_joints_across_a_fixed_body() {
    named::<f64, Far, _, 3>(&RIGID_BODY, 1, |q| q);
    named::<f32, Far, _, 3>(&RIGID_BODY, 1, |q| q);
}

// It refuses them however far the slide is out.
#[test]
fn the_engine_refuses_coaxial_joints_across_a_slide() {
    let far = |q: [f64; 4]| [q[0], q[1], 5.0 * q[2], q[3]];
    named::<f32, Telescope, _, 4>(&RIGID_BODY, 1, far);
}

#[test]
fn the_engine_refuses_a_revolute_between_coaxial_slides() {
    named::<f64, Slides, _, 4>(&RIGID_BODY, 1, |q| q);
}

#[test]
fn the_engine_refuses_a_wrist_in_gimbal_lock() {
    let locked = |q: [f64; 4]| [q[0], q[1], FRAC_PI_2.copysign(q[2]), q[3]];
    named::<f64, Wrist, _, 4>(&RIGID_BODY, 1, locked);
    named::<f32, Wrist, _, 4>(&RIGID_BODY, 1, locked);
}

#[test]
fn the_engine_refuses_coaxial_joints_under_heavy_payloads() {
    let load = Payload::<_, 3>::from_inertia(BodyInertia {
        mass: 1000.0_f32,
        com: [0.1, 0.0, 0.2],
        inertia: [90.0, 0.0, 9.0, 80.0, 0.0, 70.0],
    });
    named::<f32, Far, _, 3>(&(RIGID_BODY, load), 1, |q| q);
}

/// A wrist is refused only as near to its lock as rounding errors are.
#[test]
fn a_wrist_out_of_gimbal_lock_is_regular() {
    fn regular<R: Real>(off: f64) {
        let q = [0.3, -0.4, FRAC_PI_2 - off, 0.5].map(R::from_f64);
        let (state, tau) = (State::at(q), [R::ONE; 4]);
        assert!(Engine::<Wrist>::forward_dynamics(&state, &tau, &RIGID_BODY).is_ok());
        assert!(Engine::<Wrist>::aba(&state, &tau, &RIGID_BODY).is_ok());
        assert!(Engine::<Wrist>::ltdl(&Engine::<Wrist>::crba(&q, &RIGID_BODY)).is_ok());
    }
    regular::<f64>(1e-6);
    regular::<f32>(1e-2);
}

/// Pivots that are certain to exceed their rounding errors are not compared with them; a NaN among
/// them is named all the same.
#[test]
fn a_nan_angle_names_the_outermost_joint_that_feels_it() {
    fn named<R: Real, T: Robot<N, N, N>, const N: usize>() {
        for k in 0..N {
            let mut q = [R::from_f64(0.4); N];
            q[k] = R::from_f64(f64::NAN);
            let got = Engine::<T>::forward_dynamics(&State::at(q), &[R::ONE; N], &RIGID_BODY).err();
            // This compares each pivot.
            let want = Engine::<T>::ltdl(&Engine::<T>::crba(&q, &RIGID_BODY)).err();
            assert_eq!(got, want, "{}, joint {k}", T::MODEL.name);
            let felt = got.is_some();
            assert!(felt || k == 0 || k == N - 1, "{}, joint {k}", T::MODEL.name);
        }
    }
    named::<f64, Ur5e, 6>();
    named::<f32, Ur5e, 6>();
    named::<f32, Panda, 7>();
}

/// A joint whose descendants are free moves at least the inertia of its own body.
#[test]
fn no_pivot_is_less_than_its_body_alone() {
    fn least<T: Robot<N, N, N>, const N: usize>() {
        let (rng, mut least) = (&mut random_numbers(), f64::INFINITY);
        for _ in 0..1000 {
            let m = Engine::<T>::crba(&within(rng, 3.0), &RIGID_BODY);
            let factors = Engine::<T>::ltdl(&m).expect("a regular M");
            for (link, d_inv) in T::MODEL.links.iter().zip(factors.d_inv()) {
                // The axis of each joint is z.
                least = least.min(1.0 / (d_inv * link.inertia.rotational.z_axis.z));
            }
        }
        println!("{}: {least}", T::MODEL.name);
        // The last body has no descendants.
        assert!((least - 1.0).abs() < 1e-9, "{}: {least}", T::MODEL.name);
    }
    least::<Ur5e, 6>();
    least::<Panda, 7>();
}
