//! Kinematic loops: laws, closed forms, recordings of another library, bad input. One program,
//! since all of it uses the same functions of the same machines.

mod bad_input;
mod closed_forms;
mod clusters;
mod drift;
mod hard_cases;
mod kinds;
mod laws;
mod recorded;
mod singular;
mod status;
