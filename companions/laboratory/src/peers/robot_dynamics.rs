//! RobotDynamics (C99, by Yue Wang): the cycles that its repository publishes, as `benchmark/results`
//! of the commit on the page has them, and those that the gates count. Its code is no part of this
//! repository.

use crate::peers::gates::{INSIDE, by_stages};
use crate::peers::report::{M4F, Row};
use xtask::kit::table::{Table, thousands};

/// Cycles of its `rd_update_kinematics` and `rd_rnea` on the gates, the most of the states of `gates`,
/// counted once on 2026-11-27. It was built by riscv64-unknown-elf-gcc 12.2 with `-O3 -mtune=size`,
/// the better of ten ways, with a `memcpy` that copies 64 bytes without a loop.
const COUNTED: [u64; 3] = [5074, 5119, 7933];

/// Its robot, and ours; the algorithm; cycles on the STM32G474, STM32L413, RP2350 and ESP32-C6 of
/// `update_kinematics` and `rnea`, `crba` or the faster of `aba` and `fd_crba`; 0 if there are none.
const PUBLISHED: [([&str; 2], &str, [u64; 4]); 9] = [
    (["xarm7", "xarm7"], "rnea", [8186, 7979, 6455, 118_420]),
    (["xarm7", "xarm7"], "crba", [9702, 9450, 8384, 145_788]),
    (["xarm7", "xarm7"], "aba", [16_843, 16_450, 14_072, 250_254]),
    (["go2", "a1_free"], "rnea", [12_847, 12_486, 10_535, 206_621]),
    (["go2", "a1_free"], "crba", [13_922, 13_499, 12_115, 165_415]),
    (["go2", "a1_free"], "aba", [31_180, 30_605, 21_759, 410_149]),
    (["g1", "g1_free"], "rnea", [28_283, 0, 0, 0]),
    (["g1", "g1_free"], "crba", [43_651, 0, 0, 0]),
    (["g1", "g1_free"], "aba", [73_833, 0, 0, 0]),
];

/// Its rows on the gates.
pub fn on_gates() -> [Row; 3] {
    let peer = format!("RobotDynamics{INSIDE}");
    by_stages(["xarm7", "rnea", &peer], |stages| (COUNTED[stages], String::new()))
}

/// What it publishes, beside ours of this run.
pub fn table(rows: &[Row]) -> Table {
    let number = |cycles| if cycles == 0 { "–".into() } else { thousands(cycles) };
    let mut table = Table::new(&[
        "its robot; ours, algorithm",
        "STM32G474, 170 MHz",
        "STM32L413, 80 MHz",
        "RP2350, Cortex-M33, 150 MHz",
        "ESP32-C6, 160 MHz, no FPU",
        "core, M4F",
        "engine, M4F",
    ]);
    for ([theirs, robot], algorithm, cycles) in PUBLISHED {
        let ours = ["core", "engine"].map(|peer| {
            let of = (M4F, robot, algorithm, peer);
            let is_its = |row: &&Row| (row.target, &*row.robot, &*row.algorithm, &*row.peer) == of;
            rows.iter().find(is_its).and_then(|row| row.cycles).unwrap_or(0)
        });
        let name = format!("{theirs}; {robot}, {algorithm}");
        table.row(std::iter::once(name).chain(cycles.into_iter().chain(ours).map(number)));
    }
    table
}
