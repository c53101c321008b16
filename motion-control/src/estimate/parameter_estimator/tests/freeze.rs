//! When the estimator freezes and thaws, tick by tick.

use super::*;

/// One parameter of each of two joints, known to a millionth, with a limit of 4: an innovation
/// counts 16 at most.
type Pair = ParameterEstimator<f64, 2, 2>;
const MOST: f64 = 16.0;

fn pair() -> Pair {
    let config = ParameterEstimatorConfig {
        noise: [1.0; 2],
        prior: [1e-6; 2],
        own: [1, 1],
        forgetting: 0.0,
        limit: 4.0,
    };
    Pair::try_new(config).expect("a good configuration")
}

fn row(joint: usize) -> [f64; 2] {
    core::array::from_fn(|k| f64::from(u8::from(k == joint)))
}

fn update(pair: &mut Pair, joint: usize, residual: f64) -> Result<(), RejectedRow> {
    pair.update(joint, &row(joint), residual)
}

/// One that is frozen by the second joint, and the level of that.
fn frozen() -> (Pair, f64) {
    let mut pair = pair();
    let joint = 1;
    let outlier = Err(RejectedRow::Outlier { joint });
    let until = ticks(1.0, MOST, |level| level > 0.25 * MOST);
    for _ in 1..until {
        assert_eq!(update(&mut pair, joint, 99.0), outlier);
        assert_eq!(pair.frozen(), None);
    }
    let refused = Err(RejectedRow::Frozen { joint });
    assert_eq!(update(&mut pair, joint, 99.0), refused);
    assert_eq!(pair.frozen(), Some(joint));
    assert_eq!(pair.rejected(), &[0, until]);
    let level = pair.consistency()[joint];
    (pair, level)
}

#[test]
fn a_level_beyond_a_quarter_freezes_the_estimate() {
    let (mut pair, _) = frozen();
    // Good rows of either joint change nothing meanwhile.
    let factors = pair.factors;
    for joint in [0, 1] {
        let refused = Err(RejectedRow::Frozen { joint: 1 });
        assert_eq!(update(&mut pair, joint, 0.5), refused);
        assert_eq!(pair.factors, factors);
    }
}

#[test]
fn a_row_at_the_limit_is_no_outlier() {
    // 4² of (1 + 10⁻¹²).
    let mut at = pair();
    assert_eq!(update(&mut at, 0, 4.0), Ok(()));
    // Without a direction, exactly.
    let joint = 0;
    assert_eq!(pair().update(joint, &[0.0; 2], 4.0), Ok(()));
    let outlier = Err(RejectedRow::Outlier { joint });
    assert_eq!(update(&mut pair(), joint, 4.01), outlier);
    // With an uncertain parameter the error may be larger.
    let config = ParameterEstimatorConfig { prior: [3.0_f64.sqrt(); 2], ..at.config };
    let mut uncertain = Pair::try_new(config).expect("a good configuration");
    assert_eq!(update(&mut uncertain, 0, 7.99), Ok(()));
    let level = uncertain.consistency()[0];
    assert!((level - (1.0 + (7.99 * 7.99 / 4.0 - 1.0) / 64.0)).abs() < 1e-12);
}

#[test]
fn consistent_rows_of_its_joint_thaw_the_estimate() {
    let (mut pair, level) = frozen();
    let joint = 1;
    let refused = Err(RejectedRow::Frozen { joint });
    let until = ticks(level, 0.0, |level| level <= 0.16 * MOST);
    for _ in 1..until {
        assert_eq!(update(&mut pair, joint, 0.0), refused);
    }
    assert_eq!(update(&mut pair, joint, 0.0), Ok(()));
    assert_eq!(pair.frozen(), None);
}

#[test]
fn many_consistent_rows_of_others_thaw_the_estimate() {
    let (mut pair, _) = frozen();
    let refused = Err(RejectedRow::Frozen { joint: 1 });
    for _ in 1..1024 {
        assert_eq!(update(&mut pair, 0, 0.0), refused);
    }
    assert_eq!(update(&mut pair, 0, 0.0), Ok(()));
    assert_eq!(pair.frozen(), None);
    // A level that is not consistent begins their count anew, and an outlier alone is not counted.
    let (mut pair, _) = frozen();
    for _ in 0..1000 {
        assert_eq!(update(&mut pair, 0, 0.0), refused);
    }
    assert_eq!(update(&mut pair, 0, 99.0), refused);
    assert_eq!(pair.others, 1000);
    assert_eq!(update(&mut pair, 1, 0.0), refused);
    assert_eq!(pair.others, 0);
    // A new freeze counts from zero.
    for _ in 0..10 {
        assert_eq!(update(&mut pair, 0, 0.0), refused);
    }
    pair.reopen();
    assert_eq!(pair.frozen(), None);
    assert_eq!(update(&mut pair, 0, 0.0), Ok(()));
    assert_eq!(pair.others, 0);
}

#[test]
fn a_level_at_a_bound_neither_freezes_nor_stays_frozen() {
    // For a limit of 5 the bounds are 2.5² and 2², and an innovation of that size keeps its level.
    let config = ParameterEstimatorConfig { limit: 5.0, ..pair().config };
    let mut pair = Pair::try_new(config).expect("a good configuration");
    pair.levels = [6.25; 2];
    assert_eq!(pair.update(0, &[0.0; 2], 2.5), Ok(()));
    assert_eq!((pair.frozen(), pair.levels), (None, [6.25; 2]));
    pair.levels = [4.0; 2];
    pair.frozen = Some(0);
    assert_eq!(pair.update(0, &[0.0; 2], 2.0), Ok(()));
    assert_eq!((pair.frozen(), pair.levels), (None, [4.0; 2]));
}
