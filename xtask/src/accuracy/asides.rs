//! docs/accuracy.md: what stands beside the fronts.

use super::front;
use super::join::Host;
use super::margin::yardstick;
use super::measure::Robot;
use super::page::shown;
use super::point::{Point, Yardstick};
use super::words::{cycles, digits, name};
use crate::table::{Table, thousands};

/// What errors are held against, and how good that is.
pub fn oracle(host: &Host, robot: Robot) -> String {
    let mut lines = host.oracles.iter();
    let line = lines.find(|(name, line)| name == robot.name() && line["pinocchio"].is_string());
    let Some((_, line)) = line else {
        return String::new();
    };
    let told = |name: &str| {
        let part = &line[name];
        let share = part["relative_max"]
            .as_f64()
            .map_or_else(|| "–".into(), digits);
        format!("{share} of full scale on {} states", part["answers"])
    };
    let version = line["pinocchio"].as_str().unwrap_or_default();
    format!(
        "The f64 that errors are held against is off by at most {} from Pinocchio {version}, and by at most {} from 50 \
         digits.\n\n",
        told("f64_against_recorded"),
        told("f64_against_50_digits")
    )
}

/// All that is on a front, with the numbers that the picture has, folded away.
pub fn every(points: &[&Point]) -> String {
    let columns = [
        "no.",
        "configuration",
        "worst tick",
        "mean",
        "max, N·m",
        "of full scale",
        "front",
    ];
    let mut table = Table::new(&columns);
    for (i, point) in front::numbered(points).into_iter().enumerate() {
        table.row([
            (i + 1).to_string(),
            name(point),
            thousands(point.cycles),
            cycles(point.cycles_mean),
            digits(point.error()),
            point.relative_max.map_or_else(|| "–".into(), digits),
            match point.fronts {
                [true, true] => "both",
                [true, false] => "worst tick",
                _ => "mean",
            }
            .into(),
        ]);
    }
    format!(
        "<details><summary>Every point of the fronts, by its number in the picture</summary>\n\n{}\n</details>\n\n",
        table.markdown()
    )
}

/// Errors joint by joint, folded away.
pub fn joints(points: &[&Point]) -> String {
    let counts = points.iter().map(|point| point.joints.len());
    let count = counts.max().unwrap_or_default();
    let heads: Vec<String> = (1..=count).map(|joint| format!("joint {joint}")).collect();
    let heads: Vec<&str> = ["configuration"]
        .into_iter()
        .chain(heads.iter().map(String::as_str))
        .collect();
    let mut table = Table::new(&heads);
    let mut both = shown(points, 0);
    both.extend(
        shown(points, 1)
            .into_iter()
            .filter(|point| !point.is_default()),
    );
    for point in both {
        let each = point.joints.iter().map(|joint| {
            format!(
                "{} / {} / {}",
                digits(joint.max),
                digits(joint.p99),
                digits(joint.rms)
            )
        });
        table.row([name(point)].into_iter().chain(each));
    }
    format!(
        "<details><summary>Joint by joint: max / 99 % / RMS, N·m</summary>\n\n{}\n</details>\n\n",
        table.markdown()
    )
}

/// The ways to the motors of joints that give way.
pub fn compliant(points: &[&Point]) -> String {
    let slow = points
        .iter()
        .find(|point| point.on("model") == "compliant" && point.on("opt") == "3");
    let fast = points
        .iter()
        .find(|point| point.on("model") == "rigid" && point.on("opt") == "3");
    let (Some(slow), Some(fast)) = (slow, fast) else {
        return String::new();
    };
    format!(
        "### Joints that give way\n\nOn joints as springy as harmonic drives, along a smooth swing: taken for rigid, \
         the motors' torques cost {} cycles and are off by up to {} N·m; computed with their springs, {} cycles \
         and {} N·m.\n\n",
        thousands(fast.cycles),
        digits(fast.error()),
        thousands(slow.cycles),
        digits(slow.error())
    )
}

/// What leaving out velocity products loses at which speeds.
pub fn speeds(host: &Host, robot: Robot) -> String {
    let own = host.speeds.iter().filter(|it| it.robot == robot.name());
    let mut table = Table::new(&["joints as fast as, rad/s", "max, N·m", "of full scale"]);
    for it in own {
        table.row([
            digits(it.speed),
            digits(it.error_max),
            digits(it.relative_max),
        ]);
    }
    format!(
        "### Without Coriolis: how slow is slow enough\n\n{}\n",
        table.markdown()
    )
}

/// What else is off.
pub fn yardsticks(own: &[&Yardstick]) -> Table {
    let mut table = Table::new(&["what is off", "max, N·m", "99 %", "RMS", "of full scale"]);
    for line in own {
        let what = match &*line.what {
            "" => yardstick(line).to_owned(),
            what => what.to_owned(),
        };
        let errors = [
            line.error_max,
            line.error_p99,
            line.error_rms,
            line.relative_max,
        ];
        table.row([what].into_iter().chain(errors.map(digits)));
    }
    table
}
