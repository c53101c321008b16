//! Firmware that prints text through semihosting, on any machine.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use super::watch::{bytes_of, said};
use super::{FIXED, Qemu};
use crate::kit::error::{Error, Result};
use crate::kit::{processes, shell};

impl Qemu {
    /// Runs a firmware to its end and returns its output.
    ///
    /// # Errors
    /// QEMU cannot run it, ends with another code than zero, or does not end in time.
    pub fn text(
        &self,
        name: &str,
        machine: &[&str],
        elf: &Path,
        limit: Duration,
    ) -> Result<String> {
        let mut command = Command::new(&self.program);
        command.args(machine).args(FIXED.split(' '));
        command.args(["-serial", "none", "-semihosting-config", "enable=on,target=native"]);
        command.arg("-kernel").arg(elf);
        let (mut child, _group) = shell::spawn(shell::heard_by(&mut command, Stdio::piped))?;
        let stdout = child.stdout.take().map(bytes_of);
        let stderr = child.stderr.take().map(bytes_of);
        let status = processes::within(&mut child, limit).map_err(|e| Error::spawn(&command, e))?;
        processes::kill(&mut child);
        let [printed, complaints] =
            [stdout, stderr].map(|pipe| pipe.as_ref().map_or_else(String::new, said));
        match status {
            Some(status) if status.success() => Ok(printed),
            Some(status) => {
                let what = format!("it failed ({status}): {printed}\n{complaints}");
                Err(Error::qemu(name, what))
            }
            None => Err(Error::qemu(name, format!("it did not end within {limit:?}: {printed}"))),
        }
    }
}
