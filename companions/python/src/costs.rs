//! Cycles on a Cortex-M4F, as the repository's pages record them.

use pyo3::prelude::*;
use serde::Deserialize;

use crate::error::Exception;

const COSTS: &str = include_str!("costs.json");
const SCENES: &str = include_str!("scenes.md");

/// The cost of one call on a modelled Cortex-M4F with zero-wait memory, the slowest of 32 random
/// states.
#[pyclass(frozen, get_all, module = "robot_dynamics", name = "Cost")]
pub struct Cost {
    /// The algorithm's name, such as "rnea".
    algorithm: String,
    /// "core", the textbook form, or "engine", the form that is specialised to the robot.
    form: String,
    /// The effects, such as "full": gravity, inertia and velocity products.
    inputs: String,
    /// Whether sines and cosines are computed inside the call.
    trigonometry: bool,
    /// The number of instructions, which is exact.
    instructions: u64,
    /// The number of cycles, which is modelled.
    cycles: u64,
    /// The time at 168 MHz, µs.
    microseconds: f64,
    /// Instructions and literals, bytes.
    code: u64,
    /// Bytes that are written to.
    stack: u64,
}

#[pymethods]
impl Cost {
    fn __repr__(&self) -> String {
        let Self { algorithm, form, inputs, cycles, .. } = self;
        let sines = if self.trigonometry { "with" } else { "without" };
        format!("Cost({algorithm} {form} {inputs}, {sines} sines: {cycles} cycles)")
    }
}

fn whole(cell: &str) -> Option<u64> {
    cell.replace(',', "").parse().ok()
}

/// The cells of a row of a table.
fn cells(line: &str) -> Vec<&str> {
    line.trim().trim_matches('|').split('|').map(str::trim).collect()
}

/// What is recorded of all robots.
#[derive(Deserialize)]
struct Record {
    rows: Vec<Row>,
}

#[derive(Deserialize)]
struct Row {
    robot: String,
    algorithm: String,
    form: String,
    inputs: String,
    trig: bool,
    instructions: u64,
    cycles: u64,
    code_bytes: u64,
    stack_bytes: u64,
}

/// The rows of a robot.
pub fn of(robot: &str) -> Vec<Cost> {
    let record = serde_json::from_str(COSTS).unwrap_or(Record { rows: Vec::new() });
    let rows = record.rows.into_iter().filter(|row| row.robot == robot);
    let cost = |row: Row| Cost {
        algorithm: row.algorithm,
        form: row.form,
        inputs: row.inputs,
        trigonometry: row.trig,
        instructions: row.instructions,
        cycles: row.cycles,
        microseconds: row.cycles as f64 / 168.0,
        code: row.code_bytes,
        stack: row.stack_bytes,
    };
    rows.map(cost).collect()
}

/// The longest tick of a scene, cycles: measuring, reference, dynamics, safety and commands.
pub fn tick(scene: &str) -> Option<u64> {
    let name = format!("**{scene}**");
    SCENES.lines().find_map(|line| match cells(line).as_slice() {
        [found, cycles, ..] if *found == name => whole(cycles),
        _ => None,
    })
}

/// The error of a robot of which nothing is recorded.
pub fn not_recorded(py: Python<'_>, robot: &str, what: &str) -> PyErr {
    let text = format!("{what} of `{robot}` is not recorded");
    Exception::new(py, "NotRecorded", text).with("robot", robot).build()
}
