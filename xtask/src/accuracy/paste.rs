//! A configuration as Rust to paste.

use super::parts::{Parts, robot};
use super::point::{Kind, Point};
use super::simulator;
use crate::error::{Error, Result};

/// The code, with its figures above it.
pub fn rust(point: &Point) -> Result<String> {
    if point.kind == Kind::Simulation {
        return simulator::code(point);
    }
    let profile = match point.on("opt") {
        "3" => String::new(),
        opt => format!("// In Cargo.toml: [profile.release] opt-level = \"{opt}\"\n"),
    };
    Ok(format!("{profile}{}", code(point)?))
}

/// The code alone.
pub fn code(point: &Point) -> Result<String> {
    let mut parts = Parts::of(point)?;
    let items = match (point.on("rate"), point.on("trig")) {
        ("1", "incremental") => carried(&parts),
        ("1", _) => every(&parts),
        (_, "incremental") => {
            return Err(Error::check(
                "sines carried along are not for ticks left out",
            ));
        }
        (rate, _) if point.on("between") == "linearised" => {
            parts.uses.push("control::InertiaUpdate");
            linearised(&mut parts, rate)
        }
        (rate, _) => between(&mut parts, rate, point.on("between")),
    };
    let base = robot(point)?.0;
    let base = format!("robots::{base}");
    parts.uses.push(&base);
    parts.uses.sort_unstable();
    let uses: String = parts
        .uses
        .iter()
        .map(|it| format!("use dynamics_core::{it};\n"))
        .collect();
    let form = parts.form;
    Ok(format!(
        "use dynamics_core::{form};\n{uses}\n{}{items}",
        parts.items
    ))
}

fn every(parts: &Parts<'_>) -> String {
    format!(
        "/// Torques of a motion, N·m.\n#[inline]\npub fn torques(state: &{}) -> {} {{\n    {}\n}}\n",
        parts.state(),
        parts.torque(),
        parts.call("state")
    )
}

/// A struct that is asked tick by tick.
fn ticking(parts: &Parts<'_>, fields: &str, start: &str, tick: &str) -> String {
    let (state, torque) = (parts.state(), parts.torque());
    let first = if start.contains("first") {
        "first"
    } else {
        "_first"
    };
    format!(
        "/// Torques of a motion, tick by tick.\npub struct Torques {{\n{fields}}}\n\nimpl Torques {{\n    \
         /// Before the first tick, which will be that of this state.\n    \
         pub fn start({first}: &{state}) -> Self {{\n        Self {{\n{start}        }}\n    }}\n\n    \
         /// Torques of this tick, N·m.\n    #[inline(never)]\n    \
         pub fn tick(&mut self, state: &{state}) -> {torque} {{\n{tick}    }}\n}}\n"
    )
}

fn carried(parts: &Parts<'_>) -> String {
    let Parts {
        robot,
        form,
        effects,
        joints,
        ..
    } = parts;
    ticking(
        parts,
        &format!("    carried: Carried<f32, {joints}>,\n"),
        "            carried: Carried::at(first.q),\n",
        &format!(
            "        {form}::<{robot}>::rnea(self.carried.follow(&state.q).with(state), &{effects})\n"
        ),
    )
}

const WAIT: &str = "        if self.wait > 0 {\n            self.wait -= 1;\n            return self.between.hold(";

fn between(parts: &mut Parts<'_>, rate: &str, between: &str) -> String {
    let n = parts.joints;
    let (used, kind, start) = match between {
        "held" => (
            "control::Held",
            format!("Held<f32, {n}>"),
            "Held::start()".to_owned(),
        ),
        "extrapolated" => (
            "control::FirstOrderHold",
            format!("FirstOrderHold<f32, {n}, {rate}>"),
            "FirstOrderHold::start()".to_owned(),
        ),
        _ => (
            "control::Interpolator",
            format!("Interpolator<f32, {n}, {rate}>"),
            format!("Interpolator::start({})", parts.call("first")),
        ),
    };
    parts.uses.push(used);
    let ahead = match between {
        "interpolated" => format!(
            "        // In a tick that computes, `state` is to be that of {rate} ticks later.\n"
        ),
        _ => String::new(),
    };
    ticking(
        parts,
        &format!("    between: {kind},\n    wait: usize,\n"),
        &format!("            between: {start},\n            wait: 0,\n"),
        &format!(
            "{ahead}{WAIT});\n        }}\n        self.wait = {rate} - 1;\n        \
             self.between.update({})\n",
            parts.call("state")
        ),
    )
}

fn linearised(parts: &mut Parts<'_>, rate: &str) -> String {
    let Parts {
        robot,
        effects,
        joints,
        ..
    } = parts;
    let kernel = match parts.kernel {
        Some(kernel) => kernel,
        None => {
            parts.uses.push("trig::Table");
            "Table<128, 3>"
        }
    };
    let fields = format!("    between: InertiaUpdate<f32, {joints}, {rate}>,\n    wait: usize,\n");
    let tick = format!(
        "{WAIT}&state.qdd);\n        }}\n        self.wait = {rate} - 1;\n        \
         let trig = Engine::<{robot}, {kernel}>::joint_trig(&state.q);\n        \
         let torque = Engine::<{robot}>::rnea(trig.with(state), &{effects});\n        \
         let mass_matrix = Engine::<{robot}>::crba(&trig, &{effects});\n        \
         self.between.update(torque, mass_matrix, &state.qdd)\n"
    );
    let start = "            between: InertiaUpdate::start(),\n            wait: 0,\n";
    ticking(parts, &fields, start, &tick)
}

#[cfg(test)]
mod tests {
    use super::super::front::tests::point;
    use super::super::point::Point;
    use super::code;

    /// A way with all its axes.
    fn way(robot: &str, key: &str) -> Point {
        let usual = [
            ("arith", "f32"),
            (
                "trig",
                if key.contains("form=core") {
                    "table3x4"
                } else {
                    "table3"
                },
            ),
            ("model", "full"),
            ("rate", "1"),
            ("between", "held"),
            ("form", "engine"),
            ("opt", "3"),
        ];
        let mut point = point(key, 1.0, 1, 1.0);
        point.robot = robot.into();
        for (axis, value) in usual {
            let axis = point.configuration.entry(axis.into());
            axis.or_insert_with(|| value.into());
        }
        point
    }

    /// What the firmware's directory `pasted` has, which is built and measured.
    macro_rules! file {
        ($name:literal) => {
            include_str!(concat!(
                "../../../firmware-demo/src/accuracy/pasted/",
                $name,
                ".rs"
            ))
        };
    }

    #[test]
    fn what_is_printed_is_what_is_measured() {
        let files = [
            ("ur5e", "default", file!("ur5e_default")),
            ("ur5e", "trig=table", file!("ur5e_table")),
            ("ur5e", "model=no_coriolis", file!("ur5e_no_coriolis")),
            ("ur5e", "model=params8", file!("ur5e_params8")),
            ("ur5e", "model=pruned1000", file!("ur5e_pruned")),
            ("ur5e", "form=core", file!("ur5e_core")),
            ("ur5e", "trig=incremental", file!("ur5e_incremental")),
            ("ur5e", "rate=10", file!("ur5e_held")),
            (
                "ur5e",
                "rate=10,between=interpolated",
                file!("ur5e_interpolated"),
            ),
            (
                "ur5e",
                "rate=10,between=linearised",
                file!("ur5e_linearised"),
            ),
            ("a1_leg", "trig=minimax7", file!("a1_leg_minimax7")),
        ];
        // Rustfmt may break lines where it likes, and then adds commas.
        let words = |text: &str| {
            text.replace(",)", ")")
                .split_whitespace()
                .collect::<String>()
                .replace(",)", ")")
        };
        for (robot, key, file) in files {
            let printed = code(&way(robot, key)).expect("there is code");
            assert_eq!(
                words(file),
                words(&printed),
                "{robot} {key} prints:\n{printed}"
            );
        }
    }

    #[test]
    fn what_has_no_code_says_so() {
        assert!(code(&way("ur5e", "arith=q31,form=core")).is_err());
        assert!(code(&way("double_pendulum", "default")).is_err());
    }
}
