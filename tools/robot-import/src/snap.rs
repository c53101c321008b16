//! Roundings of right angles and of zero: numbers of a file that stand for exact ones.
//!
//! A description that an exporter wrote has `1.5708` for a right angle and `-8.97657e-09` for no
//! offset. Products with the exact value vanish from the engine's code; with the rounding they
//! stay.

use std::f64::consts::FRAC_PI_2;

use dynamics_core::glam::{DMat3, DVec3};

/// The largest angle by which a rounding differs from its exact value, rad.
const MOST_ANGLE: f64 = 2e-3;
/// An angle below which no mechanism is built, rad.
const NO_ANGLE: f64 = 1e-6;
/// A length below which no mechanism is built, m.
pub const NO_LENGTH: f64 = 1e-6;

/// The unit of a number's last printed digit: 0.0001 of `1.5708`; 0 of a number without fraction
/// and exponent.
pub fn resolution(text: &str) -> f64 {
    let (digits, exponent) = match text.split_once(['e', 'E']) {
        Some((digits, exponent)) => (digits, exponent.parse().unwrap_or(0)),
        None => (text, 0),
    };
    match digits.split_once('.') {
        Some((_, fraction)) => 10_f64.powi(exponent - fraction.len() as i32),
        None if exponent < 0 => 10_f64.powi(exponent),
        None => 0.0,
    }
}

/// The number of quarter turns that an angle is a rounding of, if it is one: within a unit of its
/// last digit, since some exporters cut digits off.
///
/// Zero has no digits that a file could have lost: 0.001 states a milliradian, and only the noise
/// of a computation is none.
pub fn quarter_turns(angle: f64, resolution: f64) -> Option<i32> {
    let turns = (angle / FRAC_PI_2).round();
    let apart = (angle - turns * FRAC_PI_2).abs();
    let most = match turns == 0.0 {
        true => NO_ANGLE,
        false => resolution.clamp(NO_ANGLE, MOST_ANGLE),
    };
    (apart <= most && turns.abs() <= 4.0).then_some(turns as i32)
}

/// Whether one of a direction's or a unit quaternion's entries is small, but not zero, so that the
/// file states it.
///
/// The entries of right angles are 0, ±½, ±√½ and ±1.
pub fn states_a_small_entry(entries: &[f64]) -> bool {
    entries.iter().any(|x| (NO_ANGLE..0.25).contains(&x.abs()))
}

/// The words for a number of quarter turns.
pub fn words(turns: i32) -> &'static str {
    match turns {
        -4 => "-2π",
        -3 => "-3π/2",
        -2 => "-π",
        -1 => "-π/2",
        0 => "0",
        1 => "π/2",
        2 => "π",
        3 => "3π/2",
        _ => "2π",
    }
}

/// Sine and cosine of a number of quarter turns, without rounding.
pub fn sin_cos(turns: i32) -> (f64, f64) {
    match turns.rem_euclid(4) {
        0 => (0.0, 1.0),
        1 => (1.0, 0.0),
        2 => (0.0, -1.0),
        _ => (-1.0, 0.0),
    }
}

/// The rotation by roll, pitch and yaw about fixed axes, of their sines and cosines.
pub fn rpy([(sr, cr), (sp, cp), (sy, cy)]: [(f64, f64); 3]) -> DMat3 {
    DMat3::from_cols(
        DVec3::new(cy * cp, sy * cp, -sp),
        DVec3::new(cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr),
        DVec3::new(cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr),
    )
}

/// The signed permutation that a rotation is a rounding of, and the largest difference of an entry.
pub fn permutation(rotation: &DMat3, resolution: f64) -> Option<(DMat3, f64)> {
    let exact = DMat3::from_cols_array(&rotation.to_cols_array().map(f64::round));
    let is_rotation = exact * exact.transpose() == DMat3::IDENTITY && exact.determinant() == 1.0;
    let apart = (exact - *rotation).to_cols_array();
    let apart = apart.into_iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let most = resolution.clamp(NO_ANGLE, MOST_ANGLE);
    (is_rotation && apart <= most).then_some((exact, apart))
}

/// The quarter turns about x, y and z that make a signed permutation.
pub fn as_quarter_turns(rotation: &DMat3) -> Option<[i32; 3]> {
    let mut all = (-1..=2).flat_map(|yaw| (-1..=1).map(move |pitch| (pitch, yaw)));
    all.find_map(|(pitch, yaw)| {
        let same = |&roll: &i32| rpy([roll, pitch, yaw].map(sin_cos)) == *rotation;
        let roll = [0, 1, 2, -1].into_iter().find(same)?;
        Some([roll, pitch, yaw])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rounding_is_within_a_unit_of_its_last_digit() {
        let turns = |text: &str| quarter_turns(text.parse().unwrap(), resolution(text));
        assert_eq!(turns("1.57"), Some(1));
        assert_eq!(turns("-3.14"), Some(-2));
        assert_eq!(turns("1.57079"), Some(1));
        assert_eq!(turns("1.5707963267948966"), Some(1));
        assert_eq!(turns("-5.55112e-17"), Some(0));
        assert_eq!(turns("0"), Some(0));
        assert_eq!(turns("3.141"), Some(2));
        assert_eq!(turns("4.71239"), Some(3));
        // Small values are stated: zero is written as 0.
        for text in ["0.001", "-0.0001", "0.00001", "0.01", "1e-5"] {
            assert_eq!(turns(text), None, "{text}");
        }
        // A calibrated angle is none, and neither is one of two digits that is far off.
        assert_eq!(turns("1.5694"), None);
        assert_eq!(turns("1.57013854"), None);
        assert_eq!(turns("1.6"), None);
        assert_eq!(turns("0.0486795"), None);
    }

    #[test]
    fn quarter_turns_are_found_for_all_24_permutations() {
        let mut found = Vec::new();
        for roll in -1..=2 {
            for pitch in -1..=2 {
                for yaw in -1..=2 {
                    let rotation = rpy([roll, pitch, yaw].map(sin_cos));
                    let turns = as_quarter_turns(&rotation).expect("a permutation");
                    assert_eq!(rpy(turns.map(sin_cos)), rotation);
                    if !found.contains(&turns) {
                        found.push(turns);
                    }
                }
            }
        }
        assert_eq!(found.len(), 24);
    }
}
