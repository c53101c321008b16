//! Files that an import writes: none replaces another.

use std::fs;
use std::path::{Path, PathBuf};

use robot_import::import::{Args, Options, run};
use robot_import::outputs::same_file;

const PENDULUM: &str = "<robot name='r'><link name='a'/><link name='b'><inertial><origin xyz='0.1 0 0'/><mass value='1'/>\
    <inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link><joint name='swing' type='continuous'>\
    <parent link='a'/><child link='b'/><axis xyz='0 1 0'/><limit effort='9' velocity='9'/></joint></robot>";

fn args(file: PathBuf, out: Option<PathBuf>, report: Option<PathBuf>) -> Args {
    Args { file, out, report, options: Options::default(), ..Args::default() }
}

#[test]
fn an_output_replaces_neither_an_input_nor_another_output() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let robot = at("r.urdf");
    fs::write(&robot, PENDULUM).expect("a robot");
    fs::create_dir(at("sub")).expect("a folder");
    let names = [at("r.urdf"), at("sub/../r.urdf"), at("./r.urdf")];
    let mut names = names.to_vec();
    #[cfg(unix)]
    {
        fs::hard_link(&robot, at("hard")).expect("a link");
        std::os::unix::fs::symlink("r.urdf", at("soft")).expect("a link");
        std::os::unix::fs::symlink("soft", at("sub/twice")).unwrap_or_default();
        std::os::unix::fs::symlink(folder.path(), at("sub/up")).expect("a link");
        names.extend([at("hard"), at("soft"), at("sub/up/r.urdf")]);
    }
    for name in names {
        for args in [
            args(robot.clone(), Some(name.clone()), None),
            args(robot.clone(), None, Some(name.clone())),
        ] {
            let error = run(&args, "today").expect_err("the description itself").to_string();
            assert!(
                error.starts_with("cannot write ")
                    && error.contains("which is read and would be lost"),
                "{error}"
            );
        }
        assert_eq!(fs::read_to_string(&robot).expect("a robot"), PENDULUM);
    }
    // Two outputs, also where neither is there yet.
    for (out, report) in [("x", "x"), ("sub/x", "sub/../sub/x"), ("x.rs", "./x.rs")] {
        let error = run(&args(robot.clone(), Some(at(out)), Some(at(report))), "today")
            .expect_err("one file")
            .to_string();
        assert!(error.contains("which is written, too"), "{error}");
        assert!(!at(out).exists());
    }
    run(&args(robot.clone(), Some(at("x.rs")), Some(at("x.json"))), "today").expect("two files");
    assert!(at("x.rs").exists());
}

#[test]
fn an_included_file_is_an_input() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let part =
        "<mujoco><worldbody><body name='b'><joint/><geom size='1'/></body></worldbody></mujoco>";
    fs::write(at("part.xml"), part).expect("a part");
    fs::write(at("r.xml"), "<mujoco><include file='part.xml'/></mujoco>").expect("a model");
    let error = run(&args(at("r.xml"), Some(at("part.xml")), None), "today")
        .expect_err("a part")
        .to_string();
    assert!(error.contains("part.xml, which is read and would be lost"), "{error}");
    assert_eq!(fs::read_to_string(at("part.xml")).expect("a part"), part);
}

#[cfg(unix)]
#[test]
fn what_cannot_be_written_is_said_to_be_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let robot = folder.path().join("r.urdf");
    fs::write(&robot, PENDULUM).expect("a robot");
    for out in ["/nodir/x.rs", "/dev/full"] {
        let error =
            run(&args(robot.clone(), Some(out.into()), None), "today").expect_err(out).to_string();
        assert!(error.starts_with(&format!("cannot write {out}: ")), "{error}");
    }
    // A device is no file that is replaced.
    let null = Path::new("/dev/null");
    assert!(!same_file(null, null));
    run(&args(robot, Some(null.into()), Some(null.into())), "today").expect("to nowhere");
}

#[test]
fn names_of_any_length_are_reported() {
    let folder = tempfile::tempdir().expect("a folder");
    let robot = folder.path().join("r.urdf");
    let long = "n".repeat(70_000);
    for name in ["'r'", "'a'", "'b'", "'swing'"] {
        fs::write(&robot, PENDULUM.replace(name, &format!("'{long}'"))).expect("a robot");
        let imported = run(&args(robot.clone(), None, None), "today")
            .unwrap_or_else(|error| panic!("{error}"));
        let text = imported.report.text();
        assert!(text.contains("nnn…") && text.len() < 300_000, "{} bytes", text.len());
    }
}

#[test]
fn a_robot_too_light_for_f32_is_refused_by_its_torques() {
    let folder = tempfile::tempdir().expect("a folder");
    let robot = folder.path().join("r.urdf");
    let light =
        PENDULUM.replace("value='1'", "value='1e-29'").replace("xyz='0.1 0 0'", "xyz='1e-9 0 0'");
    fs::write(
        &robot,
        light
            .replace("ixx='1'", "ixx='1e-36'")
            .replace("iyy='1'", "iyy='1e-36'")
            .replace("izz='1'", "izz='1e-36'"),
    )
    .expect("a robot");
    let error = run(&args(robot, None, None), "today").expect_err("too light").to_string();
    assert!(error.contains("below 1e-30") && !error.contains("defect"), "{error}");
}
