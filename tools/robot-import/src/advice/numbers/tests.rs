use dynamics_core::effects::{
    Armature, AsymmetricCoulomb, Coulomb, Gravity, LoadFriction, Payload, RIGID_BODY, Spring,
    Stribeck, Viscous, Width,
};
use dynamics_core::glam::{DMat3, DVec3};
use dynamics_core::model::{
    ArmModel, BASE, Body, BodyInertia, Joint, JointLimits, Link, Model, Robot,
};
use dynamics_core::robots::*;
use dynamics_core::scalar::Real;

use super::{Advise, NumberAdvice};

/// The robots whose inertias about the joints can be told from those about the centres of mass.
const ABOUT_JOINTS: [&str; 8] =
    ["g1", "g1_free", "gen3", "iiwa14", "openarm", "so101", "xarm7", "yam"];
const DEGREES: f64 = 180.0 / core::f64::consts::PI;

/// The questions to a robot of the library.
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
    ask.ask(&OpenArm::MODEL);
    ask.ask(&Panda::MODEL);
    ask.ask(&So101::MODEL);
    ask.ask(&Ur5e::MODEL);
    ask.ask(&XArm7::MODEL);
    ask.ask(&Yam::MODEL);
    ask.ask(&Z1::MODEL);
}

/// The kinds of advice on units.
fn units<R: Real, const B: usize, const Q: usize, const V: usize>(
    model: &Model<R, B, Q, V>,
) -> Vec<String> {
    let about_units = model.advice().filter(NumberAdvice::is_about_units);
    about_units.map(|advice| kind(&advice)).collect()
}

fn kind(advice: &NumberAdvice) -> String {
    let text = format!("{advice:?}").replace("Limit(", "");
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
    // It has no limits, so that the mistakes below cannot be made in it.
    Right.ask(&Puma560::MODEL);
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
        // Lengths in m, as a table of a drawing program has them.
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
            let single = |kind: &String| kind == "InertiaAboutJoint";
            assert!(about.iter().all(single), "{name}: {about:?}");
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
    let limits =
        |bends: f64, torque| JointLimits { lower: -bends, upper: bends, velocity: 3.0, torque };
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
    let advice: Vec<NumberAdvice> = two_rods(2.0, [19.0, 9.0]).advice().collect();
    let [NumberAdvice::GravityBeyondTorque { joint, needed, limit }] = advice[..] else {
        panic!("{advice:?}");
    };
    assert_eq!((joint.number, joint.body, limit), (0, Some("upper"), 19.0));
    assert!((needed - whole).abs() < 1e-9, "{needed} {whole}");
    assert_eq!(two_rods(2.0, [19.7, 9.0]).advice().next(), None);

    // Bent by at most 0.3 rad each from hanging down: 2 g (0.25 sin a + 0.5 sin a + 0.25 sin 2a).
    let bent = 9.81 * 2.0 * (0.75 * f64::sin(0.3) + 0.25 * f64::sin(0.6));
    let found = |torque: f64| two_rods(0.3, [torque, 9.0]).advice().next();
    assert_eq!(found(bent * 1.001), None);
    let Some(NumberAdvice::GravityBeyondTorque { needed, .. }) = found(bent * 0.999) else {
        panic!("{:?}", found(bent * 0.999));
    };
    assert!((needed - bent).abs() < 1e-9, "{needed} {bent}");
    let text = two_rods(2.0, [19.0, 9.0]).advice().next().map(|advice| advice.to_string());
    assert_eq!(
        text.as_deref(),
        Some(
            "joint 0 (`upper`): gravity needs 19.6 N·m or N at a configuration within the limits, \
             its torque limit is 19: the motor does not hold the robot there; check masses and the \
             limit, or narrow the limits of position"
        )
    );
}

#[test]
fn advice_names_the_least_excessive_torque_limit() {
    let weight = 9.81 * 2.0 * 0.25;
    let far = two_rods(2.0, [65.0 * 4.0 * weight, 70.0 * weight]);
    let advice: Vec<NumberAdvice> = far.advice().collect();
    let [NumberAdvice::TorqueLimitsFarAbove { joint, limit, needed }] = advice[..] else {
        panic!("{advice:?}");
    };
    assert_eq!(joint.number, 0);
    assert!((limit / needed - 65.0).abs() < 1e-9);
    assert!(advice[0].to_string().contains("is 65 times the 19.6"), "{}", advice[0]);
    // One joint whose limit is near its need shows that the limits mean something.
    assert_eq!(two_rods(2.0, [65.0 * 4.0 * weight, 5.0 * weight]).advice().next(), None);
}

/// The robot with one body changed, if that has mass, for each body.
fn one_body<const B: usize, const Q: usize, const V: usize>(
    model: &Model<f64, B, Q, V>,
    change: impl Fn(&mut Link<f64>),
) -> impl Iterator<Item = (&'static str, Model<f64, B, Q, V>)> {
    (0..B).filter_map(move |i| {
        let mut changed = *model;
        let link = &mut changed.links[i];
        let size = link.inertia.rotational - shift(link);
        let has_inertia = link.inertia.mass > 0.0 && size.x_axis.x + size.y_axis.y > 0.0;
        change(link);
        has_inertia.then_some((model.links[i].name, changed))
    })
}

/// The advice on one body, in words.
fn about<const B: usize, const Q: usize, const V: usize>(
    model: &Model<f64, B, Q, V>,
    body: &str,
) -> String {
    let named = format!("body `{body}`: ");
    let mut found = model.advice().map(|advice| advice.to_string());
    found.find(|text| text.starts_with(&named)).unwrap_or_default()
}

struct OneWrong {
    about_joint: usize,
    of: usize,
}
impl Ask for OneWrong {
    fn ask<const B: usize, const Q: usize, const V: usize>(&mut self, model: &Model<f64, B, Q, V>) {
        let turned = |link: &mut Link<f64>, about_com: DMat3| {
            let about = shift(link);
            link.inertia.rotational = about_com + about;
        };
        // kg·mm², g·cm² and g·mm².
        for unit in [1e6, 1e7, 1e9] {
            for (name, changed) in one_body(model, |link| {
                let about_com = link.inertia.rotational - shift(link);
                turned(link, about_com * unit);
            }) {
                let words = about(&changed, name);
                assert!(words.contains("looks like kg·mm² or g·mm²"), "{name}: {words}");
            }
        }
        // A moment that exceeds the sum of the others by a bit, and one that is negative.
        for (name, changed) in one_body(model, |link| {
            let about_com = link.inertia.rotational - shift(link);
            let sum = 0.5 * (about_com.x_axis.x + about_com.y_axis.y + about_com.z_axis.z);
            let z = 2.02 * sum;
            turned(link, DMat3::from_diagonal(DVec3::new(sum, sum, z)));
        }) {
            let words = about(&changed, name);
            assert!(
                words.contains("exceeds the sum of the two others by 1.0 %"),
                "{name}: {words}"
            );
        }
        for (name, changed) in one_body(model, |link| {
            let about_com = link.inertia.rotational - shift(link);
            turned(link, about_com * -1.0);
        }) {
            let words = about(&changed, name);
            assert!(words.contains("none is negative: no body has it"), "{name}: {words}");
        }
        let own = |link: &mut Link<f64>| link.inertia.rotational += shift(link);
        for (name, changed) in one_body(model, own) {
            self.of += 1;
            self.about_joint += usize::from(about(&changed, name).contains("about the joint"));
        }
    }
}

#[test]
fn one_wrong_body_is_named_with_its_number() {
    let mut ask = OneWrong { about_joint: 0, of: 0 };
    each_robot(&mut ask);
    // The others' inertias about their joints are such as bodies of their length may have.
    assert_eq!((ask.about_joint, ask.of), (53, 156));
}

#[test]
fn a_uniform_rod_about_its_end_is_named() {
    // m l²/3 in place of m l²/12; the others are right.
    let rod = |name, parent, about: f64| {
        let inertia = [about, 0.0, 0.0, about, 0.0, 2e-4];
        let body = Body::new(name, parent, Joint::revolute(Y)).mass(2.0);
        let at = if parent == BASE { 0.0 } else { -0.5 };
        body.com([0.0, 0.0, -0.25]).inertia(inertia).xyz([0.0, 0.0, at])
    };
    let [right, wrong] = [2.0 * 0.25 / 12.0, 2.0 * 0.25 / 3.0];
    let of = |all: [f64; 3]| {
        let arm: ArmModel<f64, 3> =
            Model::new("rods", [rod("a", BASE, all[0]), rod("b", 0, all[1]), rod("c", 1, all[2])]);
        arm.advice().map(|advice| advice.to_string()).collect::<Vec<_>>()
    };
    assert_eq!(of([right; 3]), Vec::<String>::new());
    for i in 0..3 {
        let mut all = [right; 3];
        all[i] = wrong;
        let words = of(all);
        let body = ["a", "b", "c"][i];
        assert_eq!(words.len(), 1, "{words:?}");
        assert!(
            words[0].starts_with(&format!("body `{body}`: its inertia of 0.17 kg·m²")),
            "{words:?}"
        );
    }
}

struct OneJoint;
impl Ask for OneJoint {
    fn ask<const B: usize, const Q: usize, const V: usize>(&mut self, model: &Model<f64, B, Q, V>) {
        // The advice on torques, which takes its time, comes after that on units.
        let first = |model: &Model<f64, B, Q, V>| {
            let found = model.advice().find(NumberAdvice::is_about_units);
            found.map(|advice| (kind(&advice), advice.joint().and_then(|joint| joint.body)))
        };
        for i in 0..B {
            let Link { name, limits, .. } = model.links[i];
            if model.links[i].joint.kind != dynamics_core::model::JointKind::Revolute {
                continue;
            }
            let mut changed = *model;
            changed.links[i].limits = JointLimits { lower: -170.0, upper: 170.0, ..limits };
            let single = ("PositionInDegrees".to_string(), Some(name));
            assert_eq!(first(&changed), Some(single), "{name}");
            let mut changed = *model;
            // Not quite a degree, of which 100 a second stand for no limit; that of a slow joint is
            // one of a fast one.
            changed.links[i].limits.velocity *= 57.0;
            let single = ("SpeedInDegrees".to_string(), Some(name));
            let others = model.links.iter().filter(|other| other.name != name);
            let fastest = others.map(|other| other.limits.velocity).fold(3.0, f64::max);
            if changed.links[i].limits.velocity > 20.0 * fastest {
                assert_eq!(first(&changed), Some(single), "{name}");
            }
        }
    }
}

#[test]
fn one_joint_in_degrees_is_named_among_others() {
    each_robot(&mut OneJoint);
}

#[test]
fn a_wheel_about_its_centre_gets_no_advice() {
    // It has no reach: its centre is 1 mm beside the axis.
    let turntable: ArmModel<f64, 1> = Model::new(
        "turntable",
        [Body::new("table", BASE, Joint::continuous([0.0, 0.0, 1.0]))
            .mass(5.0)
            .com([1e-3, 0.0, 0.0])
            .inertia([0.3, 0.0, 0.0, 0.3, 0.0, 0.6])],
    );
    assert_eq!(turntable.advice().next(), None);
}

/// The kinds of advice on a scene of the UR5e.
fn on<E: dynamics_core::effects::Effect<f64, 6, 6>>(scene: &E) -> Vec<String> {
    Ur5e::MODEL.advice_on(scene).map(|advice| kind(&advice)).collect()
}

#[test]
fn impossible_values_of_a_scene_are_named() {
    let w = Width::new(0.02);
    let at_2 =
        |value: f64, other: f64| core::array::from_fn(|i| if i == 2 { value } else { other });
    let none: [&str; 0] = [];
    let dry = |torque| Coulomb { torque, width: w };
    let peak = |excess| Stribeck { excess, stribeck_speed: Width::new(0.1), width: w };
    let one_way = |forward, backward| AsymmetricCoulomb { forward, backward, width: w };
    let gears = |driving, backdriving| LoadFriction { driving, backdriving, width: w };
    let spring = Spring { stiffness: [500.0; 6], rest: [0.7; 6] };
    let right = (
        RIGID_BODY,
        Viscous([0.3; 6]),
        dry([2.0; 6]),
        peak([1.0; 6]),
        one_way([1.0; 6], [2.0; 6]),
        gears([0.3; 6], [0.2; 6]),
        Armature([0.5; 6]),
        spring,
    );
    assert_eq!(on(&right), none);
    assert_eq!(on(&()), none);
    assert_eq!(on(&Viscous(at_2(-1.0, 0.5))), ["DrivingFriction"]);
    assert_eq!(on(&Viscous([-1.0; 6])), ["DrivingFriction"; 6]);
    assert_eq!(on(&dry(at_2(-1.0, 0.5))), ["DrivingFriction"]);
    assert_eq!(on(&peak(at_2(-1.0, 0.5))), ["DrivingFriction"]);
    assert_eq!(on(&(dry([2.0; 6]), peak(at_2(-1.0, 0.5)))), none);
    assert_eq!(on(&one_way(at_2(-1.0, 0.5), [1.0; 6])), ["DrivingFriction"]);
    assert_eq!(on(&one_way([1.0; 6], at_2(-1.0, 0.5))), ["DrivingFriction"]);
    let rotors = Armature([0.5; 6]);
    for wrong in [gears(at_2(-0.1, 0.3), [0.2; 6]), gears([0.3; 6], at_2(-0.1, 0.2))] {
        assert_eq!(on(&(wrong, rotors)), ["DrivingFriction"]);
    }
    assert_eq!(on(&Armature(at_2(-0.1, 0.5))), ["NegativeArmature"]);
    assert_eq!(on(&gears([0.3; 6], [0.2; 6])), ["NoRotorInertia"; 6]);
    let load = BodyInertia { mass: -1.0, ..BodyInertia::default() };
    let words: Vec<String> = Ur5e::MODEL
        .advice_on(&(Gravity::EARTH, Payload::<f64, 5>::from_inertia(load)))
        .map(|advice| advice.to_string())
        .collect();
    assert_eq!(words, ["body `wrist_3`: its payload has a mass of -1 kg, and none is negative"]);
}
