//! The verdict on a change, as it is printed and kept for the next run.

use serde::{Deserialize, Serialize};

use crate::rooms::room_of;
use crate::site::Site;

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// This test failed, or took more than ten times as long as without a change.
    Killed(String),
    /// Every test that reaches it passed.
    Survived,
    /// No test reaches it.
    Unreached,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Outcome {
    pub room: String,
    pub file: String,
    pub function: String,
    pub line: usize,
    pub change: String,
    pub operator: String,
    pub verdict: Verdict,
}

impl Outcome {
    pub fn of(site: &Site, verdict: Verdict) -> Self {
        Self {
            room: room_of(&site.file).map_or("", |room| room.name).to_owned(),
            file: site.file.clone(),
            function: site.function.clone(),
            line: site.line,
            change: site.change.clone(),
            operator: site.operator.to_owned(),
            verdict,
        }
    }
}

#[derive(Debug, Default, Serialize)]
pub struct Results {
    pub tests: usize,
    /// Tests that fail in the copy without a change.
    pub unusable: Vec<String>,
    pub outcomes: Vec<Outcome>,
}
