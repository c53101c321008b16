//! The report, as text and as JSON.

use std::fmt::Write as _;

use dynamics_core::model::BodyInertia;
use robot_import::inertia::MassProperties;
use serde::Serialize;

use crate::OF_JOINT;

use super::attempt::{JointEffect, OfOneJoint};
use super::kinds::FrictionKind;
use super::mistakes::{IMPOSSIBLE, Mistake};
use super::percent;
use super::resample::Sampling;

/// The digits of numbers to paste.
const DIGITS: usize = 6;

/// The findings about a robot from a recording; its fields are those of the JSON.
#[derive(Clone, Debug, Serialize)]
pub struct Findings {
    pub robot: String,
    /// Ticks in which the controller made the torque.
    pub ticks: usize,
    /// The length of a tick, s.
    pub tick: f64,
    pub sampling: Sampling,
    /// What was found and changed in the samples before the fit.
    pub look: Vec<String>,
    /// Whether a torque is held until the next tick.
    pub held: bool,
    /// The frequency up to which torques were compared, Hz.
    pub cutoff: f64,
    pub fitted_seconds: f64,
    pub held_out_seconds: f64,
    /// Whether what was held out is another recording.
    pub other_path: bool,
    /// The width of the smooth sign of Coulomb friction, rad/s or m/s.
    pub width: f64,
    /// The speed of Stribeck's effect, rad/s or m/s, if it was identified.
    pub stribeck_speed: Option<f64>,
    pub condition: f64,
    /// The misfit of the physical set to the estimate, in standard deviations.
    pub misfit: f64,
    /// The time to which a torque belongs, after the position of its tick, s: half a tick for a
    /// torque that is held for a tick, less if the torques lag behind.
    pub delay: f64,
    /// The end of the search for this time, after which the residuals would fall further, s; it is
    /// no estimate and is not used.
    pub delay_end: Option<f64>,
    /// The mistake in the recording, if one was found; nothing is offered to paste then.
    pub mistake: Option<Mistake>,
    pub parameters: Vec<ParameterFound>,
    pub joints: Vec<JointFound>,
    pub bodies: Vec<BodyFound>,
    /// The kinds of friction that were not identified and lower the residuals.
    pub kinds: Vec<FrictionKind>,
    /// Torques of the held-out part.
    #[serde(skip)]
    pub traces: Vec<Trace>,
}

/// A base parameter.
#[derive(Clone, Debug, Serialize)]
pub struct ParameterFound {
    pub name: String,
    /// The value of the description.
    pub before: f64,
    pub found: f64,
    pub deviation: f64,
    /// Whether it is of an effect that is not identified.
    pub is_known: bool,
    /// Whether the motion shows it.
    pub is_determined: bool,
}

/// A joint.
#[derive(Clone, Debug, Serialize)]
pub struct JointFound {
    pub name: String,
    /// The numbers of the description, in the order of [`OfJoint`](crate::OfJoint).
    pub before: OfOneJoint,
    pub after: OfOneJoint,
    /// The deviations, if the number is a base parameter of its own.
    pub deviations: [Option<f64>; OF_JOINT],
    pub gear: Option<Gear>,
    pub fitted: RecordingPart,
    pub held_out: Option<RecordingPart>,
    /// Whether its residuals are noise, of which deviations follow.
    pub is_noise: bool,
}

/// Friction of a gear per transmitted torque, while the motor drives and while the load does; with
/// a deflection, μₐ and μ_d per torque of the motor.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Gear {
    pub friction: [f64; 2],
    pub deviations: [f64; 2],
    /// The distance h over which the friction follows a new direction, and its deviation, rad or m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub deflection: Option<[f64; 2]>,
}

/// A part of a recording at a joint, N·m or N.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct RecordingPart {
    pub largest_torque: f64,
    /// Residuals of the description, and of the findings.
    pub residuals: [Residuals; 2],
}

#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Residuals {
    pub rms: f64,
    pub largest: f64,
}

/// A body.
#[derive(Clone, Debug, Serialize)]
pub struct BodyFound {
    pub name: String,
    pub before: Numbers,
    pub after: Numbers,
    /// Which of its ten parameters the motion shows alone, m, m c, and the moments about the
    /// joint; of the others it shows combinations.
    pub is_determined: [bool; 10],
}

/// Mass, kg, centre of mass, m, and inertia about it, kg·m², in the frame of the body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Numbers {
    pub mass: f64,
    pub com: [f64; 3],
    pub inertia: [f64; 6],
}

/// The torques of a joint by time, and its friction by speed, measured and of the model.
#[derive(Clone, Debug, Serialize)]
pub struct Trace {
    pub joint: String,
    pub measured: Vec<(f64, f64)>,
    pub before: Vec<(f64, f64)>,
    pub after: Vec<(f64, f64)>,
    pub friction: Vec<(f64, f64)>,
    pub curve: Vec<(f64, f64)>,
}

impl Numbers {
    pub fn of(inertia: &MassProperties) -> Self {
        Self { mass: inertia.mass, com: inertia.com, inertia: inertia.inertia }
    }

    /// With as many digits as are pasted.
    pub fn rounded(inertia: &BodyInertia<f64>) -> Self {
        Self {
            mass: rounded(inertia.mass),
            com: inertia.com.map(rounded),
            inertia: inertia.inertia.map(rounded),
        }
    }
}

/// A number of six digits.
pub fn rounded(x: f64) -> f64 {
    format!("{x:.*e}", DIGITS - 1).parse().unwrap_or(x)
}

/// A number of four digits.
fn short(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        size if (1e-3..1e5).contains(&size) => {
            let digits = 3 - (size.max(1e-3).log10().floor() as i32).min(3);
            format!("{x:.*}", digits.clamp(0, 6) as usize)
        }
        _ => format!("{x:.2e}"),
    }
}

impl Findings {
    /// The joint whose residuals are the largest share of its torque, held out or else fitted, and
    /// that share.
    pub fn worst(&self) -> Option<(&JointFound, f64)> {
        let each = self.joints.iter().map(|joint| {
            let part = joint.held_out.unwrap_or(joint.fitted);
            (joint, part.residuals[1].rms / part.largest_torque.max(1e-300))
        });
        each.max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The names of the base parameters that the motion does not show.
    pub fn undetermined(&self) -> Vec<&str> {
        let hidden = |one: &&ParameterFound| !one.is_known && !one.is_determined;
        let all = self.parameters.iter().filter(hidden);
        all.map(|one| one.name.as_str()).collect()
    }

    /// The report for a person.
    pub fn text(&self) -> String {
        let mut text = String::new();
        let held = match self.other_path {
            true => "the other recording",
            false => "its last part",
        };
        let _ = writeln!(
            text,
            "{}: {} ticks of {} ms; fitted to {:.1} s, compared with {held}, {:.1} s; torques up to \
             {:.1} Hz",
            self.robot,
            self.ticks,
            short(1e3 * self.tick),
            self.fitted_seconds,
            self.held_out_seconds,
            self.cutoff
        );
        self.sampled(&mut text);
        self.time_of_torque(&mut text);
        self.excitation(&mut text);
        self.tables(&mut text);
        self.base(&mut text);
        self.residuals(&mut text, held);
        text
    }

    fn sampled(&self, text: &mut String) {
        let Sampling { left_out, duplicates, backward, gaps, gap_seconds, bridged, .. } =
            self.sampling;
        let _ = writeln!(
            text,
            "record: {gaps} gaps of {gap_seconds:.2} s in all; rows dropped: {left_out} on hold or \
             incomplete, {duplicates} with the time of the row before, {backward} with an earlier one"
        );
        self.look.iter().for_each(|found| *text += &format!("warning: {found}\n"));
        if self.sampling.is_resampled {
            let [rms, largest] = self.sampling.jitter.map(|share| 100.0 * share);
            let [error, missing] = self.sampling.error(self.cutoff, self.tick);
            let _ = writeln!(
                text,
                "resampled: intervals differ from {} ms by {rms:.1} % RMS, at most {largest:.1} %; \
                 {bridged} missing samples between others. Cubics between samples change positions \
                 and torques up to {:.1} Hz by at most {:.3} % of an amplitude, {:.2} % at missing \
                 samples",
                short(1e3 * self.tick),
                self.cutoff,
                100.0 * error,
                100.0 * missing
            );
        }
    }

    fn time_of_torque(&self, text: &mut String) {
        let (own, ends) = match self.held {
            true => (0.5 * self.tick, "the middle of its tick"),
            false => (0.0, "the time of its position"),
        };
        let lag = own - self.delay;
        *text += &match (self.delay_end, &self.mistake, lag) {
            (Some(end), ..) => format!(
                "warning: the residuals fall up to the end of the search for a delay of the \
                 torques, {} ms, which is no estimate and is not used\n",
                short(-1e3 * end)
            ),
            (_, Some(Mistake::NotExplained { .. }), _) => {
                "delay: not known, since the residuals are not explained\n".to_owned()
            }
            (.., 0.0) => format!("delay: none; each torque belongs to {ends}\n"),
            _ => format!(
                "warning: the torques {} the positions by {} ms; the fit takes this into account\n",
                if lag > 0.0 { "lag behind" } else { "are ahead of" },
                short(1e3 * lag.abs())
            ),
        };
    }

    fn excitation(&self, text: &mut String) {
        let hidden = self.undetermined();
        let free = self.parameters.iter().filter(|one| !one.is_known).count();
        let _ = writeln!(
            text,
            "\nexcitation: condition number {}; {} of {free} base parameters are determined",
            short(self.condition),
            free - hidden.len()
        );
        if !hidden.is_empty() {
            *text += "not determined by this motion, and left near the description:\n";
            for name in hidden {
                let _ = writeln!(text, "  {name}");
            }
        }
    }

    fn tables(&self, text: &mut String) {
        let presliding =
            self.joints.iter().any(|one| one.gear.is_some_and(|g| g.deflection.is_some()));
        let gear = if presliding { "gear μₐ, μ_d, h" } else { "gear driving, driven" };
        let titles = ["joint", "viscous", "Coulomb", "armature", "offset", gear];
        let mut rows = vec![titles.map(str::to_owned)];
        for joint in &self.joints {
            let number = |k: usize| {
                let change = format!("{} → {}", short(joint.before[k]), short(joint.after[k]));
                match joint.deviations[k] {
                    Some(deviation) => format!("{change} ± {}", short(deviation)),
                    None => change,
                }
            };
            let gear = joint.gear.map_or("–".to_owned(), |gear| {
                let of = |k: usize| format!("{:.2} ± {:.2}", gear.friction[k], gear.deviations[k]);
                let h = gear.deflection.map(|h| h.map(short));
                let h = h.map_or(String::new(), |[h, own]| format!(", {h} ± {own}"));
                format!("{}, {}{h}", of(0), of(1))
            });
            let name = joint.name.clone();
            rows.push([name, number(0), number(1), number(2), number(3), gear]);
        }
        *text += "\n";
        *text += &aligned(&rows);
        for joint in self.joints.iter().filter(|one| one.after[4..] != [0.0; 2]) {
            let [excess, asymmetry] = [4, 5].map(|k| short(joint.after[k]));
            let [own, of] = [4, 5].map(|k| joint.deviations[k].map_or("–".to_owned(), short));
            let speed = self.stribeck_speed.map_or("–".to_owned(), short);
            let _ = writeln!(
                text,
                "  {}: Stribeck's excess {excess} ± {own} below some {speed} rad/s or m/s; half of \
                 the difference of directions {asymmetry} ± {of}",
                joint.name
            );
        }
        self.masses(text);
        match &self.mistake {
            Some(mistake @ Mistake::NotExplained { .. }) => {
                let _ = writeln!(text, "warning: the recording is {mistake}");
            }
            Some(mistake) => {
                let _ = writeln!(
                    text,
                    "warning: no possible robot fits this recording, unless a mistake is \
                     corrected: {mistake}"
                );
            }
            None if self.misfit > IMPOSSIBLE => {
                let _ = writeln!(
                    text,
                    "warning: no possible robot has this estimate: the nearest one is {:.1} \
                     standard deviations away. No single wrong sign, unit or zero explains it",
                    self.misfit
                );
            }
            None => {}
        }
    }

    /// The bodies, of which a motion mostly shows combinations.
    fn masses(&self, text: &mut String) {
        let mut rows = vec![["body", "mass, kg", "centre of mass, m"].map(str::to_owned)];
        let mark = |is_shown: bool, number: f64| match is_shown {
            true => short(number),
            false => short(number) + "*",
        };
        for body in &self.bodies {
            let [mass, moments @ ..]: [bool; 4] = std::array::from_fn(|k| body.is_determined[k]);
            let com = body.after.com.into_iter().zip(moments);
            let com: Vec<String> = com.map(|(c, own)| mark(mass && own, c)).collect();
            rows.push([
                body.name.clone(),
                format!("{} → {}", short(body.before.mass), mark(mass, body.after.mass)),
                format!("{} → {}", body.before.com.map(short).join(" "), com.join(" ")),
            ]);
        }
        *text += "\n";
        *text += &aligned(&rows);
        if rows.iter().flatten().any(|cell| cell.contains('*')) {
            *text += "  * of this the motion shows combinations with other numbers only, below; of all \
                      possible ones it is the nearest to the description\n";
        }
    }

    /// The base parameters that the motion shows.
    fn base(&self, text: &mut String) {
        let mut rows = vec![
            ["base parameter", "description", "found", "deviation", "of it"].map(str::to_owned),
        ];
        for one in self.parameters.iter().filter(|one| !one.is_known && one.is_determined) {
            rows.push([
                one.name.clone(),
                short(one.before),
                short(one.found),
                short(one.deviation),
                percent(one.deviation, one.found.abs()),
            ]);
        }
        *text += "\n";
        *text += &aligned(&rows);
    }

    fn residuals(&self, text: &mut String, held: &str) {
        let titles =
            ["joint", "largest torque", "description, RMS", "found, RMS", "found, largest"];
        let mut table = |title: &str, of: &dyn Fn(&JointFound) -> Option<RecordingPart>| {
            let mut rows = vec![titles.map(str::to_owned)];
            for joint in &self.joints {
                let Some(part) = of(joint) else { continue };
                let [before, after] = part.residuals;
                let of = |x: f64| format!("{}, {}", short(x), percent(x, part.largest_torque));
                rows.push([
                    joint.name.clone(),
                    short(part.largest_torque),
                    of(before.rms),
                    of(after.rms),
                    of(after.largest),
                ]);
            }
            if rows.len() > 1 {
                let _ = write!(
                    text,
                    "\nresiduals of {title}, N·m or N, and of the largest torque:\n{}",
                    aligned(&rows)
                );
            }
        };
        table("the fitted part", &|joint| Some(joint.fitted));
        table(held, &|joint| joint.held_out);
        self.friction(text, held);
        if let Some((joint, share)) = self.worst() {
            let _ = writeln!(
                text,
                "\ntorques of {held} within {} of the largest torque, RMS; the worst joint is {}",
                percent(share, 1.0),
                joint.name
            );
        }
    }
}

impl Findings {
    /// The kinds of friction that the recording carries, and whether deviations are intervals.
    fn friction(&self, text: &mut String, held: &str) {
        for one in &self.kinds {
            let (name, word) = match one.effect {
                JointEffect::Stribeck => ("Stribeck's effect", "stribeck"),
                JointEffect::Asymmetric => ("friction that differs with direction", "asymmetric"),
                _ => ("friction that grows with the load", "load"),
            };
            let [from, to] = one.residuals.map(|share| 100.0 * share);
            let at = one
                .speed
                .map_or(String::new(), |v| format!(" below some {} rad/s or m/s", short(v)));
            let _ = writeln!(
                text,
                "{}: {name}{at} lowers the residuals of {held} from {from:.1} to {to:.1} % of the \
                 largest torque (--effects …,{word})",
                one.joint
            );
        }
        let names: Vec<&str> =
            self.joints.iter().filter(|one| !one.is_noise).map(|one| one.name.as_str()).collect();
        if !names.is_empty() {
            let _ = writeln!(
                text,
                "warning: the residuals of {} are no noise: the arm has something that the model \
                 lacks, and the deviations are no intervals of its numbers",
                names.join(", ")
            );
        }
    }
}

/// Columns of equal width.
fn aligned<const N: usize>(rows: &[[String; N]]) -> String {
    let width = |k: usize| rows.iter().map(|row| row[k].chars().count()).max();
    let widths: [usize; N] = std::array::from_fn(|k| width(k).unwrap_or_default());
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (cell, width) in row.iter().zip(widths) {
            let _ = write!(line, "{cell:width$}  ");
        }
        let _ = writeln!(text, "  {}", line.trim_end());
    }
    text
}
