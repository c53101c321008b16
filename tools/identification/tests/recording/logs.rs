//! Logs of an arm of six joints in the formats of public projects, with their columns and units.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::Path;

use dynamics_core::algorithms::rnea;
use dynamics_core::effects::{Armature, Coulomb, RIGID_BODY, Stribeck, Viscous, Width};
use dynamics_core::state::State;
use identification::files::error::Result;
use identification::files::map::Map;
use identification::files::recorded::Recorded;
use identification::files::report::Findings;
use identification::files::robot::Robot;
use identification::files::run::{self, Options};
use robot_import::import::Options as Selection;
use robot_import::model;

use crate::arm::OPTIONS;

pub const V: usize = 6;
/// The arm's frictions and rotors, which its description lacks.
const VISCOUS: [f64; V] = [0.05, 0.06, 0.05, 0.04, 0.03, 0.03];
pub const COULOMB: [f64; V] = [0.06, 0.07, 0.06, 0.05, 0.04, 0.04];
const ARMATURE: [f64; V] = [0.012, 0.012, 0.012, 0.006, 0.004, 0.004];
/// Torque of a joint per ampere: the motor's constant times its gear.
const PER_AMPERE: f64 = 0.0088 * 345.0;
/// A count of an encoder, rad, and noise of the torque, N·m.
const COUNT: f64 = TAU / 4096.0;
const NOISE: f64 = 0.02;

pub fn so101() -> Robot {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../robot-import/tests/urdf/so101.urdf");
    Robot::read(Path::new(file), None, &Selection::default()).expect("a robot")
}

/// The mistake in a log.
#[derive(Clone, Copy, Default)]
pub struct Wrong {
    pub reversed: bool,
    pub shift: f64,
    pub factor: f64,
    pub late: f64,
    pub stribeck: f64,
    pub asymmetry: f64,
}

pub const RIGHT: Wrong =
    Wrong { reversed: false, shift: 0.0, factor: 1.0, late: 0.0, stribeck: 0.0, asymmetry: 0.0 };

/// Positions and torques at times.
pub struct Samples(pub Vec<(f64, [f64; V], [f64; V])>);

/// A motion within the limits that does not repeat.
fn motion(t: f64) -> State<f64, V, V> {
    let mut at = State::at([0.0, 0.0, 0.0, 0.0, 0.0, 0.7]);
    for j in 0..V {
        let size = [1.2, 1.0, 1.0, 1.2, 1.5, 0.6][j];
        for (share, rate) in [(0.45, 0.31), (0.3, 0.83), (0.25, 1.9)] {
            let rate = rate * (1.0 + 0.17 * j as f64);
            let ((sin, cos), size) = ((rate * t + 2.0 * j as f64).sin_cos(), share * size);
            at.q[j] += size * sin;
            at.qd[j] += size * rate * cos;
            at.qdd[j] -= size * rate * rate * sin;
        }
    }
    at
}

/// The arm's samples at these times.
pub fn samples(times: impl Iterator<Item = f64>, wrong: Wrong) -> Samples {
    // An arm whose masses are other ones than those of its description.
    let mut robot = so101();
    let factors = [1.2, 0.85, 1.1, 0.9, 1.15, 1.06];
    for (body, factor) in robot.imported.tree.bodies.iter_mut().zip(factors) {
        body.inertia.mass *= factor;
        body.inertia.inertia = body.inertia.inertia.map(|x| x * factor);
    }
    let arm = model::arm::<V>(&robot.imported.tree).expect("an arm");
    let width = Width::new(0.02);
    let excess = COULOMB.map(|f| wrong.stribeck * f);
    let stribeck = Stribeck { excess, stribeck_speed: Width::new(0.16), width };
    let scene = (Viscous(VISCOUS), Coulomb { torque: COULOMB, width }, Armature(ARMATURE));
    let mut rng = fastrand::Rng::with_seed(3);
    let sample = |t: f64| {
        let mut q = motion(t).q.map(|q| (q / COUNT).round() * COUNT);
        let at = motion(t - wrong.late);
        let mut tau = rnea(&arm, &at, &(RIGID_BODY, scene, stribeck));
        for j in 0..V {
            tau[j] += wrong.asymmetry * COULOMB[j] * (at.qd[j] / 0.02).tanh().powi(2);
            tau[j] = wrong.factor * (tau[j] + NOISE * (2.0 * rng.f64() - 1.0));
        }
        if wrong.reversed {
            tau[2] = -tau[2];
        }
        q[1] += wrong.shift;
        (t, q, tau)
    };
    Samples(times.map(sample).collect())
}

pub fn even(rate: f64, seconds: f64) -> impl Iterator<Item = f64> {
    (0..(rate * seconds) as u32).map(move |k| f64::from(k) / rate)
}

/// Times with jitter, lost samples, and the last one twice now and then.
pub fn uneven(rate: f64, seconds: f64, jitter: f64, lost: f64, twice: f64) -> Vec<f64> {
    let (mut rng, mut times) = (fastrand::Rng::with_seed(11), Vec::new());
    for t in even(rate, seconds) {
        if rng.f64() > lost {
            times.push(t + jitter * (2.0 * rng.f64() - 1.0));
        }
        if rng.f64() < twice {
            times.extend(times.last().copied());
        }
    }
    times
}

/// A log of rows whose first column is the time.
fn rows(
    samples: &Samples,
    titles: &str,
    separator: &str,
    row: impl Fn(f64, &[f64; V], &[f64; V]) -> (String, Vec<f64>),
) -> String {
    let mut text = titles.to_owned();
    for (t, q, tau) in &samples.0 {
        let (time, numbers) = row(*t, q, tau);
        let numbers: Vec<String> = numbers.iter().map(|x| format!("{x:.6}")).collect();
        let _ = write!(text, "\n{time}{separator}{}", numbers.join(separator));
    }
    text + "\n"
}

/// A title of a joint by its number and name.
type Title<'a> = &'a dyn Fn(usize, &str) -> String;

fn titles(first: &str, separator: &str, each: &[Title<'_>]) -> String {
    let names = so101().joints();
    let all = each.iter().flat_map(|of| names.iter().enumerate().map(move |(j, name)| of(j, name)));
    first.to_owned() + separator + &all.collect::<Vec<_>>().join(separator)
}

fn both(q: impl IntoIterator<Item = f64>, tau: impl IntoIterator<Item = f64>) -> Vec<f64> {
    q.into_iter().chain(tau).collect()
}

/// `cargo xtask watch`.
pub fn own(samples: &Samples) -> String {
    let mut text = String::from("number,tick,mode,time_s");
    (0..V).for_each(|j| text += &format!(",estimate_{j},torque_{j}"));
    for (k, (t, q, tau)) in samples.0.iter().enumerate() {
        let _ = write!(text, "\n{k},{k},full,{t:.6}");
        (0..V).for_each(|j| text += &format!(",{:.9},{:.9}", q[j], tau[j]));
    }
    text + "\n"
}

/// An episode of LeRobot: seconds, degrees.
pub fn lerobot(samples: &Samples) -> String {
    let titles = titles(
        "timestamp",
        ",",
        &[&|_, name| format!("{name}.pos"), &|_, name| format!("{name}.torque")],
    );
    rows(samples, &titles, ",", |t, q, tau| (format!("{t:.6}"), both(q.map(f64::to_degrees), *tau)))
}

/// The log of an SO-101 by its bus: Unix time, degrees, mA.
pub fn bus(samples: &Samples) -> String {
    let titles = titles(
        "timestamp",
        ";",
        &[&|_, name| format!("{name}.pos"), &|_, name| format!("{name}.current_mA")],
    );
    rows(samples, &titles, ";", |t, q, tau| {
        let current = tau.map(|tau| 1e3 * tau / PER_AMPERE);
        (format!("{:.6}", 1.76e9 + t), both(q.map(f64::to_degrees), current))
    })
}

/// `record.py` of RTDE: currents in A, spaces.
pub fn rtde(samples: &Samples) -> String {
    let of = |what: &'static str| move |j: usize, _: &str| format!("{what}_{j}");
    let titles = titles("timestamp", " ", &[&of("actual_q"), &of("actual_current")]);
    rows(samples, &titles, " ", |t, q, tau| {
        (format!("{:.3}", 8.0e4 + t), both(*q, tau.map(|tau| tau / PER_AMPERE)))
    })
}

/// A log of libfranka: ms.
pub fn franka(samples: &Samples) -> String {
    let of = |what: &'static str| move |j: usize, _: &str| format!("{what}[{j}]");
    let titles = titles("time", ", ", &[&of("q"), &of("tau_J")]);
    rows(samples, &titles, ", ", |t, q, tau| (format!("{:.0}", 1e3 * t), both(*q, *tau)))
}

/// A bag of rosbag2 with `sensor_msgs/msg/JointState`, joints by the alphabet, Unix time.
pub fn bag(samples: &Samples) -> Vec<u8> {
    let mut writer = mcap::WriteOptions::new()
        .profile("ros2")
        .compression(None)
        .create(std::io::Cursor::new(Vec::new()))
        .expect("a file");
    let schema = writer.add_schema("sensor_msgs/msg/JointState", "ros2msg", b"").expect("a schema");
    let topic = "/joint_states";
    let channel = writer.add_channel(schema, topic, "cdr", &BTreeMap::new()).expect("a channel");
    let names = so101().joints();
    let mut order: Vec<usize> = (0..V).collect();
    order.sort_by_key(|&j| &names[j]);
    for (k, (t, q, tau)) in samples.0.iter().enumerate() {
        let nanos = 1_760_000_000_000_000_000 + (1e9 * t).round() as u64;
        let data = cdr(nanos, order.iter().map(|&j| (&names[j][..], q[j], tau[j])).collect());
        let header = mcap::records::MessageHeader {
            channel_id: channel,
            sequence: k as u32,
            log_time: nanos + 300_000,
            publish_time: nanos,
        };
        writer.write_to_known_channel(&header, &data).expect("a message");
    }
    writer.finish().expect("an end");
    writer.into_inner().into_inner()
}

/// Little-endian, each number aligned to its size after the header of four bytes.
fn cdr(nanos: u64, joints: Vec<(&str, f64, f64)>) -> Vec<u8> {
    let mut body: Vec<u8> = Vec::new();
    let word = |body: &mut Vec<u8>, x: usize| {
        body.resize(body.len().next_multiple_of(4), 0);
        body.extend((x as u32).to_le_bytes());
    };
    let text = |body: &mut Vec<u8>, text: &str| {
        word(body, text.len() + 1);
        body.extend(text.bytes().chain([0]));
    };
    word(&mut body, (nanos / 1_000_000_000) as usize);
    word(&mut body, (nanos % 1_000_000_000) as usize);
    text(&mut body, "base");
    word(&mut body, joints.len());
    joints.iter().for_each(|(name, ..)| text(&mut body, name));
    for numbers in [
        joints.iter().map(|j| j.1).collect(),
        Vec::new(),
        joints.iter().map(|j| j.2).collect::<Vec<f64>>(),
    ] {
        word(&mut body, numbers.len());
        for x in &numbers {
            body.resize(body.len().next_multiple_of(8), 0);
            body.extend(x.to_le_bytes());
        }
    }
    [vec![0, 1, 0, 0], body].concat()
}

pub fn read(bytes: &[u8], map: Option<&str>) -> Result<Recorded> {
    let map = map.map(|text| Map::of(text).expect("a map"));
    Recorded::from(Path::new("log"), bytes, &so101().joints(), map.as_ref())
}

pub fn tried(recorded: &Recorded) -> Result<Findings> {
    run::identify(&so101(), (Path::new("log"), recorded), None, &OPTIONS())
}

pub fn identified(recorded: &Recorded, options: &Options) -> Findings {
    run::identify(&so101(), (Path::new("log"), recorded), None, options).expect("parameters")
}
