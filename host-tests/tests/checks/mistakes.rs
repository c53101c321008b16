//! Mistakes of a user that the compiler refuses with a message, at the user's line.
//!
//! The files in `mistakes/` are compiled as a user's crate would be, with the library of this test.
//! A comment `//~ words` says that the compiler's error has these words and names this line.
//! Without code generation rustc finds what `cargo check`, and so rust-analyzer, finds.

use std::path::{Path, PathBuf};
use std::process::Command;

use dynamics_core::effects::{LoadFriction, Payload, Width};
use dynamics_core::model::BodyInertia;

/// The compiler's messages on a file of `mistakes/`, empty if it accepts it.
fn compiled(name: &str, emit: &str) -> String {
    let program = std::env::current_exe().expect("this program has a path");
    let built = program.parent().expect("in a folder");
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("mistakes");
    std::fs::create_dir_all(&out).expect("the folder for what is compiled");
    let output = Command::new(std::env::var("RUSTC").unwrap_or("rustc".into()))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["--edition=2024", "--crate-type=lib", "--color=never", "--cap-lints=allow"])
        .arg(format!("--emit={emit}"))
        .arg("--extern")
        .arg(format!("dynamics_core={}", library(built).display()))
        .arg("-L")
        .arg(format!("dependency={}", built.display()))
        .arg("--out-dir")
        .arg(out)
        .arg(source(name))
        .output()
        .expect("rustc runs");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.success(), said.is_empty(), "{said}");
    said
}

/// The library that cargo built last, to which this program is linked.
fn library(built: &Path) -> PathBuf {
    let files = std::fs::read_dir(built).expect("the folder of this program");
    let libraries = files.filter_map(|file| {
        let path = file.ok()?.path();
        let name = path.file_name()?.to_str()?;
        let is_library = name.starts_with("libdynamics_core-") && name.ends_with(".rlib");
        is_library.then_some((path.metadata().ok()?.modified().ok()?, path))
    });
    libraries.max().expect("the library is built").1
}

fn source(name: &str) -> String {
    format!("tests/checks/mistakes/{name}.rs")
}

/// Whether every marked line has its error, and no error has other words.
fn demand(name: &str, text: &str, said: &str) -> Result<(), String> {
    let marked: Vec<(usize, &str)> = (1..)
        .zip(text.lines())
        .filter_map(|(line, text)| Some((line, text.split_once("//~ ")?.1)))
        .collect();
    // An error, with its notes, lasts to the next one.
    let mut errors: Vec<String> = Vec::new();
    for line in said.lines() {
        if line.starts_with("error") {
            errors.push(String::new());
        }
        if let Some(error) = errors.last_mut() {
            *error += line;
            error.push('\n');
        }
    }
    errors.retain(|error| {
        !error.starts_with("error: could not") && !error.starts_with("error: aborting")
    });
    let is = |error: &str, (line, words): (usize, &str)| {
        error.contains(words) && error.contains(&format!("--> {}:{line}:", source(name)))
    };
    for &mark in &marked {
        if !errors.iter().any(|error| is(error, mark)) {
            return Err(format!("no error {mark:?} in\n{said}"));
        }
    }
    for error in &errors {
        // The algorithms inside an algorithm may say the same again.
        if !marked.iter().any(|(_, words)| error.contains(words)) {
            return Err(format!("unexpected:\n{error}"));
        }
    }
    Ok(())
}

#[track_caller]
fn refused(name: &str, text: &str, emit: &str) {
    if let Err(why) = demand(name, text, &compiled(name, emit)) {
        panic!("{why}");
    }
}

#[test]
fn a_check_finds_wrong_sizes_scalars_and_traits() {
    refused("types", include_str!("mistakes/types.rs"), "metadata");
}

#[test]
fn a_check_finds_impossible_robots_and_scenes_in_constants() {
    refused("constants", include_str!("mistakes/constants.rs"), "metadata");
}

#[test]
fn a_build_finds_impossible_scenes_in_calls() {
    refused("calls", include_str!("mistakes/calls.rs"), "obj");
    // A check does not: hence the constants.
    assert_eq!(compiled("calls", "metadata"), "");
}

#[test]
fn legitimate_duplicate_effects_compile() {
    assert_eq!(compiled("right", "obj"), "");
}

#[test]
fn missing_and_unexpected_compile_errors_are_noticed() {
    let said = "error[E0080]: too heavy\n  --> tests/checks/mistakes/x.rs:2:5\n\nerror: aborting\n";
    assert_eq!(demand("x", "a\nb //~ too heavy", said), Ok(()));
    for text in ["a\nb", "a //~ too heavy\nb", "a\nb //~ too light", "a //~ c\nb //~ too heavy"] {
        assert!(demand("x", text, said).is_err(), "{text}");
    }
    assert!(demand("x", "a\nb //~ too heavy", "").is_err());
}

#[test]
fn constant_and_run_time_constructors_of_effects_give_equal_bits() {
    macro_rules! equal {
        ($r:ident, $of_efficiency:ident, $of_motor_and_load:ident) => {
            const LOAD: BodyInertia<$r> = BodyInertia {
                mass: 1.7,
                com: [0.013, -0.21, 0.33],
                inertia: [0.011, -0.0007, 0.0003, 0.017, 0.0011, 0.009],
            };
            const TOOL: Payload<$r, 5> = Payload::$r(LOAD);
            // As text, which tells −0 from 0.
            let text = |payload: Payload<$r, 5>| format!("{payload:?}");
            assert_eq!(text(TOOL), text(Payload::from_inertia(std::hint::black_box(LOAD))));

            const WIDTH: Width<$r> = Width::$r(0.013);
            assert_eq!(WIDTH, Width::new(std::hint::black_box(0.013)));
            const A: [$r; 2] = [0.83, 0.71];
            const B: [$r; 2] = [0.69, 0.57];
            let (a, b) = std::hint::black_box((A, B));
            const GEARS: LoadFriction<$r, 2> = LoadFriction::$of_efficiency(A, B, WIDTH);
            assert_eq!(GEARS, LoadFriction::of_efficiency(a, b, WIDTH));
            const MODELS: LoadFriction<$r, 2> = LoadFriction::$of_motor_and_load(A, B, WIDTH);
            assert_eq!(MODELS, LoadFriction::of_motor_and_load(a, b, WIDTH));
        };
    }
    {
        equal!(f32, of_efficiency_f32, of_motor_and_load_f32);
    }
    equal!(f64, of_efficiency_f64, of_motor_and_load_f64);
}
