//! The view as JSON and as a line of text.

use std::time::Duration;

use machine_link::PHASES;
use serde::Serialize;

use crate::view::{View, mode};

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// The name of the machine, if it arrived.
    pub machine: Option<String>,
    /// Ticks that arrived.
    pub ticks: u64,
    /// The time of the machine in these, s, if it has said how long a tick is.
    pub seconds: Option<f64>,
    pub bad_frames: u64,
    /// Ticks that the machine's queue dropped.
    pub dropped: u64,
    /// Ticks that were lost on the line.
    pub lost: u64,
    pub restarts: u64,
    pub mode: Option<&'static str>,
    pub joints: Vec<JointSummary>,
    pub cost: Vec<PhaseSummary>,
    /// Changes of mode and fault: number of the tick, and words.
    pub events: Vec<(u32, String)>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JointSummary {
    /// The root of the mean square of the tracking error, rad or m.
    pub rms_error: f64,
    /// The largest tracking error, rad or m.
    pub max_error: f32,
    /// The largest torque, N·m or N.
    pub max_torque: f32,
    /// The same as a share of the limit.
    pub max_torque_share: Option<f32>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PhaseSummary {
    pub phase: &'static str,
    /// The most counts of the timer.
    pub max_counts: u32,
    /// The same in µs, if the machine has a timer.
    pub max_us: Option<f64>,
}

impl Summary {
    #[must_use]
    pub fn of(view: &View) -> Self {
        let joint = |(number, extremes): (usize, &crate::view::Extremes)| JointSummary {
            rms_error: view.rms(number),
            max_error: extremes.error,
            max_torque: extremes.torque,
            max_torque_share: view.torque_limit(number).map(|limit| extremes.torque / limit),
        };
        let phase = |(phase, max_counts)| PhaseSummary {
            phase,
            max_counts,
            max_us: view.microseconds(max_counts),
        };
        Self {
            machine: view.machine.as_ref().map(|machine| machine.name.to_string()),
            ticks: view.ticks,
            seconds: view.seconds(),
            bad_frames: view.counts.bad,
            dropped: view.counts.dropped,
            lost: view.counts.lost(),
            restarts: view.counts.restarts,
            mode: view.last.as_ref().map(|tick| mode(tick.status.mode)),
            joints: view.extremes.iter().enumerate().map(joint).collect(),
            cost: PHASES.into_iter().zip(view.cost).map(phase).collect(),
            events: view.events.iter().map(|event| (event.first, event.words())).collect(),
        }
    }
}

/// The time that the machine ran, by its ticks and by this computer's clock.
#[must_use]
pub fn duration(view: &View, took: Duration) -> String {
    let took = took.as_secs_f64();
    match view.seconds() {
        Some(seconds) => {
            format!("{} ticks: {seconds:.2} s of the machine, in {took:.2} s", view.ticks)
        }
        None => format!("{} ticks in {took:.2} s", view.ticks),
    }
}

/// The view as a line, for a place that is no terminal.
#[must_use]
pub fn line(view: &View) -> String {
    let Some(last) = &view.last else {
        return "no tick yet".to_owned();
    };
    let error = last.joints.iter().map(|joint| joint.error().abs()).fold(0.0, f32::max);
    let us = view.microseconds(last.cost.iter().sum());
    let cost = us.map_or(String::new(), |us| format!(", {us:.1} µs"));
    let fault = last.status.fault.map_or(String::new(), |fault| format!(" ({fault})"));
    let counts = view.counts;
    format!(
        "tick {}: {}{fault}, error {:.3} mrad or mm at most{cost}; {} bad frames, {} dropped, {} \
         lost",
        last.number,
        mode(last.status.mode),
        1e3 * error,
        counts.bad,
        counts.dropped,
        counts.lost()
    )
}
