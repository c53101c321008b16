//! A process with bounds on its time and on what it writes; with it ends all that it started.

use std::io::{self, Read, Write as _};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::{Duration, Instant};

use crate::limits::MOST_MESSAGES;

/// Between two looks whether a process has ended.
const PAUSE: Duration = Duration::from_millis(2);
/// The time that messages may take to arrive after the end of a process.
const REST: Duration = Duration::from_millis(500);

/// The resources that a process may use.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Time from its start to its end.
    pub time: Duration,
    /// The number of bytes on its stdout.
    pub bytes: usize,
}

/// The end of a process that wrote no more than it may, in time.
#[derive(Debug)]
pub struct Ended {
    /// Its exit status; none after a signal.
    pub code: Option<i32>,
    /// The output of the process on stdout.
    pub stdout: Vec<u8>,
    /// The end of what it wrote to stderr.
    pub messages: Vec<u8>,
}

/// Why a process has no result.
#[derive(Debug)]
pub enum Failure {
    /// It cannot be started or waited for.
    System(io::Error),
    /// It needs more time than it may; it was ended.
    Time,
    /// It writes more to stdout than it may; it was ended.
    Bytes,
}

/// Runs a command with a text on its stdin, in a group of processes of its own, which is ended with
/// it.
///
/// # Errors
/// [`Failure`].
pub fn run(command: &mut Command, input: Vec<u8>, bounds: Bounds) -> Result<Ended, Failure> {
    let deadline = Instant::now() + bounds.time;
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(command, 0);
    let piped = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = piped.spawn().map_err(Failure::System)?;
    if let Some(mut stdin) = child.stdin.take() {
        // A process that does not read must not block this one; one that ends early says why on
        // stderr.
        thread::spawn(move || stdin.write_all(&input));
    }
    let stdout = in_thread(child.stdout.take(), move |pipe| beginning(pipe, bounds.bytes));
    let stderr = in_thread(child.stderr.take(), ending);
    let done = finished(&mut child, &stdout, deadline, bounds.bytes);
    end(&mut child);
    let (code, stdout) = done?;
    Ok(Ended { code, stdout, messages: stderr.recv_timeout(REST).unwrap_or_default() })
}

/// The exit status and the stdout of a process that ends before the deadline.
fn finished(
    child: &mut Child,
    stdout: &Receiver<Vec<u8>>,
    deadline: Instant,
    bytes: usize,
) -> Result<(Option<i32>, Vec<u8>), Failure> {
    let left = deadline.saturating_duration_since(Instant::now());
    let stdout = stdout.recv_timeout(left).map_err(|_| Failure::Time)?;
    if stdout.len() > bytes {
        return Err(Failure::Bytes);
    }
    loop {
        if let Some(status) = child.try_wait().map_err(Failure::System)? {
            return Ok((status.code(), stdout));
        }
        if Instant::now() > deadline {
            return Err(Failure::Time);
        }
        thread::sleep(PAUSE);
    }
}

/// The bytes that a thread reads from a pipe, when it has read them.
fn in_thread<P: Read + Send + 'static>(
    pipe: Option<P>,
    read: impl FnOnce(P) -> Vec<u8> + Send + 'static,
) -> Receiver<Vec<u8>> {
    let (sender, receiver) = channel();
    thread::spawn(move || {
        // Nobody may be waiting any more.
        let _ = sender.send(pipe.map(read).unwrap_or_default());
    });
    receiver
}

/// At most one byte more than `bytes`.
fn beginning(pipe: impl Read, bytes: usize) -> Vec<u8> {
    let mut read = Vec::new();
    let _ = pipe.take(bytes as u64 + 1).read_to_end(&mut read);
    read
}

/// The last bytes; all are read, so that the process is not blocked.
fn ending(mut pipe: impl Read) -> Vec<u8> {
    let (mut kept, mut block) = (Vec::new(), [0; MOST_MESSAGES]);
    while let Ok(n @ 1..) = pipe.read(&mut block) {
        kept.extend_from_slice(&block[..n]);
        kept.drain(..kept.len().saturating_sub(MOST_MESSAGES));
    }
    kept
}

/// Ends a process and those that it started, and waits for it.
fn end(child: &mut Child) {
    #[cfg(unix)]
    {
        use nix::sys::signal::{Signal, killpg};
        // It fails if all of them have ended, which is what is wanted.
        let _ = killpg(nix::unistd::Pid::from_raw(child.id().cast_signed()), Signal::SIGKILL);
    }
    let _ = child.kill();
    let _ = child.wait();
}
