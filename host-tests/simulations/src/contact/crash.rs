//! A run into a wall.

use dynamics_core::effects::Effect;
use firmware_demo::digest::Digest;
use firmware_demo::scene::TICK;
use firmware_demo::trajectories::HOME;
use glam::Vec3;
use motion_control::{ContactResponse, MotionLimits, Trajectory, WayPoint};

use super::firmware::{Cell, Firmware, Sensing};
use super::path::Off;
use super::plant::{Plant, Wall, tip};

/// Speed of the tip at the contact, m/s.
pub const SPEED: f32 = 0.25;
/// Those of ISO/TS 15066 for a hand and for the chest, N/m.
pub const STIFFNESSES: [f32; 2] = [75e3, 10e3];
/// The reactions to a contact, with their names.
pub const RESPONSES: [(&str, Option<ContactResponse<f32>>); 4] = [
    ("stop", Some(ContactResponse::Stop)),
    (
        "retract",
        Some(ContactResponse::Retract {
            distance: 0.1,
            limits: MotionLimits {
                velocity: 0.5,
                acceleration: 4.0,
            },
        }),
    ),
    (
        "float",
        Some(ContactResponse::Float {
            damping: 5.0,
            speed: 0.5,
        }),
    ),
    ("none", None),
];
/// The end of the motion, which is the first one of the pick and place; the wall is halfway.
const AWAY: [f32; 6] = [-0.70, -1.35, 1.75, -1.97, -1.57, -0.70];
/// Ticks that are observed from the touch on.
const OBSERVED: u32 = 1500;
/// Ticks from the touch until the force must have fallen.
const LATER: u32 = 500;
/// Steps of the plant in a tick.
const STEPS: u32 = 8;

#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Ticks since the touch.
    pub tick: i32,
    /// The force of the tip on the wall, N.
    pub force: f32,
    /// The external torques of the joints, N·m.
    pub external: [f32; 6],
    /// The thresholds of the joints, N·m.
    pub threshold: [f32; 6],
    /// Whether there is a contact by the detector.
    pub found: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// From the touch to the verdict of the detector, ticks; none without one.
    pub found: Option<u32>,
    /// The joint that the detector names.
    pub joint: Option<usize>,
    /// Ticks before the touch in which a contact was found.
    pub early: u32,
    /// The largest force of the first half second, N, and as a share of v √(k m).
    pub peak: [f32; 2],
    /// The force half a second after the touch and the largest one of the second after it, N.
    pub later: [f32; 2],
    /// The digest of all torques.
    pub digest: Digest,
}

/// Runs an arm against a wall of this stiffness, N/m. Nothing if its motion exceeds its limits or
/// it has no forward dynamics.
pub fn run<F: Effect<f32, 6, 6> + Clone>(
    stiffness: f32,
    response: Option<ContactResponse<f32>>,
    sensing: Sensing,
    (inertia, friction): ([f32; 6], F),
    mut observe: impl FnMut(Sample),
) -> Option<Outcome> {
    let plan = |ticks: u32| {
        let stop = |q, ticks| WayPoint {
            q,
            qd: [0.0; 6],
            ticks,
        };
        let limits = MotionLimits {
            velocity: 3.0,
            acceleration: 10.0,
        };
        let points = [stop(HOME, 0), stop(AWAY, ticks)];
        Trajectory::<f32, 6, 2>::new(&points, TICK, &[limits; 6]).ok()
    };
    // The tip is fastest halfway, where the wall is.
    let [_, slow] = tip(&plan(8000)?.at(4000));
    let motion = plan((8000.0 * slow.length() / SPEED) as u32)?;
    let middle = motion.at(motion.ticks() / 2);
    let [origin, velocity] = tip(&middle);
    let mut plant = Plant::new(HOME, inertia, friction);
    plant.wall = Wall {
        origin,
        normal: velocity.normalize(),
        stiffness,
        loss: 0.0,
        hand: Vec3::ZERO,
    };
    let free = SPEED * libm::sqrtf(stiffness * plant.mass(&middle.q).ok()?);
    let mut cell = Cell::new(Firmware::new(sensing, response).ok()?, plant);
    let mut outcome = Outcome {
        found: None,
        joint: None,
        early: 0,
        peak: [0.0; 2],
        later: [0.0; 2],
        digest: Digest::EMPTY,
    };
    // Ticks since the touch.
    let (mut touched, mut tick) = (None, 0);
    while touched.is_none_or(|since| since < OBSERVED) && tick < motion.ticks() + OBSERVED {
        let force = cell.plant.force();
        let command = cell.tick(&motion, STEPS).ok()?;
        outcome.digest.add(command.torque);
        let contact = cell.firmware.contact;
        if touched.is_none() && force > 0.0 {
            touched = Some(0);
        }
        match &mut touched {
            None => outcome.early += u32::from(contact.is_some()),
            Some(since) => {
                if outcome.found.is_none() && contact.is_some() {
                    outcome.found = Some(*since);
                    outcome.joint = contact.map(|contact| contact.joint);
                }
                match *since {
                    ..LATER => outcome.peak[0] = outcome.peak[0].max(force),
                    LATER => outcome.later = [force; 2],
                    _ => outcome.later[1] = outcome.later[1].max(force),
                }
                *since += 1;
            }
        }
        observe(Sample {
            tick: touched.map_or(tick as i32 - motion.ticks() as i32 / 2, |since| {
                since as i32
            }),
            force,
            external: *cell.firmware.detector.external_torque(),
            threshold: cell.firmware.detector.threshold(),
            found: contact.is_some(),
        });
        tick += 1;
    }
    outcome.peak[1] = outcome.peak[0] / free;
    Some(outcome)
}

/// Signs of the model errors: inertias are off by 3 %, friction by 10 %.
pub const SIGNS: u32 = 0b10_1010;

/// The kinds of friction: that of the model, and that of bristles.
pub const FRICTIONS: [&str; 2] = ["Coulomb", "LuGre"];

/// A [`run`] with encoders of 14 bits and one of [`FRICTIONS`].
pub fn either(
    stiffness: f32,
    response: Option<ContactResponse<f32>>,
    friction: &str,
    off: &Off,
    observe: impl FnMut(Sample),
) -> Option<Outcome> {
    let smooth = Sensing::BITS_14;
    match friction == FRICTIONS[0] {
        true => run(
            stiffness,
            response,
            smooth,
            (off.inertia, off.smooth()),
            observe,
        ),
        false => run(
            stiffness,
            response,
            smooth.sticking(),
            (off.inertia, off.sticking()),
            observe,
        ),
    }
}
