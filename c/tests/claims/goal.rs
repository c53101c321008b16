//! Goals that move as C calls them.

use super::controller::{config, ends, moving, report, there_and_back, tick};
use super::{Memory, numbers};
use crate::library::{self as c, *};
use crate::scene::N;
use dynamics_c::field;
use dynamics_c::status::*;

pub fn limited() -> Config {
    Config { speed: [2.0; N], acceleration: [20.0; N], ..config() }
}

pub fn goal(config: &Config, jerk: f32) -> Goal {
    let mut goal = numbers();
    assert_eq!(c::goal_init(Some(&mut goal), Some(config), Some(&[jerk; N]), None), OK);
    goal
}

#[test]
fn a_moving_arm_takes_a_goal_at_any_tick_and_arrives() {
    let (mut memory, config) = (Memory::new(), limited());
    let (mut motion, [home, away]) = (goal(&config, 200.0), ends(&config));
    moving(&mut memory, &config, 1000);
    let handle = memory.handle();
    let mut q = home;
    for _ in 0..500 {
        assert_eq!(tick(&mut memory, &q).fault, 0);
        q = report(handle).reference.q;
    }
    let (mut at, mut ticks, mut last) = (Where::NOWHERE, 0, report(handle).reference);
    assert!(last.qd.iter().any(|qd| qd.abs() > 0.1), "{last:?}");
    assert_eq!(
        c::controller_move(handle, Some(&there_and_back(&config, 500)), Some(&mut at)),
        STATE
    );
    // The goal moves while the arm moves to it, and a lower limit of speed is met by braking.
    for (target, most, speed) in [(away, 200, 2.0), (home, 70, 2.0), (away, u32::MAX, 0.5)] {
        let slow = Config { speed: [speed; N], ..config };
        assert_eq!(c::goal_limits(Some(&mut motion), Some(&slow), Some(&[200.0; N]), None), OK);
        assert!(speed > 1.0 || last.qd.iter().any(|qd| qd.abs() > speed), "{last:?}");
        let found = c::controller_goal(
            handle,
            Some(&mut motion),
            Some(&target),
            Some(&mut ticks),
            Some(&mut at),
        );
        assert_eq!(found, OK);
        for k in 0..ticks.min(most) {
            let mut next = State::at([7.0; N]);
            assert_eq!(c::goal_state(Some(&motion), k, Some(&mut next)), OK);
            for joint in 0..N {
                assert!(
                    k > 0 || next.q[joint] == last.q[joint] && next.qd[joint] == last.qd[joint],
                    "{next:?} {last:?}"
                );
                let most = if k < 200 { 2.0 } else { speed };
                assert!(next.qd[joint].abs() <= most && next.qdd[joint].abs() <= 20.0, "{next:?}");
                assert!((next.qdd[joint] - last.qdd[joint]).abs() <= 0.201, "{next:?} {last:?}");
            }
            assert_eq!(c::goal_state(Some(&motion), k + 1, Some(&mut next)), OK);
            assert_eq!(c::controller_follow(handle, Some(&next), Some(&mut at)), OK, "{at:?}");
            assert_eq!(tick(&mut memory, &q).fault, 0);
            (last, q) = (report(handle).reference, report(handle).reference.q);
        }
    }
    assert_eq!((last.q, last.qd), (away, [0.0; N]));
    // The search for another goal is spread over ticks; the new motion starts in its tick.
    let mut change = numbers();
    let mut next = State::at([7.0; N]);
    for torque in [None, Some([1e9; N])] {
        let (start, steps) = (ticks + 40, if torque.is_some() { 3 * N + 1 } else { 1 });
        let begin = c::controller_goal_begin(
            handle,
            Some(&motion),
            Some(&mut change),
            start,
            Some(&home),
            torque.as_ref(),
            Some(&mut at),
        );
        assert_eq!(begin, OK);
        let (mut moved, mut arrival) = (motion, 0);
        for tick in (ticks..=start).flat_map(|tick| core::iter::repeat_n(tick, steps)) {
            let found = c::controller_goal_advance(
                handle,
                Some(&mut moved),
                Some(&mut change),
                tick,
                Some(&mut arrival),
                Some(&mut at),
            );
            assert_eq!((found, arrival > 0), (OK, tick == start), "{at:?}");
        }
        for (tick, q) in [(start, away), (arrival, home)] {
            assert_eq!(c::goal_state(Some(&moved), tick, Some(&mut next)), OK);
            assert_eq!((next.q, next.qd), (q, [0.0; N]));
        }
        let late = c::controller_goal_advance(
            handle,
            Some(&mut moved),
            Some(&mut change),
            start + 1,
            None,
            Some(&mut at),
        );
        assert_eq!(late, LATE);
    }
    let weak = c::controller_goal_begin(
        handle,
        Some(&motion),
        Some(&mut change),
        9,
        Some(&home),
        Some(&[0.0; N]),
        Some(&mut at),
    );
    assert_eq!((weak, at.field, at.joint), (TORQUE_LIMIT, field::TORQUE, 0));
}

#[test]
fn wrong_goals_are_named_and_a_stopped_arm_starts_where_it_is() {
    let (mut memory, config) = (Memory::new(), limited());
    moving(&mut memory, &config, 300);
    let (mut slow, mut at) = (goal(&Config { speed: [1e-3; N], ..config }, 200.0), Where::NOWHERE);
    for _ in 0..300 {
        let q = report(memory.handle()).reference.q;
        tick(&mut memory, &q);
    }
    let (handle, home) = (memory.handle(), ends(&config)[0]);
    let mut refused = |goal: &mut Goal, q: [f32; N]| {
        let found = c::controller_goal(handle, Some(goal), Some(&q), None, Some(&mut at));
        (found, at.field)
    };
    let mut wrong = home;
    wrong[N - 1] = f32::NAN;
    assert_eq!(refused(&mut slow, wrong), (NOT_FINITE, field::POSITION));
    assert_eq!(refused(&mut slow, home), (OK, field::NONE));
    let hard = Config { acceleration: [1e-3; N], ..config };
    assert_eq!(refused(&mut goal(&hard, 200.0), home), (TOO_FAST, field::ACCELERATION));
    assert_eq!(refused(&mut numbers(), home).0, MEMORY);
    assert_eq!(c::controller_off(handle), OK);
    tick(&mut memory, &home);
    tick(&mut memory, &home);
    assert_eq!(refused(&mut slow, home), (OK, field::NONE));
    let mut state = State::at([7.0; N]);
    assert_eq!(c::goal_state(Some(&slow), 0, Some(&mut state)), OK);
    assert_eq!((state.q, state.qd), (report(handle).q, [0.0; N]));
    for (config, jerk, field) in
        [(config, f32::NAN, field::JERK), (Config { tick: 0.0, ..config }, 1.0, field::TICK)]
    {
        let init = if jerk.is_nan() { c::goal_limits } else { c::goal_init };
        let found = init(Some(&mut slow), Some(&config), Some(&[jerk; N]), Some(&mut at));
        assert_eq!(
            (found, at.field, at.joint),
            (CONFIG, field, if field == field::JERK { 0 } else { -1 })
        );
    }
}
