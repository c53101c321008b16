//! Numbers that are no configuration.

use super::*;

#[test]
fn numbers_that_are_no_configuration_are_refused_by_name() {
    use crate::limits::ConfigParameter::*;
    let refused = |config: HandGuidingConfig<f64, 1>| match HandGuiding::try_new(config) {
        Err(ConfigError::OutOfRange { parameter }) => Some(parameter),
        _ => None,
    };
    assert_eq!(refused(config()), None);
    let good = config();
    for x in [-0.1, f64::NAN, f64::INFINITY] {
        let rest = HandGuidingConfig {
            rest_speed: [x],
            ..good
        };
        assert_eq!(refused(rest), Some(RestSpeed));
        assert_eq!(
            refused(HandGuidingConfig { error: x, ..good }),
            Some(FrictionError)
        );
        assert_eq!(
            refused(HandGuidingConfig { share: x, ..good }),
            Some(CompensatedShare)
        );
        assert_eq!(
            refused(HandGuidingConfig {
                compensation: [x],
                ..good
            }),
            Some(Compensation)
        );
        let spring = |which| {
            let (mut spring, x) = (good.wall, [x]);
            match which {
                0 => spring.stiffness = x,
                1 => spring.damping = x,
                _ => spring.torque = x,
            }
            spring
        };
        for which in 0..3 {
            let spring = spring(which);
            assert_eq!(
                refused(HandGuidingConfig {
                    wall: spring,
                    ..good
                }),
                Some(Wall)
            );
            assert_eq!(
                refused(HandGuidingConfig {
                    lock: spring,
                    ..good
                }),
                Some(Lock)
            );
        }
    }
    assert_eq!(
        refused(HandGuidingConfig {
            share: 0.92,
            ..good
        }),
        Some(CompensatedShare)
    );
    for lower in [1.0, 2.0, f64::NAN] {
        assert_eq!(
            refused(HandGuidingConfig {
                lower: [lower],
                ..good
            }),
            Some(WallPosition)
        );
    }
    let shares = |error: f32| HandGuidingConfig {
        error,
        share: 1.0 / (1.0 + error),
        ..single()
    };
    assert!((0..1000).all(|k| shares(1e-3 * k as f32).check().is_ok()));
    assert!(
        ConfigError::OutOfRange { parameter: Wall }
            .to_string()
            .contains("virtual wall")
    );
}

fn single() -> HandGuidingConfig<f32, 1> {
    let spring = LimitedSpring {
        stiffness: [0.0],
        damping: [0.0],
        torque: [0.0],
    };
    HandGuidingConfig {
        error: 0.0,
        share: 0.0,
        rest_speed: [1.0],
        compensation: [0.0],
        lower: [-1.0],
        upper: [1.0],
        wall: spring,
        lock: spring,
    }
}
