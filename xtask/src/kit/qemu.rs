//! Runs firmware in QEMU and decodes its log as it comes.

#[cfg(all(test, unix))]
mod tests;
mod text;
mod watch;

use std::ffi::OsString;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;
use std::time::Duration;

use defmt_decoder::{DecodeError, StreamDecoder, Table};

use crate::kit::error::{Error, Result, check, refuse_if};
use crate::kit::toolchain::release;
use crate::kit::{processes, shell, unpacked};
use watch::{Decoder, Line, Watch, bytes_of, said};

pub const PROGRAM: &str = "qemu-system-arm";

/// A board with a Cortex-M4F.
pub const MACHINE: &str = "netduinoplus2";

/// The options of every run. Without `-audiodev` QEMU opens the host's sound device.
const FIXED: &str = "-nographic -audiodev none,id=silent -monitor none -icount shift=3,sleep=off";

/// A file that keeps nothing.
const NOWHERE: &str = "/dev/null";

/// The line a firmware ends with.
pub const DONE: &str = "done";

/// The longest silence of a firmware.
const PATIENCE: Duration = Duration::from_secs(60);

/// The first QEMU that is tested with the meter.
const OLDEST: (u32, u32) = (7, 0);

/// The environment variable that names the QEMU for an ARM.
pub const VARIABLE: &str = "QEMU_SYSTEM_ARM";

/// The QEMU that the user chose.
pub fn chosen() -> Option<OsString> {
    std::env::var_os(VARIABLE).filter(|program| !program.is_empty())
}

/// The time limit for QEMU to load the meter and exit.
const LOADING: Duration = Duration::from_secs(30);

#[derive(Clone)]
pub struct Qemu {
    pub version: String,
    program: PathBuf,
    /// Whether it takes the meter, once that was tried: with which version of the plugin interface,
    /// if not the one that the meter chooses; or why it does not.
    interface: OnceLock<std::result::Result<Option<i32>, String>>,
}

pub struct Run<'a> {
    pub name: &'a str,
    pub elf: &'a Path,
    /// The cycle meter and the file that it writes, if its regions are to be measured.
    pub meter: Option<(&'a Path, &'a Path)>,
    /// Whether it logs, and then ends with [`DONE`]; one that does not must stay silent.
    pub logs: bool,
    /// The value of QEMU's option `-serial`.
    pub serial: &'a str,
    /// The words of its command line.
    pub words: &'a [&'a str],
}

impl<'a> Run<'a> {
    /// A firmware that logs, and is measured if there is a meter.
    pub fn logging(name: &'a str, elf: &'a Path, meter: Option<(&'a Path, &'a Path)>) -> Self {
        Self { name, elf, meter, logs: true, serial: "none", words: &[] }
    }
}

/// Advice for a user whose QEMU does not load the meter.
pub const ANOTHER_QEMU: &str = "docker run -it -v \"$PWD\":/work -w /work debian:12
    # and in it: apt-get update && apt-get install -y cargo-web rustc-web
    # or build QEMU 10 from https://download.qemu.org, and name it by QEMU_SYSTEM_ARM:
    ./configure --target-list=arm-softmmu --enable-plugins && make";

impl Qemu {
    /// The QEMU that the user chose, or the first one that has plugins.
    ///
    /// # Errors
    /// There is none.
    pub fn find() -> Result<Self> {
        match chosen() {
            Some(program) => {
                let found = Self::at(program).and_then(Self::with_plugins);
                found.map_err(|why| check!("{VARIABLE}: {why}; another one:\n    {ANOTHER_QEMU}"))
            }
            None => Self::first(PROGRAM),
        }
    }

    /// The first emulator of a name that has plugins, on the PATH or unpacked.
    ///
    /// # Errors
    /// There is none, or none with plugins.
    pub fn first(program: &str) -> Result<Self> {
        let mut refused = None;
        for place in unpacked::places(program) {
            match Self::at(place).and_then(Self::with_plugins) {
                Ok(found) => return Ok(found),
                Err(why) => refused = refused.or(Some(why)),
            }
        }
        Err(refused.unwrap_or_else(|| check!("`{program}`, the emulator that runs the firmware")))
    }

    /// Asks a QEMU for its version.
    ///
    /// # Errors
    /// It cannot be asked.
    pub fn at(program: impl Into<PathBuf>) -> Result<Self> {
        let program = program.into();
        let text = shell::capture(Command::new(&program).arg("--version"))?;
        let version = text.lines().next().unwrap_or_default().trim().to_owned();
        Ok(Self { version, program, interface: OnceLock::new() })
    }

    /// Refuses one that cannot take the meter, as far as it shows before the meter is built: it is
    /// asked for a plugin that is not there.
    fn with_plugins(self) -> Result<Self> {
        let program = self.program.display();
        refuse_if!(cfg!(windows), "the cycle meter, a plugin of QEMU, is not for Windows");
        refuse_if!(
            release(&self.version) < OLDEST,
            "{program} is {}, and the cycle meter takes QEMU 7 to 11",
            self.version
        );
        let why = self.load(Path::new("no-plugin"), None).err().unwrap_or_default();
        refuse_if!(
            ["not enabled in this build", "invalid option"].iter().any(|says| why.contains(says)),
            "{program} ({}) was built without plugins, one of which counts the cycles",
            self.version
        );
        Ok(self)
    }

    /// With which version of the plugin interface it takes the meter, if not the one that the meter
    /// chooses. It is tried, once: what QEMU says of itself tells too little.
    ///
    /// # Errors
    /// It does not take the meter.
    pub fn interface(&self, meter: &Path) -> Result<Option<i32>> {
        let tried = self.interface.get_or_init(|| {
            let Err(why) = self.load(meter, None) else {
                return Ok(None);
            };
            // QEMU names the version next to the refused one that it would take.
            match version_named(&why) {
                Some(version) => self.load(meter, Some(version)).map(|()| Some(version)),
                None => Err(why),
            }
        });
        tried.clone().map_err(|why| {
            check!(
                "{} does not take the cycle meter, which speaks versions 1 to {} of QEMU's \
                 plugin interface ({why}); another one:\n    {ANOTHER_QEMU}",
                self.version,
                cycle_meter::NEWEST_INTERFACE
            )
        })
    }

    /// Starts QEMU with the meter and without a machine, and leaves; or says why it would not
    /// start.
    fn load(&self, meter: &Path, interface: Option<i32>) -> std::result::Result<(), String> {
        let mut command = Command::new(&self.program);
        command
            .args("-machine none -nodefaults -display none -monitor stdio -plugin".split(' '))
            .arg(format!("file={},out={NOWHERE}", doubled(meter.display())))
            .envs(interface.map(|version| (cycle_meter::INTERFACE, version.to_string())))
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped());
        let (mut child, _group) = shell::spawn(&mut command).map_err(|e| e.to_string())?;
        if let Some(mut monitor) = child.stdin.take() {
            // A QEMU that has refused and left already does not read it.
            let _ = monitor.write_all(b"quit\n");
        }
        let stderr = child.stderr.take().map(bytes_of);
        let status = processes::within(&mut child, LOADING).map_err(|e| e.to_string())?;
        let Some(status) = status else {
            processes::kill(&mut child);
            return Err(format!("it did not end within {LOADING:?}"));
        };
        if status.success() {
            return Ok(());
        }
        let said = stderr.as_ref().map_or_else(String::new, said);
        // The text after the path of the plugin, which the user did not choose.
        let why = said.rsplit_once(": ").map_or(&*said, |(_, why)| why);
        let says_nothing = why.is_empty().then(|| status.to_string());
        Err(says_nothing.unwrap_or_else(|| why.to_owned()))
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
        let elf = std::fs::read(run.elf).map_err(Error::file("read", run.elf))?;
        let table = Table::parse(&elf).map_err(|e| {
            Error::qemu(run.name, format!("its defmt strings cannot be read: {e:#}"))
        })?;
        if run.logs && table.is_none() {
            let what = "it has no defmt strings: was it linked with defmt.x?";
            return Err(Error::qemu(run.name, what));
        }
        let table = table.as_ref().filter(|_| run.logs);
        let watch = Watch {
            name: run.name,
            patience: PATIENCE,
            decoder: table.map(|table| Box::new(Defmt(table.new_stream_decoder())) as _),
        };
        watch.run(&mut self.command(MACHINE, run)?, &mut on_line)
    }

    /// As [`Qemu::run`]; returns the lines.
    pub fn lines(&self, run: &Run<'_>) -> Result<Vec<String>> {
        let mut lines = Vec::new();
        let keep = |line: &str| {
            lines.push(line.to_owned());
            Ok(())
        };
        self.run(run, keep).map(|_| lines)
    }

    /// The command line of a run.
    fn command(&self, machine: &str, run: &Run<'_>) -> Result<Command> {
        let mut command = Command::new(&self.program);
        command.args(["-machine", machine]);
        command.args(FIXED.split(' '));
        let words = [run.name].into_iter().chain(run.words.iter().copied());
        let words: String = words.map(|word| format!(",arg={}", doubled(word))).collect();
        let semihosting = format!("enable=on,target=native{words}");
        command.args(["-serial", run.serial, "-semihosting-config", &semihosting]);
        if let Some((plugin, out)) = run.meter {
            let [file, out] = [plugin, out].map(|path| doubled(path.display()));
            let plugged = format!("file={file},out={out}");
            command.args(["-plugin", &plugged]);
            let version = self.interface(plugin)?;
            command.envs(version.map(|version| (cycle_meter::INTERFACE, version.to_string())));
        }
        command.arg("-kernel").arg(run.elf);
        shell::heard_by(&mut command, Stdio::piped);
        Ok(command)
    }

    /// Appends to a listener's command line the one of a run, for the listener to start.
    ///
    /// # Errors
    /// QEMU does not take the meter.
    pub fn start_by(&self, listener: &mut Command, run: &Run<'_>) -> Result<()> {
        let command = self.command(MACHINE, run)?;
        listener.arg("--").arg(command.get_program());
        listener.args(command.get_args());
        listener.envs(command.get_envs().filter_map(|(name, value)| Some((name, value?))));
        Ok(())
    }

    /// Runs a firmware of which nothing is known on a board for so long at most, and returns
    /// whether it ended by itself; what it prints is shown if it is text.
    ///
    /// # Errors
    /// QEMU cannot run it, or ends with another code than zero.
    pub fn run_for(&self, machine: &str, run: &Run<'_>, limit: Duration) -> Result<bool> {
        let mut command = self.command(machine, run)?;
        command.stderr(Stdio::inherit());
        if run.logs {
            command.stdout(Stdio::null());
        } else {
            command.stdout(std::io::stderr());
        }
        let (mut child, _group) = shell::spawn(&mut command)?;
        let cannot_wait = |e| Error::spawn(&command, e);
        match processes::within(&mut child, limit).map_err(cannot_wait)? {
            Some(status) if status.success() => Ok(true),
            Some(status) => Err(Error::qemu(run.name, format!("it failed ({status})"))),
            None => {
                // QEMU then writes what was measured, and ends.
                processes::tell_to_end(&child);
                processes::within(&mut child, LOADING).map_err(cannot_wait)?;
                processes::kill(&mut child);
                Ok(false)
            }
        }
    }
}

/// A value among QEMU's options, where a comma that ends none of them stands twice.
fn doubled(value: impl std::fmt::Display) -> String {
    value.to_string().replace(',', ",,")
}

/// The version that QEMU would take, from why it refused another one.
fn version_named(why: &str) -> Option<i32> {
    let versions = ["minimum version of ", "only up to version "];
    let after = |words: &&str| why.split_once(*words).map(|(_, rest)| rest);
    let rest = versions.iter().find_map(after)?;
    let digits: String = rest.chars().take_while(char::is_ascii_digit).collect();
    digits.parse().ok()
}

struct Defmt<'t>(Box<dyn StreamDecoder + 't>);

impl Decoder for Defmt<'_> {
    fn received(&mut self, bytes: &[u8]) {
        self.0.received(bytes);
    }

    fn decode(&mut self) -> std::result::Result<Line, DecodeError> {
        let frame = self.0.decode()?;
        let is_error = frame.level().is_some_and(|level| level.as_str() == "error");
        Ok(Line { text: frame.display_message().to_string(), is_error })
    }
}
