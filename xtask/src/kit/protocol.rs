//! The firmware's log lines, as one recording.
//!
//! ```text
//! scene NAME joints N tick-us US ticks T bound B
//! gains OMEGA ZETA POSE
//! effect NAME BYTES                  each that the scene names
//! run PLANT LAW ADDRESS              of the function that is called each tick
//! sample TICK qd1..qdN q1..qN
//! rms e1..eN                         max e1..eN
//! total RMS                          status WORD…
//! start FORCE                        of a scene that a hand leads
//! stack BYTES
//! done
//! ```

use serde::{Deserialize, Serialize};

use crate::kit::bars::largest;
use crate::kit::error::{Result, check};
use crate::kit::qemu::DONE;

pub const FEEDFORWARD: &str = "feedforward";
/// The law that it is compared with.
pub const PD: &str = "pd";
/// The prefix of laws that are [`FEEDFORWARD`] without one effect.
pub const WITHOUT: &str = "without-";

/// The plants, the one that the controller knows exactly first.
pub const PLANTS: [&str; 2] = ["exact", "mismatched"];

/// One trajectory run under one law on one plant.
#[derive(Clone, Debug, Default)]
pub struct Trajectory {
    /// One of [`PLANTS`].
    pub plant: String,
    pub law: String,
    /// Tick, reference and true joint angles, every this many ticks.
    pub samples: Vec<Sample>,
    /// RMS of the tracking error of each joint in rad.
    pub rms: Vec<f64>,
    /// Largest absolute error of each joint in rad.
    pub max: Vec<f64>,
    /// RMS of the error over all joints in rad; not a number until it is reported.
    pub total: f64,
    /// The force that starts the motion, N, of an arm that a hand leads: its one joint is the tip,
    /// whose errors are the distances from the place of its release, m.
    pub start: Option<f64>,
    /// The status of the safety gate.
    pub status: String,
    /// The address of the function that runs each tick.
    pub tick_at: u64,
}

impl Trajectory {
    /// The largest error of any joint, rad.
    pub fn largest(&self) -> f64 {
        largest(self.max.iter().copied())
    }
}

/// An effect that the scene names.
#[derive(Clone, Debug)]
pub struct Named {
    pub name: String,
    /// The RAM of its value, bytes.
    pub bytes: u64,
}

#[derive(Clone, Debug)]
pub struct Sample {
    /// In ticks from the start of the run.
    pub tick: u32,
    /// Reference angle of each joint in rad.
    pub reference: Vec<f64>,
    /// Angle of each joint in rad.
    pub angle: Vec<f64>,
}

/// The parameters of the feedback's gains.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Gains {
    /// Natural frequency in rad/s.
    pub omega_n: f64,
    pub zeta: f64,
    /// The pose whose mass matrix they are for, or words for another inertia.
    pub pose: String,
}

#[derive(Debug, Default)]
pub struct Recording {
    pub scene: String,
    pub joints: usize,
    /// Length of a tick in µs.
    pub tick_us: u32,
    pub ticks: u32,
    /// The largest error of a joint that is promised, with the exact model, rad.
    pub bound: f64,
    /// The effects that the scene names.
    pub effects: Vec<Named>,
    /// The feedback's gains, if the scene says.
    pub gains: Option<Gains>,
    pub runs: Vec<Trajectory>,
    /// Peak stack in bytes.
    pub stack: Option<u64>,
}

impl Recording {
    /// Takes a line in; `false` if it is none of the protocol's.
    pub fn line(&mut self, line: &str) -> Result<bool> {
        let bad = || check!("the firmware's line {line:?} cannot be understood");
        self.take(line).ok_or_else(bad)
    }

    /// The same; nothing if a line of the protocol is not as it should be.
    fn take(&mut self, line: &str) -> Option<bool> {
        let words: Vec<&str> = line.split(' ').collect();
        let joints = self.joints;
        match *words.as_slice() {
            ["scene", name, _, joints, _, tick_us, _, ticks, _, bound] => {
                self.scene = name.into();
                self.joints = joints.parse().ok()?;
                self.tick_us = tick_us.parse().ok()?;
                self.ticks = ticks.parse().ok()?;
                self.bound = number(bound)?;
            }
            ["effect", name, bytes] => {
                self.effects.push(Named { name: name.into(), bytes: bytes.parse().ok()? })
            }
            ["gains", omega_n, zeta, ref pose @ ..] => {
                self.gains = Some(Gains {
                    omega_n: number(omega_n)?,
                    zeta: number(zeta)?,
                    pose: pose.join(" "),
                });
            }
            ["run", plant, law, at] => {
                let is_new = self.trajectory(plant, law).is_none() && PLANTS.contains(&plant);
                self.runs.push(is_new.then_some(Trajectory {
                    plant: plant.into(),
                    law: law.into(),
                    // The lowest bit of a function's address says Thumb.
                    tick_at: u64::from_str_radix(at.strip_prefix("0x")?, 16).ok()? & !1,
                    total: f64::NAN,
                    ..Trajectory::default()
                })?);
            }
            ["sample", tick, ref angles @ ..] => {
                let mut reference = numbers(angles, 2 * joints)?;
                let angle = reference.split_off(joints);
                self.runs.last_mut()?.samples.push(Sample {
                    tick: tick.parse().ok()?,
                    reference,
                    angle,
                });
            }
            ["rms", ref errors @ ..] => self.runs.last_mut()?.rms = numbers(errors, joints)?,
            ["max", ref errors @ ..] => self.runs.last_mut()?.max = numbers(errors, joints)?,
            ["total", rms] => self.runs.last_mut()?.total = number(rms)?,
            ["start", force] => self.runs.last_mut()?.start = Some(number(force)?),
            ["status", ref said @ ..] => self.runs.last_mut()?.status = said.join(" "),
            ["stack", bytes] => self.stack = Some(bytes.parse().ok()?),
            [DONE] => {}
            _ => return Some(false),
        }
        Some(true)
    }

    /// Fails with what is not there, if anything that the report needs is not.
    pub fn complete(&self) -> Result<()> {
        let mut lacks = Vec::new();
        if self.joints == 0 {
            lacks.push("its `scene`".to_owned());
        }
        if self.stack.is_none() {
            lacks.push("its `stack`".to_owned());
        }
        let needed = PLANTS.iter().flat_map(|plant| [FEEDFORWARD, PD].map(|law| (plant, law)));
        let missing = needed.filter(|(plant, law)| self.trajectory(plant, law).is_none());
        lacks.extend(missing.map(|(plant, law)| format!("`run {plant} {law}`")));
        for run in &self.runs {
            if run.rms.is_empty() || run.max.is_empty() || run.total.is_nan() {
                let (plant, law) = (&run.plant, &run.law);
                lacks.push(format!("`rms`, `max` and `total` of {plant} {law}"));
            }
        }
        match lacks.first() {
            None => Ok(()),
            Some(what) => Err(check!("the firmware did not report {what}")),
        }
    }

    /// The first run of these laws whose status is not this one, with its status.
    pub fn differing_status(&self, status: &str, laws: impl Fn(&str) -> bool) -> Option<String> {
        let mut runs = self.runs.iter();
        let run = runs.find(|run| laws(&run.law) && run.status != status)?;
        Some(format!("{} {}: {:?}", run.plant, run.law, run.status))
    }

    /// The greatest speed of a joint's reference between two samples, rad/s.
    pub fn peak_speed(&self) -> f64 {
        let samples = self.runs.first().map_or(&[][..], |run| &run.samples);
        let speeds = samples.windows(2).flat_map(|pair| {
            let seconds = f64::from(pair[1].tick - pair[0].tick) * f64::from(self.tick_us) * 1e-6;
            let turns = pair[1].reference.iter().zip(&pair[0].reference);
            turns.map(move |(to, from)| (to - from).abs() / seconds)
        });
        largest(speeds)
    }

    /// The run of a law on a plant.
    pub fn trajectory(&self, plant: &str, law: &str) -> Option<&Trajectory> {
        let mut runs = self.runs.iter();
        runs.find(|run| (&*run.plant, &*run.law) == (plant, law))
    }

    /// The laws on a plant in the order in which they ran, but for those that lack an effect; PD
    /// last.
    pub fn laws(&self, plant: &str) -> Vec<&str> {
        let runs = self.runs.iter().filter(|run| run.plant == plant);
        let laws = runs.map(|run| &*run.law);
        let mut laws: Vec<&str> = laws.filter(|law| !law.starts_with(WITHOUT)).collect();
        laws.sort_by_key(|law| *law == PD);
        laws
    }
}

/// This number of finite numbers, at least one of them.
fn numbers(words: &[&str], count: usize) -> Option<Vec<f64>> {
    let is_all = count > 0 && words.len() == count;
    words.iter().map(|word| number(word).filter(|_| is_all)).collect()
}

fn number(word: &str) -> Option<f64> {
    // defmt prints a slice with brackets and commas.
    let digits = word.trim_matches(['[', ']', ',']);
    digits.parse().ok().filter(|x: &f64| x.is_finite())
}

/// A law's name in print.
pub fn label(law: &str) -> String {
    match law {
        FEEDFORWARD => "feed-forward".into(),
        PD => "PD".into(),
        other => other.replace('-', " "),
    }
}

#[cfg(test)]
mod tests {
    use super::Recording;

    #[test]
    fn a_recording_takes_its_lines_and_leaves_the_others() {
        let mut recording = Recording::default();
        for line in [
            "scene two joints 2 tick-us 1000 ticks 3 bound 1e-3",
            "gains 25.1 1 home",
            "effect Viscous 24",
            "run exact pd 0x8001",
            "sample 0 0.1 0.2 0.11 2e-1",
            "rms 1e-3 2e-3",
            "max [1e-3, 2e-3]",
            "start 6.5",
            "stack 512",
        ] {
            assert!(recording.line(line).is_ok_and(|accepted| accepted), "{line}");
        }
        assert!(recording.line("hello there").is_ok_and(|accepted| !accepted));
        for line in [
            "sample 1 0.1",
            "rms NaN 0",
            "gains fast 1 home",
            "run magic pd 0x8001",
            "run exact pd 0x8001",
        ] {
            assert!(recording.line(line).is_err(), "{line}");
        }
        assert!(recording.complete().is_err());
    }
}
