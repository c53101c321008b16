//! The cost that each effect adds to inverse dynamics, and the torque that it contributes.

mod picture;

use std::collections::BTreeMap;
use std::str::FromStr;

use serde::Serialize;

use crate::kit::error::{Result, check};
use crate::kit::meter::MODEL;
use crate::kit::progress::Spinner;
use crate::kit::rows::{self, Row};
use crate::kit::table::Table;
use crate::kit::toolchain::RELEASE;
use crate::kit::{firmware, host_bin::SHARED, workspace};
use crate::studies::scenes;
use crate::studies::study::{Bench, Found};

const FEATURE: &str = "effects";
/// Several, so that they build side by side.
const BINS: [&str; 5] = [
    "effects_core",
    "effects_joints_ur5e",
    "effects_bodies_ur5e",
    "effects_joints_panda",
    "effects_bodies_panda",
];
const HOST_BIN: &str = "effects";

/// The scene that others are compared with, and the prefix of the names of those without a term of
/// it.
const RIGID: &str = "rigid_body";
const WITHOUT: &str = "less_";

/// The additional cost of an effect in a form: the fields are those of the JSON.
#[derive(Clone, Debug, Serialize)]
pub struct Price {
    pub effect: String,
    pub robot: String,
    /// `core` or `engine`.
    pub form: String,
    /// Instructions of the longest call, exact; negative where it lets the compiler do better.
    pub instructions: i64,
    /// Modelled cycles of the longest call.
    pub cycles: i64,
    /// Code of the function and of all that it calls, in bytes.
    pub code_bytes: i64,
    /// The effect's numbers and what it remembers, in bytes.
    pub ram_bytes: i64,
    /// Root mean square over the reference trajectory of |Δτ|, N·m.
    pub torque_rms_nm: f64,
}

/// Measures costs in QEMU and torques on the host.
pub fn measure(bench: &Bench<'_>) -> Result<Found> {
    let (prices, rustc) = (prices(bench)?, bench.rustc()?);
    let table = in_rows(&prices).markdown();
    let scenes = workspace::read(&bench.workspace.root.join(scenes::PAGE.file))?;
    Ok(Found {
        picture: Some(picture::svg(&prices, &picture::factors(&scenes))?),
        summary: format!("{} prices", prices.len()),
        ..Found::new(format!("{table}\n{MODEL}. Measured with {rustc}."), &prices)?
    })
}

fn prices(bench: &Bench<'_>) -> Result<Vec<Price>> {
    let (workspace, tools) = (bench.workspace, bench.tools()?);
    let building = Spinner::start(&format!("building {}", BINS.join(", ")));
    let elves = firmware::build_with(workspace, tools.toolchain, RELEASE, FEATURE, &BINS, None)?;
    drop(building);
    let (rows, lines) = rows::run_all(workspace, tools, &BINS, &elves)?;
    let sizes = lines.iter().filter_map(|line| holds(line)).collect();
    let _spinner = Spinner::start("computing torques on the host");
    let torques = SHARED.text(workspace, HOST_BIN)?;
    let torques = torques.lines().filter_map(torque).collect();
    priced(&rows, &sizes, &torques)
}

/// The N names and the number of a line `WORD NAME… NUMBER`.
fn named<const N: usize, T: FromStr>(line: &str, word: &str) -> Option<([String; N], T)> {
    let mut words: Vec<&str> = line.strip_prefix(word)?.split(' ').skip(1).collect();
    let number = words.pop()?.parse().ok()?;
    let names = <[&str; N]>::try_from(words).ok()?;
    Some((names.map(str::to_owned), number))
}

/// Robot, form and scene, and the bytes of its effects.
fn holds(line: &str) -> Option<([String; 3], i64)> {
    named(line, "holds")
}

/// Robot and scene, and its torque.
fn torque(line: &str) -> Option<([String; 2], f64)> {
    named(line, "effect")
}

/// Every scene's difference to the rigid body.
fn priced(
    rows: &[Row],
    sizes: &BTreeMap<[String; 3], i64>,
    torques: &BTreeMap<[String; 2], f64>,
) -> Result<Vec<Price>> {
    let mut prices = Vec::new();
    for row in rows.iter().filter(|row| row.inputs != RIGID) {
        let (robot, form, scene) = (&row.robot, &row.form, &row.inputs);
        let missing = |what| check!("there is no {what} of {robot} {form} {scene}");
        let rigid =
            |other: &&Row| (&*other.inputs, &other.form, &other.robot) == (RIGID, form, robot);
        let rigid = rows.iter().find(rigid);
        let rigid = rigid.ok_or_else(|| missing("rigid body beside that"))?;
        let bytes = |scene: &str| sizes.get(&[robot, form, scene].map(str::to_owned));
        let bytes = bytes(scene).zip(bytes(RIGID));
        let (own, of_rigid) = bytes.ok_or_else(|| missing("size"))?;
        // An effect that a scene lacks is one of the rigid body's own.
        let (effect, sign) = match row.inputs.strip_prefix(WITHOUT) {
            Some(term) => (term, -1),
            None => (&*row.inputs, 1),
        };
        let torque = torques.get(&[robot.clone(), scene.clone()]);
        let added = |one: u64, other: u64| sign * (one.cast_signed() - other.cast_signed());
        prices.push(Price {
            effect: effect.into(),
            robot: row.robot.clone(),
            form: row.form.clone(),
            instructions: added(row.instructions.max, rigid.instructions.max),
            cycles: added(row.cycles.max, rigid.cycles.max),
            code_bytes: added(row.code_bytes, rigid.code_bytes),
            ram_bytes: sign * (own - of_rigid),
            torque_rms_nm: *torque.ok_or_else(|| missing("torque"))?,
        });
    }
    Ok(prices)
}

/// An effect a row, core and engine side by side.
fn in_rows(prices: &[Price]) -> Table {
    let mut sorted: Vec<&Price> = prices.iter().filter(|p| p.form == "core").collect();
    // Robots side by side, effects in the catalogue's order.
    sorted.sort_by_key(|price| prices.iter().position(|p| p.effect == price.effect));
    let engine = |core: &Price, figure: fn(&Price) -> i64| {
        let found = prices.iter().find(|price| {
            (&*price.form, &price.effect, &price.robot) == ("engine", &core.effect, &core.robot)
        });
        found.map_or("–".into(), |engine| figure(engine).to_string())
    };
    Table::of(
        sorted,
        &[
            ("effect, robot", &|p| format!("{} {}", p.effect, p.robot)),
            ("cycles: core", &|p| p.cycles.to_string()),
            ("engine", &|p| engine(p, |p| p.cycles)),
            ("code: core", &|p| p.code_bytes.to_string()),
            ("engine", &|p| engine(p, |p| p.code_bytes)),
            ("torque, N·m", &|p| format!("{:.3}", p.torque_rms_nm)),
        ],
    )
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::{holds, priced, torque};
    use crate::kit::rows::Row;

    fn row(inputs: &str, cost: u64) -> Row {
        Row::sample(["ur5e", "rnea", "core", inputs], cost)
    }

    #[test]
    fn an_effect_costs_what_its_scene_takes_more() {
        let rows = [row("viscous", 130), row("rigid_body", 100), row("less_gravity", 80)];
        let lines = [
            "holds ur5e core viscous 40",
            "config …",
            "holds ur5e core rigid_body 16",
            "holds ur5e core less_gravity 0",
        ];
        let sizes: BTreeMap<_, _> = lines.iter().filter_map(|line| holds(line)).collect();
        let torques = ["effect ur5e viscous 3.5", "effect ur5e less_gravity 40"];
        let torques = torques.iter().filter_map(|line| torque(line)).collect();
        let prices = priced(&rows, &sizes, &torques).expect("complete");
        let found: Vec<_> =
            prices.iter().map(|p| (&*p.effect, p.cycles, p.ram_bytes, p.torque_rms_nm)).collect();
        assert_eq!(found, [("viscous", 30, 24, 3.5), ("gravity", 20, 16, 40.0)]);
        assert!(priced(&rows, &sizes, &BTreeMap::new()).is_err());
        assert!(priced(&rows[..1], &sizes, &torques).is_err());
    }
}
