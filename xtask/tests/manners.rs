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
    dir.program("apt-get", APT);
    dir.program("dpkg", DPKG);
    if with_sudo {
        dir.program("sudo", "echo \"$@\" >> \"${APT_RAN%apt-ran}sudo-ran\"");
    }
    let mut command = xtask(&["demo"]);
    command.env("PATH", dir.join("")).env("RUSTC", rustc());
    command.env("CARGO_TARGET_DIR", dir.join("target")).env("APT_RAN", dir.join("apt-ran"));
    command.env("CARGO", cargo_but(dir, "build", "echo it builds; exit 1"));
    command
}

/// An apt-get that notes what it is called for. `APT` chooses what goes wrong.
const APT: &str = r#"for word; do case $word in -oDir::Cache=*) cache=${word#*=};; esac; done
case "$*" in
*-s\ install*) [ "$APT" != removes ] || echo "Remv qemu-utils [1:10.0.2]"; exit;;
*--download-only*) what=download;;
*clean*) exit;;
*update*) what=update;;
*) what="$*";;
esac
echo "$what" >> "$APT_RAN"
case "$APT $what" in
offline*update) echo "W: Failed to fetch http://a/InRelease  Temporary failure resolving 'a'";;
offline*) echo "E: Unable to locate package qemu-system-arm"; exit 100;;
stale*download) while read -r did; do [ "$did" != update ] || updated=1; done < "$APT_RAN"
    [ "$updated" ] || { echo "E: Failed to fetch http://a/qemu.deb  404  Not Found"; exit 100; };;
refuses*install*) exit 100;;
esac
[ "$what" != download ] || : > "$cache/archives/qemu.deb""#;

/// Unpacks a QEMU that takes every plugin.
const DPKG: &str = r#"/bin/mkdir -p "$3/usr/bin"
printf '#!/bin/sh\necho QEMU emulator version 7.2.22' > "$3/usr/bin/qemu-system-arm"
/bin/chmod +x "$3/usr/bin/qemu-system-arm""#;

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
        let (_, _, said) = outcome(command.arg(argument).env("CI", ci));
        let ran = std::fs::read_to_string(dir.join("sudo-ran")).expect("sudo ran");
        assert!(ran.contains("apt-get install") && ran.contains("--no-remove"), "{ran}");
        // This sudo installs nothing, so QEMU is unpacked.
        assert!(said.contains("unpacked `qemu-system-arm`"), "{said}");
    }
}

#[test]
fn unconfirmed_commands_are_printed_and_not_run() {
    for (with_sudo, uid, words) in [
        (true, 1000, "    sudo apt-get install"),
        (false, 1000, "there is neither root nor sudo: unpack qemu-system-arm"),
        (false, 0, "since apt-get would remove qemu-utils: unpack qemu-system-arm"),
    ] {
        // A scene is known in capitals, too.
        for argument in ["--no-install", "--scene=UR5e"] {
            let dir = Dir::new();
            let mut command = poor_user(&dir, with_sudo);
            dir.program("id", &format!("echo {uid}"));
            command.arg(argument).env("APT", if uid == 0 { "removes" } else { "" });
            let (code, _, said) = outcome(&mut command);
            assert_eq!(code, Some(1), "{said}");
            for ran in ["sudo-ran", "apt-ran", "target/unpacked"] {
                assert!(!dir.join(ran).exists(), "{ran}: {said}");
            }
            assert!(said.contains("`qemu-system-arm`") && !said.contains("it builds"), "{said}");
            assert!(!on_debian() || said.contains(words), "{said}");
            assert_eq!(said.contains("`--yes` installs"), argument != "--no-install", "{said}");
        }
    }
}

/// The calls of apt-get by a user of this number, root or without any right, who agrees, and what
/// is said.
fn installing(dir: &Dir, uid: u32, apt: &str) -> (String, String) {
    let mut command = poor_user(dir, false);
    dir.program("id", &format!("echo {uid}"));
    let (_, _, said) = outcome(command.arg("--yes").env("APT", apt));
    (std::fs::read_to_string(dir.join("apt-ran")).expect("apt-get ran"), said)
}

#[test]
fn what_apt_refuses_is_unpacked() {
    if !on_debian() {
        return;
    }
    let install = "update\ninstall --no-install-recommends --no-remove -y qemu-system-arm -o \
                   DPkg::Lock::Timeout=600\n";
    for (uid, apt, calls) in [
        // The package would remove one of the user's, and is not tried.
        (0, "removes", "download\n"),
        (0, "refuses", &*format!("{install}download\n")),
        (1000, "", "download\n"),
        (1000, "stale", "download\nupdate\ndownload\n"),
    ] {
        let dir = Dir::new();
        // What an interrupted run and another compiler left is redone.
        let junk = dir.join("target/unpacked/qemu-system-arm.part").join("root").join("junk");
        std::fs::create_dir_all(&junk).expect("a folder");
        let (ran, said) = installing(&dir, uid, apt);
        assert_eq!(ran, calls, "{said}");
        assert!(
            said.contains("unpacked `qemu-system-arm`") && said.contains("it builds"),
            "{said}"
        );
        let here = dir.join("target/unpacked/qemu-system-arm");
        assert!(here.join("bin/qemu-system-arm").is_file() && !here.join("apt").exists());
        assert!(!junk.exists() && !here.join("root").join("junk").exists());
        // Once there it is used as it is.
        let (again, said) = installing(&dir, uid, "offline");
        assert!(again == ran && said.contains("it builds"), "{said}");
    }
}

#[test]
fn without_a_network_a_short_message_says_what_to_do() {
    if !on_debian() {
        return;
    }
    let dir = Dir::new();
    let (_, said) = installing(&dir, 1000, "offline");
    let message = said.split_once("error: ").expect("an error").1;
    assert!(message.lines().count() <= 5, "{message}");
    for words in ["Temporary failure resolving", "QEMU_SYSTEM_ARM", "With a network"] {
        assert!(message.contains(words), "{message}");
    }
    assert!(!dir.join("target/unpacked/qemu-system-arm").exists());
}

#[test]
fn a_qemu_without_plugins_is_found_out_before_anything_is_built() {
    let dir = Dir::new();
    let lines = "[ \"$1\" = --version ] && echo QEMU emulator version 8.2.0 && exit\n\
                 echo 'plugin interface not enabled in this build' >&2; exit 1";
    let bare = dir.program("qemu-system-arm", lines);
    for chosen in [true, false] {
        let mut command = poor_user(&dir, true);
        command.arg("--no-install");
        if chosen {
            command.env("QEMU_SYSTEM_ARM", &bare);
        }
        let (code, _, said) = outcome(&mut command);
        assert!(said.contains("version 8.2.0) was built without plugins"), "{said}");
        assert_eq!(said.contains("QEMU_SYSTEM_ARM: "), chosen, "{said}");
        assert!(code == Some(1) && !said.contains("it builds"), "{said}");
    }
    if on_debian() {
        // It does not stand in the way of one that has them.
        let (_, said) = installing(&dir, 1000, "");
        assert!(said.contains("unpacked `qemu-system-arm`"), "{said}");
    }
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
        let qemu = dir.program("qemu", "echo QEMU emulator version 7.2.22");
        let mut child = command
            .env("QEMU_SYSTEM_ARM", qemu)
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
        wait(60, is_over, signal);
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
