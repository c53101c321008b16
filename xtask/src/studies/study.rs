//! A study: it measures something and keeps a page. Its command, its page and pictures, its JSON
//! and its step of the tests follow from its row in `STUDIES`.

use std::cell::OnceCell;
use std::process::ExitCode;

use clap::{Arg, ArgAction, ArgMatches, Command, FromArgMatches};
use serde::Serialize;

use crate::kit::docs::{self, Page};
use crate::kit::error::{Result, bail, check};
use crate::kit::output;
use crate::kit::setup::{self, Options, Tools};
use crate::kit::table::plain;
use crate::kit::workspace::{self, Workspace};

pub struct Study {
    /// The name of its command and of its step, and in the markers of its page.
    pub name: &'static str,
    /// The line of its command in `--help`.
    pub about: &'static str,
    /// The files that it writes, its page first and then its picture.
    pub files: &'static [&'static str],
    pub held: Held,
    pub form: Form,
}

/// The check that the figures keep their bounds.
pub enum Held {
    /// A step of `cargo xtask test`, for this claim.
    Step(Lane, Scope, &'static str),
    /// Nothing measures them anew in a test, for this reason; a test checks what the page says of
    /// its bars.
    Bars(&'static str),
}

/// The way in which a study is measured and shown.
pub enum Form {
    /// It writes the part of the page between its markers.
    Part(Measure),
    /// Its command has options of its own, and it writes and compares its files itself.
    Own(Augment, Run, Check),
}

type Measure = fn(&Bench<'_>) -> Result<Found>;
type Augment = fn(Command) -> Command;
type Run = fn(Options, &ArgMatches) -> Result<ExitCode>;
type Check = fn(&Bench<'_>) -> Result<String>;

/// The runs of the tests that a step belongs to.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Scope {
    /// Every run, on the cheapest witness of each claim; a full run adds the others.
    Everyday,
    /// A full run only, or by name.
    Full,
    /// By name only: a full run would take longer than CI has.
    Named,
}

/// One of the two rows of steps that run side by side: cargo builds for the host and for the target
/// in different directories, and the one keeps no core busy while the other links or emulates.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Lane {
    Host,
    Target,
}

pub struct Bench<'a> {
    pub workspace: &'a Workspace,
    pub options: Options,
    tools: OnceCell<Tools>,
}

impl<'a> Bench<'a> {
    pub fn new(workspace: &'a Workspace, options: Options) -> Self {
        Self { workspace, options, tools: OnceCell::new() }
    }

    /// With tools that are set up already, for one of the tests.
    pub fn of_test(workspace: &'a Workspace, options: Options, tools: Tools) -> Self {
        Self { workspace, options, tools: tools.into() }
    }

    /// The compiler of the firmware and the emulator, set up when the first study asks: a study of
    /// the host needs none.
    pub fn tools(&self) -> Result<&Tools> {
        if let Some(tools) = self.tools.get() {
            return Ok(tools);
        }
        let tools = setup::for_demo(self.options)?;
        Ok(self.tools.get_or_init(|| tools))
    }

    /// The compiler of the firmware.
    pub fn rustc(&self) -> Result<String> {
        self.tools()?.toolchain.rustc_version()
    }
}

#[derive(Default)]
pub struct Found {
    /// The page, or its part.
    pub text: String,
    pub picture: Option<String>,
    pub json: String,
    /// Bars that are missed, and cases that fail.
    pub wrong: Vec<String>,
    /// The figures that the step of the tests names.
    pub summary: String,
}

impl Found {
    pub fn new(text: String, measurements: &impl Serialize) -> Result<Self> {
        Ok(Self { text, json: docs::json(measurements)?, ..Self::default() })
    }

    fn verdict(&self) -> Result<()> {
        if !self.wrong.is_empty() {
            bail!("bar: {}", self.wrong.join("\nbar: "));
        }
        Ok(())
    }
}

impl Study {
    pub fn command(&self) -> Command {
        let command = Command::new(self.name).about(self.about);
        match self.form {
            Form::Own(options, ..) => options(command).about(self.about),
            _ => command.arg(
                Arg::new("json")
                    .long("json")
                    .action(ArgAction::SetTrue)
                    .help("The measurements as JSON on stdout; progress stays on stderr"),
            ),
        }
    }

    pub fn run(&self, options: Options, matches: &ArgMatches) -> Result<ExitCode> {
        match self.form {
            Form::Own(_, run, _) => run(options, matches),
            Form::Part(measure) => {
                let workspace = Workspace::for_reports()?;
                let found = measure(&Bench::new(&workspace, options))?;
                self.write(&workspace, &found)?;
                match matches.get_flag("json") {
                    true => output::line(&found.json)?,
                    false => output::print(&format!("\n{}", plain(&found.text)))?,
                }
                found.verdict().map(|()| ExitCode::SUCCESS)
            }
        }
    }

    /// Fails unless all bounds hold; else says what was measured.
    pub fn check(&self, bench: &Bench<'_>) -> Result<String> {
        match self.form {
            Form::Own(_, _, check) => check(bench),
            Form::Part(measure) => {
                let found = measure(bench)?;
                found.verdict().map(|()| found.summary)
            }
        }
    }

    fn write(&self, workspace: &Workspace, found: &Found) -> Result<()> {
        let command = format!("cargo xtask {}", self.name);
        let page = Page { file: self.files[0], name: self.name, command: &command };
        page.write(workspace, &found.text)?;
        for (file, picture) in self.files[1..].iter().zip(&found.picture) {
            workspace::write(&workspace.report(file), picture)?;
        }
        Ok(())
    }
}

/// The arguments of a study with options of its own.
pub fn given<A: FromArgMatches>(matches: &ArgMatches) -> Result<A> {
    A::from_arg_matches(matches).map_err(|error| check!("{error}"))
}

#[cfg(test)]
mod tests {
    use super::{Form, Found, Held, Study};
    use crate::kit::workspace::Workspace;

    #[test]
    fn a_study_writes_its_files_and_fails_beyond_a_bound() {
        let folder = tempfile::tempdir().expect("a folder");
        let workspace = Workspace::at(folder.path());
        let part = "# By hand\n\n<!-- sample:begin -->\n<!-- sample:end -->\n";
        let read = |file| std::fs::read_to_string(folder.path().join(file)).expect("there");
        std::fs::write(folder.path().join("page.md"), part).expect("written");
        let mut found =
            Found { text: "| 1 |\n".into(), picture: Some("<svg/>".into()), ..Found::default() };
        let study = Study {
            name: "sample",
            about: "",
            files: &["page.md", "page.svg"],
            held: Held::Bars(""),
            form: Form::Part(|_| Ok(Found::default())),
        };
        study.write(&workspace, &found).expect("written");
        assert!(read("page.md").contains("# By hand") && read("page.md").contains("| 1 |\n"));
        assert_eq!(read("page.svg"), "<svg/>");
        assert!(found.verdict().is_ok());
        found.wrong.push("cycles 2 > 1".into());
        let error = found.verdict().expect_err("a bound").to_string();
        assert_eq!(error, "bar: cycles 2 > 1");
    }
}
