//! The header with the names of this robot: a C compiler, where there is one, finds the sizes of
//! the library's types in it.

use std::io::ErrorKind;
use std::panic::catch_unwind;
use std::path::Path;
use std::process::Command as Process;

use dynamics_c::{WayPoint, assert_header};

use crate::library::*;
use crate::scene::{MOST_POINTS, N};

fn header() -> String {
    let list = |kind| (0..N).map(|k| format!("    ARM_{kind}_{k} = {k},\n")).collect::<String>();
    let values = [
        ("crate_name | upcase", "ARM".to_owned()),
        ("crate_name", "arm".to_owned()),
        ("robot", "the arm".to_owned()),
        ("n", N.to_string()),
        ("joints", list("JOINT")),
        ("bodies", list("BODY")),
    ];
    let text = include_str!("../../include/dynamics.h.liquid").to_owned();
    values
        .into_iter()
        .fold(text, |text, (name, value)| text.replace(&format!("{{{{{name}}}}}"), &value))
}

/// Whether a compiler accepts the header with these types' sizes; nothing without a compiler.
fn compiles(compiler: &[&str], sizes: &[(&str, usize)]) -> Option<bool> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("header-{N}-{}", compiler[1]));
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::write(folder.join("arm.h"), header()).expect("written");
    let assert =
        |(name, size): &(&str, usize)| format!("SAME(sizeof(arm_{name}) == {size}, \"{name}\");\n");
    let sizes: String = sizes.iter().map(assert).collect();
    let start = "#include \"arm.h\"\n#ifdef __cplusplus\n#define SAME static_assert\n#else\n\
                 #define SAME _Static_assert\n#endif\n";
    std::fs::write(folder.join("sizes.c"), start.to_owned() + &sizes).expect("written");
    let mut process = Process::new(compiler[0]);
    process.args(&compiler[1..]).args(["-Wall", "-Wextra", "-Werror", "-fsyntax-only", "sizes.c"]);
    match process.current_dir(&folder).output() {
        Ok(output) => Some(output.status.success()),
        Err(error) if error.kind() == ErrorKind::NotFound => None,
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn the_header_has_the_sizes_of_the_library() {
    let mut sizes = [
        ("state", size_of::<State>()),
        ("load", size_of::<Load>()),
        ("tool", size_of::<Tool>()),
        ("wrench", size_of::<Wrench>()),
        ("sensor_load", size_of::<SensorLoad>()),
        ("sensor_fit", size_of::<SensorFit>()),
        ("pose", size_of::<Pose>()),
        ("controller", Exports::CONTROLLER_BYTES),
        ("config", size_of::<Config>()),
        ("where", size_of::<Where>()),
        ("waypoint", size_of::<WayPoint<N>>()),
        ("motion", size_of::<Motion>()),
        ("command", size_of::<Command>()),
        ("report", size_of::<Report>()),
        ("advice", size_of::<AdviceText>()),
        ("pose_solver", size_of::<PoseSolver>()),
        ("motors", size_of::<Motors>()),
        ("temperatures", size_of::<Temperatures>()),
        ("heat", size_of::<Heat>()),
    ];
    for compiler in [["cc", "-std=c11", "-xc"], ["c++", "-std=c++17", "-xc++"]] {
        assert_ne!(compiles(&compiler, &sizes), Some(false), "{compiler:?}");
        sizes[0].1 += 4;
        assert_ne!(compiles(&compiler, &sizes), Some(true), "{compiler:?}");
        sizes[0].1 -= 4;
    }
}

#[test]
fn a_header_of_another_library_is_refused() {
    let header = header();
    assert_header(&header, N, MOST_POINTS);
    for (joints, points) in [(N + 1, MOST_POINTS), (N, MOST_POINTS + 1)] {
        assert!(catch_unwind(|| assert_header(&header, joints, points)).is_err());
    }
}
