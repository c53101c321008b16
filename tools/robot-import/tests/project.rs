//! Projects as a newcomer gets them: built, tested and run in QEMU, their torques compared with
//! those of this process.
//!
//! Slow: `cargo test -p robot-import --test import -- --ignored --nocapture project::` builds both
//! projects of two robots, and one for each board. They need the targets thumbv7em-none-eabihf and
//! thumbv8m.main-none-eabihf, qemu-system-arm, make and arm-none-eabi-gcc.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;
use std::{env, fs};

use dynamics_core::Engine;
use dynamics_core::effects::{Coriolis, Effect, Gravity, Inertia};
use dynamics_core::model::Robot;
use dynamics_core::state::State;
use robot_import::project::{BOARDS, Board, Feedback, Kind, Library, Project, RobotFile, create};

#[allow(dead_code, reason = "a robot's file has more than the test compares")]
mod chain;
// Formatted as users' files are.
#[rustfmt::skip]
#[allow(dead_code, reason = "a robot's file has more than the test compares")]
mod openarm;
// Formatted as users' files are.
#[rustfmt::skip]
#[path = "../template/rust/src/robot.rs"]
#[allow(dead_code, reason = "a robot's file has more than the test compares")]
mod pendulum;
// Formatted as users' files are.
#[rustfmt::skip]
#[path = "../../../dynamics-core/src/robots/imported/so101.rs"]
mod so101;

/// The torques of the projects' probe, as bits.
fn expected<T: Robot<N, N, N>, E: Effect<f32, N, N>, const N: usize>(effects: &E) -> String {
    let of = |first: f32, step: f32| core::array::from_fn(|joint| first + step * joint as f32);
    let state = State { q: of(0.1, 0.07), qd: of(0.3, -0.05), qdd: of(-0.2, 0.11) };
    let torque: [f32; N] = Engine::<T>::rnea(&state, effects);
    let bits = torque.map(|torque| format!(" {:08x}", torque.to_bits()));
    format!("  bits:{}", bits.concat())
}

fn robot(type_name: &str, text: &str, [joints, bodies]: [&[&str]; 2]) -> RobotFile {
    let n = joints.len();
    RobotFile {
        type_name: type_name.into(),
        text: text.into(),
        again: "FILE".into(),
        joints: joints.iter().map(|&joint| joint.into()).collect(),
        bodies: bodies.iter().map(|&body| body.into()).collect(),
        b: n,
        q: n,
        v: n,
        coupled: false,
        feedback: Feedback::default(),
    }
}

/// A project in a folder outside the workspace, so that nothing of its configuration acts; it is
/// built in the workspace's `target`, so that a second run is faster.
struct Trial {
    folder: PathBuf,
    built: PathBuf,
}

impl Trial {
    fn new(name: &str, robot: RobotFile, kind: Kind) -> Self {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../dynamics-core");
        Self::with(name, robot, kind, Library::Path(folder))
    }

    fn with(name: &str, robot: RobotFile, kind: Kind, library: Library) -> Self {
        let folder = env::temp_dir().join(format!("{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        let project = Project { name: name.into(), robot, library, kind };
        let created = create(&folder, &project).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(created.robot_only, None);
        let built = Path::new(env!("CARGO_TARGET_TMPDIR")).join("projects");
        Self { folder, built }
    }

    /// A command in the project.
    fn command(&self, command: &str, arguments: &[&str]) -> Command {
        let mut command = Command::new(command);
        command
            .args(arguments)
            .current_dir(&self.folder)
            .env("CARGO_TARGET_DIR", &self.built)
            // Nobody debugs them.
            .env("CARGO_PROFILE_DEV_DEBUG", "false")
            .env_remove("RUSTFLAGS")
            .env_remove("CARGO_ENCODED_RUSTFLAGS");
        command
    }

    /// The output of a command, which has to succeed.
    fn run(&self, command: &str, arguments: &[&str]) -> String {
        let start = Instant::now();
        let output = self.command(command, arguments).output();
        let output = output.unwrap_or_else(|error| panic!("{command}: {error}"));
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{command} {arguments:?}\n{text}\n{errors}");
        assert!(!errors.contains("warning"), "{command} {arguments:?}\n{errors}");
        eprintln!("{:6.1} s  {command} {}", start.elapsed().as_secs_f32(), arguments.join(" "));
        text
    }

    /// Builds the firmware for a board, formatted as it is, without a warning, from the versions
    /// that it came with.
    fn firmware(&self, name: &str, board: &Board) {
        let lock =
            |folder: &Path| fs::read_to_string(folder.join("Cargo.lock")).expect("a lock file");
        let before = lock(&self.folder);
        // The time of all processes together, so that another load on this computer does not count.
        let times = self.run("sh", &["-c", "cargo build --release && times"]);
        let of_children = times.lines().nth(1).expect("a second line").split(' ');
        let in_seconds = |time: &str| -> Option<f32> {
            let (minutes, seconds) = time.strip_suffix('s')?.split_once('m')?;
            Some(60.0 * minutes.parse::<f32>().ok()? + seconds.parse::<f32>().ok()?)
        };
        let seconds: f32 = of_children.map(|time| in_seconds(time).expect("a time")).sum();
        eprintln!("{seconds:.0} s of processor time for {name}");
        assert!(seconds <= 180.0, "{name} takes {seconds} s");
        self.run("cargo", &["fmt", "--check"]);
        let built = self.built.join(board.target).join("release").join(name);
        let [image, elf] =
            [built.with_extension("bin"), built].map(|path| path.display().to_string());
        self.run("arm-none-eabi-objcopy", &["-O", "binary", &elf, &image]);
        let bytes = fs::metadata(&image).map_or(0, |file| file.len());
        eprintln!("{bytes} B of flash for {name}");
        assert!((10_000..128 * 1024).contains(&bytes), "{name} takes {bytes} B");
        // No board but this one has the code of drives on CAN.
        let symbols = self.run("arm-none-eabi-nm", &["--demangle", &elf]);
        for of_can in ["joint_drivers::can::joints", "joint_drivers::can::mit", "::can::CHIP"] {
            let has_it = symbols.contains(of_can);
            assert_eq!(has_it, board.name == "nucleo-g474re-can", "{of_can} in {name}");
        }
        // Cargo has removed what the project does not use, and added nothing but the project.
        let known: Vec<&str> = before.split("\n[[package]]\n").collect();
        let after = lock(&self.folder);
        let registry =
            after.split("\n[[package]]\n").skip(1).filter(|one| one.contains("source ="));
        for package in registry {
            let version: String = package.lines().take(2).collect();
            let is_it = |one: &&str| one.lines().take(2).collect::<String>() == version;
            assert!(known.iter().any(is_it), "{package}");
        }
    }

    /// Runs the part of a board's project that is not the board's, on devices of this computer.
    fn on_host(&self) {
        let manifest = fs::read_to_string(self.folder.join("Cargo.toml")).expect("a manifest");
        let (_, dependencies) = manifest.split_once("[dependencies]\n").expect("dependencies");
        let needed = ["dynamics-core", "embedded-hal =", "joint-drivers", "motion-control"];
        let is_needed = |line: &&str| needed.iter().any(|name| line.starts_with(name));
        let lines: Vec<&str> = dependencies.lines().filter(is_needed).collect();
        let host = self.folder.join("on-host");
        fs::create_dir_all(host.join("src")).expect("a folder");
        let put = |path: &str, text: &str| fs::write(host.join(path), text).expect("written");
        let package =
            "[package]\nname = \"on-host\"\nedition = \"2024\"\n[workspace]\n[dependencies]\n";
        put("Cargo.toml", &format!("{package}{}\n", lines.join("\n")));
        put("src/main.rs", include_str!("project/host.rs"));
        for file in ["lib.rs", "board.rs", "control.rs", "robot.rs", "say.rs", "scene.rs"] {
            let text = fs::read_to_string(self.folder.join("src").join(file)).expect("a source");
            put(&format!("src/{file}"), &text);
        }
        fs::copy(self.folder.join("Cargo.lock"), host.join("Cargo.lock")).expect("a lock file");
        // The configuration of the project has another target.
        let line = "run --quiet --manifest-path on-host/Cargo.toml --target host-tuple";
        let said = self.run("cargo", &line.split(' ').collect::<Vec<_>>());
        assert_eq!(said, "good\n");
    }

    /// The line after the one that begins with `head`.
    fn after<'a>(text: &'a str, head: &str) -> &'a str {
        let mut lines = text.lines().skip_while(|line| !line.starts_with(head));
        lines.nth(1).unwrap_or_else(|| panic!("no {head:?} in\n{text}"))
    }
}

impl Drop for Trial {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.folder);
    }
}

const PROBE: &str = "inverse dynamics of the probe";
const FIRST: &str = "torques of the first tick";
/// Runs the project by its dev profile in QEMU.
const DEV: [&str; 3] = ["run", "--target", "thumbv7em-none-eabihf"];

/// The share of its period that the longest tick takes, %.
fn share_of_period(printed: &str) -> f32 {
    let tick = printed.lines().find(|line| line.starts_with("tick: "));
    let tick = tick.unwrap_or_else(|| panic!("no tick in\n{printed}"));
    eprintln!("{tick}");
    let (_, share) = tick.split_once("the longest takes ").expect("a share");
    let (share, _) = share.split_once(" % of its period").expect("a share");
    share.parse().expect("a number")
}

fn rust_project(name: &str, robot: RobotFile, expected: &str) -> Trial {
    let trial = Trial::new(name, robot, Kind::Simulation);
    let device = trial.run("cargo", &["qemu"]);
    assert_eq!(Trial::after(&device, PROBE), expected);
    assert!(!device.contains("error:"), "{device}");
    assert!(share_of_period(&device) < 100.0, "{device}");
    // The tracking error, too, is the same on the host, but for the line of the clock.
    let host = trial.run("cargo", &["run"]);
    assert_eq!(Trial::after(&host, FIRST), Trial::after(&device, FIRST));
    let without_clock =
        |text: &str| text.lines().filter(|line| !line.starts_with("tick: ")).collect::<String>();
    assert_eq!(without_clock(&host), without_clock(&device));
    // Without `--release` the dev profile, as it is written, computes the same in time.
    let dev = trial.run("cargo", &DEV);
    assert_eq!(without_clock(&dev), without_clock(&device));
    assert!(share_of_period(&dev) < 100.0, "{dev}");
    // The program that sends the ticks, with the motion that shows the parameters.
    let watch = "run --release --features telemetry --bin watch -- excite ticks=2000";
    let frames = trial.run("cargo", &watch.split(' ').collect::<Vec<_>>());
    assert!(frames.len() > 50_000, "{} bytes", frames.len());
    trial.run("cargo", &["test"]);
    trial.run("cargo", &["fmt", "--check"]);
    trial
}

/// The example of a library, in QEMU and on this computer.
fn c_example(trial: &Trial, expected: &str) {
    let out = format!("OUT={}", trial.built.display());
    let device = trial.run("make", &[&out, "run"]);
    assert_eq!(Trial::after(&device, "inverse dynamics of the probe:"), expected);
    assert_eq!(device.lines().last(), Some("good"), "{device}");
    let costs: Vec<_> = device.lines().filter(|line| line.contains(": status 0, ")).collect();
    assert_eq!(costs.len(), 17, "{device}");
    eprintln!("{}", costs.join("\n"));
    let check = trial.run("make", &[&out, "check"]);
    assert_eq!(check.lines().last(), Some("no panic"));
    let sizes = trial.run("make", &[&out, "sizes"]);
    let advice = sizes.lines().find(|line| line.ends_with("_config_advice")).expect("a size");
    let bytes: u32 = advice.split(' ').next().and_then(|of| of.parse().ok()).expect("a number");
    assert!(bytes < 21_000, "the header says some 20 kB\n{sizes}");
    let host = trial.run("make", &[&out, "host"]);
    assert_eq!(host.lines().last(), Some("good"), "{host}");
    trial.run("cargo", &["fmt", "--check"]);
}

#[test]
#[ignore = "builds firmware"]
fn a_pendulum() {
    let text = include_str!("../template/rust/src/robot.rs");
    let robot = robot("Pendulum", text, [&pendulum::JOINTS, &pendulum::BODIES]);
    let scene = (Gravity::EARTH, Inertia, Coriolis, pendulum::VISCOUS);
    let expected = expected::<pendulum::Pendulum, _, 1>(&scene);
    rust_project("a-pendulum", robot, &expected);
}

#[test]
#[ignore = "builds firmware"]
fn an_arm() {
    let text = include_str!("../../../dynamics-core/src/robots/imported/so101.rs");
    let robot = robot("So101", text, [&so101::JOINTS, &so101::BODIES]);
    let expected = expected::<so101::So101, _, 6>(&so101::SCENE);
    let trial = rust_project("an-arm", robot, &expected);
    // At opt-level 0 the build warns and the run fails: no tick of six joints ends within its
    // period, which a hundred of them show.
    let report = trial.folder.join("src/report.rs");
    let whole = fs::read_to_string(&report).expect("a source");
    let fewer = whole.replace("for tick in 0..outcome.ticks {", "for tick in 0..100 {");
    assert_ne!(fewer, whole, "no loop over ticks");
    fs::write(&report, fewer).expect("written");
    let mut slow = trial.command("cargo", &DEV);
    let slow = slow.env("CARGO_PROFILE_DEV_OPT_LEVEL", "0").output();
    let slow = slow.expect("cargo runs");
    let [printed, errors] = [&slow.stdout, &slow.stderr].map(|text| String::from_utf8_lossy(text));
    assert!(!slow.status.success(), "{printed}");
    assert!(share_of_period(&printed) > 100.0, "{printed}");
    assert!(printed.contains("error: the longest tick takes"), "{printed}");
    assert!(errors.contains("at opt-level 0 of this package"), "{errors}");
}

/// Firmware for each board, an OpenArm where there are seven drives; the first stands alone, and a
/// robot with fewer joints than it runs on this computer as well.
#[test]
#[ignore = "builds firmware"]
fn the_boards() {
    let so101 = || {
        robot(
            "So101",
            include_str!("../../../dynamics-core/src/robots/imported/so101.rs"),
            [&so101::JOINTS, &so101::BODIES],
        )
    };
    let open_arm = || {
        let text = include_str!("project/openarm.rs");
        robot("OpenArm", text, [&openarm::JOINTS, &openarm::JOINTS])
    };
    let [first, others @ ..] = &BOARDS;
    let trial = Trial::with("on-first", so101(), Kind::Board(first), Library::Copy);
    trial.firmware("on-first", first);
    for board in others {
        let name = format!("on-{}", board.name);
        let has_seven = board.most_joints == 7;
        let robot = if has_seven { open_arm() } else { so101() };
        let mut trial = Trial::new(&name, robot, Kind::Board(board));
        if has_seven {
            // As from a fresh clone.
            trial.built = trial.folder.join("target");
        }
        trial.firmware(&name, board);
    }
    let rod = robot(
        "Pendulum",
        include_str!("../template/rust/src/robot.rs"),
        [&pendulum::JOINTS, &pendulum::BODIES],
    );
    let trial = Trial::new("a-rod", rod, Kind::Board(first));
    trial.firmware("a-rod", first);
    trial.on_host();
}

/// The bench of a project for drives on CAN: thirty mistakes and their lines in the log.
#[test]
#[ignore = "builds a project"]
fn the_bench_of_drives_on_can() {
    let text = include_str!("project/openarm.rs");
    let robot = robot("OpenArm", text, [&openarm::JOINTS, &openarm::JOINTS]);
    let board = Board::find("nucleo-g474re-can", None).expect("a board");
    let trial = Trial::new("on-bench", robot, Kind::Board(board));
    let said = trial.run("sh", &["-c", "cd bench && cargo test"]);
    assert!(said.contains("test result: ok. 9 passed"), "{said}");
    trial.run("sh", &["-c", "cargo fmt --check && cd bench && cargo fmt --check"]);
}

/// A mistake in a call is named before the robot is read, and nothing else is.
#[test]
fn a_project_that_cannot_be_written_is_refused_at_once() {
    let folder = env::temp_dir().join(format!("refused-{}", std::process::id()));
    fs::create_dir_all(folder.join("used/file")).expect("a folder");
    for (words, said) in [
        ("used", "is not empty"),
        ("new --board uno", "no firmware for a board `uno`"),
        ("new --board esp32-c3", "docs/guide/src/porting.md"),
        ("new --board pico2 --rtic", "pico2 with Embassy"),
        ("New", "cannot be the name"),
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_robot-import"))
            .args(["new", "--robot", "there is no such file"])
            .args(words.split(' '))
            .current_dir(&folder)
            .output()
            .expect("it runs");
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(errors.starts_with("error: ") && errors.contains(said), "{errors}");
        assert!(output.stdout.is_empty() && errors.lines().count() == 1, "{errors}");
    }
    assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 1);
    fs::remove_dir_all(&folder).expect("removed");
}

/// By the command of the project's README, and by one without a name: the file is called otherwise
/// than the project.
#[test]
#[cfg(unix)]
fn a_robot_that_is_imported_again_keeps_its_type() {
    let scratch = env::temp_dir().join(format!("again-{}", std::process::id()));
    let _ = fs::remove_dir_all(&scratch);
    fs::create_dir_all(&scratch).expect("a folder");
    let zoo = include_str!("urdf/so101.urdf");
    fs::write(scratch.join("it's kestrel.urdf"), zoo).expect("a description");
    let shell = |folder: &Path, line: &str| {
        let line =
            line.replace("robot-import ", &format!("'{}' ", env!("CARGO_BIN_EXE_robot-import")));
        let mut shell = Command::new("sh");
        let output = shell.args(["-c", &line]).current_dir(folder).output();
        let output = output.expect("a shell");
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{line}\n{errors}");
    };
    for (kind, name) in [("", "my-arm"), ("--c", "arm-c"), ("--board pico2", "arm-b")] {
        let line = format!(
            "robot-import new {name} --robot \"it's kestrel.urdf\" --tip wrist_link --library . {kind}"
        );
        shell(&scratch, &line);
        let project = scratch.join(name);
        let robot = || fs::read_to_string(project.join("src/robot.rs")).expect("a robot");
        let (first, readme) = (robot(), fs::read_to_string(project.join("README.md")));
        let readme = readme.expect("a README");
        let again = readme.lines().find(|line| line.starts_with("robot-import import "));
        let again = again.unwrap_or_else(|| panic!("no command in\n{readme}"));
        assert!(again.contains(" --tip=wrist_link "), "{again}");
        shell(&project, &again.replace(" 'it", " ../'it"));
        assert_eq!(robot(), first);
        shell(
            &project,
            "robot-import import \"../it's kestrel.urdf\" --tip wrist_link --out src/robot.rs",
        );
        let type_of = |file: &str| robot_import::write::type_of(file).expect("a type");
        assert_eq!(type_of(&robot()), type_of(&first));
        // A name of the user's own is the type's.
        shell(
            &project,
            "robot-import import \"../it's kestrel.urdf\" --name other --out src/robot.rs",
        );
        assert_eq!(type_of(&robot()), "Other");
    }
    fs::remove_dir_all(&scratch).expect("removed");
}

#[test]
#[ignore = "builds firmware"]
fn thirty_joints() {
    let robot = robot("Chain", include_str!("project/chain.rs"), [&chain::JOINTS, &chain::JOINTS]);
    let friction = (chain::VISCOUS, chain::COULOMB, chain::ARMATURE);
    let scene = (Gravity::EARTH, Inertia, Coriolis, friction.0, friction.1, friction.2);
    let expected = expected::<chain::Chain, _, 30>(&scene);
    rust_project("thirty-joints", robot.clone(), &expected);
    c_example(&Trial::new("thirty-joints-for-c", robot, Kind::C), &expected);
}

/// Two libraries in one program, found by CMake: on this computer, and on the emulated processor.
#[test]
#[ignore = "builds firmware"]
fn two_robots_in_c() {
    let text = include_str!("../template/rust/src/robot.rs");
    let one = robot("Pendulum", text, [&pendulum::JOINTS, &pendulum::BODIES]);
    let text = include_str!("../../../dynamics-core/src/robots/imported/so101.rs");
    let other = robot("So101", text, [&so101::JOINTS, &so101::BODIES]);
    let (left, right) =
        (Trial::new("left-arm", one, Kind::C), Trial::new("right-arm", other, Kind::C));
    c_example(&right, &expected::<so101::So101, _, 6>(&so101::SCENE));
    let program = left.folder.join("program");
    fs::create_dir_all(&program).unwrap_or_else(|error| panic!("{error}"));
    for (name, text) in [
        ("CMakeLists.txt", include_str!("project/two_robots/CMakeLists.txt")),
        ("main.c", include_str!("project/two_robots/main.c")),
    ] {
        fs::write(program.join(name), text).unwrap_or_else(|error| panic!("{error}"));
    }
    let found = [&left, &right].map(|trial| trial.folder.display().to_string());
    let prefix = format!("-DCMAKE_PREFIX_PATH={}", found.join(";"));
    let cargo = format!("-DRUST_TARGET_DIR={}", left.built.display());
    let build = |folder: &str, options: &[&str]| {
        let configure = ["-S", "program", "-B", folder, &prefix, &cargo];
        left.run("cmake", &[&configure, options].concat());
        left.run("cmake", &["--build", folder]);
    };
    build("host", &[]);
    let host = left.run("host/two_robots", &[]);
    build(
        "device",
        &["-DCMAKE_TOOLCHAIN_FILE=../left-arm/example/arm.cmake"
            .replace("../left-arm", &left.folder.display().to_string())
            .as_str()],
    );
    let line = "-machine netduinoplus2 -nographic -semihosting-config enable=on,target=native -kernel \
                device/two_robots";
    let device = left.run("qemu-system-arm", &line.split_whitespace().collect::<Vec<_>>());
    for text in [&host, &device] {
        assert_eq!(text.lines().last(), Some("good"), "{text}");
    }
    // A function that the program does not call is not in it.
    let symbols = left.run("arm-none-eabi-nm", &["device/two_robots"]);
    assert!(symbols.contains("left_arm_gravity"), "{symbols}");
    for unused in ["thermal", "sensor", "wrench", "kinematics", "_goal", "_tip_", "_pose"] {
        assert!(!symbols.contains(unused), "{symbols}");
    }
    // The guide's code compiles with the header.
    let page = include_str!("../../../docs/guide/src/c.md");
    let blocks = page.split("```c\n").skip(1);
    let code: String = blocks.filter_map(|block| block.split("```").next()).collect();
    assert!(code.contains("my_arm_controller_command"));
    let code = code.replace("my_arm", "left_arm").replace("MY_ARM", "LEFT_ARM");
    let file = program.join("guide.c");
    fs::write(&file, code).unwrap_or_else(|error| panic!("{error}"));
    let line = "-std=c11 -Wall -Wextra -Werror -Iinclude -c program/guide.c -o guide.o";
    left.run("cc", &line.split(' ').collect::<Vec<_>>());
    // The example of each project is such a program, too.
    right.run(
        "cmake",
        &[
            "-B",
            "example/built",
            &cargo,
            "-DRUST_TARGET=thumbv7em-none-eabihf",
            "-DCMAKE_TOOLCHAIN_FILE=example/arm.cmake",
        ],
    );
    right.run("cmake", &["--build", "example/built"]);
}
