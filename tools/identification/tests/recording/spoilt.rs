//! Recordings of which one thing is spoilt: the cause is named, or the recording is not explained,
//! and only what fits is offered to paste.

use std::path::Path;

use identification::files::robot::Robot;
use identification::files::run;

use crate::arm::*;

/// Positions and torques of a tick.
type Tick = [[f64; 2]; 2];

/// How it ends: an error, a mistake with nothing to paste, or parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
enum End {
    Refused,
    Mistake,
    Fitted,
}
use End::{Fitted, Mistake, Refused};

/// What is done to a recording, the end of its identification, and words that are there.
struct Case {
    name: &'static str,
    gravity: [f64; 3],
    describe: fn(&mut Robot),
    spoil: fn(&mut Vec<Tick>),
    end: End,
    words: &'static [&'static str],
}

const fn case(
    name: &'static str,
    spoil: fn(&mut Vec<Tick>),
    end: End,
    words: &'static [&'static str],
) -> Case {
    Case { name, gravity: [0.0, 0.0, -1.0], describe: |_| (), spoil, end, words }
}

/// The torques of these joints later by so many ticks.
fn late(ticks: &mut [Tick], joints: &[usize], by: usize) {
    for k in (0..ticks.len()).rev() {
        joints.iter().for_each(|&j| ticks[k][1][j] = ticks[k.saturating_sub(by)][1][j]);
    }
}

fn each(ticks: &mut [Tick], to: impl Fn(usize, &mut Tick)) {
    ticks.iter_mut().enumerate().for_each(|(k, tick)| to(k, tick));
}

fn cases() -> Vec<Case> {
    let mounted = |name, gravity, words| Case { gravity, ..case(name, |_| (), Mistake, words) };
    let described =
        |name, describe| Case { describe, ..case(name, |_| (), Fitted, &["delay: none"]) };
    vec![
        case("nothing", |_| (), Fitted, &["delay: none"]),
        case(
            "twenty single positions",
            |t| (1..21).for_each(|k| t[117 * k][0][k % 2] += 0.5),
            Fitted,
            &["20 rows were dropped", "0.234 s (position of `elbow`)"],
        ),
        case(
            "two samples of a position in turn, and one torque",
            |t| {
                t[400][0][1] -= 0.4;
                t[401][0][1] -= 0.4;
                t[900][1][0] = 40.0;
            },
            Fitted,
            &["3 rows were dropped", "1.800 s (torque of `shoulder`)"],
        ),
        case(
            "an encoder that stands still",
            |t| (800..1500).for_each(|k| t[k][0][1] = t[800][0][1]),
            Refused,
            &["the position of `elbow` is exactly", "from 1.600 s to 2.998 s", "stood still"],
        ),
        case(
            "the first encoder stands still to the end",
            |t| (1640..t.len()).for_each(|k| t[k][0][0] = t[1640][0][0]),
            Refused,
            &["the position of `shoulder` is exactly", "stood still"],
        ),
        case(
            "a torque that is zero",
            |t| each(t, |_, t| t[1][1] = 0.0),
            Refused,
            &["the torque of `elbow` is 0 in every row"],
        ),
        case(
            "positions within a turn",
            |t| {
                each(t, |k, t| {
                    if k % 900 > 400 {
                        t[0][0] += std::f64::consts::TAU
                    }
                })
            },
            Fitted,
            &["jumps of the position of `shoulder` by whole turns were undone"],
        ),
        case(
            "an encoder of noise",
            |t| {
                each(t, |k, t| {
                    if k % 7 < 2 {
                        t[0][1] += 0.3
                    }
                })
            },
            Refused,
            &["the position of `elbow` jumps faster"],
        ),
        described("a mirrored link", |robot| {
            robot.imported.tree.bodies[1].inertia.com[0] *= -1.0;
        }),
        described("a link of 0.15 of its placeholder", |robot| {
            let own = &mut robot.imported.tree.bodies[1].inertia;
            own.mass /= 0.15;
            own.inertia = own.inertia.map(|x| x / 0.15);
        }),
        Case {
            gravity: [1.0, 0.0, 0.0],
            ..described("a wall that is told", |robot| robot.gravity = [1.0, 0.0, 0.0])
        },
        case(
            "a torque that stands still",
            |t| (800..1500).for_each(|k| t[k][1][1] = t[800][1][1]),
            Refused,
            &["the torque of `elbow` is exactly"],
        ),
        case(
            "an encoder that never moves",
            |t| each(t, |_, t| t[0][0] = 0.2),
            Mistake,
            &["the position of `shoulder` is the same in every row", "not explained"],
        ),
        mounted("a wall", [1.0, 0.0, 0.0], &["gravity is along (1.000, 0.000, 0.000)"]),
        mounted("a ceiling", [0.0, 0.0, 1.0], &["--gravity=0.000,0.000,1.000"]),
        mounted("an aslant base", [0.6, 0.0, -0.8], &["not explained", "mounting"]),
        case(
            "torques in each other's columns",
            |t| each(t, |_, t| t[1].swap(0, 1)),
            Mistake,
            &["the torques of `shoulder` and `elbow` are in each other's columns"],
        ),
        case(
            "positions in each other's columns",
            |t| each(t, |_, t| t[0].swap(0, 1)),
            Mistake,
            &["the positions of `shoulder` and `elbow` are in each other's columns"],
        ),
        case(
            "all torques late by 60 ms",
            |t| late(t, &[0, 1], 30),
            Fitted,
            &["lag behind", "by 60."],
        ),
        case("all torques late by 250 ms", |t| late(t, &[0, 1], 125), Mistake, &["not explained"]),
        case(
            "one torque late by 20 ms",
            |t| late(t, &[0], 10),
            Fitted,
            &["of shoulder are no noise"],
        ),
        case("one torque late by 250 ms", |t| late(t, &[0], 125), Mistake, &["not explained"]),
        case(
            "radians as degrees",
            |t| each(t, |_, t| t[0] = t[0].map(f64::to_radians)),
            Mistake,
            &["not explained"],
        ),
        case(
            "a position twice as large",
            |t| each(t, |_, t| t[0][1] *= 2.0),
            Refused,
            &["`elbow`", "in another unit, with another zero"],
        ),
        case(
            "a position half as large",
            |t| each(t, |_, t| t[0][0] *= 0.5),
            Mistake,
            &["not explained"],
        ),
        case(
            "two zeros",
            |t| {
                each(t, |_, t| {
                    t[0][0] += 0.19;
                    t[0][1] -= 0.16;
                });
            },
            Mistake,
            &["zero of `shoulder` is shifted: its positions are too small by about -0.18"],
        ),
        case(
            "torques of another motion",
            |t| {
                let (count, old) = (t.len(), t.clone());
                each(t, |k, t| t[1] = old[count - 1 - k][1]);
            },
            Mistake,
            &["not explained", "mounting"],
        ),
        case(
            "a sign and a delay",
            |t| {
                each(t, |_, t| t[1][1] = -t[1][1]);
                late(t, &[0, 1], 10);
            },
            Mistake,
            &["the torques of `elbow` have the wrong sign"],
        ),
        case("a light arm", |t| each(t, |_, t| t[1] = t[1].map(|x| 0.5 * x)), Fitted, &["delay"]),
    ]
}

fn spoilt(case: &Case) -> String {
    let mut robot = described();
    robot.gravity = case.gravity;
    let motion = |t: f64| swing(t, [0.9, 1.1], [1.7, 2.6]);
    let text = record_with(motion, 2_500, 0.0, |at| torques(&robot, at));
    let (titles, rows) = text.split_once('\n').expect("titles");
    let mut rows: Vec<Vec<String>> =
        rows.lines().map(|row| row.split(',').map(str::to_owned).collect()).collect();
    let number = |row: &[String], at: usize| row[at].parse::<f64>().expect("a number");
    let mut ticks: Vec<Tick> =
        rows.iter().map(|row| [8, 9].map(|at| [at, at + 3].map(|at| number(row, at)))).collect();
    (case.spoil)(&mut ticks);
    for (row, tick) in rows.iter_mut().zip(&ticks) {
        for (at, to) in [8, 9, 11, 12].into_iter().zip([0, 2, 1, 3]) {
            row[at] = tick[to / 2][to % 2].to_string();
        }
    }
    let rows: Vec<String> = rows.iter().map(|row| row.join(",")).collect();
    format!("{titles}\n{}\n", rows.join("\n"))
}

#[test]
fn spoilt_recordings_are_named_or_not_explained_and_only_what_fits_is_offered() {
    let mut wrong = Vec::new();
    for case in cases() {
        let recorded = read(&spoilt(&case)).expect("ticks");
        let mut robot = off();
        (case.describe)(&mut robot);
        let found = run::identify(&robot, (Path::new("run.csv"), &recorded), None, &OPTIONS());
        let (end, text) = match found {
            Err(error) => (Refused, error.to_string()),
            // The program offers nothing and fails if there is a mistake.
            Ok(found) if found.mistake.is_some() => (Mistake, found.text()),
            Ok(found) => (Fitted, found.text()),
        };
        let lacks: Vec<&&str> = case.words.iter().filter(|words| !text.contains(**words)).collect();
        if end != case.end || !lacks.is_empty() {
            let text: Vec<&str> = text.lines().filter(|line| !line.starts_with("  ")).collect();
            wrong.push(format!("{}: {end:?}, lacks {lacks:?}\n{}", case.name, text.join("\n")));
        }
        assert!(!text.contains("NaN") && !text.contains("inf "), "{}: {text}", case.name);
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}
