//! Quotients, roots and branches on data: of a leg with a four-bar as it was compiled one day, and
//! of a few instructions.

use std::cmp::Ordering;

use certification::bound::Bounder;
use certification::branch::prove;
use certification::certificate::{Function, expression};
use certification::error::Error;
use certification::graph::{Guess, Input, Node};
use certification::grid::Program;
use certification::image::Image;
use certification::interval::Interval;
use certification::paths;
use certification::roots::relative_error;
use certification::search::{Evaluation, search};
use certification::state_box::Robot;
use certification::walk::{Walked, walk};
use dynamics_core::Core;
use dynamics_core::clusters::Clustered;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::state::State;
use firmware_demo::robots::FourBarLeg;

use super::recorded::{BASE, LITTLE, SINES, bytes, robot};

/// `Clustered::<Engine<FourBarLeg>>::rnea` with its kernel of sines as a call, behind a function
/// that passes the gravity.
const FOUR_BAR: &str = include_str!("four_bar.hex");
/// The address at which the kernel was.
const KERNEL: u32 = BASE + 0xf50;
/// The guess of the library's reciprocal root.
const GUESS: Guess = Guess { magic: 0x5f37_59df, steps: 3 };

fn four_bar() -> Walked {
    let mut code = bytes(FOUR_BAR);
    let end = BASE + code.len() as u32;
    let effects = [0x51eb_851f, 0x4023_9eb8, 0x411c_f5c3, 0];
    let words = [BASE | 1, KERNEL | 1, 12, 4, 8, 0].into_iter().chain(effects);
    code.extend(words.flat_map(u32::to_le_bytes));
    let image = Image::of(BASE, &code)
        .with_function("CERTIFIED_CLUSTERED", end, 4)
        .with_function("CERTIFIED_SINES", end + 4, 4)
        .with_function("CERTIFIED_TRIG", end + 8, 16)
        .with_function("CERTIFIED_EFFECTS", end + 24, 16);
    expression(&image, Function::Clustered).expect("it is followed")
}

/// Hip, crank and ankle, the crank within a range.
fn leg(crank: f64) -> Robot {
    let mut leg = robot(3);
    leg.joints[1].position = Interval::new(-crank, crank);
    leg
}

/// Assembled by hand: x + 3, 3 by it, the root of that, which is the result if it is above zero.
const CODE: &str = "92ed000af0ee080a30ee200a80ee801af1eec11af5ee401af1ee10fa01ddc0ed001a7047";

#[test]
fn quotients_roots_and_comparisons_are_read() {
    let image = Image::of(BASE, &bytes(CODE));
    let walked = walk(&image, BASE, [None; 4]).expect("it is followed");
    let input = Node::Input(Input { argument: 2, offset: 0 });
    let nodes = [input, Node::Literal(3.0), Node::Add(0, 1), Node::Div(1, 2), Node::Sqrt(3)];
    assert_eq!(walked.graph.nodes[..5], nodes);
    let [one] = walked.comparisons[..] else {
        panic!("{:?}", walked.comparisons);
    };
    assert_eq!((one.address, one.ordering), (BASE + 24, Ordering::Greater));
    // The least angle is -3, of which the quotient has no bound.
    let mut robot = robot(1);
    let said = paths::prove(&walked, &robot, SINES, 50).expect_err("x + 3 may be zero");
    assert!(matches!(said, Error::Branch { address, .. } if address == BASE + 24), "{said}");
    robot.joints[0].position = Interval::new(-2.0, 1.0);
    assert!(paths::prove(&walked, &robot, SINES, 50).is_ok());
    let mut bounder =
        Bounder::new(&walked.graph, 0, &robot, SINES).expect("its input is the robot's");
    for (x, root) in [(-2.0, 3.0_f64.sqrt()), (1.0, 0.75_f64.sqrt())] {
        bounder.bound(&[Interval::point(x), Interval::default(), Interval::default()]);
        let range = bounder.range();
        assert!(range.contains(Interval::point(root)) && range.high - range.low < 1e-6);
        // By the quotient the root rises by half of root over quotient, and by x + 3 it falls by
        // half of root over that.
        let adjoints = [3, 2].map(|k| bounder.adjoints[k]);
        let by_hand = [0.5 / root, -0.5 * root / (x + 3.0)];
        assert!(
            adjoints
                .iter()
                .zip(by_hand)
                .all(|(a, b)| (a.low - b).abs() < 1e-6 && (a.high - b).abs() < 1e-6)
        );
    }
}

#[test]
fn a_reciprocal_root_is_within_its_proven_error() {
    let proven = relative_error(GUESS);
    assert!(proven < 2e-7, "{proven:e}");
    let worst = |guess: Guess| {
        let mut rng = fastrand::Rng::with_seed(1);
        (0..10_000).fold(0.0_f64, |worst, _| {
            let x = (10.0_f64.powf(60.0 * rng.f64() - 30.0)) as f32;
            worst.max((f64::from(guess.inverse_root(x)) * f64::from(x).sqrt() - 1.0).abs())
        })
    };
    assert!(worst(GUESS) <= proven && proven < 2.0 * worst(GUESS));
    let one_step_less = Guess { steps: 2, ..GUESS };
    assert!(worst(one_step_less) > proven);
}

/// The core in f64 knows nothing of machine code and computes roots itself.
#[test]
fn the_four_bar_is_that_of_the_core_within_its_bound() {
    let (walked, robot) = (four_bar(), leg(0.6));
    assert!(paths::prove(&walked, &robot, SINES, 1000).is_ok());
    assert!(walked.graph.nodes.iter().any(|node| matches!(node, Node::InverseRoot(_, GUESS))));
    let observed = search(&walked.graph, &robot, LITTLE, 1);
    let bounds: Vec<f64> = (0..3)
        .map(|output| {
            let mut bounder = Bounder::new(&walked.graph, output, &robot, SINES)
                .expect("its inputs are the robot's");
            let proven = prove(&mut bounder, &robot.whole(), 500).bound.total();
            let one = walked.graph.of_output(output);
            let program = Program::new(&one, &robot).expect("speeds are not divided by");
            let grid = program.prove(&one, &robot, SINES, 50_000, &[]);
            let grid = grid.expect("it closes").total();
            let worst = &observed[output];
            assert!(
                worst.error <= grid && grid < 10.0 * worst.error && grid < 0.5 * proven,
                "{:e} {grid:e} {proven:e}",
                worst.error
            );
            // At a point nothing is lost, and a tenth of the bound is contradicted.
            let here: Vec<Interval> = worst.state.iter().map(|x| Interval::point(*x)).collect();
            let at = bounder.bound(&here).total();
            assert!(worst.error <= at && worst.error > 0.1 * at, "{:e} {at:e}", worst.error);
            grid
        })
        .collect();
    let mut evaluation = Evaluation::new(&walked.graph, &robot);
    let mut rng = fastrand::Rng::with_seed(1);
    for _ in 0..200 {
        let drawn = robot.whole();
        let drawn = drawn.iter().map(|x| f64::from((x.low + rng.f64() * (x.high - x.low)) as f32));
        let state: Vec<f64> = drawn.collect();
        let part = |i: usize| std::array::from_fn(|j| state[3 * i + j]);
        let y = State { q: part(0), qd: part(1), qdd: part(2) };
        let tau = Clustered::<Core<FourBarLeg>>::rnea(&y, &RIGID_BODY).expect("it closes");
        for (joint, (single, _)) in evaluation.at(&state).enumerate() {
            let error = (f64::from(single) - tau[joint]).abs();
            assert!(error <= bounds[joint], "{joint}: {error:e} > {:e}", bounds[joint]);
        }
    }
}

#[test]
fn a_box_with_a_singular_posture_is_declined() {
    let walked = four_bar();
    let said = paths::prove(&walked, &leg(3.0), SINES, 1000).expect_err("it does not close");
    assert!(matches!(said, Error::Branch { ordering: Ordering::Greater, .. }), "{said}");
    // The opposite of what the code has taken.
    let mut wrong = walked;
    wrong.comparisons[0].ordering = Ordering::Less;
    assert!(paths::prove(&wrong, &leg(0.6), SINES, 1000).is_err());
}
