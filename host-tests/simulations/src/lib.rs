//! Tests that simulate, in `tests/`.
