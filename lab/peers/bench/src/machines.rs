//! The robots with kinematic loops that are compared on the target, as `lab/peers/cpp/generate.cpp` reads them.

use cluster_tests::recorded::recording;
use dynamics_core::loops::LoopRobot;
use dynamics_core::model::Robot as _;
use dynamics_core::robots::A1Free;
use firmware_demo::robots::pick_delta::SIDES;
use firmware_demo::robots::{FourBarLeg, PickDelta};
use host_tests::export::{Placement, Robot, robot};
use loop_tests::export::loops;
use loop_tests::machines::{Delta, FiveBar, FourBar};

use crate::loops::Theirs;

/// Two points that coincide, each on a body; −1 is the base.
type Points = [(i64, [f64; 3]); 2];

/// All of them.
pub fn all() -> String {
    let rods = [0, 1, 2].map(|arm| {
        let radius = PickDelta::PLATFORM;
        let on_platform = SIDES[arm].map(|side| radius * side);
        let tip = [0.0, 0.0, -PickDelta::ROD];
        let body = 3 * arm as i64 + 2;
        [(11, [on_platform[0], on_platform[1], 0.0]), (body, tip)]
    });
    let knee = recording("four_bar_leg");
    let knee = knee
        .loops
        .iter()
        .map(|of| [0, 1].map(|k| (of.bodies[k], of.points[k])));
    // A foot's frame is its centre, held wherever it is.
    let feet = [4, 8, 12, 16].map(|foot| [(-1, [0.0; 3]), (foot, [0.0; 3])]);
    let held = Robot {
        name: "a1_held".into(),
        ..robot(&A1Free::MODEL)
    };
    let legs: Vec<usize> = (6..18).collect();
    let texts = [
        general::<FourBar, 3, 3, 3, 1, 5, 1>(),
        general::<FiveBar, 4, 4, 4, 1, 5, 2>(),
        general::<Delta, 10, 22, 21, 6, 18, 3>(),
        text(&robot(&FourBarLeg::MODEL), knee, &[0, 1, 4]),
        text(&robot(&PickDelta::MODEL), rods, &PickDelta::MOTORS),
        text(&held, feet, &legs),
    ];
    texts.concat()
}

/// A robot of general loops.
fn general<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
>() -> String
where
    T: LoopRobot<B, Q, V, L, C, A>,
{
    let points = loops(&T::LOOPS)
        .into_iter()
        .map(|joint| [0, 1].map(|end| (joint.bodies[end], joint.placements[end].position)));
    text(&robot(&T::MODEL), points, T::LOOPS.actuated())
}

fn text(robot: &Robot, points: impl IntoIterator<Item = Points>, actuated: &[usize]) -> String {
    let rotation = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let mut robot = robot.clone();
    for body in &mut robot.bodies {
        // Rounding of the way back to the centre of mass: CasADi drops products with exact zeros only.
        let [xx, _, _, yy, _, zz] = body.inertia_com;
        for entry in &mut body.inertia_com {
            if entry.abs() < 1e-15 * (xx + yy + zz) {
                *entry = 0.0;
            }
        }
    }
    let end = |(body, position)| (body, Placement { rotation, position });
    let ends: Vec<_> = points.into_iter().map(|points| points.map(end)).collect();
    Theirs::new(&robot, &ends, actuated, 0.0).text
}
