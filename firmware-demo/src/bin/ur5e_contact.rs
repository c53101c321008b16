//! Runs the scene [`contact`](firmware_demo::contact) and prints a row for each run: the host prints the same ones.
#![no_std]
#![no_main]

use firmware_demo::contact::{crash, firmware::REGIONS};

firmware_demo::trial_main!(REGIONS, crash::COLUMNS, crash::rows);
