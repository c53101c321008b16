//! Terms whose loss no other test noticed: slopes that implicit steps use, momenta with a payload
//! or on a moving base, the tolerance of a payload's check.

use dynamics_core::algorithms::{
    base_velocity_from_momentum, centroidal_matrix, centroidal_momentum, cholesky, crba, ltdl,
    momentum,
};
use dynamics_core::drivetrain::{ElasticJoints, ElasticReference, elastic_inverse_dynamics};
use dynamics_core::effects::{
    Coriolis, Effect, EndStops, GyroscopicRotors, Inertia, InvalidPayload, JointState, Lugre,
    MovingBase, Payload, Spring, Stribeck, TorqueDerivatives, Width,
};
use dynamics_core::model::{ArmModel, BASE, Body, BodyInertia, Joint, Model, Problem};
use dynamics_core::spatial::{Force, Motion};
use dynamics_core::state::State;
use dynamics_core::state::manifold::{integrate, neutral};
use glam::DVec3;
use motion_control::law::{TaskCommand, TaskMotion, ZeroOrderHold};

fn at(q: f64, qd: f64) -> JointState<f64> {
    JointState::new(q, qd)
}

/// ∂τ/∂q and ∂τ/∂q̇ as the effect has them.
fn derivatives<E: Effect<f64, 1, 1>>(effect: &E, at: JointState<f64>) -> [f64; 2] {
    let mut slopes = TorqueDerivatives::default();
    effect.derivatives(0, at, &mut slopes);
    [slopes.dq, slopes.dqd]
}

/// The same by central differences of its torque.
fn differences<E: Effect<f64, 1, 1>>(
    effect: &E,
    JointState { q, qd, .. }: JointState<f64>,
) -> [f64; 2] {
    const H: f64 = 1e-7;
    let torque = |q, qd| {
        let mut tau = 0.0;
        effect.torque(0, at(q, qd), &mut tau);
        tau
    };
    [
        (torque(q + H, qd) - torque(q - H, qd)) / (2.0 * H),
        (torque(q, qd + H) - torque(q, qd - H)) / (2.0 * H),
    ]
}

#[track_caller]
fn near(got: [f64; 2], want: [f64; 2], relative: f64) {
    let size = want[0].abs().max(want[1].abs());
    for (a, b) in got.into_iter().zip(want) {
        assert!((a - b).abs() <= relative * size, "{got:?} for {want:?}");
    }
}

#[test]
fn stribecks_slope_at_rest_is_that_of_its_torque() {
    let stribeck =
        Stribeck { excess: [2.0], stribeck_speed: Width::f64(0.1), width: Width::f64(0.01) };
    near(derivatives(&stribeck, at(0.0, 0.0)), differences(&stribeck, at(0.0, 0.0)), 1e-8);
    assert!(derivatives(&stribeck, at(0.0, 0.0))[1] > 100.0);
}

#[test]
fn lugre_bristles_are_springs_only_while_sticking() {
    let mut friction = Lugre {
        stiffness: [1e5],
        damping: [300.0],
        viscous: [0.4],
        sliding: [1.0],
        excess: [0.5],
        stribeck_speed: Width::f64(0.01),
        bristle: [0.0],
    };
    near(derivatives(&friction, at(0.0, 0.0)), [1e5, 300.4], 1e-12);
    let sliding = at(0.0, 0.5);
    for _ in 0..1000 {
        Effect::<f64, 1, 1>::advance(&mut friction, 0, sliding, 0.01);
    }
    let [q, qd] = derivatives(&friction, sliding);
    assert!(q.abs() < 1e-5 && (qd - 0.4).abs() < 1e-7, "{q} {qd}");
}

#[test]
fn slopes_of_the_stops_are_those_of_their_torque() {
    let stops = EndStops {
        lower: [-1.0],
        upper: [1.0],
        stiffness: 1e4,
        damping: 50.0,
        damping_depth: Width::f64(1e-3),
    };
    // Deep enough that the damping no longer grows with the depth; within, at both ends, and pulled
    // out of one so fast that the stop has let go.
    for state in [at(0.0, 2.0), at(1.5, 0.3), at(1.5, -0.3), at(-1.5, 0.3), at(1.5, -200.0)] {
        near(derivatives(&stops, state), differences(&stops, state), 1e-5);
    }
    assert_eq!(derivatives(&stops, at(1.5, -200.0)), [0.0; 2]);
}

/// A payload whose principal moments exceed what a body has by 0.2 of the largest.
fn checked(relative: f64) -> Result<Payload<f64, 0>, InvalidPayload> {
    let load =
        BodyInertia { mass: 2.0, com: [0.0, 0.0, 0.1], inertia: [0.05, 0.0, 0.0, 0.02, 0.0, 0.02] };
    Payload::try_new(load, relative)
}

#[test]
fn a_payload_is_refused_just_beyond_its_tolerance() {
    assert!(checked(0.2 + 1e-9).is_ok());
    for relative in [0.2 - 1e-9, f64::NAN] {
        let error = checked(relative).expect_err("no body is like that");
        assert!(matches!(error.problem, Problem::Triangle(_)));
        assert_eq!(error.body, 0);
    }
}

/// A trunk that floats, with an arm.
const FLOATING: Model<f64, 2, 8, 7> = Model::new(
    "floating",
    [
        Body::new("trunk", BASE, Joint::free())
            .mass(5.0)
            .com([0.05, -0.02, 0.1])
            .inertia([0.3, 0.01, -0.02, 0.25, 0.03, 0.2]),
        Body::new("arm", 0, Joint::revolute([0.2, 1.0, -0.3]))
            .xyz([0.1, 0.2, 0.3])
            .mass(1.5)
            .com([0.2, 0.0, 0.1])
            .inertia([0.01, 0.0, 0.002, 0.03, 0.0, 0.03]),
    ],
);

fn floating() -> State<f64, 8, 7> {
    let step = [0.3, -0.2, 0.5, 0.1, 0.4, -0.3, 0.7];
    let q = integrate(&FLOATING, &neutral(&FLOATING), &step);
    State { q, qd: [0.4, -0.3, 0.8, 0.5, 0.2, -0.6, 1.3], qdd: [0.0; 7] }
}

#[track_caller]
fn same(got: Force<f64>, want: Force<f64>) {
    let apart = (got.ang - want.ang).length() + (got.lin - want.lin).length();
    assert!(apart < 2e-14, "{got:?} for {want:?}");
}

#[test]
fn the_centroidal_matrix_has_the_payload() {
    let state = floating();
    let load = Payload::<_, 0>::from_inertia(BodyInertia {
        mass: 2.0,
        com: [0.3, -0.1, 0.2],
        inertia: [0.02, 0.0, 0.0, 0.01, 0.0, 0.02],
    });
    let columns = centroidal_matrix(&FLOATING, &state.q, &load);
    let mut h = Force::ZERO;
    for (column, qd) in columns.into_iter().zip(state.qd) {
        h += column * qd;
    }
    same(h, centroidal_momentum(&FLOATING, &state, &load));
    let empty = centroidal_momentum(&FLOATING, &state, &());
    assert!((h.lin - empty.lin).length() > 0.5);
}

#[test]
fn a_wanted_momentum_is_reached_on_a_moving_base() {
    let ship = MovingBase {
        velocity: Motion::new(DVec3::new(0.2, -0.4, 0.1), DVec3::new(1.0, 0.5, -0.3)),
        acceleration: Motion::ZERO,
    };
    let wanted = Force::new(DVec3::new(0.5, -1.0, 2.0), DVec3::new(3.0, 1.0, -2.0));
    let mut state = floating();
    state.qd =
        base_velocity_from_momentum(&FLOATING, &state, wanted, &ship).expect("the trunk has mass");
    same(momentum(&FLOATING, &state, &ship), wanted);
    assert!((momentum(&FLOATING, &state, &()).lin - wanted.lin).length() > 0.5);
}

const WHEEL: ArmModel<f64, 1> = Model::new(
    "wheel",
    [Body::new("w", BASE, Joint::revolute([0.0, 0.0, 1.0]))
        .mass(1.0)
        .inertia([0.0, 0.0, 0.0, 0.0, 0.0, 2.0])],
);

#[test]
fn a_spring_adds_to_a_compliant_joints_torque_rate() {
    let joints = ElasticJoints { stiffness: [100.0], rotor: [0.5], friction: [0.0] };
    let course = ElasticReference {
        state: State { q: [0.7], qd: [0.3], qdd: [-0.4] },
        jerk: [1.1],
        snap: [-2.0],
    };
    let spring = Spring { stiffness: [30.0], rest: [0.2] };
    let motors = elastic_inverse_dynamics(&WHEEL, &joints, &course, &(Inertia, Coriolis, spring))
        .expect("one joint");
    // τ = I q̈ + k (q − q₀) with its derivatives; θ = q + τ/K; τ_m = J θ̈ + τ.
    let [tau, rate, accel] =
        [2.0 * -0.4 + 30.0 * 0.5, 2.0 * 1.1 + 30.0 * 0.3, 2.0 * -2.0 + 30.0 * -0.4];
    let close = |got: f64, want: f64| assert!((got - want).abs() < 1e-14, "{got} for {want}");
    close(motors.position[0], 0.7 + tau / 100.0);
    close(motors.velocity[0], 0.3 + rate / 100.0);
    close(motors.torque[0], 0.5 * (-0.4 + accel / 100.0) + tau);
}

#[test]
fn a_wanted_momentum_is_reached_with_spinning_rotors() {
    let mut rotors = GyroscopicRotors { inertia: [0.0; 7], ratio: [20.0; 7] };
    rotors.inertia[6] = 0.02;
    let wanted = Force::new(DVec3::new(0.5, -1.0, 2.0), DVec3::new(3.0, 1.0, -2.0));
    let mut state = floating();
    state.qd = base_velocity_from_momentum(&FLOATING, &state, wanted, &rotors)
        .expect("the trunk has mass");
    same(momentum(&FLOATING, &state, &rotors), wanted);
    assert!((momentum(&FLOATING, &state, &()).ang - wanted.ang).length() > 0.1);
}

#[test]
fn a_floating_point_masss_inertia_has_no_factors() {
    for step in 0..50 {
        let com = [0.1, -0.23, 0.37].map(|x| x * (1.0 + f64::from(step) / 7.0));
        let model: Model<f64, 1, 7, 6> =
            Model::new("point", [Body::new("point", BASE, Joint::free()).mass(1.5).com(com)]);
        let m = crba(&model, &neutral(&model), &Inertia);
        assert!(ltdl(&model, &m).is_err(), "{com:?}");
        assert!(cholesky(&model, &m).is_err(), "{com:?}");
    }
    let model: Model<f64, 1, 7, 6> =
        Model::new("point", [Body::new("point", BASE, Joint::free()).mass(1.5)]);
    let (state, wanted) = (State::at(neutral(&model)), Force::new(DVec3::X, DVec3::Y));
    assert!(base_velocity_from_momentum(&model, &state, wanted, &()).is_err());
}

#[test]
fn a_held_torque_is_the_last_that_was_computed() {
    let mut held = ZeroOrderHold::start();
    assert_eq!(held.hold(), [0.0_f64]);
    assert_eq!((held.update([3.0]), held.hold()), ([3.0], [3.0]));
}

#[test]
fn a_tasks_damping_is_twice_ratio_times_frequency() {
    let task =
        TaskMotion { error: 0.0, error_rate: 2.0, acceleration: 0.5, omega_n: 10.0, zeta: 0.7 };
    let TaskCommand::Motion { acceleration } = TaskCommand::<f64>::motion(task) else {
        panic!("a motion");
    };
    assert!((acceleration - 28.5).abs() < 1e-14, "{acceleration}");
}

#[test]
fn an_impossible_payload_is_named_with_its_excess() {
    let text = checked(0.2 - 1e-9).expect_err("no body is like that").to_string();
    assert!(text.contains("body 0") && text.contains("of the largest"), "{text}");
}

#[test]
fn a_state_is_finite_if_all_its_numbers_are() {
    assert!(floating().is_finite());
    for field in 0..3 {
        let mut state = floating();
        let State { q, qd, qdd } = &mut state;
        *[&mut q[1], &mut qd[1], &mut qdd[1]][field] = f64::NAN;
        assert!(!state.is_finite(), "{field}");
    }
}

/// The bound of a pivot is 32 roundings of what it is the difference of: here the difference is 48
/// roundings of 1.
const SMALL: f64 = 48.0 * f64::EPSILON;

#[test]
fn a_pivot_inherits_errors_only_within_its_joint() {
    // M is I: 1 − b² is left of the first coordinate once the second is free, both with the error
    // of a 1.
    let b = (1.0 - SMALL).sqrt();
    let rod = Body::new("rod", BASE, Joint::spherical()).mass(1.0);
    let ball = Model::<f64, 1, 4, 3>::new("ball", [rod.inertia([1.0, b, 0.0, 1.0, 0.0, 2.0])]);
    let m = crba(&ball, &neutral(&ball), &Inertia);
    assert!(ltdl(&ball, &m).is_err());
    assert!(cholesky(&ball, &m).is_err());
    // Two joints on one axis, the inner body of inertia SMALL, and a joint of several coordinates
    // elsewhere.
    let wheel = |name, parent, inertia| {
        let x = [inertia, 0.0, 0.0, 1.0, 0.0, 1.0];
        Body::new(name, parent, Joint::revolute([1.0, 0.0, 0.0])).mass(1.0).inertia(x)
    };
    let bodies = [
        wheel("inner", BASE, SMALL),
        wheel("outer", 0, 1.0),
        rod.inertia([1.0, 0.0, 0.0, 1.0, 0.0, 1.0]),
    ];
    let wheels = Model::<f64, 3, 6, 5>::new("wheels", bodies);
    let m = crba(&wheels, &neutral(&wheels), &Inertia);
    assert_eq!(m.get(0, 0) - m.get(1, 1), SMALL);
    assert!(ltdl(&wheels, &m).is_ok());
    assert!(cholesky(&wheels, &m).is_ok());
}
