//! What a scene's run amounts to; its fields are those of the JSON.

use cycle_meter::Sample;
use serde::{Deserialize, Serialize};

use crate::elf::Sizes;
use crate::error::{Error, Result};
use crate::meter::{self, BETWEEN, Cost, REGIONS};
use crate::protocol::{Gains, LAWS, PLANTS, Recording, Trajectory};

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
    /// Gravity compensation, and PD.
    pub gravity: Errors,
    /// PD alone.
    pub pd: Errors,
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
    /// The laws with their printed names.
    pub fn laws(&self) -> [(&'static str, &Errors); 3] {
        let [feedforward, gravity, pd] = LAWS.map(|(_, printed)| printed);
        [
            (feedforward, &self.feedforward),
            (gravity, &self.gravity),
            (pd, &self.pd),
        ]
    }

    /// The error with feed-forward as a share of PD's.
    pub fn ratio(&self) -> f64 {
        self.feedforward.rms_rad / self.pd.rms_rad
    }

    fn of(recording: &Recording, plant: &str) -> Result<Self> {
        let errors = |law: &str| {
            recording
                .trajectory(plant, law)
                .and_then(errors)
                .ok_or_else(|| Error::check(format!("there is no run of {law} on {plant}")))
        };
        Ok(Self {
            feedforward: errors("feedforward")?,
            gravity: errors("gravity")?,
            pd: errors("pd")?,
        })
    }
}

fn errors(run: &Trajectory) -> Option<Errors> {
    Some(Errors {
        rms_rad: run.total?,
        max_rad: run.max.iter().copied().fold(0.0, f64::max),
        per_joint: std::iter::zip(&run.rms, &run.max)
            .map(|(&rms_rad, &max_rad)| JointError { rms_rad, max_rad })
            .collect(),
        status: run.status.clone(),
    })
}

impl Report {
    /// From what the firmware said and the meter saw.
    pub fn new(
        recording: &Recording,
        samples: &[Sample],
        sizes: Sizes,
        rustc: String,
        qemu: String,
    ) -> Result<Self> {
        recording.complete()?;
        let ticks = recording.ticks as usize;
        // The other laws cost less: the figures are those of the law that we sell.
        let is_sold = |tick: usize| {
            let run = recording.order.get(tick / ticks.max(1));
            run.is_some_and(|(_, law)| law == LAWS[0].0)
        };
        let all = ticks * recording.order.len();
        let costs = meter::costs(samples, all, is_sold)?;
        let cost = |name: &str| {
            let mut names = REGIONS.iter().chain([&BETWEEN]);
            let at = names.position(|region| *region == name);
            at.and_then(|at| costs.get(at).copied()).unwrap_or_default()
        };
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
            tracking: Tracking::of(recording, PLANTS[0])?,
            tracking_mismatched: Tracking::of(recording, PLANTS[1])?,
            flash_bytes: sizes.flash,
            ram_bytes: sizes.ram,
            stack_bytes: recording.stack.unwrap_or_default(),
            rustc,
            qemu,
        })
    }
}
