//! Errors name the port, program or file concerned.

use std::path::Path;

use telemetry_watch::record::Recorder;
use telemetry_watch::session::{self, Options};
use telemetry_watch::source::Place;

#[test]
fn a_record_of_another_ending_is_refused() {
    let error = Recorder::create(Path::new("ticks.xls")).err().expect("refused");
    assert_eq!(error.to_string(), "ticks.xls: a record ends with .csv or .mcap");
}

#[test]
fn a_missing_port_is_named_with_the_existing_ones() {
    let error = Place::Port("/dev/ttyNONE".into(), 9600).open().err();
    let error = error.expect("there is none").to_string();
    assert!(error.contains("/dev/ttyNONE") && error.contains("this machine has"), "{error}");
}

#[test]
fn a_missing_or_ended_program_is_named() {
    let start = |words: &[&str]| {
        let words = words.iter().map(ToString::to_string).collect();
        Place::Program(words).open().err().expect("an error").to_string()
    };
    assert!(start(&["no-such-emulator"]).starts_with("cannot start `no-such-emulator`"));
    assert!(start(&["false"]).contains("`false` ended"), "{}", start(&["false"]));
}

#[test]
#[cfg(target_os = "linux")]
fn a_silent_machine_is_an_error_in_its_time() {
    // A program that connects and is silent.
    let words = ["bash", "-c", "exec 3<>/dev/tcp/127.0.0.1/{port}; exec sleep 60"];
    let words = words.map(str::to_owned).to_vec();
    let mut source = Place::Program(words).open().expect("a shell with TCP");
    let outcome = session::run(&mut source, None, Options::QUIET);
    let error = outcome.expect_err("silence").to_string();
    assert!(error.contains("no frame from bash in 5 s"), "{error}");
}

#[test]
fn a_record_does_not_replace_the_file_that_is_read() {
    let file = std::env::temp_dir().join(format!("watch-{}.csv", std::process::id()));
    std::fs::write(&file, "received").expect("a file");
    let same = file.with_file_name(format!(
        "../{}/watch-{}.csv",
        std::env::temp_dir().file_name().expect("a folder").display(),
        std::process::id()
    ));
    let ended = std::process::Command::new(env!("CARGO_BIN_EXE_telemetry-watch"))
        .arg("--file")
        .arg(&file)
        .arg("--record")
        .arg(&same)
        .output()
        .expect("it starts");
    let left = std::fs::read_to_string(&file).expect("a file");
    std::fs::remove_file(&file).expect("a file");
    assert_eq!(left, "received");
    let error = String::from_utf8_lossy(&ended.stderr);
    assert!(!ended.status.success() && error.contains("it is the file that is read"), "{error}");
}
