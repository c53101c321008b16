//! Programs that stand in for QEMU and misbehave.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use defmt_decoder::DecodeError;
use tempfile::TempDir;

use super::watch::{Decoder, Line, Watch};
use super::{Qemu, Run};

/// The folder of a script `qemu`, gone with the value.
fn script(lines: &str) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("qemu"), lines).expect("a script");
    folder
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
        let end = end.ok_or(DecodeError::UnexpectedEof)?;
        let frame: Vec<u8> = self.0.drain(..=end).collect();
        let text = String::from_utf8_lossy(&frame[..end]).into_owned();
        if text.starts_with('?') {
            return Err(DecodeError::Malformed);
        }
        let error = text.strip_prefix('!');
        Ok(Line { is_error: error.is_some(), text: error.unwrap_or(&text).to_owned() })
    }
}

/// Long enough for a script to start on a machine that is busy building.
const PATIENCE: Duration = Duration::from_secs(3);

/// The outcome of a run of some lines of shell.
fn outcome(lines: &str) -> Result<Vec<u8>, String> {
    let script = script(lines);
    let watch =
        Watch { name: "fake", patience: PATIENCE, decoder: Some(Box::new(Plain::default())) };
    let mut command = Command::new("sh");
    command
        .arg(script.path().join("qemu"))
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    watch.run(&mut command, &mut |_| Ok(())).map_err(|error| error.to_string())
}

#[test]
fn a_run_that_ends_with_done_passes() {
    let log = b"hello\0done\0".to_vec();
    assert_eq!(outcome(r"printf 'hello\0done\0'"), Ok(log));
}

#[test]
fn whatever_else_a_run_does_is_reported() {
    for (lines, with) in [
        // A crash, with its output.
        (
            r"printf 'hello\0'; echo 'no such machine' >&2; exit 3",
            &["it failed", "3", "QEMU said: no such machine"][..],
        ),
        (r"printf '!a record was lost\0'; exit 1", &["a record was lost"]),
        ("kill -SEGV $$", &["it failed", "signal"]),
        // A silent exit.
        ("exit 0", &["ended without `done`", "\"\""]),
        (r"printf 'hello\0'", &["ended without `done`", "\"hello\""]),
        // A panic, at once.
        (
            r"printf '!panic: out of bounds\0'; exec sleep 100",
            &["the firmware panicked: panic: out of bounds"],
        ),
        // Malformed frames, and a flood of them.
        (r"printf '?bad\0'; exec sleep 100", &["not the defmt log", "?bad"]),
        (r"printf 'done\0half a frame'", &["not the defmt log", "half a"]),
        ("exec yes junk", &["not the defmt log", "junk"]),
        // No progress.
        (r"printf 'hello\0'; exec sleep 100", &["no progress for 3s, killed", "\"hello\""]),
        ("while :; do printf junk; sleep 0.02; done", &["no progress for 3s"]),
        (
            r"printf 'done\0'; exec >&- 2>&-; exec sleep 100",
            &["closed its output and went on for 3s, killed"],
        ),
    ] {
        let message = outcome(lines).expect_err(lines);
        for part in with {
            assert!(message.contains(part), "{lines}: {message}");
        }
    }
}

#[test]
fn a_child_that_holds_the_pipe_of_stderr_keeps_nobody() {
    assert!(outcome(r"sleep 20 >/dev/null & printf 'done\0'").is_ok());
}

/// A QEMU that is a script.
fn qemu(script: &TempDir) -> Qemu {
    let program = script.path().join("qemu");
    let mode = std::os::unix::fs::PermissionsExt::from_mode(0o755);
    std::fs::set_permissions(&program, mode).expect("made executable");
    Qemu::at(program).expect("a version")
}

/// A QEMU of this version that runs `why` in place of loading the meter.
fn refusing(version: &str, why: &str) -> TempDir {
    script(&format!(
        "#!/bin/sh\nif [ \"$1\" = --version ]; then echo 'QEMU emulator version {version}'; exit; \
         fi\n{why}\n"
    ))
}

const REFUSES: &str =
    "qemu-system-arm: Could not load plugin /x/libcycle_meter.so: plugin requires API version";

#[test]
fn a_qemu_that_loads_the_meter_or_names_its_version_takes_it() {
    let newer = format!(
        "[ \"$CYCLE_METER_INTERFACE\" = 9 ] && exit 0\necho '{REFUSES} 6, but this QEMU supports \
         only a minimum version of 9' >&2; exit 1"
    );
    for (version, lines, interface) in [
        ("7.2.22", "read quit; exit 0", None),
        ("10.0.2", "read quit; exit 0", None),
        ("99.1.0", "read quit; exit 0", None),
        ("99.1.0", &newer, Some(9)),
    ] {
        let script = refusing(version, lines);
        let qemu = qemu(&script);
        let accepted = qemu.interface(Path::new("meter.so"));
        assert_eq!(accepted.map_err(|e| e.to_string()), Ok(interface), "{version}");
    }
}

#[test]
fn a_qemu_is_judged_before_anything_is_built() {
    let says = |what: &str| format!("echo 'qemu-system-arm: {what}' >&2; exit 1");
    let no_file = says("Could not load plugin no-plugin: cannot open shared object file");
    for version in ["7.0.0", "7.2.22", "8.2.2", "9.2.0", "10.0.2", "11.0.0"] {
        assert!(qemu(&refusing(version, &no_file)).with_plugins().is_ok(), "{version}");
    }
    for (version, lines, why) in [
        ("6.2.0", &no_file, "takes QEMU 7 to 11"),
        ("8.1.0", &says("plugin interface not enabled in this build"), "built without plugins"),
        ("7.2.0", &says("-plugin: invalid option"), "built without plugins"),
    ] {
        let refused = qemu(&refusing(version, lines)).with_plugins().err();
        let refused = refused.expect("refused").to_string();
        assert!(refused.contains(why) && refused.contains(version), "{refused}");
    }
}

#[test]
fn commas_of_paths_and_words_stand_twice() {
    let script = refusing("10.0.2", "exit 0");
    let [plugin, out] = ["/a, b/meter.so", "/it's, c=d/out"].map(Path::new);
    let run = Run { words: &["1,2"], ..Run::logging("a,b", plugin, Some((plugin, out))) };
    let command = qemu(&script).command("m", &run).expect("a command");
    let words: Vec<&str> = command.get_args().filter_map(|word| word.to_str()).collect();
    for word in [
        "enable=on,target=native,arg=a,,b,arg=1,,2",
        "file=/a,, b/meter.so,out=/it's,, c=d/out",
        "/a, b/meter.so",
    ] {
        assert!(words.contains(&word), "{words:?}");
    }
}

#[test]
fn a_qemu_that_takes_no_version_is_refused() {
    let stubborn =
        format!("echo '{REFUSES} 1, but this QEMU supports only up to version 0' >&2; exit 1");
    let refused = qemu(&refusing("12.0.0", &stubborn)).interface(Path::new("meter.so"));
    let refused = refused.expect_err("refused").to_string();
    for part in ["12.0.0", "cycle meter", "up to version 0", super::ANOTHER_QEMU] {
        assert!(refused.contains(part), "{refused}");
    }
}
