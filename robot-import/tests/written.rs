//! Written files compile, are those of today's importer, and have the numbers that were checked.

#[path = "robots/parallelogram.rs"]
mod parallelogram;

use std::path::Path;

use dynamics_core::algorithms::rnea;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::loops::{LoopRobot, constraints};
use dynamics_core::model::{ArmModel, Robot};
use dynamics_core::robots::So101;
use dynamics_core::state::State;
use robot_import::import::{Args, Options, import};
use robot_import::model::{AnyModel, Motion};
use robot_import::selection::Selection;
use robot_import::tree::{Numbers, Tree};
use robot_import::{check, loops, source};

const SO101: &str = include_str!("../../dynamics-core/src/robots/imported/so101.rs");
const PARALLELOGRAM: &str = include_str!("robots/parallelogram.rs");

/// What the importer makes of a file of these tests, on the day on which `written` was.
fn imported(file: &str, name: &str, without: &[&str], written: &str) -> (String, Tree) {
    let day = written.split_once("Imported on ").expect("a day").1;
    let day = day.split_once(' ').expect("a sentence").0;
    let args = Args {
        file: Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("tests")
            .join(file),
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

/// The torques of the file's model are those of the checked tree, bit by bit.
fn same_numbers<const N: usize>(written: &ArmModel<f64, N>, tree: &Tree) {
    let checked = AnyModel::of(tree).expect("few joints");
    for k in 0..10 {
        let number = |i: usize, size: f64| size * (1.3 * k as f64 + 2.1 * i as f64).sin();
        let [q, qd, qdd] = [1.5, 3.0, 10.0].map(|size| std::array::from_fn(|i| number(i, size)));
        let torque = rnea(written, &State { q, qd, qdd }, &RIGID_BODY);
        let motion = Motion {
            q: q.into(),
            qd: qd.into(),
            qdd: qdd.into(),
        };
        assert_eq!(torque.to_vec(), checked.dynamics(&motion).torque);
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
fn a_loop_is_closed_where_its_machine_is() {
    use parallelogram::Parallelogram;
    let error = |q: [f64; 3]| {
        let found = constraints(&Parallelogram::MODEL, &Parallelogram::LOOPS, &State::at(q));
        found
            .position
            .into_iter()
            .fold(0.0, |most: f64, x| most.max(x.abs()))
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
