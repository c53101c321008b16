//! The tables and charts of `docs/contact.md`.

use lab_target::contact::crash::{self, FRICTIONS, RESPONSES, STIFFNESSES, Sample};
use lab_target::contact::path::Off;

use super::{
    LAPS, LATER, PATIENCE, PEAK, PUSHED, PUSHES, WATCHES, Worst, both, delay, limit, required,
    watch, worst,
};
use crate::page::{Chart, Scale, Shown, bar, table};

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
