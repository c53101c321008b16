//! The box of the joints: data beside the code, for `certify`.

use dynamics_core::model::{JointKind, Robot as _};

use super::{B, N, Robot};

/// For each joint, whether it turns, its least and greatest position, and its greatest speed.
#[used]
static CERTIFIED_JOINTS: [[f32; 4]; N] = joints();

const fn joints() -> [[f32; 4]; N] {
    let (links, mut joints) = (Robot::MODEL.links, [[0.0; 4]; N]);
    let mut i = 0;
    while i < B {
        let link = &links[i];
        let turns = match link.joint.kind {
            JointKind::Revolute | JointKind::Continuous => 1.0,
            _ => 0.0,
        };
        let (_, coordinates) = link.joint.kind.coordinates();
        assert!(coordinates < 2, "each joint has one coordinate at most");
        if coordinates == 1 {
            let limits = link.limits;
            joints[link.idx_v] =
                [turns, limits.lower as f32, limits.upper as f32, limits.velocity as f32];
        }
        i += 1;
    }
    joints
}
