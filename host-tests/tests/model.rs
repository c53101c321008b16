//! Errors of a robot's description name the body.

use dynamics_core::model::{
    ArmModel, BASE, Body, Joint, JointLimits, Model, ModelError, Problem, Robot,
};
use dynamics_core::robots::{A1, Iiwa14, Panda, Ur5e};

const Y: [f64; 3] = [0.0, 1.0, 0.0];

/// A body that has nothing wrong with it.
fn tip() -> Body {
    Body::new("tip", 0, Joint::revolute(Y))
        .xyz([0.3, 0.0, 0.1])
        .rpy([0.1, 0.2, 0.3])
        .mass(1.0)
        .com([0.1, 0.0, 0.0])
        .inertia([0.1, 0.0, 0.0, 0.1, 0.0, 0.1])
        .limits(LIMITS)
}

const LIMITS: JointLimits<f64> =
    JointLimits { lower: -1.0, upper: 1.0, velocity: 3.0, torque: 100.0 };

fn root() -> Body {
    Body::new("root", BASE, Joint::prismatic(Y)).mass(1.0)
}

fn arm(tip: Body) -> ArmModel<f64, 2> {
    Model::new("arm", [root(), tip])
}

fn problem(tip: Body) -> Option<Problem> {
    match Model::<f64, 2, 2, 2>::try_new("arm", [root(), tip]) {
        Ok(_) => None,
        Err(ModelError { body, problem, .. }) => {
            assert_eq!(body, "tip");
            Some(problem)
        }
    }
}

#[test]
fn a_sound_description_is_accepted() {
    assert_eq!(arm(tip()).links[1].name, "tip");
    assert_eq!(problem(tip().limits(JointLimits::NONE)), None);
    // A weld has no axis, a massless body is one that only carries others.
    let weld = Body::new("tip", 0, Joint::fixed());
    assert!(Model::<f64, 2, 1, 1>::try_new("arm", [root(), weld]).is_ok());
}

#[test]
#[should_panic(expected = "body `tip`: its parent is not listed before it")]
fn a_parent_listed_after_its_child_is_named() {
    arm(Body::new("tip", 1, Joint::revolute(Y)));
}

#[test]
#[should_panic(expected = "body `tip`: its joint axis is zero or not finite")]
fn a_zero_axis_is_named() {
    arm(Body::new("tip", 0, Joint::revolute([0.0; 3])));
}

#[test]
#[should_panic(expected = "body `tip`: its mass is negative or not finite")]
fn a_negative_mass_is_named() {
    arm(tip().mass(-1.0));
}

#[test]
#[should_panic(expected = "body `tip`: a length, an angle or an inertia is not finite")]
fn a_length_that_is_not_finite_is_named() {
    arm(tip().xyz([0.0, f64::NAN, 0.0]));
}

#[test]
#[should_panic(expected = "body `tip`: a limit is not a number, lower exceeds upper, or a speed \
                           or torque limit is negative")]
fn limits_that_exclude_each_other_are_named() {
    arm(tip().limits(JointLimits { lower: 1.0, upper: -1.0, ..LIMITS }));
}

#[test]
#[should_panic(expected = "robot `arm`: its joints make Q = 1 and V = 1, not Q = 2 and V = 2")]
fn wrong_coordinate_counts_name_the_robot() {
    arm(Body::new("tip", 0, Joint::fixed()));
}

#[test]
fn numbers_that_are_not_finite_are_refused_wherever_they_stand() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for i in 0..3 {
            let at = |i: usize| {
                let mut v = [0.1, 0.2, 0.3];
                v[i] = bad;
                v
            };
            let not_finite = Some(Problem::NotFinite);
            assert_eq!(problem(tip().xyz(at(i))), not_finite, "xyz[{i}] = {bad}");
            assert_eq!(problem(tip().rpy(at(i))), not_finite, "rpy[{i}] = {bad}");
            assert_eq!(problem(tip().com(at(i))), not_finite, "com[{i}] = {bad}");
            for joint in [Joint::revolute(at(i)), Joint::prismatic(at(i))] {
                let tip = Body::new("tip", 0, joint);
                assert_eq!(problem(tip), Some(Problem::Axis), "axis[{i}] = {bad}");
            }
            for k in [i, i + 3] {
                let mut inertia = [0.1, 0.0, 0.0, 0.1, 0.0, 0.1];
                inertia[k] = bad;
                let tip = tip().inertia(inertia);
                assert_eq!(problem(tip), not_finite, "inertia[{k}] = {bad}");
            }
        }
        let found = problem(tip().mass(bad));
        assert!(
            matches!(found, Some(Problem::Mass(mass)) if mass.to_bits() == bad.to_bits()),
            "mass {bad}"
        );
    }
}

#[test]
fn angles_too_large_to_be_an_attitude_are_refused() {
    for i in 0..3 {
        for huge in [1e20, -1e100, 1e300] {
            let mut rpy = [0.1; 3];
            rpy[i] = huge;
            assert_eq!(problem(tip().rpy(rpy)), Some(Problem::Angle), "{rpy:?}");
        }
    }
}

#[test]
fn a_moment_of_inertia_that_overflows_is_refused() {
    let far = tip().mass(1e10).com([1e155, 0.0, 0.0]);
    assert_eq!(problem(far), Some(Problem::NotFinite));
}

#[test]
fn limits_that_are_not_numbers_or_negative_are_refused() {
    let nan = f64::NAN;
    for limits in [
        JointLimits { lower: nan, ..LIMITS },
        JointLimits { upper: nan, ..LIMITS },
        JointLimits { velocity: nan, ..LIMITS },
        JointLimits { torque: nan, ..LIMITS },
        JointLimits { velocity: -3.0, ..LIMITS },
        JointLimits { torque: -100.0, ..LIMITS },
        JointLimits { lower: 1.0, upper: -1.0, ..LIMITS },
    ] {
        assert_eq!(problem(tip().limits(limits)), Some(Problem::Limits), "{limits:?}");
    }
}

#[test]
fn const_messages_are_error_messages_but_for_masses() {
    let free = Body::new("tip", 0, Joint::free());
    let negative = |moment| tip().inertia([0.3, 0.0, 0.0, 0.2, 0.0, moment]);
    for (bodies, amount) in [
        ([root(), negative(-0.12345)], ""),
        ([root(), negative(-99.999)], ""),
        ([root(), negative(-9.99e-4)], ""),
        ([root(), negative(-1234.5)], ""),
        ([root(), tip().inertia([0.3, 0.2, 0.2, 0.0, 0.0, 0.0])], ""),
        ([root(), tip().mass(-1.0)], ": -1 kg"),
        ([root(), free], ""),
    ] {
        let error = Model::<f64, 2, 2, 2>::try_new("arm", bodies).unwrap_err();
        let panic =
            std::panic::catch_unwind(|| Model::<f64, 2, 2, 2>::new("arm", bodies)).unwrap_err();
        let said = panic.downcast_ref::<String>().expect("a formatted message");
        assert_eq!(format!("{}{amount}", said.trim_end()), error.to_string());
    }
}

#[test]
fn an_impossible_inertia_is_named_with_its_amount() {
    // Moments 1, 1 and 4: the largest exceeds the sum of the others by 2, half of itself.
    let model = arm(tip().inertia([1.0, 0.0, 0.0, 4.0, 0.0, 1.0]));
    let error = model.check(1e-6).unwrap_err();
    assert_eq!(error.body, "tip");
    let Problem::Triangle(excess) = error.problem else {
        panic!("{error}");
    };
    assert!((excess - 0.5).abs() < 1e-12, "{excess}");
    assert_eq!(
        error.to_string(),
        "body `tip`: its moments of inertia break the triangle inequality by 5.00e-1 of the largest"
    );
    assert!(model.check(0.51).is_ok(), "the tolerance is the caller's");
    let negative = arm(tip().inertia_as_published([-0.1, 0.0, 0.0, 0.1, 0.0, 0.1]));
    let error = negative.check(1e-6).unwrap_err();
    assert_eq!(error.body, "tip");
    let Problem::NegativeMoment(moment) = error.problem else {
        panic!("{error}");
    };
    assert!((moment + 0.1).abs() < 1e-12, "{moment}");
    // The same moments about other axes: they are principal ones that count, not the diagonal.
    let turned = arm(tip().inertia([2.5, 1.5, 0.0, 2.5, 0.0, 1.0]));
    assert_eq!(turned.check(1e-6).unwrap_err().body, "tip");
}

#[test]
fn a_negative_moment_is_refused_with_its_amount() {
    let said = |inertia| {
        let bodies = [root(), tip().inertia(inertia)];
        let error = Model::<f64, 2, 2, 2>::try_new("arm", bodies).err()?;
        assert_eq!(error.body, "tip");
        Some(error.to_string())
    };
    let negative = "body `tip`: a principal moment of its inertia is negative: -2.60e-2 kg·m²";
    assert_eq!(said([0.03, 0.0, 0.0, -0.026, 0.0, 0.03]).as_deref(), Some(negative));
    // A negative moment with a diagonal that is positive: 0.02 ± 0.046.
    assert_eq!(said([0.02, 0.046, 0.0, 0.02, 0.0, 0.03]).as_deref(), Some(negative));
    // Six right numbers in the order of other descriptions; the moment is the root of a cubic.
    for [xx, xy, xz, yy, yz, zz] in [
        [0.03, 0.001, -0.002, 0.04, 0.003, 0.05],
        [0.04, 0.0, 0.0, 0.04, 0.0, 0.001],
        [0.001, 0.0, 0.0, 0.04, 0.0, 0.04],
        [0.01, 0.0, 0.0, 0.01, 0.0, 0.01],
    ] {
        assert_eq!(said([xx, xy, xz, yy, yz, zz]), None);
        let text = said([xx, yy, zz, xy, xz, yz]).expect("a negative moment");
        assert!(text.contains("in the order xx, yy, zz, xy, xz, yz it has none: -"), "{text}");
    }
    // Rounded digits, and what breaks the triangle inequality alone, as published robots do.
    assert_eq!(said([0.03, 0.0, 0.0, 0.03, 0.0, -2e-5]), None);
    assert_eq!(said([0.0, 0.0, 0.0, 0.0, 0.0, 2.0]), None);
}

#[test]
fn the_robots_of_the_library_have_possible_inertias() {
    Ur5e::MODEL.check(1e-9).unwrap();
    Panda::MODEL.check(1e-9).unwrap();
    Iiwa14::MODEL.check(1e-9).unwrap();
    A1::MODEL.check(1e-9).unwrap();
}

#[test]
fn wrong_axes_and_pitches_have_messages_of_their_own() {
    let said = |joint| {
        let bodies = [Body::new("tip", BASE, joint)];
        let error = Model::<f64, 1, 2, 2>::try_new("arm", bodies).unwrap_err();
        error.to_string()
    };
    assert_eq!(
        said(Joint::universal(Y, [0.0, 1e-8, 1.0])),
        "body `tip`: the two axes of its joint are not at right angles"
    );
    assert_eq!(
        said(Joint::helical(Y, f64::INFINITY)),
        "body `tip`: the pitch of its joint is not finite"
    );
    assert_eq!(
        said(Joint::universal(Y, [0.0; 3])),
        "body `tip`: its joint axis is zero or not finite"
    );
}

#[test]
fn degrees_are_refused_and_a_whole_turn_is_not() {
    use std::f64::consts::TAU;
    assert_eq!(problem(tip().rpy([0.0, -90.0, 0.0])), Some(Problem::Angle));
    assert_eq!(problem(tip().rpy([-TAU, TAU, TAU + 1.4e-5])), None);
    // The last attitude named is the one that counts.
    assert_eq!(problem(tip().rpy([90.0; 3]).quarter_turns([1, 0, 0])), None);
}

#[test]
fn a_check_finds_massless_inertias_and_duplicate_names() {
    let ghost = arm(tip().mass(0.0)).check(1e-6).unwrap_err();
    assert_eq!((ghost.body, ghost.problem), ("tip", Problem::Massless));
    let twin = Body::new("root", 0, Joint::revolute(Y)).mass(1.0);
    let twins = arm(twin).check(1e-6).unwrap_err();
    assert_eq!((twins.body, twins.problem), ("root", Problem::Name));
}

#[test]
fn a_checks_tolerance_is_the_amount_of_violation() {
    // Moments 1, 1 and 2.25: the largest exceeds the sum of the others by a ninth of itself.
    let broken = arm(tip().inertia([1.0, 0.0, 0.0, 1.0, 0.0, 2.25]).com([0.0; 3]));
    assert!(broken.check(1.001 / 9.0).is_ok());
    let error = broken.check(0.999 / 9.0).unwrap_err();
    assert!(matches!(error.problem, Problem::Triangle(_)), "{error}");
    // xy and yx differ by 0.1 of the largest entry, 2.
    let mut skewed = arm(tip().inertia([2.0, 0.3, 0.0, 2.0, 0.0, 2.0]).com([0.0; 3]));
    let inertia = &mut skewed.links[1].inertia.rotational;
    let size = inertia.to_cols_array().iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    inertia.x_axis.y += 0.1 * size;
    let skew = (inertia.x_axis.y - inertia.y_axis.x).abs()
        / inertia.to_cols_array().iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    assert!(skew > 0.09);
    assert!(skewed.check(1.001 * skew).is_ok());
    let error = skewed.check(0.999 * skew).unwrap_err();
    assert!(matches!(error.problem, Problem::Asymmetric(_)), "{error}");
}
