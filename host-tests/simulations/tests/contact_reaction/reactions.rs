//! An arm that a hand moves.

use glam::DVec3;
use motion_control::motion::{ContactPhase, ContactResponse};

use crate::contact_reaction::cell::Cell;
use crate::contact_reaction::plant::{Off, Setup};
use crate::contact_reaction::{FLOAT, OFF};

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |most, x| f64::max(most, x.abs()))
}

/// The effect of a hand on an arm: from tick 1000 on it pushes for a second.
struct Pushed {
    cell: Cell,
    /// The distance of the tip while it was pushed, m.
    went: f64,
    /// The largest speed of a joint a second after it, rad/s.
    left: f64,
}

fn pushed(response: ContactResponse<f64>, off: Off, share: f64) -> Pushed {
    let mut cell = Cell::new(&Setup { off, response: Some(response), share, ..Setup::FREE });
    let hand = DVec3::new(0.0, 20.0, 30.0);
    let mut places = Vec::new();
    let mut left = 0.0;
    for tick in 0..5000 {
        let pushes = (1000..2000).contains(&tick);
        cell.wall.hand = if pushes { hand } else { DVec3::ZERO };
        cell.tick();
        if pushes {
            places.push(cell.tip());
        }
        if tick == 3000 {
            left = largest(cell.at.qd);
        }
    }
    Pushed { went: places[0].distance(places[places.len() - 1]), left, cell }
}

#[test]
fn a_floating_arm_stays_where_a_hand_leaves_it() {
    for off in OFF {
        let Pushed { mut cell, went, left, .. } = pushed(FLOAT, off, 0.6);
        println!("{off:?}: {went} m, {left} rad/s");
        assert!(went > 0.2, "{went}");
        assert!(left < 0.02, "{left}");
        assert_eq!(cell.reaction.phase(), ContactPhase::Held);
        let place = cell.tip();
        for _ in 0..2000 {
            cell.tick();
        }
        assert!(cell.tip().distance(place) < 1e-3);
        // The hand comes back.
        cell.wall.hand = DVec3::new(0.0, -20.0, 40.0);
        for _ in 0..200 {
            cell.tick();
        }
        let soon = cell.tip().distance(place);
        println!("again: {soon} m");
        assert_eq!(cell.reaction.phase(), ContactPhase::Floating);
        assert!(soon > 0.01, "{soon}");
    }
    // One with twenty times the damping is not moved as far, and one whose friction is compensated
    // in excess does not come to rest.
    let stiff = ContactResponse::Float { damping: 100.0, speed: 0.5 };
    let damped = pushed(stiff, OFF[0], 0.6);
    let driven = pushed(FLOAT, OFF[1], 1.3);
    println!("damped: {} m, driven: {} rad/s", damped.went, driven.left);
    assert!(damped.went < 0.2, "{}", damped.went);
    assert!(driven.left > 0.2, "{}", driven.left);
}
