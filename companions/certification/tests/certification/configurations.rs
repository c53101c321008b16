//! The proven errors of other kernels of sines and of other models, against what is observed of
//! them.

use certification::bound::SineErrors;
use certification::certificate::{Function, expression};
use certification::check;
use certification::configurations::{self, Configurations, Spent, Whole, each};
use certification::error::Error;
use certification::graph::{Graph, Input};
use certification::search::Evaluation;
use certification::state_box::{Leaf, Robot};
use dynamics_core::trig::{Kernel as _, Table};

use certification::image::Image;
use certification::narrow::magnitude;

use super::recorded::{GRAVITY, RNEA, SINES, bytes, graph, program, robot};

const SPENT: Spent = Spent { points: 20_000, fine: 200_000, parts: 10 };

fn state(robot: &Robot, rng: &mut fastrand::Rng) -> Vec<f64> {
    let within = |x: certification::interval::Interval| x.low + rng.f64() * (x.high - x.low);
    robot.whole().into_iter().map(within).map(|x| f64::from(x as f32)).collect()
}

/// Half of the square of half of a step of the table, and its roundings.
const LINEAR: SineErrors = SineErrors { sine: 7.6e-5, cosine: 7.6e-5 };

/// The results in f32 with the sines of a linear table.
fn coarse(graph: &Graph, robot: &Robot, state: &[f64], values: &mut Vec<f32>) -> Vec<f32> {
    let input = |input: Input| match robot.leaf(input) {
        Some(Leaf::Sine(joint)) => Table::<256, 1>::sin_cos(state[joint] as f32).0,
        Some(Leaf::Cosine(joint)) => Table::<256, 1>::sin_cos(state[joint] as f32).1,
        Some(Leaf::Axis(axis)) => state[axis] as f32,
        None => f32::NAN,
    };
    graph.evaluate(input, values);
    graph.outputs.iter().map(|(_, node)| values[*node]).collect()
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
    assert!(most_fine <= fine && most_coarse <= bound, "{most_coarse:e} {bound:e}");
    assert!(most_coarse > fine && bound < 10.0 * most_coarse);
}

#[test]
fn a_model_that_leaves_terms_out_needs_its_distance() {
    let (own, whole, robot) = (graph(GRAVITY), graph(RNEA), robot(6));
    let beside = |graph| Whole::of(graph, &robot, SPENT.points).expect("angles alone");
    let of = |whole: Option<&Whole<'_>>| {
        each(&own, whole, &robot, &[SINES], SPENT).expect("angles alone")[0]
    };
    let (bound, alone) = (of(Some(&beside(&whole))), of(None));
    let mut rng = fastrand::Rng::with_seed(1);
    let (mut one, mut other) = (Evaluation::new(&own, &robot), Evaluation::new(&whole, &robot));
    let mut most = 0.0_f64;
    for _ in 0..100_000 {
        let state = state(&robot, &mut rng);
        for ((single, _), (_, exact)) in one.at(&state).zip(other.at(&state)) {
            most = most.max((f64::from(single) - exact).abs());
        }
    }
    assert!(most <= bound && alone < most && bound < 10.0 * most, "{most} {bound} {alone:e}");
    // The same model twice has no distance, and little more than its own bound.
    let twice = of(Some(&beside(&own)));
    assert!(twice < 3.0 * alone, "{twice:e} {alone:e}");
}

#[test]
fn a_changed_number_of_a_page_of_certificates_is_refused() {
    let page = include_str!("../../certificates.md");
    let said = |page: &str| check::numbers(page).err().map(|error| error.to_string());
    assert_eq!(said(page), None);
    // The first row of each table: its bound, to below what was observed, and by one digit.
    let mut rows: Vec<&str> = Vec::new();
    for (head, row) in page.lines().zip(page.lines().skip(2)) {
        if head.contains("| worst observed |") {
            rows.push(row);
        }
    }
    assert!(rows.len() > 10, "{}", rows.len());
    for row in rows {
        let digit = |figure: &str| figure.find(|c: char| c.is_ascii_digit()).expect("a digit");
        let bound = row.split('|').nth(2).expect("a bound").trim();
        let tiny = page.replacen(row, &row.replacen(bound, "1.00 · 10⁻³⁰", 1), 1);
        let observed = row.split('|').nth(3).expect("what was observed").trim();
        if ["0", "0.000"].contains(&observed) {
            assert!(said(&tiny).is_some(), "{row}");
        } else {
            assert!(said(&tiny).is_some_and(|said| said.contains("below")), "{row}");
        }
        let at = digit(bound);
        let other = if bound[at..].starts_with('9') { "8" } else { "9" };
        let larger = format!("{}{other}{}", &bound[..at], &bound[at + 1..]);
        assert!(said(&page.replacen(row, &row.replacen(bound, &larger, 1), 1)).is_some(), "{row}");
    }
    // A number of a sentence.
    assert!(said(&page.replacen("Cycles: 576", "Cycles: 575", 1)).is_some());
}

#[test]
fn a_page_of_other_machine_code_is_stale() {
    let image = program(bytes(GRAVITY), "GRAVITY");
    let walked = expression(&image, Function::Gravity).expect("it is straight-line");
    let hash = image.hash(&walked.visited);
    let stale = |image: &Image, page: &str| {
        let checked = check::hashes(image, &[Function::Gravity], "ur5e", page);
        checked.err().map(|error| error.to_string())
    };
    let page = format!(
        "### ur5e: engine `rnea`\n\n### ur5e: engine `rnea`, gravity alone\n\n68 instructions; SHA-256 of the machine code `{hash}`\n\n\
         ### panda: engine `rnea`, gravity alone\n\n"
    );
    assert_eq!(stale(&image, &page), None);
    // The hash of another robot or of another function.
    assert!(stale(&image, &page.replace("ur5e", "iiwa14")).is_some());
    let elsewhere = page.replace("### ur5e: engine `rnea`\n\n", "");
    let elsewhere =
        elsewhere.replace("### ur5e: engine `rnea`, gravity alone", "### ur5e: engine `rnea`");
    assert!(stale(&image, &elsewhere).is_some());
    // One digit of the page, and one bit of a literal behind the code.
    let digit = if hash.starts_with('0') { "1" } else { "0" };
    let said = stale(&image, &page.replace(&hash, &format!("{digit}{}", &hash[1..])));
    assert!(said.is_some_and(|said| said.contains("ur5e") && said.contains("not of today's")));
    let mut code = bytes(GRAVITY);
    *code.last_mut().expect("a literal") ^= 1;
    assert!(stale(&program(code, "GRAVITY"), &page).is_some());
}

#[test]
fn a_record_of_other_code_or_robots_is_refused() {
    let today = [("CONFIGURED_FULL", "5a"), ("inputs", "c3")];
    let today = today.map(|(what, hash)| (what.to_owned(), hash.to_owned()));
    let today = std::collections::BTreeMap::from(today);
    let record = |change: fn(&mut Configurations)| {
        let mut one = Configurations {
            robot: "ur5e".to_owned(),
            hashes: today.clone(),
            ..Configurations::default()
        };
        change(&mut one);
        configurations::check(&[one], "ur5e", &today)
    };
    assert!(record(|_| ()).is_ok());
    let other =
        record(|one| one.hashes.insert("inputs".to_owned(), "c4".to_owned()).map_or((), drop));
    assert!(matches!(other, Err(Error::Unproven { what, .. }) if what == "inputs"));
    assert!(record(|one| one.hashes.clear()).is_err());
    assert!(record(|one| one.robot = "panda".to_owned()).is_err());
    // The box is an input: another speed is another hash.
    let (one, mut other) = (robot(2), robot(2));
    assert_eq!(configurations::inputs(&one), configurations::inputs(&robot(2)));
    other.joints[1].speed += 1.0;
    assert_ne!(configurations::inputs(&one), configurations::inputs(&other));
}

#[test]
fn a_magnitude_is_finite_and_not_negative() {
    assert_eq!(magnitude("4.5"), Ok(4.5));
    assert_eq!(magnitude("0"), Ok(0.0));
    for wrong in ["-1", "nan", "inf", "fast", ""] {
        assert!(magnitude(wrong).is_err(), "{wrong}");
    }
}
