//! The names that joints of the library's robots have in the files of their sources.

/// The name of the joint of a robot's body.
pub fn joint(robot: &str, number: usize, body: &str) -> String {
    // A name for each, or one for all, with the joint's number (#) or the body (*).
    let names = match robot {
        "ur5e" => "shoulder_pan_joint shoulder_lift_joint elbow_joint *_joint *_joint *_joint",
        "so101" => "shoulder_pan shoulder_lift elbow_flex wrist_flex wrist_roll gripper",
        "panda" => "panda_joint#",
        "iiwa14" => "iiwa_joint_#",
        "gen3" => "joint_#",
        "xarm7" => "joint#",
        "z1" => "joint1 joint2 joint3 joint4 joint5 joint6 jointGripper",
        _ => "*_joint",
    };
    let name = names.split(' ').cycle().nth(number).unwrap_or("*_joint");
    match body {
        "trunk" | "pelvis" => "floating_base".to_owned(),
        "torso" => "waist_pitch_joint".to_owned(),
        foot if foot.ends_with("_foot") => format!("{foot}_fixed"),
        body => name.replace('#', &(number + 1).to_string()).replace('*', body),
    }
}
