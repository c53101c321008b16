//! Runs into the wall, false alarms, and delays until a push is found.

use super::crash::{self, FRICTIONS, RESPONSES};
use super::firmware::Sensing;
use super::path::{Off, Push, lap};

/// The bars: the first peak as a share of v √(k m), the force half a second later, N, and the false
/// alarms in a million ticks.
pub const PEAK: f32 = 1.2;
/// See [`PEAK`].
pub const LATER: f32 = 10.0;
/// Laps of a million ticks.
pub const LAPS: u32 = 150;
/// Ticks from one instant of pushes to the next: no divisor of the way-points'.
const EVERY: u32 = 251;
/// Ticks after which a push counts as not found.
pub const PATIENCE: u32 = 200;

/// The errors of the model of a lap: a share of 3 % of inertias and 10 % of friction, with its own
/// signs.
fn off_by(lap: u32, share: f32) -> Off {
    // Knuth's multiplicative hash.
    Off::by(
        0.03 * share,
        0.1 * share,
        lap.wrapping_add(1000).wrapping_mul(2_654_435_761) >> 13,
    )
}

/// The worst runs into a wall, over errors of the model of all kinds of signs.
#[derive(Clone, Copy, Debug, Default)]
pub struct Worst {
    /// The longest delay, ticks.
    pub found: u32,
    /// The largest peak, as a share of v √(k m).
    pub peak: f32,
    /// The largest force half a second later and in the second after that, N.
    pub later: [f32; 2],
    /// Ticks with a contact before the wall.
    pub early: u32,
}

/// The worst of some runs into a wall.
///
/// # Panics
/// If a run fails or a contact is not found.
pub fn worst(friction: &str, stiffness: f32, response: usize) -> Worst {
    let (_, response) = RESPONSES[response];
    let mut worst = Worst::default();
    for signs in [
        0,
        0xfff,
        crash::SIGNS,
        !crash::SIGNS,
        crash::SIGNS | 0xfc0,
        !crash::SIGNS & 0x3f,
    ] {
        let off = Off::by(0.03, 0.1, signs);
        let one = crash::either(stiffness, response, friction, &off, |_| ()).expect("a run");
        worst.found = worst.found.max(one.found.expect("a contact"));
        worst.peak = worst.peak.max(one.peak[1]);
        worst.early = worst.early.max(one.early);
        for (most, force) in worst.later.iter_mut().zip(one.later) {
            *most = most.max(force);
        }
    }
    worst
}

/// An encoder, a kind of friction, and whether the stated errors hold for joints that stick.
#[derive(Clone, Copy, Debug)]
pub struct Watch {
    pub bits: u32,
    /// One of [`FRICTIONS`].
    pub friction: &'static str,
    /// Whether stiction is stated.
    pub sticks: bool,
}

impl Watch {
    fn sensing(self) -> Sensing {
        let sensing = match self.bits {
            14 => Sensing::BITS_14,
            _ => Sensing::BITS_20,
        };
        if self.sticks {
            sensing.sticking()
        } else {
            sensing
        }
    }

    /// The excess of each tick of some laps, and those after each push.
    fn laps(self, laps: u32, share: f32, pushes: &[Push]) -> (Vec<f32>, Vec<(Push, Vec<f32>)>) {
        let (mut all, mut after) = (Vec::new(), Vec::new());
        for number in 0..laps {
            let off = off_by(number, share);
            let free = |_, excess| all.push(excess);
            let set = (EVERY, pushes, PATIENCE);
            let pushed = |push, _, excess: &mut dyn Iterator<Item = f32>| {
                after.push((push, excess.collect()));
            };
            let done = match self.friction == FRICTIONS[0] {
                true => lap(
                    self.sensing(),
                    (off.inertia, off.smooth()),
                    free,
                    set,
                    pushed,
                ),
                false => lap(
                    self.sensing(),
                    (off.inertia, off.sticking()),
                    free,
                    set,
                    pushed,
                ),
            };
            done.expect("an arm with forward dynamics");
        }
        (all, after)
    }

    /// The ticks of some laps, and those with a contact.
    pub fn alarms(self, laps: u32) -> [usize; 2] {
        let (all, _) = self.laps(laps, 1.0, &[]);
        [
            all.len(),
            all.iter().filter(|excess| **excess > 1.0).count(),
        ]
    }

    /// The delays until each of [`PUSHES`] is found, of either sign, ticks, in order; [`PATIENCE`]
    /// where it is not.
    pub fn delays(self, laps: u32) -> Vec<Vec<u32>> {
        let (_, after) = self.laps(laps, 1.0, &both(&PUSHES));
        let of = |push: &Push| {
            let mine = after.iter().filter(|(other, _)| other.joint == push.joint);
            let mut delays: Vec<u32> = mine.map(|(_, excess)| delay(excess, 1.0)).collect();
            delays.sort_unstable();
            delays
        };
        PUSHES.iter().map(of).collect()
    }
}

/// The pushes: on the shoulder, and on the joints of the wrist.
pub const PUSHES: [Push; 4] = [push(1, 10.0), push(3, 2.0), push(4, 2.0), push(5, 2.0)];

const fn push(joint: usize, torque: f32) -> Push {
    Push { joint, torque }
}

fn both(pushes: &[Push]) -> Vec<Push> {
    let signs = |p: &Push| [1.0, -1.0].map(|sign| push(p.joint, sign * p.torque));
    pushes.iter().flat_map(signs).collect()
}

/// Ticks until an excess is above a number of margins.
fn delay(excess: &[f32], margins: f32) -> u32 {
    let found = excess.iter().position(|excess| *excess > margins);
    found.map_or(PATIENCE, |ticks| ticks as u32 + 1)
}

/// The time within which a push is to be found, ms.
pub fn required(bits: u32) -> u32 {
    if bits == 14 { 40 } else { 10 }
}

/// The encoders and kinds of friction.
pub const WATCHES: [Watch; 6] = [
    watch(14, FRICTIONS[0], false),
    watch(20, FRICTIONS[0], false),
    watch(14, FRICTIONS[1], true),
    watch(20, FRICTIONS[1], true),
    watch(14, FRICTIONS[1], false),
    watch(20, FRICTIONS[1], false),
];

const fn watch(bits: u32, friction: &'static str, sticks: bool) -> Watch {
    Watch {
        bits,
        friction,
        sticks,
    }
}
