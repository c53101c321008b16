//! Claims about the fastest motions along taught paths: against TOPP-RA, within limits between grid
//! points, and played back after a hand has guided the arm. `TABLES_WRITE=1` writes the tables of
//! `docs/guide/src/taught-paths.md`.

mod person;
mod playback;
mod toppra;
mod ur5e;

use host_tests::page::Table;

const fn table(name: &'static str) -> Table {
    Table { page: "taught-paths.md", name, test: "host-tests/simulations/tests/taught_path" }
}
