//! The bound by a grid of angles, against what is known of it and what is observed.

use std::f64::consts::{PI, TAU};

use certification::bound::{Bound, Bounder, SineErrors};
use certification::branch::prove;
use certification::graph::{Graph, Input, Node};
use certification::grid::{Program, between};
use certification::interval::half_ulp;
use certification::search::{Effort, Evaluation, search};

use super::recorded::{GRAVITY, LITTLE, RNEA, SINES, graph, robot};

const POINTS: usize = 10_000;

/// sin q of joint 1, its cosine, and the speed of joint 1 of six.
const INPUTS: [Node; 3] = [
    Node::Input(Input { argument: 1, offset: 4 }),
    Node::Input(Input { argument: 1, offset: 8 }),
    Node::Input(Input { argument: 2, offset: 24 }),
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
    Some(program.prove(graph, &robot, SINES, points, &[])?.total())
}

#[test]
fn no_observed_error_is_above_the_bound_of_a_grid() {
    for (hex, outputs) in [(RNEA, 4..6), (GRAVITY, 0..6)] {
        let (graph, robot) = (graph(hex), robot(6));
        let observed = search(&graph, &robot, LITTLE, 1);
        for (output, observed) in observed.iter().enumerate().filter(|one| outputs.contains(&one.0))
        {
            let bound = bound(&graph.of_output(output), POINTS).expect("angles alone");
            assert!(observed.error <= bound, "{output}: {:e} {bound:e}", observed.error);
        }
    }
}

/// Half of sin 2q is ½ between the points of an odd grid, where a product has twice the error that
/// it has below.
#[test]
fn what_lies_between_the_points_is_bounded() {
    let graph = of(&[Node::Mul(0, 1)]);
    let error = |points: usize| {
        let robot = robot(6);
        let program = Program::new(&graph, &robot).expect("one angle");
        program.prove(&graph, &robot, SineErrors::default(), points, &[]).map(Bound::total)
    };
    let half_ulp_of_a_half = 2.0_f64.powi(-25);
    for points in [5, 7, 9, 31] {
        assert!(error(points) >= Some(half_ulp_of_a_half), "{points}");
    }
    // By Riesz' factor, 3.24, it would be twice as much.
    assert!(error(5) < Some(1.01 * half_ulp_of_a_half));
    assert_eq!(error(4), None, "degree two asks for five angles");
}

/// On 2n + 1 angles the factor is the constant of Lebesgue. A polynomial that is at most one on the
/// grid is found nearly as large.
#[test]
fn the_factor_between_the_points_is_enough_and_less_than_riesz() {
    for (angles, lebesgue) in [(3, 5.0 / 3.0), (5, 1.98885), (7, 2.20221)] {
        let factor = between(angles / 2, angles);
        assert!((factor / lebesgue - 1.0).abs() < 1e-2, "{angles}: {factor}");
    }
    let up_to_nine =
        (1..=4).flat_map(|n| (2 * n + 1..=9.min(4 * n)).map(move |angles| (n, angles)));
    for (degree, angles) in up_to_nine.chain([(3, 10), (4, 11), (3, 13)]) {
        let factor = between(degree, angles);
        let riesz = 1.0 / (PI * degree as f64 / angles as f64).cos();
        assert!(factor <= riesz);
        // The values at the angles of the grid by which the polynomial of least squares through
        // them is the greatest half way.
        let mut most = 0.0_f64;
        for signs in 0..1_u32 << angles {
            let value = |j: usize| if signs >> j & 1 == 0 { 1.0 } else { -1.0 };
            let at = |x: f64| {
                let of = |j: usize| {
                    let t = x - TAU * j as f64 / angles as f64;
                    let terms = (1..=degree).map(|m| 2.0 * (m as f64 * t).cos());
                    value(j) * (1.0 + terms.sum::<f64>()) / angles as f64
                };
                (0..angles).map(of).sum::<f64>().abs()
            };
            let on_grid = (0..angles).map(|j| at(TAU * j as f64 / angles as f64));
            let on_grid = on_grid.fold(0.0, f64::max);
            // Alternating signs leave rounding errors alone.
            if on_grid > 0.1 {
                most = most.max(at(PI / angles as f64) / on_grid);
            }
        }
        assert!(most <= factor, "{degree}, {angles}: {most} > {factor}");
        // On the fewest angles the polynomials are those of any signs.
        let reached = if angles == 2 * degree + 1 { 0.999 } else { 0.85 };
        assert!(most > reached * factor, "{degree}, {angles}: {most} {factor}");
    }
}

/// Known bounds of values lower the errors, and wrong bounds are contradicted.
#[test]
fn values_that_are_known_to_be_less_count() {
    let (graph, robot) = (graph(RNEA).of_output(4), robot(6));
    let program = Program::new(&graph, &robot).expect("angles alone");
    let bound = |known: &[f64]| {
        let bound = program.prove(&graph, &robot, SINES, POINTS, known);
        bound.expect("enough points").total()
    };
    let mut bounder = Bounder::new(&graph, 0, &robot, SINES).expect("its inputs are the robot's");
    let known = prove(&mut bounder, &robot.whole(), 200).magnitudes;
    let mut evaluation = Evaluation::new(&graph, &robot);
    let whole: Vec<f64> = robot.whole().iter().map(|x| x.high).collect();
    let (single, _) = evaluation.at(&whole).next().expect("a result");
    assert!(f64::from(single.abs()) <= known[known.len() - 1]);
    let observed = search(&graph, &robot, LITTLE, 1)[0].error;
    assert!(observed <= bound(&known) && bound(&known) < bound(&[]));
    let product = of(&[Node::Mul(0, 1)]);
    let program = Program::new(&product, &robot).expect("one angle");
    let bound = |known: &[f64]| {
        let bound = program.prove(&product, &robot, SineErrors::default(), 31, known);
        bound.expect("enough points").total()
    };
    // Half of sin 2q is no tenth.
    let half_ulp_of_a_half = 2.0_f64.powi(-25);
    assert!(bound(&[1.0, 1.0, 0.51]) >= half_ulp_of_a_half);
    assert!(bound(&[1.0, 1.0, 0.1]) < half_ulp_of_a_half);
}

/// The torque of gravity about a vertical axis is zero for any angles: errors of sines do not reach
/// it.
#[test]
fn what_cancels_has_no_part_in_the_bound() {
    let (graph, robot) = (graph(GRAVITY).of_output(0), robot(6));
    let program = Program::new(&graph, &robot).expect("angles alone");
    let by_grid = program.prove(&graph, &robot, SINES, POINTS, &[]).expect("enough points");
    let by_parts = Bounder::new(&graph, 0, &robot, SINES)
        .expect("its inputs are the robot's")
        .bound(&robot.whole());
    assert!(by_grid.sines < 1e-12 * by_parts.sines, "{by_grid:?} {by_parts:?}");
    assert!(by_grid.total() < 0.3 * by_parts.total());
}

#[test]
fn a_cube_of_a_speed_is_declined() {
    let cube = of(&[Node::Mul(2, 2), Node::Mul(3, 2)]);
    assert!(Program::new(&cube, &robot(6)).is_none());
}

/// 1/(q + 4) of a position between −3 and 3: one at most, where an error of 4 counts as much as one
/// of the result.
#[test]
fn positions_and_quotients_are_bounded_by_parts() {
    let position = Node::Input(Input { argument: 2, offset: 0 });
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
    assert!(bound >= at_the_end && bound < 1.1 * at_the_end, "{bound:e} {at_the_end:e}");
    let observed = search(&graph, &robot(1), LITTLE, 1)[0].error;
    assert!(observed > 0.0 && observed <= bound);
    // At q = −3 there is no quotient.
    let robot = robot(1);
    let singular = quotient(3.0);
    let program = Program::new(&singular, &robot).expect("a quotient");
    assert_eq!(program.prove(&singular, &robot, SINES, 10_000, &[]), None);
}

/// sin q cos² q + sin³ q is of degree three by its terms, and sin q.
#[test]
fn a_greatest_value_knows_what_cancels() {
    let product = of(&[Node::Mul(0, 1)]);
    let sine = of(&[Node::Mul(1, 1), Node::Mul(0, 0), Node::Add(3, 4), Node::Mul(5, 0)]);
    for (graph, most) in [(product, 0.5), (sine, 1.0)] {
        let greatest = |fine| {
            let program = Program::new(&graph, &robot(6)).expect("one angle");
            program.greatest_value(20, fine).expect("seven points are enough")
        };
        for fine in [5, 6, 100] {
            assert!(greatest(fine) >= most, "{fine}");
        }
        assert!(greatest(100) < 1.01 * most, "{}", greatest(100));
    }
}

/// sin⁴ q is 3/8 − ½ cos 2q + ⅛ cos 4q. With the fifth power, a wave may be off by more than the
/// proof adds.
#[test]
fn a_greatest_value_of_a_higher_degree_or_too_many_points_is_declined() {
    let greatest = |graph: &Graph, joints: usize| {
        let program = Program::new(graph, &robot(joints)).expect("angles alone");
        program.greatest_value(1_000_000, 1_000_000)
    };
    let products = [0, 3, 4, 5].map(|before| Node::Mul(before, 0));
    let power = |n: usize| of(&products[..n - 1]);
    let most = greatest(&power(4), 6).expect("nine angles");
    assert!((1.0..1.01).contains(&most), "{most}");
    assert_eq!(greatest(&power(5), 6), None);
    // Three angles of each of 41 joints are more points than a number has.
    let sine = |joint: u32| {
        let (argument, offset) = (1, 12 * joint + 4);
        Node::Input(Input { argument, offset })
    };
    let mut nodes: Vec<Node> = (0..41).map(sine).collect();
    nodes.push(Node::Mul(0, 1));
    nodes.extend((2..41).map(|joint| Node::Mul(39 + joint, joint)));
    let outputs = vec![(0, nodes.len() - 1)];
    assert_eq!(greatest(&Graph { nodes, outputs }, 41), None);
}

/// A square of a speed is as large at −3 as at 3, and its error that of nine.
#[test]
fn speeds_are_at_their_greatest() {
    let square = of(&[Node::Mul(2, 2)]);
    let none = SineErrors::default();
    let robot = robot(6);
    let bound = Program::new(&square, &robot)
        .and_then(|program| program.prove(&square, &robot, none, 10, &[]))
        .expect("no angle")
        .total();
    let half_ulp_of_nine = 2.0_f64.powi(-21);
    assert!((bound / half_ulp_of_nine - 1.0).abs() < 1e-6, "{bound:e}");
    let effort = Effort { random: 100, ..LITTLE };
    assert!(search(&square, &robot, effort, 1)[0].error <= bound);
}
