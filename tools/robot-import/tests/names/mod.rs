//! Whatever a robot, a link, a joint or a project is called, what is written of it compiles, and
//! nothing of a name is code.

pub mod compiled;
mod drawn;
mod files;
mod projects;

use std::path::Path;

use robot_import::loops::{self, Motors};
use robot_import::project::{Feedback, FileEffects, Kind, Library, Project, RobotFile};
use robot_import::selection::Selection;
use robot_import::source::parse;
use robot_import::tree::{Numbers, Tree};
use robot_import::write::{self, Origin, type_name};

/// The names of a robot and its parts.
#[derive(Clone, Debug)]
struct Names {
    robot: String,
    /// The base, two links that move, and one that is fixed to the first of them.
    links: [String; 4],
    /// Names of the links, and of the joint or constraint that closes a loop, if there is one.
    joints: [String; 4],
    /// The name of the file and its licence.
    file: [String; 2],
}

/// An attribute's text in XML, which has no other control characters than these.
fn attribute(name: &str) -> String {
    let legal = |c: &char| !c.is_control() || "\t\n\r".contains(*c) || *c >= '\u{7f}';
    let written = |c: char| match c {
        '\u{fffe}' | '\u{ffff}' => String::new(),
        'a'..='z' | 'A'..='Z' | '0'..='9' => c.to_string(),
        _ => format!("&#{};", u32::from(c)),
    };
    name.chars().filter(legal).map(written).collect()
}

const INERTIAL: &str = r#"<inertial><origin xyz=".1 0 .05"/><mass value="1"/><inertia ixx=".02" ixy="0" ixz="0" iyy=".02" iyz="0" izz=".03"/></inertial>"#;

impl Names {
    /// Two joints, of which the second follows the first, with friction, roundings and a fixed
    /// link.
    fn urdf(&self) -> String {
        let [base, a, b, fixed] = self.links.each_ref().map(|name| attribute(name));
        let [j, k, weld, _] = self.joints.each_ref().map(|name| attribute(name));
        let link = |name| format!("<link name=\"{name}\">{INERTIAL}</link>\n");
        let joint = |name, kind, [parent, child]: [&str; 2], more| {
            format!(
                "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>\
                 <origin xyz=\"0 0 .2\" rpy=\"1.5708 0 0.3\"/><axis xyz=\"0 1 0\"/>\
                 <limit lower=\"-1\" upper=\"1\" effort=\"10\" velocity=\"2\"/>{more}</joint>\n"
            )
        };
        let follows = format!("<mimic joint=\"{j}\" multiplier=\"0.5\"/>");
        [
            format!("<robot name=\"{}\">\n", attribute(&self.robot)),
            [&base, &a, &b, &fixed].map(link).concat(),
            joint(&j, "revolute", [&base, &a], "<dynamics damping=\"1\" friction=\"2\"/>"),
            joint(&k, "prismatic", [&a, &b], &follows),
            joint(&weld, "fixed", [&a, &fixed], ""),
            "</robot>".to_owned(),
        ]
        .concat()
    }

    /// Two bodies whose ends meet, with a spring and a balanced weight, which the import leaves out
    /// and names.
    fn mjcf(&self) -> String {
        let [_, a, b, _] = self.links.each_ref().map(|name| attribute(name));
        let [j, k, end, _] = self.joints.each_ref().map(|name| attribute(name));
        let body = |name, joint, more| {
            format!(
                "<body name=\"{name}\" {more}><joint name=\"{joint}\" axis=\"0 1 0\" stiffness=\"3\" armature=\"1\"/>\
                 <geom size=\".1\" pos=\".1 0 0\"/></body>\n"
            )
        };
        format!(
            "<mujoco model=\"{}\"><worldbody>\n{}{}</worldbody><equality>\
             <connect name=\"{end}\" body1=\"{a}\" body2=\"{b}\" anchor=\".3 0 0\"/></equality>\
             <actuator><motor joint=\"{j}\" ctrlrange=\"-5 5\"/></actuator></mujoco>",
            attribute(&self.robot),
            body(&a, &j, "gravcomp=\"1\""),
            body(&b, &k, ""),
        )
    }

    /// The file of such a robot; none if two links or joints have one name.
    fn robot_file(&self, text: &str) -> Option<RobotFile> {
        let robot = parse(text, Path::new(".")).ok()?;
        let selected = Selection::default().of(&robot).expect("all of it");
        let tree = Tree::of(&robot, &selected, Numbers::Exact).expect("two joints");
        let (closed, left_out) = loops::closed(&robot, &tree);
        let [file, licence] = self.file.clone();
        let origin = Origin {
            file,
            licence: Some(licence),
            date: "2026-11-23".to_owned(),
            notes: [robot.notes.clone(), left_out].concat(),
        };
        let type_name = type_name(&self.robot);
        let motors = Motors::of(&tree, &closed, &[]).expect("the file's own motors");
        let text = write::source(&tree, &self.robot, &type_name, &origin)
            + &loops::source(&tree, &type_name, &closed, &motors);
        let is_some = |of: fn(&robot_import::tree::Body) -> f64| {
            tree.bodies.iter().any(|body| of(body) != 0.0)
        };
        let [q, v] = tree.coordinates();
        Some(RobotFile {
            type_name,
            text,
            again: "FILE".into(),
            joints: tree.bodies.iter().map(|body| body.joint.clone()).collect(),
            bodies: tree.bodies.iter().map(|body| body.name.clone()).collect(),
            b: tree.bodies.len(),
            q,
            v,
            coupled: tree.has_followers(),
            effects: FileEffects {
                viscous: is_some(|body| body.damping),
                coulomb: is_some(|body| body.friction),
                armature: is_some(|body| body.armature),
                spring: tree.has_springs(),
            },
            feedback: Feedback::default(),
        })
    }
}

/// A project of a robot.
fn project(name: &str, robot: RobotFile, c: bool) -> Project {
    Project {
        name: name.to_owned(),
        robot,
        library: Library::Path(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../dynamics-core")),
        kind: if c { Kind::C } else { Kind::Simulation },
    }
}
