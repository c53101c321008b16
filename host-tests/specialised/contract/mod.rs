//! The promises of effects and descriptions to their users: a load acts on the body that it names,
//! a hook under the constant that announces it, a calibration in the frames of the description;
//! small robots, few instances.

mod hooks;
mod payload;

use dynamics_core::model::{BASE, Body, Joint, Model, Robot};
use dynamics_core::state::State;

/// A column with two arms, each of which ends in a hand that is welded on, and a frame without mass
/// that is listed last, as converters of URDF list it.
struct TwoHands;

const LEFT: usize = TwoHands::MODEL.body("left hand");
const RIGHT: usize = TwoHands::MODEL.body("right hand");
const FRAME: usize = TwoHands::MODEL.body("frame");

impl Robot<6, 3, 3> for TwoHands {
    const MODEL: Model<f64, 6, 3, 3> = Model::new(
        "two hands",
        [
            Body::new("column", BASE, Joint::revolute([0.1, -0.2, 1.0]))
                .xyz([0.1, 0.2, 0.3])
                .rpy([0.2, -0.1, 0.4])
                .mass(4.0)
                .com([0.02, -0.01, 0.2])
                .inertia([0.2, 0.01, -0.02, 0.25, 0.03, 0.1]),
            Body::new("left arm", 0, Joint::revolute([1.0, 0.3, -0.2]))
                .xyz([0.0, 0.2, 0.5])
                .rpy([0.7, 0.1, -0.3])
                .mass(1.5)
                .com([0.1, 0.02, -0.03])
                .inertia([0.01, 0.001, 0.0, 0.03, -0.002, 0.03]),
            Body::new("left hand", 1, Joint::fixed())
                .xyz([0.3, 0.0, 0.1])
                .rpy([0.3, -0.6, 0.2])
                .mass(0.4)
                .com([0.0, 0.01, 0.05])
                .inertia([0.001, 0.0, 0.0, 0.001, 0.0, 0.001]),
            Body::new("right arm", 0, Joint::prismatic([0.2, 1.0, 0.4]))
                .xyz([0.0, -0.2, 0.5])
                .rpy([-0.5, 0.2, 0.9])
                .mass(1.2)
                .com([0.05, -0.1, 0.02])
                .inertia([0.02, 0.0, 0.001, 0.01, 0.0, 0.02]),
            Body::new("right hand", 3, Joint::fixed())
                .xyz([0.1, -0.3, 0.0])
                .rpy([1.1, 0.4, -0.8])
                .mass(0.3)
                .com([0.02, 0.0, 0.04])
                .inertia([0.001, 0.0, 0.0, 0.001, 0.0, 0.001]),
            Body::new("frame", BASE, Joint::fixed()).rpy([0.0, 0.0, 3.0]),
        ],
    );
}

const MOVING: State<f64, 3, 3> =
    State { q: [0.3, -0.8, 0.2], qd: [1.2, -0.7, 0.5], qdd: [3.0, 2.0, -4.0] };

/// The largest difference, relative to the largest number that is wanted.
#[track_caller]
fn close(got: &[f64], want: &[f64], relative: f64) {
    assert_eq!(got.len(), want.len());
    let size = want.iter().fold(0.0, |size, x| f64::max(size, x.abs()));
    for (got, want) in got.iter().zip(want) {
        let apart = (got - want).abs();
        assert!(apart <= relative * size, "{got} for {want}, of {size}");
    }
}
