//! The controller, behind a serial line or in this process.

use std::time::{Duration, Instant};

use firmware_demo::pil::Controlled;
use firmware_demo::scenes::ur5e::PickAndPlace;
use firmware_demo::sim_io::Wires;
use telemetry::decoder::Frames;
use telemetry::encode;
use telemetry::pil::{Commanded, Measured};
use telemetry_watch::source::Source;

use crate::{Error, JOINTS};

/// The time limit of a reply; after it the request is sent again.
const REPLY: Duration = Duration::from_millis(500);
/// The largest number of times that a request is sent.
const TRIES: u32 = 10;

/// What controls the robot.
pub trait Machine {
    /// The reply to what the encoders answer.
    ///
    /// # Errors
    /// There is none.
    fn tick(&mut self, measured: &Measured<JOINTS>) -> Result<Commanded<JOINTS>, Error>;
}

/// A controller behind a serial line.
pub struct Remote {
    line: Source,
    frames: Frames,
}

impl Remote {
    #[must_use]
    pub fn new(line: Source) -> Self {
        let frames = Frames::new();
        Self { line, frames }
    }

    /// The reply of this number, if it arrives in its time.
    fn reply(&mut self, number: u32) -> Result<Option<Commanded<JOINTS>>, Error> {
        let (sent, mut buffer) = (Instant::now(), [0; 1024]);
        while sent.elapsed() < REPLY {
            let Some(bytes) = self.line.read(&mut buffer)? else {
                return Ok(None);
            };
            for &byte in bytes {
                match self.frames.push::<Commanded<JOINTS>>(byte) {
                    Some(Ok(reply)) if reply.tick.number == number => return Ok(Some(reply)),
                    // A reply that came late, or a bad frame: the request is sent again.
                    _ => {}
                }
            }
        }
        Ok(None)
    }
}

impl Machine for Remote {
    fn tick(&mut self, measured: &Measured<JOINTS>) -> Result<Commanded<JOINTS>, Error> {
        let mut buffer = [0; 256];
        let frame = encode(measured, &mut buffer).unwrap_or_default();
        for _ in 0..TRIES {
            self.line.send(frame)?;
            if let Some(reply) = self.reply(measured.number)? {
                return Ok(reply);
            }
        }
        Err(Error::Silent {
            name: self.line.name.clone(),
            number: measured.number,
            tries: TRIES,
        })
    }
}

/// The firmware's controller in this process.
pub struct Local(Controlled<PickAndPlace, 6, 6, 6, 6>);

impl Local {
    /// At the start of its trajectory.
    ///
    /// # Errors
    /// A trajectory that the arm's limits do not allow.
    pub fn new() -> Result<Self, Error> {
        // As long as the program, which makes few.
        let wires: &'static Wires<JOINTS> = Box::leak(Box::default());
        let controlled = Controlled::new(wires).map_err(|_| Error::Trajectory)?;
        Ok(Self(controlled))
    }
}

impl Machine for Local {
    fn tick(&mut self, measured: &Measured<JOINTS>) -> Result<Commanded<JOINTS>, Error> {
        Ok(self.0.tick(measured).clone())
    }
}
