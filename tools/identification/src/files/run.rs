//! The fit of a recording, its comparison with held-out ticks, and the physical set.

use std::path::Path;

use crate::{Comparison, Gears, IdentificationError, OfJoint, Parameter, TickRecording};
use dynamics_core::effects::smooth_sign;
use dynamics_core::model::BodyInertia;
use dynamics_core::spatial::SpatialInertia;

use crate::fit::lagged;
use crate::physical::STEPS;

use super::attempt::{Attempt, Estimate, Task, UNEXPLAINED, bell, own, possible};
pub use super::attempt::{JointEffect, Options};
use super::error::{Error, Result};
use super::kinds;
use super::look;
use super::mistakes::{self, Mistake};
use super::recorded::Recorded;
use super::report::{
    BodyFound, Findings, Gear, JointFound, Numbers, ParameterFound, RecordingPart, Trace,
};
use super::robot::Robot;

/// The most points of a trace.
const POINTS: usize = 800;
/// Residuals that are correlated by more than this share at one of these distances, rows, are no
/// noise.
const LAGS: [usize; 8] = [3, 4, 5, 6, 7, 8, 9, 10];
const CORRELATED: f64 = 0.2;

/// The parameters of a robot by a recording; the other recording is of another path.
///
/// # Errors
/// [`Error`] names the file, and the joint where one is concerned.
pub fn identify(
    robot: &Robot,
    recording: (&Path, &Recorded),
    other: Option<(&Path, &Recorded)>,
    options: &Options,
) -> Result<Findings> {
    let names = robot.joints();
    if [JointEffect::Load, JointEffect::Preslide].iter().all(|one| options.effects.contains(one)) {
        let reason = "gears have one kind of friction: --effects with load or with preslide";
        return Err(Error::Unsuitable { path: robot.path.clone(), reason: reason.to_owned() });
    }
    let joints = [Some(recording), other].map(|all| all.map_or(names.len(), |(_, all)| all.joints));
    if let Some(joints) = joints.into_iter().find(|joints| *joints != names.len()) {
        let reason = format!("{joints} joints were recorded, but it has {}", names.join(", "));
        return Err(Error::Unsuitable { path: robot.path.clone(), reason });
    }
    if let Some((path, recorded)) = other {
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
    #[cfg(feature = "files")]
    return sized!(1 2 3 4 5 6 7 8 9 10 11 12);
    #[cfg(not(feature = "files"))]
    sized!(1 2 3 4 5 6 7 8)
}

fn of_size<const V: usize>(
    robot: &Robot,
    (path, recorded): (&Path, &Recorded),
    other: Option<(&Path, &Recorded)>,
    options: &Options,
) -> Result<Findings> {
    let (recorded, look) = look::at(robot, path, recorded)?;
    let other = match other {
        Some((path, other)) => Some((path, look::at(robot, path, other)?.0)),
        None => None,
    };
    let delay = if recorded.held { 0.5 * recorded.tick } else { 0.0 };
    let task = Task { robot, gravity: robot.gravity, path, options, steps: STEPS, delay };
    let whole: TickRecording<V> = recorded.ticks(path)?;
    let (fitted_part, held) = match &other {
        Some((path, other)) => (whole.clone(), other.ticks(path)?),
        None => whole.split(1.0 - options.hold_out),
    };
    let attempt = task.attempt(task.best_base(&whole, &fitted_part)?, &fitted_part, None)?;
    let names = robot.joints();
    let mistake = mistakes::explains(task, [&whole, &fitted_part], &attempt, &names);
    let Attempt { estimate, set, .. } = &attempt;
    let Estimate { arm, joints, nominal, known, fit, found, .. } = estimate;
    let pasted = set.joints;
    let after = arm.of_all(&set.bodies, &pasted);
    let gears = possible(found);
    let smooth = arm.of_all(&set.bodies, &pasted.map(|[_, _, a, o, ..]| [0.0, 0.0, a, o]));
    let models = [(&nominal[..], None), (&after[..], gears), (&smooth[..], gears)];
    let compare = |part: &TickRecording<V>| fit.compare(arm, part, &models);
    let own_part = compare(&fitted_part).map_err(|source| task.failed(source))?;
    let validated = match compare(&held) {
        // A part of the recording itself too short for the filter is no error.
        Err(IdentificationError::TooShort { .. }) if other.is_none() => None,
        validated => Some(validated.map_err(|source| task.failed(source))?),
    };
    let mistake = mistake.or_else(|| {
        let parts = [Some(&own_part), validated.as_ref()].into_iter().flatten();
        let shares = parts
            .flat_map(|of| (0..V).map(|j| (j, part(of, j).residuals[1].rms / attempt.largest[j])));
        let worst =
            shares.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, share)| *share > UNEXPLAINED);
        worst.map(|(j, share)| Mistake::NotExplained { joint: names[j].clone(), share })
    });
    let kinds = match (&mistake, &validated) {
        (None, Some(held)) => kinds::carried(options, [&own_part, held], &names),
        _ => Vec::new(),
    };
    let own_of = |j: usize, of: OfJoint| {
        let at = own(arm, j, of)?;
        Some(found.deviations[at]).filter(|_| !known[at])
    };
    let of_joint = |j: usize| JointFound {
        name: names[j].clone(),
        before: joints[j],
        after: pasted[j],
        deviations: OfJoint::ALL.map(|of| own_of(j, of)),
        gear: found.gears.zip(gears).map(|([_, deviations], used)| {
            let [used, own] = [&used, &deviations].map(|of| of.joint(j));
            let deflection = used.get(2).zip(own.get(2)).map(|(h, deviation)| [*h, *deviation]);
            Gear { friction: [used[0], used[1]], deviations: [own[0], own[1]], deflection }
        }),
        fitted: part(&own_part, j),
        held_out: validated.as_ref().map(|held| part(held, j)),
        is_noise: is_noise(&own_part, j),
    };
    let of_body = |i: usize| {
        let body = &robot.imported.tree.bodies[i];
        let before = Numbers::of(&body.inertia);
        let about = |phi| BodyInertia::about_com(&SpatialInertia::from_parameters(phi));
        let after = match body.inertia.mass > 0.0 {
            true => Numbers::rounded(&about(set.bodies[i])),
            false => before,
        };
        let is_determined = std::array::from_fn(|place| {
            // A column stands for itself if no other is a part of its base parameter.
            let alone =
                |base: &usize| arm.terms(*base)[..] == [(1.0, Parameter::Body { body: i, place })];
            (0..arm.len()).find(alone).is_some_and(|base| found.is_determined(base))
        });
        BodyFound { name: body.name.clone(), before, after, is_determined }
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
    let curve = |j: usize, qd: f64| {
        let [viscous, coulomb, _, _, excess, asymmetry] = pasted[j];
        let s = smooth_sign(qd / options.width);
        let excess = excess * arm.friction.stribeck.map_or(0.0, |speed| bell(s, qd, speed));
        viscous * qd + s * (coulomb + asymmetry * s) + excess
    };
    Ok(Findings {
        robot: robot.imported.name.clone(),
        ticks: whole.ticks(),
        tick,
        sampling: recorded.sampling,
        look,
        held: recorded.held,
        cutoff: fit.cutoff,
        fitted_seconds: tick * fitted_part.ticks() as f64,
        held_out_seconds: tick * held.ticks() as f64,
        other_path: other.is_some(),
        width: options.width,
        stribeck_speed: arm.friction.stribeck,
        condition: found.condition,
        misfit: set.misfit,
        delay: fit.delay,
        delay_end: estimate.delay_end,
        mistake,
        kinds,
        parameters: (0..arm.len()).map(of_parameter).chain(numbers).collect(),
        joints: (0..V).map(of_joint).collect(),
        bodies: (0..V).map(of_body).collect(),
        traces: traces(&names, validated.as_ref().unwrap_or(&own_part), curve),
    })
}

/// The residuals of a joint.
fn part<const V: usize>(compared: &Comparison<V>, joint: usize) -> RecordingPart {
    let mut part = RecordingPart::default();
    let count = compared.measured.len() as f64;
    for (k, measured) in compared.measured.iter().enumerate() {
        let measured = measured[joint];
        part.largest_torque = part.largest_torque.max(measured.abs());
        for (model, residuals) in compared.modelled[..2].iter().zip(&mut part.residuals) {
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

/// Whether the residuals of a joint are noise: through the filter, noise is correlated over two
/// rows, and not beyond.
fn is_noise<const V: usize>(compared: &Comparison<V>, joint: usize) -> bool {
    let pairs = compared.measured.iter().zip(&compared.modelled[1]);
    let residuals: Vec<f64> = pairs.map(|(a, b)| a[joint] - b[joint]).collect();
    let product = |lag| lagged(&residuals, lag);
    let (all, count) = (product(0).max(1e-300), residuals.len() as f64);
    LAGS.map(product).iter().all(|own| own.abs() < all * CORRELATED.max(4.0 / count.sqrt()))
}

fn traces<const V: usize>(
    names: &[String],
    compared: &Comparison<V>,
    curve: impl Fn(usize, f64) -> f64,
) -> Vec<Trace> {
    let step = compared.times.len().div_ceil(POINTS).max(1);
    let line = |of: &dyn Fn(usize) -> (f64, f64)| -> Vec<(f64, f64)> {
        (0..compared.times.len()).step_by(step).map(of).collect()
    };
    let modelled = |model: usize, k: usize, j: usize| compared.modelled[model][k][j];
    let trace = |(j, name): (usize, &String)| {
        let by_time = |of: &dyn Fn(usize) -> f64| line(&|k| (compared.times[k], of(k)));
        let friction =
            line(&|k| (compared.speeds[k][j], compared.measured[k][j] - modelled(2, k, j)));
        let fastest = friction.iter().fold(0.0, |most: f64, (qd, _)| most.max(qd.abs()));
        let speed = |k: i32| fastest * f64::from(k) / 100.0;
        Trace {
            joint: name.clone(),
            measured: by_time(&|k| compared.measured[k][j]),
            before: by_time(&|k| modelled(0, k, j)),
            after: by_time(&|k| modelled(1, k, j)),
            curve: (-100..=100).map(|k| (speed(k), curve(j, speed(k)))).collect(),
            friction,
        }
    };
    names.iter().enumerate().map(trace).collect()
}
