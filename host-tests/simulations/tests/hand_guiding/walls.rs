//! Walls and locked joints against a hand.

use glam::DVec3;
use motion_control::law::{CartesianImpedance, ImpedanceConfig};

use crate::hand_guiding::cell::{Cell, Setup};
use crate::hand_guiding::plant::Hand;
use crate::hand_guiding::{POSTURES, SHARE, setup};

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

// The joint does not oscillate.
#[test]
fn a_virtual_wall_stops_and_returns_the_joint() {
    let mut walls = setup(SHARE, 0.1);
    (walls.config.lower[0], walls.config.upper[0]) = (-0.1, 0.1);
    let others = [false, true, true, true, true, true];
    for side in [1.0, -1.0] {
        let push = DVec3::new(0.0, -40.0 * side, 0.0);
        let mut cell = pushed(&walls, others, push, 4000);
        let depth = |cell: &Cell| side * cell.at.q[0] - 0.1;
        let before = depth(&cell);
        let frictionless = 40.0 * cell.tip().length() / 400.0;
        // The wall has braked the joint before, and friction takes a part of the push.
        assert!((0.3..1.0).contains(&(before / frictionless)), "{before} rad");
        for _ in 0..1000 {
            cell.tick();
            // It creeps to where stiction holds it, and does not come back.
            let wave = depth(&cell) - before;
            assert!((-1e-5..2e-4).contains(&wave), "it oscillates: {wave} rad");
        }
        cell.hand = Hand::Away;
        let before = depth(&cell);
        for _ in 0..3000 {
            cell.tick();
            let deeper = depth(&cell) - before;
            assert!(deeper < 1e-5, "{deeper} rad deeper");
        }
        // The energy of the spring is lost to friction on the way back.
        let after = depth(&cell);
        assert!((-0.3..0.0).contains(&after), "{after} rad");
        cell.tick();
        assert!((depth(&cell) - after).abs() < 1e-6, "it is at rest");
    }
}

/// The tip pushed for a second and released: its greatest distance from its height, its way across,
/// and at rest again the greatest distance within a second, m.
fn led(level: Option<CartesianImpedance<f64, 1>>) -> [f64; 3] {
    let mut cell = Cell::new(POSTURES[0], &setup(SHARE, 0.1));
    let from = cell.tip();
    cell.level = level.map(|impedance| (impedance, from.z));
    cell.hand = Hand::Push(DVec3::new(20.0, 10.0, 20.0));
    let mut highest = 0.0_f64;
    for _ in 0..1000 {
        cell.tick();
        highest = highest.max((cell.tip().z - from.z).abs());
    }
    let across = (cell.tip() - from).truncate().length();
    cell.hand = Hand::Away;
    cell.run(5000);
    [highest, across, cell.run(1000)]
}

#[test]
fn only_unlocked_directions_of_the_tip_move() {
    let config = ImpedanceConfig { stiffness: [3000.0], zeta: 1.0, slowest: 2.0 };
    let impedance = CartesianImpedance::try_new(config).expect("a good one");
    let [free, level] = [None, Some(impedance)].map(led);
    println!("{free:?} {level:?} m");
    assert!(free[0] > 0.2 && free[1] > 0.2, "{free:?} m");
    assert!(level[0] < 0.02 && level[1] > 0.2, "{level:?} m");
    assert!(level[2] < 5e-5, "it oscillates: {level:?} m");
}
