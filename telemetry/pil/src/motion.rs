//! The motion of a run of a controller and a robot.

use std::path::Path;

use telemetry::pil::Measured;
use telemetry_watch::source::Place;
use telemetry_watch::{Decoder, Message};

use crate::machine::Machine;
use crate::plant::{Robot, torques};
use crate::{Error, JOINTS};

/// The references and the estimated positions of each tick, rad.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    pub references: Vec<[f32; JOINTS]>,
    pub estimates: Vec<[f32; JOINTS]>,
}

impl Motion {
    /// Runs a controller and a robot over a number of ticks.
    ///
    /// # Errors
    /// The controller does not reply, or the robot has no forward dynamics.
    pub fn of(
        machine: &mut impl Machine,
        robot: &mut impl Robot,
        ticks: u32,
    ) -> Result<Self, Error> {
        let mut motion = Self::default();
        for number in 0..ticks {
            let answers = robot.answers().into_iter().collect();
            let reply = machine.tick(&Measured { number, answers })?;
            let found = reply.tick.joints.len();
            let joints = |_| Error::Joints { number, found };
            let duties = reply.duties.into_array().map_err(|_| Error::Joints {
                number,
                found: JOINTS,
            })?;
            motion.push(&reply.tick.joints).map_err(joints)?;
            if !robot.advance(&torques(&duties)) {
                return Err(Error::Broken { number });
            }
        }
        Ok(motion)
    }

    /// The first so many ticks of a recorded firmware whose robot is inside.
    ///
    /// # Errors
    /// The file cannot be read, or lacks a tick.
    pub fn recorded(path: &Path, ticks: usize) -> Result<Self, Error> {
        let mut source = Place::File(path.to_owned()).open()?;
        let (mut decoder, mut buffer, mut motion) = (Decoder::new(), [0; 4096], Self::default());
        while let Some(bytes) = source.read(&mut buffer)? {
            for &byte in bytes {
                let Some(Ok(Message::Tick(tick))) = decoder.push(byte) else {
                    continue;
                };
                let found = motion.estimates.len();
                if found < ticks {
                    let is_next = tick.number as usize == found;
                    let pushed = is_next && motion.push(&tick.joints).is_ok();
                    if !pushed {
                        return Err(Error::Record { found, ticks });
                    }
                }
            }
        }
        let found = motion.estimates.len();
        if found < ticks {
            return Err(Error::Record { found, ticks });
        }
        Ok(motion)
    }

    /// Adds a tick, if it has the joints of the scene.
    fn push(&mut self, joints: &[telemetry::Joint]) -> Result<(), ()> {
        let joints: &[telemetry::Joint; JOINTS] = joints.try_into().map_err(|_| ())?;
        self.references.push(joints.map(|joint| joint.reference));
        self.estimates.push(joints.map(|joint| joint.estimate));
        Ok(())
    }
}
