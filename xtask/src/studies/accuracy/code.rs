//! A configuration as Rust to paste.

use super::names;
use super::point::{Kind, Point};
use super::robot::Robot;
use crate::kit::error::{Result, check, refuse_if};

/// The paths of the items of dynamics-core in generated code.
const DYNAMICS: &str = "Core Engine effects::Gravity effects::Inertia effects::RIGID_BODY model::Pruned robots::A1Leg \
                        robots::Panda robots::Ur5e state::State state::IncrementalTrig trig::Minimax trig::Table";
/// The names of the controller's items in generated code.
const CONTROL: &str = "law::FirstOrderHold law::ZeroOrderHold law::Interpolator law::InertiaUpdate";

/// The simulation of the UR5e, which the tests compile and run.
const SIMULATION: &str = include_str!("../../../../host-tests/tests/generated/ur5e_rk4.rs");

/// The code.
///
/// # Errors
/// The Rust of a configuration; an error if the library does not ship a part of it.
pub fn rust(point: &Point) -> Result<String> {
    match point.kind {
        Kind::Simulation => simulation(point),
        _ => torques(point),
    }
}

/// The library's types and constants for the values on these axes.
fn shipped<const K: usize>(point: &Point, axes: [&str; K]) -> Result<[&'static str; K]> {
    let mut all = [""; K];
    for (rust, axis) in all.iter_mut().zip(axes) {
        let value = point.on(axis);
        let lacks = || {
            let robot = &point.robot;
            check!(
                "there is no Rust to paste of {robot} with {axis}={value}: see host-tests/fixtures/src/accuracy"
            )
        };
        *rust = names::rust(axis, value).ok_or_else(lacks)?;
    }
    Ok(all)
}

/// The code with each of these words replaced, one after the other.
pub fn filled(code: &str, values: &[(&str, &str)]) -> String {
    let fill = |code: String, (word, value): &(&str, &str)| code.replace(word, value);
    values.iter().fold(code.to_owned(), fill)
}

/// Whether it remembers something from tick to tick.
pub fn ticks(point: &Point) -> bool {
    point.on("rate") != "1" || point.on("trig") == "incremental"
}

fn torques(point: &Point) -> Result<String> {
    let axes = ["model", "trig", "between", "form", "arith"];
    let [effects, kernel, between, form, scalar] = shipped(point, axes)?;
    let [rate, trig] = ["rate", "trig"].map(|axis| point.on(axis));
    let known = || {
        let mut arms = Robot::COMPUTED.map(Robot::names).into_iter();
        arms.find_map(|[name, _, arm, joints]| (name == point.robot).then_some([arm, joints]))
    };
    let arm = point.own.as_ref();
    let arm = arm.map(|own| own.each_ref().map(String::as_str));
    let lacks = || check!("no torques of {} are computed", point.robot);
    let [arm, joints] = arm.or_else(known).ok_or_else(lacks)?;
    let robot = match point.on("model").strip_prefix("pruned") {
        Some(millionths) => format!("Pruned<{arm}, {millionths}>"),
        None => arm.to_owned(),
    };
    let template = match (rate, trig, point.on("between")) {
        ("1", "incremental", _) => include_str!("templates/carried.txt"),
        ("1", ..) => include_str!("templates/every.txt"),
        (_, _, "interpolated") => include_str!("templates/interpolated.txt"),
        (_, _, "linearised") => include_str!("templates/linearised.txt"),
        _ => include_str!("templates/held.txt"),
    };
    let own = match form {
        "Core" => "table3x4",
        _ => "table3",
    };
    let generics = match [own, "incremental"].contains(&trig) || scalar == "f64" {
        true => robot.clone(),
        false => format!("{robot}, {kernel}"),
    };
    let values = [
        ("BETWEEN", between),
        ("NAME", between.split('<').next().unwrap_or_default()),
        ("FORM", form),
        ("GENERICS", &generics),
        ("ROBOT", &robot),
        ("EFFECTS", effects),
        ("KERNEL", kernel),
        ("JOINTS", joints),
        ("TICKS", rate),
        ("f32", scalar),
    ];
    let code = filled(template, &values);
    let dynamics = DYNAMICS.split_whitespace().map(|path| ("dynamics_core", path));
    let control = CONTROL.split_whitespace().map(|path| ("motion_control", path));
    let uses = dynamics.chain(control).filter(|(_, path)| {
        let name = path.rsplit("::").next().unwrap_or_default();
        let mut words = code.split(|letter: char| !letter.is_alphanumeric() && letter != '_');
        words.any(|word| word == name)
    });
    let uses: String = uses.map(|(library, path)| format!("use {library}::{path};\n")).collect();
    // The user knows in which module of the program the importer's file is.
    let own = point.own.as_ref();
    let own = own.map(|[arm, _]| format!("use crate::robot::{arm};\n"));
    Ok(format!("{uses}{}\n{code}", own.unwrap_or_default()))
}

fn simulation(point: &Point) -> Result<String> {
    let robot = &point.robot;
    refuse_if!(robot != "ur5e", "the library has no {robot}");
    let axes = ["scene", "integrator", "state", "arith"];
    let [_, integrator, compensated, scalar] = shipped(point, axes)?;
    let name = integrator.split('<').next().unwrap_or_default();
    let step: f64 = point.on("step").parse().unwrap_or_default();
    let values = [
        ("integrator: RungeKutta", &*format!("integrator: {integrator}")),
        (", RungeKutta", &format!(", {name}")),
        ("1000.0e-6", &format!("{step:?}e-6")),
        ("true", compensated),
        ("f32", scalar),
    ];
    Ok(filled(SIMULATION, &values))
}

#[cfg(test)]
mod tests {
    use super::super::front::tests::point;
    use super::super::point::{Kind, Point};
    use super::super::recorded;
    use super::rust;
    use crate::kit::docs::repository::read;

    fn recorded() -> Vec<Point> {
        serde_json::from_str(&read(recorded::FILE)).expect("points")
    }

    /// The code of a recorded point of the UR5e.
    fn code_of(key: &str) -> String {
        let points = recorded();
        let point = points.iter().find(|p| p.robot == "ur5e" && p.key == key);
        rust(point.expect("it was measured")).expect("there is code")
    }

    #[test]
    fn the_default_prints_as_five_lines() {
        let code = "use dynamics_core::Engine;\nuse dynamics_core::effects::RIGID_BODY;\nuse dynamics_core::robots::Ur5e;\n\
                    use dynamics_core::state::State;\n\n/// Torques of a motion, N·m.\n#[inline]\n\
                    pub fn torques(state: &State<f32, 6, 6>) -> [f32; 6] {\n    Engine::<Ur5e>::rnea(state, &RIGID_BODY)\n}\n";
        assert_eq!(code_of("default"), code);
    }

    /// All that the library ships has code, in which nothing is left to be filled in.
    #[test]
    fn whatever_the_library_ships_can_be_generated() {
        let shipped = |point: &&Point| match point.kind {
            Kind::Simulation => {
                point.on("scene") == "free"
                    && point.robot == "ur5e"
                    && point.on("integrator") != "implicit_damping"
            }
            _ => {
                !matches!(point.on("trig"), "libm" | "micromath")
                    && !point.on("model").starts_with("params")
            }
        };
        let points = recorded();
        assert!(points.iter().filter(shipped).count() > 400);
        for point in points.iter().filter(shipped) {
            let code = rust(point).unwrap_or_else(|e| panic!("{} {}: {e}", point.robot, point.key));
            let mut blanks = "FORM ROBOT GENERICS JOINTS TICK BETWEEN NAME KERNEL <>".split(' ');
            assert!(!blanks.any(|blank| code.contains(blank)), "{}:\n{code}", point.key);
        }
    }

    /// With the values of the printed simulation itself, the text is the file that the tests
    /// compile and run.
    #[test]
    fn the_tested_simulation_is_the_printed_one() {
        let key = "integrator=rk4,state=compensated,step=1000";
        assert_eq!(code_of(key), super::SIMULATION);
    }

    #[test]
    fn code_of_a_robot_from_a_file_names_its_type() {
        let mut own = point("form=core", 1.0, 1, 1.0);
        let axes = "model=pruned1000 trig=table3x4 between=held form=core arith=f32 rate=1";
        let axes = axes.split(' ').filter_map(|axis| axis.split_once('='));
        own.configuration = axes.map(|(axis, value)| (axis.into(), value.into())).collect();
        assert!(rust(&own).is_err(), "the repository has no such robot");
        own.own = Some(["MyArm".into(), "5".into()]);
        let code = rust(&own).expect("there is code");
        for part in [
            "use crate::robot::MyArm;\n\n",
            "state: &State<f32, 5, 5>) -> [f32; 5]",
            "Core::<Pruned<MyArm, 1000>>::rnea",
        ] {
            assert!(code.contains(part), "{code}");
        }
    }

    #[test]
    fn what_has_no_code_says_so() {
        let mut other = point("trig=libm", 1.0, 1, 1.0);
        assert!(rust(&other).is_err());
        other.robot = "ur5e".into();
        let said = rust(&other).expect_err("it has no model").to_string();
        assert!(said.contains("no Rust to paste"), "{said}");
    }
}
