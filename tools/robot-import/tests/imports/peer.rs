//! The comparison with a peer: isolated, bounded, and of like with like.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use robot_import::advice::Topic;
use robot_import::import::{Args, Imported, Options, import};
use robot_import::source::for_peer;

/// A robot of one joint, and a body with all that a name can be.
const PENDULUM: &str = "<robot name='r'><link name='a'/><link name='b'><inertial><origin xyz='0.1 0 0'/><mass value='1'/>\
    <inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link><joint name='swing' type='continuous'>\
    <parent link='a'/><child link='b'/><axis xyz='0 1 0'/><limit effort='9' velocity='9'/></joint></robot>";

fn args(file: PathBuf, python: &str) -> Args {
    Args {
        file,
        options: Options { python: python.to_owned(), ..Options::default() },
        ..Args::default()
    }
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder")
}

/// A robot beside a program of the shell that stands for a Python.
#[cfg(unix)]
fn fake(script: &str) -> (tempfile::TempDir, Args) {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = folder();
    let (robot, python) = (folder.path().join("r.urdf"), folder.path().join("python"));
    fs::write(&robot, PENDULUM).expect("a robot");
    fs::write(&python, format!("#!/bin/sh\n{script}\n")).expect("a program");
    fs::set_permissions(&python, fs::Permissions::from_mode(0o755)).expect("a program");
    let mut args = args(robot, &python.to_string_lossy());
    // Compiling may use the processors.
    args.options.peer_time = 20.0;
    (folder, args)
}

/// The advice on the peer.
fn advice(imported: &Imported) -> String {
    let all = imported.report.advice.iter();
    let texts: Vec<&str> = all
        .filter(|advice| advice.topic == Topic::Peer)
        .map(|advice| advice.text.as_str())
        .collect();
    texts.join("\n")
}

/// The modules that a comparison imports, and those that Python itself starts with.
const MODULES: [&str; 8] =
    ["json", "os", "numpy", "pinocchio", "mujoco", "site", "sitecustomize", "usercustomize"];

#[test]
fn no_file_of_the_current_folder_runs() {
    let folder = folder();
    fs::write(folder.path().join("r.urdf"), PENDULUM).expect("a robot");
    for module in MODULES {
        let text = format!(
            "open(__file__ + '.pwned', 'w').write('x')\nopen('pwned_{module}', 'w').write('x')\n"
        );
        fs::write(folder.path().join(format!("{module}.py")), text).expect("a module");
    }
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
    for options in [&[][..], &["--python-environment"]] {
        let done = Command::new(env!("CARGO_BIN_EXE_robot-import"))
            .args(["import", "r.urdf", "--out", "r.rs"])
            .args(options)
            .current_dir(folder.path())
            .env_remove("PYTHONPATH")
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
}

#[cfg(unix)]
#[test]
fn the_description_is_data_and_the_folder_is_empty() {
    let (folder, args) = fake(
        "cat > \"$0.stdin\"; printf '%s\\n' \"$@\" > \"$0.args\"; ls -A > \"$0.ls\"; pwd > \"$0.pwd\"",
    );
    import(&args, "today").expect("without a peer");
    let written = |what: &str| fs::read_to_string(folder.path().join(what)).expect("a file");
    assert!(written("python.stdin").contains("<robot name='r'>"));
    let arguments = written("python.args");
    assert!(arguments.starts_with("-I\n-c\n"), "{arguments}");
    assert!(!arguments.contains("<robot") && !arguments.contains("r.urdf"), "{arguments}");
    assert_eq!(written("python.ls"), "");
    let own = written("python.pwd");
    assert!(!Path::new(own.trim()).exists(), "{own} is left behind");
}

#[cfg(unix)]
#[test]
fn a_peer_that_sleeps_is_ended_with_what_it_started() {
    let (folder, mut args) = fake("sleep 100 & echo $! > \"$0.pid\"; wait");
    // Long enough for a shell to start beside compilers.
    args.options.peer_time = 1.0;
    let start = Instant::now();
    let imported = import(&args, "today").expect("without a peer");
    assert!(start.elapsed() < Duration::from_secs(10), "{:?}", start.elapsed());
    let text = advice(&imported);
    assert!(text.contains("had not answered after 1 s and was ended"), "{text}");
    let pid = fs::read_to_string(folder.path().join("python.pid")).expect("a process");
    let status = fs::read_to_string(format!("/proc/{}/status", pid.trim())).unwrap_or_default();
    assert!(!status.contains("State:\tS"), "it still sleeps: {status}");
    (args.options.check, args.options.peer_time) = (true, 0.05);
    let error = import(&args, "today").expect_err("no peer").to_string();
    assert!(error.starts_with("no peer to compare with: "), "{error}");
}

#[cfg(unix)]
#[test]
fn a_peer_that_floods_or_answers_nonsense_is_advice() {
    let cases = [
        ("yes", "it wrote more than 8 MB and was ended"),
        ("yes >&2 & exec cat > /dev/null", "its answer is none"),
        ("exit 0", "its answer is none"),
        ("echo '{\"name\": \"x\", \"torques\": [[1.0]]}'", "another number of states"),
        ("printf 'a\\n\\033[2Jcleared\\n' >&2; exit 1", ": [2Jcleared"),
        ("kill -9 $$", "no message"),
    ];
    for (script, words) in cases {
        let (_folder, args) = fake(script);
        let imported = import(&args, "today").unwrap_or_else(|error| panic!("{script}: {error}"));
        let text = advice(&imported);
        assert!(text.contains(words) && !text.contains('\u{1b}'), "{script}: {text}");
        assert!(imported.report.text().contains("no peer"));
    }
}

#[cfg(unix)]
#[test]
fn a_disagreement_without_a_reason_is_refused_at_its_joint() {
    let torques = vec!["[1e3]"; 100].join(",");
    let (_folder, mut args) =
        fake(&format!("cat > /dev/null; echo '{{\"name\": \"X 1\", \"torques\": [{torques}]}}'"));
    let error = import(&args, "today").expect_err("other torques").to_string();
    assert!(error.contains("differs from X 1 by") && error.contains("joint `swing`"), "{error}");
    args.options.python = "none".to_owned();
    import(&args, "today").expect("compared with nothing");
    args.options.python = "no-such-python".to_owned();
    let imported = import(&args, "today").expect("without a peer");
    assert_eq!(advice(&imported), "", "nobody expects a peer");
}

/// The words of urdfdom where a number has a line end, which XML allows.
#[cfg(unix)]
const DROPPED: &str = "printf 'Error:   Inertial: inertia element ixz is not a valid double\\n         at line 415 in link.cpp\\n\
    Error:   Could not parse inertial element for Link [b]\\n' >&2";

#[cfg(unix)]
#[test]
fn a_peer_that_disagrees_is_quoted() {
    let torques = vec!["[1e3]"; 100].join(",");
    let (_folder, args) = fake(&format!(
        "cat > /dev/null; {DROPPED}; echo '{{\"name\": \"X 1\", \"torques\": [{torques}]}}'"
    ));
    let error = import(&args, "today").expect_err("other torques").to_string();
    assert!(
        error.contains(
            "of which X 1 says: \"Error:   Inertial: inertia element ixz is not a valid double; Error:   Could not parse inertial \
             element for Link [b]\""
        ),
        "{error}"
    );
}

/// The peer has no torque where a number has a blank before it, and says so; else it has the
/// import's, which it is given.
#[cfg(unix)]
#[test]
fn a_peer_that_drops_a_number_with_blanks_is_advice() {
    let (folder, mut args) = fake("exit 1");
    args.options.python = "none".to_owned();
    let right = import(&args, "today").expect("compared with nothing");
    let torques = |of: &dyn Fn(f64) -> f64| {
        let samples = right.report.check.samples.iter();
        let rows: Vec<String> =
            samples.map(|(_, torque)| format!("[{:e}]", of(torque[0]))).collect();
        format!("{{\"name\": \"X 1\", \"torques\": [{}]}}", rows.join(","))
    };
    fs::write(folder.path().join("right"), torques(&|x| x)).expect("an answer");
    fs::write(folder.path().join("wrong"), torques(&|_| 0.0)).expect("an answer");
    let at = folder.path().display();
    let script = format!(
        "#!/bin/sh\nif grep -q \"ixz='0.\"; then {DROPPED}; cat {at}/wrong; else cat {at}/right; fi\n"
    );
    fs::write(folder.path().join("python"), script).expect("a program");
    args.options.python = folder.path().join("python").display().to_string();
    for blank in [" ", "\\n"] {
        let blank = blank.replace("\\n", "\n");
        let text = PENDULUM.replace("ixz='0'", &format!("ixz='0{blank}'"));
        fs::write(&args.file, text).expect("a robot");
        let imported = import(&args, "today").unwrap_or_else(|error| panic!("{error}"));
        assert!(imported.report.peer.as_ref().is_some_and(|peer| peer.difference < 1e-12));
        let words = advice(&imported);
        assert!(
            words.contains("X 1 misreads the file and says: \"Error:   Inertial: inertia element ixz is not a valid double"),
            "{words}"
        );
    }
}

#[test]
fn a_peer_is_given_no_name_of_a_file() {
    let path = cases().join("arm_of_many_terms.xml");
    let text = for_peer(&path, None).expect("a model");
    for words in ["file", "meshdir", "texturedir", "passwd", "/etc", "..", "paint"] {
        assert!(!text.contains(words), "{words}: {text}");
    }
    // The numbers are the file's own.
    for words in ["ref=\"0.4\"", "fullinertia=\"0.01 0.03 0.03 0.001 0 0.002\"", "axis=\"0 0.3 1\""]
    {
        assert!(text.contains(words), "{words}: {text}");
    }
    let outside = path.with_file_name("outside.xml");
    let error = robot_import::source::parse(
        "<mujoco><include file='../../Cargo.toml'/></mujoco>",
        outside.parent().expect("a folder"),
    );
    assert!(error.expect_err("outside").to_string().contains("not below the folder"));
}

fn cases() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/peer")
}

/// A Python with MuJoCo: `PEER_PYTHON`, or `python3`.
fn with_mujoco() -> Option<String> {
    static FOUND: OnceLock<Option<String>> = OnceLock::new();
    FOUND.get_or_init(mujoco).clone()
}

fn mujoco() -> Option<String> {
    let python = std::env::var("PEER_PYTHON").unwrap_or("python3".to_owned());
    let mut command = Command::new(&python);
    let tried = command.args(["-I", "-c", "import mujoco"]).output();
    tried.is_ok_and(|done| done.status.success()).then_some(python)
}

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
    let python = with_mujoco();
    let files = fs::read_dir(cases()).expect("a folder").count();
    assert_eq!(files, TERMS.len());
    for (name, left_out) in TERMS {
        let mut args = args(cases().join(format!("{name}.xml")), "none");
        if let Some(python) = &python {
            args.options.python.clone_from(python);
            args.options.check = true;
        }
        let imported = import(&args, "today").unwrap_or_else(|error| panic!("{name}: {error}"));
        let text = imported.report.text();
        for words in left_out {
            assert!(text.contains(words), "{name}: {words}:\n{text}");
        }
        if let Some(peer) = imported.report.peer {
            assert!(peer.difference < 1e-13, "{name}: {peer:?}");
        }
    }
}

/// Locked joints are where the import has them: at zero, not at the position in the file.
#[test]
fn joints_with_a_reference_lock_as_the_peer_does() {
    let Some(python) = with_mujoco() else {
        return;
    };
    for (file, lock) in [
        ("ref_slide", "k=0.3"),
        ("arm_of_many_terms", "pitch=0"),
        ("free_body_that_is_turned", "fly=0"),
        ("arm_of_many_terms", "wrist=0"),
    ] {
        let mut args = args(cases().join(format!("{file}.xml")), "none");
        let (joint, position) = lock.split_once('=').expect("a position");
        args.options.lock = vec![(joint.to_owned(), position.parse().expect("a number"))];
        args.options.python.clone_from(&python);
        args.options.check = true;
        import(&args, "today").unwrap_or_else(|error| panic!("{file}, {lock}: {error}"));
    }
}
