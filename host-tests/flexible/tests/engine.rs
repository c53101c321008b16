//! The engine's links that bend against the core's, on trees with every joint of one coordinate and
//! under every kind of effect.

use dynamics_core::effects::{
    Armature, Coriolis, Effect, Elasticity, Gravity, GravityVector, Inertia, LoadFriction,
    MovingBase, Payload, RIGID_BODY, Width, WorldWrench, hook,
};
use dynamics_core::flexible::{
    Beam, Bending, BendingRobot, FlexibleError, FlexibleInertia, JointsAndModes, ModalFeedforward,
    Modes, Shape,
};
use dynamics_core::model::{ArmModel, BASE, Body, BodyInertia, Joint, Model, Robot, Static};
use dynamics_core::scalar::Real;
use dynamics_core::spatial::Force;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};
use flexible_tests::{JOINTS, LOWER, MODES, Numbers, PLANAR, Planar, UPPER, link};
use glam::DVec3;

/// A tree on a slide. The first link that bends carries one on its very end, a joint that is off it
/// with a skew axis, and a body that is fixed there with a joint behind it. Another is fixed to the
/// slide.
struct Tree;

const fn of(beam: &Beam, name: &'static str, parent: usize, joint: Joint<f64>) -> Body {
    Body::new(name, parent, joint).mass(beam.mass()).com(beam.com()).inertia(beam.inertia())
}

const fn lump(name: &'static str, parent: usize, joint: Joint<f64>) -> Body {
    Body::new(name, parent, joint)
        .mass(0.7)
        .com([0.05, -0.02, 0.08])
        .inertia([0.02, 0.001, -0.002, 0.03, 0.003, 0.025])
}

impl Robot<9, 7, 7> for Tree {
    const MODEL: Model<f64, 9, 7, 7> = Model::new(
        "tree",
        [
            lump("slide", BASE, Joint::prismatic([0.0, 0.6, 0.8])),
            lump("fixed", 0, Joint::fixed()).xyz([0.1, 0.2, -0.1]),
            of(&UPPER, "boom", 0, Joint::revolute([0.0, 0.0, 1.0]))
                .xyz([0.1, 0.2, 0.3])
                .rpy([0.4, -0.3, 0.2]),
            of(&LOWER, "on end", 2, Joint::revolute([0.0, 1.0, 0.0])).xyz([0.5, 0.0, 0.0]),
            lump("off end", 2, Joint::revolute([0.48, 0.6, 0.64]))
                .xyz([0.45, 0.03, -0.06])
                .rpy([0.3, 0.5, -0.8]),
            lump("screw", 3, Joint::helical([0.0, 0.0, 1.0], 0.05)).xyz([0.4, 0.0, 0.02]),
            lump("last", 4, Joint::prismatic([1.0, 0.0, 0.0])).xyz([0.1, 0.1, 0.0]),
            lump("flange", 2, Joint::fixed()).xyz([0.52, 0.01, -0.02]).rpy([0.1, 0.7, -0.4]),
            lump("wrist", 7, Joint::revolute([1.0, 0.0, 0.0])).xyz([0.05, 0.0, 0.03]),
        ],
    );
}

impl BendingRobot<9, 7, 7, 5> for Tree {
    const MODES: Modes<f64, 5> = Modes::new(
        &Self::MODEL,
        &[
            link(&UPPER, 2, &[Shape::BendY(1), Shape::BendZ(1), Shape::Twist(1)]),
            link(&LOWER, 3, &[Shape::BendZ(1), Shape::BendY(1)]),
        ],
    );
}

host_tests::in_full! {
    /// Three links in a plane, of which the second is mounted the other way round and the last, with a
    /// gripper fixed on its end, bends out of the plane as well.
    struct Flipped;

    impl Robot<4, 3, 3> for Flipped {
        const MODEL: Model<f64, 4, 3, 3> = Model::new(
            "flipped",
            [
                of(&UPPER, "upper", BASE, Joint::revolute([0.0, 1.0, 0.0])),
                of(&LOWER, "lower", 0, Joint::revolute([0.0, -1.0, 0.0])).xyz([0.5, 0.0, 0.0]),
                of(&LOWER, "hand", 1, Joint::revolute([0.0, 1.0, 0.0])).xyz([0.4, 0.0, 0.0]),
                lump("gripper", 2, Joint::fixed()).xyz([0.4, 0.0, 0.0]),
            ],
        );
    }

    impl BendingRobot<4, 3, 3, 5> for Flipped {
        const MODES: Modes<f64, 5> = Modes::new(
            &Self::MODEL,
            &[
                link(&UPPER, 0, &[Shape::BendZ(1), Shape::BendZ(2)]),
                link(&LOWER, 1, &[Shape::BendZ(1)]),
                link(&LOWER, 2, &[Shape::BendZ(1), Shape::BendY(1)]),
            ],
        );
    }
}

/// An arm without modes: two parallel axes, 0.4 m apart, and a slide along them.
struct Scara;

impl Robot<3, 3, 3> for Scara {
    const MODEL: ArmModel<f64, 3> = ArmModel::new(
        "scara",
        [
            lump("upper", BASE, Joint::revolute([0.0, 0.0, 1.0])),
            lump("fore", 0, Joint::revolute([0.0, 0.0, 1.0])).xyz([0.4, 0.0, 0.0]),
            lump("quill", 1, Joint::prismatic([0.0, 0.0, 1.0])),
        ],
    );
}

impl BendingRobot<3, 3, 3, 0> for Scara {
    const MODES: Modes<f64, 0> = Modes::new(&Self::MODEL, &[]);
}

/// A drag on each body.
struct Drag;

impl<R: Real, const B: usize, const V: usize> Effect<R, B, V> for Drag {
    const EXTERNAL_WRENCH: hook::Wrench<Self, R> = hook::Wrench::of_velocity(|_, _, at, fx| {
        fx.lin -= at.velocity.lin * R::from_f64(0.7);
        fx.ang -= at.velocity.ang * R::from_f64(0.3);
    });
}

/// The largest difference over the largest number, of torques and of forces on modes.
fn apart<const V: usize, const M: usize>(
    a: &JointsAndModes<f64, V, M>,
    b: &JointsAndModes<f64, V, M>,
) -> f64 {
    let of = |a: &[f64], b: &[f64]| {
        let scale = b.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
        let worst = a.iter().zip(b).map(|(a, b)| (a - b).abs());
        worst.fold(0.0, f64::max) / f64::max(scale, 1e-300)
    };
    f64::max(of(&a.joints, &b.joints), of(&a.modes, &b.modes))
}

/// Compares inverse dynamics and the modes' accelerations at random states; returns the largest
/// difference.
fn compare<T, E, const B: usize, const V: usize, const M: usize>(scene: &E) -> f64
where
    T: BendingRobot<B, V, V, M>,
    E: Effect<f64, B, V>,
{
    let (mut numbers, mut worst) = (Numbers::new(11), 0.0);
    for _ in 0..20 {
        let (state, bent) = (numbers.state::<V>(JOINTS), numbers.state::<M>(MODES));
        let core = Bending::<Core<T>>::rnea(&state, &bent, scene);
        let engine = Bending::<Engine<T>>::rnea(&state, &bent, scene);
        worst = f64::max(worst, apart(&engine, &core));
        worst = f64::max(worst, inertia_apart::<T, E, B, V, M>(&state, &bent, scene));
        let free = |modes| JointsAndModes::<f64, V, M> { joints: [0.0; V], modes };
        let core = Bending::<Core<T>>::modal_dynamics(&state, &bent, scene);
        let engine = Bending::<Engine<T>>::modal_dynamics(&state, &bent, scene);
        let [core, engine] = [core, engine].map(|found| free(found.expect("an inertia")));
        worst = f64::max(worst, apart(&engine, &core));
    }
    worst
}

/// The difference of M, of each block relative to its largest entry.
fn inertia_apart<T, E, const B: usize, const V: usize, const M: usize>(
    state: &State<f64, V, V>,
    bent: &State<f64, M, M>,
    scene: &E,
) -> f64
where
    T: BendingRobot<B, V, V, M>,
    E: Effect<f64, B, V>,
{
    let core = Bending::<Core<T>>::crba(&state.q, &bent.q, scene);
    let engine = Bending::<Engine<T>>::crba(&state.q, &bent.q, scene);
    let rows = |m: &FlexibleInertia<f64, V, M>, i: usize| JointsAndModes::<f64, V, M> {
        joints: core::array::from_fn(|j| m.joints.get(i, j)),
        modes: core::array::from_fn(|k| m.coupling[k][i]),
    };
    let joints = (0..V).map(|i| apart(&rows(&engine, i), &rows(&core, i)));
    let row = |m: &FlexibleInertia<f64, V, M>, k: usize| JointsAndModes::<f64, V, M> {
        joints: m.coupling[k],
        modes: core::array::from_fn(|l| m.modes.get(k, l)),
    };
    let modes = (0..M).map(|k| apart(&row(&engine, k), &row(&core, k)));
    joints.chain(modes).fold(0.0, f64::max)
}

fn scenes<T, L, const B: usize, const V: usize, const M: usize>(load: fn(BodyInertia<f64>) -> L)
where
    T: BendingRobot<B, V, V, M>,
    L: Effect<f64, B, V>,
{
    let g = GravityVector(DVec3::new(1.0, -3.0, -9.0));
    let body = BodyInertia {
        mass: 1.3,
        com: [0.1, -0.05, 0.2],
        inertia: [0.03, 0.0, 0.001, 0.02, 0.0, 0.04],
    };
    let wrench = WorldWrench {
        body: B - 1,
        wrench: Force::new(DVec3::new(1.0, -2.0, 0.5), DVec3::new(5.0, 3.0, -4.0)),
    };
    let base = MovingBase::of_point(
        DVec3::new(0.3, -0.5, 0.7),
        DVec3::new(1.0, 2.0, -1.0),
        DVec3::new(0.2, 0.1, -0.4),
        DVec3::new(-1.0, 0.5, 2.0),
    );
    let gears = LoadFriction::of_efficiency([0.8; V], [0.75; V], Width::new(0.01));
    let found = [
        compare::<T, _, B, V, M>(&RIGID_BODY),
        compare::<T, _, B, V, M>(&(RIGID_BODY, Elasticity)),
        compare::<T, _, B, V, M>(&(g, Elasticity)),
        compare::<T, _, B, V, M>(&(Gravity::EARTH, Inertia)),
        compare::<T, _, B, V, M>(&(Gravity::EARTH, Coriolis)),
        compare::<T, _, B, V, M>(&(RIGID_BODY, Payload::<f64, 1>::from_inertia(body), wrench)),
        compare::<T, _, B, V, M>(&(RIGID_BODY, load(body))),
        compare::<T, _, B, V, M>(&(RIGID_BODY, Drag, Elasticity)),
        compare::<T, _, B, V, M>(&(Inertia, Coriolis, g, base, Drag, Elasticity)),
        compare::<T, _, B, V, M>(&(RIGID_BODY, Armature([0.1; V]), gears)),
    ];
    println!("{}: {found:?}", T::MODEL.name);
    assert!(found.iter().all(|&error| error < 1e-12), "{found:?}");
}

#[test]
fn engine_and_core_bend_alike_under_every_effect() {
    scenes::<Planar, _, 2, 2, 4>(Payload::<f64, 0>::from_inertia);
    let error = compare::<Tree, _, 9, 7, 5>(&(Gravity::EARTH, Inertia, Coriolis, Drag, Elasticity));
    assert!(error < 1e-12, "{error}");
    host_tests::in_full! {
        scenes::<flexible_tests::Spatial, _, 2, 2, 6>(Payload::<f64, 1>::from_inertia);
        scenes::<Flipped, _, 4, 3, 5>(Payload::<f64, 3>::from_inertia);
        scenes::<Tree, _, 9, 7, 5>(Payload::<f64, 7>::from_inertia);
        scenes::<Scara, _, 3, 3, 0>(Payload::<f64, 2>::from_inertia);
    }
}

/// A difference of a part in 10⁹ of the largest stiffness, of one integral or of one place is
/// found.
#[test]
fn a_wrong_table_is_found() {
    struct Off<const WHAT: usize>;
    impl<const WHAT: usize> Robot<2, 2, 2> for Off<WHAT> {
        const MODEL: ArmModel<f64, 2> = Planar::MODEL;
    }
    impl<const WHAT: usize> BendingRobot<2, 2, 2, 4> for Off<WHAT> {
        const MODES: Modes<f64, 4> = {
            let mut upper = link(&UPPER, 0, &[Shape::BendZ(1), Shape::BendZ(2)]);
            *match WHAT {
                0 => &mut upper.stiffness[1][1],
                1 => &mut upper.modes[1].moments[2][0],
                _ => &mut upper.end[0],
            } *= 1.0 + 1e-9;
            let lower = link(&LOWER, 1, &[Shape::BendZ(1), Shape::BendZ(2)]);
            Modes::new(&Self::MODEL, &[upper, lower])
        };
    }
    let mut numbers = Numbers::new(5);
    let (state, bent) = (numbers.state::<2>(JOINTS), numbers.state::<4>(MODES));
    let scene = (RIGID_BODY, Elasticity);
    let right = Bending::<Core<Planar>>::rnea(&state, &bent, &scene);
    let found = [
        Bending::<Engine<Off<0>>>::rnea(&state, &bent, &scene),
        Bending::<Engine<Off<1>>>::rnea(&state, &bent, &scene),
        Bending::<Engine<Off<2>>>::rnea(&state, &bent, &scene),
    ]
    .map(|wrong| apart(&wrong, &right));
    assert!(found.iter().all(|&error| error > 1e-11), "{found:?}");
}

#[test]
fn a_thousand_ticks_of_feedforward_agree() {
    let scene = (RIGID_BODY, Elasticity);
    let start = ModalFeedforward::at_rest(&Static::<Planar>::NEW, &PLANAR, &[0.0; 2], &scene);
    let [mut core, mut engine] = [start.expect("stiffness"); 2];
    let mut worst = 0.0;
    for tick in 0..1000 {
        let t = f64::from(tick) * 1e-3;
        let reference = State {
            q: [(3.0 * t).sin(), 0.5 * (5.0 * t).sin()],
            qd: [3.0 * (3.0 * t).cos(), 2.5 * (5.0 * t).cos()],
            qdd: [-9.0 * (3.0 * t).sin(), -12.5 * (5.0 * t).sin()],
        };
        let a = Bending::<Core<Planar>>::tick(&mut core, &reference, &scene, 1e-3);
        let b = Bending::<Engine<Planar>>::tick(&mut engine, &reference, &scene, 1e-3);
        for (a, b) in a.expect("finite").iter().zip(b.expect("finite")) {
            worst = f64::max(worst, (a - b).abs());
        }
    }
    println!("ticks: {worst:.1e} N·m");
    assert!(worst < 5e-14, "{worst:.1e}");
}

#[test]
fn the_engine_names_modes_that_are_not_finite() {
    let scene = (RIGID_BODY, Elasticity);
    let start = ModalFeedforward::at_rest(&Static::<Planar>::NEW, &PLANAR, &[0.0; 2], &scene);
    let start = start.expect("stiffness");
    let reference = State::at([0.3, f64::NAN]);
    let mut feedforward = start;
    let found = Bending::<Engine<Planar>>::tick(&mut feedforward, &reference, &scene, 1e-3);
    assert!(matches!(found, Err(FlexibleError::Mode(_))), "{found:?}");
    assert_eq!(feedforward, start);
    let mut bent = start.bent;
    bent.qd[1] = f64::INFINITY;
    let found = Bending::<Engine<Planar>>::modal_dynamics(&State::at([0.3; 2]), &bent, &scene);
    assert!(matches!(found, Err(FlexibleError::Mode(_))), "{found:?}");
}

#[test]
fn the_engine_does_not_read_a_coordinate_without_effect() {
    let (scene, bent) = (RIGID_BODY, State::at([]));
    let state = State { q: [f64::NAN, 0.3, 0.1], qd: [1.0; 3], qdd: [2.0; 3] };
    let mut feedforward = ModalFeedforward { bent };
    let tau = Bending::<Engine<Scara>>::tick(&mut feedforward, &state, &scene, 1e-3);
    let tau = tau.expect("finite torques");
    let found = Bending::<Engine<Scara>>::forward_dynamics(&state, &bent, &tau, &scene);
    let found = found.expect("finite accelerations").joints;
    assert!(found.iter().all(|qdd| (qdd - 2.0).abs() < 1e-12), "{found:?}");
    let core = Bending::<Core<Scara>>::forward_dynamics(&state, &bent, &tau, &scene);
    assert_eq!(core, Err(FlexibleError::Joint(0)));
}

#[test]
fn forward_dynamics_of_engine_and_core_agree() {
    let gears = LoadFriction::of_efficiency([0.8; 7], [0.75; 7], Width::new(0.01));
    let scene = (RIGID_BODY, Elasticity, Armature([0.1; 7]), gears);
    let (mut numbers, mut worst) = (Numbers::new(3), 0.0);
    for _ in 0..100 {
        let (state, bent) = (numbers.state::<7>(JOINTS), numbers.state::<5>(MODES));
        let tau = [(); 7].map(|()| 5.0 * numbers.draw());
        let core = Bending::<Core<Tree>>::forward_dynamics(&state, &bent, &tau, &scene);
        let engine = Bending::<Engine<Tree>>::forward_dynamics(&state, &bent, &tau, &scene);
        let [core, engine] = [core, engine].map(|found| found.expect("an inertia"));
        worst = f64::max(worst, apart(&engine, &core));
    }
    println!("forward dynamics: {worst:.1e}");
    assert!(worst < 2e-13, "{worst:.1e}");
}
