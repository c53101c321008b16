//! The robot of a file for a report: imported, and given to bins of the firmware and of the host.

use std::path::PathBuf;

use serde_json::Value;
use tempfile::TempDir;

use crate::kit::error::{Error, Result, bail};
use crate::kit::importer;
use crate::kit::importer::passed::{OF_FILE, Passed};
use crate::kit::workspace::{self, Workspace};

/// The file of a report's robot.
#[derive(clap::Args)]
#[group(skip)]
pub struct Args {
    /// Measure the robot of this file, URDF or MJCF, alone; no page is written
    #[arg(long, value_name = "FILE")]
    file: Option<PathBuf>,
    #[command(flatten)]
    options: Passed<OF_FILE>,
}

pub struct OwnRobot {
    pub file: PathBuf,
    pub name: String,
    /// The name of its type.
    pub type_name: String,
    pub joints: u64,
    /// Its Rust file, and what the bins include: two commands at a time have two.
    folder: TempDir,
}

impl Args {
    /// The robot, if there is a file; fails if the firmware does not take it, or not this many
    /// joints.
    pub fn robot(&self, workspace: &Workspace, most: u64) -> Result<Option<OwnRobot>> {
        let Some(file) = &self.file else {
            return Ok(None);
        };
        let folder = tempfile::tempdir().map_err(Error::file("create", &workspace.target))?;
        let path = file.to_string_lossy();
        let words = std::iter::once(&*path).chain(self.options.0.iter().map(String::as_str));
        let words: Vec<&str> = words.collect();
        let report = importer::import(workspace, &words, folder.path().join("robot.rs"))?.report;
        if let Some(why) = refusal(&report, most) {
            bail!("{path}: {why}");
        }
        let text = |name: &str| report[name].as_str().unwrap_or_default().to_owned();
        Ok(Some(OwnRobot {
            file: file.clone(),
            name: text("name"),
            type_name: text("type_name"),
            joints: report["sizes"][2].as_u64().unwrap_or_default(),
            folder,
        }))
    }
}

impl OwnRobot {
    /// Writes what the bins include, and returns the file.
    pub fn included(&self) -> Result<PathBuf> {
        let [file, bins] = ["robot.rs", "own_robot.rs"].map(|name| self.folder.path().join(name));
        let text = format!(
            "#[path = {file:?}]\nmod robot;\ntype Robot = fixtures::Own<robot::{}>;\n\
             const N: usize = robot::V;\n",
            self.type_name
        );
        workspace::write(&bins, text)?;
        Ok(bins)
    }
}

/// The reason why a firmware for this number of joints does not take the robot of a report, if
/// there is one.
fn refusal(report: &Value, most: u64) -> Option<String> {
    let [bodies, q, v] = [0, 1, 2].map(|i| report["sizes"][i].as_u64().unwrap_or_default());
    if bodies != v || q != v {
        return Some(format!(
            "{bodies} bodies have {q} position and {v} velocity coordinates, but the measured \
             firmware takes joints of one coordinate only, and no free base"
        ));
    }
    (v > most).then(|| {
        format!(
            "{v} joints are more than the {most} that fit into the RAM of the measured firmware: \
             --tip, --joints or --lock leave some out"
        )
    })
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::refusal;

    #[test]
    fn unsuitable_robots_are_refused_with_the_reason() {
        let said = |sizes: [u64; 3]| refusal(&json!({ "sizes": sizes }), 40);
        assert_eq!(said([6, 6, 6]), None);
        assert_eq!(said([40, 40, 40]), None);
        let reason = |sizes| said(sizes).unwrap_or_default();
        assert!(reason([41, 41, 41]).starts_with("41 joints are more than the 40"));
        // A universal joint, and a free base.
        for sizes in [[6, 7, 7], [7, 13, 12]] {
            assert!(reason(sizes).contains("joints of one coordinate"), "{sizes:?}");
        }
        assert!(refusal(&json!({ "sizes": [21, 21, 21] }), 20).is_some());
    }
}
