//! The results of the last whole run, from which a choice is made without measuring.

use std::path::PathBuf;

use super::front;
use super::page::COMMAND;
use super::point::Point;
use super::proven;
use crate::kit::error::{Result, check, refuse_if};
use crate::kit::workspace::{self, Workspace};

/// The points, one a line.
pub const FILE: &str = "docs/accuracy.json";

/// Recorded figures may be so far from today's, as a share: those of one program, these of another
/// one.
const CLOSE: f64 = 0.05;

pub fn read(workspace: &Workspace) -> Result<Vec<Point>> {
    let text = workspace::read(&workspace.root.join(FILE))?;
    let mut points: Vec<Point> = serde_json::from_str(&text)
        .map_err(|e| check!("{FILE}: {e}; `{COMMAND}` writes it anew"))?;
    front::mark(&mut points);
    proven::attach(&proven::read(workspace, None)?, &mut points);
    Ok(points)
}

/// The file with what was measured in the place of what it had of the same.
pub fn replaced(workspace: &Workspace, measured: &[Point]) -> Result<(PathBuf, String)> {
    let mut points = read(workspace)?;
    points.retain(|old| !measured.iter().any(|new| new.group() == old.group()));
    points.extend_from_slice(measured);
    points.sort_by(|a, b| a.group().cmp(&b.group()));
    // Proofs have a file of their own.
    points.iter_mut().for_each(|point| point.proven = None);
    let line = |point| serde_json::to_string(point).map_err(|e| check!("cannot write {FILE}: {e}"));
    let lines = points.iter().map(line).collect::<Result<Vec<_>>>()?;
    let text = format!("[\n{}\n]\n", lines.join(",\n"));
    Ok((workspace.report(FILE), text))
}

/// Fails unless these, measured now, are recorded as they are: errors to the bit, costs closely.
pub fn check(recorded: &[Point], now: &[Point]) -> Result<()> {
    for point in now {
        let same = |old: &&Point| old.group() == point.group() && old.key == point.key;
        let old = recorded.iter().find(same);
        let close = |old: &Point| {
            let apart =
                std::iter::zip(old.costs(), point.costs()).map(|(a, b)| (a / b - 1.0).abs());
            old.error_max == point.error_max && apart.into_iter().all(|apart| apart <= CLOSE)
        };
        let (robot, key) = (&point.robot, &point.key);
        refuse_if!(
            !old.is_some_and(close),
            "{FILE} is out of date in {robot} {key}: `{COMMAND}` rewrites it"
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::front::tests::point;
    use super::check;

    #[test]
    fn what_is_recorded_is_compared_with_today() {
        let old = [point("default", 1e-6, 1000, 1000.0)];
        assert!(check(&old, &[point("default", 1e-6, 1040, 1040.0)]).is_ok());
        assert!(check(&old, &[point("default", 1e-6, 1100, 1100.0)]).is_err());
        assert!(check(&old, &[point("default", 2e-6, 1000, 1000.0)]).is_err());
        assert!(check(&old, &[point("trig=a", 1e-6, 1000, 1000.0)]).is_err());
    }
}
