//! The listener's claims on its screen, its records and its errors, on recorded frames.

use std::path::{Path, PathBuf};
use std::time::Duration;

use dynamics_core::model::JointLimits;
use machine_link::{Axis, Joint, encode};
use motion_control::limits::{Fault, Mode};
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use telemetry_watch::record::Recorder;
use telemetry_watch::session::{self, Options};
use telemetry_watch::source::Place;
use telemetry_watch::summary::{self, Summary};
use telemetry_watch::view::View;
use telemetry_watch::{Decoder, Machine, Message, Tick, screen};

/// A machine with one joint that turns and one that slides.
fn machine() -> Machine {
    let axis = |upper: f32, torque, prismatic| Axis {
        limits: JointLimits { lower: -upper, upper, velocity: 2.0, torque },
        prismatic,
    };
    Machine {
        name: "two_axes".try_into().expect("short enough"),
        tick_us: 1000,
        timer_hz: 168_000_000,
        joints: [axis(3.0, 150.0, false), axis(0.5, 80.0, true)].into_iter().collect(),
    }
}

fn tick(number: u32) -> Tick {
    let joint = |reference: f32, error: f32, torque| Joint {
        reference,
        estimate: reference - error,
        torque,
    };
    let mut tick = Tick {
        number,
        tick: number,
        joints: [joint(1.5, 2e-3, 75.0), joint(-0.5, 0.0, -20.0)].into_iter().collect(),
        cost: [1680, 168, 3360, 336, 840],
        ..Tick::default()
    };
    if number >= 20 {
        tick.status.mode = Mode::Stopped;
        tick.status.fault = Some(Fault::Encoder { joint: 1 });
    } else if number >= 10 {
        tick.status.mode = Mode::Hold;
        tick.status.limited = true;
    }
    tick
}

/// The bytes of 25 ticks, of which one is dropped and one is corrupted.
fn recorded() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut send = |message: &Message| {
        let mut buffer = [0; 1024];
        bytes.extend_from_slice(encode(message, &mut buffer).expect("it fits"));
    };
    send(&Message::Machine(machine()));
    for number in (0..25).filter(|&number| number != 5) {
        let mut tick = tick(number);
        tick.dropped = u32::from(number > 5);
        send(&Message::Tick(tick));
    }
    // In the last but one frame.
    let at = bytes.len() - 90;
    bytes[at] ^= 0x10;
    bytes
}

fn view(bytes: &[u8]) -> View {
    let (mut decoder, mut view) = (Decoder::new(), View::default());
    let messages = bytes.iter().filter_map(|&byte| decoder.push(byte)?.ok());
    messages.for_each(|message| view.take(message));
    view.counts = decoder.counts();
    view
}

/// A file of its own, removed at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let name = format!("telemetry-watch-{}-{name}", std::process::id());
        Self(std::env::temp_dir().join(name))
    }

    fn holding(name: &str, bytes: &[u8]) -> Self {
        let file = Self::new(name);
        std::fs::write(&file.0, bytes).expect("written");
        file
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // A test that failed may not have written it.
        let _ = std::fs::remove_file(&self.0);
    }
}

/// The result of a session on these bytes, with its record.
fn session(name: &str, bytes: &[u8], record: Option<&Path>) -> Result<View, String> {
    let file = Scratch::holding(name, bytes);
    let mut source = Place::File(file.0.clone()).open().expect("it is there");
    let recorder = record.map(|path| Recorder::create(path).expect("created"));
    session::run(&mut source, recorder, Options::QUIET).map_err(|error| error.to_string())
}

/// The screen as lines of text.
fn drawn(view: &View) -> String {
    let mut terminal = Terminal::new(TestBackend::new(92, 24)).expect("a terminal");
    terminal.draw(|frame| screen::draw(frame, view, "QEMU")).expect("drawn");
    let lines = terminal.backend().to_string();
    let lines = lines.lines().map(|line| line.trim_matches('"').trim_end());
    lines.collect::<Vec<_>>().join("\n")
}

#[test]
fn the_screen_shows_what_was_recorded() {
    let shown = drawn(&view(&recorded()));
    assert_eq!(shown, include_str!("screen.txt").trim_end(), "\n{shown}\n");
}

#[test]
fn a_screen_of_any_size_is_drawn() {
    let view = view(&recorded());
    for (width, height) in [(1, 1), (20, 5), (200, 60)] {
        for view in [&view, &View::default()] {
            let mut terminal = Terminal::new(TestBackend::new(width, height)).expect("a terminal");
            let drawn = terminal.draw(|frame| screen::draw(frame, view, "QEMU"));
            assert!(drawn.is_ok());
        }
    }
}

#[test]
fn numbers_that_are_none_are_drawn() {
    let mut tick = tick(1);
    tick.joints[0].estimate = f32::NAN;
    tick.joints[1].torque = f32::INFINITY;
    let mut view = View::default();
    view.take(Message::Machine(machine()));
    view.take(Message::Tick(tick));
    assert!(drawn(&view).contains("NaN"));
}

#[test]
fn the_summary_counts_what_is_missing_and_why() {
    let summary = Summary::of(&session("summary", &recorded(), None).expect("frames"));
    let counts = (summary.ticks, summary.bad_frames, summary.dropped, summary.lost);
    assert_eq!(counts, (23, 1, 1, 1));
    assert_eq!(summary.machine.as_deref(), Some("two_axes"));
    assert_eq!(summary.joints[0].max_torque_share, Some(0.5));
    assert!((summary.joints[0].rms_error - 2e-3).abs() < 1e-6);
    assert_eq!(summary.cost[2].max_us, Some(20.0));
    let events: Vec<&str> = summary.events.iter().map(|(_, text)| text.as_str()).collect();
    assert_eq!(events, ["hold", "stopped: joint 1: its encoder reports an error"]);
}

#[test]
fn a_fault_that_comes_and_goes_is_one_line() {
    let mut view = View::default();
    for number in 0..5000 {
        let mut tick = tick(0);
        tick.number = number;
        // From tick 2000, and again from 4000, an encoder reports an error in every second tick.
        let is_faulty = number % 2000 < 20 && number >= 2000;
        if is_faulty && number % 2 == 0 {
            tick.status.mode = Mode::Hold;
            tick.status.fault = Some(Fault::Encoder { joint: 1 });
        }
        view.take(Message::Tick(tick));
    }
    let words: Vec<(u32, String)> = Summary::of(&view).events;
    let fault = "hold: joint 1: its encoder reports an error";
    let expected = [
        (2000, format!("{fault}  (10 times to tick 2018)")),
        (2001, "full  (10 times to tick 2019)".to_owned()),
        (4000, format!("{fault}  (10 times to tick 4018)")),
        (4001, "full  (10 times to tick 4019)".to_owned()),
    ];
    assert_eq!(words, expected);
}

#[test]
fn the_last_line_tells_the_machines_time_from_the_computers() {
    let mut view = view(&recorded());
    let said = |view: &View| summary::duration(view, Duration::from_secs(2));
    assert_eq!(said(&view), "23 ticks: 0.02 s of the machine, in 2.00 s");
    view.machine = None;
    assert_eq!(said(&view), "23 ticks in 2.00 s");
}

#[test]
fn a_line_of_text_says_the_same() {
    let line = summary::line(&view(&recorded()));
    let expected = "tick 24: stopped (joint 1: its encoder reports an error), error 2.000 mrad or \
                    mm at most, 38.0 µs; 1 bad frames, 1 dropped, 1 lost";
    assert_eq!(line, expected);
}

#[test]
fn a_csv_record_has_a_line_for_each_tick() {
    let record = Scratch::new("record.csv");
    session("csv", &recorded(), Some(&record.0)).expect("frames");
    let text = std::fs::read_to_string(&record.0).expect("written");
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 1 + 23);
    let columns: Vec<usize> = lines.iter().map(|line| line.split(',').count()).collect();
    assert!(columns.iter().all(|&columns| columns == 7 + 2 * 3 + 5), "{columns:?}");
    assert!(lines[0].starts_with("number,tick,mode,fault,limited,dropped,time_s,reference_0,"));
    assert!(lines[1].starts_with("0,0,full,,false,0,0.000000,1.5,1.498,75,"), "{}", lines[1]);
}

#[test]
fn an_mcap_record_is_read_back() {
    let record = Scratch::new("record.mcap");
    session("mcap", &recorded(), Some(&record.0)).expect("frames");
    let bytes = std::fs::read(&record.0).expect("written");
    let messages = mcap::MessageStream::new(&bytes).expect("an MCAP file");
    let messages: Vec<_> = messages.collect::<Result<_, _>>().expect("whole");
    assert_eq!(messages.len(), 23);
    let last = messages.last().expect("the last tick");
    assert_eq!((last.sequence, last.log_time), (24, 24_000_000));
    let json: serde_json::Value = serde_json::from_slice(&last.data).expect("JSON");
    assert_eq!(json["joints"][0]["torque"], 75.0);
    assert_eq!(json["cost"]["dynamics"], 3360);
}

#[test]
fn bytes_without_a_frame_are_an_error_that_counts_them() {
    let error = session("noise", &[7, 0, 9, 9, 0], None).expect_err("no frame");
    assert!(error.contains("of 5 bytes 1 were ends of bad frames"), "{error}");
    let error = session("nothing", &[], None).expect_err("no byte");
    assert!(error.contains("nothing was received"), "{error}");
}

#[test]
fn a_paced_session_takes_as_long_as_its_ticks() {
    // 400 ticks of 1 ms, in more than one read.
    let mut bytes = Vec::new();
    let messages = (0..400).map(|number| Message::Tick(tick(number)));
    for message in [Message::Machine(machine())].into_iter().chain(messages) {
        let mut buffer = [0; 1024];
        bytes.extend_from_slice(encode(&message, &mut buffer).expect("it fits"));
    }
    let file = Scratch::holding("paced", &bytes);
    for pace in [true, false] {
        let mut source = Place::File(file.0.clone()).open().expect("it is there");
        let options = Options { pace, ..Options::QUIET };
        let start = std::time::Instant::now();
        let view = session::run(&mut source, None, options).expect("frames");
        assert_eq!(view.ticks, 400);
        // A busy machine takes longer for both.
        assert!(!pace || start.elapsed() >= Duration::from_millis(250), "{:?}", start.elapsed());
    }
}
