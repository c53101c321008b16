//! The states that the host writes into the program.

use dynamics_core::model::JointCoordinate;
use dynamics_core::state::State;

use crate::{N, Trig};

const STATES: usize = 32;

#[used]
pub static CERTIFIED_STATES: [State<f32, N, N>; STATES] =
    [const { State { q: [0.0; N], qd: [0.0; N], qdd: [0.0; N] } }; STATES];

#[used]
pub static CERTIFIED_TRIGS: [Trig; STATES] =
    [const { Trig { coordinates: [JointCoordinate { q: 0.0, sin: 0.0, cos: 1.0 }; N] } }; STATES];
