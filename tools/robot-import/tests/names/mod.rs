//! Whatever a robot, a link, a joint or a project is called, what is written of it compiles, and
//! nothing of a name is code.

pub mod compiled;
mod files;

use std::path::Path;

use robot_import::project::{Kind, Library, Project, RobotFile};

/// A project of a robot.
fn project(name: &str, robot: RobotFile, c: bool) -> Project {
    Project {
        name: name.to_owned(),
        robot,
        library: Library::Path(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../dynamics-core")),
        kind: if c { Kind::C } else { Kind::Simulation },
    }
}
