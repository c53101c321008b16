//! The targets of `host_tests::fuzz` for bolero: `cargo xtask fuzz`, or with coverage to guide it
//! `cargo bolero test --engine libfuzzer description` in this directory.

#[test]
fn description() {
    bolero::check!().for_each(host_tests::fuzz::description);
}

#[test]
fn dynamics() {
    bolero::check!().for_each(host_tests::fuzz::dynamics);
}

#[test]
fn controller() {
    bolero::check!().for_each(host_tests::fuzz::controller);
}

#[test]
fn frames() {
    bolero::check!().for_each(host_tests::fuzz::frames);
}
