//! The bound by a grid of angles, against what is known of it and what is observed.

use super::recorded::{GRAVITY, LITTLE, RNEA, SINES, graph, robot};
use certification::bound::{Bound, Bounder, Enclosure, SineErrors};
use certification::graph::{Graph, Input, Node};
use certification::grid::Program;
use certification::search::{Effort, search};

const POINTS: usize = 10_000;

/// sin q of joint 1, its cosine, and the speed of joint 1 of six.
const INPUTS: [Node; 3] = [
    Node::Input(Input {
        argument: 1,
        offset: 4,
    }),
    Node::Input(Input {
        argument: 1,
        offset: 8,
    }),
    Node::Input(Input {
        argument: 2,
        offset: 24,
    }),
];

fn of(nodes: &[Node]) -> Graph {
    Graph {
        nodes: [INPUTS.as_slice(), nodes].concat(),
        outputs: vec![(0, INPUTS.len() + nodes.len() - 1)],
    }
    .of_output(0)
}

fn bound(graph: &Graph, points: usize) -> Option<f64> {
    let robot = robot(6);
    let program = Program::new(graph, &robot)?;
    Some(program.prove(graph, &robot, SINES, points)?.total())
}

#[test]
fn no_observed_error_is_above_the_bound_of_a_grid() {
    for (hex, outputs) in [(RNEA, 4..6), (GRAVITY, 0..6)] {
        let (graph, robot) = (graph(hex), robot(6));
        let observed = search(&graph, &robot, LITTLE, 1);
        for (output, observed) in observed
            .iter()
            .enumerate()
            .filter(|one| outputs.contains(&one.0))
        {
            let bound = bound(&graph.of_output(output), POINTS).expect("angles alone");
            assert!(
                observed.error <= bound,
                "{output}: {:e} {bound:e}",
                observed.error
            );
        }
    }
}

/// Half of sin 2q is ½ between the points of an odd grid, where a product has twice the error that it has below.
#[test]
fn what_lies_between_the_points_is_bounded() {
    let graph = of(&[Node::Mul(0, 1)]);
    let error = |points: usize| {
        let robot = robot(6);
        let program = Program::new(&graph, &robot).expect("one angle");
        program
            .prove(&graph, &robot, SineErrors::default(), points)
            .map(Bound::total)
    };
    let half_ulp_of_a_half = 2.0_f64.powi(-25);
    for points in [5, 7, 9, 31] {
        assert!(error(points) >= Some(half_ulp_of_a_half), "{points}");
    }
    assert!(error(5) > error(31));
    assert_eq!(error(4), None, "degree two asks for five angles");
}

/// The torque of gravity about a vertical axis is zero for any angles: errors of sines do not reach it.
#[test]
fn what_cancels_has_no_part_in_the_bound() {
    let (graph, robot) = (graph(GRAVITY).of_output(0), robot(6));
    let program = Program::new(&graph, &robot).expect("angles alone");
    let by_grid = program
        .prove(&graph, &robot, SINES, POINTS)
        .expect("enough points");
    let by_parts = Bounder::new(&graph, 0, &robot, SINES, Enclosure::WrittenOut)
        .expect("its inputs are the robot's")
        .bound(&robot.whole());
    assert!(
        by_grid.sines < 1e-12 * by_parts.sines,
        "{by_grid:?} {by_parts:?}"
    );
    assert!(by_grid.total() < 0.3 * by_parts.total());
}

#[test]
fn a_cube_of_a_speed_and_a_joint_that_slides_are_declined() {
    let cube = of(&[Node::Mul(2, 2), Node::Mul(3, 2)]);
    assert!(Program::new(&cube, &robot(6)).is_none());
    let slides = Graph {
        nodes: vec![
            Node::Input(Input {
                argument: 2,
                offset: 0,
            }),
            Node::Add(0, 0),
        ],
        outputs: vec![(0, 1)],
    };
    assert!(Program::new(&slides, &robot(6)).is_none());
}

/// A square of a speed is as large at −3 as at 3, and its error that of nine.
#[test]
fn speeds_are_at_their_greatest() {
    let square = of(&[Node::Mul(2, 2)]);
    let none = SineErrors::default();
    let robot = robot(6);
    let bound = Program::new(&square, &robot)
        .and_then(|program| program.prove(&square, &robot, none, 10))
        .expect("no angle")
        .total();
    let half_ulp_of_nine = 2.0_f64.powi(-21);
    assert!((bound / half_ulp_of_nine - 1.0).abs() < 1e-6, "{bound:e}");
    let effort = Effort {
        random: 100,
        ..LITTLE
    };
    assert!(search(&square, &robot, effort, 1)[0].error <= bound);
}
