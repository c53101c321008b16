//! Forward dynamics: of an A1's leg as it was compiled one day, against the core in f64.

use std::cmp::Ordering;

use certification::bodies::{Body, Position, inertia_matrix};
use certification::certificate::{Function, Spent, Subject, expression};
use certification::error::Error;
use certification::exact::Exact;
use certification::factors::{Factored, Noise, Order};
use certification::forward::{Forward, Worst, inverse};
use certification::graph::{Graph, Node, operands};
use certification::image::Image;
use certification::page::RecordedForward;
use certification::search::Evaluation;
use certification::state_box::Robot;
use dynamics_core::Core;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::Robot as _;
use dynamics_core::robots::A1Leg;
use dynamics_core::state::State;

use super::floor;
use super::recorded::{BASE, LITTLE, SINES, bytes, forward_program, robot};

/// The machine code of `Engine::<A1Leg>::forward_dynamics` and `crba`.
const FORWARD: &str = include_str!("a1_forward.hex");
const CRBA: &str = include_str!("a1_crba.hex");
/// `Core::<A1Leg>::forward_dynamics`, `crba` and what they read, each line from its address on; and
/// where they begin.
const CORE: &str = include_str!("a1_core.hex");
const CORE_FUNCTIONS: [u32; 2] = [0x0800_0ed1, 0x0800_27d5];
/// The states of the greatest errors, and the page that they are from.
const WORST: &str = include_str!("../../forward.json");
const PAGE: &str = include_str!("../../certificates.md");
const BOTH: [Function; 2] = [Function::ForwardDynamics, Function::CoreForwardDynamics];

fn image(function: Function) -> Image {
    let mut code = bytes(FORWARD);
    if function == Function::CoreForwardDynamics {
        code.clear();
        for (at, line) in CORE.lines().filter_map(|line| line.split_once(' ')) {
            let at = u32::from_str_radix(at, 16).expect("an address") - BASE;
            code.resize(at as usize, 0);
            code.extend(bytes(line));
        }
        return forward_program(code, CORE_FUNCTIONS, "CORE_");
    }
    let functions = [BASE | 1, (BASE | 1) + code.len() as u32];
    code.extend(bytes(CRBA));
    forward_program(code, functions, "")
}

fn subject(function: Function) -> Subject {
    Subject::of(&image(function), function).expect("it is the recursion")
}

fn bodies() -> Vec<Body> {
    floor::bodies(&A1Leg::MODEL)
}

fn proven(subject: &Subject, robot: &Robot) -> Forward {
    let exact = Exact::of(Function::ForwardDynamics, || Ok(bodies())).expect("bodies");
    let spent = Spent { parts: 100, points: 3000, search: LITTLE };
    let outputs = subject.outputs(robot, &exact, SINES, spent).expect("bounds");
    let factored = subject.factored.as_ref().expect("it is forward dynamics");
    Forward::prove(factored, &outputs, &bodies(), robot, SINES, 2000).expect("bounds")
}

fn search(forward: &Forward, code: &Graph, robot: &Robot) -> Result<(), Error> {
    forward.clone().search(code, &bodies(), robot, LITTLE)
}

#[test]
fn the_machine_code_solves_with_the_factors_and_its_roundings_are_counted() {
    let [engine, core] = BOTH.map(|function| subject(function).factored);
    let factored = engine.expect("it is forward dynamics");
    // The roundings of entry 1, 1 by the second joint are those of l, its product with the row, and
    // the difference of the third joint's share before; the product with y and such a difference;
    // D⁻¹ y; the product with q̈; τ − b.
    assert_eq!(factored.roundings, [[8, 7, 6], [6, 7, 6], [4, 5, 5]]);
    let [first, second, third] = factored.noise[..] else {
        panic!("three joints");
    };
    assert!(first.is_some_and(|noise| noise.least > 0.0 && noise.least < 1e-5));
    assert_eq!((second, third), (None, None));
    let factored = core.expect("it is forward dynamics");
    // The acceleration of the parent's joint is subtracted first.
    assert_eq!(factored.roundings, [[8, 7, 6], [7, 6, 6], [5, 4, 5]]);
    let share = f64::from(32.0 * f32::EPSILON);
    let of_m = |noise: &Option<Noise>| noise.is_some_and(|noise| noise.share == share);
    assert!(factored.noise[..2].iter().all(of_m));
}

/// The recursion of the core or of the engine on M and torques less biases, each operation of which
/// is off by a share of its own, and Σ_k d_k |l_ki l_kj| of its factors.
fn solved(
    m: &[[f64; 3]; 3],
    rest: [f64; 3],
    shares: &[f64],
    of_core: bool,
) -> ([f64; 3], [[f64; 3]; 3]) {
    let mut shares = shares.iter();
    let mut off = |x: f64| x * (1.0 + shares.next().expect("a share for each operation"));
    let (mut l, mut inverse, mut x) = (*m, [0.0; 3], rest.map(&mut off));
    for k in (0..3).rev() {
        inverse[k] = off(1.0 / l[k][k]);
        for i in (0..k).rev() {
            let factor = off(l[k][i] * inverse[k]);
            let of_k = l[k];
            for (entry, other) in l[i].iter_mut().zip(of_k).take(i + 1) {
                let share = off(factor * other);
                *entry = off(*entry - share);
            }
            l[k][i] = factor;
        }
        l[k][k] = 1.0;
    }
    for (k, i) in [(2, 0), (2, 1), (1, 0)] {
        let share = off(l[k][i] * x[k]);
        x[i] = off(x[i] - share);
    }
    for k in 0..3 {
        x[k] = off(x[k] * inverse[k]);
        for place in 0..k {
            let i = if of_core { k - 1 - place } else { place };
            let share = off(l[k][i] * x[i]);
            x[k] = off(x[k] - share);
        }
    }
    let entry = |i: usize, j: usize| {
        let all = (i.max(j)..3).map(|k| (l[k][i] * l[k][j]).abs() / inverse[k]);
        all.sum::<f64>()
    };
    let sizes = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
    (x, sizes)
}

/// Shares of ± u are chosen by climbing: what remains of the torques is within the count.
#[test]
fn the_counted_roundings_are_enough_and_one_less_is_not() {
    for function in BOTH {
        let most = most_of_the_count(function);
        // The count is at most eight, so that a count less by one would be contradicted.
        assert!(most <= 1.0 + 1e-5 && most > 0.95, "{function:?}: {most}");
    }
}

/// The torques that remain, as a share of what the count allows.
fn most_of_the_count(function: Function) -> f64 {
    let factored = subject(function).factored;
    let counts = factored.expect("it is forward dynamics").roundings;
    let of_core = function == Function::CoreForwardDynamics;
    let (mut rng, unit) = (fastrand::Rng::with_seed(5), 2.0_f64.powi(-24));
    let mut most = 0.0_f64;
    for trial in 0..60 {
        // L of entries of any size, D of any sizes.
        let mut number = |low: f64| low + (1.0 - low) * rng.f64();
        let l: [[f64; 3]; 3] = std::array::from_fn(|_| std::array::from_fn(|_| 3.0 * number(-1.0)));
        let d: [f64; 3] = std::array::from_fn(|_| 100.0_f64.powf(number(-1.0)));
        let at = |k: usize, i: usize| if k == i { 1.0 } else { l[k][i] };
        let entry = |i: usize, j: usize| (i.max(j)..3).map(|k| d[k] * at(k, i) * at(k, j)).sum();
        let m: [[f64; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
        let rest: [f64; 3] = std::array::from_fn(|_| number(-1.0));
        let ratio = |shares: &[f64], row: usize| {
            let (x, sizes) = solved(&m, rest, shares, of_core);
            let product: f64 = (0..3).map(|j| m[row][j] * x[j]).sum();
            let allowed = (0..3).map(|j| f64::from(counts[row][j]) * sizes[row][j] * x[j].abs());
            (rest[row] - product).abs() / (allowed.sum::<f64>() * unit)
        };
        let row = trial % 3;
        let mut shares: Vec<f64> = (0..60).map(|_| if rng.bool() { unit } else { -unit }).collect();
        for _ in 0..600 {
            let before = ratio(&shares, row);
            let k = rng.usize(..shares.len());
            shares[k] = -shares[k];
            if ratio(&shares, row) < before {
                shares[k] = -shares[k];
            }
        }
        most = most.max(ratio(&shares, row));
    }
    most
}

/// The nodes that some others depend on.
fn below(graph: &Graph, of: impl Iterator<Item = usize>) -> Vec<bool> {
    let mut used = vec![false; graph.nodes.len()];
    of.for_each(|node| used[node] = true);
    for at in (0..graph.nodes.len()).rev().filter(|at| used[*at]).collect::<Vec<_>>() {
        let mut open = vec![at];
        while let Some(node) = open.pop() {
            for a in operands(graph.nodes[node])
                .into_iter()
                .flatten()
                .filter(|a| !used[*a])
                .collect::<Vec<_>>()
            {
                used[a] = true;
                open.push(a);
            }
        }
    }
    used
}

#[test]
fn every_other_operation_in_factors_and_solution_is_refused() {
    BOTH.into_iter().for_each(others_are_refused);
}

fn others_are_refused(function: Function) {
    let subject = subject(function);
    let (crba, order) = function.matrix().expect("it is forward dynamics");
    let factored = subject.factored.as_ref().expect("it is forward dynamics");
    let matrix = expression(&image(function), crba).expect("it is followed").graph;
    let code = &subject.walked.graph;
    let used = below(code, code.outputs.iter().map(|output| output.1));
    let biases = factored.graph.outputs[..3].iter().map(|output| output.1);
    let in_bias = below(&factored.graph, biases);
    // Torques plus something are torques less another bias: the search contradicts that.
    let is_torque = |a: usize| matches!(code.nodes[a], Node::Input(input) if input.argument == 3);
    let others = |node: Node| match node {
        Node::Sub(a, b) if is_torque(a) => vec![Node::Sub(b, a), Node::Neg(b)],
        Node::Add(a, b) => vec![Node::Sub(a, b), Node::Mul(a, b)],
        Node::Sub(a, b) => vec![Node::Add(a, b), Node::Sub(b, a), Node::Neg(b)],
        // A product that was lost, or of which one factor was.
        Node::Mul(a, b) => vec![Node::Literal(0.0), Node::Neg(a), Node::Mul(b, b)],
        Node::Div(a, b) => vec![Node::Mul(a, b), Node::Div(b, a)],
        Node::Literal(x) => vec![Node::Literal(1.5 * x + 1.0)],
        _ => Vec::new(),
    };
    // The core's matrix is complete before the first pivot; products with zero are part of it.
    let first = code.nodes.iter().position(|node| matches!(node, Node::Div(..)));
    let first = first.filter(|_| order == Order::Inward).unwrap_or(0);
    let is_rest = |node: Node| matches!(node, Node::Sub(a, _) | Node::Add(a, _) if is_torque(a));
    let tried = (0..code.nodes.len()).filter(|k| used[*k] && !in_bias[*k]);
    let mut refused = 0;
    for k in tried.filter(|k| *k >= first || is_rest(code.nodes[*k])) {
        for other in others(code.nodes[k]) {
            let mut wrong = subject.walked.clone();
            wrong.graph.nodes[k] = other;
            let said = Factored::of(&wrong, &matrix, order).err();
            assert!(matches!(said, Some(Error::Factors { .. })), "{k}: {:?}", code.nodes[k]);
            refused += 1;
        }
    }
    assert!(refused > 80, "{refused}");
    // Another order, another matrix, another comparison.
    let otherwise = match order {
        Order::Outward => Order::Inward,
        Order::Inward => Order::Outward,
    };
    assert!(Factored::of(&subject.walked, &matrix, otherwise).is_err());
    let mut other = matrix.clone();
    other.outputs.swap(0, 4);
    [other.outputs[0].0, other.outputs[4].0] = [0, 16];
    assert!(Factored::of(&subject.walked, &other, order).is_err());
    let wrong_comparison = |change: fn(&mut certification::walk::Comparison)| {
        let mut wrong = subject.walked.clone();
        change(&mut wrong.comparisons[0]);
        Factored::of(&wrong, &matrix, order).is_err()
    };
    assert!(wrong_comparison(|one| one.ordering = Ordering::Equal));
    assert!(wrong_comparison(|one| one.ordering = Ordering::Less));
    assert!(wrong_comparison(|one| one.nodes[0] -= 1));
}

/// The oracle is the core's ABA in f64, which shares no code with the proof or with the search.
#[test]
fn no_acceleration_is_further_from_the_cores_than_its_bound() {
    BOTH.into_iter().for_each(stays_below_the_bound);
}

fn stays_below_the_bound(function: Function) {
    let (subject, robot, bodies) = (subject(function), robot(3), bodies());
    let forward = proven(&subject, &robot);
    assert!(forward.is_total && forward.epsilon < 0.01 * forward.floor.floor, "{forward:?}");
    let mut evaluation = Evaluation::new(&subject.walked.graph, &robot);
    let mut rng = fastrand::Rng::with_seed(3);
    let mut greatest = [0.0_f64; 3];
    for _ in 0..2000 {
        let drawn = robot.whole();
        let drawn = drawn.iter().map(|x| f64::from((x.low + rng.f64() * (x.high - x.low)) as f32));
        let state: Vec<f64> = drawn.collect();
        let [q, qd, tau]: [[f64; 3]; 3] =
            std::array::from_fn(|i| std::array::from_fn(|j| state[3 * i + j]));
        let at = State { q, qd, qdd: [0.0; 3] };
        let exact = Core::<A1Leg>::aba(&at, &tau, &RIGID_BODY).expect("it has inertia");
        let computed: Vec<f64> = evaluation.at(&state).map(|pair| pair.0.into()).collect();
        let matrix = inertia_matrix(&bodies, 3, &q.map(Position::at));
        for joint in 0..3 {
            assert!(matrix[joint][joint] <= forward.scales[joint]);
            greatest[joint] = matrix[joint][joint].max(greatest[joint]);
        }
        let bounds = forward.bound(&matrix, &inverse(&matrix).expect("it is positive"), &computed);
        for joint in 0..3 {
            let error = (computed[joint] - exact[joint]).abs();
            assert!(error <= bounds[joint], "joint {joint}: {error:e} > {:e}", bounds[joint]);
        }
    }
    // The grid knows the greatest entries of M; intervals alone have them up to twice as large.
    for (scale, greatest) in forward.scales.iter().zip(greatest) {
        assert!(*scale < 1.1 * greatest, "{scale} {greatest}");
    }
}

/// The difference between an error by `forward.py` and the same by f64, as a share of the greatest
/// error of the state.
fn difference(of: &Worst, exact: &[f64]) -> f64 {
    let greatest = of.errors.iter().fold(0.0, |most, error| error.abs().max(most));
    let computed = of.computed.iter().zip(exact).map(|(computed, exact)| computed - exact);
    let apart = computed.zip(&of.errors).map(|(precise, error)| (precise - error).abs());
    apart.fold(0.0, f64::max) / greatest
}

#[test]
fn the_worst_errors_of_the_page_are_those_of_fifty_digits() {
    let recorded: Vec<RecordedForward> = serde_json::from_str(WORST).expect("as certify writes it");
    // Both of four arms, and the engine of the leg.
    assert_eq!(recorded.len(), 9);
    for one in &recorded {
        let title = format!("### {}: {}\n", one.robot, one.function.name());
        let section = PAGE.split_once(&title).expect("it is on the page").1;
        let rows = section.lines().filter(|line| line.starts_with("| ") && line.ends_with(" |"));
        assert_eq!(one.exact.len(), one.worst.len(), "run forward.py");
        // The last is of the norm, which stands in a sentence.
        let joints = one.worst.len() - 1;
        for (of, row) in one.worst[..joints].iter().zip(rows.skip(1)) {
            let ratio = format!("| {:.1} |", 1.0 / of.share);
            assert!(row.ends_with(&ratio), "{title}{row}: {ratio}");
        }
        for (of, exact) in one.worst.iter().zip(&one.exact) {
            let apart = difference(of, exact);
            assert!(apart < 2e-8, "{title}{apart:e}");
            // A millionth of the greatest error is found.
            let (mut wrong, errors) = (exact.clone(), &of.errors);
            let greatest =
                (0..errors.len()).max_by(|a, b| errors[*a].abs().total_cmp(&errors[*b].abs()));
            let greatest = greatest.expect("a joint");
            wrong[greatest] += 1e-6 * errors[greatest];
            assert!(difference(of, &wrong) > 2e-8);
        }
    }
}

#[test]
fn pivots_that_must_exceed_more_of_m_may_be_refused() {
    let (mut subject, robot) = (subject(Function::ForwardDynamics), robot(3));
    for (share, is_total) in [(1e-3, true), (1.0, false)] {
        let factored = subject.factored.as_mut().expect("it is forward dynamics");
        factored.noise[2] = Some(Noise { least: 0.0, share });
        assert_eq!(proven(&subject, &robot).is_total, is_total, "{share}");
    }
}

#[test]
fn a_bound_without_one_of_its_parts_is_contradicted() {
    BOTH.into_iter().for_each(parts_are_needed);
}

fn parts_are_needed(function: Function) {
    let subject = subject(function);
    let (code, moving) = (subject.walked.graph.clone(), robot(3));
    let contradicted = |forward: &Forward, code: &Graph, robot: &Robot| {
        let said = search(forward, code, robot).expect_err("an error is above its bound");
        assert!(matches!(said, Error::Contradicted { .. }), "{said}");
    };
    let forward = proven(&subject, &moving);
    assert!(search(&forward, &code, &moving).is_ok());
    let without_bias = Forward { bias: vec![0.0; 3], beta: 0.0, ..forward.clone() };
    contradicted(&without_bias, &code, &moving);
    // A bias of the other sign has the same structure.
    let mut wrong = code.clone();
    let is_torque = |a: usize| matches!(code.nodes[a], Node::Input(input) if input.argument == 3);
    for node in &mut wrong.nodes {
        match *node {
            Node::Sub(a, b) if is_torque(a) => *node = Node::Add(a, b),
            _ => {}
        }
    }
    contradicted(&forward, &wrong, &moving);
    // The box in which accelerations alone make the torques.
    let mut still = robot(3);
    for joint in &mut still.joints {
        (joint.speed, joint.acceleration) = (0.0, 1e5);
    }
    let forward = proven(&subject, &still);
    assert!(search(&forward, &code, &still).is_ok());
    let without_matrix = Forward {
        matrix: vec![vec![0.0; 3]; 3],
        roundings: vec![vec![0; 3]; 3],
        ..forward.clone()
    };
    contradicted(&without_matrix, &code, &still);
    let without_norm = Forward { epsilon: 0.02 * forward.epsilon, ..forward };
    contradicted(&without_norm, &code, &still);
}
