//! A robot with what real ones lack.

use dynamics_core::model::{BASE, Body, Joint, Model, Robot};

/// All that the four robots lack: prismatic joints, oblique axes of both kinds, welds on the
/// base, in mid-tree (a branch among them) and at a tip, two roots.
#[derive(Clone, Copy, Debug)]
pub struct StressRobot;

impl Robot<11, 7, 7> for StressRobot {
    const MODEL: Model<f64, 11, 7, 7> = Model::new(
        "odd",
        [
            Body::new("plinth", BASE, Joint::fixed())
                .xyz([0.1, 0.2, 0.3])
                .rpy([0.3, 0.2, 0.1])
                .mass(3.0)
                .com([0.1, 0.0, 0.0]),
            Body::new("rail", 0, Joint::prismatic([1.0, 2.0, -0.5]))
                .xyz([0.3, -0.1, 0.2])
                .rpy([0.5, -0.2, 0.7])
                .mass(2.0)
                .com([0.1, -0.2, 0.3])
                .inertia([0.2, 0.01, -0.02, 0.3, 0.03, 0.25]),
            Body::new("yoke", 1, Joint::revolute([0.3, -0.4, 0.8]))
                .xyz([0.3, 0.5, -0.2])
                .rpy([-0.5, 1.2, 0.7])
                .mass(1.5)
                .com([-0.1, 0.2, 0.3])
                .inertia([0.1, 0.01, -0.02, 0.12, 0.03, 0.15]),
            Body::new("bracket", 2, Joint::fixed())
                .xyz([0.1, 0.5, 0.2])
                .rpy([0.5, 0.2, -0.7])
                .mass(0.7)
                .com([0.1, 0.2, -0.3])
                .inertia([0.05, 0.0, 0.0, 0.06, 0.0, 0.04]),
            Body::new("quill", 3, Joint::prismatic([0.0, 0.0, 1.0]))
                .xyz([0.3, 0.3, 0.3])
                .mass(1.0)
                .com([0.05, 0.02, 0.3])
                .inertia([0.05, 0.0, 0.0, 0.06, 0.0, 0.04]),
            Body::new("head", 4, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.0, 0.3, 0.3])
                .rpy([0.1, 0.2, 0.3])
                .mass(0.8)
                .com([0.15, 0.02, 0.1])
                .inertia([0.05, 0.004, 0.0, 0.06, 0.0, 0.04]),
            Body::new("tool", 5, Joint::fixed())
                .xyz([0.0, 0.1, 0.2])
                .quarter_turns([1, 0, 2])
                .mass(0.3)
                .com([0.0, 0.02, 0.1]),
            Body::new("boom", 3, Joint::revolute([-1.0, 0.2, 0.0]))
                .xyz([0.2, 0.1, 0.3])
                .rpy([1.1, 0.2, 0.3])
                .mass(0.9)
                .com([0.15, -0.12, 0.1])
                .inertia([0.05, 0.004, 0.0, 0.06, 0.0, 0.04]),
            Body::new("jib", 7, Joint::revolute([1.0, 0.0, 0.0]))
                .xyz([0.2, 0.1, 0.3])
                .mass(0.4)
                .com([0.15, -0.12, 0.1])
                .inertia([0.05, 0.004, 0.0, 0.06, 0.0, 0.04]),
            Body::new("lift", BASE, Joint::prismatic([0.0, -1.0, 0.0]))
                .xyz([0.2, 0.1, 0.3])
                .rpy([0.2, 0.3, 0.4])
                .mass(0.4)
                .com([0.15, -0.12, 0.1])
                .inertia([0.05, 0.004, 0.0, 0.06, 0.0, 0.04]),
            Body::new("ballast", 9, Joint::fixed())
                .xyz([0.0, 0.1, 0.2])
                .mass(0.5)
                .com([0.05, 0.0, 0.1]),
        ],
    );
}
