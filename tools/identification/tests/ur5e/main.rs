//! Claims about the identification of a UR5e: half a minute in closed loop with encoders of 14
//! bits, torques with noise, and parameters that are off by up to 30 %. The tables of
//! `docs/guide/src/identification.md` were measured here.

mod bad_input;
mod base;
mod coverage;
mod excitation;
#[path = "../generated/ur5e_excitation.rs"]
mod generated;
mod physical;
mod plant;
mod setup;
