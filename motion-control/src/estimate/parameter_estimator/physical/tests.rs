//! Which bodies are possible, and the margin.

use super::*;

/// Two bodies, one with moments that are not zero, and two parameters of joints.
const NOMINAL: [f64; 22] = [
    2.0, 0.5, -0.25, 0.125, 1.0, -0.25, 1.5, -0.125, -0.0625, 2.0, // the first
    1.0, -0.5, 0.0, 0.0, 0.5, -0.125, 1.0, 0.0, 0.0, 1.0, // the second
    0.5, 0.0, // frictions
];

type Two = PhysicalParameters<f64, 2, 22>;

fn two() -> Two {
    Two::try_new(NOMINAL).expect("possible bodies")
}

fn with(place: usize, value: f64) -> [f64; 22] {
    let mut all = NOMINAL;
    all[place] = value;
    all
}

#[test]
fn a_pseudo_inertia_has_each_moment_in_its_place() {
    let body = core::array::from_fn(|i| NOMINAL[i]);
    let expected = [
        [1.25, 0.25, 0.125, 0.5],
        [0.25, 0.75, 0.0625, -0.25],
        [0.125, 0.0625, 0.25, 0.125],
        [0.5, -0.25, 0.125, 2.0],
    ];
    assert_eq!(pseudo_inertia(&body), expected);
}

#[test]
fn the_first_impossible_body_or_parameter_is_named() {
    let refused = |place, value| Two::try_new(with(place, value)).unwrap_err();
    for (place, body) in [(0, 0), (10, 1)] {
        for value in [-1.0, 0.0, f64::NAN] {
            assert_eq!(refused(place, value), ImpossibleParameters::Body { body });
        }
    }
    for (place, parameter) in [(20, 0), (21, 1)] {
        for value in [-1e-9, f64::NAN, f64::INFINITY] {
            let joint = ImpossibleParameters::Joint { parameter };
            assert_eq!(refused(place, value), joint);
        }
    }
}

/// A body of mass 2 at a place, with principal moments about its origin.
fn is_possible(x: f64, [xx, yy, zz]: [f64; 3]) -> bool {
    let body = [2.0, x, 0.0, 0.0, xx, 0.0, yy, 0.0, 0.0, zz];
    PhysicalParameters::<f64, 1, 10>::try_new(body).is_ok()
}

#[test]
fn a_body_without_extent_in_a_direction_is_impossible() {
    // ½ tr − I of one axis: positive, zero, negative.
    for (least, possible) in [(0.25, true), (0.5, false), (0.75, false)] {
        for axis in 0..3 {
            let mut moments = [0.25; 3];
            moments[axis] = least;
            assert_eq!(is_possible(0.0, moments), possible, "{axis} {least}");
        }
    }
    // Σ of the first axis is 1, of which the mass at its centre takes h²/m.
    for (x, possible) in [(0.0, true), (1.0, true), (1.25, true), (1.5, false)] {
        assert_eq!(is_possible(x, [1.0, 1.5, 1.5]), possible, "{x}");
    }
}

#[test]
fn products_of_inertia_count_for_whether_a_body_is_possible() {
    for (product, possible) in [(0.0, true), (0.2, true), (0.3, false), (-0.3, false)] {
        for place in [5, 7, 8] {
            let mut body = [1.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.5, 0.0, 0.0, 0.5];
            body[place] = product;
            let made = PhysicalParameters::<f64, 1, 10>::try_new(body);
            assert_eq!(made.is_ok(), possible, "{place} {product}");
        }
    }
}

#[test]
fn each_body_and_joint_keeps_its_margin() {
    let two = two();
    assert!(two.is_possible(&NOMINAL));
    // A twentieth of the friction; one of zero stays at zero.
    for (friction, possible) in [(0.026, true), (0.025, true), (0.024, false), (0.0, false)] {
        assert_eq!(two.is_possible(&with(20, friction)), possible, "{friction}");
    }
    for (friction, possible) in [(0.0, true), (0.1, true), (-1e-6, false)] {
        assert_eq!(two.is_possible(&with(21, friction)), possible, "{friction}");
    }
    for place in [0, 10] {
        assert!(!two.is_possible(&with(place, 0.01)));
    }
    assert!(!two.is_possible(&with(3, f64::NAN)));
}

#[test]
fn a_body_of_nothing_stays_so() {
    let frame = PhysicalParameters::<f64, 1, 10>::try_new([0.0; 10]).expect("nothing");
    assert!(frame.is_possible(&[0.0; 10]));
    let mut heavy = [0.0; 10];
    for body in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]] {
        [heavy[0], heavy[4]] = body;
        assert_eq!(frame.is_possible(&heavy), body == [0.0; 2]);
    }
}

#[test]
fn a_set_follows_to_the_margin() {
    let mut two = two();
    assert_eq!(two.follow(&with(20, 0.25)), 1.0);
    assert_eq!(two.parameters(), &with(20, 0.25));
    // From 0.25 to a margin of 0.025 at 0.6008 of the way, of which 615/1024 are the steps of the
    // bisection.
    let share = two.follow(&with(20, 0.25 - 0.225 / 0.6008));
    assert_eq!(share, 615.0 / 1024.0);
    let stored = two.parameters()[20];
    assert!((0.025..0.0255).contains(&stored), "{stored}");
}

#[test]
fn an_estimate_changes_the_nominal_set() {
    let mut two = two();
    let mut base =
        SelectedParameters { columns: [20, 21], prior: [1.0; 2], spread: [[0.0; 2]; 22] };
    (base.spread[0], base.spread[20]) = ([0.5, 0.0], [-0.25, 1.0]);
    // The same again: it is the change of the nominal parameters, not of those that are stored.
    for _ in 0..2 {
        assert_eq!(two.update(&base, &[0.5, 0.25]), 1.0);
        let mut expected = NOMINAL;
        (expected[0], expected[20]) = (2.25, 0.625);
        assert_eq!(two.parameters(), &expected);
    }
    assert_eq!(two.update(&base, &[0.0; 2]), 1.0);
    assert_eq!(two.parameters(), &NOMINAL);
}
