//! Programs that stand in for QEMU and misbehave.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

use defmt_decoder::DecodeError;

use super::Qemu;
use super::watch::{Decoder, Line, Watch};

/// A script, gone with its directory.
struct Script(PathBuf);

impl Script {
    fn new(lines: &str) -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let name = format!("xtask-qemu-{}-{number}", std::process::id());
        let dir = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&dir).expect("a temporary directory");
        std::fs::write(dir.join("qemu"), lines).expect("a script");
        Self(dir)
    }
}

impl Drop for Script {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Lines of text in frames that end with a zero, as defmt's do; `!` marks an error and `?` is
/// malformed.
#[derive(Default)]
struct Plain(Vec<u8>);

impl Decoder for Plain {
    fn received(&mut self, bytes: &[u8]) {
        self.0.extend(bytes);
    }

    fn decode(&mut self) -> Result<Line, DecodeError> {
        let end = self.0.iter().position(|byte| *byte == 0);
        let frame: Vec<u8> = self
            .0
            .drain(..=end.ok_or(DecodeError::UnexpectedEof)?)
            .collect();
        let text = String::from_utf8_lossy(&frame[..frame.len() - 1]).into_owned();
        match text.strip_prefix('!') {
            _ if text.starts_with('?') => Err(DecodeError::Malformed),
            Some(error) => Ok(Line {
                text: error.into(),
                is_error: true,
            }),
            None => Ok(Line {
                text,
                is_error: false,
            }),
        }
    }
}

/// Long enough for a script to start on a machine that is busy building.
const PATIENCE: Duration = Duration::from_secs(3);

/// The outcome of a run of some lines of shell, within a few times [`PATIENCE`].
fn outcome(lines: &str) -> Result<Vec<u8>, String> {
    let script = Script::new(lines);
    let start = Instant::now();
    let watch = Watch {
        name: "fake",
        patience: PATIENCE,
        decoder: Some(Box::new(Plain::default())),
    };
    let mut command = Command::new("sh");
    command
        .arg(script.0.join("qemu"))
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let outcome = watch.run(&mut command, &mut |_| Ok(()));
    // A busy machine may start a script late, but not for ever.
    assert!(start.elapsed() < Duration::from_secs(60), "{lines}");
    outcome.map_err(|error| error.to_string())
}

fn assert_fails(lines: &str, with: &[&str]) {
    let message = outcome(lines).expect_err(lines);
    for part in with {
        assert!(message.contains(part), "{lines}: {message}");
    }
}

#[test]
fn a_run_that_ends_with_done_passes() {
    assert_eq!(
        outcome(r"printf 'hello\0done\0'"),
        Ok(b"hello\0done\0".to_vec())
    );
}

#[test]
fn a_crash_is_reported_with_its_output() {
    assert_fails(
        r"printf 'hello\0'; echo 'no such machine' >&2; exit 3",
        &["it failed", "3", "QEMU said: no such machine"],
    );
    assert_fails(
        r"printf '!a record was lost\0'; exit 1",
        &["a record was lost"],
    );
    assert_fails("kill -SEGV $$", &["it failed", "signal"]);
}

#[test]
fn a_hang_is_killed() {
    assert_fails(
        r"printf 'hello\0'; exec sleep 100",
        &["no progress for 3s, killed", "\"hello\""],
    );
}

#[test]
fn a_flood_of_junk_is_killed_by_its_size() {
    assert_fails("exec yes junk", &["not the defmt log", "junk"]);
}

#[test]
fn a_trickle_of_junk_is_killed_by_the_clock() {
    assert_fails(
        "while :; do printf junk; sleep 0.02; done",
        &["no progress for 3s"],
    );
}

#[test]
fn malformed_frames_are_reported() {
    assert_fails(
        r"printf '?bad\0'; exec sleep 100",
        &["not the defmt log", "?bad"],
    );
    assert_fails(
        r"printf 'done\0half a frame'",
        &["not the defmt log", "half a"],
    );
}

#[test]
fn a_silent_exit_is_no_success() {
    assert_fails("exit 0", &["ended without `done`", "\"\""]);
    assert_fails(r"printf 'hello\0'", &["ended without `done`", "\"hello\""]);
}

#[test]
fn a_panic_is_reported_at_once() {
    assert_fails(
        r"printf '!panic: out of bounds\0'; exec sleep 100",
        &["the firmware panicked: panic: out of bounds"],
    );
}

#[test]
fn a_program_that_goes_on_without_output_is_killed() {
    assert_fails(
        r"printf 'done\0'; exec >&- 2>&-; exec sleep 100",
        &["closed its output and went on for 3s, killed"],
    );
}

#[test]
fn a_child_that_holds_the_pipe_of_stderr_keeps_nobody() {
    assert!(outcome(r"sleep 20 >/dev/null & printf 'done\0'").is_ok());
}

/// A QEMU that is a script.
fn qemu(script: &Script) -> Qemu {
    let program = script.0.join("qemu");
    let mode = std::os::unix::fs::PermissionsExt::from_mode(0o755);
    std::fs::set_permissions(&program, mode).expect("made executable");
    Qemu::at(program).expect("a version")
}

/// A QEMU of this version that runs `why` in place of loading the meter.
fn refusing(version: &str, why: &str) -> Script {
    Script::new(&format!(
        "#!/bin/sh\nif [ \"$1\" = --version ]; then echo 'QEMU emulator version {version}'; exit; fi\n{why}\n"
    ))
}

const REFUSES: &str =
    "qemu-system-arm: Could not load plugin /x/libcycle_meter.so: plugin requires API version";

#[test]
fn any_qemu_that_loads_the_meter_takes_it() {
    for version in ["7.2.22", "10.0.2", "99.1.0"] {
        let script = refusing(version, "read quit; exit 0");
        let accepted = qemu(&script).interface(Path::new("meter.so"));
        assert_eq!(accepted.map_err(|e| e.to_string()), Ok(None), "{version}");
    }
}

#[test]
fn the_version_that_a_newer_qemu_names_is_tried() {
    let script = refusing(
        "99.1.0",
        &format!(
            "[ \"$CYCLE_METER_INTERFACE\" = 9 ] && exit 0\necho '{REFUSES} 6, but this QEMU supports only a \
             minimum version of 9' >&2; exit 1"
        ),
    );
    let qemu = qemu(&script);
    let accepted = qemu.interface(Path::new("meter.so"));
    assert_eq!(accepted.map_err(|e| e.to_string()), Ok(Some(9)));
    assert!(!qemu.is_known());
}

#[test]
fn a_qemu_that_takes_no_version_is_refused() {
    let stubborn =
        format!("echo '{REFUSES} 1, but this QEMU supports only up to version 0' >&2; exit 1");
    let no_plugins = "echo 'qemu-system-arm: -plugin: invalid option' >&2; exit 1".to_owned();
    for (lines, why) in [
        (stubborn, "up to version 0"),
        (no_plugins, "invalid option"),
    ] {
        let script = refusing("12.0.0", &lines);
        let refused = qemu(&script).interface(Path::new("meter.so"));
        let refused = refused.expect_err("refused").to_string();
        for part in ["12.0.0", "cycle meter", why, super::ANOTHER_QEMU] {
            assert!(refused.contains(part), "{refused}");
        }
    }
}
