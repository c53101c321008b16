//! Claims about the estimator of an arm's parameters, on a simulated SO-101 with the encoders,
//! duties and frictions of its scene.

mod arm;
mod bad_input;
mod estimate;
mod learner;
mod least_squares;
mod rest;
mod stored;
mod ur5e;
