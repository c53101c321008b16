//! `cargo xtask identify`: the parameters of a robot's file from a recording, by the package `identify`, and their picture.

use std::path::Path;
use std::process::{Command, ExitCode};

use serde::Deserialize;

use crate::kit::chart::{self, Axis, HPos, Line, RGBColor};
use crate::kit::error::{Error, Result, check};
use crate::kit::workspace::{self, Workspace};
use crate::kit::{output, shell};

const PACKAGE: &str = "identify";
/// The profile in which its equations are solved within a second.
const PROFILE: &str = "simulated";
/// The most of a picture.
const HEIGHT: usize = 900;
/// The lines of a chart, and their colours.
const NAMES: [&str; 3] = ["measured", "by the description", "by what was found"];
const COLOURS: [RGBColor; 3] = [chart::COLOURS[3], chart::COLOURS[1], chart::COLOURS[0]];

/// A recording, and options of the package `identify`.
#[derive(clap::Args)]
pub struct Args {
    /// The record of `cargo xtask watch`, --robot FILE, and other options: --effects, --validate, --width, --cutoff, --out, --json,
    /// and those of `import` that select joints; the torques are drawn beside the record
    #[arg(value_name = "CSV", required = true, num_args = 1.., trailing_var_arg = true, allow_hyphen_values = true)]
    arguments: Vec<String>,
}

/// The torques of a joint by time.
#[derive(Deserialize)]
struct Trace {
    joint: String,
    measured: Vec<(f64, f64)>,
    before: Vec<(f64, f64)>,
    after: Vec<(f64, f64)>,
}

pub fn run(args: &Args) -> Result<ExitCode> {
    let workspace = Workspace::find()?;
    let mut build = workspace.cargo("build");
    shell::cargo(build.args(["--profile", PROFILE, "--package", PACKAGE]))?;
    let folder = tempfile::tempdir().map_err(Error::file("create", &workspace.target))?;
    let traces = folder.path().join("traces.json");
    let file = format!("{PROFILE}/{PACKAGE}{}", std::env::consts::EXE_SUFFIX);
    let mut program = Command::new(workspace.target.join(file));
    program.arg("--traces").arg(&traces).args(&args.arguments);
    let status = shell::run_for_user(&mut program)?;
    if status.success() && traces.is_file() {
        let record = args.arguments.iter().find(|word| word.ends_with(".csv"));
        let picture =
            Path::new(record.map_or("run.csv", String::as_str)).with_extension("torques.svg");
        workspace::write(&picture, drawn(&workspace::read(&traces)?)?)?;
        output::note(&format!("drawn: {}", picture.display()));
    }
    // It has printed its error.
    Ok(ExitCode::from(u8::from(!status.success())))
}

/// A chart for each joint, from the base outward.
fn drawn(json: &str) -> Result<String> {
    let traces: Vec<Trace> = serde_json::from_str(json)
        .map_err(|error| check!("`{PACKAGE}` wrote what is not understood: {error}"))?;
    let columns = if traces.len() > 3 { 2 } else { 1 };
    let rows = traces.len().div_ceil(columns).max(1);
    let size = (
        480 * columns as u32 + 280,
        (HEIGHT / rows).min(300) as u32 * rows as u32,
    );
    chart::svg(size, |root| {
        let areas = root.split_evenly((rows, columns));
        for (trace, area) in traces.iter().zip(&areas) {
            chart::label(
                area,
                &format!("{}, torque in N·m or N", trace.joint),
                (28, 14),
                15,
                HPos::Left,
            )?;
            let names = NAMES.map(str::to_owned).into_iter().zip(COLOURS);
            chart::legend(area, names, (70, 34))?;
            let all = [&trace.measured, &trace.before, &trace.after];
            let lines = all.iter().zip(COLOURS).map(|(points, colour)| Line {
                points: (*points).clone(),
                colour,
                dots: false,
            });
            let of = |of: fn(&(f64, f64)) -> f64| {
                let values = || all.iter().flat_map(|points| points.iter()).map(of);
                let least = values().fold(f64::INFINITY, f64::min);
                [least, values().fold(least + 1e-9, f64::max)]
            };
            let axes = [
                Axis::linear("s", of(|at| at.0), 7, 36),
                Axis::linear("", of(|at| at.1), 4, 60),
            ];
            chart::lines(area, 44, [&axes[0], &axes[1]], &lines.collect::<Vec<_>>())?;
        }
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    #[test]
    fn each_joint_has_its_chart() {
        let trace = |name: &str| {
            let line = "[[0.0,1.0],[1.0,-2.0]]";
            format!(r#"{{"joint":"{name}","measured":{line},"before":{line},"after":{line}}}"#)
        };
        let names = ["a", "b", "c", "d"].map(|name| format!("joint {name}"));
        let json = format!("[{}]", names.each_ref().map(|name| trace(name)).join(","));
        let svg = super::drawn(&json).expect("a picture");
        assert!(
            names.iter().all(|name| svg.contains(name.as_str())),
            "{svg}"
        );
        assert!(super::drawn("{}").is_err());
    }
}
