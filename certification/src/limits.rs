//! What is proven of a robot itself, whatever the code: the speeds of its links, and a floor of the
//! least eigenvalue of its inertia matrix.

use std::fmt::Write as _;

use serde::{Deserialize, Serialize};

use crate::bodies;
use crate::digits::short;
use crate::error::{Error, Result};
use crate::floor::{self, Floor};
use crate::image::Image;
use crate::inertias::{self, Band, Bands};
use crate::program::Program;
use crate::speeds::{self, Speed, Speeds};
use crate::state_box::Robot;

/// What is proven of a robot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Limits {
    /// The robot's name.
    pub robot: String,
    /// The speeds of its bodies, as their list has them.
    pub speeds: Vec<Speeds>,
    /// The floor of the least eigenvalue of the inertia matrix.
    pub floor: Floor,
    /// What inertias can change of the torques, if a percentage is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bands: Option<Bands>,
}

/// Parts of the positions for each speed; for each floor that is tried.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// See [`speeds::prove`].
    pub speeds: usize,
    /// See [`floor::prove`].
    pub floor: usize,
    /// The percentage of [`Bands`], and what is spent on them.
    pub inertias: Option<(f64, inertias::Effort)>,
}

impl Limits {
    /// Of the robot that a program carries.
    ///
    /// # Errors
    /// [`Error::Missing`], [`Error::Robot`], [`Error::Limit`].
    pub fn of(program: &Program, robot: &Robot, effort: Effort) -> Result<Self> {
        let bodies = bodies::read(&Image::read(&program.elf)?)?;
        let positions = &robot.whole()[..robot.joints.len()];
        let most: Vec<f64> = robot.joints.iter().map(|joint| joint.speed).collect();
        let bands = effort
            .inertias
            .map(|(percent, effort)| Bands::prove(&bodies, robot, percent, effort));
        let limits = Self {
            bands: bands.transpose()?,
            robot: program.robot.clone(),
            speeds: speeds::prove(&bodies, positions, &most, effort.speeds),
            floor: floor::prove(
                &bodies,
                positions,
                &vec![1.0; positions.len()],
                effort.floor,
            ),
        };
        limits.check()?;
        Ok(limits)
    }

    /// Fails if something was found that the proofs exclude.
    ///
    /// # Errors
    /// [`Error::Limit`].
    pub fn check(&self) -> Result<()> {
        let above = |what: &'static str, body: usize, of: Speed| match of.found > of.bound {
            true => Err(Error::Limit {
                what: format!("{what} of body {body}"),
                proven: of.bound,
                found: of.found,
            }),
            false => Ok(()),
        };
        for one in &self.speeds {
            above("angular velocity", one.body, one.turning)?;
            above("velocity of the joint", one.body, one.joint)?;
            above("velocity of the centre of mass", one.body, one.mass)?;
        }
        let bands = self.bands.iter().flat_map(|bands| &bands.joints);
        for (joint, Band { bound, found }) in bands.enumerate() {
            if bound.is_nan() || found > bound {
                return Err(Error::Limit {
                    what: format!("torque of joint {} by inertias", joint + 1),
                    proven: *bound,
                    found: *found,
                });
            }
        }
        let Floor { floor, least, .. } = self.floor;
        match least < floor {
            true => Err(Error::Limit {
                what: "least eigenvalue of the inertia matrix".to_owned(),
                proven: floor,
                found: least,
            }),
            false => Ok(()),
        }
    }

    /// As a table and a sentence.
    pub fn markdown(&self) -> String {
        let mut text = "| body | angular velocity, rad/s: at most | found | its joint, m/s: at most | found | its centre of mass, m/s: at most | found \
                        |\n|---|---|---|---|---|---|---|\n"
            .to_owned();
        for one in &self.speeds {
            let _ = write!(text, "| {} |", one.body);
            for Speed { bound, found } in [one.turning, one.joint, one.mass] {
                let _ = write!(text, " {bound:.3} | {found:.3} |");
            }
            text.push('\n');
        }
        let Floor { floor, least, .. } = self.floor;
        let _ = write!(
            text,
            "\nThe least eigenvalue of the inertia matrix of the links, without rotors, is above {} (SI units) at every position; the least that was \
             found is {}, and the floor {:.3} of it.\n",
            short(floor),
            short(least),
            self.floor.ratio(),
        );
        if let Some(bands) = &self.bands {
            text = text + "\n" + &bands.markdown();
        }
        text
    }
}
