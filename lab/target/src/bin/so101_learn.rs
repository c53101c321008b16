//! Runs the scene [`learning`](lab_target::learning) and prints a row for each run: the host prints the same ones.
#![no_std]
#![no_main]

use lab_target::learning::{firmware::REGIONS, run};

lab_target::trial_main!(REGIONS, run::COLUMNS, run::rows);
