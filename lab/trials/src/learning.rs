//! The figures of `docs/learning.md`.

use dynamics_core::effects::Effect;
use lab_target::learning::TICK;
use lab_target::learning::arm::{BRISTLES, SMOOTH};
use lab_target::learning::firmware::{LEARNED, Task, WEIGHED};
use lab_target::learning::parameters::{Known, Model, N, OWN};
use lab_target::learning::run::{LOAD, Outcome, load_error, possible, run, validation};
use lab_target::learning::selected::KNOWN;
use lab_target::learning::tag_k::TagK;

use crate::page::{Chart, Scale, Shown, bar, table};
use crate::select::{known, selected, truth};

/// The arms that differ in which of their parameters are off by 30 % in which direction.
pub const SEEDS: core::ops::Range<u32> = 1..7;
/// The required error of the torques.
pub const ERROR: f32 = 0.05;
/// The errors of a load: of its mass, as a share, and of its centre, m.
pub const LOAD_ERRORS: [f32; 2] = [0.02, 5e-3];
/// Ticks from one point of a chart to the next.
const EVERY: u32 = 250;
const OF_JOINTS: [&str; OWN] = [
    "viscous",
    "Coulomb",
    "armature",
    "gear drives",
    "gear driven",
];

/// The outcomes of an arm with either kind of friction.
///
/// # Panics
/// If a run fails.
pub fn both(known: &Known) -> [(&'static str, Outcome); 2] {
    let smooth = run(known, SMOOTH, |_, _, _| ()).expect("a run");
    let sticking = run(known, BRISTLES, |_, _, _| ()).expect("a run");
    [("Coulomb", smooth), ("LuGre", sticking)]
}

/// The errors of a load as in [`LOAD_ERRORS`].
pub fn of_load(outcome: &Outcome) -> [f32; 2] {
    let [mass, off] = outcome.load;
    [(mass / LOAD.mass - 1.0).abs(), off]
}

pub fn shown() -> Shown {
    let mut rows = Vec::new();
    let mut most = [0.0_f32; 4];
    let mut row = |name: String, friction: &str, one: &Outcome| {
        let [[before, _], [after, worst]] =
            one.errors.map(|x| x.map(|x| format!("{:.1} %", 100.0 * x)));
        let [mass, off] = one.load.map(|x| format!("{:.1}", 1e3 * x));
        let rejected = one.rejected.to_string();
        rows.push(vec![
            name,
            friction.into(),
            before,
            after,
            worst,
            rejected,
            mass + " g",
            off + " mm",
        ]);
    };
    for seed in SEEDS {
        for (friction, one) in both(&known(seed)) {
            row(seed.to_string(), friction, &one);
            let [mass, off] = of_load(&one);
            for (most, x) in most
                .iter_mut()
                .zip([one.errors[1][0], one.errors[1][1], mass, off])
            {
                *most = most.max(x);
            }
        }
    }
    let mut exact = [0.0_f32; 2];
    for (friction, one) in both(&selected(truth())) {
        row("exact".into(), friction, &one);
        for (exact, x) in exact.iter_mut().zip(of_load(&one)) {
            *exact = exact.max(x);
        }
    }
    let percent = |x: f32| format!("{:.1} %", 100.0 * x);
    let load = |[mass, off]: [f32; 2]| format!("{}, {:.1} mm", percent(mass), 1e3 * off);
    let within = |found: [f32; 2]| found.iter().zip(LOAD_ERRORS).all(|(x, most)| *x <= most);
    let learned = [most[2], most[3]];
    let required = "≤ 2 %, 5 mm, of a UR5e";
    let bars = [
        bar(
            "torque error by 24 parameters after 30 s, all joints",
            "≤ 5 %",
            percent(most[0]),
            most[0] <= ERROR,
        ),
        ["the same of the worst joint", "–", &percent(most[1]), "–"]
            .map(str::to_owned)
            .into(),
        bar(
            "load after 5 s, learned model: mass, centre",
            required,
            load(learned),
            within(learned),
        ),
        bar(
            "load after 5 s, exact model: mass, centre",
            required,
            load(exact),
            within(exact),
        ),
    ];
    let text = format!(
        "{}\nThe arms:\n\n{}",
        table("bar|required|got, the worst|verdict", bars),
        table(
            "nominal model|friction|torque error before|after 30 s|of the worst joint|rows rejected|load of 150 g|its centre off by",
            rows
        ),
    );
    let (charts, estimators) = charts();
    Shown {
        text,
        charts,
        estimators,
    }
}

/// The first estimated parameter of each kind that joints have, by its name and its column.
fn parameters(known: &Known) -> Vec<(String, usize)> {
    let columns = known
        .base
        .columns
        .iter()
        .copied()
        .filter(|column| *column >= N - 6 * OWN);
    let name = |column: usize| {
        let (joint, own) = ((column - 60) / OWN, (column - 60) % OWN);
        (format!("{} {}", OF_JOINTS[own], joint + 1), column)
    };
    let mut all: Vec<(String, usize)> = columns.map(name).collect();
    let mut listed = [false; OWN];
    all.retain(|(_, column)| !std::mem::replace(&mut listed[(column - 60) % OWN], true));
    all
}

type Points = Vec<(f64, f64)>;

struct Curves {
    /// By seconds: each of [`parameters`], and the error of the torques.
    lines: Vec<(String, Points)>,
    errors: Points,
    outcome: Outcome,
    /// The load by another estimator from the same ticks, six rows in each.
    by_tag_k: [f32; 10],
}

fn curves<F: Effect<f32, 6, 6> + Clone>(friction: F) -> Curves {
    let truth = truth();
    let mut lines: Vec<(String, usize, Points)> = parameters(&KNOWN)
        .into_iter()
        .map(|(name, column)| (name, column, Vec::new()))
        .collect();
    let mut errors = Vec::new();
    let (mut weighings, mut greedy) = (Vec::new(), TagK::default());
    let outcome = run(&KNOWN, friction, |task, tick, firmware| {
        if task == Task::Weigh {
            if tick == 0 {
                weighings.push(*std::mem::take(&mut greedy).estimate());
            }
            let (y, residual) = firmware.weighted();
            greedy.update(&y, &residual);
        }
        if task != Task::Learn || !tick.is_multiple_of(EVERY) {
            return;
        }
        let (seconds, estimate) = (
            f64::from(TICK) * f64::from(tick),
            &firmware.estimator.estimate(),
        );
        let change = KNOWN.base.change(estimate);
        for (_, column, points) in &mut lines {
            let found = f64::from(KNOWN.nominal[*column] + change[*column]);
            points.push((seconds, found / truth[*column]));
        }
        let model = possible(&KNOWN, estimate).and_then(|all| Model::of(&all));
        let [error, _] = validation(&model.expect("a possible one"));
        errors.push((seconds, 100.0 * f64::from(error)));
    });
    // The error of the model without the load is found in the weighing before the last one.
    let tare = *weighings.last().expect("a weighing");
    let load = core::array::from_fn(|i| greedy.estimate()[i] - tare[i]);
    let lines = lines.into_iter().map(|(name, _, points)| (name, points));
    Curves {
        lines: lines.collect(),
        errors,
        outcome: outcome.expect("a run"),
        by_tag_k: load,
    }
}

fn charts() -> (Vec<Chart>, Vec<(String, &'static str, f64)>) {
    let Curves {
        lines,
        errors: smooth,
        outcome,
        by_tag_k,
    } = curves(SMOOTH);
    let sticking = curves(BRISTLES).errors;
    let seconds = || Scale::linear("s of motion", [0.0, 30.0]);
    let parameters = Chart {
        title: "The first estimated parameter of each kind, with its joint; Coulomb friction"
            .into(),
        x: seconds(),
        y: Scale::linear("estimate over truth", [0.5, 1.5]),
        lines,
        dots: false,
    };
    let errors = Chart {
        title: "Error of the torques on another path, by the friction of the arm".into(),
        x: seconds(),
        y: Scale::decades("% of the torques", [1.0, 100.0]),
        lines: vec![("Coulomb".into(), smooth), ("LuGre".into(), sticking)],
        dots: false,
    };
    let [[before, _], [after, _]] = outcome.errors;
    let left = [
        f64::from(after / before),
        f64::from(load_error(&outcome.found)),
        f64::from(load_error(&by_tag_k)),
    ];
    let rows = [LEARNED, WEIGHED, "ur5e payload_update core tag_k"];
    let names = [
        LEARNED,
        WEIGHED,
        "update of a load by TAG-K, without its rows",
    ];
    let estimators = names.map(str::to_owned).into_iter().zip(rows).zip(left);
    let estimators = estimators.map(|((name, row), left)| (name, row, left));
    (vec![parameters, errors], estimators.collect())
}
