//! Runs the scene [`contact`](lab_target::contact) and prints a row for each run: the host prints the same ones.
#![no_std]
#![no_main]

use lab_target::contact::{crash, firmware::REGIONS};

lab_target::trial_main!(REGIONS, crash::COLUMNS, crash::rows);
