//! The summary of a scene's run; its fields are those of the JSON.

use std::collections::BTreeMap;

use cycle_meter::Sample;
use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

use crate::kit::elf::Image;
use crate::kit::error::{Result, check};
use crate::kit::meter::{self, BETWEEN, Cost, MODEL, REGIONS};
use crate::kit::protocol::{FEEDFORWARD, Gains, PD, PLANTS, Recording, Trajectory, WITHOUT};
use crate::kit::rows::code_bytes;

#[derive(Debug, Serialize, Deserialize)]
pub struct Report {
    pub scene: String,
    /// The model of the cycle figures.
    pub model: String,
    /// Ticks measured: those of the runs with feed-forward.
    pub ticks_measured: usize,
    /// Length of a tick's period in µs.
    pub period_us: u32,
    /// The price of a tick by its parts: of the whole, of each phase, and of what is between them.
    pub tick: IndexMap<String, Cost>,
    /// The feedback's gains, if the scene says.
    pub gains: Option<Gains>,
    /// The greatest speed of a joint's reference in rad/s.
    pub peak_speed: f64,
    /// Errors with a plant that the controller knows exactly.
    pub tracking: Tracking,
    /// Errors with a plant that it does not know exactly.
    pub tracking_mismatched: Tracking,
    /// The largest error of a joint that is promised, with the exact model, rad.
    pub bound_rad: f64,
    /// The effects that the scene names.
    pub named: Vec<String>,
    /// The effects that the scene also runs without, with their value.
    pub effects: Vec<Ablation>,
    /// Code that the tick can reach, bytes: the rest of the flash simulates, compares and logs.
    pub tick_bytes: u64,
    /// Code, constants and initial values.
    pub flash_bytes: u64,
    /// Variables.
    pub ram_bytes: u64,
    /// Peak stack, painted.
    pub stack_bytes: u64,
    /// The compiler of the firmware.
    pub rustc: String,
    pub qemu: String,
}

#[derive(Debug, Serialize, Deserialize)]
pub struct Tracking {
    /// Full inverse dynamics along the reference, and PD.
    pub feedforward: Errors,
    /// Other laws that the scene compares.
    #[serde(flatten)]
    pub beside: BTreeMap<String, Errors>,
    pub pd: Errors,
}

/// The cost of an effect, and the error without it.
#[derive(Debug, Serialize, Deserialize)]
pub struct Ablation {
    pub effect: String,
    /// Modelled cycles of the longest tick that dropping it saves.
    pub cycles: i64,
    /// Bytes of the tick's code that dropping it saves.
    pub flash_bytes: i64,
    /// Bytes of RAM where its value is kept there, as in the plant.
    pub ram_bytes: u64,
    /// The error when the feed-forward lacks it, with the exact model.
    pub without: Errors,
}

/// The tracking error of a run.
#[derive(Debug, Serialize, Deserialize)]
pub struct Errors {
    /// RMS over all joints.
    pub rms_rad: f64,
    /// The largest of any joint.
    pub max_rad: f64,
    /// Each joint from the base.
    pub per_joint: Vec<JointError>,
    /// The force that starts the motion, N, if a hand leads the arm: the one joint is then the tip,
    /// and its errors are distances, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start_n: Option<f64>,
    /// The status of the safety gate.
    pub status: String,
    /// Modelled cycles of the longest tick under this law.
    pub tick_cycles: u64,
}

/// The tracking error of a joint.
#[derive(Debug, Serialize, Deserialize)]
pub struct JointError {
    pub rms_rad: f64,
    pub max_rad: f64,
}

impl Errors {
    /// The figure by which laws are compared.
    pub fn figure(&self) -> f64 {
        self.start_n.unwrap_or(self.rms_rad)
    }
}

impl Tracking {
    /// The laws by their names, feed-forward first, PD last.
    pub fn laws(&self) -> Vec<(&str, &Errors)> {
        let beside = self.beside.iter().map(|(law, errors)| (law.as_str(), errors));
        let first = std::iter::once((FEEDFORWARD, &self.feedforward));
        first.chain(beside).chain([(PD, &self.pd)]).collect()
    }

    /// The error with feed-forward as a share of PD's.
    pub fn ratio(&self) -> f64 {
        self.feedforward.rms_rad / self.pd.rms_rad
    }

    fn of(runs: &Runs<'_>, laws: &[&str], plant: &str) -> Result<Self> {
        let errors = |law: &str| runs.find(plant, law).map(|(run, cost)| errors(run, cost));
        let beside = laws.iter().filter(|law| ![FEEDFORWARD, PD].contains(law));
        Ok(Self {
            feedforward: errors(FEEDFORWARD)?,
            beside: beside
                .map(|law| Ok(((*law).to_owned(), errors(law)?)))
                .collect::<Result<_>>()?,
            pd: errors(PD)?,
        })
    }
}

/// The runs of a recording, each with the price of its tick.
struct Runs<'a>(Vec<(&'a Trajectory, Cost)>);

impl Runs<'_> {
    fn find(&self, plant: &str, law: &str) -> Result<(&Trajectory, &Cost)> {
        let mut runs = self.0.iter();
        let found = runs.find(|(run, _)| (&*run.plant, &*run.law) == (plant, law));
        let (run, cost) = found.ok_or_else(|| check!("there is no run of {law} on {plant}"))?;
        Ok((run, cost))
    }

    /// The value of each effect that the scene also runs without.
    fn ablations(&self, recording: &Recording, image: &Image) -> Result<Vec<Ablation>> {
        let (full, full_cost) = self.find(PLANTS[0], FEEDFORWARD)?;
        let mut all = Vec::new();
        for effect in &recording.effects {
            let law = format!("{WITHOUT}{}", effect.name);
            let Ok((run, cost)) = self.find(PLANTS[0], &law) else {
                continue;
            };
            all.push(Ablation {
                effect: effect.name.clone(),
                cycles: full_cost.cycles.max as i64 - cost.cycles.max as i64,
                flash_bytes: code(image, full)? as i64 - code(image, run)? as i64,
                ram_bytes: effect.bytes,
                without: errors(run, cost),
            });
        }
        Ok(all)
    }
}

/// Whether a tick of all runs is one with feed-forward: the other laws cost less.
fn is_feedforward(recording: &Recording, tick: usize) -> bool {
    recording.runs[tick / recording.ticks.max(1) as usize].law == FEEDFORWARD
}

/// The price of the ticks with feed-forward by their parts, in the order of [`Report::tick`].
fn feedforward_costs(recording: &Recording, samples: &[Sample]) -> Result<Vec<Cost>> {
    let all = recording.ticks.max(1) as usize * recording.runs.len();
    meter::costs(samples, all, |tick| is_feedforward(recording, tick))
}

/// Bytes of the code that a run's tick can reach.
fn code(image: &Image, run: &Trajectory) -> Result<u64> {
    code_bytes(image, run.tick_at, |_| false)
}

fn errors(run: &Trajectory, cost: &Cost) -> Errors {
    let joints = std::iter::zip(&run.rms, &run.max);
    Errors {
        rms_rad: run.total,
        max_rad: run.largest(),
        per_joint: joints.map(|(&rms_rad, &max_rad)| JointError { rms_rad, max_rad }).collect(),
        start_n: run.start,
        status: run.status.clone(),
        tick_cycles: cost.cycles.max,
    }
}

impl Report {
    /// Whether a hand leads the arm.
    pub fn is_guided(&self) -> bool {
        self.tracking.feedforward.start_n.is_some()
    }

    /// From what the firmware said and the meter saw.
    pub fn new(
        recording: &Recording,
        samples: &[Sample],
        image: &Image,
        rustc: String,
        qemu: String,
    ) -> Result<Self> {
        recording.complete()?;
        let ticks = recording.ticks.max(1) as usize;
        let all = ticks * recording.runs.len();
        let is_feedforward = |tick: usize| is_feedforward(recording, tick);
        let costs = feedforward_costs(recording, samples)?;
        let names = REGIONS.into_iter().chain([BETWEEN]);
        let mut runs = Runs(Vec::new());
        for (number, run) in recording.runs.iter().enumerate() {
            let costs = meter::costs(samples, all, |tick| tick / ticks == number)?;
            runs.0.push((run, costs[0]));
        }
        let tracking = |plant| Tracking::of(&runs, &recording.laws(plant), plant);
        let effects = recording.effects.iter();
        Ok(Self {
            scene: recording.scene.clone(),
            model: MODEL.to_owned(),
            ticks_measured: (0..all).filter(|tick| is_feedforward(*tick)).count(),
            period_us: recording.tick_us,
            tick: names.map(str::to_owned).zip(costs).collect(),
            gains: recording.gains.clone(),
            peak_speed: recording.peak_speed(),
            tracking: tracking(PLANTS[0])?,
            tracking_mismatched: tracking(PLANTS[1])?,
            bound_rad: recording.bound,
            named: effects.map(|effect| effect.name.clone()).collect(),
            effects: runs.ablations(recording, image)?,
            tick_bytes: code(image, runs.find(PLANTS[0], FEEDFORWARD)?.0)?,
            flash_bytes: image.sizes.flash,
            ram_bytes: image.sizes.ram,
            stack_bytes: recording.stack.unwrap_or_default(),
            rustc,
            qemu,
        })
    }
}
