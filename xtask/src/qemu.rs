//! Runs firmware in QEMU and decodes its log as it comes.

#[cfg(all(test, unix))]
mod tests;
mod watch;

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use defmt_decoder::{DecodeError, StreamDecoder, Table};

use crate::error::{Error, Result};
use crate::shell;
use crate::toolchain::release;
use watch::{Decoder, Line, Watch};

const PROGRAM: &str = "qemu-system-arm";

/// The line a firmware ends with.
pub const DONE: &str = "done";

/// How long a firmware may stay silent.
const PATIENCE: Duration = Duration::from_secs(60);

/// The first and the last QEMU that take the cycle meter: 9.0 took away what version 1 of the plugin
/// interface had, and refuses such plugins since.
const TAKEN: [(u32, u32); 2] = [(4, 2), (8, 2)];

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

/// The versions that take the cycle meter, in words.
pub fn versions() -> String {
    let [(a, b), (c, d)] = TAKEN;
    format!("{a}.{b} to {c}.{d}")
}

/// What to do where the system brings another version.
pub fn another_version() -> String {
    let [_, (major, minor)] = TAKEN;
    format!(
        "either work in a container of Debian 12 or Ubuntu 24.04, whose `qemu-system-arm` does: \
         `docker run -it -v \"$PWD\":/work -w /work debian:12`; or build QEMU {major}.{minor} from \
         https://download.qemu.org with `./configure --target-list=arm-softmmu --enable-plugins && \
         make`, and put its build directory first on the PATH"
    )
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
        let [oldest, newest] = TAKEN;
        if (oldest..=newest).contains(&release(&self.version)) {
            return Ok(());
        }
        Err(Error::check(format!(
            "{} does not take the cycle meter, which speaks version 1 of QEMU's plugin interface: \
             that is QEMU {}; {}",
            self.version,
            versions(),
            another_version()
        )))
    }

    /// Runs a firmware to its end and hands over its log line by line; returns the raw bytes
    /// of the log.
    ///
    /// # Errors
    /// QEMU ends with another code than zero, the firmware logs a panic, stays silent for
    /// [`PATIENCE`], or ends without [`DONE`]; its output is not defmt or has no end.
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
        let table = table.as_ref().filter(|_| run.logs);
        let watch = Watch {
            name: run.name,
            patience: PATIENCE,
            decoder: table.map(|table| Box::new(Defmt(table.new_stream_decoder())) as _),
        };
        watch.run(&mut command(run), &mut on_line)
    }
}

/// defmt's frames as lines.
struct Defmt<'t>(Box<dyn StreamDecoder + Send + Sync + 't>);

impl Decoder for Defmt<'_> {
    fn received(&mut self, bytes: &[u8]) {
        self.0.received(bytes);
    }

    fn decode(&mut self) -> std::result::Result<Line, DecodeError> {
        let frame = self.0.decode()?;
        let is_error = frame.level().is_some_and(|level| level.as_str() == "error");
        Ok(Line {
            text: frame.display_message().to_string(),
            is_error,
        })
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
