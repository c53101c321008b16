use std::path::PathBuf;
use std::{env, fs, process};

use super::*;

fn pendulum() -> RobotFile {
    RobotFile {
        type_name: "Pendulum".into(),
        text: include_str!("../../template/rust/src/robot.rs").into(),
        again: "rod.urdf --name my-arm".into(),
        joints: vec!["bearing".into()],
        bodies: vec!["rod".into()],
        b: 1,
        q: 1,
        v: 1,
        coupled: false,
        feedback: Feedback::default(),
    }
}

fn project(c: bool) -> Project {
    Project {
        name: "my-arm".into(),
        robot: pendulum(),
        library: Library::Path("/a \"b\"\\c".into()),
        kind: if c { Kind::C } else { Kind::Simulation },
    }
}

/// A folder that is removed with the value.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let folder = env::temp_dir().join(format!("robot-import-{name}-{}", process::id()));
        let _ = fs::remove_dir_all(&folder);
        Self(folder)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn no_placeholder_is_left_in_a_project() {
    for c in [false, true] {
        let folder = Folder::new(if c { "c" } else { "rust" });
        let created = create(&folder.0, &project(c)).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(created.files.len(), 2 + if c { C.len() } else { RUST.len() });
        for file in &created.files {
            let text = read(file);
            assert!(!text.contains("{{") && !text.contains("{%"), "{}", file.display());
        }
        let manifest = read(&folder.0.join("Cargo.toml"));
        assert!(manifest.contains(r#"{ path = "/a \"b\"\\c" }"#), "{manifest}");
        let scene = read(&folder.0.join("src/scene.rs"));
        // Another import of the robot changes what acts on it.
        let acts = if c { "robot::FORCES" } else { "robot::SCENE" };
        assert!(scene.contains(acts) && !scene.contains("Viscous"), "{scene}");
        if c {
            let header = read(&folder.0.join("include/my_arm.h"));
            assert!(header.contains("MY_ARM_JOINT_BEARING = 0,"), "{header}");
        }
    }
}

/// Firmware for a board, of a robot with these joints.
fn for_board(board: &'static Board, joints: &[&str]) -> Project {
    let mut robot = pendulum();
    robot.joints = joints.iter().map(|&joint| joint.into()).collect();
    (robot.b, robot.q, robot.v) = (joints.len(), joints.len(), joints.len());
    Project { robot, library: Library::Copy, kind: Kind::Board(board), ..project(false) }
}

const NAMES: [&str; 7] = ["a", "b", "c|d`\u{202e}", "{{n}}", "e -->", "// joint 9", "g"];

#[test]
fn a_project_for_a_board_has_the_lines_of_its_joints_alone() {
    for board in &BOARDS {
        for joints in 1..=board.most_joints {
            let files =
                files(&for_board(board, &NAMES[..joints])).unwrap_or_else(|e| panic!("{e}"));
            let own = files.iter().filter(|(path, _)| !path.starts_with("libraries/"));
            let text: String = own.clone().map(|(_, text)| text.as_str()).collect();
            let pins = own.clone().find(|(path, _)| path == "src/pins.rs");
            let pins = &pins.unwrap_or_else(|| panic!("no pins for {}", board.name)).1;
            // A select and a PWM channel, or a number on the bus.
            let is_on_bus = board.name.ends_with("-can");
            for joint in (1..=board.most_joints).filter(|_| !is_on_bus) {
                let lines =
                    pins.lines().filter(|line| line.ends_with(&format!("// joint {joint}")));
                let count = lines.filter(|line| !line.starts_with("use ")).count();
                assert_eq!(count >= 2, joint <= joints, "{} {joint}", board.name);
            }
            assert!(!text.contains("<!-- joint") && !text.contains("{{pins"), "{}", board.name);
            assert_eq!(text.matches("{{").count(), usize::from(joints > 3), "{}", board.name);
            let readme = own.clone().find(|(path, _)| path == "README.md").expect("a README");
            let rows: Vec<_> =
                (readme.1.lines()).filter(|line| line.starts_with("| joint ")).collect();
            assert_eq!(rows.len(), joints);
            for row in rows {
                assert_eq!(row.matches('|').count(), 3, "{row}");
                let part = if is_on_bus { "the drive of number" } else { "select of its encoder" };
                assert!(row.contains(part) && !row.contains('\u{202e}'), "{row}");
            }
        }
    }
}

#[test]
fn a_project_has_no_path_out_of_its_folder() {
    let boards = BOARDS.iter().map(|board| for_board(board, &["a"]));
    let others = [false, true].map(|c| Project { library: Library::Copy, ..project(c) });
    for project in boards.chain(others) {
        let files = files(&project).unwrap_or_else(|error| panic!("{error}"));
        let mut manifests = 0;
        for (path, text) in &files {
            if !path.ends_with("Cargo.toml") {
                continue;
            }
            manifests += 1;
            assert!(!text.contains("workspace = true") && !text.contains("git ="), "{text}");
            for target in text.split("path = \"").skip(1) {
                let target = target.split('"').next().unwrap_or_default();
                let joined = included(path, target);
                let is_file = |(path, _): &&(String, String)| {
                    path == &joined || path == &format!("{joined}/Cargo.toml")
                };
                assert!(files.iter().any(|file| is_file(&file)), "{path}: {target}");
            }
        }
        assert!(manifests >= 3, "{:?}", project.kind);
        let own = files.iter().filter(|(path, _)| path.ends_with(".rs"));
        for (path, text) in own {
            for target in text.split("include_str!(\"").skip(1) {
                let target = target.split('"').next().unwrap_or_default();
                let found = included(path, target);
                assert!(files.iter().any(|(file, _)| *file == found), "{path}: {target}");
            }
        }
    }
}

#[test]
fn a_project_of_a_program_from_crates_io_names_its_version() {
    let boards = BOARDS.iter().map(|board| for_board(board, &["a"]));
    for project in boards.chain([project(false), project(true)]) {
        let files = files(&Project { library: Library::Registry, ..project });
        let files = files.unwrap_or_else(|error| panic!("{error}"));
        assert!(!files.iter().any(|(path, _)| path.contains("libraries/") || path == "Cargo.lock"));
        let (_, manifest) = files.iter().find(|file| file.0 == "Cargo.toml").expect("a manifest");
        assert!(!manifest.contains("path = \"libraries"), "{manifest}");
        let line = format!("\ndynamics-core = {{ version = \"{VERSION}\" }}\n");
        assert!(manifest.contains(&line), "{manifest}");
    }
}

/// The path of a file that another one includes.
fn included(path: &str, target: &str) -> String {
    let mut folders: Vec<&str> = path.split('/').collect();
    folders.pop();
    for part in target.split('/') {
        match part {
            ".." => drop(folders.pop()),
            part => folders.push(part),
        }
    }
    folders.join("/")
}

#[test]
fn what_no_board_has_is_refused_with_what_there_is() {
    let said =
        |name, framework| Board::find(name, framework).map(|_| ()).map_err(|e| e.to_string());
    for board in &BOARDS {
        assert_eq!(said(board.name, None), Ok(()));
        assert_eq!(said(board.name, Some(board.framework)), Ok(()));
    }
    let error = said("uno\u{1b}", None).expect_err("no such board");
    assert!(
        error.contains("pico2 with Embassy") && error.contains("nucleo-f446re with RTIC, "),
        "{error}"
    );
    assert!(error.contains(r"uno\u{1b}") && error.contains("guide/src/porting.md"), "{error}");
    let error = said("pico2", Some(Framework::Rtic)).expect_err("no such firmware");
    assert!(error.contains("pico2 with Embassy") && !error.contains("nucleo"), "{error}");
    let folder = Folder::new("seven");
    let error = create(&folder.0, &for_board(&BOARDS[0], &["a"; 7])).expect_err("seven joints");
    assert!(matches!(error, ProjectError::TooManyJoints { joints: 7, most: 6, .. }), "{error}");
    assert!(!folder.0.exists());
}

#[test]
fn the_boards_use_the_versions_of_the_lock_file() {
    for board in &BOARDS {
        let files = files(&for_board(board, &["a"])).unwrap_or_else(|error| panic!("{error}"));
        let (_, manifest) = files.iter().find(|file| file.0 == "Cargo.toml").expect("a manifest");
        let (_, dependencies) = manifest.split_once("[dependencies]\n").expect("dependencies");
        let registry = dependencies
            .lines()
            .take_while(|line| !line.is_empty())
            .filter(|line| !line.contains("path = ") && !line.starts_with('#'));
        let mut count = 0;
        for line in registry {
            let name = line.split(' ').next().unwrap_or_default();
            let version = line.split('"').nth(1).unwrap_or_default();
            let locked = format!("name = \"{name}\"\nversion = \"{version}\"\n");
            assert!(libraries::LOCK_OF_BOARDS.contains(&locked), "{line}");
            count += 1;
        }
        assert!(count > 6, "{manifest}");
    }
}

#[test]
fn the_template_has_only_what_cargo_generate_knows() {
    let config = include_str!("../../template/rust/cargo-generate.toml");
    let mut used = Vec::new();
    for file in RUST {
        for part in [file.path, file.text].iter().flat_map(|text| text.split("{{").skip(1)) {
            used.push(part.split("}}").next().unwrap_or_default());
        }
    }
    used.sort_unstable();
    used.dedup();
    assert!(used.len() > 3);
    for name in used {
        let is_built_in = ["project-name", "crate_name", "crate_name | upcase"].contains(&name);
        let is_placeholder = config.lines().any(|line| line.starts_with(&format!("{name} = ")));
        assert!(is_built_in || is_placeholder, "{name}");
    }
}

#[test]
fn a_folder_with_files_is_left_as_it_is() {
    let folder = Folder::new("used");
    fs::create_dir_all(&folder.0).unwrap_or_else(|error| panic!("{error}"));
    fs::write(folder.0.join("mine"), "mine").unwrap_or_else(|error| panic!("{error}"));
    let error = create(&folder.0, &project(false)).expect_err("it is not empty");
    assert!(matches!(error, ProjectError::NotEmpty(_)), "{error}");
    assert_eq!(fs::read_dir(&folder.0).map(Iterator::count).ok(), Some(1));
}

#[test]
fn names_that_are_no_crates_are_refused() {
    for name in ["", "My-arm", "1arm", "a b", "../x", "core", "dynamics-core", "self", "ärm"] {
        let project = Project { name: name.into(), ..project(false) };
        let folder = Folder::new("name");
        let error = create(&folder.0, &project).expect_err(name);
        assert!(matches!(error, ProjectError::Name { .. }), "{name}: {error}");
        assert!(!folder.0.exists());
    }
}

#[test]
fn addresses_that_are_no_toml_are_refused() {
    let project =
        Project { library: Library::Git("https://example.org/a\nb".into()), ..project(false) };
    let folder = Folder::new("address");
    let error = create(&folder.0, &project).expect_err("a line end");
    assert!(matches!(error, ProjectError::Library(_)), "{error}");
}

#[test]
fn a_floating_robot_gets_its_file_only() {
    let mut project = project(false);
    (project.robot.b, project.robot.q, project.robot.v) = (13, 19, 18);
    let folder = Folder::new("floating");
    let created = create(&folder.0, &project).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(created.files, [folder.0.join("src/robot.rs")]);
    let (b, q, v) = (13, 19, 18);
    assert_eq!(created.robot_only, Some(RobotOnly::Coordinates { b, q, v }));
}

#[test]
fn no_two_joints_have_one_constant() {
    let lines = |joints: &[&str]| {
        let joints: Vec<String> = joints.iter().map(|&joint| joint.to_owned()).collect();
        enumerators("ARM", "JOINT", &joints, &constants(C))
    };
    let expected = "    ARM_JOINT_A_B_0_0 = 0, /* \"a-b\" */\n    ARM_JOINT_A_B_1 = 1, /* \"a.b\" \
                    */\n    ARM_JOINT_A_B_0 = 2,\n    ARM_JOINT_C = 3,";
    assert_eq!(lines(&["a-b", "a.b", "a_b_0", "c"]), expected);
    // Names without a letter of ASCII, names that are each other's numbered form, and the header's
    // own.
    let all = ["", "é", "-", "1", "a", "A", "a_4", "a_4_4", "a 5"];
    let text = lines(&all);
    let mut names: Vec<&str> = text.lines().filter_map(|line| line.split('=').next()).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), all.len(), "{text}");
    let taken = enumerators("ARM", "JOINT", &["x".to_owned()], &["JOINT_X"]);
    assert_eq!(taken, "    ARM_JOINT_X_0 = 0, /* \"x\" */");
    assert!(constants(C).contains(&"JOINTS"));
}

#[test]
fn values_are_not_searched_for_placeholders() {
    let values = [("a", "{{b}}".to_owned()), ("b", "x".to_owned())];
    assert_eq!(substitute("{{a}} {{b}} {{c}} }}", &values), "{{b}} x {{c}} }}");
}
