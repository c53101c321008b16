//! The loop that reads, records and shows.

use std::io::{IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::time::{Duration, Instant};

use ratatui::DefaultTerminal;
use ratatui::crossterm::event::{self, Event, KeyCode, KeyModifiers};

use crate::error::{Error, Result};
use crate::record::Recorder;
use crate::source::Source;
use crate::view::View;
use crate::{Decoder, Message, screen, summary};

/// The longest time without a frame.
pub const PATIENCE: Duration = Duration::from_secs(5);
/// From one picture to the next.
const PICTURE: Duration = Duration::from_millis(50);
/// From one line to the next, where there is no terminal.
const LINE: Duration = Duration::from_secs(1);

/// A signal has ended the session.
pub static ENDED: AtomicBool = AtomicBool::new(false);

/// The output of the session while it runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Show {
    /// The screen, or a line a second if stdout is no terminal.
    Live,
    Nothing,
}

#[derive(Clone, Copy, Debug)]
pub struct Options {
    pub show: Show,
    /// When it ends at the latest.
    pub limit: Option<Duration>,
    /// Whether it takes no more than the ticks that are due.
    pub pace: bool,
}

impl Options {
    /// It shows nothing, and reads to the end of its source.
    pub const QUIET: Self = Self { show: Show::Nothing, limit: None, pace: false };
}

/// Reads until the source ends, the user ends it, a signal does, or its time is over; returns what
/// is known then.
///
/// # Errors
/// The source fails or is silent for [`PATIENCE`]; the record or the terminal cannot be written.
pub fn run(source: &mut Source, mut recorder: Option<Recorder>, options: Options) -> Result<View> {
    let is_terminal = options.show == Show::Live && std::io::stdout().is_terminal();
    let mut terminal = if is_terminal {
        // It restores the terminal if the program panics.
        Some(ratatui::try_init()?)
    } else {
        None
    };
    let mut session = Session::new(options);
    let outcome = session.read(source, &mut recorder, &mut terminal);
    if terminal.is_some() {
        ratatui::restore();
    }
    // The record is kept, however the session ended.
    let finished = recorder.map_or(Ok(()), Recorder::finish);
    outcome.and(finished).map(|()| session.view)
}

struct Session {
    view: View,
    decoder: Decoder,
    options: Options,
    /// The first tick: its number, and when it arrived.
    first: Option<(u32, Instant)>,
    bytes: u64,
    heard: Instant,
    shown: Instant,
}

impl Session {
    fn new(options: Options) -> Self {
        let now = Instant::now();
        Self {
            view: View::default(),
            decoder: Decoder::new(),
            options,
            first: None,
            bytes: 0,
            heard: now,
            shown: now,
        }
    }

    fn read(
        &mut self,
        source: &mut Source,
        recorder: &mut Option<Recorder>,
        terminal: &mut Option<DefaultTerminal>,
    ) -> Result<()> {
        let start = Instant::now();
        let mut buffer = [0; 4096];
        loop {
            if self.options.pace && self.is_ahead() {
                std::thread::sleep(PICTURE / 10);
            } else {
                let Some(bytes) = source.read(&mut buffer)? else {
                    return self.silence(source, self.view.ticks == 0);
                };
                self.take(bytes, recorder)?;
                self.silence(source, self.heard.elapsed() > PATIENCE)?;
            }
            let is_over = self.options.limit.is_some_and(|limit| start.elapsed() >= limit);
            if is_over || ENDED.load(Relaxed) || self.shows(source, terminal)? {
                return Ok(());
            }
        }
    }

    fn take(&mut self, bytes: &[u8], recorder: &mut Option<Recorder>) -> Result<()> {
        self.bytes += bytes.len() as u64;
        for &byte in bytes {
            let Some(Ok(message)) = self.decoder.push(byte) else {
                continue;
            };
            self.heard = Instant::now();
            if let Some(recorder) = recorder {
                match &message {
                    Message::Machine(machine) => recorder.period(machine.tick_us),
                    Message::Tick(tick) => recorder.write(tick)?,
                    _ => {}
                }
            }
            self.view.take(message);
        }
        self.view.counts = self.decoder.counts();
        Ok(())
    }

    /// Whether the last tick is not due yet.
    fn is_ahead(&mut self) -> bool {
        let (Some(machine), Some(last)) = (&self.view.machine, &self.view.last) else {
            return false;
        };
        let (number, start) = *self.first.get_or_insert((last.number, Instant::now()));
        let ticks = last.number.saturating_sub(number);
        let due = u64::from(ticks) * u64::from(machine.tick_us);
        start.elapsed() < Duration::from_micros(due)
    }

    /// Shows the view if it is time to; returns whether the user ends it.
    fn shows(&mut self, source: &Source, terminal: &mut Option<DefaultTerminal>) -> Result<bool> {
        if let Some(terminal) = terminal {
            if self.shown.elapsed() >= PICTURE {
                self.shown = Instant::now();
                terminal.draw(|frame| screen::draw(frame, &self.view, &source.name))?;
                return ends();
            }
        } else if self.options.show == Show::Live && self.shown.elapsed() >= LINE {
            self.shown = Instant::now();
            writeln!(std::io::stdout(), "{}", summary::line(&self.view))?;
        }
        Ok(false)
    }

    /// Fails if nothing arrives.
    fn silence(&self, source: &Source, is_silent: bool) -> Result<()> {
        if !is_silent {
            return Ok(());
        }
        let hint = match (self.bytes, self.view.counts.bad) {
            (0, _) => "nothing was received; is the machine on, and its line connected?".to_owned(),
            (bytes, bad) => format!(
                "of {bytes} bytes {bad} were ends of bad frames and {} of good ones; is the rate \
                 of the port right?",
                self.view.counts.frames
            ),
        };
        Err(Error::Silent { source_name: source.name.clone(), patience: PATIENCE, hint })
    }
}

/// Whether the user ends the session.
fn ends() -> Result<bool> {
    while event::poll(Duration::ZERO)? {
        if let Event::Key(key) = event::read()? {
            let is_interrupt =
                key.code == KeyCode::Char('c') && key.modifiers.contains(KeyModifiers::CONTROL);
            if is_interrupt || matches!(key.code, KeyCode::Char('q') | KeyCode::Esc) {
                return Ok(true);
            }
        }
    }
    Ok(false)
}
