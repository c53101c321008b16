//! The compensation and the configuration of several joints, in numbers.

use super::*;

/// Joints of which each number is another one.
fn two() -> HandGuidingConfig<f64, 2> {
    let spring = spring([100.0, 300.0], [10.0, 30.0], [5.0, 15.0]);
    HandGuidingConfig {
        error: 0.25,
        share: 0.75,
        rest_speed: [0.01, 0.02],
        compensation: [4.0, 8.0],
        damping: [0.0; 2],
        brake: no_brake(),
        lower: [-1.0, -2.0],
        upper: [1.5, 2.5],
        wall: spring,
        lock: spring,
    }
}

#[test]
fn compensation_is_a_share_less_the_error_of_either_sign() {
    let guiding = HandGuiding::try_new(two()).expect("a good one");
    let torque = |qd: [f64; 2], friction: [f64; 2], errors: [f64; 2]| {
        let estimate = Estimate { q: [0.0; 2], qd };
        guiding.torque(&estimate, &friction, &errors)
    };
    let fast = [0.5, -0.5];
    for errors in [[0.5, 1.5], [-0.5, -1.5], [0.5, -1.5]] {
        // 0.75 · 4 − 0.5 and 0.75 · 8 − 1.5, in the direction of the motion.
        assert_eq!(torque(fast, [4.0, -8.0], errors), [2.5, -4.5]);
        // An error that exceeds the share leaves nothing.
        assert_eq!(torque(fast, [0.5, -1.0], errors), [0.0; 2]);
        // Friction that drives is not compensated.
        assert_eq!(torque(fast, [-4.0, 8.0], errors), [0.0; 2]);
        // Its limit.
        assert_eq!(torque(fast, [40.0, -80.0], errors), [4.0, -8.0]);
    }
    let none = [0.0; 2];
    // Nothing up to the speed of rest, all of it from twice that speed on.
    for [speed, share] in [[0.5, 0.0], [1.0, 0.0], [1.25, 0.25], [1.75, 0.75], [2.0, 1.0]] {
        let qd = [0.01 * speed, -0.02 * speed];
        let tau = torque(qd, [4.0, -8.0], none);
        for (tau, full) in tau.into_iter().zip([3.0, -6.0]) {
            assert!((tau - share * full).abs() < 1e-12, "{speed}: {tau}");
        }
    }
}

#[test]
fn each_joint_has_its_own_walls_and_its_own_lock() {
    let mut guiding = HandGuiding::try_new(two()).expect("a good one");
    let none = [0.0; 2];
    let at = |guiding: &HandGuiding<f64, 2>, q: [f64; 2], qd: [f64; 2]| {
        guiding.torque(&Estimate { q, qd }, &none, &none)
    };
    let near = |got: [f64; 2], want: [f64; 2]| {
        let apart = [0, 1].map(|k| (got[k] - want[k]).abs());
        assert!(apart.iter().all(|x| *x < 1e-9), "{got:?}, not {want:?}");
    };
    // 0.02 rad in the wall, and 0.1 rad/s deeper.
    near(at(&guiding, [-1.02, 2.52], none), [2.0, -6.0]);
    near(at(&guiding, [1.52, -2.02], none), [-2.0, 6.0]);
    near(at(&guiding, [-1.02, 2.52], [-0.1, 0.1]), [3.0, -9.0]);
    near(at(&guiding, [1.52, -2.02], [0.1, -0.1]), [-3.0, 9.0]);
    near(at(&guiding, [-9.0, 9.0], none), [5.0, -15.0]);
    guiding.lock(&[false, true], &[0.0, 1.0]).expect("finite");
    near(at(&guiding, [0.5, 0.98], [0.0, 0.1]), [0.0, 3.0]);
    let refused = guiding.lock(&[true, true], &[f64::NAN, 7.0]);
    assert_eq!(refused, Err(Fault::NotFinite { joint: 0 }));
    guiding.lock(&[true, true], &[0.5, 7.0]).expect("finite");
    // The one that was locked stays where it was.
    near(at(&guiding, [0.48, 0.98], none), [2.0, 6.0]);
    assert_eq!(guiding.locked(), [true; 2]);
    // At a wall a locked joint has both. There is nothing to lock of the other one.
    guiding.lock(&[true, false], &[0.5, f64::NAN]).expect("finite");
    near(at(&guiding, [1.51, 0.0], none), [-5.0 - 1.0, 0.0]);
    // Other walls, at which it stays locked.
    let nearer = HandGuidingConfig { upper: [1.4, 2.5], ..two() };
    let same = [nearer, nearer].map(|config| guiding.set_config(config));
    assert_eq!(same, [Ok(true), Ok(false)]);
    near(at(&guiding, [1.51, 0.0], none), [-5.0 - 5.0, 0.0]);
    let before = guiding;
    assert!(guiding.set_config(HandGuidingConfig { share: 1.0, ..two() }).is_err());
    let mut circles = guiding.on_circles::<0b10>().expect("within a turn");
    let turns = HandGuidingConfig { upper: [1.5, 7.0], ..two() };
    assert!(circles.set_config(turns).is_err());
    assert_eq!((guiding, circles), (before, before.on_circles().expect("as before")));
}

#[test]
fn every_number_of_a_configuration_is_checked() {
    use crate::limits::ConfigParameter::*;
    let good = two();
    assert_eq!(good.check(), Ok(()));
    let refuse = |change: &dyn Fn(&mut HandGuidingConfig<f64, 2>), parameter| {
        let mut config = good;
        change(&mut config);
        let refused = ConfigError::OutOfRange { parameter };
        assert_eq!(config.check(), Err(refused));
        assert_eq!(HandGuiding::try_new(config).err(), Some(refused));
    };
    type Change = fn(&mut HandGuidingConfig<f64, 2>, usize, f64);
    let changes: [(Change, _); 13] = [
        (|c, _, x| c.error = x, FrictionError),
        (|c, _, x| c.share = x, CompensatedShare),
        (|c, k, x| c.rest_speed[k] = x, RestSpeed),
        (|c, k, x| c.compensation[k] = x, Compensation),
        (|c, k, x| c.damping[k] = x, FreeDamping),
        (|c, k, x| c.brake.damping[k] = x, GuidingSpeed),
        (|c, k, x| c.brake.torque[k] = x, GuidingSpeed),
        (|c, k, x| c.wall.stiffness[k] = x, Wall),
        (|c, k, x| c.wall.damping[k] = x, Wall),
        (|c, k, x| c.wall.torque[k] = x, Wall),
        (|c, k, x| c.lock.stiffness[k] = x, Lock),
        (|c, k, x| c.lock.damping[k] = x, Lock),
        (|c, k, x| c.lock.torque[k] = x, Lock),
    ];
    for joint in 0..2 {
        for (change, parameter) in changes {
            for bad in [-0.1, f64::NAN, f64::INFINITY] {
                refuse(&|c| change(c, joint, bad), parameter);
            }
        }
        refuse(&|c| c.rest_speed[joint] = 0.0, RestSpeed);
        refuse(&|c| c.wall.stiffness[joint] = 0.0, Wall);
        for bad in [-0.1, f64::NAN] {
            refuse(&|c| c.brake.speed[joint] = bad, GuidingSpeed);
        }
        for [lower, upper] in [[9.0, 2.5], [-1.0, -9.0], [1.0, 1.0], [f64::NAN, 1.0]] {
            let walls = |c: &mut HandGuidingConfig<f64, 2>| {
                (c.lower[joint], c.upper[joint]) = (lower, upper);
            };
            refuse(&walls, WallPosition);
        }
    }
    // The error leaves 1/1.25.
    refuse(&|c| c.share = 0.81, CompensatedShare);
}

#[test]
fn a_share_that_is_rounded_to_the_error_is_a_configuration() {
    let zero = spring([0.0], [0.0], [0.0]);
    for k in 0..1000 {
        let error = 1e-3 * k as f32;
        let config = HandGuidingConfig::<f32, 1> {
            error,
            share: 1.0 / (1.0 + error),
            rest_speed: [1.0],
            compensation: [0.0],
            damping: [0.0],
            brake: SpeedBrake { speed: [f32::INFINITY], damping: [0.0], torque: [0.0] },
            lower: [-1.0],
            upper: [1.0],
            wall: zero,
            lock: zero,
        };
        assert_eq!(config.check(), Ok(()), "{error}");
    }
}
