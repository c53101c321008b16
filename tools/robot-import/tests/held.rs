//! Written projects of robots that are hard to hold run their own tests here: light joints with
//! much torque or dry friction, ranges below an encoder's step, links whose gravity is stiffer than
//! gains from their inertia.

use std::path::Path;
use std::process::Command;

use robot_import::import::{Args, Options, import};
use robot_import::project::{Kind, Library, Project, create};

use crate::names::compiled::{Batch, Folder, failure, rust};

/// A beam, and a light part on its end with another joint.
struct Light {
    kind: &'static str,
    inertia: f64,
    com: f64,
    effort: f64,
    friction: f64,
    range: [f64; 2],
}

const CRANK: Light = Light {
    kind: "continuous",
    inertia: 1e-6,
    com: 0.0,
    effort: 1.0,
    friction: 0.0,
    range: [-1.0, 1.0],
};

impl Light {
    fn urdf(&self) -> String {
        let Self { kind, inertia, com, effort, friction, range: [lower, upper] } = self;
        let moments =
            |i: &str| format!("<inertia ixx='{i}' iyy='{i}' izz='{i}' ixy='0' ixz='0' iyz='0'/>");
        format!(
            "<robot name='light'><link name='base'/>
            <link name='beam'><inertial><origin xyz='0.12 0 0'/><mass value='0.5'/>{}</inertial></link>
            <link name='crank'><inertial><origin xyz='{com} 0 0'/><mass value='0.004'/>{}</inertial></link>
            <joint name='lift' type='revolute'><parent link='base'/><child link='beam'/><axis xyz='0 1 0'/>
            <limit lower='-1.5' upper='1.5' effort='15' velocity='3.14'/></joint>
            <joint name='grip' type='{kind}'><origin xyz='0.25 0 0'/><parent link='beam'/><child link='crank'/>
            <axis xyz='1 0 0'/><limit lower='{lower}' upper='{upper}' effort='{effort}' velocity='3.14'/>
            <dynamics friction='{friction}'/></joint></robot>",
            moments("0.002"),
            moments(&inertia.to_string()),
        )
    }
}

/// The project of a description, and what `new` says of it.
fn project(folder: &Folder, name: &str, file: &Path) -> (Project, Vec<String>) {
    let args = Args {
        file: file.to_path_buf(),
        name: Some(name.to_owned()),
        options: Options::default(),
        ..Args::default()
    };
    let imported = import(&args, "today").unwrap_or_else(|error| panic!("{error}"));
    let project = Project {
        name: name.to_owned(),
        robot: imported.robot_file(),
        library: Library::Path("/nowhere".into()),
        kind: Kind::Simulation,
    };
    let created = create(&folder.0.join(name), &project).unwrap_or_else(|error| panic!("{error}"));
    (project, created.notes)
}

/// The projects, each with the motion that shows parameters, and their tests as one program.
fn run(projects: &[(&str, Project)]) -> String {
    let mut batch = Batch::new();
    let mut root =
        "#![allow(dead_code, missing_docs, reason = \"programs in one crate\")]\n".to_owned();
    for (k, (name, project)) in projects.iter().enumerate() {
        batch.project(project);
        let files = robot_import::project::files(project).expect("a legal name");
        let file = |path: &str| {
            let found = files.iter().find(|file| file.0 == path);
            &found.unwrap_or_else(|| panic!("no {path}")).1
        };
        let own = |text: &str| text.replace("crate::", &format!("crate::m{k}::"));
        let tests = file("tests/tracking.rs").replace(&format!("::{name}::"), "crate::");
        batch.folder.write(&format!("t{k}.rs"), &own(&tests));
        let motion = own(file("src/excitation.rs"));
        batch.folder.write(&format!("x{k}.rs"), &motion);
        let along = include_str!("project/excited.rs");
        let along = along.replace("arm::excitation", &format!("crate::x{k}"));
        let along = along.replace("arm::", &format!("crate::m{k}::"));
        batch.folder.write(&format!("e{k}.rs"), &along);
        root += &format!("pub mod m{k};\nmod t{k};\nmod x{k};\nmod e{k};\n");
    }
    let root = batch.folder.write("all.rs", &root);
    let program = batch.folder.0.join("all");
    let out = program.display().to_string();
    let built = rust("rustc", &root, &["--test", "-Copt-level=1", "-o", &out]);
    assert_eq!(failure(&built), None);
    let ran = Command::new(&program).output().expect("the tests run");
    String::from_utf8_lossy(&ran.stdout).into_owned()
}

#[test]
fn light_joints_follow_their_motion() {
    let folder = Folder::new();
    let friction = Light { friction: 0.1, ..CRANK };
    let range = [-0.1, 0.95];
    let variants = [
        ("friction", friction),
        ("little_friction", Light { friction: 0.01, ..CRANK }),
        ("no_friction", Light { inertia: 1e-7, ..CRANK }),
        ("much_friction", Light { friction: 0.9, inertia: 1e-8, ..CRANK }),
        (
            "large_effort",
            Light { kind: "revolute", inertia: 5e-6, com: 0.02, effort: 1000.0, range, ..CRANK },
        ),
        ("sliding", Light { kind: "prismatic", effort: 1e5, friction: 0.2, range, ..CRANK }),
        ("heavier", Light { friction: 0.1, inertia: 1e-5, ..CRANK }),
        ("narrow", Light { kind: "revolute", range: [-1e-6, 1e-6], ..CRANK }),
    ];
    let written = variants.map(|(name, light)| {
        let file = folder.write(&format!("{name}.urdf"), &light.urdf());
        let (project, words) = project(&folder, name, &file);
        let told = words.iter().any(|text| text.contains("`grip`"));
        // Its limit of torque fits its inertia and friction.
        assert_eq!(told, name != "heavier", "{name}: {words:?}");
        let is_held = !words.concat().contains("no feedback holds it");
        assert_eq!(is_held, name != "much_friction", "{name}: {words:?}");
        (name, project)
    });
    let is_tried = |name: &str| match cfg!(feature = "full") {
        true => name != "much_friction",
        false => name == "friction" || name == "narrow",
    };
    let held: Vec<_> = written.into_iter().filter(|(name, _)| is_tried(name)).collect();
    let said = run(&held);
    let passed = format!("test result: ok. {} passed", 4 * held.len());
    assert!(held.len() > 1 && said.contains(&passed), "{said}");
}

/// With K_p from 1/(M⁻¹)ⱼⱼ at 25 rad/s the least eigenvalue of K_p + ∂g/∂q was −0.20 N·m/rad there.
#[test]
fn an_arm_is_held_along_its_excitation() {
    let folder = Folder::new();
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/urdf/so101.urdf");
    let (project, _) = project(&folder, "so101", &file);
    let mut soft = project.clone();
    soft.robot.feedback.omega_n = 5.0;
    let said = run(&[("so101", project)]);
    assert!(said.contains("test result: ok. 4 passed"), "{said}");
    if cfg!(feature = "full") {
        let said = run(&[("so101", soft)]);
        assert!(said.contains("test e0::it_stays_at_its_reference ... FAILED"), "{said}");
    }
}

/// A mass at the distance r falls with √(g / r), in rad/s.
#[test]
fn a_feedback_is_faster_than_the_links_fall() {
    let folder = Folder::new();
    let of = |name: &str, com: f64| {
        let light = Light { inertia: 1e-10, com, ..CRANK };
        // About an axis across the distance.
        let urdf = light.urdf().replace("<axis xyz='1 0 0'/>", "<axis xyz='0 1 0'/>");
        let file = folder.write(&format!("{name}.urdf"), &urdf);
        let (project, words) = project(&folder, name, &file);
        (project.robot.feedback.omega_n, words)
    };
    let (omega, words) = of("far", 0.1);
    assert!(omega == 25.0 && !words.concat().contains("gravity"), "{omega} {words:?}");
    let (omega, words) = of("near", 0.006);
    // √2 of 40 rad/s.
    assert!(
        (50.0..65.0).contains(&omega) && words.concat().contains("against gravity"),
        "{omega} {words:?}"
    );
    let (_, words) = of("nearest", 0.001);
    assert!(
        words
            .concat()
            .contains("`grip` is not held against gravity everywhere, and `cargo test` may fail"),
        "{words:?}"
    );
}

#[test]
fn a_failing_test_names_the_joint_and_what_to_do() {
    let folder = Folder::new();
    let weak = Light { kind: "revolute", inertia: 1e-5, com: 0.2, effort: 1e-4, ..CRANK };
    let file = folder
        .write("weak.urdf", &weak.urdf().replace("<axis xyz='1 0 0'/>", "<axis xyz='0 1 0'/>"));
    let (project, words) = project(&folder, "weak", &file);
    assert!(words.iter().any(|text| text.contains("`grip` needs 0.0")), "{words:?}");
    let said = run(&[("weak", project)]);
    for part in [
        "joint `grip` needs 0.0",
        "see home, away and limits in scene.rs",
        "ticks at a limit, first joint `grip`",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
}

/// Three times what a slow motion needs was less than what feedback asks for at a step of an
/// encoder.
#[test]
fn a_joint_without_a_limit_of_torque_has_room_for_feedback() {
    let folder = Folder::new();
    let urdf = "<robot name='slow'><link name='base'/>
        <link name='column'><inertial><origin xyz='0 0 0.1'/><mass value='2'/>
        <inertia ixx='0.01' iyy='0.01' izz='0.01' ixy='0' ixz='0' iyz='0'/></inertial></link>
        <link name='beam'><inertial><origin xyz='0.3 0 0'/><mass value='1'/>
        <inertia ixx='0.002' iyy='0.01' izz='0.01' ixy='0' ixz='0' iyz='0'/></inertial></link>
        <joint name='turn' type='continuous'><parent link='base'/><child link='column'/><axis xyz='0 0 1'/></joint>
        <joint name='lift' type='revolute'><origin xyz='0 0 0.2'/><parent link='column'/><child link='beam'/>
        <axis xyz='0 1 0'/><limit lower='-1.5' upper='1.5' effort='15' velocity='0.3'/></joint></robot>";
    let file = folder.write("slow.urdf", urdf);
    let (project, words) = project(&folder, "slow", &file);
    assert!(words.is_empty(), "{words:?}");
    if cfg!(feature = "full") {
        let said = run(&[("slow", project)]);
        assert!(said.contains("test result: ok. 4 passed"), "{said}");
    }
    // With a limit of its own the steps of the encoders saturate it up to 0.2 N·m, and do not at
    // 0.3 N·m.
    for (effort, is_told) in [(0.2, true), (0.3, false)] {
        let limit = format!("'continuous'><limit effort='{effort}' velocity='3'/>");
        let urdf = urdf.replace("'continuous'>", &limit);
        let file = folder.write("weak.urdf", &urdf);
        let (_, words) = self::project(&folder, &format!("weak{is_told}"), &file);
        let told = words.concat().contains("`turn` has a limit of torque of 0.2");
        assert_eq!(told, is_told, "{words:?}");
    }
}
