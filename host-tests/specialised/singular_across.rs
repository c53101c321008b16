//! Robots whose M is singular across bodies without inertia are refused by every algorithm, robots
//! with a light wrist by none.

use core::f64::consts::FRAC_PI_2;

use dynamics_core::algorithms::{
    NotPositiveDefinite, Prescribed, aba, crba, forward_dynamics, frame, hybrid_dynamics, ltdl,
    osim_inverse, spatial_operator_inverse, spatial_operator_ltdl,
};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{BASE, Body, Joint, Model};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use glam::{DMat3, DVec3};
use host_tests::random::{random_numbers, six_points, state_of, within};
use proptest::prelude::RngExt;
use proptest::test_runner::TestRng;

/// The algorithms that run on each robot.
const WAYS: [&str; 7] = [
    "aba",
    "hybrid",
    "mobility",
    "spatial_operator_ltdl",
    "spatial_operator_inverse",
    "forward",
    "factor",
];

fn verdicts<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
    state: &State<R, Q, V>,
) -> [Option<NotPositiveDefinite>; 7] {
    let (tau, scene) = ([R::ONE; V], &RIGID_BODY);
    [
        aba(model, state, &tau, scene).err(),
        hybrid_dynamics(model, state, &tau.map(Prescribed::Torque), scene).err(),
        osim_inverse(model, &state.q, B - 1, frame::LocalWorldAligned, scene).err(),
        spatial_operator_ltdl(model, &state.q, scene).err(),
        spatial_operator_inverse(model, &state.q, scene).err(),
        forward_dynamics(model, state, &tau, scene).err(),
        ltdl(model, &crba(model, &state.q, scene)).err(),
    ]
}

fn in_single<const Q: usize, const V: usize>(state: &State<f64, Q, V>) -> State<f32, Q, V> {
    State {
        q: state.q.map(|x| x as f32),
        qd: state.qd.map(|x| x as f32),
        qdd: state.qdd.map(|x| x as f32),
    }
}

/// The number of robots that each way refuses, in f64 and in f32.
fn refused<const B: usize, const Q: usize, const V: usize>(
    count: usize,
    mut draw: impl FnMut(&mut TestRng) -> (Model<f64, B, Q, V>, State<f64, Q, V>),
) -> [[usize; 7]; 2] {
    let (rng, mut refused) = (&mut random_numbers(), [[0; 7]; 2]);
    for _ in 0..count {
        let (model, state) = draw(rng);
        let double = verdicts(&model, &state);
        let single = verdicts(&model.to_f32(), &in_single(&state));
        for (refused, verdicts) in refused.iter_mut().zip([double, single]) {
            for (refused, verdict) in refused.iter_mut().zip(verdicts) {
                *refused += usize::from(verdict.is_some());
            }
        }
    }
    refused
}

/// Each of `count` robots with a random state is refused by every way.
fn all_refused<const B: usize, const Q: usize, const V: usize>(
    what: &str,
    count: usize,
    draw: impl FnMut(&mut TestRng) -> (Model<f64, B, Q, V>, State<f64, Q, V>),
) {
    let refused = refused(count, draw);
    println!("{what}, {WAYS:?}: {refused:?} of {count} refused");
    assert_eq!(refused, [[count; 7]; 2], "{what}, {WAYS:?}");
}

/// As [`all_refused`] by the ways of articulated bodies; M alone does not show in which frames it
/// was computed.
fn refused_by_bodies<const B: usize, const Q: usize, const V: usize>(
    what: &str,
    count: usize,
    draw: impl FnMut(&mut TestRng) -> (Model<f64, B, Q, V>, State<f64, Q, V>),
) {
    for [aba, hybrid_dynamics, osim_inverse, factor, inverse, ..] in refused(count, draw) {
        let refused = [aba, hybrid_dynamics, osim_inverse, factor, inverse];
        assert_eq!(refused, [count; 5], "{what}, {WAYS:?}");
    }
}

fn solid(rng: &mut TestRng, body: Body) -> Body {
    let (mass, com, inertia) = six_points(|| (rng.random_range(0.1..0.5), within(rng, 0.3)));
    body.mass(mass).com(com).inertia(inertia)
}

/// An arm of inertia on an oblique axis.
fn arm(rng: &mut TestRng) -> Body {
    let body = Body::new("arm", BASE, Joint::revolute(within(rng, 1.0)));
    let body = body.xyz(within(rng, 0.5)).rpy(within(rng, 3.0));
    solid(rng, body)
}

/// Rotations as URDF writes them: about x, then y, then z of the parent.
fn rotation([x, y, z]: [f64; 3]) -> DMat3 {
    DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x)
}

/// A line in a body's frame: a direction, and a point.
#[derive(Clone, Copy)]
struct Line(DVec3, DVec3);

impl Line {
    /// Through the origin.
    fn random(rng: &mut TestRng) -> Self {
        Self(DVec3::from(within(rng, 1.0)), DVec3::ZERO)
    }

    /// The line in the frame of a body that stands at `place` and `turn` of this one.
    fn in_frame(self, place: DVec3, turn: &DMat3) -> Self {
        let Self(along, point) = self;
        Self(turn.transpose() * along, turn.transpose() * (point - place))
    }

    /// A body at random on `parent` whose joint is on this line.
    fn carry(
        self,
        rng: &mut TestRng,
        name: &'static str,
        parent: usize,
        joint: fn([f64; 3]) -> Joint<f64>,
    ) -> Body {
        let rpy = within(rng, 3.0);
        let Self(along, point) = self;
        let place = point + along * rng.random_range(-0.3..0.3);
        let Self(axis, _) = self.in_frame(place, &rotation(rpy));
        let body = Body::new(name, parent, joint(axis.to_array()));
        body.xyz(place.to_array()).rpy(rpy)
    }
}

/// A body at random without inertia.
fn carrier(rng: &mut TestRng, name: &'static str, parent: usize, joint: Joint<f64>) -> Body {
    let body = Body::new(name, parent, joint).xyz(within(rng, 0.3));
    body.rpy(within(rng, 3.0))
}

#[test]
fn two_joints_on_one_axis_are_refused() {
    all_refused("adjacent", 1000, |rng| {
        let axis = Line::random(rng);
        let pedestal = solid(rng, Body::new("pedestal", BASE, Joint::fixed()));
        let motor = carrier(rng, "motor", 1, Joint::revolute(axis.0.to_array()));
        let hand = axis.carry(rng, "hand", 2, Joint::revolute);
        let bodies = [pedestal, arm(rng), motor, solid(rng, hand)];
        let model = Model::<f64, 4, 3, 3>::new("adjacent", bodies);
        let state = state_of(&model, rng);
        (model, state)
    });
}

/// Two turns on one axis, and between them a plate without mass, `reach` away from the axis at
/// most.
fn across_a_plate(rng: &mut TestRng, reach: f64) -> (Model<f64, 4, 3, 3>, State<f64, 3, 3>) {
    let axis = Line::random(rng);
    let motor = carrier(rng, "motor", 0, Joint::revolute(axis.0.to_array()));
    let place = axis.0 * rng.random_range(-0.3..0.3) + DVec3::from(within(rng, 1.0)) * reach;
    let rpy = within(rng, 3.0);
    let plate = Body::new("plate", 1, Joint::fixed()).xyz(place.to_array());
    let across = axis.in_frame(place, &rotation(rpy));
    let hand = across.carry(rng, "hand", 2, Joint::revolute);
    let bodies = [arm(rng), motor, plate.rpy(rpy), solid(rng, hand)];
    let model = Model::new("plate", bodies);
    let state = state_of(&model, rng);
    (model, state)
}

#[test]
fn coaxial_joints_across_a_massless_body_are_refused() {
    all_refused("plate on the axis", 1000, |rng| across_a_plate(rng, 0.0));
    all_refused("plate near the axis", 1000, |rng| across_a_plate(rng, 0.05));
    refused_by_bodies("plate beside it", 1000, |rng| across_a_plate(rng, 0.5));
}

#[test]
fn a_wrist_without_mass_is_refused_in_gimbal_lock() {
    all_refused("gimbal lock", 1000, |rng| {
        let z = carrier(rng, "yaw", 0, Joint::revolute([0.0, 0.0, 1.0]));
        let y = Body::new("pitch", 1, Joint::revolute([0.0, 1.0, 0.0]));
        let x = Body::new("roll", 2, Joint::revolute([1.0, 0.0, 0.0]));
        let bodies = [arm(rng), z, y, solid(rng, x)];
        let model = Model::<f64, 4, 4, 4>::new("wrist", bodies);
        let mut state = state_of(&model, rng);
        state.q[2] = if rng.random_range(0.0..1.0) < 0.5 { FRAC_PI_2 } else { -FRAC_PI_2 };
        (model, state)
    });
}

#[test]
fn a_turn_between_two_slides_on_one_axis_is_refused() {
    all_refused("slide, turn, slide", 1000, |rng| {
        let axis = Line::random(rng);
        let slide = carrier(rng, "slide", 0, Joint::prismatic(axis.0.to_array()));
        let rpy = within(rng, 3.0);
        let axis = axis.in_frame(DVec3::ZERO, &rotation(rpy));
        let turn = Body::new("turn", 1, Joint::revolute(axis.0.to_array())).rpy(rpy);
        let quill = axis.carry(rng, "quill", 2, Joint::prismatic);
        let bodies = [arm(rng), slide, turn, solid(rng, quill)];
        let model = Model::<f64, 4, 4, 4>::new("slides", bodies);
        let state = state_of(&model, rng);
        (model, state)
    });
}

// The revolute joint turns about a line through the centre of the ball.
#[test]
fn a_massless_ball_joint_carrying_a_revolute_is_refused() {
    all_refused("ball and turn", 300, |rng| {
        let ball = carrier(rng, "ball", 0, Joint::spherical());
        let hand = Line::random(rng).carry(rng, "hand", 1, Joint::revolute);
        let bodies = [arm(rng), ball, solid(rng, hand)];
        let model = Model::<f64, 3, 6, 5>::new("ball", bodies);
        let state = state_of(&model, rng);
        (model, state)
    });
}

#[test]
fn a_massless_free_joint_carrying_a_revolute_is_refused() {
    all_refused("free and turn", 300, |rng| {
        let base = carrier(rng, "base", 0, Joint::free());
        let axis = within(rng, 1.0);
        let hand = carrier(rng, "hand", 1, Joint::revolute(axis));
        let bodies = [arm(rng), base, solid(rng, hand)];
        let model = Model::<f64, 3, 9, 8>::new("free", bodies);
        let state = state_of(&model, rng);
        (model, state)
    });
}

/// Two coaxial motors with a plate between them, their bodies small and on an oblique axis.
#[test]
fn a_plate_between_two_motors_on_one_axis_is_named() {
    let far = Model::<f64, 4, 3, 3>::new(
        "far",
        [
            Body::new("arm", BASE, Joint::revolute([0.1, 0.9, -0.3]))
                .xyz([0.1, 0.2, 0.3])
                .rpy([0.3, 0.2, 0.1])
                .mass(2.0)
                .com([0.1, 0.03, -0.1])
                .inertia([0.1, 0.01, 0.02, 0.12, 0.03, 0.11]),
            Body::new("motor 1", 0, Joint::revolute([0.3, -0.2, 1.0]))
                .xyz([0.3, 0.1, 0.2])
                .rpy([0.7, -0.4, 0.9]),
            Body::new("plate", 1, Joint::fixed()).xyz([0.03, -0.02, 0.1]),
            Body::new("hand", 2, Joint::revolute([0.3, -0.2, 1.0]))
                .mass(1.0)
                .com([0.1, 0.0, 0.2])
                .inertia([0.1, 0.0, 0.01, 0.12, 0.0, 0.1]),
        ],
    );
    let rng = &mut random_numbers();
    for _ in 0..100 {
        let state = state_of(&far, rng);
        let double = verdicts(&far, &state);
        let single = verdicts(&far.to_f32(), &in_single(&state));
        for verdicts in [double, single] {
            assert_eq!(verdicts.map(|error| error.map(|error| error.joint)), [Some(1); 7]);
        }
    }
}

/// Light links under a heavy hand are regular: their accelerations give the original torques again.
#[test]
fn a_light_wrist_under_a_heavy_hand_is_regular() {
    let rng = &mut random_numbers();
    for round in 0..1000 {
        let light = 10.0_f64.powi(-(round % 7));
        let mut link = |name, parent, scale: f64| {
            let axis = within(rng, 1.0);
            let body = carrier(rng, name, parent, Joint::revolute(axis));
            let (mass, com, inertia) =
                six_points(|| (scale * rng.random_range(0.1..0.5), within(rng, 0.3)));
            body.mass(mass).com(com).inertia(inertia)
        };
        let bodies = [
            link("arm", BASE, 1.0),
            link("yaw", 0, light),
            link("pitch", 1, light),
            link("hand", 2, 1.0),
        ];
        let model = Model::<f64, 4, 4, 4>::new("light wrist", bodies);
        let state = state_of(&model, rng);
        assert_eq!(verdicts(&model, &state), [None; 7], "{light}");
        let single = verdicts(&model.to_f32(), &in_single(&state));
        assert_eq!(single, [None; 7], "f32, {light}");
    }
}
