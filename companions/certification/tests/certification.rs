//! The checks of certificates, each with what it refuses.

#[path = "certification/configurations.rs"]
mod configurations;
#[path = "certification/grid.rs"]
mod grid;
#[path = "certification/loops.rs"]
mod loops;
#[path = "certification/recorded.rs"]
mod recorded;
#[path = "certification/target.rs"]
mod target;

use certification::bound::Bounder;
use certification::branch::prove;
use certification::certificate::{Function, Spent, outputs};
use certification::error::Error;
use certification::exact::Exact;
use certification::graph::{Graph, Input, Node};
use certification::image::Image;
use certification::interval::{Interval, half_ulp};
use certification::program::{CLUSTERED, Program};
use certification::search::{self, Evaluation, search};
use certification::state_box::{Robot, Sector};
use certification::walk::walk;
use dynamics_core::Core;
use dynamics_core::effects::{Gravity, RIGID_BODY};
use dynamics_core::model::{BASE as NONE, Body, Joint, Model, Robot as _};
use dynamics_core::robots::{A1Leg, Ur5e};
use dynamics_core::state::State;
use recorded::{BASE, GRAVITY, LITTLE, RNEA, SINES, bodies, bytes, graph, robot};

/// Assembled by hand: `good` at 0, `loop` at 0x30, `convert` at 0x44, `spoil` at 0x4e.
const CODE: &str = "80b591ed010ad1ed020a92ed011a60ee011a20ee812a71eee01af6ee082a22ee622ac0ed001a32ee212a80ed012a80bd032391ed010a30ee000a013b\
fbd180ed000a704791ed010ab8eec00a704791ed010a82ed000a7047";
fn function(at: u32) -> Result<Graph, Error> {
    walk(&Image::of(BASE, &bytes(CODE)), BASE + at, [None; 4]).map(|walked| walked.graph)
}

fn bounder(graph: &Graph, output: usize, robot: &Robot) -> Bounder {
    Bounder::new(graph, output, robot, SINES).expect("its inputs are the robot's")
}

#[test]
fn the_graph_is_that_of_the_instructions() {
    use Node::{Add, Literal, Mul, Neg, Sub};
    let input = |argument, offset| Node::Input(Input { argument, offset });
    let graph = function(0).expect("it is straight-line");
    let nodes = [
        input(1, 4),
        input(1, 8),
        input(2, 4),
        Mul(0, 2),
        Mul(1, 2),
        Sub(3, 1),
        Literal(0.75),
        Mul(4, 6),
        Neg(7),
        Add(8, 5),
    ];
    assert_eq!(graph.nodes, nodes);
    assert_eq!(graph.outputs, [(0, 5), (4, 9)]);
}

#[test]
fn a_loop_of_constant_length_is_followed() {
    let graph = function(0x30).expect("it is straight-line");
    assert_eq!(graph.operations(), 3);
}

#[test]
fn an_it_block_executes_what_its_conditions_let() {
    // Compares 1 with 2: itete lt of vadd, vmul, mov 4 and mov 2; then whether that with its last
    // bit set is 5: it eq of vneg.
    let code =
        "91ed010ad1ed020a0123022bb5bf30ee200a20ee200a0423022343f00103052b08bfb1ee400a80ed000a7047";
    let image = Image::of(BASE, &bytes(code));
    let graph = walk(&image, BASE, [None; 4]).expect("it is followed").graph;
    let nodes = [Node::Add(0, 1), Node::Neg(2)];
    assert_eq!((&graph.nodes[2..], graph.outputs[0].1), (&nodes[..], 3));
}

#[test]
fn what_is_not_proven_is_declined_with_its_address() {
    let declined = function(0x44).expect_err("a conversion");
    assert!(
        matches!(declined, Error::Declined { address, .. } if address == BASE + 0x48),
        "{declined}"
    );
    let declined = function(0x4e).expect_err("a store to an input");
    assert!(
        matches!(declined, Error::Declined { address, .. } if address == BASE + 0x52),
        "{declined}"
    );
    // strb r0, [r1, #4]; bx lr
    let declined = walk(&Image::of(BASE, &bytes("08717047")), BASE, [None; 4]);
    assert!(matches!(declined, Err(Error::Declined { address: BASE, .. })), "a part of an input");
}

#[test]
fn a_byte_of_a_known_word_is_loaded_and_one_of_a_real_number_is_declined() {
    let of = |store: &str| {
        // vldr s0; movs r3, #2; lsls r3, #8; a store; ldrb r2, [sp, #-3]; cmp r2, #2; it eq; vneg
        let code = format!("91ed010a02231b02{store}1df8032c022a08bfb1ee400a80ed000a7047");
        walk(&Image::of(BASE, &bytes(&code)), BASE, [None; 4])
    };
    // str r3, or vstr s0, [sp, #-4]
    let nodes = of("4df8043c").expect("the byte is 2").graph.nodes;
    assert_eq!(nodes.last(), Some(&Node::Neg(0)));
    let declined = of("0ded010a").expect_err("bits of a real number");
    let at = BASE + 12;
    assert!(matches!(declined, Error::Declined { address, .. } if address == at), "{declined}");
}

#[test]
fn a_function_that_is_asked_for_twice_is_proven_once() {
    let of =
        |robot: &str| Program { robot: robot.to_owned(), elf: Vec::new(), rustc: String::new() };
    let asked = [Function::Core, Function::Rnea, Function::Core];
    assert_eq!(of("ur5e").functions(&asked), asked[..2]);
    assert_eq!(of(CLUSTERED).functions(&asked), [Function::Clustered]);
}

/// The core in f64 knows nothing of machine code, base parameters and literals.
#[test]
fn the_expression_is_inverse_dynamics() {
    let robot = robot(6);
    let mut rng = fastrand::Rng::with_seed(1);
    for (hex, gravity_alone) in [(RNEA, false), (GRAVITY, true)] {
        let graph = graph(hex);
        let mut evaluation = Evaluation::new(&graph, &robot);
        let bounds: Vec<f64> = (0..6)
            .map(|output| bounder(&graph, output, &robot).bound(&robot.whole()).total())
            .collect();
        for _ in 0..50 {
            let state: Vec<f64> = robot
                .whole()
                .iter()
                .map(|x| f64::from((x.low + rng.f64() * (x.high - x.low)) as f32))
                .collect();
            let part = |i: usize| std::array::from_fn(|j| state[6 * i + j]);
            let exact = State { q: part(0), qd: part(1), qdd: part(2) };
            let tau: [f64; 6] = if gravity_alone {
                Core::<Ur5e>::rnea(&exact, &(Gravity::EARTH,))
            } else {
                Core::<Ur5e>::rnea(&exact, &RIGID_BODY)
            };
            for (joint, (single, _)) in evaluation.at(&state).enumerate() {
                let error = (f64::from(single) - tau[joint]).abs();
                assert!(error <= bounds[joint], "joint {joint}: {error:e} > {:e}", bounds[joint]);
            }
        }
    }
    assert_eq!(Ur5e::MODEL.links.len(), 6);
}

#[test]
fn observed_errors_include_those_of_the_literals() {
    let (graph, robot) = (graph(GRAVITY), robot(6));
    let exact = Exact::of(Function::Gravity, || Ok(bodies(&Ur5e::MODEL))).expect("bodies");
    let [with, without] =
        [search::against(&exact, &graph, &robot, LITTLE, 1), search(&graph, &robot, LITTLE, 1)];
    // The weight on the shoulder: a tenth of its bound is of literals.
    let (with_literals, alone) = (with[1].error, without[1].error);
    assert!(with_literals > 1.1 * alone, "{with_literals:e} {alone:e}");
    let bound = bounder(&graph, 1, &robot).bound(&robot.whole());
    assert!(with_literals <= bound.total());
    // The core in f64 says the same at the worst state.
    let state = State::at(std::array::from_fn(|k| with[1].state[k]));
    let tau: [f64; 6] = Core::<Ur5e>::rnea(&state, &(Gravity::EARTH,));
    let computed = Evaluation::new(&graph, &robot).at(&with[1].state).nth(1).expect("the shoulder");
    let error = (f64::from(computed.0) - tau[1]).abs();
    assert!((error - with_literals).abs() < 1e-12, "{error:e} {with_literals:e}");
    // A literal that is off by some units is found, and a bound that trusts it contradicted.
    let mut wrong = graph.clone();
    let literals = wrong.nodes.iter_mut().filter_map(|node| match node {
        Node::Literal(x) if x.abs() > 1.0 => Some(x),
        _ => None,
    });
    for literal in literals {
        *literal *= 1.0 + 20.0 * f32::EPSILON;
    }
    let off = search::against(&exact, &wrong, &robot, LITTLE, 1)[1].error;
    let trusted = bounder(&wrong, 1, &robot).bound(&robot.whole()).total();
    assert!(off > trusted, "{off:e} {trusted:e}");
    assert!(search(&wrong, &robot, LITTLE, 1)[1].error < trusted);
    let spent = Spent { parts: 100, points: 10_000, search: LITTLE };
    let certified = |graph: &Graph| outputs(graph, &robot, &exact, SINES, spent);
    assert!(certified(&graph).is_ok());
    assert!(matches!(certified(&wrong), Err(Error::Contradicted { .. })));
}

/// A turn about an oblique axis, and a slide beyond it.
struct Reach;

impl dynamics_core::model::Robot<2, 2, 2> for Reach {
    const MODEL: Model<f64, 2, 2, 2> = Model::new(
        "reach",
        [
            Body::new("turret", NONE, Joint::revolute([0.0, 0.0, 1.0]))
                .rpy([0.0, 0.3, 0.0])
                .mass(3.0)
                .com([0.05, 0.02, 0.1])
                .inertia([0.02, 0.0, 0.0, 0.02, 0.0, 0.015]),
            Body::new("arm", 0, Joint::prismatic([0.0, 0.0, 1.0]))
                .xyz([0.1, 0.05, 0.2])
                .rpy([0.0, 1.2, 0.0])
                .mass(2.0)
                .com([0.03, 0.01, 0.2])
                .inertia([0.02, 0.0, 0.0, 0.02, 0.0, 0.002]),
        ],
    );
}

fn differs<T: dynamics_core::model::Robot<B, N, N>, const B: usize, const N: usize>() -> f64 {
    let exact = Exact::of(Function::Rnea, || Ok(bodies(&T::MODEL))).expect("bodies");
    let mut rng = fastrand::Rng::with_seed(1);
    let state: Vec<f64> = (0..3 * N).map(|_| 4.0 * rng.f64() - 2.0).collect();
    let part = |i: usize| std::array::from_fn(|j| state[N * i + j]);
    let tau = Core::<T>::rnea(&State { q: part(0), qd: part(1), qdd: part(2) }, &RIGID_BODY);
    let exact = exact.at(&state, 0..N);
    exact.iter().zip(tau).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn exact_torques_of_turns_slides_and_fixed_bodies_are_the_cores() {
    assert!(differs::<Reach, 2, 2>() < 1e-13);
    assert!(differs::<A1Leg, 4, 3>() < 1e-13);
}

#[test]
fn no_observed_error_is_above_the_bound_and_a_wrong_graph_has_one() {
    let (graph, robot) = (graph(GRAVITY), robot(6));
    let observed = search(&graph, &robot, LITTLE, 1);
    for (output, observed) in observed.iter().enumerate() {
        let proven = prove(&mut bounder(&graph, output, &robot), &robot.whole(), 100);
        assert!(observed.error <= proven.bound.total());
        assert!(proven.reached <= proven.bound.total() * (1.0 + 1e-9));
        // At a point nothing is lost: the bound is sharp up to how roundings add up.
        let here: Vec<Interval> = observed.state.iter().map(|x| Interval::point(*x)).collect();
        let at = bounder(&graph, output, &robot).bound(&here).total();
        assert!(
            observed.error <= at && at <= 10.0 * observed.error.max(1e-9),
            "{:e} {at:e}",
            observed.error
        );
    }
    // A product that was lost: the machine code has errors that the wrong graph has not.
    let mut wrong = graph.clone();
    let product = |node: &Node| matches!(node, Node::Mul(..));
    for node in wrong.nodes.iter_mut().filter(|node| product(node)) {
        *node = Node::Literal(0.0);
    }
    let contradicted = |output: usize| {
        bounder(&wrong, output, &robot).bound(&robot.whole()).total() < observed[output].error
    };
    assert!((0..5).any(contradicted));
}

#[test]
fn parts_lower_the_bound_and_cover_the_box() {
    let (graph, robot) = (graph(GRAVITY), robot(6));
    let whole = robot.whole();
    let mut one = bounder(&graph, 1, &robot);
    let (few, many) = (prove(&mut one, &whole, 1), prove(&mut one, &whole, 200));
    assert!(many.bound.total() < few.bound.total());
    let volume = |states: &[Interval]| {
        one_axes(&graph, &robot)
            .iter()
            .map(|axis| states[*axis].high - states[*axis].low)
            .product::<f64>()
    };
    let sum: f64 = many.parts.iter().map(|part| volume(&part.states)).sum();
    assert!((sum / volume(&whole) - 1.0).abs() < 1e-9);
}

fn one_axes(graph: &Graph, robot: &Robot) -> Vec<usize> {
    bounder(graph, 1, robot).axes()
}

#[test]
fn intervals_are_rounded_outward() {
    let tenth = Interval::point(0.1);
    let sum = (0..10).fold(Interval::default(), |sum, _| sum + tenth);
    // Ten times the f64 next to 0.1 is 1 + 5.55e-17, which is no f64.
    assert!(sum.low <= 1.0 && sum.high > 1.0 && sum.high - sum.low < 1e-14);
    assert_eq!(half_ulp(1.0), 2.0_f64.powi(-24));
    assert_eq!(half_ulp(0.999), 2.0_f64.powi(-25));
    let sector = Interval::new(0.3, 1.1);
    let range = Sector::new(sector).rotated(Interval::new(-1.0, 2.0), Interval::new(0.5, 3.0));
    let mut hull = Interval::new(f64::INFINITY, f64::NEG_INFINITY);
    for i in 0..=1000 {
        let (s, c) = (0.3 + 0.8 * f64::from(i) / 1000.0).sin_cos();
        for (a, b) in [(-1.0, 0.5), (-1.0, 3.0), (2.0, 0.5), (2.0, 3.0)] {
            let x: f64 = a * c + b * s;
            assert!(range.low <= x && x <= range.high);
            hull = Interval::new(hull.low.min(x), hull.high.max(x));
        }
    }
    assert!(range.high - hull.high < 1e-5 && hull.low - range.low < 1e-5, "{range:?} {hull:?}");
}
