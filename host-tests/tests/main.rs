//! The tests of the library on the host, in one program: each robot, scalar and scene is compiled
//! once for all of them.

mod common;

mod accuracy;
mod calibrated;
mod checks;
mod closed_loops;
mod contact;
mod control;
mod control_example;
mod control_parts;
mod coriolis;
mod derivatives;
mod detectors;
mod devices;
mod effects;
mod energy_projected;
mod external_torque;
mod fuzz;
mod generated;
mod kinematics;
mod manifold;
mod measured;
mod merged;
mod model;
mod momentum;
mod moving_goal;
mod operational;
mod oracle_motion;
mod passivity;
mod pictures;
mod regressor;
mod scara;
mod serde;
mod singular;
mod survivors;
mod tip_motion;
mod trig;
