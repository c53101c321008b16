//! Written files compile, are those of today's importer, and have the numbers that were checked.

#[rustfmt::skip]
#[path = "robots/parallelogram.rs"]
mod parallelogram;
// Machines whose motors have no limit, and that have no motor: that they compile is what is tested.
#[rustfmt::skip]
#[path = "robots/driven_loop.rs"]
mod driven_loop;
use std::path::Path;

use dynamics_core::algorithms::rnea;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::loops::{LoopRobot, constraints};
use dynamics_core::model::{ArmModel, Robot, RobotModel};
use dynamics_core::robots::So101;
use dynamics_core::scalar::Native;
use dynamics_core::state::State;
use robot_import::import::{Args, Options, import};
use robot_import::model::{AnyModel, Motion};
use robot_import::selection::Selection;
use robot_import::tree::{Numbers, Tree};
use robot_import::{check, loops, source};

const SO101: &str = include_str!("../../../dynamics-core/src/robots/imported/so101.rs");
const DRIVEN: &str = include_str!("robots/driven_loop.rs");
const PARALLELOGRAM: &str = include_str!("robots/parallelogram.rs");

/// The importer's result for a file of these tests, on the day on which `written` was.
fn imported(file: &str, name: &str, without: &[&str], written: &str) -> (String, Tree) {
    let day = written.split_once("Imported on ").expect("a day").1;
    let day = day.split_once(' ').expect("a sentence").0;
    let args = Args {
        file: Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(file),
        name: Some(name.to_owned()),
        options: Options {
            without: without.iter().map(|&link| link.to_owned()).collect(),
            ..Options::default()
        },
        ..Args::default()
    };
    let imported = import(&args, day).unwrap_or_else(|error| panic!("{error}"));
    (imported.source, imported.tree)
}

/// A model of which nothing is known, as of a checked tree: a chain's dynamics have other
/// roundings.
struct Unknown<'a, const N: usize>(&'a ArmModel<f64, N>);

impl<const N: usize> RobotModel<f64, N, N, N> for Unknown<'_, N> {
    type Kernel = Native;

    fn model(&self) -> &ArmModel<f64, N> {
        self.0
    }
}

/// The torques of the file's model are those of the checked tree, bit by bit.
fn same_numbers<const N: usize>(written: &ArmModel<f64, N>, tree: &Tree) {
    let checked = AnyModel::of(tree).expect("few joints");
    for k in 0..10 {
        let number = |i: usize, size: f64| size * (1.3 * k as f64 + 2.1 * i as f64).sin();
        let [q, qd, qdd] = [1.5, 3.0, 10.0].map(|size| std::array::from_fn(|i| number(i, size)));
        let torque = rnea(&Unknown(written), &State { q, qd, qdd }, &RIGID_BODY);
        let motion = Motion { q: q.into(), qd: qd.into(), qdd: qdd.into() };
        assert_eq!(torque.to_vec(), checked.torque(&motion));
    }
}

#[test]
fn written_files_are_todays_and_have_the_checked_numbers() {
    let without = ["gripper_frame_link"];
    let (source, tree) = imported("urdf/so101.urdf", "so101", &without, SO101);
    assert_eq!(source, SO101);
    same_numbers(&So101::MODEL, &tree);
    let file = "mjcf/parallelogram.xml";
    let (source, tree) = imported(file, "parallelogram", &[], PARALLELOGRAM);
    assert_eq!(source, PARALLELOGRAM);
    same_numbers(&parallelogram::Parallelogram::MODEL, &tree);
}

#[test]
fn loops_without_limits_of_torque_have_their_motors() {
    let (source, _) = imported("mjcf/driven_loop_no_ctrlrange.xml", "driven_loop", &[], DRIVEN);
    assert_eq!(source, DRIVEN);
    // A motor without a range, and a drive of position.
    assert_eq!(driven_loop::DrivenLoop::LOOPS.actuated(), &[0, 3]);
    // The same without motors: all coordinates are actuated, and the file says so.
    let words = [
        ("driven_loop_no_ctrlrange", "passive_loop"),
        ("driven_loop", "passive_loop"),
        ("DrivenLoop", "PassiveLoop"),
        ("1, 3, 2>", "1, 3, 4>"),
        ("[0, 3]", "[0, 1, 2, 3]"),
        (
            "The actuated coordinates are those of the joints with a motor.",
            "The file has too few motors: every coordinate is taken as actuated.",
        ),
        (
            "Actuators of type position, that of joint `s`: their gains are controllers of the \
             simulation and are left out.",
            "The file has no motor on a joint of its machine with loops, and at least 1 move \
             freely: every joint is taken as driven. `--motors A,B` names those with a motor, or \
             `<motor joint=…/>` in the file.",
        ),
    ];
    let passive = words.iter().fold(DRIVEN.to_owned(), |text, (from, to)| text.replace(from, to));
    let (source, _) = imported("mjcf/passive_loop.xml", "passive_loop", &[], &passive);
    assert_eq!(source, passive);
}

// Its motors can be named.
#[test]
fn a_loop_without_enough_motors_gets_advice() {
    let of = |file: &str, motors: &[&str]| {
        let args = Args {
            file: Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(file),
            options: Options {
                motors: motors.iter().map(|&name| name.to_owned()).collect(),
                ..Options::default()
            },
            ..Args::default()
        };
        import(&args, "today").map_err(|error| error.to_string())
    };
    let passive = |motors: &[&str]| of("mjcf/passive_loop.xml", motors);
    let report = passive(&[]).expect("a machine").report.text();
    let words = "The file has no motor on a joint of its machine with loops, and at least 1 move freely: every joint is taken as driven.";
    assert!(report.contains(words), "{report}");
    let named = passive(&["p", "s"]).expect("a machine");
    assert!(named.source.contains("Loops<1, 3, 2>"), "{}", named.source);
    assert!(!named.report.text().contains("no motor"), "{}", named.report.text());
    let error = passive(&["p", "t"]).expect_err("no joint");
    assert!(error.contains("`--motors t`: no joint of this name moves"), "{error}");
    let error = of("urdf/so101.urdf", &["elbow_flex"]).expect_err("no loop");
    assert!(error.contains("has no loop"), "{error}");
    // Nobody has said which of the joints have motors, but the file compiles.
    for (file, sizes) in
        [("loop_name", "<1, 3, 1>"), ("loop_no_motor", "<1, 3, 3>"), ("weld", "<1, 6, 1>")]
    {
        let machine = of(&format!("mjcf/{file}.xml"), &[]).expect(file);
        assert!(machine.source.contains(&format!("Loops{sizes}")), "{}", machine.source);
    }
}

#[test]
fn a_refused_loop_is_named_with_its_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("m.xml");
    let text = include_str!("mjcf/passive_loop.xml");
    let ends = [
        ("body1=\"c\" body2=\"d\" anchor=\".1 0 0\"", "site1=\"one\" site2=\"two\""),
        ("<joint name=\"r\"", "<site name=\"one\"/><joint name=\"r\""),
        ("<joint name=\"s\"", "<site name=\"two\" pos=\".1 0 0\"/><joint name=\"s\""),
        ("pos=\".5 0 0\"", "pos=\"50 0 0\""),
    ];
    let text = ends.iter().fold(text.to_owned(), |text, (from, to)| text.replace(from, to));
    std::fs::write(&file, text).expect("a model");
    let options = Options::default();
    let args = Args { file, options, ..Args::default() };
    let error = import(&args, "today").expect_err("open").to_string();
    let words = "loop `loop_0`: one link is longer than all the others together";
    assert!(error.starts_with("line 1: ") && error.contains(words), "{error}");
}

#[test]
fn a_loop_is_closed_where_its_machine_is() {
    use parallelogram::Parallelogram;
    let error = |q: [f64; 3]| {
        let found = constraints(&Parallelogram::MODEL, &Parallelogram::LOOPS, &State::at(q));
        found.position.into_iter().fold(0.0, |most: f64, x| most.max(x.abs()))
    };
    assert_eq!(error([0.0; 3]), 0.0);
    assert!(error([0.4, -0.4, 0.4]) < 1e-15);
    assert!(error([0.4, 0.0, 0.4]) > 0.05);
}

#[test]
fn the_frames_of_loops_are_compared_with_the_files_links() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/mjcf/parallelogram.xml");
    let robot = source::read(&path).expect("a robot");
    let selected = Selection::default().of(&robot).expect("all of it");
    let tree = Tree::of(&robot, &selected, Numbers::AsGiven).expect("three joints");
    let (mut closed, left_out) = loops::closed(&robot, &tree);
    assert!(left_out.is_empty());
    let most = |closed: &[loops::Closed]| {
        check::loops(&robot, &selected, &tree, closed, 20).expect("a small robot")
    };
    assert!(most(&closed) < 1e-15, "{:e}", most(&closed));
    closed[0].ends[1].1[2] += 1e-9;
    assert!(most(&closed) > 1e-10, "{:e}", most(&closed));
}
