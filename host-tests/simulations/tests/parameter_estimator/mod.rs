//! Claims about the estimator of an arm's parameters, on a simulated SO-101 with the encoders,
//! duties and frictions of its scene.

pub mod arm;
mod bad_input;
mod estimate;
mod learner;
mod rest;
mod stored;
