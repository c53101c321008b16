//! Numbers as a person would write them.

use std::f64::consts::FRAC_PI_2;

use dynamics_core::glam::DMat3;
use serde::{Deserialize, Serialize};

use crate::snap;

/// A number of at most 12 digits, where it differs from that by rounding alone.
pub fn tidy(x: f64) -> f64 {
    let short: f64 = format!("{x:.11e}").parse().unwrap_or(x);
    // A negative zero is written as zero.
    if (short - x).abs() <= 4.0 * f64::EPSILON * x.abs() { short + 0.0 } else { x }
}

/// A number as a literal of Rust: exact when it is parsed again.
pub fn literal(x: f64) -> String {
    let plain = format!("{x:?}");
    match x.abs() {
        size if size != 0.0 && !(1e-4..1e7).contains(&size) => format!("{x:e}"),
        _ => plain,
    }
}

/// An attitude as [`dynamics_core::model::Body`] takes it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Attitude {
    /// Quarter turns about x, y and z.
    QuarterTurns([i32; 3]),
    /// Roll, pitch and yaw, rad.
    Rpy([f64; 3]),
}

impl Attitude {
    /// Makes the angles of a rotation matrix.
    pub fn of(rotation: &DMat3) -> Self {
        if let Some(turns) = snap::as_quarter_turns(rotation) {
            return Self::QuarterTurns(turns);
        }
        let [x, y, z] = [rotation.x_axis, rotation.y_axis, rotation.z_axis];
        let along = x.x.hypot(x.y);
        let pitch = (-x.z).atan2(along);
        let [roll, yaw] = match along > 1e-12 {
            true => [y.z.atan2(z.z), x.y.atan2(x.x)],
            // At a pitch of a quarter turn only the sum or difference of the two is determined.
            false => [(-z.y).atan2(y.y), 0.0],
        };
        Self::Rpy([roll, pitch, yaw].map(|angle| {
            let turns = (angle / FRAC_PI_2).round();
            let exact = turns * FRAC_PI_2;
            if (angle - exact).abs() < 1e-15 { exact } else { tidy(angle) }
        }))
    }
}

/// An angle as a literal, with the constants of π.
pub fn angle(x: f64) -> String {
    match x {
        _ if x == FRAC_PI_2 => "FRAC_PI_2".to_owned(),
        _ if x == -FRAC_PI_2 => "-FRAC_PI_2".to_owned(),
        _ if x == 2.0 * FRAC_PI_2 => "PI".to_owned(),
        _ if x == -2.0 * FRAC_PI_2 => "-PI".to_owned(),
        _ => literal(x),
    }
}
