//! Claims about what an arm does after a contact: a UR5e that runs against an elastic wall, and one
//! that a hand pushes. The table of `docs/guide/src/contact.md` was measured here.

mod cell;
mod plant;
mod reactions;

use self::cell::{Cell, MARGIN};
use self::plant::{MOTIONS, Off, SPEED, STIFFNESSES, Setup};
use motion_control::{limits::MotionLimits, motion::ContactResponse};

const SLOW: MotionLimits<f64> = MotionLimits { velocity: 0.5, acceleration: 4.0 };
const RETRACT: ContactResponse<f64> = ContactResponse::Retract {
    distance: 0.1, // rad
    limits: SLOW,
};
const FLOAT: ContactResponse<f64> = ContactResponse::Float { damping: 5.0, speed: 0.5 };
const RESPONSES: [ContactResponse<f64>; 3] = [ContactResponse::Stop, RETRACT, FLOAT];

/// Inertias off by 3 % from body to body and friction off by 10 %, in each combination of signs.
const OFF: [Off; 4] =
    [Off::new(0.03, 0.1), Off::new(-0.03, -0.1), Off::new(0.03, -0.1), Off::new(-0.03, 0.1)];

#[derive(Clone, Copy, Debug, Default)]
struct Crash {
    /// From the touch to the verdict of the detector, ticks.
    found: u32,
    /// The largest force of the first half second, as a share of v √(k m).
    peak: f64,
    /// The force half a second after the touch and the largest one of the second after it, N.
    later: f64,
    after: f64,
    /// The largest torque and the largest speed of a joint, as shares of their limits.
    torque: f64,
    speed: f64,
}

impl Crash {
    fn worse(self, other: Self) -> Self {
        Self {
            found: self.found.max(other.found),
            peak: self.peak.max(other.peak),
            later: self.later.max(other.later),
            after: self.after.max(other.after),
            torque: self.torque.max(other.torque),
            speed: self.speed.max(other.speed),
        }
    }
}

/// Runs an arm against a wall.
fn crash(setup: &Setup) -> Crash {
    let mut cell = Cell::new(setup);
    let free = SPEED * (setup.stiffness * cell.mass()).sqrt();
    let (mut speed, mut torque, mut fastest) = (0.0, 0.0_f64, 0.0_f64);
    let mut forces = Vec::new();
    let mut found = None;
    while forces.len() < 1500 {
        let force = cell.force();
        if forces.is_empty() && force == 0.0 {
            speed = cell.speed();
            assert_eq!(cell.contact, None, "before the wall: {setup:?}");
        } else {
            forces.push(force);
        }
        let command = cell.tick();
        torque = torque.max(Cell::share(&command.torque, &cell.limits.torque));
        fastest = fastest.max(Cell::share(&cell.at.qd, &cell.limits.speed));
        if !forces.is_empty() {
            found = found.or(cell.contact.map(|_| forces.len() as u32));
        }
    }
    assert!((speed / SPEED - 1.0).abs() < 0.01, "{speed} m/s");
    let largest = |forces: &[f64]| forces.iter().copied().fold(0.0, f64::max);
    Crash {
        found: found.expect("a contact"),
        peak: largest(&forces[..500]) / free,
        later: forces[500],
        after: largest(&forces[500..]),
        torque,
        speed: fastest,
    }
}

/// The worst over motions and errors of the model, of an elastic wall or one that absorbs most of
/// the energy.
fn worst(stiffness: f64, loss: f64, response: Option<ContactResponse<f64>>) -> Crash {
    let runs = MOTIONS.iter().flat_map(|motion| OFF.map(|off| (*motion, off)));
    let crashes = runs.map(|(motion, off)| {
        crash(&Setup { motion, stiffness, loss, off, response, ..Setup::FREE })
    });
    let worst = crashes.reduce(Crash::worse).expect("a run");
    println!("{} N/mm, loss {loss} s/m, {response:?}: {worst:?}", 1e-3 * stiffness);
    worst
}

// The peak is below 1.2 times that of a free mass, and half a second later it is relieved.
#[test]
fn a_contacts_peak_is_bounded_and_soon_relieved() {
    for stiffness in STIFFNESSES {
        for response in RESPONSES {
            let worst = worst(stiffness, 0.0, Some(response));
            assert!(worst.found <= 40 && worst.peak <= 1.2, "{worst:?}");
            assert!(worst.later <= 10.0 && worst.after <= 10.0, "{worst:?}");
            assert!(worst.torque <= 1.0 && worst.speed <= 1.0, "{worst:?}");
        }
        // An arm that follows its motion into the wall fails both.
        let none = worst(stiffness, 0.0, None);
        assert!(none.peak > 1.5 && none.later > 200.0, "{none:?}");
    }
}

// It is relieved half a second later.
#[test]
fn a_wall_without_rebound_is_soon_relieved() {
    for stiffness in STIFFNESSES {
        for response in RESPONSES {
            let worst = worst(stiffness, 12.0, Some(response));
            assert!(worst.later <= 10.0 && worst.after <= 10.0, "{worst:?}");
        }
    }
}

#[test]
fn the_margins_exceed_4_9_noise_deviations() {
    for motion in MOTIONS {
        let mut cell = Cell::new(&Setup { motion, ..Setup::FREE });
        let mut squares = [0.0; 6];
        let ticks = cell.motion.ticks();
        for _ in 0..ticks {
            cell.tick();
            let external = cell.detector.external_torque();
            squares = core::array::from_fn(|j| squares[j] + external[j] * external[j]);
        }
        for (margin, square) in MARGIN.iter().zip(squares) {
            let share = margin / (4.9 * (square / f64::from(ticks)).sqrt());
            assert!((1.3..2.5).contains(&share), "{share}");
        }
    }
}
