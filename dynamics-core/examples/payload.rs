//! A payload that is known only at run time.
//!
//! `cargo run -p dynamics-core --example payload`
fn main() {}
