//! The parts of a file that an import leaves out are listed, and no file beside it runs.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use robot_import::import::{Args, import};

/// A robot of one joint, and a body with all that a name can be.
const PENDULUM: &str = "<robot name='r'><link name='a'/><link name='b'><inertial><origin xyz='0.1 0 0'/><mass value='1'/>\
    <inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link><joint name='swing' type='continuous'>\
    <parent link='a'/><child link='b'/><axis xyz='0 1 0'/><limit effort='9' velocity='9'/></joint></robot>";

/// Files, each with words of what the import says that it leaves out; none where it carries the
/// term.
const TERMS: [(&str, &[&str]); 20] = [
    ("actuator_armature", &[]),
    ("actuator_damping", &[]),
    ("ball_spring", &["`joint_0`: the spring"]),
    ("fluid", &["option density", "option viscosity"]),
    ("free_ref", &[]),
    ("gravcomp", &["body `body_1`: gravcomp"]),
    ("gravity_flag", &["flag gravity"]),
    ("gravity_off", &["option gravity"]),
    ("joint_damping", &[]),
    ("joint_stiffness", &[]),
    ("position_kv", &["position, that of joint `j`: their gains"]),
    ("ref", &[]),
    ("ref_slide", &[]),
    ("tendon_armature", &["fixed `t`: the tendon with its armature"]),
    ("tendon_damping", &["fixed `t`: the tendon with its damping"]),
    ("tendon_friction", &["fixed `t`: the tendon with its frictionloss"]),
    ("tendon_stiffness", &["fixed `t`: the tendon with its stiffness"]),
    (
        "arm_of_many_terms",
        &[
            "option gravity",
            "option wind",
            "flag gravity",
            "flag damper",
            "body `turret`: gravcomp",
            "body `boom`: gravcomp",
            "`hold` of joint `yaw`",
            "general, that of joint `pitch`",
            "<velocity>: it acts on no joint",
            "spatial `rope`: the tendon with its stiffness, damping, armature",
        ],
    ),
    (
        "free_body_that_is_turned",
        &["alignfree", "joint `fly`: the spring", "joint `joint_4`: align"],
    ),
    (
        "muscles_and_flags",
        &["muscle `m`", "damper, that of joint `s`", "intvelocity, that of joint `h`"],
    ),
];

#[test]
fn omitted_terms_are_listed_but_not_refused() {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/terms");
    assert_eq!(fs::read_dir(&cases).expect("a folder").count(), TERMS.len());
    for (name, left_out) in TERMS {
        let args = Args { file: cases.join(format!("{name}.xml")), ..Args::default() };
        let imported = import(&args, "today").unwrap_or_else(|error| panic!("{name}: {error}"));
        let text = imported.report.text();
        for words in left_out {
            assert!(text.contains(words), "{name}: {words}:\n{text}");
        }
    }
}

#[test]
fn no_file_of_the_current_folder_runs() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("r.urdf"), PENDULUM).expect("a robot");
    // rustup's rustfmt is the program of the toolchain that such a file names.
    let tools = folder.path().join("tools");
    fs::create_dir_all(tools.join("bin")).expect("a folder");
    let rustfmt = tools.join("bin/rustfmt");
    fs::write(
        &rustfmt,
        format!("#!/bin/sh\ntouch {}/pwned_rustfmt\ncat\n", folder.path().display()),
    )
    .expect("a program");
    #[cfg(unix)]
    fs::set_permissions(&rustfmt, std::os::unix::fs::PermissionsExt::from_mode(0o755))
        .expect("a program");
    let toolchain = format!("[toolchain]\npath = {tools:?}\n");
    fs::write(folder.path().join("rust-toolchain.toml"), toolchain).expect("a file");
    fs::write(folder.path().join("rustfmt.toml"), "max_width = 40").expect("a file");
    let done = Command::new(env!("CARGO_BIN_EXE_robot-import"))
        .args(["import", "r.urdf", "--out", "r.rs"])
        .current_dir(folder.path())
        .env_remove("RUSTUP_TOOLCHAIN")
        .output()
        .expect("the importer");
    assert!(done.status.success(), "{done:?}");
    let ran: Vec<PathBuf> = fs::read_dir(folder.path())
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.to_string_lossy().contains("pwned"))
        .collect();
    assert!(ran.is_empty(), "{ran:?}");
    let written = fs::read_to_string(folder.path().join("r.rs")).expect("a file");
    assert!(written.lines().any(|line| line.len() > 60), "{written}");
}
