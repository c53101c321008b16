//! Bytes from a serial port, from a program, or from a file.

use std::io::{ErrorKind, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use crate::error::{Error, Result};

/// The placeholder in a program's arguments for the number of the TCP port that it connects to.
pub const TCP_PORT: &str = "{port}";

/// The source of the bytes.
#[derive(Clone, Debug)]
pub enum Place {
    /// A serial port and its rate, bit/s.
    Port(String, u32),
    /// A program that connects its serial line to a TCP port of this machine, such as QEMU.
    Program(Vec<String>),
    /// A file of bytes received earlier.
    File(PathBuf),
}

/// A line in both directions.
trait Line: Read + Write + Send {}
impl<T: Read + Write + Send> Line for T {}

/// Bytes as they come, and the program that sends them, which ends with it.
pub struct Source {
    /// The port, program or file, for messages.
    pub name: String,
    bytes: Box<dyn Line>,
    child: Option<Child>,
}

impl Place {
    /// Opens it.
    ///
    /// # Errors
    /// There is no such port, program or file, or the program does not connect.
    pub fn open(&self) -> Result<Source> {
        match self {
            Self::Port(port, rate) => open_port(port, *rate),
            Self::Program(words) => start(words),
            Self::File(path) => open_file(path),
        }
    }
}

fn open_port(port: &str, rate: u32) -> Result<Source> {
    let opened = serialport::new(port, rate).timeout(Duration::from_millis(100));
    let bytes = opened.open().map_err(|source| Error::Port {
        port: port.to_owned(),
        source,
        ports: ports(),
    })?;
    Ok(Source { name: port.to_owned(), bytes: Box::new(bytes), child: None })
}

/// The serial ports of this machine, as a sentence.
fn ports() -> String {
    let found = serialport::available_ports().unwrap_or_default();
    let names: Vec<String> = found.into_iter().map(|port| port.port_name).collect();
    match names.as_slice() {
        [] => "this machine has no serial port".to_owned(),
        names => format!("this machine has {}", names.join(", ")),
    }
}

fn open_file(path: &Path) -> Result<Source> {
    let name = path.display().to_string();
    let file = std::fs::File::open(path)
        .map_err(|source| Error::Read { source_name: name.clone(), source })?;
    Ok(Source { name, bytes: Box::new(file), child: None })
}

fn start(words: &[String]) -> Result<Source> {
    let program = words.first().cloned().unwrap_or_default();
    let failed = |source| Error::Start { program: program.clone(), source };
    let listener = TcpListener::bind("127.0.0.1:0").map_err(failed)?;
    listener.set_nonblocking(true).map_err(failed)?;
    let port = listener.local_addr().map_err(failed)?.port().to_string();
    let mut command = Command::new(&program);
    command.args(words.iter().skip(1).map(|word| word.replace(TCP_PORT, &port)));
    // Its log is no telemetry, and would write over the screen.
    command.stdin(Stdio::null()).stdout(Stdio::null());
    let mut child = command.spawn().map_err(failed)?;
    let stream = accept(&listener, &mut child, &program)?;
    Ok(Source { name: program, bytes: Box::new(stream), child: Some(child) })
}

/// Waits until the program connects or ends.
fn accept(listener: &TcpListener, child: &mut Child, program: &str) -> Result<TcpStream> {
    let failed = |source| Error::Start { program: program.to_owned(), source };
    loop {
        match listener.accept() {
            Ok((stream, _)) => {
                stream.set_nonblocking(false).map_err(failed)?;
                stream.set_nodelay(true).map_err(failed)?;
                let timeout = Some(Duration::from_millis(100));
                stream.set_read_timeout(timeout).map_err(failed)?;
                return Ok(stream);
            }
            Err(error) if error.kind() == ErrorKind::WouldBlock => {}
            Err(error) => return Err(failed(error)),
        }
        if let Some(status) = child.try_wait().map_err(failed)? {
            return Err(Error::Ended { program: program.to_owned(), status });
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}

impl Source {
    /// The next bytes: none if there are none yet, and `None` at the end.
    ///
    /// # Errors
    /// The port or file cannot be read, or the program failed.
    pub fn read<'b>(&mut self, buffer: &'b mut [u8]) -> Result<Option<&'b [u8]>> {
        match self.bytes.read(buffer) {
            Ok(0) => self.end().map(|()| None),
            Ok(length) => Ok(Some(&buffer[..length])),
            Err(error) => match error.kind() {
                ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted => {
                    Ok(Some(&[]))
                }
                ErrorKind::ConnectionReset => self.end().map(|()| None),
                _ => Err(Error::Read { source_name: self.name.clone(), source: error }),
            },
        }
    }

    /// Sends bytes.
    ///
    /// # Errors
    /// The port or program does not take them; a file takes none.
    pub fn send(&mut self, bytes: &[u8]) -> Result<()> {
        self.bytes
            .write_all(bytes)
            .map_err(|source| Error::Read { source_name: self.name.clone(), source })
    }

    /// Waits for the end of a program that has closed its line.
    fn end(&mut self) -> Result<()> {
        let Some(mut child) = self.child.take() else {
            return Ok(());
        };
        let status = child
            .wait()
            .map_err(|source| Error::Read { source_name: self.name.clone(), source })?;
        if status.success() {
            return Ok(());
        }
        let program = self.name.clone();
        Err(Error::Failed { program, status })
    }
}

impl Drop for Source {
    fn drop(&mut self) {
        if let Some(child) = &mut self.child {
            // Both fail only if it has ended already.
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}
