//! A calibrated model: masses and inertias from flash in place of those of the data sheet.
//!
//! `cargo run -p dynamics-core --example calibrated_model`
fn main() {}
