//! A configuration as Rust to paste.

use super::point::{Kind, Point};
use super::words::kernel;
use crate::error::{Error, Result};

/// In every tick. Capitals stand for what a configuration puts there.
const EVERY: &str = "\
/// Torques of a motion, N·m.
#[inline]
pub fn torques(state: &State<f32, JOINTS, JOINTS>) -> [f32; JOINTS] {
    CALL
}
";

/// In every tick or in every few of them, with something to remember.
const TICKING: &str = "\
/// Torques of a motion, tick by tick.
pub struct Torques {
FIELDS}

impl Torques {
    /// Before the first tick, which will be that of this state.
    pub fn start(FIRST: &State<f32, JOINTS, JOINTS>) -> Self {
        Self { START }
    }

    /// Torques of this tick, N·m.
    #[inline(never)]
    pub fn tick(&mut self, state: &State<f32, JOINTS, JOINTS>) -> [f32; JOINTS] {
TICK    }
}
";

/// What a tick in every few is.
const SPARSE: &str = "        if self.wait > 0 {
            self.wait -= 1;
            return self.between.hold(COAST);
        }
        self.wait = TICKS - 1;
FRESH";

const LINEARISED: &str = "        let trig = FORM::<ROBOT, KERNEL>::joint_trig(&state.q);
        let torque = FORM::<ROBOT>::rnea(trig.with(state), &EFFECTS);
        let mass_matrix = FORM::<ROBOT>::crba(&trig, &EFFECTS);
        self.between.update(torque, mass_matrix, &state.qdd)
";

/// Where the library has what a piece of code names.
const PATHS: &str = "Core Engine control::FirstOrderHold control::ZeroOrderHold control::Interpolator control::InertiaUpdate \
                     effects::Gravity effects::Inertia effects::RIGID_BODY model::Pruned robots::A1Leg robots::Panda \
                     robots::Ur5e state::State state::IncrementalTrig trig::Minimax trig::Table";

/// The simulation of the UR5e, which the tests compile and run.
const SIMULATION: &str = include_str!("../../../host-tests/tests/pasted/ur5e_rk4.rs");

/// Whether, and why not, there is code: what the library does not ship cannot be pasted.
fn lacks(point: &Point, axis: &str) -> Error {
    Error::check(format!(
        "there is no Rust to paste of {} with {axis}={}: see firmware-demo/src/accuracy",
        point.robot,
        point.on(axis)
    ))
}

/// The code, with what has to stand in the user's manifest.
pub fn rust(point: &Point) -> Result<String> {
    let code = match point.kind {
        Kind::Simulation => simulation(point)?,
        Kind::Inverse => torques(point)?,
    };
    let opt = point.on("opt");
    let manifest = format!("// In Cargo.toml: [profile.release] opt-level = \"{opt}\"\n");
    Ok(pick(matches!(opt, "s" | "z"), &manifest, "").to_owned() + &code)
}

fn pick<'a>(first: bool, one: &'a str, other: &'a str) -> &'a str {
    if first { one } else { other }
}

/// The code with each of these words replaced, one after the other.
fn filled(code: String, values: &[(&str, &str)]) -> String {
    let fill = |code: String, (word, value): &(&str, &str)| code.replace(word, value);
    values.iter().fold(code, fill)
}

/// Whether it remembers something from tick to tick.
pub fn ticks(point: &Point) -> bool {
    point.on("rate") != "1" || point.on("trig") == "incremental"
}

fn torques(point: &Point) -> Result<String> {
    let axes = ["model", "trig", "rate", "between", "arith"];
    let [model, trig, rate, between, scalar] = axes.map(|axis| point.on(axis));
    let (arm, joints) = match &*point.robot {
        "ur5e" => ("Ur5e", "6"),
        "panda" => ("Panda", "7"),
        "a1_leg" => ("A1Leg", "3"),
        _ => return Err(lacks(point, "kind")),
    };
    let mut robot = arm.to_owned();
    let effects = match (model, model.strip_prefix("pruned")) {
        ("full", _) => "RIGID_BODY",
        ("no_coriolis", _) => "(Gravity::EARTH, Inertia)",
        ("gravity", _) => "(Gravity::EARTH,)",
        (_, Some(millionths)) => {
            robot = format!("Pruned<{arm}, {millionths}>");
            "RIGID_BODY"
        }
        _ => return Err(lacks(point, "model")),
    };
    if !matches!(scalar, "f32" | "f64") {
        return Err(lacks(point, "arith"));
    }
    let core = point.on("form") == "core";
    let own = trig == pick(core, "table3x4", "table3") || scalar == "f64";
    let call = match trig {
        _ if own => "FORM::<ROBOT>::rnea(state, &EFFECTS)",
        "incremental" => "FORM::<ROBOT>::rnea(self.carried.follow(&state.q).with(state), &EFFECTS)",
        "libm" | "micromath" => return Err(lacks(point, "trig")),
        _ => "FORM::<ROBOT, KERNEL>::rnea(state, &EFFECTS)",
    };
    let (first, renewed) = (
        call.replace("state", "first"),
        format!("        self.between.update({call})\n"),
    );
    let (kept, start, coast, fresh) = match between {
        "held" => (
            "ZeroOrderHold<f32, JOINTS>",
            "ZeroOrderHold::start()",
            "",
            &*renewed,
        ),
        "extrapolated" => (
            "FirstOrderHold<f32, JOINTS, TICKS>",
            "FirstOrderHold::start()",
            "",
            &*renewed,
        ),
        "interpolated" => (
            "Interpolator<f32, JOINTS, TICKS>",
            "Interpolator::start(CALL)",
            "",
            &*renewed,
        ),
        _ => (
            "InertiaUpdate<f32, JOINTS, TICKS>",
            "InertiaUpdate::start()",
            "&state.qdd",
            LINEARISED,
        ),
    };
    let interpolated = between == "interpolated";
    let ahead = "        // In a tick that computes, `state` is to be that of TICKS ticks later.\n";
    let sparse = SPARSE.replace("COAST", coast).replace("FRESH", fresh);
    let (fields, start, tick) = match rate {
        "1" => (
            "    carried: IncrementalTrig<f32, JOINTS>,\n".into(),
            "carried: IncrementalTrig::at(first.q)".into(),
            format!("        {call}\n"),
        ),
        _ => (
            format!("    between: {kept},\n    wait: usize,\n"),
            format!("between: {start}, wait: 0"),
            pick(interpolated, ahead, "").to_owned() + &sparse,
        ),
    };
    let code = match ticks(point) {
        false => EVERY.replace("CALL", call),
        true => filled(
            TICKING.into(),
            &[
                ("FIELDS", &fields),
                ("START", &start),
                ("CALL", &first),
                ("TICK ", &(tick + " ")),
            ],
        ),
    };
    let reads_first = interpolated || trig == "incremental";
    let values = [
        ("FORM", pick(core, "Core", "Engine")),
        ("ROBOT", &robot),
        ("EFFECTS", effects),
        ("KERNEL", kernel(trig)),
        ("JOINTS", joints),
        ("TICKS", rate),
        ("FIRST", pick(reads_first, "first", "_first")),
        ("f32", scalar),
    ];
    let code = filled(code, &values);
    let uses = PATHS.split_whitespace().filter(|path| {
        let name = path.rsplit("::").next().unwrap_or_default();
        let mut words = code.split(|letter: char| !letter.is_alphanumeric() && letter != '_');
        words.any(|word| word == name)
    });
    let uses: String = uses
        .map(|path| format!("use dynamics_core::{path};\n"))
        .collect();
    Ok(format!("{uses}\n{code}"))
}

fn simulation(point: &Point) -> Result<String> {
    let scalar = point.on("arith");
    let kept = format!("EnergyProjected<{scalar}>");
    let integrator = match (point.on("scene"), point.on("integrator")) {
        ("free", "euler") => "Euler",
        ("free", "semi_implicit") => "SemiImplicit",
        ("free", "rk4") => "RungeKutta",
        ("free", "energy") => &kept,
        _ => return Err(lacks(point, "integrator")),
    };
    let arm = point.robot == "ur5e";
    let pendulum = "firmware_demo::accuracy::let_go::DoublePendulum";
    let n = pick(arm, "6", "2");
    let [array, generic, last] = ["]", ",", ">"].map(|end| format!("{n}{end}"));
    let step: f64 = point.on("step").parse().map_err(|_| lacks(point, "step"))?;
    let values = [
        (
            "dynamics_core::robots::Ur5e",
            pick(arm, "dynamics_core::robots::Ur5e", pendulum),
        ),
        ("Ur5e", pick(arm, "Ur5e", "DoublePendulum")),
        (
            "integrator: RungeKutta",
            &format!("integrator: {integrator}"),
        ),
        (
            ", RungeKutta",
            &format!(", {}", integrator.split('<').next().unwrap_or_default()),
        ),
        ("1000.0e-6", &format!("{step:?}e-6")),
        (
            "true",
            pick(point.on("state") == "compensated", "true", "false"),
        ),
        ("6]", &array),
        ("6,", &generic),
        ("6>", &last),
        ("f32", scalar),
    ];
    Ok(filled(SIMULATION.to_owned(), &values))
}

#[cfg(test)]
mod tests {
    use super::super::front::tests::point;
    use super::super::point::{Kind, Point};
    use super::super::recorded;
    use super::rust;
    use crate::docs::repository::root;

    fn recorded() -> Vec<Point> {
        let text = std::fs::read_to_string(root().join(recorded::FILE)).expect("a record");
        serde_json::from_str(&text).expect("points")
    }

    #[test]
    fn the_default_prints_as_five_lines() {
        let points = recorded();
        let default = points
            .iter()
            .find(|p| p.is_default() && p.robot == "ur5e")
            .expect("a default");
        let code = "use dynamics_core::Engine;\nuse dynamics_core::effects::RIGID_BODY;\nuse dynamics_core::robots::Ur5e;\n\
                    use dynamics_core::state::State;\n\n/// Torques of a motion, N·m.\n#[inline]\n\
                    pub fn torques(state: &State<f32, 6, 6>) -> [f32; 6] {\n    Engine::<Ur5e>::rnea(state, &RIGID_BODY)\n}\n";
        assert_eq!(rust(default).expect("there is code"), code);
    }

    /// All that the library ships has code, in which nothing is left to be filled in.
    #[test]
    fn whatever_the_library_ships_can_be_pasted() {
        let shipped = |point: &&Point| match point.kind {
            Kind::Simulation => {
                point.on("scene") == "free" && point.on("integrator") != "implicit_damping"
            }
            Kind::Inverse => {
                point.on("plant") == "rigid"
                    && matches!(point.on("arith"), "f32" | "f64")
                    && !matches!(point.on("trig"), "libm" | "micromath")
                    && !point.on("model").starts_with("params")
            }
        };
        let points = recorded();
        assert!(points.iter().filter(shipped).count() > 1000);
        for point in points.iter().filter(shipped) {
            let code = rust(point).unwrap_or_else(|e| panic!("{} {}: {e}", point.robot, point.key));
            for blank in [
                "FORM", "ROBOT", "JOINTS", "TICK", "CALL", "START", "FRESH", "FIELDS", "<>",
            ] {
                assert!(
                    !code.contains(blank),
                    "{} {}:\n{code}",
                    point.robot,
                    point.key
                );
            }
        }
    }

    /// With the values of the printed simulation itself, the text is the file that the tests compile and run.
    #[test]
    fn the_simulation_that_is_tested_is_the_one_that_is_printed() {
        let points = recorded();
        let key = "integrator=rk4,state=compensated,step=1000";
        let point = points.iter().find(|p| p.robot == "ur5e" && p.key == key);
        assert_eq!(
            rust(point.expect("it was measured")).expect("code"),
            super::SIMULATION
        );
    }

    #[test]
    fn what_has_no_code_says_so() {
        let mut other = point("arith=q31", 1.0, 1, 1.0);
        assert!(rust(&other).is_err());
        other.robot = "ur5e".into();
        let said = rust(&other).expect_err("it has no model").to_string();
        assert!(said.contains("no Rust to paste"), "{said}");
    }
}
