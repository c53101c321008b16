//! The results of the last whole run, from which a choice is made without measuring.

use std::path::PathBuf;

use super::front;
use super::page::COMMAND;
use super::point::Point;
use super::proven;
use crate::kit::docs::json_lines;
use crate::kit::error::{Result, check};
use crate::kit::workspace::{self, Workspace};

/// The points, one a line.
pub const FILE: &str = "docs/accuracy.json";

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
    Ok((workspace.report(FILE), json_lines(&points)? + "\n"))
}
