//! A machine's constants as the oracle's script reads them.

use dynamics_core::loops::{BodyFrame, Loops};
use dynamics_core::model::BASE;
use host_tests::export::{Placement, Robot, robot};
use serde::{Deserialize, Serialize};

use crate::machines::Machine;

#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Exported {
    pub robot: Robot,
    /// The joints that close it.
    pub loops: Vec<Loop>,
    /// The actuated coordinates, as indices in q̇ and in q.
    pub actuated: Vec<[usize; 2]>,
    /// A configuration that is nearly closed.
    pub home: Vec<f64>,
    /// The range of the actuated coordinates about it.
    pub range: f64,
}

#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Loop {
    pub name: String,
    /// Its kind in lower case.
    pub joint: String,
    /// Its unit axis in the loop frames.
    pub axis: [f64; 3],
    /// Predecessor and successor; −1 is the base.
    pub bodies: [i64; 2],
    /// The loop frames in the frames of the two bodies.
    pub placements: [Placement; 2],
}

/// The machine's numbers as they stand in its description.
pub fn machine<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
>() -> Exported
where
    T: Machine<B, Q, V, L, C, A>,
{
    let actuated = T::LOOPS.actuated().iter().zip(T::ACTUATED_Q);
    Exported {
        robot: robot(&T::MODEL),
        loops: loops(&T::LOOPS),
        actuated: actuated.map(|(&v, q)| [v, q]).collect(),
        home: T::HOME.to_vec(),
        range: T::RANGE,
    }
}

/// The joints that close a machine.
pub fn loops<const L: usize, const C: usize, const A: usize>(of: &Loops<L, C, A>) -> Vec<Loop> {
    let loops = of.joints().iter().map(|joint| Loop {
        name: joint.name().into(),
        joint: format!("{:?}", joint.joint().kind).to_lowercase(),
        axis: joint.joint().axis.to_array(),
        bodies: joint.ends().map(|end| match end.body() {
            BASE => -1,
            body => body as i64,
        }),
        placements: joint.ends().each_ref().map(placement),
    });
    loops.collect()
}

fn placement(end: &BodyFrame) -> Placement {
    let pose = end.pose();
    Placement { rotation: pose.rot.transpose().to_cols_array(), position: pose.pos.to_array() }
}
