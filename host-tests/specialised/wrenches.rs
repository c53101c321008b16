//! The wrenches in joints against Pinocchio's `data.f`, of every recorded robot with forces on its
//! bodies; between bodies that are fixed to each other core and engine are each other's oracle.

use dynamics_core::algorithms::TorquesAndWrenches;
use dynamics_core::effects::{
    Coriolis, Effect, Gravity, GyroscopicRotors, Inertia, MovingBase, Payload, hook,
};
use dynamics_core::model::{Bodies, BodyInertia, JointKind, Robot};
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::{Force, Motion};
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use host_tests::measured::largest;
use host_tests::recordings::{columns, load, row};
use host_tests::stress_robot::StressRobot;

/// All bodies of a robot whose first N that move or are moved have the numbers FIRST and above.
#[derive(Clone, Copy)]
struct From<const FIRST: usize>;

impl<const FIRST: usize, const N: usize> Bodies<N> for From<FIRST> {
    const NUMBERS: [usize; N] = {
        let (mut numbers, mut i) = ([0; N], 0);
        while i < N {
            numbers[i] = FIRST + i;
            i += 1;
        }
        numbers
    };
}

struct Pushed<R, const B: usize>([[R; 6]; B]);

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Pushed<R, B> {
    const EXTERNAL_WRENCH: hook::Wrench<Self, R> = hook::Wrench::constant(|pushed, body, fx| {
        let [a, b, c, d, e, f] = pushed.0[body];
        *fx += Force::new(R::Vec3::new(a, b, c), R::Vec3::new(d, e, f));
    });
}

fn six<R: Real>(f: &Force<R>) -> [f64; 6] {
    let ([a, b, c], [d, e, g]) = (f.ang.array(), f.lin.array());
    [a, b, c, d, e, g].map(R::to_f64)
}

/// The largest errors of core and engine in the couples and in the forces, relative to the largest
/// couple and force of any joint, under this share of the recorded forces.
fn errors<R: Real, T, const B: usize, const Q: usize, const V: usize>(share: f64) -> [f64; 4]
where
    T: Robot<B, Q, V>,
{
    let recording = load(T::MODEL.name);
    let joints: Vec<usize> = (0..B)
        .filter(|&body| !matches!(T::MODEL.links[body].joint.kind, JointKind::Fixed))
        .collect();
    let (mut error, mut scale) = ([0.0; 4], [0.0_f64; 2]);
    for (i, wanted) in recording.reactions.iter().enumerate() {
        let real = |rows| row::<V>(rows, i).map(R::from_f64);
        let (qd, qdd) = (real(&recording.qd), real(&recording.qdd));
        let state = State { q: row::<Q>(&recording.q, i).map(R::from_f64), qd, qdd };
        let pushed =
            Pushed(columns::<B>(&recording.wrenches, i).map(|f| f.map(|x| R::from_f64(share * x))));
        let scene = (Gravity::EARTH, Inertia, Coriolis, pushed);
        let core = Core::<T>::rnea_and_wrenches(&state, &scene);
        let engine: TorquesAndWrenches<R, V, B> =
            Engine::<T>::rnea_and_wrenches(&state, &scene, From::<0>);
        assert_eq!(engine.tau.map(R::to_f64), Engine::<T>::rnea(&state, &scene).map(R::to_f64));
        assert_eq!(wanted.len(), 6 * joints.len());
        for (&body, wanted) in joints.iter().zip(wanted.chunks(6)) {
            for (form, got) in [core.wrenches[body], engine.wrenches[body]].iter().enumerate() {
                for (k, (got, wanted)) in six(got).iter().zip(wanted).enumerate() {
                    let at = 2 * form + k / 3;
                    error[at] = largest([error[at], (got - wanted).abs()]);
                    scale[k / 3] = scale[k / 3].max(wanted.abs());
                }
            }
        }
    }
    std::array::from_fn(|k| error[k] / scale[k % 2])
}

fn check<T, const B: usize, const Q: usize, const V: usize>()
where
    T: Robot<B, Q, V>,
{
    for (scalar, bound, errors) in [
        ("f64", 1e-14, errors::<f64, T, B, Q, V>(1.0)),
        ("f32", 1e-6, errors::<f32, T, B, Q, V>(1.0)),
    ] {
        let shown = errors.map(|error| format!("{error:.1e}")).join(", ");
        println!("{} {scalar}: {shown}", T::MODEL.name);
        assert!(errors.iter().all(|&error| error < bound), "{} {scalar}: {shown}", T::MODEL.name);
    }
}

#[test]
fn a_force_that_is_off_by_a_thousandth_is_found_in_the_wrenches() {
    let off = errors::<f64, Ur5e, 6, 6, 6>(1.001);
    assert!(off.iter().all(|&error| error > 1e-5), "{off:?}");
}

#[test]
fn the_wrenches_in_joints_are_pinocchios() {
    check::<Ur5e, 6, 6, 6>();
}

#[cfg(feature = "full")]
#[test]
fn the_wrenches_in_the_joints_of_other_robots_are_pinocchios() {
    use dynamics_core::robots::*;
    use host_tests::trees::{TreeA, TreeB};
    check::<Panda, 7, 7, 7>();
    check::<Iiwa14, 7, 7, 7>();
    check::<Gen3, 7, 7, 7>();
    check::<XArm7, 7, 7, 7>();
    check::<Puma560, 6, 6, 6>();
    check::<OpenArm, 7, 7, 7>();
    check::<Yam, 6, 6, 6>();
    check::<Z1, 7, 7, 7>();
    check::<So101, 6, 6, 6>();
    check::<A1, 16, 12, 12>();
    check::<TreeA, 17, 35, 32>();
    check::<TreeB, 17, 35, 32>();
    check::<A1Free, 17, 19, 18>();
    check::<G1, 29, 29, 29>();
    check::<G1Free, 30, 36, 35>();
}

/// Bodies that are fixed in mid-tree, at a tip and to the base; under payloads on some of them,
/// forces, a moving base and spinning rotors.
#[test]
fn fixed_joints_have_the_same_wrenches_in_core_and_engine() {
    let load =
        BodyInertia { mass: 1.5, com: [0.1, -0.2, 0.3], inertia: [0.1, 0.2, 0.3, 0.02, 0.0, 0.0] };
    let pushed = Pushed(std::array::from_fn(|i| [1.0, -2.0, 3.0, 0.5, i as f64, -1.0]));
    let moves = |[a, b, c]: [f64; 3]| Motion::new([a, b, c].into(), [c, a, b].into());
    let base =
        MovingBase { velocity: moves([0.3, -0.2, 0.5]), acceleration: moves([1.0, 2.0, -3.0]) };
    let rotors = GyroscopicRotors { inertia: [0.01; 7], ratio: [50.0; 7] };
    let tool: Payload<f64, 6> = Payload::f64(load);
    let scene = (Gravity::EARTH, Inertia, Coriolis, pushed, base, rotors, tool);
    let state = State {
        q: [0.3, -0.5, 0.7, 0.2, -1.1, 0.4, 0.9],
        qd: [1.0, -2.0, 0.5, 1.5, -0.7, 0.3, 2.0],
        qdd: [3.0, 1.0, -4.0, 2.0, 5.0, -2.0, 1.0],
    };
    let core = Core::<StressRobot>::rnea_and_wrenches(&state, &scene);
    let engine: TorquesAndWrenches<f64, 7, 11> =
        Engine::<StressRobot>::rnea_and_wrenches(&state, &scene, From::<0>);
    for (body, (core, engine)) in core.wrenches.iter().zip(&engine.wrenches).enumerate() {
        let (core, engine) = (six(core), six(engine));
        let scale = core.iter().fold(1.0_f64, |scale, x| scale.max(x.abs()));
        let error = largest(core.iter().zip(engine).map(|(a, b)| (a - b).abs() / scale));
        assert!(error < 1e-14, "body {body}: {core:?} {engine:?}");
    }
}
