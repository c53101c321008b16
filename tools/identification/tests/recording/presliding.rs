//! Friction of gears that grows with the load and holds at rest.

use std::path::Path;

use dynamics_core::algorithms::rnea;
use dynamics_core::effects::{
    Coriolis, Effect, Gravity, Inertia, JointState, LoadFriction, PreslidingLoadFriction,
    RIGID_BODY, Viscous, Width,
};
use dynamics_core::state::State;
use identification::files::paste;
use identification::files::run::{self, JointEffect, Options};
use identification::{BaseModel, ExcitationLimits, Fit, Fitted, Gears};
use robot_import::model;

use crate::arm::*;

const GEARS: PreslidingLoadFriction<f64, 2> = PreslidingLoadFriction {
    magnitude: [0.2, 0.15],
    torque: [0.06, 0.05],
    deflection: [3e-3, 6e-3],
    direction: [0.0; 2],
};
const VISCOUS: Viscous<f64, 2> = Viscous([0.8, 0.3]);
const LOADED: ((Gravity, Inertia, Coriolis), Viscous<f64, 2>) = (RIGID_BODY, VISCOUS);
const NOMINAL: Gears<2> = Gears::Presliding([[0.0; 3]; 2]);

/// Slow turns back and forth under the load of gravity.
fn turns(t: f64) -> At {
    swing(t, [0.9, 1.1], [0.7, 1.1])
}

/// The same speeds, without a turn.
fn one_way(t: f64) -> At {
    let mut at = State::at([-1.2 + 0.05 * t, -1.5 + 0.06 * t]);
    for (j, rate) in [1.3, 1.9].into_iter().enumerate() {
        let ((sin, cos), size) = ((rate * t).sin_cos(), 0.02);
        at.q[j] += size * sin;
        at.qd[j] = 0.05 + 0.01 * j as f64 + size * rate * cos;
        at.qdd[j] = -size * rate * rate * sin;
    }
    at
}

/// The record of the arm with the gears, whose directions follow in twenty steps a tick.
fn presliding(
    motion: impl Fn(f64) -> At,
    ticks: u32,
    scene: impl Effect<f64, 2, 2> + Copy,
) -> String {
    let arm = model::arm::<2>(&described().imported.tree).expect("an arm");
    let (mut gears, mut last) = (GEARS, motion(0.0).q);
    record_with(motion, ticks, 0.0, |at| {
        for (j, last) in last.iter().enumerate() {
            let step = JointState::new(at.q[j], at.q[j] - last);
            (0..20).for_each(|_| Effect::<f64, 2, 2>::advance(&mut gears, j, step, 0.05));
        }
        last = at.q;
        rnea(&arm, at, &(scene, gears))
    })
}

/// The record of slow turns with another law.
fn smooth(ticks: u32) -> String {
    let arm = model::arm::<2>(&described().imported.tree).expect("an arm");
    let width = Width::new(0.02);
    let gears = LoadFriction { driving: [0.2, 0.15], backdriving: [0.14, 0.1], width };
    record_with(turns, ticks, 0.0, |at| rnea(&arm, at, &(RIGID_BODY, VISCOUS, gears)))
}

/// The fit from a description whose bodies and viscous frictions are off by 30 %. Torques up to
/// 5 Hz: the encoders' counts make accelerations, and so torques, of higher frequencies.
fn fitted(text: &str, gears: Gears<2>, scene: impl Effect<f64, 2, 2>) -> Fitted<2> {
    let recording = read(text).and_then(|all| all.ticks::<2>(Path::new("run.csv"))).expect("ticks");
    let limits = ExcitationLimits {
        lower: [-2.0; 2],
        upper: [2.0; 2],
        velocity: [1.5; 2],
        acceleration: [3.0; 2],
        torque: [10.0, 3.0],
    };
    let (model, bodies, joints) = off().model::<2>(off().gravity).expect("a model");
    let arm = BaseModel::new(model, scene, Width::new(0.02), limits);
    let nominal = arm.of_all(&bodies, &joints.map(|[viscous, ..]| [viscous, 0.0, 0.0, 0.0]));
    let is_known = |name: String| name.contains("Coulomb") || name.contains("offset");
    let known: Vec<bool> = (0..arm.len()).map(|base| is_known(arm.name(base))).collect();
    let fit = Fit { cutoff: 5.0, ..Fit::new(TICK) };
    fit.identify(&arm, &recording, &nominal, &known, Some(gears)).expect("a fit")
}

#[test]
fn slow_turns_under_load_show_all_three_numbers() {
    let found = fitted(&presliding(turns, 20_000, LOADED), NOMINAL, RIGID_BODY);
    let [own, deviations] = found.gears.expect("gears");
    for j in 0..2 {
        let truth = [GEARS.magnitude[j], GEARS.torque[j], GEARS.deflection[j]];
        for (k, (truth, within)) in truth.into_iter().zip([0.01, 0.03, 0.05]).enumerate() {
            let (error, deviation) = (own.joint(j)[k] - truth, deviations.joint(j)[k]);
            assert!(error.abs() < within * truth, "joint {j} {k}: {own:?}");
            assert!(error.abs() < 4.0 * deviation, "joint {j} {k}: {own:?} {deviations:?}");
            assert!(found.is_gear_determined(j, k), "joint {j} {k}: {deviations:?}");
        }
    }
}

/// Whether the joints' numbers are determined.
fn determined(found: &Fitted<2>) -> [[bool; 3]; 2] {
    [0, 1].map(|j| [0, 1, 2].map(|k| found.is_gear_determined(j, k)))
}

#[test]
fn without_turns_or_motion_or_load_the_numbers_are_not_determined() {
    let found = fitted(&presliding(one_way, 20_000, LOADED), NOMINAL, RIGID_BODY);
    assert_eq!(determined(&found), [[false; 3]; 2], "{:?}", found.gears);
    let rests = |t: f64| swing(t, [0.9, 0.0], [0.7, 1.1]);
    let found = fitted(&presliding(rests, 10_000, LOADED), NOMINAL, RIGID_BODY);
    assert_eq!(determined(&found), [[true; 3], [false; 3]], "{:?}", found.gears);
    let slow = |t: f64| swing(t, [0.9, 1.1], [0.1, 0.13]);
    let weightless = (Inertia, Coriolis);
    let found = fitted(&presliding(slow, 20_000, weightless), NOMINAL, weightless);
    assert_eq!(determined(&found), [[false; 3]; 2], "{:?}", found.gears);
}

#[test]
fn the_wrong_law_has_larger_residuals_and_no_distance() {
    let fits = |text: &str| {
        [NOMINAL, Gears::Load([[0.0; 2]; 2])].map(|gears| fitted(text, gears, RIGID_BODY))
    };
    // Friction that follows the velocity at once: h is at its least value.
    let [presliding_law, own] = fits(&smooth(20_000));
    for j in 0..2 {
        assert!(presliding_law.noise[j] > 1.05 * own.noise[j], "{:?}", presliding_law.noise);
        assert!(!presliding_law.is_gear_determined(j, 2), "{:?}", presliding_law.gears);
    }
    let [own, smooth_law] = fits(&presliding(turns, 20_000, LOADED));
    assert!((0..2).all(|j| smooth_law.noise[j] > 5.0 * own.noise[j]), "{:?}", smooth_law.noise);
}

#[test]
fn what_is_found_is_named_and_pasted() {
    let effects = vec![JointEffect::Viscous, JointEffect::Preslide];
    let mut options = Options { effects, cutoff: Some(5.0), ..OPTIONS() };
    let mut robot = off();
    robot.imported.tree.bodies.iter_mut().for_each(|body| body.friction = 0.0);
    let recorded = read(&presliding(turns, 5_000, LOADED)).expect("ticks");
    let identify =
        |options: &Options| run::identify(&robot, (Path::new("run.csv"), &recorded), None, options);
    let found = identify(&options).expect("parameters");
    let [first, second] = [0, 1].map(|j| found.joints[j].gear.expect("a gear"));
    let lines = paste::lines(&paste::file(&robot, &found));
    let lines = lines.split_whitespace().collect::<Vec<_>>().join(" ");
    let ([first_h, _], [second_h, _]) = first.deflection.zip(second.deflection).expect("distances");
    let [first_h, second_h] = [first_h, second_h].map(identification::files::report::rounded);
    let deflection = format!("deflection: [{first_h:?}, {second_h:?}], direction: [0.0; V]");
    for part in ["effects::PreslidingLoadFriction { magnitude: [0.", &deflection] {
        assert!(lines.contains(part), "{part}\n{lines}");
    }
    assert!(found.worst().expect("joints").1 < 0.01, "{}", found.text());
    for part in ["gear μₐ, μ_d, h", "joint 1 gear's μ_d"] {
        assert!(found.text().contains(part), "{part}\n{}", found.text());
    }
    options.effects.push(JointEffect::Load);
    assert!(identify(&options).expect_err("two kinds").to_string().contains("one kind"));
}
