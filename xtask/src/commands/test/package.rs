//! The steps about the library as a dependency: what cargo packages, its features and its examples.

use std::ffi::OsString;
use std::path::Path;

use super::{Context, others};
use crate::kit::error::{Error, Result, refuse_if};
use crate::kit::host_bin::SHARED;
use crate::kit::shell;
use crate::kit::toolchain::{TARGET, Toolchain};
use crate::kit::workspace::read;

const LIBRARY: &str = "dynamics-core";
const CONTROLLER: &str = "motion-control";
const FEATURES: &str = "defmt,serde";
/// The files of the root that the crate has to contain: copies, since a symbolic link is a text
/// file after a checkout on Windows.
const COPIES: [&str; 2] = ["LICENSE-APACHE", "LICENSE-MIT"];
/// The example whose numbers are compared with and without features: it prints all digits of a
/// simulation's end.
const COMPARED: &str = "computed_torque";

pub fn package(context: &Context) -> Result<String> {
    let root = &context.workspace.root;
    for library in [LIBRARY, CONTROLLER] {
        copies_are_equal(root, &root.join(library))?;
    }
    context.cargo(&["package --package dynamics-core --allow-dirty"])
}

/// Compares what stands in the workspace's root with the crate's copies.
fn copies_are_equal(root: &Path, library: &Path) -> Result<()> {
    for name in COPIES {
        let is_other = read(&root.join(name))? != read(&library.join(name))?;
        refuse_if!(is_other, "{} is not a copy of {name}", library.join(name).display());
    }
    Ok(())
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

pub fn examples(context: &Context) -> Result<String> {
    let workspace = &context.workspace;
    shell::capture(SHARED.build(workspace).arg("--examples"))?;
    let mut ran = Vec::new();
    for library in [LIBRARY, CONTROLLER] {
        ran.extend(example_names(&workspace.root, library)?);
    }
    for name in &ran {
        shell::capture(&mut SHARED.built(workspace, &format!("examples/{name}")))?;
    }
    Ok(ran.join(", "))
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

#[cfg(test)]
mod tests {
    use super::{COPIES, LIBRARY, copies_are_equal};
    use crate::kit::workspace::write;

    #[test]
    fn a_licence_that_differs_from_its_copy_is_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        let library = folder.path().join(LIBRARY);
        std::fs::create_dir(&library).expect("a folder");
        for name in COPIES {
            write(&folder.path().join(name), "a licence").expect("written");
            write(&library.join(name), "a licence").expect("written");
        }
        copies_are_equal(folder.path(), &library).expect("equal");
        write(&library.join(COPIES[0]), "another licence").expect("written");
        let error = copies_are_equal(folder.path(), &library).expect_err("not equal");
        assert!(error.to_string().contains(COPIES[0]), "{error}");
    }
}
