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

/// A program that states the sizes of types.
fn of_sizes(sizes: &[(&str, usize)]) -> String {
    let assert =
        |(name, size): &(&str, usize)| format!("SAME(sizeof(arm_{name}) == {size}, \"{name}\");\n");
    let start = "#ifdef __cplusplus\n#define SAME static_assert\n#else\n\
                 #define SAME _Static_assert\n#endif\n";
    start.to_owned() + &sizes.iter().map(assert).collect::<String>()
}

/// Whether a compiler accepts a program with the header; nothing without a compiler.
fn compiles(name: &str, compiler: &[&str], program: &str) -> Option<bool> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{N}-{}", compiler[1]));
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::write(folder.join("arm.h"), header()).expect("written");
    let program = format!("#include \"arm.h\"\n{program}");
    std::fs::write(folder.join("program.c"), program).expect("written");
    let mut process = Process::new(compiler[0]);
    process.args(&compiler[1..]).args(["-Wall", "-Wextra", "-Werror", "-c", "program.c"]);
    process.args(["-o", "program.o"]);
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
        assert_ne!(compiles("sizes", &compiler, &of_sizes(&sizes)), Some(false), "{compiler:?}");
        sizes[0].1 += 4;
        assert_ne!(compiles("sizes", &compiler, &of_sizes(&sizes)), Some(true), "{compiler:?}");
        sizes[0].1 -= 4;
    }
}

/// The compilers know statuses from other numbers, unless the user says that they do not.
#[test]
fn a_status_that_nobody_looks_at_is_a_warning() {
    let used = "float x[ARM_JOINTS]; int32_t f(void) { return arm_gravity(x, x); }\n";
    let ignored = "float x[ARM_JOINTS]; void f(void) { arm_gravity(x, x); }\n";
    for compiler in [["cc", "-std=c11", "-xc"], ["c++", "-std=c++17", "-xc++"]] {
        assert_ne!(compiles("status", &compiler, used), Some(false), "{compiler:?}");
        assert_ne!(compiles("status", &compiler, ignored), Some(true), "{compiler:?}");
        let [name, standard, language] = compiler;
        let off = [name, standard, language, "-DARM_NODISCARD="];
        assert_ne!(compiles("status", &off, ignored), Some(false), "{compiler:?}");
    }
    let header = header();
    let others: Vec<_> = header.lines().filter(|line| line.starts_with("int32_t ")).collect();
    assert_eq!(others.len(), 2, "a status of each function: {others:?}");
}

#[test]
fn header_and_library_have_the_version_of_the_crate() {
    let numbers = env!("CARGO_PKG_VERSION").split('.').map(|part| part.parse::<i32>());
    let version = numbers.fold(0, |all, part| 100 * all + part.expect("a number"));
    assert_eq!(version, crate::library::version(), "`_VERSION` in dynamics.h.liquid");
    assert!(header().contains(&format!("#define ARM_VERSION {version}\n")));
}

#[test]
fn a_header_of_another_library_is_refused() {
    let header = header();
    assert_header(&header, N, MOST_POINTS);
    for (joints, points) in [(N + 1, MOST_POINTS), (N, MOST_POINTS + 1)] {
        assert!(catch_unwind(|| assert_header(&header, joints, points)).is_err());
    }
}
