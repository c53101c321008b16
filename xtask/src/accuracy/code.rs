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
            return self.between.coast(COAST);
        }
        self.wait = TICKS - 1;
FRESH";

const LINEARISED: &str = "        let posture = FORM::<ROBOT>::posture_by::<KERNEL, f32, BODIES, JOINTS, JOINTS>(&state.q);
        let torque = FORM::<ROBOT>::rnea_at(&posture, state, &EFFECTS);
        let mass_matrix = FORM::<ROBOT>::crba_at(&posture, &EFFECTS);
        self.between.renew(torque, mass_matrix, &state.qdd)
";

/// Where the library has what a piece of code names.
const PATHS: &str = "Core Engine control::Extrapolated control::Held control::Interpolated control::Linearised \
                     effects::Gravity effects::Inertia effects::RIGID_BODY model::Pruned robots::A1Leg robots::Panda \
                     robots::Ur5e state::State trig::Carried trig::Minimax trig::Table";

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
    Ok(match point.on("opt") {
        "s" | "z" => format!(
            "// In Cargo.toml: [profile.release] opt-level = \"{}\"\n{code}",
            point.on("opt")
        ),
        _ => code,
    })
}

/// Type, bodies and joints of a robot whose torques are computed.
pub fn robot(point: &Point) -> Result<(&'static str, &'static str, &'static str)> {
    match &*point.robot {
        "ur5e" => Ok(("Ur5e", "6", "6")),
        "panda" => Ok(("Panda", "7", "7")),
        "a1_leg" => Ok(("A1Leg", "4", "3")),
        _ => Err(lacks(point, "kind")),
    }
}

/// Whether it remembers something from tick to tick.
pub fn ticks(point: &Point) -> bool {
    point.on("rate") != "1" || point.on("trig") == "incremental"
}

fn torques(point: &Point) -> Result<String> {
    let (arm, bodies, joints) = robot(point)?;
    let [model, trig, rate, between] =
        ["model", "trig", "rate", "between"].map(|axis| point.on(axis));
    let (pruned, effects) = match (model, model.strip_prefix("pruned")) {
        ("full", _) => (None, "RIGID_BODY"),
        ("no_coriolis", _) => (None, "(Gravity::EARTH, Inertia)"),
        ("gravity", _) => (None, "Gravity::EARTH"),
        (_, Some(millionths)) => (Some(format!("Pruned<{arm}, {millionths}>")), "RIGID_BODY"),
        _ => return Err(lacks(point, "model")),
    };
    let form = if point.on("form") == "core" {
        "Core"
    } else {
        "Engine"
    };
    let scalar = point.on("arith");
    if !matches!(scalar, "f32" | "f64") {
        return Err(lacks(point, "arith"));
    }
    if !trig.starts_with("table") && !trig.starts_with("minimax") && trig != "incremental" {
        return Err(lacks(point, "trig"));
    }
    let own = if form == "Core" { "table3x4" } else { "table3" };
    let call = if trig == own || scalar == "f64" {
        "FORM::<ROBOT>::rnea(state, &EFFECTS)"
    } else if trig == "incremental" {
        "FORM::<ROBOT>::rnea_at(self.carried.follow(&state.q), state, &EFFECTS)"
    } else {
        "FORM::<ROBOT>::rnea_by::<KERNEL, f32, _, BODIES, JOINTS, JOINTS>(state, &EFFECTS)"
    };
    let kept = match between {
        "held" => "Held<f32, JOINTS>",
        "extrapolated" => "Extrapolated<f32, JOINTS, TICKS>",
        "interpolated" => "Interpolated<f32, JOINTS, TICKS>",
        _ => "Linearised<f32, JOINTS, TICKS>",
    };
    let named = kept.split('<').next().unwrap_or_default();
    let first = call.replace("state", "first");
    let start = if between == "interpolated" {
        first.as_str()
    } else {
        ""
    };
    let reads_first = between == "interpolated" || trig == "incremental";
    let code = if trig == "incremental" {
        let tick = format!("        {call}\n");
        TICKING
            .replace("FIELDS", "    carried: Carried<f32, JOINTS>,\n")
            .replace("START", "carried: Carried::at(first.q)")
            .replace("TICK ", &format!("{tick} "))
    } else if rate == "1" {
        EVERY.replace("CALL", call)
    } else {
        let fresh = match between {
            "linearised" => LINEARISED.to_owned(),
            _ => format!("        self.between.renew({call})\n"),
        };
        let ahead = match between {
            "interpolated" => {
                "        // In a tick that computes, `state` is to be that of TICKS ticks later.\n"
            }
            _ => "",
        };
        let coast = if between == "linearised" {
            "&state.qdd"
        } else {
            ""
        };
        let sparse = SPARSE.replace("COAST", coast).replace("FRESH", &fresh);
        TICKING
            .replace(
                "FIELDS",
                &format!("    between: {kept},\n    wait: usize,\n"),
            )
            .replace(
                "START",
                &format!("between: {named}::start({start}), wait: 0"),
            )
            .replace("TICK ", &format!("{ahead}{sparse} "))
    };
    let values = [
        ("FORM", form),
        ("ROBOT", pruned.as_deref().unwrap_or(arm)),
        ("EFFECTS", effects),
        ("KERNEL", kernel(trig)),
        ("BODIES", bodies),
        ("JOINTS", joints),
        ("TICKS", rate),
        ("FIRST", if reads_first { "first" } else { "_first" }),
        ("f32", scalar),
    ];
    let code = values
        .iter()
        .fold(code, |code, (word, value)| code.replace(word, value));
    let uses = PATHS.split_whitespace().filter(|path| {
        let name = path.rsplit("::").next().unwrap_or_default();
        code.split(|letter: char| !letter.is_alphanumeric() && letter != '_')
            .any(|word| word == name)
    });
    let uses: String = uses
        .map(|path| format!("use dynamics_core::{path};\n"))
        .collect();
    Ok(format!("{uses}\n{code}"))
}

fn simulation(point: &Point) -> Result<String> {
    if point.on("scene") != "free" {
        return Err(lacks(point, "scene"));
    }
    let scalar = point.on("arith");
    let (integrator, kind) = match point.on("integrator") {
        "euler" => ("Euler", "Euler".to_owned()),
        "semi_implicit" => ("SemiImplicit", "SemiImplicit".to_owned()),
        "rk4" => ("RungeKutta", "RungeKutta".to_owned()),
        "energy" => ("EnergyKept", format!("EnergyKept<{scalar}>")),
        _ => return Err(lacks(point, "integrator")),
    };
    let (path, robot, n) = match &*point.robot {
        "ur5e" => ("dynamics_core::robots::Ur5e", "Ur5e", "6"),
        _ => (
            "firmware_demo::accuracy::let_go::DoublePendulum",
            "DoublePendulum",
            "2",
        ),
    };
    let step: f64 = point.on("step").parse().map_err(|_| lacks(point, "step"))?;
    let compensated = (point.on("state") == "compensated").to_string();
    let values = [
        ("dynamics_core::robots::Ur5e", path),
        ("Ur5e", robot),
        ("integrator: RungeKutta", &format!("integrator: {kind}")),
        ("RungeKutta", integrator),
        ("1000.0e-6", &format!("{step:?}e-6")),
        ("true", &compensated),
        ("6]", &format!("{n}]")),
        ("6,", &format!("{n},")),
        ("6>", &format!("{n}>")),
        ("f32", scalar),
    ];
    Ok(values
        .iter()
        .fold(SIMULATION.to_owned(), |code, (word, value)| {
            code.replace(word, value)
        }))
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
