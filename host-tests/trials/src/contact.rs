//! The figures of `docs/contact.md`.

use dynamics_core::Core;
use dynamics_core::effects::{Armature, Coriolis, Gravity, Inertia};
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use firmware_demo::contact::crash::{self, FRICTIONS, RESPONSES, STIFFNESSES, Sample};
use firmware_demo::contact::firmware::Sensing;
use firmware_demo::contact::path::{Off, Push, lap};
use firmware_demo::contact::plant::rotors;
use firmware_demo::trajectories::HOME;

use crate::page::{Chart, Scale, Shown, bar, table};

/// The bars: the first peak as a share of v √(k m), the force half a second later, N, and the false alarms in a million ticks.
pub const PEAK: f32 = 1.2;
/// See [`PEAK`].
pub const LATER: f32 = 10.0;
/// Laps of a million ticks.
pub const LAPS: u32 = 150;
/// Laps with pushes.
const PUSHED: u32 = 20;
/// Ticks from one instant of pushes to the next: no divisor of the way-points'.
const EVERY: u32 = 251;
/// Ticks after which a push counts as not found.
pub const PATIENCE: u32 = 200;

/// The errors of the model of a lap: inertias off by 3 % and friction off by 10 %, with its own signs.
pub fn off(lap: u32) -> Off {
    off_by(lap, 1.0)
}

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
    /// The bits of the encoder.
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

    fn words(self) -> [String; 3] {
        let stated = if self.sticks {
            "with stiction"
        } else {
            "sliding"
        };
        [
            format!("{} bits", self.bits),
            self.friction.into(),
            stated.into(),
        ]
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

    /// The delays until each of [`PUSHES`] is found, of either sign, ticks, in order; [`PATIENCE`] where it is not.
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

/// The time in which a push moves its joint from rest by one step of the encoder, ms: t = √(2 Δ / q̈).
pub fn limit(bits: u32, push: Push) -> f64 {
    let rotors: Armature<f64, 6> = rotors();
    let scene = (Gravity::EARTH, Inertia, Coriolis, rotors);
    let at = State::at(HOME.map(f64::from));
    let mut tau = Core::<Ur5e>::rnea(&at, &scene);
    tau[push.joint] += f64::from(push.torque);
    let qdd = Core::<Ur5e>::aba(&at, &tau, &scene).expect("an arm with mass")[push.joint];
    let step = core::f64::consts::TAU / f64::from(1 << bits);
    1e3 * (2.0 * step / qdd).sqrt()
}

/// The time within which a push is to be found, ms.
pub fn required(bits: u32) -> u32 {
    if bits == 14 { 40 } else { 10 }
}

/// The encoders and kinds of friction of the page.
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

/// The page.
pub fn shown() -> Shown {
    let mut bars = Vec::new();
    let mut crashes = Vec::new();
    let mut most = Worst::default();
    for friction in FRICTIONS {
        for stiffness in STIFFNESSES {
            for (number, (name, response)) in RESPONSES.into_iter().enumerate() {
                let one = worst(friction, stiffness, number);
                crashes.push(vec![
                    friction.into(),
                    format!("{} N/mm", 1e-3 * stiffness),
                    name.into(),
                    format!("{} ms", one.found),
                    format!("{:.2}", one.peak),
                    format!("{:.0} N", one.later[0]),
                    format!("{:.0} N", one.later[1]),
                ]);
                if response.is_some() {
                    most.peak = most.peak.max(one.peak);
                    most.later[0] = most.later[0].max(one.later[0]);
                }
            }
        }
    }
    let peak = format!("{:.2}", most.peak);
    bars.push(bar(
        "first peak over v √(k m), both stiffnesses, both kinds of friction",
        "≤ 1.2",
        peak,
        most.peak <= PEAK,
    ));
    let later = format!("{:.0} N", most.later[0]);
    bars.push(bar(
        "force 0.5 s later, the same",
        "≤ 10 N",
        later,
        most.later[0] <= LATER,
    ));

    let (mut delays, mut alarms) = (Vec::new(), Vec::new());
    for watch in WATCHES {
        let [ticks, found] = watch.alarms(LAPS);
        let [encoder, friction, stated] = watch.words();
        let row = [encoder.clone(), friction.clone(), stated.clone()];
        let row = row
            .into_iter()
            .chain([ticks.to_string(), found.to_string()]);
        alarms.push(row.collect());
        let rate = found as f64 / ticks as f64;
        let name = format!("false alarms, {encoder}, {friction} friction, stated errors {stated}");
        bars.push(bar(
            &name,
            "< 1 in 10⁶ ticks",
            format!("{found} in {ticks}"),
            rate < 1e-6,
        ));
        if watch.friction == FRICTIONS[1] && !watch.sticks {
            continue;
        }
        let required = required(watch.bits);
        for (push, all) in PUSHES.iter().zip(watch.delays(PUSHED)) {
            let at = |share: f64| all[((all.len() - 1) as f64 * share) as usize];
            let words = |ticks: u32| match ticks {
                PATIENCE => "not found".to_owned(),
                ticks => format!("{ticks} ms"),
            };
            let within = all.iter().filter(|ticks| **ticks <= required).count();
            let share = format!("{:.1} %", 100.0 * within as f64 / all.len() as f64);
            let pushed = format!("{} N·m at joint {}", push.torque, push.joint + 1);
            delays.push(vec![
                encoder.clone(),
                friction.clone(),
                pushed.clone(),
                words(at(0.5)),
                words(at(0.95)),
                words(at(1.0)),
                share.clone(),
                format!("{:.1} ms", limit(watch.bits, *push)),
            ]);
            let name = format!("{pushed} found, {encoder}, {friction} friction");
            let got = format!("{}, {share} within {required} ms", words(at(1.0)));
            bars.push(bar(
                &name,
                &format!("≤ {required} ms"),
                got,
                at(1.0) <= required,
            ));
        }
    }
    let text = format!(
        "{}\nInto the wall, the worst of six arms:\n\n{}\nPushes on the pick and place, of either sign, {PUSHED} arms:\n\n{}\n\
         False alarms on the pick and place, {LAPS} arms:\n\n{}",
        table("bar|required|got|verdict", bars),
        table(
            "friction|stiffness|response|contact found after|peak|force 0.5 s later|most after that",
            crashes
        ),
        table(
            "encoder|friction|push|median|95 %|longest|within the bar|one step of the encoder takes",
            delays
        ),
        table("encoder|friction|stated errors|ticks|with an alarm", alarms),
    );
    Shown {
        text,
        charts: charts(),
        estimators: Vec::new(),
    }
}

/// The samples of a run into a wall by an arm of [`crash::rows`].
fn samples(stiffness: f32, response: usize) -> (Vec<Sample>, crash::Outcome) {
    let mut samples = Vec::new();
    let off = Off::by(0.03, 0.1, crash::SIGNS);
    let (_, response) = RESPONSES[response];
    let outcome = crash::either(stiffness, response, FRICTIONS[0], &off, |one| {
        samples.push(one)
    });
    samples.retain(|one| (-60..240).contains(&one.tick));
    (samples, outcome.expect("a run"))
}

fn charts() -> Vec<Chart> {
    let mut charts = Vec::new();
    for (stiffness, most) in STIFFNESSES.into_iter().zip([320.0, 320.0]) {
        let line = |number: usize| {
            let (samples, _) = samples(stiffness, number);
            let points = samples
                .iter()
                .map(|one| (f64::from(one.tick), f64::from(one.force)));
            (RESPONSES[number].0.to_owned(), points.collect())
        };
        charts.push(Chart {
            title: format!(
                "Contact at 0.25 m/s, {} N/mm, by the response",
                1e-3 * stiffness
            ),
            x: Scale::linear("ms after the touch", [-60.0, 240.0]),
            y: Scale::linear("force, N", [0.0, most]),
            lines: (0..RESPONSES.len()).map(line).collect(),
            dots: false,
        });
    }
    for stiffness in STIFFNESSES {
        let (samples, outcome) = samples(stiffness, 0);
        let (joint, found) = (outcome.joint.expect("one"), outcome.found.expect("found"));
        let of = |value: fn(&Sample, usize) -> f32| {
            let points = samples
                .iter()
                .map(|one| (f64::from(one.tick), f64::from(value(one, joint))));
            points.filter(|(tick, _)| *tick <= 60.0).collect::<Vec<_>>()
        };
        let residual = of(|one, joint| one.external[joint].abs());
        let top = residual.iter().fold(1.0, |most, (_, r)| f64::max(most, *r));
        let mark = vec![(f64::from(found), 0.0), (f64::from(found), top)];
        charts.push(Chart {
            title: format!(
                "The joint that finds it, joint {}, {} N/mm",
                joint + 1,
                1e-3 * stiffness
            ),
            x: Scale::linear("ms after the touch", [-60.0, 60.0]),
            y: Scale::linear("torque, N·m", [0.0, top]),
            lines: vec![
                ("|residual|".into(), residual),
                ("threshold".into(), of(|one, joint| one.threshold[joint])),
                ("contact found".into(), mark),
            ],
            dots: false,
        });
    }
    charts.push(Chart {
        title: "A push of 10 N·m at the shoulder, 14 bits, by the error of the model".into(),
        x: Scale::decades(
            "share of ticks with a false alarm; none at the left edge",
            [1e-6, 1.0],
        ),
        y: Scale::linear("found after, 95 %, ms", [0.0, 200.0]),
        lines: CURVES.map(curve).into(),
        dots: true,
    });
    charts
}

/// The error of the model as a share of the stated one, and the kind of friction.
const CURVES: [(f32, &str); 4] = [
    (0.0, FRICTIONS[0]),
    (1.0, FRICTIONS[0]),
    (2.0, FRICTIONS[0]),
    (1.0, FRICTIONS[1]),
];

/// Delay against false alarms, from one margin to another.
fn curve((share, friction): (f32, &'static str)) -> (String, Vec<(f64, f64)>) {
    let sticks = friction == FRICTIONS[1];
    let watch = watch(14, friction, sticks);
    let (all, after) = watch.laps(PUSHED, share, &both(&PUSHES[..1]));
    let point = |margins: f32| {
        let alarms = all.iter().filter(|excess| **excess > margins).count();
        let mut delays: Vec<u32> = after
            .iter()
            .map(|(_, excess)| delay(excess, margins))
            .collect();
        delays.sort_unstable();
        let rate = (alarms as f64 / all.len() as f64).max(1e-6);
        (rate, f64::from(delays[delays.len() * 95 / 100]))
    };
    let margins = (1..=16).map(|tenth| 0.1 * tenth as f32);
    let name = format!("{} %, {friction}", 3.0 * share);
    (name, margins.map(point).collect())
}
