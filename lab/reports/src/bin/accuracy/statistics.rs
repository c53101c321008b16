//! Errors of many answers, and the lines of JSON that say them.

use dynamics_core::state::State;
use host_tests::measured::largest;
use serde_json::{Value, json};

/// |error| of every joint in every answer.
#[derive(Clone, Debug, Default)]
pub struct Errors(Vec<f64>);

impl Errors {
    /// The errors of answers against the truth.
    pub fn of<const N: usize>(pairs: impl Iterator<Item = ([f64; N], [f64; N])>) -> Self {
        let mut errors = Self::default();
        pairs.for_each(|(answer, truth)| errors.add(&answer, &truth));
        errors
    }

    pub fn add<const N: usize>(&mut self, answer: &[f64; N], truth: &[f64; N]) {
        let errors = answer.iter().zip(truth).map(|(a, b)| (a - b).abs());
        let stated = |error: f64| if error.is_nan() { f64::INFINITY } else { error };
        self.0.extend(errors.map(stated));
    }

    pub fn max(&self) -> f64 {
        largest(self.0.iter().copied())
    }

    pub fn rms(&self) -> f64 {
        (self.0.iter().map(|e| e * e).sum::<f64>() / self.0.len() as f64).sqrt()
    }

    /// The smallest error that 99 % do not exceed.
    fn p99(&self) -> f64 {
        let mut sorted = self.0.clone();
        sorted.sort_by(f64::total_cmp);
        sorted[(sorted.len() * 99).div_ceil(100) - 1]
    }

    /// Prints a line with them, none smaller than `floor`, and with what else it is to have.
    pub fn print(&self, robot: &str, kind: &str, [full_scale, floor]: [f64; 2], more: Value) {
        let [max, rms, p99] = [self.max(), self.rms(), self.p99()].map(|e| largest([e, floor]));
        let mut line = json!({
            "robot": robot,
            "kind": kind,
            "unit": "N·m",
            "full_scale": full_scale,
            "error_max": max,
            "error_rms": rms,
            "error_p99": p99,
            "relative_max": max / full_scale,
        });
        if let (Value::Object(line), Value::Object(more)) = (&mut line, more) {
            line.extend(more);
        }
        println!("{line}");
    }
}

/// Axes as a JSON object.
pub fn object<'a>(axes: impl Iterator<Item = &'a (&'a str, &'a str)>) -> Value {
    let named = |&(axis, value): &(&str, &str)| (axis.to_owned(), json!(value));
    Value::Object(axes.map(named).collect())
}

pub fn widened<const N: usize>(state: &State<f32, N, N>) -> State<f64, N, N> {
    let [q, qd, qdd] = [state.q, state.qd, state.qdd].map(|numbers| numbers.map(f64::from));
    State { q, qd, qdd }
}
