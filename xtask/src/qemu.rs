//! Runs firmware in QEMU and decodes its log as it comes.

use std::io::Read;
use std::path::Path;
use std::process::{Child, ChildStdout, Command, Stdio};
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use defmt_decoder::{DecodeError, Table};

use crate::error::{Error, Result};
use crate::shell;
use crate::toolchain::release;

const PROGRAM: &str = "qemu-system-arm";

/// The line a firmware ends with.
pub const DONE: &str = "done";

/// How long a firmware may stay silent.
const PATIENCE: Duration = Duration::from_secs(60);

/// The QEMU of this machine.
pub struct Qemu {
    /// What it says of itself.
    pub version: String,
}

/// A firmware in QEMU.
pub struct Run<'a> {
    /// The name in messages.
    pub name: &'a str,
    /// The firmware.
    pub elf: &'a Path,
    /// The cycle meter and the file that it writes, if its regions are to be measured.
    pub meter: Option<(&'a Path, &'a Path)>,
    /// Whether it logs, and then ends with [`DONE`]; one that does not must stay silent.
    pub logs: bool,
}

/// Kills QEMU whichever way we leave.
struct Guard(Child);

impl Drop for Guard {
    fn drop(&mut self) {
        // Both fail only if it has ended already, which is what is wanted.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

impl Qemu {
    /// Whether there is one.
    pub fn is_installed() -> bool {
        shell::succeeds(Command::new(PROGRAM).arg("--version"))
    }

    /// Asks QEMU for its version.
    ///
    /// # Errors
    /// It cannot be asked, or the cycle meter is not made for it.
    pub fn find() -> Result<Self> {
        let text = shell::capture(Command::new(PROGRAM).arg("--version"))?;
        let version = text.lines().next().unwrap_or_default().trim().to_owned();
        let qemu = Self { version };
        qemu.takes_the_meter()?;
        Ok(qemu)
    }

    /// Fails if this QEMU does not take the cycle meter.
    fn takes_the_meter(&self) -> Result<()> {
        // 9.0 took away what version 1 of the plugin API had: QEMU refuses such plugins since.
        if ((4, 2)..(9, 0)).contains(&release(&self.version)) {
            return Ok(());
        }
        Err(Error::check(format!(
            "{} does not take the cycle meter, which speaks version 1 of QEMU's plugin API: \
             that is QEMU 4.2 to 8.2",
            self.version
        )))
    }

    /// Runs a firmware to its end and hands over its log line by line; returns the raw bytes
    /// of the log.
    ///
    /// # Errors
    /// QEMU ends with another code than zero, the firmware logs a panic, stays silent for
    /// [`PATIENCE`], or ends without [`DONE`]; its output is not defmt.
    pub fn run(
        &self,
        run: &Run<'_>,
        mut on_line: impl FnMut(&str) -> Result<()>,
    ) -> Result<Vec<u8>> {
        let failed = |what: String| Error::Qemu {
            program: run.name.to_owned(),
            what,
        };
        let elf = std::fs::read(run.elf).map_err(Error::file("read", run.elf))?;
        let table = Table::parse(&elf)
            .map_err(|e| failed(format!("its defmt strings cannot be read: {e:#}")))?;
        if run.logs && table.is_none() {
            return Err(failed(
                "it has no defmt strings: was it linked with defmt.x?".into(),
            ));
        }

        let mut command = command(run);
        let mut child = Guard(command.spawn().map_err(|e| Error::spawn(&command, e))?);
        let stdout = child.0.stdout.take().expect("stdout is piped");
        let mut stderr = child.0.stderr.take().expect("stderr is piped");
        let said = thread::spawn(move || {
            let mut text = String::new();
            // What QEMU says is decoration of an error message: a broken pipe is no news.
            let _ = stderr.read_to_string(&mut text);
            text
        });

        let mut log = Log {
            table: table.as_ref().filter(|_| run.logs),
            raw: Vec::new(),
            last: String::new(),
            complaint: None,
        };
        let heard = log.listen(&bytes_of(stdout), &mut on_line);
        if matches!(heard, Err(Heard::Wrong(_) | Heard::Callback(_))) {
            let _ = child.0.kill();
        }
        let status = child.0.wait().map_err(|e| Error::spawn(&command, e))?;
        let said = said.join().unwrap_or_default();
        let said = match said.trim() {
            "" => String::new(),
            text => format!("\nQEMU said: {text}"),
        };
        match heard {
            Err(Heard::Callback(error)) => return Err(error),
            Err(Heard::Wrong(what)) => return Err(failed(format!("{what}{said}"))),
            Ok(()) => {}
        }
        if !status.success() {
            let why = log.complaint.map(|line| format!(": {line}"));
            return Err(failed(format!(
                "it failed ({status}){}{said}",
                why.unwrap_or_default()
            )));
        }
        if run.logs && log.last != DONE {
            return Err(failed(format!(
                "it ended without `{DONE}`; its last line was {:?}{said}",
                log.last
            )));
        }
        if !said.is_empty() {
            eprintln!("{}", said.trim());
        }
        Ok(log.raw)
    }
}

/// The command line of a run.
fn command(run: &Run<'_>) -> Command {
    let mut command = Command::new(PROGRAM);
    command
        .args(["-machine", "netduinoplus2", "-nographic"])
        .args(["-monitor", "none", "-serial", "none"])
        .args(["-icount", "shift=3,sleep=off"])
        .args(["-semihosting-config", "enable=on,target=native"]);
    if let Some((plugin, out)) = run.meter {
        command
            .arg("-plugin")
            .arg(format!("{},out={}", plugin.display(), out.display()));
    }
    command
        .arg("-kernel")
        .arg(run.elf)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

/// Reads in a thread of its own, since a read cannot be given a deadline.
fn bytes_of(mut stdout: ChildStdout) -> mpsc::Receiver<Vec<u8>> {
    let (sender, receiver) = mpsc::channel();
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

/// Why listening stopped before the end.
enum Heard {
    /// The firmware or QEMU did something wrong.
    Wrong(String),
    /// Whoever gets the lines refused one.
    Callback(Error),
}

struct Log<'t> {
    /// None if it must stay silent.
    table: Option<&'t Table>,
    raw: Vec<u8>,
    last: String,
    /// The last line at the level of an error.
    complaint: Option<String>,
}

impl Log<'_> {
    /// Decodes until the stream ends.
    fn listen(
        &mut self,
        bytes: &mpsc::Receiver<Vec<u8>>,
        on_line: &mut impl FnMut(&str) -> Result<()>,
    ) -> std::result::Result<(), Heard> {
        let mut decoder = self.table.map(Table::new_stream_decoder);
        // Only whole messages are progress: a firmware that spews rubbish hangs as well.
        let mut progress = Instant::now();
        loop {
            let left = PATIENCE.saturating_sub(progress.elapsed());
            match bytes.recv_timeout(left) {
                Ok(chunk) => {
                    self.raw.extend(&chunk);
                    match &mut decoder {
                        Some(decoder) => decoder.received(&chunk),
                        None => return Err(Heard::Wrong(self.not_defmt())),
                    }
                }
                Err(mpsc::RecvTimeoutError::Disconnected) => break,
                Err(mpsc::RecvTimeoutError::Timeout) => {
                    return Err(Heard::Wrong(format!(
                        "no progress for {} s, killed; the last line was {:?}",
                        PATIENCE.as_secs(),
                        self.last
                    )));
                }
            }
            while let Some(decoder) = &mut decoder {
                let frame = match decoder.decode() {
                    Ok(frame) => frame,
                    Err(DecodeError::UnexpectedEof) => break,
                    Err(DecodeError::Malformed) => return Err(Heard::Wrong(self.not_defmt())),
                };
                let line = frame.display_message().to_string();
                let error = frame.level().is_some_and(|level| level.as_str() == "error");
                if error && line.starts_with("panic") {
                    return Err(Heard::Wrong(format!("the firmware panicked: {line}")));
                }
                if error {
                    self.complaint = Some(line.clone());
                }
                progress = Instant::now();
                on_line(&line).map_err(Heard::Callback)?;
                self.last = line;
            }
        }
        // rzCOBS ends each frame with a zero; what follows the last one was never decoded.
        match self.raw.last() {
            None | Some(0) => Ok(()),
            Some(_) => Err(Heard::Wrong(self.not_defmt())),
        }
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

#[cfg(test)]
mod tests {
    use super::Qemu;

    #[test]
    fn a_qemu_with_another_plugin_api_is_named() {
        let takes = |version: &str| {
            Qemu {
                version: format!("QEMU emulator version {version} (somewhere's)"),
            }
            .takes_the_meter()
            .map_err(|error| error.to_string())
        };
        for version in ["4.2.0", "7.2.22", "8.2.0"] {
            assert_eq!(takes(version), Ok(()), "{version}");
        }
        for version in ["4.1.0", "9.0.1", "10.0.2"] {
            assert!(
                takes(version).is_err_and(|m| m.contains(version)),
                "{version}"
            );
        }
    }
}
