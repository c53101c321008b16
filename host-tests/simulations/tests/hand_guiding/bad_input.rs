//! Numbers that are not finite: torques stay limited, and the arm stays where it is.

use motion_control::Estimate;

use crate::hand_guiding::cell::Cell;
use crate::hand_guiding::{POSTURES, SHARE, setup};

// The arm does not move.
#[test]
fn nonfinite_velocities_and_frictions_give_no_torque() {
    let setup = setup(SHARE, 0.1);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for q in POSTURES {
            let mut cell = Cell::new(q, &setup);
            let from = cell.tip();
            for tick in 0..1000 {
                let mut estimate = Estimate { q, qd: [0.0; 6] };
                if tick % 2 == 0 {
                    estimate.qd = [bad; 6];
                } else {
                    (estimate.qd, cell.over) = ([0.1; 6], bad);
                }
                cell.tick_by(&estimate);
                assert_eq!(cell.guide, [0.0; 6]);
                cell.over = 0.1;
            }
            for _ in 0..1000 {
                cell.tick();
            }
            assert!((cell.tip() - from).length() < 1e-3);
        }
    }
}

#[test]
fn a_wrong_velocity_is_compensated_within_the_limit() {
    let setup = setup(SHARE, 0.1);
    for wrong in [1e3, -1e3, 1e300, f64::MIN_POSITIVE] {
        let mut cell = Cell::new(POSTURES[0], &setup);
        let estimate = Estimate {
            q: POSTURES[0],
            qd: [wrong; 6],
        };
        cell.tick_by(&estimate);
        for (guide, limit) in cell.guide.iter().zip(setup.config.compensation) {
            assert!(guide.abs() <= limit, "{guide} of {limit} N·m");
        }
    }
}
