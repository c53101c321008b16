//! The bound by a grid of angles, against what is known of it and what is observed.

use super::recorded::{GRAVITY, LITTLE, RNEA, SINES, graph, robot};
use certification::bound::{Bound, Bounder, Enclosure, SineErrors};
use certification::graph::{Graph, Input, Node};
use certification::grid::{Program, between};
use certification::interval::half_ulp;
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

/// Interpolation of signs on the fewest angles is as large between them as the bound says.
#[test]
fn a_polynomial_reaches_the_bound_between_the_points() {
    for degree in 1..=4 {
        for size in 2 * degree + 1..=4 * degree {
            let bound = between(degree, size);
            let angle = |j: f64| std::f64::consts::TAU * j / size as f64;
            // Σ_k cos k(θ − θ_j) with these signs is of the degree, and at the points at most its own greatest value there.
            let mut most = 0.0_f64;
            for pattern in 0..1_u32 << size {
                let sign = |j: usize| f64::from(pattern >> j & 1) * 2.0 - 1.0;
                let at = |theta: f64| -> f64 {
                    let waves = |j: usize| {
                        let wave = |k: usize| 2.0 * (k as f64 * (theta - angle(j as f64))).cos();
                        sign(j) * (1.0 + (1..=degree).map(wave).sum::<f64>())
                    };
                    (0..size).map(waves).sum()
                };
                let on_grid = (0..size).map(|j| at(angle(j as f64)).abs());
                let on_grid = on_grid.fold(1e-9, f64::max);
                most = most.max(at(angle(0.5)).abs() / on_grid);
                if size > 9 {
                    break;
                }
            }
            assert!(most <= bound, "{degree} {size}: {most} {bound}");
            if size == 2 * degree + 1 {
                assert!(size > 9 || most > 0.999 * bound, "{degree}: {most} {bound}");
            }
        }
    }
}

#[test]
fn a_cube_of_a_speed_is_declined() {
    let cube = of(&[Node::Mul(2, 2), Node::Mul(3, 2)]);
    assert!(Program::new(&cube, &robot(6)).is_none());
}

/// 1/(q + 4) of a position between −3 and 3: one at most, where an error of 4 counts as much as one of the result.
#[test]
fn positions_and_quotients_are_bounded_by_parts() {
    let position = Node::Input(Input {
        argument: 2,
        offset: 0,
    });
    let quotient = |shift: f32| Graph {
        nodes: vec![
            position,
            Node::Literal(shift),
            Node::Add(0, 1),
            Node::Literal(1.0),
            Node::Div(3, 2),
        ],
        outputs: vec![(0, 4)],
    };
    let graph = quotient(4.0);
    let bound = bound(&graph, 100_000).expect("the divisor is one at least");
    // Two literals, a sum and a quotient, at q = −3.
    let at_the_end = half_ulp(4.0) + half_ulp(1.0) + half_ulp(1.0) + half_ulp(1.0);
    assert!(
        bound >= at_the_end && bound < 1.1 * at_the_end,
        "{bound:e} {at_the_end:e}"
    );
    let observed = search(&graph, &robot(1), LITTLE, 1)[0].error;
    assert!(observed > 0.0 && observed <= bound);
    // At q = −3 there is no quotient.
    let robot = robot(1);
    let singular = quotient(3.0);
    let program = Program::new(&singular, &robot).expect("a quotient");
    assert_eq!(program.prove(&singular, &robot, SINES, 10_000), None);
}

/// sin q cos² q + sin³ q is of degree three by its terms, and sin q.
#[test]
fn a_greatest_value_knows_what_cancels() {
    let product = of(&[Node::Mul(0, 1)]);
    let sine = of(&[
        Node::Mul(1, 1),
        Node::Mul(0, 0),
        Node::Add(3, 4),
        Node::Mul(5, 0),
    ]);
    for (graph, most) in [(product, 0.5), (sine, 1.0)] {
        let greatest = |fine| {
            let program = Program::new(&graph, &robot(6)).expect("one angle");
            program
                .greatest_value(20, fine)
                .expect("seven points are enough")
        };
        for fine in [5, 6, 100] {
            assert!(greatest(fine) >= most, "{fine}");
        }
        assert!(greatest(100) < 1.01 * most, "{}", greatest(100));
    }
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
