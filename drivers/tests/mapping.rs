//! The promises of the mapping between shaft and joint.

use joint_drivers::{Direction, JointMapping, MappingError, Resolution};

const DIRECTIONS: [Direction; 2] = [Direction::Forward, Direction::Reverse];

#[test]
fn the_joint_is_zero_at_the_shafts_zero() {
    for (direction, sign) in DIRECTIONS.into_iter().zip([1.0, -1.0]) {
        let mapping = JointMapping::new(1.25, direction, 8.0).unwrap();
        assert_eq!(mapping.position(1.25), Ok(0.0));
        assert_eq!(mapping.direction(), direction);
        assert_eq!(mapping.position(9.25), Ok(sign));
        assert_eq!(mapping.velocity(8.0), Ok(sign));
    }
}

#[test]
fn conversions_to_the_shaft_invert_those_to_the_joint() {
    for direction in DIRECTIONS {
        for ratio in [0.01, 0.5, 1.0, 7.75, 121.0] {
            let mapping = JointMapping::new(-0.4, direction, ratio).unwrap();
            for quantity in [-3.0_f32, -0.1, 0.0, 0.7, 2.0] {
                let shaft = mapping.shaft_position(quantity).unwrap();
                assert!((mapping.position(shaft).unwrap() - quantity).abs() < 1e-4);
                let shaft = mapping.shaft_torque(quantity).unwrap();
                assert!((mapping.torque(shaft).unwrap() - quantity).abs() < 1e-6);
            }
        }
    }
}

#[test]
fn a_gear_keeps_the_power() {
    let mapping = JointMapping::new(0.3, Direction::Reverse, 50.0).unwrap();
    let (torque, velocity) = (0.25_f32, 40.0);
    let power = mapping.torque(torque).unwrap() * mapping.velocity(velocity).unwrap();
    assert!((power - torque * velocity).abs() < 1e-5);
}

#[test]
fn invalid_zeros_and_ratios_are_refused() {
    let new = |zero, ratio| JointMapping::new(zero, Direction::Forward, ratio);
    for zero in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1.1e6] {
        assert_eq!(new(zero, 1.0), Err(MappingError::Zero));
    }
    for ratio in [f32::NAN, f32::INFINITY, 0.0, -1.0, f32::MIN_POSITIVE, 1.1e6] {
        assert_eq!(new(0.0, ratio), Err(MappingError::Ratio));
    }
}

#[test]
fn no_conversion_returns_a_nonfinite_value() {
    let mapping = JointMapping::new(1.0, Direction::Forward, 1e-6).unwrap();
    for input in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX] {
        assert_eq!(mapping.position(input), Err(MappingError::NotFinite));
        assert_eq!(mapping.velocity(input), Err(MappingError::NotFinite));
        assert_eq!(mapping.shaft_torque(input), Err(MappingError::NotFinite));
    }
    let mapping = JointMapping::new(1.0, Direction::Forward, 1e6).unwrap();
    assert_eq!(mapping.torque(f32::MAX), Err(MappingError::NotFinite));
    let far = mapping.shaft_position(f32::MAX);
    assert_eq!(far, Err(MappingError::NotFinite));
}

#[test]
fn resolutions_map_full_turns_and_invalid_ones_are_refused() {
    for counts in [1, 3, 1000, 4096, 1 << 24] {
        let angle = Resolution::new(counts).unwrap().angle(counts as i32);
        let off = angle - core::f32::consts::TAU;
        assert!(off.abs() < 1e-6, "{counts}: {angle}");
    }
    assert_eq!(Resolution::new(0), Err(MappingError::Counts));
    assert_eq!(Resolution::new((1 << 24) + 1), Err(MappingError::Counts));
    assert_eq!(Resolution::from_bits(25), Err(MappingError::Counts));
    assert_eq!(Resolution::from_bits(u32::MAX), Err(MappingError::Counts));
}
