//! The fit of a recording, its comparison with held-out ticks, and the physical set.

use std::path::Path;

use crate::{Comparison, Gears, IdentificationError, OfJoint, TickRecording};
use dynamics_core::model::BodyInertia;
use dynamics_core::spatial::SpatialInertia;

use super::attempt::{Attempt, Task, own, possible};
pub use super::attempt::{JointEffect, Options};
use super::error::{Error, Result};
use super::mistakes;
use super::recorded::Recorded;
use super::report::{BodyFound, Found, Gear, JointFound, Numbers, ParameterFound, Part, Trace};
use super::robot::Robot;

/// The most points of a trace.
const POINTS: usize = 800;

/// The parameters of a robot by a recording; the other recording is of another path.
///
/// # Errors
/// [`Error`] names the file, and the joint where one is concerned.
pub fn identify(
    robot: &Robot,
    recording: (&Path, &Recorded),
    other: Option<(&Path, &Recorded)>,
    options: &Options,
) -> Result<Found> {
    let names = robot.joints();
    if [JointEffect::Load, JointEffect::Preslide].iter().all(|one| options.effects.contains(one)) {
        let reason = "gears have one kind of friction: --effects with load or with preslide";
        return Err(Error::Unsuitable { path: robot.path.clone(), reason: reason.to_owned() });
    }
    let all = [Some(recording), other];
    for (path, recorded) in all.into_iter().flatten() {
        if recorded.joints != names.len() {
            return Err(Error::Joints {
                recording: path.to_owned(),
                recorded: recorded.joints,
                robot: robot.path.clone(),
                described: names.len(),
                names: names.join(", "),
            });
        }
        let (own, other) = (recording.1.tick, recorded.tick);
        if (own - other).abs() > 1e-3 * own {
            let path = path.to_owned();
            return Err(Error::Ticks { path, own, other });
        }
    }
    macro_rules! sized {
        ($($v:literal)*) => {
            match names.len() {
                $($v => of_size::<$v>(robot, recording, other, options),)*
                _ => Err(Error::Unsuitable {
                    path: robot.path.clone(),
                    reason: format!("{} joints are not between 1 and {}", names.len(), super::MOST_JOINTS),
                }),
            }
        };
    }
    sized!(1 2 3 4 5 6 7 8 9 10 11 12)
}

fn of_size<const V: usize>(
    robot: &Robot,
    (path, recorded): (&Path, &Recorded),
    other: Option<(&Path, &Recorded)>,
    options: &Options,
) -> Result<Found> {
    let task = Task { robot, path, options };
    let whole: TickRecording<V> = recorded.ticks(path)?;
    let (fitted_part, held) = match other {
        Some((path, other)) => (whole.clone(), other.ticks(path)?),
        None => whole.split(1.0 - options.hold_out),
    };
    let attempt = task.attempt(&whole, &fitted_part, None)?;
    let names = robot.joints();
    let mistake = mistakes::explains(&task, &whole, &fitted_part, &attempt, &names);
    let Attempt { arm, joints, nominal, known, fit, found, set, .. } = &attempt;
    let pasted = set.joints;
    let after = arm.of_all(&set.bodies, &pasted);
    let gears = possible(found);
    let models = [(&nominal[..], None), (&after[..], gears)];
    let compare = |part: &TickRecording<V>| fit.compare(arm, part, &models);
    let own_part = compare(&fitted_part).map_err(|source| task.failed(source))?;
    let validated = match compare(&held) {
        // A part of the recording itself too short for the filter is no error.
        Err(IdentificationError::TooShort { .. }) if other.is_none() => None,
        validated => Some(validated.map_err(|source| task.failed(source))?),
    };
    let own_of = |j: usize, of: OfJoint| {
        let at = own(arm, j, of)?;
        Some(found.deviations[at]).filter(|_| !known[at])
    };
    let of_joint = |j: usize| JointFound {
        name: names[j].clone(),
        before: joints[j],
        after: pasted[j],
        deviations: [OfJoint::Viscous, OfJoint::Coulomb, OfJoint::Armature, OfJoint::Offset]
            .map(|of| own_of(j, of)),
        gear: found.gears.zip(gears).map(|([_, deviations], used)| {
            let [used, own] = [&used, &deviations].map(|of| of.joint(j));
            let deflection = used.get(2).zip(own.get(2)).map(|(h, deviation)| [*h, *deviation]);
            Gear { friction: [used[0], used[1]], deviations: [own[0], own[1]], deflection }
        }),
        fitted: part(&own_part, j),
        held_out: validated.as_ref().map(|held| part(held, j)),
    };
    let of_body = |i: usize| {
        let body = &robot.imported.tree.bodies[i];
        let before = Numbers::of(&body.inertia);
        let about = |phi| BodyInertia::about_com(&SpatialInertia::from_parameters(phi));
        let after = match body.inertia.mass > 0.0 {
            true => Numbers::rounded(&about(set.bodies[i])),
            false => before,
        };
        BodyFound { name: body.name.clone(), before, after }
    };
    let of_parameter = |base: usize| ParameterFound {
        name: arm.name(base),
        before: nominal[base],
        found: found.base[base],
        deviation: found.deviations[base],
        is_known: known[base],
        is_determined: found.is_determined(base),
    };
    let of_gear = |(j, k): (usize, usize)| {
        let [own, deviation] = found.gears?.map(|of| of.joint(j).get(k).copied());
        Some(ParameterFound {
            name: format!("joint {j} gear's {}", ["μₐ", "μ_d", "h"][k]),
            before: 0.0,
            found: own?,
            deviation: deviation?,
            is_known: false,
            is_determined: found.is_gear_determined(j, k),
        })
    };
    let presliding = matches!(gears, Some(Gears::Presliding(_)));
    let numbers = if presliding { 3 * V } else { 0 };
    let numbers = (0..numbers).filter_map(|at| of_gear((at / 3, at % 3)));
    let tick = whole.tick();
    Ok(Found {
        robot: robot.imported.name.clone(),
        ticks: whole.ticks(),
        tick,
        left_out: recorded.left_out,
        gaps: recorded.gaps,
        fitted_seconds: tick * fitted_part.ticks() as f64,
        held_out_seconds: tick * held.ticks() as f64,
        other_path: other.is_some(),
        width: options.width,
        condition: found.condition,
        misfit: set.misfit,
        delay: fit.delay,
        mistake,
        parameters: (0..arm.len()).map(of_parameter).chain(numbers).collect(),
        joints: (0..V).map(of_joint).collect(),
        bodies: (0..V).map(of_body).collect(),
        traces: traces(&names, validated.as_ref().unwrap_or(&own_part)),
    })
}

/// The residuals of a joint.
fn part<const V: usize>(compared: &Comparison<V>, joint: usize) -> Part {
    let mut part = Part::default();
    let count = compared.measured.len() as f64;
    for (k, measured) in compared.measured.iter().enumerate() {
        let measured = measured[joint];
        part.largest_torque = part.largest_torque.max(measured.abs());
        for (model, residuals) in compared.modelled.iter().zip(&mut part.residuals) {
            let residual = (measured - model[k][joint]).abs();
            residuals.rms += residual * residual / count;
            residuals.largest = residuals.largest.max(residual);
        }
    }
    for residuals in &mut part.residuals {
        residuals.rms = residuals.rms.sqrt();
    }
    part
}

fn traces<const V: usize>(names: &[String], compared: &Comparison<V>) -> Vec<Trace> {
    let step = compared.times.len().div_ceil(POINTS).max(1);
    let line = |of: &[[f64; V]], j: usize| -> Vec<(f64, f64)> {
        let points = compared.times.iter().zip(of).step_by(step);
        points.map(|(time, torque)| (*time, torque[j])).collect()
    };
    let trace = |(j, name): (usize, &String)| Trace {
        joint: name.clone(),
        measured: line(&compared.measured, j),
        before: line(&compared.modelled[0], j),
        after: line(&compared.modelled[1], j),
    };
    names.iter().enumerate().map(trace).collect()
}
