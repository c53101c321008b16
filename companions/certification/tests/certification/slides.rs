//! Absolute values: of a few instructions, and of a slide beyond a turn, whose pivots are compared
//! with what depends on how far it is out.

use certification::bound::{Bounder, Enclosure};
use certification::certificate::{Function, Spent, Subject, expression};
use certification::exact::Exact;
use certification::factors::{Factored, Order};
use certification::forward::{Forward, greatest_over};
use certification::graph::{Graph, Input, Node};
use certification::grid::Program;
use certification::image::Image;
use certification::interval::Interval;
use certification::search::{Evaluation, search};
use certification::state_box::{Joint, Robot};
use certification::walk::{Walked, walk};
use dynamics_core::Core;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::{BASE as NONE, Body, Joint as Of, Model, Robot as _};
use dynamics_core::state::State;

use super::floor;
use super::recorded::{BASE, LITTLE, SINES, bytes, forward_program, robot};

/// Assembled by hand: |3 x − 1|.
const CODE: &str = "92ed000af0ee080a20ee200af7ee000a30ee600ab0eec00a80ed000a7047";

#[test]
fn an_absolute_value_has_the_error_of_its_operand() {
    let walked = walk(&Image::of(BASE, &bytes(CODE)), BASE, [None; 4]);
    let graph = walked.expect("it is followed").graph;
    let input = Node::Input(Input { argument: 2, offset: 0 });
    let of = |last: Node| {
        let nodes = vec![
            input,
            Node::Literal(3.0),
            Node::Mul(0, 1),
            Node::Literal(1.0),
            Node::Sub(2, 3),
            last,
        ];
        let outputs = vec![(0, 5)];
        Graph { nodes, outputs }
    };
    assert_eq!(graph, of(Node::Abs(4)));
    let robot = robot(1);
    let bounder = |graph: &Graph| {
        let mut bounder = Bounder::new(graph, 0, &robot, SINES, Enclosure::WrittenOut);
        let bounder = bounder.as_mut().expect("its input is the robot's");
        (bounder.bound(&robot.whole()).total(), bounder.clone())
    };
    let (bound, absolute) = bounder(&graph);
    let negated = bounder(&of(Node::Neg(4))).0;
    assert!((bound / negated - 1.0).abs() < 1e-12, "{bound:e} {negated:e}");
    let observed = search(&graph, &robot, LITTLE, 1)[0].error;
    assert!(observed > 0.0 && observed <= bound, "{observed:e} {bound:e}");
    // From −10 to 8, and neither end is less than zero without its sign.
    let range = absolute.range();
    assert!(range.low == 0.0 && range.high > 10.0 && range.high < 10.001);
    for (x, y) in [((-3.0, -1.0), (1.0, 3.0)), ((1.0, 3.0), (1.0, 3.0))] {
        assert_eq!(Interval::new(x.0, x.1).abs(), Interval::new(y.0, y.1));
    }
    assert!(Program::new(&graph, &robot).is_none(), "no polynomial");
    assert_eq!(graph.operations(), 2);
}

/// A turn about an oblique axis, and a slide beyond it.
struct Reach;

impl dynamics_core::model::Robot<2, 2, 2> for Reach {
    const MODEL: Model<f64, 2, 2, 2> = Model::new(
        "reach",
        [
            Body::new("turret", NONE, Of::revolute([0.0, 0.0, 1.0]))
                .xyz([0.0, 0.0, 0.3])
                .rpy([0.0, 0.3, 0.0])
                .mass(3.0)
                .com([0.05, 0.02, 0.1])
                .inertia([0.02, 0.0, 0.0, 0.02, 0.0, 0.015]),
            Body::new("arm", 0, Of::prismatic([0.0, 0.0, 1.0]))
                .xyz([0.1, 0.05, 0.2])
                .rpy([0.0, 1.2, 0.0])
                .mass(2.0)
                .com([0.03, 0.01, 0.2])
                .inertia([0.02, 0.0, 0.0, 0.02, 0.0, 0.002]),
        ],
    );
}

/// The machine code of `Engine::<Reach>::forward_dynamics` and `crba`.
const REACH: &str = include_str!("reach.hex");

fn subject() -> Subject {
    Subject::of(&image(), Function::ForwardDynamics).expect("it is the recursion")
}

fn image() -> Image {
    let lines: Vec<Vec<u8>> = REACH.lines().map(bytes).collect();
    let functions = [BASE | 1, (BASE | 1) + lines[0].len() as u32];
    forward_program(lines.concat(), functions, "")
}

fn reach() -> Robot {
    let mut reach = robot(2);
    reach.joints[1] =
        Joint { turns: false, position: Interval::new(-0.2, 0.6), speed: 1.0, acceleration: 10.0 };
    reach
}

fn proven(subject: &Subject) -> Forward {
    let spent = Spent { parts: 300, points: 20_000, search: LITTLE };
    let (robot, bodies) = (reach(), floor::bodies(&Reach::MODEL));
    let exact = Exact::of(Function::ForwardDynamics, || Ok(bodies.clone())).expect("bodies");
    let outputs = subject.outputs(&robot, &exact, SINES, spent).expect("bounds");
    let factored = subject.factored.as_ref().expect("it is forward dynamics");
    let forward = Forward::prove(factored, &outputs, &bodies, &robot, SINES, 2000);
    let mut forward = forward.expect("bounds");
    let searched = forward.search(&subject.walked.graph, &bodies, &robot, LITTLE);
    searched.expect("no error is above its bound");
    forward
}

fn states(robot: &Robot, number: usize) -> impl Iterator<Item = Vec<f64>> {
    let (whole, mut rng) = (robot.whole(), fastrand::Rng::with_seed(3));
    (0..number).map(move |_| {
        let drawn = whole.iter().map(|x| x.low + rng.f64() * (x.high - x.low));
        drawn.map(|x| f64::from(x as f32)).collect()
    })
}

/// The oracle is the core's ABA in f64, which shares no code with the proof or with the search.
#[test]
fn a_slide_beyond_a_turn_has_a_bound() {
    let (subject, robot) = (subject(), reach());
    let forward = proven(&subject);
    assert!(forward.is_total, "{forward:?}");
    let (code, bodies) = (&subject.walked.graph, floor::bodies(&Reach::MODEL));
    let mut evaluation = Evaluation::new(code, &robot);
    for state in states(&robot, 2000) {
        let [q, qd, tau]: [[f64; 2]; 3] =
            std::array::from_fn(|i| std::array::from_fn(|j| state[2 * i + j]));
        let qdd = [0.0; 2];
        let exact = Core::<Reach>::aba(&State { q, qd, qdd }, &tau, &RIGID_BODY);
        let exact = exact.expect("it has inertia");
        let computed: Vec<f64> = evaluation.at(&state).map(|pair| pair.0.into()).collect();
        let at = q.map(certification::bodies::Position::at);
        let matrix = certification::bodies::inertia_matrix(&bodies, 2, &at);
        let inverse = certification::forward::inverse(&matrix).expect("it is positive");
        let bounds = forward.bound(&matrix, &inverse, &computed);
        for joint in 0..2 {
            let error = (computed[joint] - exact[joint]).abs();
            assert!(error <= bounds[joint], "{joint}: {error:e} {bounds:?}");
        }
    }
    // The search finds a tenth of the bound at least: it is no empty one.
    assert!(forward.shares.iter().all(|share| share.error > 0.1), "{:?}", forward.shares);
}

#[test]
fn what_pivots_are_compared_with_is_bounded_over_the_slide() {
    let (subject, robot) = (subject(), reach());
    let factored = subject.factored.as_ref().expect("it is forward dynamics");
    let [(0, node)] = factored.others[..] else {
        panic!("{:?}", factored.others);
    };
    let own = Graph { outputs: vec![(0, node)], ..factored.graph.clone() };
    // −|q| in place of |q|, and q.
    let negated = |node: &Node| match *node {
        Node::Abs(a) => Node::Neg(a),
        node => node,
    };
    let operand = |k: usize| match own.nodes[k] {
        Node::Abs(a) => a,
        _ => k,
    };
    let others: [Vec<Node>; 2] = [
        own.nodes.iter().map(negated).collect(),
        own.nodes.iter().map(|node| node.moved(operand)).collect(),
    ];
    let mirrored = Interval::new(-0.6, 0.2);
    for (range, nodes) in [robot.joints[1].position, mirrored].into_iter().zip(others) {
        let mut robot = robot.clone();
        robot.joints[1].position = range;
        let most = |graph: &Graph| greatest_over(graph, node, &robot, SINES);
        let mut evaluation = Evaluation::new(&own, &robot);
        let mut found = 0.0_f64;
        for state in states(&robot, 2000) {
            let (computed, _) = evaluation.at(&state).next().expect("a number");
            found = found.max(computed.into());
        }
        let proven = most(&own);
        assert!(found <= proven && proven < 1.01 * found, "{found:e} {proven:e}");
        // With a wrong absolute value the proven bound would be less than the values that the code
        // computes.
        let outputs = own.outputs.clone();
        let wrong = most(&Graph { nodes, outputs });
        assert!(wrong < found, "{wrong:e} {found:e}");
    }
    // The code refuses no state: each pivot exceeds what it is compared with.
    for one in &subject.walked.comparisons {
        let both = Graph {
            outputs: one.nodes.map(|node| (0, node)).to_vec(),
            ..subject.walked.graph.clone()
        };
        let mut evaluation = Evaluation::new(&both, &robot);
        for state in states(&robot, 2000) {
            let order = evaluation.at(&state).map(|pair| pair.0);
            assert!(order.is_sorted_by(|a, b| a.partial_cmp(b) == Some(one.ordering)));
        }
    }
    // A position that is not bounded bounds nothing.
    let mut endless = robot.clone();
    endless.joints[1].position.high = f64::INFINITY;
    assert_eq!(greatest_over(&own, node, &endless, SINES), f64::INFINITY);
}

#[test]
fn pivots_that_must_exceed_more_beyond_a_slide_may_be_refused() {
    for (times, is_total) in [(100.0, true), (1e6, false)] {
        let mut subject = subject();
        let factored = subject.factored.as_mut().expect("it is forward dynamics");
        let (nodes, node) = (&mut factored.graph.nodes, &mut factored.others[0].1);
        let factor = nodes.len();
        nodes.extend([Node::Literal(times), Node::Mul(*node, factor)]);
        *node = factor + 1;
        assert_eq!(proven(&subject).is_total, is_total, "{times}");
    }
    // Torques may be any numbers.
    let (mut subject, crba) = (subject(), expression(&image(), Function::Crba));
    let walked = &mut subject.walked;
    let is_torque = |node: &Node| matches!(node, Node::Input(input) if input.argument == 3);
    let torque = walked.graph.nodes.iter().position(is_torque);
    walked.comparisons[0].nodes[1] = torque.expect("forward dynamics");
    let matrix = crba.expect("it is followed").graph;
    let factored = Factored::of(walked, &matrix, Order::Outward);
    let factored = factored.expect("it is the recursion");
    let least = factored.noise[0].map(|noise| noise.least);
    assert_eq!((least, factored.others.len()), (Some(f64::INFINITY), 0));
}

/// 1/√x τ of one joint, by its own inertia and by another one.
#[test]
fn another_root_in_the_matrix_is_refused() {
    let input = |argument, offset| Node::Input(Input { argument, offset });
    let graph =
        |nodes: &[Node]| Graph { nodes: nodes.to_vec(), outputs: vec![(0, nodes.len() - 1)] };
    let forward = [
        input(3, 0),
        input(2, 0),
        Node::Sqrt(1),
        Node::Literal(1.0),
        Node::Div(3, 2),
        Node::Mul(0, 4),
    ];
    let forward = Walked {
        graph: graph(&forward),
        visited: Vec::new(),
        executed: 0,
        comparisons: Vec::new(),
    };
    for (of, is_its_own) in [(0, true), (1, false)] {
        let matrix = graph(&[input(2, 0), input(2, 4), Node::Sqrt(of)]);
        let said = Factored::of(&forward, &matrix, Order::Outward);
        assert_eq!(said.is_ok(), is_its_own, "{of}");
    }
}
