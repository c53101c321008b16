//! `cargo xtask import`: a robot from a file, by the crate `robot-import`, and what its inverse
//! dynamics costs.

use std::path::Path;
use std::process::ExitCode;

use crate::kit::error::{Error, Result};
use crate::kit::importer::passed::{IMPORT, NEW, Passed};
use crate::kit::importer::{ALL, Robot, command, measure, report};
use crate::kit::meter::MODEL;
use crate::kit::qemu::PROGRAM;
use crate::kit::rows::Row;
use crate::kit::setup::{self, Options};
use crate::kit::table::{Table, thousands};
use crate::kit::workspace::{self, Workspace};
use crate::kit::{apt, docs, output};

/// A file, and the options of `robot-import import`.
#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    passed: Passed<IMPORT>,
    /// Do not measure in QEMU what inverse dynamics costs
    #[arg(long)]
    no_measure: bool,
}

/// The arguments of `robot-import new`.
pub type New = Passed<NEW>;

/// Writes a project.
pub fn new(args: &New) -> Result<ExitCode> {
    let text = command(&Workspace::find()?, "new", &args.0)?;
    let folder = apt::unpacked(PROGRAM);
    output::print(&with_path(&text, folder.as_deref()))?;
    Ok(ExitCode::SUCCESS)
}

/// The commands of QEMU that a project's text recommends, with the folder of an unpacked QEMU on
/// the PATH.
fn with_path(text: &str, folder: Option<&Path>) -> String {
    let Some(folder) = folder else {
        return text.to_owned();
    };
    let quoted = folder.display().to_string().replace('\'', r"'\''");
    let path = format!(r#"PATH="$PATH":'{quoted}'"#);
    let mut with_path = text.to_owned();
    for command in ["cargo qemu", "make run"] {
        with_path = with_path.replace(
            &format!("&& {command}\n"),
            &format!("&& {path} {command}\n"),
        );
    }
    match with_path == text {
        true => with_path,
        false => {
            with_path
                + &format!("note: {PROGRAM} is not on your PATH: `export {path}` puts it there\n")
        }
    }
}

pub fn run(options: Options, args: Args) -> Result<ExitCode> {
    let workspace = Workspace::find()?;
    let scratch = tempfile::tempdir().map_err(Error::file("create", &workspace.target))?;
    let mut passed = args.passed;
    let json = passed.take("--json").is_some();
    let [kept, reported] = ["--out=", "--report="].map(|option| passed.take(option));
    let scratch = |name| scratch.path().join(name).display().to_string();
    let file = kept.clone().unwrap_or_else(|| scratch("robot.rs"));
    let json_file = reported.unwrap_or_else(|| scratch("report.json"));
    let written = [format!("--out={file}"), format!("--report={json_file}")];
    passed.0.extend(written);
    let text = command(&workspace, "import", &passed.0)?;
    let report = report(&workspace::read(json_file.as_ref())?)?;
    let file = file.into();
    let robot = Robot { file, report };
    let measured = (!args.no_measure).then(|| {
        setup::for_demo(options).and_then(|tools| measure(&workspace, &tools, &[&robot], ALL))
    });
    if json {
        let mut report = robot.report;
        let rows = measured.transpose().unwrap_or_default();
        report["measured"] = serde_json::to_value(rows.unwrap_or_default()).unwrap_or_default();
        docs::print_json(&report)?;
        return Ok(ExitCode::SUCCESS);
    }
    // A measured figure is not estimated.
    let is_measured = matches!(&measured, Some(Ok(rows)) if !rows.is_empty());
    output::print(if is_measured {
        without_estimate(&text)
    } else {
        &text
    })?;
    match measured {
        Some(Ok(rows)) => output::print(&format!("\n{MODEL}:\n{}", table(&rows).text()))?,
        Some(Err(error)) => output::note(&format!("not measured: {error}")),
        None => {}
    }
    show(&robot.file, kept.is_some())?;
    Ok(ExitCode::SUCCESS)
}

/// The importer's report up to its last paragraph, the estimate of the cycles.
fn without_estimate(text: &str) -> &str {
    let estimate = "\nInverse dynamics by the engine: about ";
    text.rsplit_once(estimate)
        .map_or(text, |(before, _)| before)
}

/// The file itself, where it is not kept.
fn show(file: &Path, kept: bool) -> Result<()> {
    match kept {
        true => output::print(&format!("\nwritten: {}\n", file.display())),
        false => output::print(&format!("\n{}", workspace::read(file)?)),
    }
}

pub fn table(rows: &[Row]) -> Table {
    let mut table = Table::new(&[
        "inverse dynamics",
        "form",
        "cycles",
        "instructions",
        "code, B",
        "stack, B",
    ]);
    for row in rows {
        let figures = [
            row.cycles.max,
            row.instructions.max,
            row.code_bytes,
            row.stack_bytes,
        ];
        let names = [row.inputs.clone(), row.form.clone()];
        table.row(names.into_iter().chain(figures.map(thousands)));
    }
    table
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::{with_path, without_estimate};

    #[test]
    fn no_estimate_stands_beside_a_measurement() {
        let report = "Advice:\n  none\n\nInverse dynamics by the engine: about 740 cycles on a \
            Cortex-M4F and 2664 B of code (estimated).\n";
        assert_eq!(without_estimate(report), "Advice:\n  none\n");
        assert_eq!(without_estimate("Advice:\n  none\n"), "Advice:\n  none\n");
    }

    #[test]
    fn a_recommended_command_finds_an_unpacked_qemu() {
        for command in ["cargo qemu", "make run"] {
            let text = format!("written\n\nnext: cd my-arm && {command}\n");
            assert_eq!(with_path(&text, None), text);
            let said = with_path(&text, Some(Path::new("/it's/usr/bin")));
            let path = r#"PATH="$PATH":'/it'\''s/usr/bin'"#;
            assert!(
                said.contains(&format!("next: cd my-arm && {path} {command}\n")),
                "{said}"
            );
            assert!(
                said.ends_with(&format!("`export {path}` puts it there\n")),
                "{said}"
            );
        }
        let board = "next: cd my-arm && cargo build --release; README.md says what to connect\n";
        assert_eq!(with_path(board, Some(Path::new("/usr/bin"))), board);
    }

    /// A shell finds the program by the command that is recommended.
    #[test]
    #[cfg(unix)]
    fn a_shell_takes_the_recommended_path() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().expect("a folder");
        let place = folder.path().join("it's here");
        std::fs::create_dir_all(&place).expect("a folder");
        let program = place.join("make");
        std::fs::write(&program, "#!/bin/sh\necho found $1\n").expect("written");
        let rights = std::fs::Permissions::from_mode(0o755);
        std::fs::set_permissions(&program, rights).expect("set");
        let said = with_path("next: true && make run\n", Some(&place));
        let line = said
            .lines()
            .next()
            .and_then(|line| line.strip_prefix("next: "));
        let mut shell = std::process::Command::new("/bin/sh");
        let output = shell
            .args(["-c", line.expect("a command")])
            .env("PATH", "/nowhere")
            .output();
        assert_eq!(output.expect("a shell").stdout, b"found run\n");
    }
}
