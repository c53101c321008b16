//! The behaviour of xtask where it is interrupted, may not install, or cannot write.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::support::{Dir, EXIT, cargo, outcome, three_passages, xtask};

/// The text on stderr and the exit code if its output goes there.
fn printing(arguments: &[&str], to: Stdio) -> (String, Option<i32>) {
    let mut command = xtask(arguments);
    let child = command.stdout(to).stderr(Stdio::piped()).spawn();
    let out = child.expect("started").wait_with_output().expect("ended");
    let said = String::from_utf8_lossy(&out.stderr).into_owned();
    (said, out.status.code())
}

#[test]
fn a_closed_pipe_or_full_disk_is_no_panic() {
    for arguments in [["test", "--list"].as_slice(), &["--help"]] {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let (said, code) = printing(arguments, writer.into());
        assert!(said.is_empty() && code != Some(0), "{arguments:?}: {said}");
        let Ok(full) = File::options().write(true).open("/dev/full") else {
            continue;
        };
        let (said, code) = printing(arguments, full.into());
        assert!(said.contains("No space left"), "{said}");
        assert!(!said.contains("panicked"), "{said}");
        assert_eq!(code, Some(1), "{arguments:?}");
    }
}

/// A user who is not root, may use sudo, and has neither QEMU nor anything else.
fn poor_user(dir: &Dir, with_sudo: bool) -> Command {
    dir.program("id", "echo 1000");
    dir.program("apt-get", "true");
    if with_sudo {
        let ran = dir.join("sudo-ran");
        dir.program("sudo", &format!("echo \"$@\" >> {}", ran.display()));
    }
    let mut command = xtask(&["demo"]);
    command.env("PATH", dir.join("")).env("RUSTC", rustc());
    command
}

/// The compiler itself: rustup's stand-in for it needs a PATH.
fn rustc() -> PathBuf {
    let sysroot = Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()))
        .args(["--print", "sysroot"])
        .output()
        .expect("a compiler");
    let sysroot = String::from_utf8_lossy(&sysroot.stdout).trim().to_owned();
    Path::new(&sysroot).join("bin/rustc")
}

fn on_debian() -> bool {
    std::fs::read_to_string("/etc/os-release").is_ok_and(|text| text.contains("debian"))
}

#[test]
fn yes_and_ci_let_it_run_sudo() {
    if !on_debian() {
        return;
    }
    for (argument, ci) in [("--yes", "false"), ("--scene=ur5e", "true")] {
        let dir = Dir::new();
        let mut command = poor_user(&dir, true);
        command.arg(argument).env("CI", ci);
        let (code, _, said) = outcome(&mut command);
        let ran = std::fs::read_to_string(dir.join("sudo-ran")).expect("sudo ran");
        assert!(ran.contains("apt-get install"), "{ran}");
        // This sudo installs nothing, so QEMU is still not there.
        assert_eq!(code, Some(1), "{said}");
    }
}

/// Root on a Debian where `qemu-system-arm` conflicts with the user's `qemu-utils`; `apt-ran` lists
/// the calls of apt-get.
fn root_with_a_conflict(dir: &Dir) -> Command {
    let mut command = poor_user(dir, false);
    dir.program("id", "echo 0");
    let ran = dir.join("apt-ran");
    let refuses = "case \"$*\" in *qemu-system-arm*) exit 100;; esac";
    let lines = format!("echo \"$@\" >> {}\n{refuses}", ran.display());
    dir.program("apt-get", &lines);
    command.env("CARGO", cargo_but(dir, "build", "exit 1"));
    command
}

#[test]
fn unconfirmed_commands_are_printed_and_not_run() {
    let dirs = [(); 3].map(|()| Dir::new());
    let [with_sudo, without, root] = &dirs;
    let mut alone = poor_user(without, false);
    let ran = without.join("apt-ran");
    without.program("apt-get", &format!("touch {}", ran.display()));
    alone.arg("--yes");
    for (mut command, ran, words) in [
        (
            poor_user(with_sudo, true),
            with_sudo.join("sudo-ran"),
            ["    sudo apt-get install", "--yes"],
        ),
        (alone, ran, ["as root", "    apt-get install"]),
        (root_with_a_conflict(root), root.join("apt-ran"), ["    apt-get install", "--yes"]),
    ] {
        let (code, _, said) = outcome(&mut command);
        assert_eq!(code, Some(1), "{said}");
        assert!(!ran.exists(), "{said}");
        assert!(said.contains("qemu-system-arm"), "{said}");
        for words in words.iter().filter(|_| on_debian()) {
            assert!(said.contains(words), "{said}");
        }
    }
}

#[test]
fn a_package_of_the_user_is_not_removed() {
    if !on_debian() {
        return;
    }
    let dir = Dir::new();
    let (code, _, said) = outcome(root_with_a_conflict(&dir).arg("--yes"));
    let ran = std::fs::read_to_string(dir.join("apt-ran")).expect("apt-get ran");
    let mut installs = ran.lines().filter(|line| line.starts_with("install"));
    assert!(installs.all(|line| line.contains("--no-remove")), "{ran}");
    assert_eq!((ran.lines().count(), code), (2, Some(1)), "{ran}\n{said}");
}

/// Cargo, with another program for one of its commands.
fn cargo_but(dir: &Dir, command: &str, lines: &str) -> PathBuf {
    let cargo = cargo();
    let cargo = cargo.display();
    let otherwise =
        format!("if [ \"$1\" = {command} ]; then\n{lines}\nelse exec {cargo} \"$@\"; fi");
    dir.program("cargo", &otherwise)
}

fn is_alive(process: &str) -> bool {
    let stat = std::fs::read_to_string(format!("/proc/{process}/stat"));
    // One that has ended and that nobody has asked for yet is a zombie.
    stat.is_ok_and(|stat| !stat.contains(") Z "))
}

#[test]
#[cfg(target_os = "linux")]
fn no_process_is_left_behind_after_a_signal_to_end() {
    for signal in ["TERM", "INT", "HUP"] {
        let dir = Dir::new();
        let processes = dir.join("processes");
        let lines = format!(
            "sleep 300 & echo $$ $! > {0}.part; mv {0}.part {0}; wait",
            processes.display()
        );
        let mut command = xtask(&["meter"]);
        let mut child = command
            .arg(dir.file("firmware", &three_passages(EXIT)))
            .env("CARGO", cargo_but(&dir, "build", &lines))
            .stderr(Stdio::null())
            .spawn()
            .expect("xtask");
        wait(60, || processes.exists(), "it builds nothing");
        let text = std::fs::read_to_string(&processes).expect("their numbers");
        let processes: Vec<&str> = text.split_whitespace().collect();
        assert!(processes.iter().all(|process| is_alive(process)), "{text}");
        let kill = format!("kill -{signal} {}", child.id());
        let sent = Command::new("sh").args(["-c", &kill]).status();
        assert!(sent.expect("sent").success());
        assert!(!child.wait().expect("ended").success());
        let is_over = || !processes.iter().any(|process| is_alive(process));
        wait(10, is_over, signal);
    }
}

fn wait(seconds: u64, is_over: impl Fn() -> bool, what: &str) {
    let start = Instant::now();
    while !is_over() {
        assert!(start.elapsed() < Duration::from_secs(seconds), "{what}");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// Builds a program that prints a figure.
const FIGURES: &str = r#"program="$CARGO_TARGET_DIR/debug/hard_cases"
mkdir -p "$CARGO_TARGET_DIR/debug"
cat > "$program" <<'END'
#!/bin/sh
echo '{"cases": [{"number": 1, "name": "one", "parameters": "", "source": "", "oracle": "", "reason": ""}], "in_qemu": [], "wrong": [],
"rows": [{"case": "one", "number": 1, "quantity": "a figure", "scalar": "f32", "error": 0.5, "bound": 1, "condition": 1, "verdict": "holds"}]}'
END
chmod +x "$program""#;

#[test]
fn reports_written_elsewhere_leave_the_workspace_as_it_is() {
    let dir = Dir::new();
    let out = dir.join("new/reports");
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/hard-cases.md");
    let before = std::fs::read(&page).expect("a page");
    let mut command = xtask(&["hard-cases", "--reports"]);
    command
        .arg(&out)
        .env("CARGO_TARGET_DIR", dir.join("target"))
        .env("CARGO", cargo_but(&dir, "build", FIGURES));
    let (code, _, said) = outcome(&mut command);
    assert_eq!(code, Some(0), "{said}");
    let written = std::fs::read_to_string(out.join("hard-cases.md")).expect("the report");
    assert!(written.contains("\n1. one | 0.50 |"), "{written}");
    // The page and its picture.
    assert_eq!(std::fs::read_dir(&out).expect("its directory").count(), 2);
    assert_eq!(std::fs::read(&page).expect("the page"), before);
}

#[test]
fn a_read_only_directory_is_named_before_anything_is_measured() {
    let dir = Dir::new();
    let file = dir.file("file", b"in the way");
    let measured = dir.join("measured");
    let touch = format!("touch {}", measured.display());
    let mut command = xtask(&["hard-cases", "--reports"]);
    command.arg(file.join("reports")).env("CARGO", cargo_but(&dir, "build", &touch));
    let (code, _, said) = outcome(&mut command);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("cannot create"), "{said}");
    assert!(!measured.exists(), "{said}");
}

#[test]
fn a_scene_is_known_in_capitals_too() {
    let dir = Dir::new();
    let (_, _, said) = outcome(poor_user(&dir, true).args(["--scene", "UR5e", "--no-install"]));
    assert!(said.contains("something is missing"), "{said}");
}
