//! Many files as modules of one crate, which the compiler checks once.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::SystemTime;
use std::{env, fs, process};

use robot_import::project::{Project, files};

/// A folder that is removed with the value.
pub struct Folder(pub PathBuf);

impl Folder {
    pub fn new() -> Self {
        static NUMBER: AtomicUsize = AtomicUsize::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let name = format!("robot-import-names-{}-{number}", process::id());
        let folder = env::temp_dir().join(name);
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).expect("a folder for temporary files");
        Self(folder)
    }

    pub fn write(&self, path: &str, text: &str) -> PathBuf {
        let path = self.0.join(path);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(&path, text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// The libraries that this test was built with, and with it what is written can be compiled
/// against.
fn dependencies() -> PathBuf {
    let own = env::current_exe().expect("the test program");
    own.parent().expect("its folder").to_path_buf()
}

/// The libraries of a crate whose sources are in a folder of this name, the newest first.
fn libraries(name: &str, folder: &str) -> Vec<PathBuf> {
    let prefix = format!("lib{name}-");
    let libraries = fs::read_dir(dependencies()).expect("the test's folder");
    let of_folder = |path: &PathBuf| {
        let file = path.file_name()?.to_str()?.strip_prefix(&prefix)?;
        let hash = file.strip_suffix(".rlib")?;
        let made_of = fs::read_to_string(path.with_file_name(format!("{name}-{hash}.d"))).ok()?;
        let age = path.metadata().and_then(|file| file.modified()).ok()?;
        made_of.contains(folder).then_some(age)
    };
    let paths = libraries.flatten().map(|entry| entry.path());
    let mut found: Vec<(SystemTime, PathBuf)> =
        paths.filter_map(|path| Some((of_folder(&path)?, path))).collect();
    assert!(!found.is_empty(), "no library of {name} beside the test");
    found.sort();
    found.into_iter().rev().map(|(_, path)| path).collect()
}

/// The crates against which written files and projects are compiled: crates' names and their
/// libraries.
type Externs = [(&'static str, PathBuf); 4];

/// Compiles against libraries that were built with each other alone.
const PROBE: &str = "use ::joint_drivers::{Law, NoBrake};
pub fn limits(limits: ::dynamics_core::model::JointLimits<f32>) -> ::motion_control::limits::MotionLimits<f32> { limits.into() }
pub fn torque<L: Law<1>>(state: &::dynamics_core::state::State<f32, 1, 1>) -> [f32; 1] { L::feedforward(state, &()) }
pub fn gains<L: Law<1>>(gains: ::motion_control::law::Gains<f32, 1>, state: &::dynamics_core::state::State<f32, 1, 1>,
    estimate: &::motion_control::estimate::Estimate<f32, 1>) -> [f32; 1] { L::torque(&gains, state, estimate, &()) }
pub fn brake() -> impl ::embedded_hal::digital::OutputPin { NoBrake }
";

/// The newest libraries that were built with each other. The folder can have several of each crate,
/// for other features.
fn externs() -> &'static Externs {
    static EXTERNS: OnceLock<Externs> = OnceLock::new();
    EXTERNS.get_or_init(|| {
        let folder = Folder::new();
        let root = folder.write("probe.rs", PROBE);
        let out = format!("metadata={}", folder.0.join("probe").display());
        let fits = |set: &Externs| call("rustc", set, &root, &["--emit", &out]).status.success();
        let cores = libraries("dynamics_core", "dynamics-core");
        let controls = libraries("motion_control", "motion-control");
        let drivers = libraries("joint_drivers", "drivers");
        let hals = libraries("embedded_hal", "embedded-hal-1");
        let mut sets = hals.iter().flat_map(|hal| {
            let (cores, controls, drivers) = (&cores, &controls, &drivers);
            drivers.iter().flat_map(move |driver| {
                controls.iter().flat_map(move |control| {
                    cores.iter().map(move |core| {
                        [
                            ("dynamics_core", core.clone()),
                            ("motion_control", control.clone()),
                            ("joint_drivers", driver.clone()),
                            ("embedded_hal", hal.clone()),
                        ]
                    })
                })
            })
        });
        sets.find(fits).expect("libraries that were built with each other")
    })
}

/// A call of the compiler, or of rustdoc, on a crate's root.
pub fn rust(program: &str, root: &Path, arguments: &[&str]) -> Output {
    call(program, externs(), root, arguments)
}

fn call(program: &str, externs: &Externs, root: &Path, arguments: &[&str]) -> Output {
    let program = match program {
        "rustc" => env::var("RUSTC").unwrap_or_else(|_| program.to_owned()),
        _ => env::var("RUSTDOC").unwrap_or_else(|_| program.to_owned()),
    };
    let mut command = Command::new(&program);
    command.args(["--edition", "2024", "--crate-type", "lib", "-D", "warnings"]);
    let folder = dependencies();
    command.arg("-L").arg(format!("dependency={}", folder.display()));
    for (name, file) in externs {
        command.arg("--extern").arg(format!("{name}={}", file.display()));
    }
    let output = command
        // Cargo sets it for the crate that it compiles.
        .env("CARGO_CRATE_NAME", "arm")
        .args(arguments)
        .arg(root)
        .current_dir(root.parent().expect("a folder"));
    output.output().unwrap_or_else(|error| panic!("{program}: {error}"))
}

/// The message of a program that failed; none if it did not.
pub fn failure(output: &Output) -> Option<String> {
    (!output.status.success()).then(|| String::from_utf8_lossy(&output.stderr).into_owned())
}

/// Modules of one crate.
pub struct Batch {
    pub folder: Folder,
    root: String,
    count: usize,
}

impl Batch {
    pub fn new() -> Self {
        let reason = "they are a test's";
        Self {
            folder: Folder::new(),
            root: format!("//! Written files.\n#![allow(missing_docs, reason = \"{reason}\")]\n"),
            count: 0,
        }
    }

    /// Adds a robot's file; the line that names it is one of the root's.
    pub fn file(&mut self, text: &str) {
        let k = self.count;
        self.folder.write(&format!("m{k}.rs"), text);
        let _ = writeln!(self.root, "pub mod m{k};");
        self.count += 1;
    }

    /// Adds the library of a project: what is the crate there is the module here.
    pub fn project(&mut self, project: &Project) {
        let k = self.count;
        for (path, text) in files(project).expect("a legal name") {
            let path = match path.as_str() {
                "src/lib.rs" => format!("m{k}/mod.rs"),
                path if path.starts_with("src/") && path != "src/main.rs" => {
                    path.replacen("src", &format!("m{k}"), 1)
                }
                _ => continue,
            };
            let text = text.replace("crate::", &format!("crate::m{k}::"));
            self.folder.write(&path, &text);
        }
        let _ = writeln!(self.root, "pub mod m{k};");
        self.count += 1;
    }

    /// The crate's root.
    pub fn root(&self) -> PathBuf {
        self.folder.write("lib.rs", &self.root)
    }

    /// Fails with what the compiler says, warnings included.
    pub fn check(&self) -> Result<(), String> {
        let out = self.folder.0.join("checked");
        let out = format!("metadata={}", out.display());
        failure(&rust("rustc", &self.root(), &["--emit", &out])).map_or(Ok(()), Err)
    }

    /// The examples that rustdoc would run.
    pub fn doctests(&self) -> Vec<String> {
        let output = rust("rustdoc", &self.root(), &["--test", "--test-args=--list"]);
        let text = String::from_utf8_lossy(&output.stdout);
        assert!(text.contains("benchmarks"), "{:?} {text}", failure(&output));
        let tests = text.lines().filter_map(|line| line.strip_suffix(": test"));
        tests.map(str::to_owned).collect()
    }

    /// Fails with what rustdoc warns of, or with a module whose documentation has more than prose,
    /// lists and names.
    pub fn document(&self) -> Result<(), String> {
        let out = self.folder.0.join("html");
        let path = out.display().to_string();
        let arguments = ["--crate-name", "written", "-W", "rustdoc::all", "-o", &path];
        if let Some(said) = failure(&rust("rustdoc", &self.root(), &arguments)) {
            return Err(said);
        }
        for k in 0..self.count {
            let page = out.join(format!("written/m{k}/index.html"));
            let html = fs::read_to_string(&page).expect("a page of the module");
            let docs: Vec<&str> = html.split("<div class=\"docblock\">").skip(1).collect();
            assert!(!docs.is_empty(), "{html}");
            for doc in docs {
                let doc = doc.split("</details>").next().unwrap_or_default();
                // The headings of a file's head, with their links to themselves, and its list of
                // changes.
                let own = ["<a class=\"doc-anchor\"", "<h2 id=\"source\">", "<h2 id=\"changed\">"];
                let doc = own.iter().fold(doc.to_owned(), |doc, tag| doc.replacen(tag, "", 2));
                let found = [
                    "<pre",
                    "<a ",
                    "<img",
                    "<table",
                    "<blockquote",
                    "<script",
                    "<h",
                    "<ol",
                    "<em",
                    "<strong",
                    "<del",
                    "<li>\n<ul",
                ];
                if let Some(at) = found.iter().find_map(|tag| doc.find(tag)) {
                    let around: String = doc[at..].chars().take(200).collect();
                    return Err(format!("in m{k}: {around}"));
                }
            }
        }
        Ok(())
    }
}

/// Headers included in one file, by each compiler for C and C++ that there is; how many there were.
pub fn c_headers(headers: &[String]) -> Result<usize, String> {
    let folder = Folder::new();
    let mut text = String::new();
    for (k, header) in headers.iter().enumerate() {
        folder.write(&format!("h{k}.h"), header);
        let _ = writeln!(text, "#include \"h{k}.h\"");
    }
    let calls = [("cc", "-std=c11", "all.c"), ("c++", "-std=c++17", "all.cpp")];
    let mut compilers = 0;
    for (program, standard, name) in calls {
        let source = folder.write(name, &text);
        let mut command = Command::new(program);
        command.args([standard, "-fsyntax-only", "-pedantic", "-Wall", "-Wextra", "-Werror"]);
        match command.arg(&source).output() {
            Ok(output) => failure(&output).map_or(Ok(()), Err)?,
            Err(_) => {
                eprintln!("skipped: there is no `{program}`");
                continue;
            }
        }
        compilers += 1;
    }
    Ok(compilers)
}
