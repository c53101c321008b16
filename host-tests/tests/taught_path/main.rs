//! Claims about the fastest motions along taught paths: against TOPP-RA, within limits between grid points, and played back after
//! a hand has guided the arm. `TABLES_WRITE=1` writes the tables of `docs/guide/src/taught-paths.md`.

#[path = "../hand_guiding/cell.rs"]
#[allow(dead_code, reason = "other tests use the rest of it")]
mod cell;
mod person;
#[path = "../hand_guiding/plant.rs"]
#[allow(dead_code, reason = "other tests use the rest of it")]
mod plant;
mod playback;
mod toppra;
mod trees;
mod ur5e;

use host_tests::page::Table;

const fn table(name: &'static str) -> Table {
    Table {
        page: "taught-paths.md",
        name,
        test: "host-tests/tests/taught_path",
    }
}
