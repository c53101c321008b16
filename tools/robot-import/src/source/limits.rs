//! Numbers of a joint that mean no limit, or no motion.

use crate::description::{Description, Format, Kind, shortened};
use crate::limits::{MOST, NO_LIMIT};

/// Takes out the limits that are none, and says so in a sentence for each joint.
///
/// A limit of speed or torque of zero or less is none as well: see [`Tree`](crate::tree::Tree).
pub fn without(robot: &mut Description) {
    for joint in &mut robot.joints {
        let mut none = Vec::new();
        let limits = &mut joint.limits;
        for (what, limit) in
            [("speed", &mut limits.velocity), ("torque or force", &mut limits.effort)]
        {
            if let Some(x) = limit.take_if(|x| x.abs() >= NO_LIMIT) {
                none.push(format!("{what} {x:e}"));
            }
        }
        if let Some([lower, upper]) = limits.position {
            let [is_below, is_above] = [lower <= -NO_LIMIT, upper >= NO_LIMIT];
            if is_below && is_above {
                limits.position = None;
                if (robot.format, joint.kind) == (Format::Mjcf, Kind::Revolute) {
                    joint.kind = Kind::Continuous;
                }
                none.push(format!("position {lower:e} to {upper:e}"));
            } else if is_below || is_above {
                // The library's limits have two ends.
                limits.position = Some([lower.max(-NO_LIMIT), upper.min(NO_LIMIT)]);
                let end = if is_below { lower } else { upper };
                none.push(format!(
                    "position {end:e} at one end, which stands as {:e}",
                    end.clamp(-NO_LIMIT, NO_LIMIT)
                ));
            }
        }
        let holds = [
            ("damping", joint.damping),
            ("dry friction", joint.friction),
            ("armature", joint.armature),
        ];
        if let Some((what, x)) = holds.into_iter().find(|(_, x)| *x > MOST) {
            let name = shortened(&joint.name);
            robot.notes.push(format!(
                "Joint `{name}`: {what} {x:e} holds it where it is; `--lock {name}=0` takes it out \
                 of the robot."
            ));
        }
        if !none.is_empty() {
            robot.notes.push(format!(
                "Joint `{}`: {} is a number that stands for no limit (beyond {NO_LIMIT:e}), and is \
                 taken as none.",
                shortened(&joint.name),
                none.join(", ")
            ));
        }
    }
}
