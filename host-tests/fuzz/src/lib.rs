//! See `tests/targets.rs`.
