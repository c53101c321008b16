//! Runs the scene [`learning`](firmware_demo::learning) and prints a row for each run: the host prints the same ones.
#![no_std]
#![no_main]

use firmware_demo::learning::{firmware::REGIONS, run};

firmware_demo::trial_main!(REGIONS, run::COLUMNS, run::rows);
