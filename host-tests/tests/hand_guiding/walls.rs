//! Walls and locked joints against a hand.

use glam::DVec3;

use crate::cell::{Cell, Setup};
use crate::plant::{Hand, Q};
use crate::{POSTURES, SHARE, setup};

/// An arm with locked joints after a push of a hand.
fn pushed(setup: &Setup, locked: [bool; 6], push: DVec3, ticks: u32) -> Cell {
    let mut cell = Cell::new(POSTURES[0], setup);
    cell.guiding.lock(&locked, &POSTURES[0]).expect("finite");
    cell.hand = Hand::Push(push);
    for _ in 0..ticks {
        cell.tick();
    }
    cell
}

fn moved(cell: &Cell) -> Q {
    core::array::from_fn(|j| (cell.at.q[j] - POSTURES[0][j]).abs())
}

#[test]
fn a_wall_stops_the_joint_without_oscillation_and_pushes_it_back() {
    let mut walls = setup(SHARE, 0.1);
    (walls.config.lower[0], walls.config.upper[0]) = (-0.1, 0.1);
    let others = [false, true, true, true, true, true];
    for side in [1.0, -1.0] {
        let push = DVec3::new(0.0, -40.0 * side, 0.0);
        let mut cell = pushed(&walls, others, push, 4000);
        let depth = |cell: &Cell| side * cell.at.q[0] - 0.1;
        let before = depth(&cell);
        let frictionless = 40.0 * cell.tip().length() / 400.0;
        assert!(
            (0.5..1.0).contains(&(before / frictionless)),
            "{before} rad"
        );
        for _ in 0..1000 {
            cell.tick();
            let wave = (depth(&cell) - before).abs();
            assert!(wave < 1e-5, "it oscillates: {wave} rad");
        }
        cell.hand = Hand::Away;
        for _ in 0..3000 {
            cell.tick();
            let deeper = depth(&cell) - before;
            assert!(deeper < 1e-5, "{deeper} rad deeper");
        }
        // The energy of the spring is lost to friction outside.
        let after = depth(&cell);
        assert!((-0.3..0.0).contains(&after), "{after} rad");
        cell.tick();
        assert!((depth(&cell) - after).abs() < 1e-6, "it is at rest");
    }
}

#[test]
fn a_locked_joint_stays_unless_the_hand_is_stronger_and_the_others_are_moved() {
    let (strong, push) = (setup(SHARE, 0.1), DVec3::new(0.0, 25.0, 0.0));
    let first = [true, false, false, false, false, false];
    let free = moved(&pushed(&strong, [false; 6], push, 700));
    let locked = moved(&pushed(&strong, first, push, 700));
    println!("{free:.3?} {locked:.3?} rad");
    assert!(free[0] > 0.1 && locked[0] < 0.02 && locked[4] > 0.1);
    let mut weak = strong;
    weak.config.lock.torque[0] = 2.0;
    let slips = moved(&pushed(&weak, first, push, 700));
    assert!(slips[0] > 0.1, "{slips:?}");
}
