//! The proven errors of other kernels of sines and of other models, against what is observed of them.

use certification::bound::SineErrors;
use certification::configurations::{Spent, each};
use certification::graph::{Graph, Input};
use certification::search::Evaluation;
use certification::state_box::{Leaf, Robot};
use dynamics_core::trig::{Kernel as _, Table};

use super::recorded::{GRAVITY, RNEA, SINES, graph, robot};

const SPENT: Spent = Spent {
    points: 20_000,
    parts: 10,
};

fn state(robot: &Robot, rng: &mut fastrand::Rng) -> Vec<f64> {
    let within = |x: certification::interval::Interval| x.low + rng.f64() * (x.high - x.low);
    robot
        .whole()
        .into_iter()
        .map(within)
        .map(|x| f64::from(x as f32))
        .collect()
}

/// Half of the square of half of a step of the table, and its roundings.
const LINEAR: SineErrors = SineErrors {
    sine: 7.6e-5,
    cosine: 7.6e-5,
};

/// The results in f32 with the sines of a linear table.
fn coarse(graph: &Graph, robot: &Robot, state: &[f64], values: &mut Vec<f32>) -> Vec<f32> {
    let input = |input: Input| match robot.leaf(input) {
        Some(Leaf::Sine(joint)) => Table::<256, 1>::sin_cos(state[joint] as f32).0,
        Some(Leaf::Cosine(joint)) => Table::<256, 1>::sin_cos(state[joint] as f32).1,
        Some(Leaf::Axis(axis)) => state[axis] as f32,
        None => f32::NAN,
    };
    graph.evaluate(input, values);
    graph
        .outputs
        .iter()
        .map(|(_, node)| values[*node])
        .collect()
}

#[test]
fn a_coarse_kernel_keeps_its_bound_and_breaks_the_fine_one() {
    let (graph, robot) = (graph(GRAVITY), robot(6));
    let [fine, bound] =
        each(&graph, None, &robot, &[SINES, LINEAR], SPENT).expect("angles alone")[..]
    else {
        panic!("a bound for each kernel");
    };
    let (mut rng, mut values) = (fastrand::Rng::with_seed(1), Vec::new());
    let mut evaluation = Evaluation::new(&graph, &robot);
    let (mut most_fine, mut most_coarse) = (0.0_f64, 0.0_f64);
    for _ in 0..100_000 {
        let state = state(&robot, &mut rng);
        let results = coarse(&graph, &robot, &state, &mut values);
        for ((single, double), coarse) in evaluation.at(&state).zip(results) {
            most_fine = most_fine.max((f64::from(single) - double).abs());
            most_coarse = most_coarse.max((f64::from(coarse) - double).abs());
        }
    }
    assert!(
        most_fine <= fine && most_coarse <= bound,
        "{most_coarse:e} {bound:e}"
    );
    assert!(most_coarse > fine && bound < 10.0 * most_coarse);
}

#[test]
fn a_model_that_leaves_terms_out_needs_its_distance() {
    let (own, whole, robot) = (graph(GRAVITY), graph(RNEA), robot(6));
    let of = |whole| each(&own, whole, &robot, &[SINES], SPENT).expect("angles alone")[0];
    let (bound, alone) = (of(Some(&whole)), of(None));
    let mut rng = fastrand::Rng::with_seed(1);
    let (mut one, mut other) = (
        Evaluation::new(&own, &robot),
        Evaluation::new(&whole, &robot),
    );
    let mut most = 0.0_f64;
    for _ in 0..100_000 {
        let state = state(&robot, &mut rng);
        for ((single, _), (_, exact)) in one.at(&state).zip(other.at(&state)) {
            most = most.max((f64::from(single) - exact).abs());
        }
    }
    assert!(most <= bound && alone < most, "{most} {bound} {alone:e}");
    // The same model twice has no distance, and little more than its own bound.
    let twice = of(Some(&own));
    assert!(twice < 3.0 * alone, "{twice:e} {alone:e}");
}
