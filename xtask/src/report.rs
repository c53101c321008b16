//! What a scene's run amounts to; its fields are those of the JSON.

use std::collections::BTreeMap;

use cycle_meter::Sample;
use serde::{Deserialize, Serialize};

use crate::bars::largest;
use crate::callgraph::Reach;
use crate::elf::Image;
use crate::error::{Error, Result};
use crate::meter::{self, BETWEEN, Cost, REGIONS};
use crate::protocol::{Gains, PD, PLANTS, Recording, SOLD, Trajectory, WITHOUT};

/// What every cycle figure has to say of itself.
pub const MODEL: &str = "modelled Cortex-M4F, zero-wait memory; instructions exact";

/// Everything that the demo prints.
#[derive(Debug, Serialize, Deserialize)]
pub struct Report {
    /// The scene.
    pub scene: String,
    /// What the cycle figures are.
    pub model: String,
    /// Ticks measured: those of the runs with feed-forward.
    pub ticks_measured: usize,
    /// Length of a tick's period in µs.
    pub period_us: u32,
    /// The price of a tick.
    pub tick: Tick,
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
    /// What each of them is worth that the scene runs without.
    pub effects: Vec<Worth>,
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
    /// The emulator.
    pub qemu: String,
}

/// The price of each phase of a tick.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct Tick {
    /// The whole tick.
    pub total: Cost,
    /// Reading the encoders.
    pub read: Cost,
    /// Evaluating the trajectory.
    pub reference: Cost,
    /// Computing the torques.
    pub dynamics: Cost,
    /// The safety gate.
    pub safety: Cost,
    /// Commanding the drives.
    pub write: Cost,
    /// What is in none of them.
    pub between: Cost,
}

/// The error of each law.
#[derive(Debug, Serialize, Deserialize)]
pub struct Tracking {
    /// Full inverse dynamics along the reference, and PD.
    pub feedforward: Errors,
    /// What the scene compares beside.
    #[serde(flatten)]
    pub beside: BTreeMap<String, Errors>,
    /// PD alone.
    pub pd: Errors,
}

/// What an effect costs, and what is lost without it.
#[derive(Debug, Serialize, Deserialize)]
pub struct Worth {
    /// Its type.
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
    /// What the safety gate said.
    pub status: String,
    /// Modelled cycles of the longest tick under this law.
    pub tick_cycles: u64,
}

/// The tracking error of a joint.
#[derive(Debug, Serialize, Deserialize)]
pub struct JointError {
    /// Its RMS.
    pub rms_rad: f64,
    /// Its largest absolute value.
    pub max_rad: f64,
}

impl Tick {
    /// The phases with their names, the total last.
    pub fn phases(&self) -> [(&'static str, &Cost); 7] {
        [
            ("read", &self.read),
            ("reference", &self.reference),
            ("dynamics", &self.dynamics),
            ("safety", &self.safety),
            ("write", &self.write),
            (BETWEEN, &self.between),
            ("total", &self.total),
        ]
    }
}

impl Tracking {
    /// The laws by their names, the one to sell first, PD last.
    pub fn laws(&self) -> Vec<(&str, &Errors)> {
        let beside = self
            .beside
            .iter()
            .map(|(law, errors)| (law.as_str(), errors));
        let sold = std::iter::once((SOLD, &self.feedforward));
        sold.chain(beside).chain([(PD, &self.pd)]).collect()
    }

    /// The error with feed-forward as a share of PD's.
    pub fn ratio(&self) -> f64 {
        self.feedforward.rms_rad / self.pd.rms_rad
    }

    fn of(recording: &Recording, costs: &[Cost], plant: &str) -> Result<Self> {
        let errors = |law: &str| {
            run(recording, costs, plant, law)
                .and_then(|(run, cost)| errors(run, cost))
                .ok_or_else(|| Error::check(format!("there is no run of {law} on {plant}")))
        };
        let mut beside = BTreeMap::new();
        for law in recording.laws(plant) {
            if ![SOLD, PD].contains(&law) {
                beside.insert(law.to_owned(), errors(law)?);
            }
        }
        Ok(Self {
            feedforward: errors(SOLD)?,
            beside,
            pd: errors(PD)?,
        })
    }
}

impl Worth {
    /// Of each effect that the scene runs without.
    fn all(recording: &Recording, costs: &[Cost], image: &Image) -> Result<Vec<Self>> {
        let plant = PLANTS[0];
        let at = |law: &str| run(recording, costs, plant, law);
        let none = || Error::check(format!("there is no run of {SOLD} on {plant}"));
        let (full, full_cost) = at(SOLD).ok_or_else(none)?;
        let mut all = Vec::new();
        for effect in &recording.effects {
            let Some((run, cost)) = at(&format!("{WITHOUT}{}", effect.name)) else {
                continue;
            };
            all.push(Self {
                effect: effect.name.clone(),
                cycles: full_cost.cycles.max as i64 - cost.cycles.max as i64,
                flash_bytes: code(image, full)? as i64 - code(image, run)? as i64,
                ram_bytes: effect.bytes,
                without: errors(run, cost).ok_or_else(none)?,
            });
        }
        Ok(all)
    }
}

/// Bytes of the code that a run's tick can reach.
fn code(image: &Image, run: &Trajectory) -> Result<u64> {
    let reach = Reach::of(image, |function| function.address == run.tick_at)?;
    Ok(reach
        .functions()
        .map(|(function, _)| function.bytes.len() as u64)
        .sum())
}

/// The run of a law on a plant, with the price of its tick; `costs` are in the order of the runs.
fn run<'a>(
    recording: &'a Recording,
    costs: &'a [Cost],
    plant: &str,
    law: &str,
) -> Option<(&'a Trajectory, &'a Cost)> {
    let mut order = recording.order.iter();
    let place = order.position(|(on, name)| on == plant && name == law)?;
    Some((recording.trajectory(plant, law)?, costs.get(place)?))
}

fn errors(run: &Trajectory, cost: &Cost) -> Option<Errors> {
    Some(Errors {
        rms_rad: run.total?,
        max_rad: largest(run.max.iter().copied()),
        per_joint: std::iter::zip(&run.rms, &run.max)
            .map(|(&rms_rad, &max_rad)| JointError { rms_rad, max_rad })
            .collect(),
        status: run.status.clone(),
        tick_cycles: cost.cycles.max,
    })
}

impl Report {
    /// From what the firmware said and the meter saw.
    pub fn new(
        recording: &Recording,
        samples: &[Sample],
        image: &Image,
        rustc: String,
        qemu: String,
    ) -> Result<Self> {
        recording.complete()?;
        let ticks = recording.ticks as usize;
        // The other laws cost less: the figures are those of the law that we sell.
        let is_sold = |tick: usize| {
            let run = recording.order.get(tick / ticks.max(1));
            run.is_some_and(|(_, law)| law == SOLD)
        };
        let all = ticks * recording.order.len();
        let costs = meter::costs(samples, all, is_sold)?;
        let cost = |name: &str| {
            let mut names = REGIONS.iter().chain([&BETWEEN]);
            let at = names.position(|region| *region == name);
            at.and_then(|at| costs.get(at).copied()).unwrap_or_default()
        };
        let of_runs = (0..recording.order.len())
            .map(|run| {
                let costs = meter::costs(samples, all, |tick| tick / ticks.max(1) == run)?;
                Ok(costs.first().copied().unwrap_or_default())
            })
            .collect::<Result<Vec<Cost>>>()?;
        Ok(Self {
            scene: recording.scene.clone(),
            model: MODEL.to_owned(),
            ticks_measured: (0..all).filter(|tick| is_sold(*tick)).count(),
            period_us: recording.tick_us,
            tick: Tick {
                total: cost("total"),
                read: cost("read"),
                reference: cost("reference"),
                dynamics: cost("dynamics"),
                safety: cost("safety"),
                write: cost("write"),
                between: cost(BETWEEN),
            },
            gains: recording.gains.clone(),
            peak_speed: recording.peak_speed(),
            tracking: Tracking::of(recording, &of_runs, PLANTS[0])?,
            tracking_mismatched: Tracking::of(recording, &of_runs, PLANTS[1])?,
            bound_rad: recording.bound,
            named: recording
                .effects
                .iter()
                .map(|effect| effect.name.clone())
                .collect(),
            effects: Worth::all(recording, &of_runs, image)?,
            tick_bytes: recording
                .trajectory(PLANTS[0], SOLD)
                .map_or(Ok(0), |run| code(image, run))?,
            flash_bytes: image.sizes.flash,
            ram_bytes: image.sizes.ram,
            stack_bytes: recording.stack.unwrap_or_default(),
            rustc,
            qemu,
        })
    }
}
