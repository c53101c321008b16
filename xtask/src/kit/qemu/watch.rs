//! Runs a program that may hang, spew rubbish or leave children behind, and gives up on it in time.

use std::io::Read;
use std::process::{Child, Command, ExitStatus};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use defmt_decoder::DecodeError;

use super::DONE;
use crate::kit::error::{Error, Result};
use crate::kit::processes::{self, Group};
use crate::kit::{output, shell};

/// Bytes that may come without one whole message among them.
const MOST_JUNK: usize = 1 << 20;
/// Bytes of a whole log.
const MOST_LOG: usize = 64 << 20;
/// Bytes of stderr that are kept.
const MOST_SAID: usize = 1 << 16;
/// Chunks of a pipe that wait for who reads them: beyond it the program has to.
const CHUNKS: usize = 64;
/// The time for which stderr may stay open after the program's end: a child process may never close
/// it.
const GRACE: Duration = Duration::from_secs(1);

pub struct Line {
    pub text: String,
    pub is_error: bool,
}

/// Decodes bytes into lines.
pub trait Decoder {
    fn received(&mut self, bytes: &[u8]);
    fn decode(&mut self) -> std::result::Result<Line, DecodeError>;
}

pub struct Watch<'a> {
    /// The firmware's name in messages.
    pub name: &'a str,
    /// The longest silence, and the longest time from the end of the output to the end of the
    /// program.
    pub patience: Duration,
    /// None if it must stay silent.
    pub decoder: Option<Box<dyn Decoder + 'a>>,
}

/// Kills the program whichever way we leave.
struct Guard(Child, #[expect(dead_code, reason = "held until it is dropped")] Group);

impl Drop for Guard {
    fn drop(&mut self) {
        processes::kill(&mut self.0);
    }
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
        let stderr = bytes_of(child.0.stderr.take().expect("stderr is piped"));
        let mut log = Log::default();
        let mut outcome = self.listen(&mut log, &bytes_of(stdout), on_line);
        if outcome.is_ok() {
            let status = processes::within(&mut child.0, self.patience);
            let status = status.map_err(|e| Error::spawn(command, e))?;
            outcome = self.verdict(status, &log);
        }
        drop(child);
        match (outcome, said(&stderr)) {
            (outcome, said) if said.is_empty() => outcome?,
            (Err(Error::Qemu { program, what }), said) => {
                return Err(Error::qemu(&program, format!("{what}\nQEMU said: {said}")));
            }
            (Err(error), _) => return Err(error),
            (Ok(()), said) => output::note(&said),
        }
        Ok(log.raw)
    }

    fn verdict(&self, status: Option<ExitStatus>, log: &Log) -> Result<()> {
        let (patience, last) = (self.patience, &log.last);
        let what = match status {
            None => format!("it closed its output and went on for {patience:?}, killed"),
            Some(status) if !status.success() => {
                let why = log.complaint.iter().map(|line| format!(": {line}"));
                format!("it failed ({status}){}", why.collect::<String>())
            }
            Some(_) if self.decoder.is_some() && last != DONE => {
                format!("it ended without `{DONE}`; its last line was {last:?}")
            }
            Some(_) => return Ok(()),
        };
        Err(Error::qemu(self.name, what))
    }

    /// Decodes until the stream ends.
    fn listen(
        &mut self,
        log: &mut Log,
        bytes: &Receiver<Vec<u8>>,
        on_line: &mut impl FnMut(&str) -> Result<()>,
    ) -> Result<()> {
        let (name, patience) = (self.name, self.patience);
        let wrong = |what| Err(Error::qemu(name, what));
        // Only whole messages are progress: a firmware that spews rubbish hangs as well.
        let mut progress = Instant::now();
        let mut junk = 0;
        loop {
            let left = patience.saturating_sub(progress.elapsed());
            let chunk = match bytes.recv_timeout(left) {
                Ok(chunk) if !left.is_zero() => chunk,
                Err(RecvTimeoutError::Disconnected) => break,
                Ok(_) | Err(RecvTimeoutError::Timeout) => {
                    let last = &log.last;
                    return wrong(format!(
                        "no progress for {patience:?}, killed; the last line was {last:?}"
                    ));
                }
            };
            log.raw.extend(&chunk);
            junk += chunk.len();
            let Some(decoder) = &mut self.decoder else {
                return wrong(log.not_defmt());
            };
            decoder.received(&chunk);
            loop {
                let Line { text, is_error } = match decoder.decode() {
                    Ok(line) => line,
                    Err(DecodeError::UnexpectedEof) => break,
                    Err(DecodeError::Malformed) => return wrong(log.not_defmt()),
                };
                (progress, junk) = (Instant::now(), 0);
                if is_error && text.starts_with("panic") {
                    return wrong(format!("the firmware panicked: {text}"));
                }
                on_line(&text)?;
                if is_error {
                    log.complaint = Some(text.clone());
                }
                log.last = text;
            }
            if junk > MOST_JUNK {
                return wrong(log.not_defmt());
            }
            if log.raw.len() > MOST_LOG {
                return wrong(format!("it logged more than {} MB, killed", MOST_LOG >> 20));
            }
        }
        // rzCOBS ends each frame with a zero; what follows the last one was never decoded.
        match log.raw.last() {
            None | Some(0) => Ok(()),
            Some(_) => wrong(log.not_defmt()),
        }
    }
}

impl Log {
    fn not_defmt(&self) -> String {
        let frames = self.raw.split(|byte| *byte == 0);
        let last = frames.rev().find(|frame| !frame.is_empty()).unwrap_or(&[]);
        let end = String::from_utf8_lossy(&last[last.len().saturating_sub(200)..]);
        format!("its output is not the defmt log that was expected; it ends with {end:?}")
    }
}

/// Reads in a thread of its own, since a read cannot be given a deadline.
pub fn bytes_of(mut pipe: impl Read + Send + 'static) -> Receiver<Vec<u8>> {
    let (sender, receiver) = mpsc::sync_channel(CHUNKS);
    thread::spawn(move || {
        let mut buffer = [0; 4096];
        while let Ok(n @ 1..) = pipe.read(&mut buffer) {
            if sender.send(buffer[..n].to_vec()).is_err() {
                break;
            }
        }
    });
    receiver
}

/// The text on stderr so far; it only completes an error message, so nothing waits for it
/// for long.
pub fn said(stderr: &Receiver<Vec<u8>>) -> String {
    let end = Instant::now() + GRACE;
    let mut text = Vec::new();
    while text.len() < MOST_SAID
        && let Ok(chunk) = stderr.recv_timeout(end.saturating_duration_since(Instant::now()))
    {
        text.extend(chunk);
    }
    String::from_utf8_lossy(&text).trim().to_owned()
}
