//! Runs a program that may hang, spew rubbish or leave children behind, and gives up on it in time.

use std::io::Read;
use std::process::{Child, Command, ExitStatus};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use defmt_decoder::DecodeError;

use super::DONE;
use crate::error::{Error, Result};
use crate::output;
use crate::processes::Group;
use crate::shell;

/// Bytes that may come without one whole message among them.
const MOST_JUNK: usize = 1 << 20;
/// Bytes of a whole log.
const MOST_LOG: usize = 64 << 20;
/// Bytes of stderr that are kept.
const MOST_SAID: usize = 1 << 16;
/// Chunks that wait for the decoder: beyond it the program has to.
const CHUNKS: usize = 64;
/// How long stderr may stay open after the program's end: a child of its may hold it for ever.
const GRACE: Duration = Duration::from_secs(1);

/// A whole message.
pub struct Line {
    pub text: String,
    pub is_error: bool,
}

/// What makes lines of bytes.
pub trait Decoder {
    fn received(&mut self, bytes: &[u8]);
    fn decode(&mut self) -> std::result::Result<Line, DecodeError>;
}

/// How to watch.
pub struct Watch<'a> {
    /// The firmware's name in messages.
    pub name: &'a str,
    /// How long it may stay silent, or go on after its output has ended.
    pub patience: Duration,
    /// None if it must stay silent.
    pub decoder: Option<Box<dyn Decoder + 'a>>,
}

/// Kills the program whichever way we leave.
struct Guard(
    Child,
    #[expect(dead_code, reason = "held until it is dropped")] Group,
);

impl Drop for Guard {
    fn drop(&mut self) {
        // Both fail only if it has ended already, which is what is wanted.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Why listening stopped before the end.
enum Heard {
    /// The firmware or QEMU did something wrong.
    Wrong(String),
    /// Whoever gets the lines refused one.
    Callback(Error),
}

#[derive(Default)]
struct Log {
    raw: Vec<u8>,
    last: String,
    /// The last line at the level of an error.
    complaint: Option<String>,
}

impl Watch<'_> {
    /// Runs the command to its end, its output piped to us.
    pub fn run(
        mut self,
        command: &mut Command,
        on_line: &mut impl FnMut(&str) -> Result<()>,
    ) -> Result<Vec<u8>> {
        let (child, group) = shell::spawn(command)?;
        let mut child = Guard(child, group);
        let stdout = child.0.stdout.take().expect("stdout is piped");
        let said = Said::by(child.0.stderr.take().expect("stderr is piped"));
        let mut log = Log::default();
        let heard = self.listen(&mut log, &bytes_of(stdout), on_line);
        let ended = match heard {
            Ok(()) => self.end_of(&mut child.0, command)?,
            Err(_) => None,
        };
        drop(child);
        let said = said.text();
        let failed = |what: String| Error::Qemu {
            program: self.name.to_owned(),
            what: if said.is_empty() {
                what
            } else {
                format!("{what}\nQEMU said: {said}")
            },
        };
        match (heard, ended) {
            (Err(Heard::Callback(error)), _) => Err(error),
            (Err(Heard::Wrong(what)), _) => Err(failed(what)),
            (Ok(()), None) => Err(failed(format!(
                "it closed its output and went on for {:?}, killed",
                self.patience
            ))),
            (Ok(()), Some(status)) if !status.success() => {
                let why = log.complaint.map(|line| format!(": {line}"));
                let why = why.unwrap_or_default();
                Err(failed(format!("it failed ({status}){why}")))
            }
            (Ok(()), Some(_)) if self.decoder.is_some() && log.last != DONE => {
                Err(failed(format!(
                    "it ended without `{DONE}`; its last line was {:?}",
                    log.last
                )))
            }
            (Ok(()), Some(_)) => {
                if !said.is_empty() {
                    output::note(&said);
                }
                Ok(log.raw)
            }
        }
    }

    /// Decodes until the stream ends.
    fn listen(
        &mut self,
        log: &mut Log,
        bytes: &Receiver<Vec<u8>>,
        on_line: &mut impl FnMut(&str) -> Result<()>,
    ) -> std::result::Result<(), Heard> {
        // Only whole messages are progress: a firmware that spews rubbish hangs as well.
        let mut progress = Instant::now();
        let mut junk = 0;
        loop {
            let left = self.patience.saturating_sub(progress.elapsed());
            let chunk = match bytes.recv_timeout(left) {
                Ok(chunk) if !left.is_zero() => chunk,
                Err(RecvTimeoutError::Disconnected) => break,
                Ok(_) | Err(RecvTimeoutError::Timeout) => {
                    return Err(Heard::Wrong(format!(
                        "no progress for {:?}, killed; the last line was {:?}",
                        self.patience, log.last
                    )));
                }
            };
            log.raw.extend(&chunk);
            junk += chunk.len();
            let Some(decoder) = &mut self.decoder else {
                return Err(Heard::Wrong(log.not_defmt()));
            };
            decoder.received(&chunk);
            loop {
                let line = match decoder.decode() {
                    Ok(line) => line,
                    Err(DecodeError::UnexpectedEof) => break,
                    Err(DecodeError::Malformed) => return Err(Heard::Wrong(log.not_defmt())),
                };
                (progress, junk) = (Instant::now(), 0);
                log.take(&line)?;
                on_line(&line.text).map_err(Heard::Callback)?;
                log.last = line.text;
            }
            if junk > MOST_JUNK {
                return Err(Heard::Wrong(log.not_defmt()));
            }
            if log.raw.len() > MOST_LOG {
                let most = MOST_LOG >> 20;
                return Err(Heard::Wrong(format!(
                    "it logged more than {most} MB, killed"
                )));
            }
        }
        // rzCOBS ends each frame with a zero; what follows the last one was never decoded.
        match log.raw.last() {
            None | Some(0) => Ok(()),
            Some(_) => Err(Heard::Wrong(log.not_defmt())),
        }
    }

    /// How it ended; `None` if it does not.
    fn end_of(&self, child: &mut Child, command: &Command) -> Result<Option<ExitStatus>> {
        let start = Instant::now();
        loop {
            let status = child.try_wait().map_err(|e| Error::spawn(command, e))?;
            if status.is_some() || start.elapsed() > self.patience {
                return Ok(status);
            }
            thread::sleep(Duration::from_millis(5));
        }
    }
}

impl Log {
    fn take(&mut self, line: &Line) -> std::result::Result<(), Heard> {
        if line.is_error && line.text.starts_with("panic") {
            let what = format!("the firmware panicked: {}", line.text);
            return Err(Heard::Wrong(what));
        }
        if line.is_error {
            self.complaint = Some(line.text.clone());
        }
        Ok(())
    }

    fn not_defmt(&self) -> String {
        let frames = self.raw.split(|byte| *byte == 0);
        let last = frames.rev().find(|frame| !frame.is_empty()).unwrap_or(&[]);
        format!(
            "its output is not the defmt log that was expected; it ends with {:?}",
            String::from_utf8_lossy(&last[last.len().saturating_sub(200)..])
        )
    }
}

/// Reads in a thread of its own, since a read cannot be given a deadline.
fn bytes_of(mut stdout: impl Read + Send + 'static) -> Receiver<Vec<u8>> {
    let (sender, receiver) = mpsc::sync_channel(CHUNKS);
    thread::spawn(move || {
        let mut buffer = [0; 4096];
        while let Ok(n @ 1..) = stdout.read(&mut buffer) {
            if sender.send(buffer[..n].to_vec()).is_err() {
                break;
            }
        }
    });
    receiver
}

/// What came on stderr: decoration of an error message, so nothing waits for it for long.
struct Said {
    text: Arc<Mutex<Vec<u8>>>,
    ended: Receiver<()>,
}

impl Said {
    fn by(mut stderr: impl Read + Send + 'static) -> Self {
        let text = Arc::new(Mutex::new(Vec::new()));
        let (sender, ended) = mpsc::channel();
        let kept = Arc::clone(&text);
        thread::spawn(move || {
            let mut buffer = [0; 4096];
            // What is not kept is read all the same: a full pipe would stop the program.
            while let Ok(n @ 1..) = stderr.read(&mut buffer) {
                if let Ok(mut kept) = kept.lock() {
                    let room = n.min(MOST_SAID - kept.len());
                    kept.extend(&buffer[..room]);
                }
            }
            let _ = sender.send(());
        });
        Self { text, ended }
    }

    /// All of it, or what there is when patience ends.
    fn text(&self) -> String {
        let _ = self.ended.recv_timeout(GRACE);
        let text = self.text.lock();
        text.map_or_else(
            |_| String::new(),
            |text| String::from_utf8_lossy(&text).trim().to_owned(),
        )
    }
}
