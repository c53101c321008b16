use std::string::{String, ToString};
use std::vec::Vec;

use super::*;
use crate::glam::{DMat3, DVec3};
use crate::model::{ArmModel, BASE, Body, Joint, JointLimits, Link, Model, Robot};
use crate::robots::*;
use crate::scalar::Real;

/// The robots whose inertias about the joints can be told from those about the centres of mass.
const ABOUT_JOINTS: [&str; 6] = ["g1", "g1_free", "gen3", "iiwa14", "so101", "xarm7"];
const DEGREES: f64 = 180.0 / core::f64::consts::PI;

/// What a robot of the library is asked.
trait Ask {
    fn ask<const B: usize, const Q: usize, const V: usize>(&mut self, model: &Model<f64, B, Q, V>);
}

fn each_robot(ask: &mut impl Ask) {
    ask.ask(&A1::MODEL);
    ask.ask(&A1Free::MODEL);
    ask.ask(&A1Leg::MODEL);
    ask.ask(&G1::MODEL);
    ask.ask(&G1Free::MODEL);
    ask.ask(&Gen3::MODEL);
    ask.ask(&Iiwa14::MODEL);
    ask.ask(&Panda::MODEL);
    ask.ask(&So101::MODEL);
    ask.ask(&Ur5e::MODEL);
    ask.ask(&XArm7::MODEL);
    ask.ask(&Z1::MODEL);
}

/// The kinds of advice on units.
fn units<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
) -> Vec<String> {
    let about_units = model.advice().filter(Advice::is_about_units);
    about_units.map(|advice| kind(&advice)).collect()
}

fn kind(advice: &Advice) -> String {
    let text = std::format!("{advice:?}");
    text.split(' ').next().unwrap_or_default().to_string()
}

struct Right;
impl Ask for Right {
    fn ask<const B: usize, const Q: usize, const V: usize>(&mut self, model: &Model<f64, B, Q, V>) {
        let none: [&str; 0] = [];
        assert_eq!(units(model), none, "{}", model.name);
        assert_eq!(units(&model.to_f32()), none, "{}", model.name);
        assert_eq!(model.advice().count(), 0, "{}", model.name);
    }
}

#[test]
fn no_robot_of_the_library_gets_advice() {
    each_robot(&mut Right);
}

struct Wrong;
impl Ask for Wrong {
    fn ask<const B: usize, const Q: usize, const V: usize>(&mut self, model: &Model<f64, B, Q, V>) {
        let with = |change: fn(&mut Link<f64>)| {
            let mut changed = *model;
            changed.links.iter_mut().for_each(change);
            units(&changed)
        };
        let name = model.name;
        assert_eq!(with(grams), ["MassesInGrams"], "{name}");
        assert_eq!(with(millimetres), ["LengthsInMillimetres"], "{name}");
        let both = with(|link| {
            grams(link);
            millimetres(link);
        });
        assert_eq!(both, ["MassesInGrams", "LengthsInMillimetres"], "{name}");
        // Of lengths in m, as a table of a drawing program has them.
        for unit in [1e6, 1e9] {
            let mut changed = *model;
            for link in &mut changed.links {
                let about = shift(link);
                link.inertia.rotational = (link.inertia.rotational - about) * unit + about;
            }
            assert_eq!(units(&changed), ["InertiasInMillimetres"], "{name}");
        }
        let positions = with(|link| {
            link.limits.lower *= DEGREES;
            link.limits.upper *= DEGREES;
        });
        assert_eq!(positions, ["PositionsInDegrees"], "{name}");
        let speeds = with(|link| link.limits.velocity *= DEGREES);
        assert_eq!(speeds, ["SpeedsInDegrees"], "{name}");
        let about = with(|link| link.inertia.rotational += shift(link));
        if ABOUT_JOINTS.contains(&name) {
            assert_eq!(about, ["InertiasAboutJoints"], "{name}");
        } else {
            // Some body's inertia about its joint is what another body could have.
            let none: [&str; 0] = [];
            assert_eq!(about, none, "{name}");
        }
    }
}

fn grams(link: &mut Link<f64>) {
    link.inertia.mass *= 1e3;
    link.inertia.first_moment *= 1e3;
    link.inertia.rotational *= 1e3;
}

fn millimetres(link: &mut Link<f64>) {
    link.placement.pos *= 1e3;
    link.inertia.first_moment *= 1e3;
    link.inertia.rotational *= 1e6;
}

/// m (d² 1 − d dᵀ).
fn shift(link: &Link<f64>) -> DMat3 {
    let (m, h) = (link.inertia.mass, link.inertia.first_moment);
    if m == 0.0 {
        return DMat3::ZERO;
    }
    (DMat3::from_diagonal(DVec3::splat(h.dot(h))) - DMat3::from_cols(h * h.x, h * h.y, h * h.z))
        * (1.0 / m)
}

#[test]
fn each_wrong_unit_gets_exactly_its_advice() {
    each_robot(&mut Wrong);
}

const Y: [f64; 3] = [0.0, 1.0, 0.0];

/// Two rods whose joints bend by at most these angles, rad, with these limits of torque, N·m.
fn two_rods(bends: f64, torques: [f64; 2]) -> ArmModel<f64, 2> {
    let limits = |bends: f64, torque| JointLimits {
        lower: -bends,
        upper: bends,
        velocity: 3.0,
        torque,
    };
    let rod = |name, parent, torque, bends| {
        let body = Body::new(name, parent, Joint::revolute(Y)).mass(2.0);
        body.com([0.0, 0.0, -0.25]).limits(limits(bends, torque))
    };
    let lower = rod("lower", 0, torques[1], bends).xyz([0.0, 0.0, -0.5]);
    Model::new("rods", [rod("upper", BASE, torques[0], bends), lower])
}

#[test]
fn gravity_advice_states_the_closed_form_torque() {
    // Stretched out horizontally: 2 g · 0.25 + 2 g · 0.75.
    let whole = 9.81 * 2.0 * (0.25 + 0.75);
    let advice: Vec<Advice> = two_rods(2.0, [19.0, 9.0]).advice().collect();
    let [
        Advice::GravityBeyondTorque {
            joint,
            needed,
            limit,
        },
    ] = advice[..]
    else {
        panic!("{advice:?}");
    };
    assert_eq!((joint.number, joint.body, limit), (0, Some("upper"), 19.0));
    assert!((needed - whole).abs() < 1e-9, "{needed} {whole}");
    assert_eq!(two_rods(2.0, [19.7, 9.0]).advice().next(), None);

    // Bent by at most 0.3 rad each from hanging down: 2 g (0.25 sin a + 0.5 sin a + 0.25 sin 2a).
    let bent = 9.81 * 2.0 * (0.75 * f64::sin(0.3) + 0.25 * f64::sin(0.6));
    let found = |torque: f64| two_rods(0.3, [torque, 9.0]).advice().next();
    assert_eq!(found(bent * 1.001), None);
    let Some(Advice::GravityBeyondTorque { needed, .. }) = found(bent * 0.999) else {
        panic!("{:?}", found(bent * 0.999));
    };
    assert!((needed - bent).abs() < 1e-9, "{needed} {bent}");
    let text = two_rods(2.0, [19.0, 9.0])
        .advice()
        .next()
        .map(|advice| advice.to_string());
    assert_eq!(
        text.as_deref(),
        Some(
            "joint 0 (`upper`): gravity needs 19.6 N·m or N at a configuration within the limits, its torque limit is 19: the motor \
             does not hold the robot there; check masses and the limit, or narrow the limits of position"
        )
    );
}

#[test]
fn advice_names_the_least_excessive_torque_limit() {
    let weight = 9.81 * 2.0 * 0.25;
    let far = two_rods(2.0, [65.0 * 4.0 * weight, 70.0 * weight]);
    let advice: Vec<Advice> = far.advice().collect();
    let [
        Advice::TorqueLimitsFarAbove {
            joint,
            limit,
            needed,
        },
    ] = advice[..]
    else {
        panic!("{advice:?}");
    };
    assert_eq!(joint.number, 0);
    assert!((limit / needed - 65.0).abs() < 1e-9);
    assert!(
        advice[0].to_string().contains("is 65 times the 19.6"),
        "{}",
        advice[0]
    );
    // One joint whose limit is near its need shows that the limits mean something.
    assert_eq!(
        two_rods(2.0, [65.0 * 4.0 * weight, 5.0 * weight])
            .advice()
            .next(),
        None
    );
}
