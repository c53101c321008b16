//! The processes that xtask started: they end with it, and on a signal that ends it.
//!
//! A child runs in a process group of its own, because cargo starts compilers that outlive it: on
//! SIGINT, SIGTERM and SIGHUP the whole group is told to end.

use std::collections::BTreeSet;
use std::io;
use std::process::{Child, Command, ExitStatus};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// The groups that run, by the number of their first process.
static RUNNING: Mutex<BTreeSet<u32>> = Mutex::new(BTreeSet::new());

/// The exit code of a program that SIGTERM ended, as a shell reports it.
#[cfg(unix)]
const INTERRUPTED: i32 = 128 + 15;
#[cfg(not(unix))]
const INTERRUPTED: i32 = 1;

fn running() -> MutexGuard<'static, BTreeSet<u32>> {
    RUNNING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Ends all running processes on a signal that ends xtask.
pub fn end_with_us() -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(|| {
        // Kept locked: nothing is started from now on.
        let groups = running();
        for group in groups.iter() {
            end(*group);
        }
        std::process::exit(INTERRUPTED);
    })
}

#[cfg(unix)]
fn end(group: u32) {
    use nix::sys::signal::{Signal, killpg};
    use nix::unistd::Pid;
    // It fails if all its processes have ended, which is what is wanted.
    let _ = killpg(Pid::from_raw(group.cast_signed()), Signal::SIGTERM);
}

#[cfg(not(unix))]
fn end(_: u32) {}

/// Tells a process to end, where there are signals; it may still write what it has.
pub fn tell_to_end(child: &Child) {
    end(child.id());
}

/// Waits for a process and returns its status, or nothing if the time runs out.
pub fn within(child: &mut Child, limit: Duration) -> io::Result<Option<ExitStatus>> {
    let start = Instant::now();
    loop {
        let status = child.try_wait()?;
        if status.is_some() || start.elapsed() > limit {
            return Ok(status);
        }
        thread::sleep(Duration::from_millis(5));
    }
}

pub fn kill(child: &mut Child) {
    // Both fail only if it has ended already, which is what is wanted.
    let _ = child.kill();
    let _ = child.wait();
}

/// A process group that runs; when dropped, what is left of it is ended.
#[derive(Debug)]
pub struct Group(u32);

impl Group {
    /// Starts a command in a group of its own.
    pub fn spawn(command: &mut Command) -> io::Result<(Child, Self)> {
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(command, 0);
        // Locked across the start: there is no moment in which it runs and nobody knows.
        let mut running = running();
        let child = command.spawn()?;
        running.insert(child.id());
        let group = Self(child.id());
        Ok((child, group))
    }
}

impl Drop for Group {
    fn drop(&mut self) {
        running().remove(&self.0);
        end(self.0);
    }
}
