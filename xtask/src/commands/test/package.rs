//! The steps about the library as a dependency: what cargo packages, its features and its examples.

use std::ffi::OsString;
use std::path::Path;

use super::{Context, host, others};
use crate::kit::error::{Error, Result, refuse_if};
use crate::kit::host_bin::SHARED;
use crate::kit::shell;
use crate::kit::toolchain::{TARGET, Toolchain};

const LIBRARY: &str = "dynamics-core";
const CONTROLLER: &str = "motion-control";
const FEATURES: &str = "defmt,serde";
/// The example whose numbers are compared with and without features: it prints all digits of a
/// simulation's end.
const COMPARED: &str = "computed_torque";

pub fn package(context: &Context) -> Result<String> {
    context.cargo(&["package --package dynamics-core --allow-dirty"])
}

pub fn features(context: &Context) -> Result<String> {
    if context.tools.toolchain == Toolchain::Native {
        for library in [LIBRARY, CONTROLLER] {
            let check = format!("check --package {library} --features {FEATURES}");
            context.cargo(&[&format!("{check} --target {TARGET}")])?;
        }
    }
    let plain = run_example(context, COMPARED, "")?;
    let with_features = run_example(context, COMPARED, &format!("--features {FEATURES}"))?;
    refuse_if!(
        plain != with_features,
        "the features `{FEATURES}` change the numbers of `{COMPARED}`:\n{plain}\n{with_features}"
    );
    match others::msrv(context) {
        Err(Error::Skipped(why)) => Ok(format!("{FEATURES}; the oldest compiler: {why}")),
        rustc => Ok(format!("{FEATURES}; {}", rustc?)),
    }
}

/// The examples in the documentation, and those of the library.
pub fn examples(context: &Context) -> Result<String> {
    let documented = host::doctests(context)?;
    let workspace = &context.workspace;
    shell::capture(SHARED.build(workspace).arg("--examples"))?;
    let mut ran = Vec::new();
    for library in [LIBRARY, CONTROLLER] {
        ran.extend(example_names(&workspace.root, library)?);
    }
    for name in &ran {
        shell::capture(&mut SHARED.built(workspace, &format!("examples/{name}")))?;
    }
    Ok(format!("{documented}; {}", ran.join(", ")))
}

fn run_example(context: &Context, name: &str, more: &str) -> Result<String> {
    let run = format!("run --quiet --package {LIBRARY}");
    context.cargo(&[&format!("{run} --example {name} {more}")])
}

/// The names of a library's examples, which must be some.
fn example_names(root: &Path, library: &str) -> Result<Vec<String>> {
    let folder = root.join(library).join("examples");
    let entries = std::fs::read_dir(&folder).map_err(Error::file("read", &folder))?;
    let files = entries.flatten().map(|entry| entry.file_name());
    let stem = |file: OsString| Some(file.to_str()?.strip_suffix(".rs")?.to_owned());
    let mut names: Vec<String> = files.filter_map(stem).collect();
    names.sort();
    refuse_if!(names.is_empty(), "{} is empty", folder.display());
    Ok(names)
}

pub fn deny(context: &Context) -> Result<String> {
    if shell::which("cargo-deny").is_none() {
        if !context.options.agrees() {
            let why = "to have it run: cargo install cargo-deny --locked";
            return Err(Error::Skipped(why.into()));
        }
        context.cargo(&["install cargo-deny --locked"])?;
    }
    context.cargo(&["deny check bans licenses sources"])?;
    Ok(String::new())
}
