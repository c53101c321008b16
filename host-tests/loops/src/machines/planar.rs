//! The planar linkages near their homes.

use firmware_demo::robots::planar_loops::{FiveBar, FourBar, Parallelogram};

use super::Machine;

impl Machine<3, 3, 3, 1, 5, 1> for FourBar {
    const HOME: [f64; 3] = [-1.0, 0.5, -1.5];
    const RANGE: f64 = 0.6;
    const ACTUATED_Q: [usize; 1] = [0];
}

impl Machine<3, 3, 3, 1, 5, 1> for Parallelogram {
    const HOME: [f64; 3] = [-1.2, 1.2, -1.2];
    const RANGE: f64 = 0.6;
    const ACTUATED_Q: [usize; 1] = [0];
}

impl Machine<4, 4, 4, 1, 5, 2> for FiveBar {
    const HOME: [f64; 4] = [-2.2, 1.2, -0.9, -1.2];
    const RANGE: f64 = 0.4;
    const ACTUATED_Q: [usize; 2] = [0, 2];
}
