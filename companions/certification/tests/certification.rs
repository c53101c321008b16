//! The checks of certificates, each with what it refuses.

#[path = "certification/configurations.rs"]
mod configurations;
#[path = "certification/floor.rs"]
mod floor;
#[path = "certification/forward.rs"]
mod forward;
#[path = "certification/grid.rs"]
mod grid;
#[path = "certification/loops.rs"]
mod loops;
#[path = "certification/recorded.rs"]
mod recorded;
#[path = "certification/slides.rs"]
mod slides;
#[path = "certification/target.rs"]
mod target;

use std::cmp::Ordering;

use certification::bound::{Bounder, Enclosure};
use certification::branch::prove;
use certification::certificate::Function;
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
use dynamics_core::model::Robot as _;
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use recorded::{BASE, GRAVITY, LITTLE, RNEA, SINES, bytes, graph, robot};

/// Assembled by hand: `good` at 0, `loop` at 0x30, `convert` at 0x44, `spoil` at 0x4e.
const CODE: &str = "80b591ed010ad1ed020a92ed011a60ee011a20ee812a71eee01af6ee082a22ee622ac0ed001a32ee212a80ed012a80bd032391ed010a30ee000a013b\
fbd180ed000a704791ed010ab8eec00a704791ed010a82ed000a7047";
fn function(at: u32) -> Result<Graph, Error> {
    walk(&Image::of(BASE, &bytes(CODE)), BASE + at, [None; 4]).map(|walked| walked.graph)
}

fn bounder(graph: &Graph, output: usize, robot: &Robot) -> Bounder {
    Bounder::new(graph, output, robot, SINES, Enclosure::WrittenOut)
        .expect("its inputs are the robot's")
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
}

#[test]
fn a_byte_stored_into_an_input_or_the_program_is_declined() {
    // strb r0, [r1, #4], or at sp - 4; vldr s0, [r1, #4]; vstr s0, [r0]; bx lr
    for (store, inputs, is_declined) in
        [("0871", None, true), ("0871", Some(BASE), true), ("0df8040c", None, false)]
    {
        let code = bytes(&format!("{store}91ed010a80ed000a7047"));
        let said = walk(&Image::of(BASE, &code), BASE, [None, inputs, None, None]);
        let at_the_store =
            |said| matches!(said, Error::Declined { address, .. } if address == BASE);
        assert_eq!(said.err().is_some_and(at_the_store), is_declined, "{store}");
    }
}

/// Bits of a cosine: less the least of a positive number there is no carry; less one there may be.
/// Then bytes and a table of bytes.
#[test]
fn bits_of_a_positive_number_are_followed_as_a_range() {
    let code = "91ed020a10ee103ab3f5000328bfb1ee400a80ed000a704700bf\
91ed020a10ee103ab3f17e5f28bfb1ee400a80ed000a7047\
91ed010a02230df8033c1df8032c022adfe802f00f0f030f00de80ed000a7047";
    let of = |at: u32| {
        let mut code = bytes(code);
        let end = BASE + code.len() as u32;
        code.extend([12_u32, 4, 8, 0].into_iter().flat_map(u32::to_le_bytes));
        let image = Image::of(BASE, &code).with_function("CERTIFIED_TRIG", end, 16);
        walk(&image, BASE + at, [None; 4])
    };
    let walked = of(0).expect("it is the same of all of them");
    let last = *walked.graph.nodes.last().expect("a result");
    assert_eq!(last, Node::Neg(0));
    let [one] = walked.comparisons[..] else {
        panic!("one comparison: {:?}", walked.comparisons);
    };
    let least = walked.graph.nodes[one.nodes[1]];
    assert_eq!((one.nodes[0], least), (0, Node::Literal(f32::MIN_POSITIVE)));
    assert_eq!(one.ordering, Ordering::Greater);
    let declined = of(26).expect_err("it depends on the cosine");
    assert!(matches!(declined, Error::Declined { .. }), "{declined}");
    // Without the place of cosines all inputs are zero.
    let declined = walk(&Image::of(BASE, &bytes(code)), BASE, [None; 4]);
    assert!(declined.is_err());
    let walked = of(50).expect("the byte is 2, and so is the table's");
    assert_eq!(walked.graph.outputs, [(0, 0)]);
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
    let exact = Exact::of(Function::Gravity, || Ok(floor::bodies(&Ur5e::MODEL))).expect("bodies");
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
