//! The steps about the library as a dependency: what cargo packages and vendors, its features and its examples.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::{Context, Outcome};
use crate::error::{Error, Result};
use crate::shell;
use crate::toolchain::{TARGET, Toolchain};
use crate::workspace::{read, write};

const LIBRARY: &str = "dynamics-core";
/// All of its features.
const FEATURES: &str = "defmt,serde";
/// The files of the root that the crate has to contain: copies, since a symbolic link is a text file after a checkout
/// on Windows.
const COPIES: [&str; 2] = ["LICENSE-APACHE", "LICENSE-MIT"];
/// The example whose numbers are compared with and without features: it prints all digits of a simulation's end.
const COMPARED: &str = "computed_torque";

pub fn package(context: &Context) -> Result<Outcome> {
    let root = &context.workspace.root;
    copies_are_equal(root, &root.join(LIBRARY))?;
    let mut cargo = context.workspace.cargo("package");
    shell::capture(cargo.args(["--package", LIBRARY, "--allow-dirty"]))?;
    let folder = Folder::new("vendored")?;
    vendored_builds(context, &folder.0)?;
    Outcome::PASSED
}

/// Compares what stands in the workspace's root with the crate's copies.
fn copies_are_equal(root: &Path, library: &Path) -> Result<()> {
    for name in COPIES {
        if read(&root.join(name))? != read(&library.join(name))? {
            let what = format!("{LIBRARY}/{name} is not a copy of {name}");
            return Err(Error::check(what));
        }
    }
    Ok(())
}

/// Builds a project that depends on the library by git, from nothing but what `cargo vendor` has copied.
fn vendored_builds(context: &Context, folder: &Path) -> Result<()> {
    let git_url = commit_work_tree(&context.workspace.root, &folder.join("repository"))?;
    let project = folder.join("project");
    let manifest = format!(
        "[package]\nname = \"vendored\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\n[workspace]\n\n\
         [dependencies]\n{LIBRARY} = {{ git = \"{git_url}\", features = [\"serde\"] }}\n"
    );
    let program = "use dynamics_core::glam::Vec3;\n\nfn main() {\n    \
                   let _ = dynamics_core::effects::GravityVector::<f32>(Vec3::X);\n}\n";
    let files = [("Cargo.toml", manifest.as_str()), ("src/main.rs", program)];
    for (name, text) in files {
        create_parent(&project.join(name))?;
        write(&project.join(name), text)?;
    }
    // The versions that the workspace's other steps have been tested with.
    let lock = read(&context.workspace.root.join("Cargo.lock"))?;
    write(&project.join("Cargo.lock"), lock)?;
    let cargo = |subcommand| {
        let mut command = context.workspace.cargo(subcommand);
        command.current_dir(&project);
        command
    };
    let config = shell::capture(&mut cargo("vendor"))?;
    let path = project.join(".cargo/config.toml");
    create_parent(&path)?;
    write(&path, config)?;
    let target = project.join("target");
    let mut check = cargo("check");
    shell::capture(
        check
            .args(["--offline", "--locked", "--target-dir"])
            .arg(target),
    )?;
    Ok(())
}

/// Commits the work tree as it is, without what git ignores, into a new repository, and returns its URL.
fn commit_work_tree(root: &Path, repository: &Path) -> Result<String> {
    shell::capture(
        Command::new("git")
            .args(["init", "--quiet"])
            .arg(repository),
    )?;
    let git = |arguments: &[&str]| {
        let mut command = Command::new("git");
        command.arg("--git-dir").arg(repository.join(".git"));
        command.arg("--work-tree").arg(root).current_dir(root);
        command.args(["-c", "user.name=test", "-c", "user.email=test@localhost"]);
        shell::capture(command.args(arguments)).map(drop)
    };
    git(&["add", "--all"])?;
    git(&[
        "commit",
        "--quiet",
        "--no-gpg-sign",
        "--no-verify",
        "--message",
        "work tree",
    ])?;
    let path = repository.to_string_lossy().replace('\\', "/");
    Ok(format!("file:///{}", path.trim_start_matches('/')))
}

pub fn features(context: &Context) -> Result<Outcome> {
    if context.tools.toolchain == Toolchain::Native {
        let mut cargo = context.workspace.cargo("check");
        cargo.args([
            "--package",
            LIBRARY,
            "--features",
            FEATURES,
            "--target",
            TARGET,
        ]);
        shell::capture(&mut cargo)?;
    }
    let plain = run_example(context, COMPARED, &[])?;
    let with_features = run_example(context, COMPARED, &["--features", FEATURES])?;
    if plain != with_features {
        return Err(Error::check(format!(
            "the features `{FEATURES}` change the numbers of the example `{COMPARED}`:\n{plain}\n{with_features}"
        )));
    }
    Ok(Outcome::Passed(FEATURES.to_owned()))
}

pub fn examples(context: &Context) -> Result<Outcome> {
    let names = example_names(&context.workspace.root)?;
    let mut cargo = context.workspace.cargo("build");
    shell::capture(cargo.args(["--package", LIBRARY, "--examples"]))?;
    for name in &names {
        run_example(context, name, &[])?;
    }
    Ok(Outcome::Passed(names.join(", ")))
}

fn run_example(context: &Context, name: &str, arguments: &[&str]) -> Result<String> {
    let mut cargo = context.workspace.cargo("run");
    cargo.args(["--quiet", "--package", LIBRARY, "--example", name]);
    shell::capture(cargo.args(arguments))
}

/// The names of the library's examples, which must be some.
fn example_names(root: &Path) -> Result<Vec<String>> {
    let folder = root.join(LIBRARY).join("examples");
    let entries = std::fs::read_dir(&folder).map_err(Error::file("read", &folder))?;
    let mut names: Vec<String> = entries
        .flatten()
        .filter_map(|entry| Some(entry.file_name().to_str()?.strip_suffix(".rs")?.to_owned()))
        .collect();
    names.sort();
    if names.is_empty() {
        return Err(Error::check(format!("{} is empty", folder.display())));
    }
    Ok(names)
}

pub fn deny(context: &Context) -> Result<Outcome> {
    const INSTALL: &str = "cargo install cargo-deny --locked";
    if shell::which("cargo-deny").is_none() {
        if !context.may_install_debian {
            return Ok(Outcome::Skipped(format!("to have it run: {INSTALL}")));
        }
        let mut cargo = context.workspace.cargo("install");
        shell::capture(cargo.args(["cargo-deny", "--locked"]))?;
    }
    let mut cargo = context.workspace.cargo("deny");
    shell::capture(cargo.args(["check", "bans", "licenses", "sources"]))?;
    Outcome::PASSED
}

/// A folder outside the workspace, whose configuration would otherwise apply; removed when dropped.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Result<Self> {
        let folder = std::env::temp_dir().join(format!("{LIBRARY}-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&folder).map_err(Error::file("create", &folder))?;
        Ok(Self(folder))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // It is in the system's place for what may be removed at any time.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn create_parent(path: &Path) -> Result<()> {
    let parent = path.parent().unwrap_or(path);
    std::fs::create_dir_all(parent).map_err(Error::file("create", parent))
}

#[cfg(test)]
mod tests {
    use super::{COPIES, Folder, LIBRARY, copies_are_equal, create_parent};
    use crate::workspace::write;

    #[test]
    fn a_licence_that_differs_from_its_copy_is_refused() {
        let folder = Folder::new("copies").expect("a folder");
        let library = folder.0.join(LIBRARY);
        for name in COPIES {
            create_parent(&library.join(name)).expect("a folder");
            write(&folder.0.join(name), "a licence").expect("written");
            write(&library.join(name), "a licence").expect("written");
        }
        copies_are_equal(&folder.0, &library).expect("equal");
        write(&library.join(COPIES[0]), "another licence").expect("written");
        let error = copies_are_equal(&folder.0, &library).expect_err("not equal");
        assert!(error.to_string().contains(COPIES[0]), "{error}");
    }
}
