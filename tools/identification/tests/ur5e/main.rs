//! Claims about the identification of a UR5e: half a minute in closed loop with encoders of 14
//! bits, torques with noise, and parameters that are off by up to 30 %. `TABLES_WRITE=1` writes the
//! tables of `docs/guide/src/identification.md`.

mod bad_input;
mod base;
mod coverage;
mod excitation;
#[path = "../generated/ur5e_excitation.rs"]
mod generated;
mod physical;
mod plant;
mod setup;

use host_tests::page::Table;

const fn table(name: &'static str) -> Table {
    Table { page: "identification.md", name, test: "tools/identification/tests/ur5e" }
}
