//! Constant torques, late torques, and mistakes of a recording that no robot explains.

use std::path::Path;

use identification::files::mistakes::Mistake;
use identification::files::paste;
use identification::files::report::{Findings, rounded};

use crate::arm::*;

/// A record whose positions and torques are changed.
fn changed(positions: impl Fn(usize, f64) -> f64, torques: impl Fn(usize, f64) -> f64) -> String {
    let text = record(|t| swing(t, [0.9, 1.1], [1.7, 2.6]), 2_500);
    let mut lines = text.lines();
    let mut out = lines.next().expect("titles").to_owned() + "\n";
    for line in lines {
        let mut fields: Vec<String> = line.split(',').map(str::to_owned).collect();
        for joint in 0..2 {
            for (at, to) in [
                (8 + 3 * joint, &positions as &dyn Fn(usize, f64) -> f64),
                (9 + 3 * joint, &torques),
            ] {
                let number = fields[at].parse().expect("a number");
                fields[at] = to(joint, number).to_string();
            }
        }
        out += &(fields.join(",") + "\n");
    }
    out
}

fn of(joint: usize, factor: f64) -> impl Fn(usize, f64) -> f64 {
    move |j, x| if j == joint { factor * x } else { x }
}

fn same(_: usize, x: f64) -> f64 {
    x
}

fn found(text: &str) -> Findings {
    identified(text).expect("parameters")
}

#[test]
fn a_constant_torque_is_found_and_pasted_beside_the_masses() {
    let offsets = [3.0, -0.4];
    let found = found(&changed(same, |j, tau| tau + offsets[j]));
    assert_eq!(found.mistake, None);
    for (joint, offset) in found.joints.iter().zip(offsets) {
        let deviation = joint.deviations[3].expect("a parameter of its own");
        assert!((joint.after[3] - offset).abs() < 4.0 * deviation + 0.01, "{joint:?}");
        assert!((joint.after[1] - if offset > 0.0 { 0.5 } else { 0.2 }).abs() < 0.05, "{joint:?}");
    }
    let lines = paste::lines(&paste::file(&off(), &found));
    let lines: String = lines.split_whitespace().collect();
    let offset = format!("ConstantTorque([{:?},", rounded(found.joints[0].after[3]));
    assert!(lines.contains("pubconstOFFSET:") && lines.contains(&offset), "{lines}");
    assert!(paste::c(&found).contains("offset[2]"));
    // The residuals are those of what is pasted.
    assert!(found.worst().expect("joints").1 < 0.02, "{}", found.text());
}

#[test]
fn an_arm_without_a_constant_torque_gets_none() {
    let found = found(&changed(same, same));
    assert!(found.joints.iter().all(|joint| joint.after[3] == 0.0));
    assert!(!paste::file(&off(), &found).contains("OFFSET"));
    assert!((found.delay - 0.5 * found.tick).abs() < 1e-12 && found.mistake.is_none());
}

#[test]
fn one_wrong_sign_is_named_and_nothing_is_explained_by_another_robot() {
    for joint in 0..2 {
        let names = ["shoulder", "elbow"].map(str::to_owned);
        let joints = vec![names[joint].clone()];
        let torque = found(&changed(same, of(joint, -1.0)));
        assert_eq!(torque.mistake, Some(Mistake::TorqueSign { joints }), "{}", torque.text());
        assert!(torque.text().contains("wrong sign"));
    }
}

#[test]
fn torques_in_another_unit_are_named() {
    for factor in [1e3, 1.0 / 147.0] {
        match found(&changed(same, |_, tau| factor * tau)).mistake {
            Some(Mistake::Unit { factor: named }) => {
                assert!((named / factor).ln().abs() < 0.5, "{named} for {factor}");
            }
            other => panic!("{other:?} for {factor}"),
        }
    }
}

#[test]
fn a_shifted_zero_is_named() {
    let found = found(&changed(|j, q| if j == 0 { q - 0.15 } else { q }, same));
    match &found.mistake {
        Some(Mistake::Zero { shifts }) => {
            let [(joint, shift)] = &shifts[..] else { panic!("{shifts:?}") };
            assert_eq!(joint, "shoulder");
            assert!((shift - 0.15).abs() < 0.01, "{shift}");
        }
        other => panic!("{other:?}\n{}", found.text()),
    }
}

#[test]
fn a_late_torque_is_estimated_and_reported() {
    {
        let late = 0.02;
        let motion = |t: f64| swing(t, [0.9, 1.1], [1.7, 2.6]);
        let text = record_late(motion, 2_500, late);
        let recorded = read(&text).expect("ticks");
        let file = Path::new("run.csv");
        let found =
            identification::files::run::identify(&off(), (file, &recorded), None, &OPTIONS());
        let found = found.expect("parameters");
        // The torque belongs to the time before it was recorded.
        assert!((found.delay + late - 0.5 * TICK).abs() < 2e-3, "{} for {late}", found.delay);
        assert!(
            found.text().contains("the torques lag behind the positions by 2"),
            "{}",
            found.text()
        );
    }
}
