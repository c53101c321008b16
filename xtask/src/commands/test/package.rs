//! The steps about the library as a dependency: what cargo packages, its features and its examples.

use std::ffi::OsString;
use std::path::Path;

use super::{Context, host, others};
use crate::kit::error::{Error, Result, check, refuse_if};
use crate::kit::host_bin::SHARED;
use crate::kit::shell;
use crate::kit::toolchain::{TARGET, Toolchain};

const LIBRARY: &str = "dynamics-core";
const CONTROLLER: &str = "motion-control";
const FEATURES: &str = "defmt,serde";
/// The example whose numbers are compared with and without features: it prints all digits of a
/// simulation's end.
const COMPARED: &str = "computed_torque";

/// What each package has beside its sources.
const BESIDE: [&str; 3] = ["LICENSE-APACHE", "LICENSE-MIT", "README.md"];

/// Packages each crate that may be published, and builds it from its package and from those of the
/// others.
pub fn package(context: &Context) -> Result<String> {
    let metadata = context.cargo(&["metadata --no-deps --format-version 1"])?;
    let packages = published(&metadata)?;
    let names: Vec<&str> = packages.iter().map(|(name, _)| name.as_str()).collect();
    let quick = "package --allow-dirty --config profile.dev.debug=false";
    context.cargo(&[format!("{quick} -p {}", names.join(" -p "))])?;
    for (name, version) in &packages {
        check_beside(&context.workspace.target.join(format!("package/{name}-{version}")))?;
    }
    Ok(names.join(", "))
}

/// The names and versions of the members whose manifests do not forbid to publish them.
fn published(metadata: &str) -> Result<Vec<(String, String)>> {
    #[derive(serde::Deserialize)]
    struct Metadata {
        packages: Vec<Package>,
    }
    #[derive(serde::Deserialize)]
    struct Package {
        name: String,
        version: String,
        publish: Option<Vec<String>>,
    }
    let metadata: Metadata =
        serde_json::from_str(metadata).map_err(|e| check!("cargo metadata: {e}"))?;
    let packages = metadata.packages.into_iter().filter(|package| package.publish.is_none());
    Ok(packages.map(|package| (package.name, package.version)).collect())
}

/// Fails if an unpacked package lacks a file that comes from outside its folder.
fn check_beside(folder: &Path) -> Result<()> {
    for name in BESIDE {
        let length = std::fs::metadata(folder.join(name)).map_or(0, |file| file.len());
        refuse_if!(length < 500, "{} lacks its {name}", folder.display());
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

#[cfg(test)]
mod tests {
    use super::{BESIDE, check_beside, published};

    #[test]
    fn a_package_without_its_licence_is_found() {
        let folder = tempfile::tempdir().expect("a folder");
        for name in BESIDE {
            std::fs::write(folder.path().join(name), "text ".repeat(200)).expect("a file");
        }
        assert!(check_beside(folder.path()).is_ok());
        // What a checkout without symbolic links has in its place.
        std::fs::write(folder.path().join("LICENSE-MIT"), "../LICENSE-MIT").expect("a file");
        let error = check_beside(folder.path()).expect_err("no licence").to_string();
        assert!(error.ends_with("lacks its LICENSE-MIT"), "{error}");
    }

    #[test]
    fn what_may_not_be_published_is_not_packaged() {
        let metadata = r#"{"packages": [{"name": "a", "version": "1.0.0", "publish": []},
            {"name": "b", "version": "0.1.0", "publish": null}]}"#;
        let names = published(metadata).expect("packages");
        assert_eq!(names, [("b".to_owned(), "0.1.0".to_owned())]);
    }
}
