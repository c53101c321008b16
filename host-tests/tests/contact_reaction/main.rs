//! Claims about what an arm does after a contact: a UR5e that runs against an elastic wall, and one that a hand pushes.

mod bad_input;
mod cell;
mod plant;
mod reactions;

use cell::{Cell, MARGIN, Spoiled};
use dynamics_core::control::{ContactResponse, MotionLimits};
use plant::{Off, SPEED, STIFFNESSES, Setup, WAYS};

pub const SLOW: MotionLimits<f64> = MotionLimits {
    velocity: 0.5,
    acceleration: 4.0,
};
pub const RETRACT: ContactResponse<f64> = ContactResponse::Retract {
    distance: 0.1, // rad
    limits: SLOW,
};
pub const FLOAT: ContactResponse<f64> = ContactResponse::Float {
    damping: 5.0,
    speed: 0.5,
};
pub const RESPONSES: [ContactResponse<f64>; 3] = [ContactResponse::Stop, RETRACT, FLOAT];

/// Inertias off by 3 % from body to body and friction off by 10 %, in each combination of signs.
pub const OFF: [Off; 4] = [
    Off::new(0.03, 0.1),
    Off::new(-0.03, -0.1),
    Off::new(0.03, -0.1),
    Off::new(-0.03, 0.1),
];

/// What became of a contact.
#[derive(Clone, Copy, Debug, Default)]
struct Crash {
    /// From the touch to the verdict of the detector, ticks.
    found: u32,
    /// The largest force of the first half second, as a share of v √(k m).
    peak: f64,
    /// The force half a second after the touch and the largest one of the second after it, N.
    later: f64,
    after: f64,
    /// The largest torque, as a share of its limit.
    torque: f64,
}

impl Crash {
    fn worse(self, other: Self) -> Self {
        Self {
            found: self.found.max(other.found),
            peak: self.peak.max(other.peak),
            later: self.later.max(other.later),
            after: self.after.max(other.after),
            torque: self.torque.max(other.torque),
        }
    }
}

/// Runs an arm against a wall.
fn crash(setup: &Setup) -> Crash {
    let mut cell = Cell::new(setup);
    let free = SPEED * (setup.stiffness * cell.mass()).sqrt();
    let (mut speed, mut torque) = (0.0, 0.0_f64);
    while cell.force() == 0.0 {
        speed = cell.speed();
        let command = cell.tick(Spoiled::Nothing);
        torque = torque.max(cell.share(&command.torque));
        assert_eq!(cell.contact, None, "before the wall: {setup:?}");
    }
    assert!((speed / SPEED - 1.0).abs() < 0.01, "{speed} m/s");
    let (mut forces, mut found) = (Vec::new(), None);
    for tick in 1..=1500 {
        forces.push(cell.force());
        let command = cell.tick(Spoiled::Nothing);
        torque = torque.max(cell.share(&command.torque));
        found = found.or(cell.contact.map(|_| tick));
    }
    let largest = |forces: &[f64]| forces.iter().copied().fold(0.0, f64::max);
    Crash {
        found: found.expect("a contact"),
        peak: largest(&forces[..500]) / free,
        later: forces[500],
        after: largest(&forces[500..]),
        torque,
    }
}

/// The worst over ways and errors of the model.
fn worst(stiffness: f64, response: Option<ContactResponse<f64>>) -> Crash {
    let runs = WAYS.iter().flat_map(|way| OFF.map(|off| (*way, off)));
    let crashes = runs.map(|(way, off)| {
        crash(&Setup {
            way,
            stiffness,
            off,
            response,
            ..Setup::FREE
        })
    });
    let worst = crashes.reduce(Crash::worse).expect("a run");
    println!("{} N/mm, {response:?}: {worst:?}", 1e-3 * stiffness);
    worst
}

#[test]
fn a_contact_peaks_below_1_2_times_that_of_a_free_mass_and_is_relieved_half_a_second_later() {
    for stiffness in STIFFNESSES {
        for response in RESPONSES {
            let Crash {
                found,
                peak,
                later,
                after,
                torque,
            } = worst(stiffness, Some(response));
            assert!(found <= 40 && peak <= 1.2, "{found} {peak}");
            assert!(later <= 10.0 && after <= 10.0, "{later} {after}");
            assert!(torque <= 1.0, "{torque}");
        }
        // An arm that follows its motion into the wall fails both.
        let none = worst(stiffness, None);
        assert!(none.peak > 1.5 && none.later > 200.0, "{none:?}");
    }
}

#[test]
fn the_margins_are_above_4_9_standard_deviations_of_the_noise() {
    for way in WAYS {
        let mut cell = Cell::new(&Setup { way, ..Setup::FREE });
        let mut squares = [0.0; 6];
        let ticks = cell.motion.ticks();
        for _ in 0..ticks {
            cell.tick(Spoiled::Nothing);
            let external = cell.detector.external_torque();
            squares = core::array::from_fn(|j| squares[j] + external[j] * external[j]);
        }
        for (margin, square) in MARGIN.iter().zip(squares) {
            let share = margin / (4.9 * (square / f64::from(ticks)).sqrt());
            assert!((1.3..2.5).contains(&share), "{share}");
        }
    }
}
