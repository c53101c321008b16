//! Comparison of the machines with Pinocchio: `host-tests/oracle/loops.py`.

use dynamics_core::model::Robot;
use loop_tests::export::machine;
use loop_tests::machines::{Delta, FiveBar, FourBar, Stewart};
use loop_tests::recorded::{Recording, errors};

macro_rules! moves_as_in_pinocchio {
    ($test:ident, $T:ident, $($sizes:literal),*) => {
        #[test]
        fn $test() {
            let recording = Recording::load($T::MODEL.name);
            let version = &recording.pinocchio;
            assert!(version.starts_with("4.1"), "{version}");
            let now = machine::<$T, $($sizes),*>();
            assert_eq!(recording.machine, now, "another machine was recorded");
            errors::<$T, $($sizes),*>().check();
        }
    };
}

moves_as_in_pinocchio!(a_four_bar_linkage, FourBar, 3, 3, 3, 1, 5, 1);
moves_as_in_pinocchio!(a_five_bar_linkage, FiveBar, 4, 4, 4, 1, 5, 2);
moves_as_in_pinocchio!(a_delta_robot, Delta, 10, 22, 21, 6, 18, 3);
moves_as_in_pinocchio!(a_stewart_platform, Stewart, 13, 25, 24, 6, 18, 6);
