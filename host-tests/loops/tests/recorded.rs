//! Comparison of the machines with Pinocchio: `host-tests/oracle/loops.py`.

use loop_tests::export::machine;
use loop_tests::machines::{Delta, FiveBar, FourBar, Machine, Stewart};
use loop_tests::recorded::{Recording, errors};

fn agrees<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
>()
where
    T: Machine<B, Q, V, L, C, A>,
{
    let recording = Recording::load(T::MODEL.name);
    let version = &recording.pinocchio;
    assert!(version.starts_with("4.1"), "{version}");
    assert_eq!(recording.machine, machine::<T, B, Q, V, L, C, A>(), "another machine was recorded");
    errors::<T, B, Q, V, L, C, A>().check();
}

#[test]
fn a_four_bar_linkage_moves_as_in_pinocchio() {
    agrees::<FourBar, 3, 3, 3, 1, 5, 1>();
}

#[test]
fn a_five_bar_linkage_moves_as_in_pinocchio() {
    agrees::<FiveBar, 4, 4, 4, 1, 5, 2>();
}

#[test]
fn a_delta_robot_moves_as_in_pinocchio() {
    agrees::<Delta, 10, 22, 21, 6, 18, 3>();
}

#[test]
fn a_stewart_platform_moves_as_in_pinocchio() {
    agrees::<Stewart, 13, 25, 24, 6, 18, 6>();
}
