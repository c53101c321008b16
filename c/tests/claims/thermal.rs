//! The thermal limits as C calls them.

use super::controller::{config, ends, moving, tick};
use super::{Memory, numbers};
use crate::library::{self as c, *};
use crate::scene::N;
use dynamics_c::field;
use dynamics_c::status::*;

pub const MOTORS: Motors = Motors {
    tick: 1e-3,
    ambient: 25.0,
    hottest: [125.0; N],
    continuous: [2.0; N],
    peak: [6.0; N],
    winding_time: [10.0; N],
    housing_time: [300.0; N],
    share: [0.4; N],
};

/// Limits of motors with these temperatures, or as hot as they may be.
pub fn limits(saved: Option<[f32; 2]>) -> Thermal {
    let saved = saved
        .map(|[winding, housing]| Temperatures { winding: [winding; N], housing: [housing; N] });
    let mut thermal = numbers();
    let found = c::thermal_init(Some(&mut thermal), Some(&MOTORS), None, saved.as_ref(), 0.0, None);
    assert_eq!(found, OK);
    thermal
}

fn heat(thermal: &Thermal) -> Heat {
    let mut heat = numbers();
    assert_eq!(c::thermal_report(Some(thermal), Some(&mut heat)), OK);
    heat
}

#[test]
fn a_torque_is_held_as_long_as_was_said_and_temperatures_are_kept() {
    let mut thermal = limits(Some([0.0; 2]));
    let [for_ever, never, said] = [1.9, 6.1, -4.0].map(|torque| {
        let mut seconds = 7.0;
        let found = c::thermal_holds_for(Some(&thermal), N as i32 - 1, torque, Some(&mut seconds));
        assert_eq!(found, OK);
        seconds
    });
    let (mut limit, mut held) = ([6.0; N], 0.0);
    while limit[N - 1] >= 4.0 {
        held += 1e-3;
        assert_eq!(c::thermal_update(Some(&mut thermal), Some(&[-4.0; N]), Some(&mut limit)), OK);
    }
    assert!(
        said <= held && held - said < 0.1 && (for_ever, never) == (f32::MAX, 0.0),
        "{said} {held}"
    );
    // From the equations of both masses, w is 11/12, at which the limit is 4 N·m, after 8.431 s.
    assert!((8.3..8.432).contains(&said), "{said}");
    // Saved, what a block of ticks has heated counts at once; without it the worst counts.
    let (before, worst) = (heat(&thermal), heat(&limits(None)));
    let again = heat(&limits(Some([before.saved.winding[0], before.saved.housing[0]])));
    assert!((0.0..1.0).contains(&(again.celsius[0] - before.celsius[0])), "{again:?} {before:?}");
    assert!(worst.celsius == [125.0; N] && worst.torque[0] < 2.0 && worst.torque[0] > 1.98);
    assert_eq!(heat(&limits(Some([f32::NAN, -1.0]))), worst);
    // A torque that is not a number heats more than any other, and a drive's measurement counts.
    let found = c::thermal_update(Some(&mut thermal), Some(&[f32::NAN; N]), Some(&mut limit));
    assert!(found == NOT_FINITE && heat(&thermal).saved.winding[0] > before.saved.winding[0] + 0.1);
    let mut measured = |joint, celsius| c::thermal_measured(Some(&mut thermal), joint, celsius);
    assert_eq!([measured(N as i32, 1.0), measured(0, f32::NAN)], [NO_FAULT, NOT_FINITE]);
    (0..1000).for_each(|_| assert_eq!(measured(0, 150.0), OK));
    assert_eq!((heat(&thermal).state, heat(&thermal).joint), (2, 0));
}

#[test]
fn a_wrong_motor_is_named_and_the_gate_of_a_controller_has_the_limits() {
    let (mut memory, mut thermal) = (Memory::new(), limits(None));
    // A feedback that asks for all that there is.
    let mut config = Config { torque: [6.0; N], rate: [1e3; N], kp: [1e6; N], ..config() };
    let (mut most, home, limit) = (0.0_f32, ends(&config)[0], heat(&thermal).torque[0]);
    moving(&mut memory, &config, 1000);
    for _ in 0..300 {
        assert_eq!(c::controller_limit(memory.handle(), Some(&thermal)), OK);
        most = tick(&mut memory, &home)
            .torque
            .iter()
            .fold(most, |most, torque| most.max(torque.abs()));
    }
    assert!(most <= limit && most > 0.99 * limit, "{most} {limit}");

    config.torque[N - 1] = 5.9;
    let mut refused = |config: Option<&Config>, set: fn(&mut Motors)| {
        let (mut wrong, mut at) = (MOTORS, Where::NOWHERE);
        set(&mut wrong);
        let found =
            c::thermal_init(Some(&mut thermal), Some(&wrong), config, None, 0.0, Some(&mut at));
        (found, at.field, at.joint)
    };
    let named = |field| (CONFIG, field, N as i32 - 1);
    assert_eq!(refused(Some(&config), |_| ()), named(field::THERMAL_TORQUE));
    assert_eq!(
        refused(None, |motors| motors.continuous[N - 1] = f32::NAN),
        named(field::THERMAL_TORQUE)
    );
    assert_eq!(
        refused(None, |motors| motors.winding_time[N - 1] = -1.0),
        named(field::THERMAL_MOTOR)
    );
    assert_eq!(refused(None, |motors| motors.tick = 0.0), (CONFIG, field::TICK, -1));
    assert_eq!(c::controller_limit(memory.handle(), Some(&numbers())), MEMORY);
}
