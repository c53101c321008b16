//! Tests of many specialised functions that run for a first_moment: compiled at opt-level 0, they take the compiler a
//! third of the time that `host-tests` would take for them, and no less memory.
