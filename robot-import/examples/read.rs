//! Reads files and prints what they have.
fn main() {
    for path in std::env::args().skip(1) {
        match robot_import::source::read(path.as_ref()) {
            Ok(robot) => {
                let snaps: usize = robot.joints.iter().map(|joint| joint.snapped.len()).sum();
                println!(
                    "ok {} links, {} joints, {snaps} snapped: {path}",
                    robot.links.len(),
                    robot.joints.len()
                );
            }
            Err(error) => println!("ERR {path}: {error}"),
        }
    }
}
