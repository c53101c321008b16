//! What is printed to be pasted is built and measured beside the ways that it was chosen for: it must cost and err the
//! same.

use serde_json::Value;

use super::join::Host;
use super::measure::Measured;
use super::point::{Kind, Point};
use crate::costs::Row;
use crate::error::{Error, Result};

/// What is pasted may take so much more than was promised, or less, as shares: a caller gets torques in registers in
/// the one program and through memory in the other, and a function may be compiled into its caller.
const CLOSE: std::ops::RangeInclusive<f64> = 0.95..=1.02;

/// Fails unless all that is pasted reproduces its figures, errors to the bit; else says how much that is.
pub fn check(measured: &Measured) -> Result<usize> {
    let Measured {
        single: points,
        host,
        pasted,
        ..
    } = measured;
    let mut unlike = Vec::new();
    for row in pasted {
        let point = promised(points, &row.robot, &row.inputs)?;
        let seen = [
            row.instructions.max as f64,
            row.cycles.max as f64,
            row.cycles_mean,
        ];
        let told = [
            point.instructions as f64,
            point.cycles as f64,
            point.cycles_mean,
        ];
        let mut ratios = std::iter::zip(seen, told).map(|(seen, told)| seen / told);
        let close = ratios.all(|ratio| CLOSE.contains(&ratio));
        if !close {
            unlike.push(format!(
                "{} {}: instructions, cycles and their mean were promised as {told:?}, but what is pasted takes {seen:?}",
                row.robot, row.inputs
            ));
        }
        check_errors(host, row, point)?;
    }
    if pasted.is_empty() {
        return Err(Error::check("nothing that is pasted was measured"));
    }
    if !unlike.is_empty() {
        return Err(Error::check(unlike.join("\n")));
    }
    Ok(pasted.len())
}

fn promised<'a>(points: &'a [Point], robot: &str, key: &str) -> Result<&'a Point> {
    let of = |point: &&Point| {
        (point.kind, &*point.robot, &*point.key) == (Kind::Inverse, robot, key)
            && point.on("plant") == "rigid"
    };
    let lacks = || {
        Error::check(format!(
            "{robot} {key} is pasted, but not measured otherwise"
        ))
    };
    points.iter().find(of).ok_or_else(lacks)
}

fn check_errors(host: &Host, row: &Row, point: &Point) -> Result<()> {
    let of = |line: &&Value| line["robot"] == *row.robot && line["key"] == *row.inputs;
    let line = host.pasted.iter().find(of);
    let line = line.ok_or_else(|| {
        Error::check(format!(
            "the host did not paste {} {}",
            row.robot, row.inputs
        ))
    })?;
    let figures = [
        ("error_max", point.error_max),
        ("error_rms", point.error_rms),
        ("error_p99", point.error_p99),
    ];
    for (name, told) in figures {
        let seen = line[name].as_f64();
        if seen != told {
            return Err(Error::check(format!(
                "{} {}: {name} was promised as {told:?}, but what is pasted has {seen:?}",
                row.robot, row.inputs
            )));
        }
    }
    Ok(())
}
