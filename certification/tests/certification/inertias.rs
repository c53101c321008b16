//! What inertias within some percent can change of torques, against the core in f64, a formula and
//! random factors.

use certification::bodies::{Body, Moves};
use certification::error::Error;
use certification::floor::Floor;
use certification::inertias::{Band, Bands, Effort, Links};
use certification::interval::Interval;
use certification::limits::Limits;
use certification::state_box::{Joint, Robot};
use dynamics_core::Core;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{Model, Robot as _};
use dynamics_core::robots::{A1Leg, Ur5e};
use dynamics_core::spatial::SpatialInertia;
use dynamics_core::state::State;

use crate::limits::bodies;

/// The leg of which one link alone has an inertia; the foot is welded on the last.
struct Only<const LINK: usize>;

const fn only(link: usize) -> Model<f64, 4, 3, 3> {
    let mut model = A1Leg::MODEL;
    let mut i = 0;
    while i < 4 {
        if i != link && !(link == 2 && i == 3) {
            model.links[i].inertia = SpatialInertia::ZERO;
        }
        i += 1;
    }
    model
}

impl<const LINK: usize> dynamics_core::model::Robot<4, 3, 3> for Only<LINK> {
    const MODEL: Model<f64, 4, 3, 3> = only(LINK);
}

const LITTLE: Effort = Effort {
    points: 30_000,
    states: 20_000,
};

fn leg() -> Robot {
    let joint = |low: f64, high: f64, speed: f64| Joint {
        turns: true,
        position: Interval::new(low, high),
        speed,
        acceleration: 40.0,
    };
    Robot {
        joints: vec![
            joint(-0.8, 0.8, 21.0),
            joint(-1.0, 4.1, 20.0),
            joint(-2.7, -0.9, 19.0),
        ],
        trig: [12, 4, 8, 0],
    }
}

fn state(robot: &Robot, rng: &mut fastrand::Rng) -> State<f64, 3, 3> {
    let whole = robot.whole();
    let mut part = |i: usize| {
        std::array::from_fn(|j| {
            let Interval { low, high } = whole[3 * i + j];
            match rng.u8(..4) {
                0 => low,
                1 => high,
                _ => low + rng.f64() * (high - low),
            }
        })
    };
    State {
        q: part(0),
        qd: part(1),
        qdd: part(2),
    }
}

/// By the core, by link and joint.
fn by_core(state: &State<f64, 3, 3>) -> [[f64; 3]; 3] {
    [
        Core::<Only<0>>::rnea(state, &RIGID_BODY),
        Core::<Only<1>>::rnea(state, &RIGID_BODY),
        Core::<Only<2>>::rnea(state, &RIGID_BODY),
    ]
}

#[test]
fn each_links_torque_is_the_cores_and_no_factors_exceed_the_bound() {
    let (robot, bodies, mut rng) = (leg(), bodies(&A1Leg::MODEL), fastrand::Rng::with_seed(3));
    let links = Links::of(&bodies).expect("a leg");
    let bands = Bands::prove(&bodies, &robot, 5.0, LITTLE).expect("a leg");
    let mut most = [0.0_f64; 3];
    for number in 0..100_000 {
        let state = state(&robot, &mut rng);
        let each = by_core(&state);
        if number % 100 == 0 {
            let mine = links.torques(&state.q, &state.qd, &state.qdd);
            for (k, link) in each.iter().enumerate() {
                for (i, torque) in link.iter().enumerate() {
                    assert!((mine[i][k] - torque).abs() < 1e-11, "link {k}, joint {i}");
                }
            }
        }
        let factors: [f64; 3] = std::array::from_fn(|_| if rng.bool() { 0.05 } else { -0.05 });
        for (i, most) in most.iter_mut().enumerate() {
            let off: f64 = factors
                .iter()
                .zip(&each)
                .map(|(factor, link)| factor * link[i])
                .sum();
            *most = most.max(off.abs());
        }
    }
    for (most, band) in most.iter().zip(&bands.joints) {
        assert!(
            *most <= band.bound && band.found <= band.bound,
            "{most} {band:?}"
        );
        assert!(
            *most > 0.6 * band.found && band.bound < 3.0 * band.found,
            "{most} {band:?}"
        );
    }
    // For half the speeds, or without a link's mass, what was found contradicts the bound.
    let mut slow = robot.clone();
    slow.joints.iter_mut().for_each(|joint| joint.speed *= 0.5);
    let mut light = bodies.clone();
    light[2].inertia = [0.0; 10];
    for (bodies, robot) in [(&bodies, &slow), (&light, &robot)] {
        let wrong = Bands::prove(bodies, robot, 5.0, LITTLE).expect("a leg");
        let found = bands.joints.iter().zip(&wrong.joints);
        assert!(
            found
                .clone()
                .any(|(right, wrong)| right.found > wrong.bound),
            "{wrong:?}"
        );
    }
}

/// A mass on a horizontal axis, or on a slide: x (m g l + I q̈) and x m (g + q̈).
#[test]
fn a_pendulum_and_a_lift_reach_their_closed_forms() {
    let (mass, arm, turning, most) = (2.0, 0.5, 0.7, 10.0);
    let mut pendulum = Body {
        parent: None,
        moves: Moves::Turns(0),
        // z of the body along x of the base.
        rot: [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
        pos: [0.0, 0.0, 0.3],
        inertia: [
            mass,
            mass * arm,
            0.0,
            0.0,
            0.1,
            0.0,
            0.0,
            turning,
            0.0,
            turning,
        ],
    };
    let mut robot = leg();
    robot.joints.truncate(1);
    robot.joints[0].position = Interval::new(-4.0, 4.0);
    robot.joints[0].acceleration = most;
    let band = |body: &Body, robot: &Robot| {
        let all = Bands::prove(&[*body], robot, 10.0, LITTLE).expect("one joint");
        all.joints[0]
    };
    let exact = 0.1 * (mass * 9.81 * arm + turning * most);
    let of = band(&pendulum, &robot);
    assert!(
        of.bound >= exact && of.bound < exact * (1.0 + 1e-6),
        "{exact} {of:?}"
    );
    assert!(
        of.found <= exact * (1.0 + 1e-12) && of.found > 0.999 * exact,
        "{exact} {of:?}"
    );
    // With limits: gravity's moment is m g l cos q.
    robot.joints[0].position = Interval::new(0.5, 1.0);
    let exact = 0.1 * (mass * 9.81 * arm * 0.5_f64.cos() + turning * most);
    let of = band(&pendulum, &robot);
    assert!(
        of.bound >= exact && of.bound < exact * (1.0 + 1e-6),
        "{exact} {of:?}"
    );
    pendulum.moves = Moves::Slides(0);
    pendulum.rot = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let exact = 0.1 * mass * (9.81 + most);
    let of = band(&pendulum, &robot);
    assert!(
        of.bound >= exact && of.bound < exact * (1.0 + 1e-9),
        "{exact} {of:?}"
    );
}

/// A slide on a turning joint: its position is on the grid by a cosine.
#[test]
fn an_arm_that_slides_out_is_bounded_at_its_reach() {
    let turn = Body {
        parent: None,
        moves: Moves::Turns(0),
        rot: [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
        pos: [0.0; 3],
        inertia: [0.0; 10],
    };
    let slide = Body {
        parent: Some(0),
        moves: Moves::Slides(1),
        // z of the slide along x of the arm.
        rot: [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
        pos: [0.0; 3],
        inertia: [3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    };
    let mut robot = leg();
    robot.joints.truncate(2);
    robot.joints[0].position = Interval::new(-4.0, 4.0);
    let (reach, speed) = (0.9, 0.5);
    robot.joints[1] = Joint {
        turns: false,
        position: Interval::new(0.2, reach),
        speed,
        acceleration: 5.0,
    };
    let bands = Bands::prove(&[turn, slide], &robot, 1.0, LITTLE).expect("an arm");
    let exact = 0.01 * 3.0 * reach * (reach * 40.0 + 2.0 * 21.0 * speed + 9.81);
    let of = bands.joints[0];
    assert!(
        of.bound >= exact && of.bound < 1.01 * exact,
        "{exact} {of:?}"
    );
    assert!(
        of.found <= exact * (1.0 + 1e-12) && of.found > 0.98 * exact,
        "{exact} {of:?}"
    );
}

#[test]
fn the_bound_of_a_ur5e_is_below_three_times_what_is_found() {
    let robot = Robot {
        joints: [3.0, 3.0, 3.0, 6.0, 6.0, 6.0]
            .map(|speed| Joint {
                turns: true,
                position: Interval::new(-7.0, 7.0),
                speed,
                acceleration: 10.0,
            })
            .to_vec(),
        trig: [12, 4, 8, 0],
    };
    let effort = Effort {
        points: 120_000,
        states: 100_000,
    };
    let bands = Bands::prove(&bodies(&Ur5e::MODEL), &robot, 5.0, effort).expect("an arm");
    for band in &bands.joints {
        assert!(
            band.found <= band.bound && band.bound < 3.0 * band.found,
            "{band:?}"
        );
    }
}

#[test]
fn what_is_no_percentage_or_moves_by_one_joint_is_declined() {
    let (robot, mut bodies) = (leg(), bodies(&A1Leg::MODEL));
    for percent in [0.0, -5.0, 101.0, f64::NAN, f64::INFINITY] {
        let declined = Bands::prove(&bodies, &robot, percent, LITTLE);
        assert!(matches!(declined, Err(Error::Robot(_))), "{percent}");
    }
    bodies[1].moves = bodies[0].moves;
    let declined = Bands::prove(&bodies, &robot, 5.0, LITTLE).expect_err("twice");
    assert!(declined.to_string().contains("joint 1"), "{declined}");
}

/// Two legs on one hip: their links are counted once.
#[test]
fn a_tree_is_bounded_by_its_branches() {
    let mut bodies = bodies(&A1Leg::MODEL);
    for k in 1..4 {
        let mut other = bodies[k];
        other.parent = Some(if k == 1 { 0 } else { k + 2 });
        if let Moves::Turns(joint) = other.moves {
            other.moves = Moves::Turns(joint + 2);
        }
        bodies.push(other);
    }
    let mut robot = leg();
    robot.joints.extend_from_within(1..);
    let links = Links::of(&bodies).expect("two legs");
    let found = links.search(&robot, 20_000);
    let bounds = links.bounds(&robot, &found, LITTLE.points);
    for (bound, found) in bounds.iter().zip(&found) {
        assert!(found <= bound && *bound < 2.0 * found, "{found} {bound}");
    }
    // The second leg moves nothing of the first but the hip.
    let torques = links.torques(&[0.3; 5], &[1.0; 5], &[2.0; 5]);
    assert!(torques[1][1] != 0.0 && torques[1][3..].iter().all(|x| *x == 0.0));
    assert!((torques[1][1] - torques[3][3]).abs() < 1e-14 && torques[0][4] != 0.0);
}

#[test]
fn the_sheet_has_the_bands_and_refuses_a_band_below_what_was_found() {
    let mut limits = Limits {
        robot: "leg".to_owned(),
        speeds: Vec::new(),
        floor: Floor::default(),
        bands: Some(Bands {
            percent: 5.0,
            joints: vec![Band {
                bound: 1.5,
                found: 1.0,
            }],
        }),
    };
    assert!(limits.check().is_ok());
    assert!(limits.markdown().contains("| 1 | 1.500 | 1.000 | 1.50 |"));
    let json = serde_json::to_value(&limits).expect("data");
    assert_eq!(json["bands"]["joints"][0]["bound"], 1.5);
    for wrong in [0.9, f64::NAN] {
        limits.bands.as_mut().expect("it has them").joints[0].bound = wrong;
        let said = limits.check().expect_err("below").to_string();
        assert!(said.starts_with("torque of joint 1 by inertias"), "{said}");
    }
}
