use super::*;
use crate::tests::Random;

fn limits<R: Real>(random: &mut Random, low: f64, high: f64) -> JerkLimits<R> {
    let mut draw = || R::from_f64(random.log(low, high));
    JerkLimits { velocity: draw(), acceleration: draw(), jerk: draw() }
}

/// Limits, positions and ticks of any size: what is not refused is finite, and ends at the goal.
fn is_finite_at_any_size<R: Real>(seed: u64) -> (u32, u32) {
    let mut random = Random(seed);
    let (mut refused, mut reached) = (0, 0);
    for _ in 0..20_000 {
        let tick = R::from_f64(random.log(1e-5, 1.0));
        let all = [(); 2].map(|()| limits(&mut random, 1e-9, 1e9));
        let mut size = || R::from_f64(random.log(1e-12, 1e12) * (random.next() - 0.5));
        let q = [size(), size()];
        let goals = [[size(), size()], [q[0], size()]];
        let mut goal = MovingGoal::try_new(&q, all, tick).unwrap();
        for to in goals {
            let from = (f64::from(goal.ticks()) * random.next() * 1.2) as u32;
            let Ok(arrival) = goal.set(from, &to) else {
                refused += 1;
                continue;
            };
            reached += 1;
            for share in [0.0, 0.1, 0.5, 0.9, 1.0] {
                let ticks = f64::from(arrival - from) * share;
                assert!(goal.at(from + ticks as u32).is_finite(), "{goal:?}");
            }
            assert_eq!(goal.at(arrival), State::at(to));
        }
    }
    (refused, reached)
}

#[test]
fn a_motion_of_any_size_is_finite_or_refused() {
    for (refused, reached) in [is_finite_at_any_size::<f32>(1), is_finite_at_any_size::<f64>(2)] {
        assert!(refused > 1000 && reached > 1000, "{refused} {reached}");
    }
}

const LIMITS: JerkLimits<f64> = JerkLimits { velocity: 1.0, acceleration: 2.0, jerk: 10.0 };

#[test]
fn a_refused_goal_changes_nothing() {
    let mut goal = MovingGoal::try_new(&[0.0, 1.0], [LIMITS; 2], 1e-3).unwrap();
    goal.set(0, &[1.0, 0.0]).unwrap();
    let before = goal;
    assert_eq!(goal.set(300, &[f64::NAN, 0.0]), Err(GoalError::NotFinite { joint: 0 }));
    assert_eq!(goal.set(300, &[0.0, f64::INFINITY]), Err(GoalError::NotFinite { joint: 1 }));
    assert_eq!(goal.set(300, &[0.0, 1e7]), Err(GoalError::TooLong));
    assert_eq!(goal.set(u32::MAX, &[0.0, 0.0]), Err(GoalError::TooLong));
    let fast = State { qd: [0.0, -0.9], qdd: [0.0, -2.1], ..State::at([0.0; 2]) };
    assert_eq!(goal.set_from(300, &fast, &[0.0, 0.0]), Err(GoalError::Start { joint: 1 }));
    let unknown = State { qd: [f64::NAN, 0.0], ..State::at([0.0; 2]) };
    assert!(goal.set_from(300, &unknown, &[0.0, 0.0]).is_err());
    assert_eq!(goal, before);
    // A speed brakes, also one above its limit.
    let slower = State { qd: [0.0, -3.0], qdd: [0.0, 1.9], ..fast };
    assert!(goal.set_from(300, &slower, &[0.0, 0.0]).is_ok());
    assert_eq!(goal.at(300), slower);
    goal.set_limits([JerkLimits { acceleration: 1e-3, ..LIMITS }; 2]).unwrap();
    assert_eq!(goal.set(310, &[0.5; 2]), Err(GoalError::Start { joint: 1 }));
}

#[test]
fn limits_that_are_none_are_refused() {
    for limits in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e10, 1e-10].map(|x| {
        [
            JerkLimits { velocity: x, ..LIMITS },
            JerkLimits { acceleration: x, ..LIMITS },
            JerkLimits { jerk: x, ..LIMITS },
        ]
    }) {
        for limits in limits {
            let parameter = ConfigParameter::JerkLimit { joint: 0 };
            let error = MovingGoal::try_new(&[0.0], [limits], 1e-3).unwrap_err();
            assert_eq!(error, ConfigError::OutOfRange { parameter });
            let mut goal = MovingGoal::try_new(&[0.0], [LIMITS], 1e-3).unwrap();
            assert_eq!(goal.set_limits([limits]), Err(error));
        }
    }
    assert!(MovingGoal::try_new(&[f64::NAN], [LIMITS], 1e-3).is_err());
    assert!(MovingGoal::try_new(&[0.0], [LIMITS], 0.0).is_err());
}

/// From rest the durations have closed forms: with and without a time at the greatest acceleration
/// and velocity.
#[test]
fn rest_to_rest_takes_the_time_of_the_closed_forms() {
    let [v, a, j]: [f64; 3] = [1.0, 2.0, 10.0];
    let cruising = |d: f64| d / v + v / a + a / j;
    let accelerating = |d: f64| a / j + (a * a / (j * j) + 4.0 * d / a).sqrt();
    let jerking = |d: f64| (32.0 * d / j).cbrt();
    // A limit of velocity that is far away makes no motion slower.
    for d in [1e-6, 1e-3] {
        let limits = JerkLimits { velocity: 1000.0, ..LIMITS };
        let mut goal = MovingGoal::try_new(&[0.2], [limits], 1e-3).unwrap();
        goal.set(0, &[0.2 - d]).unwrap();
        let ratio = goal.seconds() / jerking(d);
        assert!((1.0..1.05).contains(&ratio), "{d}: {ratio}");
    }
    for (d, expected) in [(3.0, cruising(3.0)), (0.3, accelerating(0.3)), (0.05, jerking(0.05))] {
        let mut goal = MovingGoal::try_new(&[0.2], [LIMITS], 1e-3).unwrap();
        goal.set(0, &[0.2 - d]).unwrap();
        let ratio = goal.seconds() / expected;
        assert!((1.0..1.01).contains(&ratio), "{d}: {ratio}");
    }
}

/// A goal that is set again in every tick: the same one, and one that trembles.
fn is_reached_when_set_again<R: Real>(limit: f64, trembles: &[f64]) {
    let number = |x: f64| R::from_f64(x);
    let limits = JerkLimits { velocity: R::ONE, acceleration: number(2.0), jerk: number(10.0) };
    for &tremble in trembles {
        let mut goal = MovingGoal::try_new(&[R::ZERO, R::ONE], [limits; 2], number(1e-3)).unwrap();
        let to = |tick: u32| [1.0, 0.3].map(|q| number(q + tremble * f64::from(tick % 2)));
        // 3 N·m for 2 kg·m² lower the accelerations.
        let [limit, load] = [number(limit), number(2.0)];
        let set = |goal: &mut MovingGoal<R, 2>, tick| {
            let torques = |state: &State<R, 2, 2>| state.qdd.map(|a| load * a);
            goal.set_within(tick, &to(tick), &[limit; 2], torques).unwrap()
        };
        let arrival = set(&mut goal, 0);
        for tick in 1..2 * arrival {
            set(&mut goal, tick);
            let away = (goal.at(tick).q[0].to_f64() - 1.0).abs();
            assert!(tick < arrival || away <= 3.0 * tremble, "{tremble} {tick} {away}");
        }
        assert!(tremble > 0.0 || goal.at(arrival) == State::at(to(0)), "{goal:?}");
    }
}

// As of a cable that hangs at one place: near the limit all parts of an interval are sampled.
#[test]
fn a_torque_beyond_its_limit_between_two_samples_is_found() {
    for place in 0..20 {
        let place = 0.3 + 0.02 * f64::from(place);
        let torques = |state: &State<f64, 1, 1>| {
            let x = (state.q[0] - place) / 0.01;
            [7.0 + 4.0 * (-0.5 * x * x).exp()]
        };
        let mut goal = MovingGoal::try_new(&[0.0], [LIMITS], 1e-3).unwrap();
        let refused = goal.set_within(0, &[1.0], &[10.0], torques);
        assert_eq!(refused, Err(GoalError::Torque { joint: 0 }), "{place}");
    }
}

#[test]
fn a_goal_that_is_set_in_every_tick_is_reached() {
    for limit in [3.0, f64::INFINITY] {
        is_reached_when_set_again::<f64>(limit, &[0.0, 1e-4, 1e-8]);
        is_reached_when_set_again::<f32>(limit, &[0.0, 1e-4]);
    }
}

#[test]
fn a_change_that_misses_its_tick_or_its_motion_changes_nothing() {
    let mut goal = MovingGoal::try_new(&[0.0, 1.0], [LIMITS; 2], 1e-3).unwrap();
    goal.set(0, &[1.0, 0.0]).unwrap();
    let free = [f64::INFINITY; 2];
    let error = goal.begin_within(302, &[f64::NAN, 0.0], &free).unwrap_err();
    assert_eq!(error, GoalError::NotFinite { joint: 0 });
    let begun_and = |steps: u32, tick: u32, other: Option<u32>| {
        let mut goal = goal;
        let mut change = goal.begin_within(302, &[0.5, 0.5], &free).unwrap();
        for _ in 0..steps {
            change.step(|_| unreachable!()).unwrap();
        }
        other.map(|tick| goal.set(tick, &[0.2, 0.3]).unwrap());
        let before = goal;
        let last = goal.take(tick, &change);
        assert!(matches!(last, Ok(Some(_))) || goal == before);
        last
    };
    assert_eq!(begun_and(3, 301, None), Ok(None));
    assert!(matches!(begun_and(3, 302, None), Ok(Some(303..))));
    for (steps, tick, other) in [(2, 302, None), (3, 303, None), (3, 302, Some(299))] {
        assert_eq!(begun_and(steps, tick, other), Err(GoalError::Missed));
    }
    let (mut slow, mut change) = (goal, goal.begin_within(302, &[0.5, 0.5], &free).unwrap());
    while change.step(|_| unreachable!()) == Ok(false) {}
    slow.set_limits([JerkLimits { velocity: 0.9, ..LIMITS }; 2]).unwrap();
    assert_eq!(slow.take(302, &change), Err(GoalError::Missed));
}

/// Limits of velocity that are lowered on the way to other goals, near and far, in every second
/// case within limits of torque: the number of joints that brake. The samples keep the limits.
fn braked<const V: usize>(random: &mut Random) -> u32 {
    let (h, mut braked) = (1e-3, 0);
    for case in 0..2000 {
        let fast = [(); V].map(|()| limits::<f32>(random, 0.5, 50.0));
        let mut goal = MovingGoal::try_new(&[0.0; V], fast, h).unwrap();
        let last = goal.set(0, &fast.map(|limits| limits.velocity)).unwrap();
        let start = (f64::from(last) * random.next()) as u32;
        let (from, is_far, share) = (goal.at(start), case % 4 == 0, [f32::INFINITY, 0.6][case % 2]);
        let (mut slow, mut goals, mut most) = (fast, from.q, [0.0; V]);
        for (j, JerkLimits { velocity, acceleration, jerk }) in fast.into_iter().enumerate() {
            let (v, reach) = (from.qd[j], if is_far { 50.0 } else { 1.5 * random.next() - 0.3 });
            slow[j].velocity = v.abs().max(0.05 * velocity) * (1.0 - random.log(1e-6, 0.95) as f32);
            goals[j] += v * (v.abs() / acceleration + acceleration / jerk) * reach as f32;
            most[j] = f32::max(share * acceleration, 1.05 * from.qdd[j].abs());
        }
        goal.set_limits(slow).unwrap();
        let arrival = goal.set_within(start, &goals, &most, |state| state.qdd).unwrap();
        assert_eq!(goal.at(arrival), State::at(goals));
        for (j, JerkLimits { velocity, acceleration, jerk }) in slow.into_iter().enumerate() {
            let [v, a] = [from.qd[j].abs(), from.qdd[j] * from.qd[j].signum()];
            let level = v + 0.5 * a * a.abs() / jerk;
            let (top, least) = (v.max(level).max(velocity), level.min(v).min(velocity));
            let time = a.max(0.0) / jerk + (top - velocity) / acceleration + acceleration / jerk;
            braked += u32::from(v > velocity);
            for k in 0..100 {
                let tick = start + (f64::from(arrival - start) * f64::from(k * k) / 1e4) as u32;
                let [now, next] = [tick, tick + 1].map(|tick| goal.at(tick));
                let is_over = (tick - start) as f32 * h > time * [1.0, 3.0][case % 2] + h;
                let speed = now.qd[j].abs();
                assert!(speed <= if is_over { velocity } else { 1.0001 * top });
                assert!(now.qdd[j].abs() <= acceleration.min(1.02 * most[j]), "{case} {goal:?}");
                let rounding = 2.0 * f32::EPSILON * (acceleration + goal.seconds() * jerk);
                assert!((next.qdd[j] - now.qdd[j]).abs() <= jerk * h + rounding, "{case} {goal:?}");
                // A joint on its own goes on at the new limit.
                assert!(!is_far || V > 1 || k > 50 || speed >= least - 1e-4 * v, "{goal:?}");
            }
        }
    }
    braked
}

#[test]
fn a_limit_of_velocity_that_is_lowered_on_the_way_is_met_by_braking() {
    let mut random = Random(7);
    assert!(braked::<1>(&mut random) > 1000 && braked::<3>(&mut random) > 3000);
}
