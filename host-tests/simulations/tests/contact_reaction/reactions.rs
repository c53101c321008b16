//! The retraction, and an arm that a hand moves.

use dynamics_core::state::State;
use glam::DVec3;
use motion_control::{ContactPhase, ContactResponse, MotionLimits, ResetError};

use crate::contact_reaction::cell::{Cell, Spoiled, TICK};
use crate::contact_reaction::plant::{Off, Q, STIFFNESSES, Setup};
use crate::contact_reaction::{FLOAT, OFF, RETRACT, SLOW};

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values
        .into_iter()
        .fold(0.0, |most, x| f64::max(most, x.abs()))
}

/// The references from the contact to the end of the retraction, and the tick of the contact.
fn retraction(
    response: ContactResponse<f64>,
    stiffness: f64,
) -> (Cell, Vec<State<f64, 6, 6>>, u32) {
    let mut cell = Cell::new(&Setup {
        stiffness,
        off: OFF[0],
        response: Some(response),
        ..Setup::FREE
    });
    let (mut path, mut contact) = (Vec::new(), 0);
    for tick in 0..cell.motion.ticks() {
        cell.tick(Spoiled::Nothing);
        match cell.reaction.phase() {
            ContactPhase::Retracting => path.push(*cell.controller.reference()),
            ContactPhase::Watching => contact = tick,
            _ => {}
        }
    }
    assert_eq!(cell.reaction.phase(), ContactPhase::Held);
    (cell, path, contact)
}

/// The largest speed and acceleration of references, by their differences from tick to tick.
fn peaks(path: &[State<f64, 6, 6>]) -> [f64; 2] {
    let speeds = path
        .windows(2)
        .flat_map(|w| (0..6).map(|j| (w[1].q[j] - w[0].q[j]) / TICK));
    let changes = path
        .windows(3)
        .flat_map(|w| (0..6).map(|j| (w[2].q[j] - 2.0 * w[1].q[j] + w[0].q[j]) / (TICK * TICK)));
    [largest(speeds), largest(changes)]
}

#[test]
fn an_arm_goes_back_along_its_path_within_its_limits() {
    for stiffness in STIFFNESSES {
        let (cell, path, contact) = retraction(RETRACT, stiffness);
        let [speed, acceleration] = peaks(&path);
        assert!(speed <= SLOW.velocity, "{speed}");
        assert!(acceleration <= SLOW.acceleration, "{acceleration}");
        // The joint that moves most is the same throughout.
        let ends = [&path[0], &path[path.len() - 1]];
        let went = largest((0..6).map(|j| ends[0].q[j] - ends[1].q[j]));
        assert!((0.095..0.11).contains(&went), "{went}");
        // The distance of positions from the path before the contact.
        let off = |q: &Q| {
            let path = (contact - 1000..contact + 10).map(|tick| cell.motion.at(tick).q);
            path.map(|p| largest((0..6).map(|j| p[j] - q[j])))
                .fold(f64::MAX, f64::min)
        };
        let worst = largest(path.iter().map(|state| off(&state.q)));
        println!(
            "{stiffness}: {speed} rad/s, {acceleration} rad/s², off {worst} and {}",
            off(&cell.at.q)
        );
        assert!(worst < 2e-3, "{worst}");
        assert!(off(&cell.at.q) < 5e-3, "{}", off(&cell.at.q));
        // Another place is off it.
        let elsewhere = core::array::from_fn(|j| ends[1].q[j] + if j == 2 { 0.01 } else { 0.0 });
        assert!(off(&elsewhere) > 2e-3);
    }
    // Wider limits are used, and are beyond these.
    let limits = MotionLimits {
        velocity: 1.0,
        acceleration: 16.0,
    };
    let (_, path, _) = retraction(
        ContactResponse::Retract {
            distance: 0.1,
            limits,
        },
        STIFFNESSES[0],
    );
    let [speed, acceleration] = peaks(&path);
    assert!(speed > SLOW.velocity && acceleration > SLOW.acceleration);
    assert!(speed <= limits.velocity && acceleration <= limits.acceleration);
}

/// The effect of a hand on an arm: from tick 1000 on it pushes for a second.
struct Pushed {
    cell: Cell,
    /// The distance of the tip while it was pushed, m.
    went: f64,
    /// The largest speed of a joint in the second half of the push and a second after it, rad/s.
    fastest: f64,
    left: f64,
}

fn pushed(response: ContactResponse<f64>, off: Off, share: f64) -> Pushed {
    let mut cell = Cell::new(&Setup {
        off,
        response: Some(response),
        share,
        ..Setup::FREE
    });
    let hand = DVec3::new(0.0, 20.0, 30.0);
    let mut places = Vec::new();
    let (mut fastest, mut left) = (0.0, 0.0);
    for tick in 0..5000 {
        let pushes = (1000..2000).contains(&tick);
        cell.wall.hand = if pushes { hand } else { DVec3::ZERO };
        cell.tick(Spoiled::Nothing);
        if pushes {
            places.push(cell.tip());
        }
        if (1500..2000).contains(&tick) {
            fastest = f64::max(fastest, largest(cell.at.qd));
        }
        if tick == 3000 {
            left = largest(cell.at.qd);
        }
    }
    Pushed {
        went: places[0].distance(places[places.len() - 1]),
        fastest,
        left,
        cell,
    }
}

#[test]
fn a_floating_arm_stays_where_a_hand_leaves_it() {
    for off in OFF {
        let Pushed {
            mut cell,
            went,
            left,
            ..
        } = pushed(FLOAT, off, 0.6);
        println!("{off:?}: {went} m, {left} rad/s");
        assert!(went > 0.2, "{went}");
        assert!(left < 0.02, "{left}");
        assert_eq!(cell.reaction.phase(), ContactPhase::Held);
        let place = cell.tip();
        for _ in 0..2000 {
            cell.tick(Spoiled::Nothing);
        }
        assert!(cell.tip().distance(place) < 1e-3);
        // The hand comes back.
        cell.wall.hand = DVec3::new(0.0, -20.0, 40.0);
        for _ in 0..200 {
            cell.tick(Spoiled::Nothing);
        }
        let soon = cell.tip().distance(place);
        println!("again: {soon} m");
        assert_eq!(cell.reaction.phase(), ContactPhase::Floating);
        assert!(soon > 0.01, "{soon}");
    }
    // One with twenty times the damping is not moved as far, and one whose friction is compensated
    // in excess does not come to rest.
    let stiff = ContactResponse::Float {
        damping: 100.0,
        speed: 0.5,
    };
    let damped = pushed(stiff, OFF[0], 0.6);
    let driven = pushed(FLOAT, OFF[1], 1.3);
    println!("damped: {} m, driven: {} rad/s", damped.went, driven.left);
    assert!(damped.went < 0.2, "{}", damped.went);
    assert!(driven.left > 0.2, "{}", driven.left);
}

#[test]
fn an_arm_that_floats_is_damped_more_beyond_its_speed() {
    let of = |speed| {
        let damping = 5.0;
        pushed(ContactResponse::Float { damping, speed }, OFF[1], 0.6).fastest
    };
    let (slow, free) = (of(0.2), of(10.0));
    println!("beyond 0.2 rad/s: {slow} rad/s, without: {free} rad/s");
    assert!(slow < 0.8 && free > 2.0 * slow, "{slow} {free}");
}

// After the push it returns to its motion.
#[test]
fn a_pushed_arm_is_not_reset() {
    let mut cell = pushed(FLOAT, OFF[2], 0.6).cell;
    cell.wall.hand = DVec3::new(0.0, 0.0, 40.0);
    for _ in 0..100 {
        cell.tick(Spoiled::Nothing);
    }
    let motion = cell.motion;
    let refused = cell.reaction.reset(&mut cell.controller, &motion);
    assert!(refused.is_err(), "{refused:?}");
    assert!(!cell.recovers(Spoiled::Nothing));
    cell.wall.hand = DVec3::ZERO;
    for _ in 0..2000 {
        cell.tick(Spoiled::Nothing);
    }
    let far = cell.reaction.reset(&mut cell.controller, &motion);
    assert!(matches!(far, Err(ResetError::TooFar { .. })), "{far:?}");
    assert!(cell.recovers(Spoiled::Nothing));
}
