//! The selection of base parameters in closed form.

use super::*;
use crate::estimate::tests::solved;

#[test]
fn a_change_of_a_base_parameter_is_one_of_its_sum() {
    // τ = a (θ₀ + 2 θ₁) + b θ₂: the second column explains most.
    let mut motion: Excitation<3> = Excitation::new();
    for (a, b) in [(1.0, 1.0), (1.0, -1.0), (-2.0, 0.5), (-2.0, -0.5)] {
        motion.add(&[a, 2.0 * a, b], 0.5);
    }
    let (nominal, share) = ([4.0, 1.0, 30.0], 0.5);
    let base: SelectedParameters<f64, 2, 3> =
        motion.select::<_, 0, 2>(&nominal, share).expect("two columns");
    // Among deviations 2 and 2 · 0.5 the first has the larger effect; the last has the largest, and
    // stays behind it.
    assert_eq!(base.columns, [0, 2]);
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} {b}");
    near(base.prior[1], share * nominal[2]);
    let change = base.change(&[10.0, -1.0]);
    near(change[0] + 2.0 * change[1], 10.0);
    near(change[2], -1.0);
}

#[test]
fn columns_that_a_motion_does_not_tell_apart_are_counted() {
    let mut motion: Excitation<3> = Excitation::default();
    motion.add(&[1.0, 2.0, 0.0], 1.0);
    assert_eq!(motion.select::<f64, 0, 2>(&[1.0; 3], 1.0), Err(1));
    // A part in 10¹² of the first is not rounding, one in 10¹⁴ is.
    for (size, rank) in [(1e-6, 2), (1e-7, 1)] {
        let mut motion: Excitation<2> = Excitation::new();
        motion.add(&[10.0, 0.0], 1.0);
        motion.add(&[0.0, 10.0 * size], 1.0);
        let selected = motion.select::<f64, 0, 2>(&[1.0; 2], 1.0);
        let expected = if rank == 2 { None } else { Some(rank) };
        assert_eq!(selected.err(), expected);
    }
    let none = Excitation::<3>::new().select::<f64, 0, 1>(&[1.0; 3], 1.0);
    assert_eq!(none, Err(0));
}

#[test]
fn the_weight_of_a_row_is_its_noise() {
    // With the noise the second column explains more, without it the first.
    let mut motion: Excitation<2> = Excitation::new();
    motion.add(&[3.0, 0.0], 1.0);
    motion.add(&[0.0, 2.0], 0.5);
    let base = motion.select::<f64, 0, 1>(&[1.0; 2], 1.0).expect("one column");
    assert_eq!(base.columns, [1]);
    // Among two that explain the same it is the first.
    let mut motion: Excitation<3> = Excitation::new();
    motion.add(&[1.0, 2.0, 2.0], 1.0);
    let base = motion.select::<f64, 0, 1>(&[1.0; 3], 1.0);
    assert_eq!(base.map(|base| base.columns), Ok([1]));
}

/// The dual X of a parameter: ⟨X, J⟩ is the parameter.
fn dual(parameter: usize) -> [[f64; 4]; 4] {
    let mut x = [[0.0; 4]; 4];
    let mut add = |i: usize, j: usize, value: f64| {
        x[i][j] += 0.5 * value;
        x[j][i] += 0.5 * value;
    };
    match parameter {
        0 => add(3, 3, 1.0),
        1..4 => add(parameter - 1, 3, 1.0),
        4 => (add(1, 1, 1.0), add(2, 2, 1.0)).0,
        5 => add(0, 1, -1.0),
        6 => (add(0, 0, 1.0), add(2, 2, 1.0)).0,
        7 => add(0, 2, -1.0),
        8 => add(1, 2, -1.0),
        _ => (add(0, 0, 1.0), add(1, 1, 1.0)).0,
    }
    x
}

fn product(a: [[f64; 4]; 4], b: [[f64; 4]; 4]) -> [[f64; 4]; 4] {
    a.map(|row| core::array::from_fn(|j| (0..4).map(|k| row[k] * b[k][j]).sum()))
}

// The covariance of two parameters ⟨X, J⟩ and ⟨Y, J⟩ is s² tr(X J Y J).
#[test]
fn the_covariance_of_a_body_follows_its_pseudo_inertia() {
    const BODY: [f64; 10] = [2.0, 0.5, -0.25, 0.125, 1.0, -0.25, 1.5, -0.125, -0.0625, 2.0];
    let (share, friction) = (0.5, 3.0);
    // The second of two bodies, and a friction.
    let mut nominal = [0.0; 21];
    nominal[10..20].copy_from_slice(&BODY);
    nominal[20] = friction;
    let j = pseudo_inertia(&BODY);
    let of_bodies = |a: usize, b: usize| {
        let all = product(product(dual(a), j), product(dual(b), j));
        share * share * (0..4).map(|i| all[i][i]).sum::<f64>()
    };
    let got = covariance::<2, 21>(&nominal, share);
    for (a, row) in got.iter().enumerate() {
        for (b, got) in row.iter().enumerate() {
            let expected = match (a, b) {
                (10..20, 10..20) => of_bodies(a - 10, b - 10),
                (20, 20) => share * share * friction * friction,
                _ => 0.0,
            };
            assert!((got - expected).abs() < 1e-12, "{a} {b}");
        }
    }
}

#[test]
fn a_row_has_the_selected_columns_of_its_joint() {
    const BODIES: usize = 2;
    let bodies: [[f64; 10]; BODIES] =
        core::array::from_fn(|body| core::array::from_fn(|k| (10 * body + k) as f64));
    // Three joints have two parameters each.
    let all = |joint, own| Excitation::<26>::row::<f64, BODIES, 2>(joint, &bodies, &own);
    for joint in 0..3 {
        let row = all(joint, [0.5, 0.25]);
        for (column, x) in row.into_iter().enumerate() {
            let expected = match column {
                0..20 => column as f64,
                _ if column == 20 + 2 * joint => 0.5,
                _ if column == 21 + 2 * joint => 0.25,
                _ => 0.0,
            };
            assert_eq!(x, expected, "{joint} {column}");
        }
    }
    let base = SelectedParameters::<f64, 5, 26> {
        columns: [3, 14, 20, 23, 24],
        prior: [1.0; 5],
        spread: [[0.0; 5]; 26],
    };
    let row = base.row(1, &bodies, &[0.5, 0.25]);
    assert_eq!(row, [3.0, 14.0, 0.0, 0.25, 0.0]);
    assert_eq!(base.own::<3>(BODIES, 2), [1, 1, 1]);
    assert_eq!(base.own::<3>(BODIES, 0), [0; 3]);
    assert_eq!(base.bodies::<BODIES>(), [true, true]);
    let friction = SelectedParameters { columns: [10, 20, 21, 22, 25], ..base };
    assert_eq!(friction.bodies::<BODIES>(), [false, true]);
    assert_eq!(friction.own::<3>(BODIES, 2), [2, 1, 1]);
}

// Columns that are correlated: of the regression K of all columns on the selected ones and the
// covariance C, the prior is K C Kᵀ and the spread C Kᵀ (K C Kᵀ)⁻¹.
#[test]
fn the_spread_is_that_of_the_regression_on_the_selection() {
    const ROWS: [[f64; 5]; 6] = [
        [1.0, 0.5, -0.3, 0.2, 0.9],
        [0.4, -1.0, 0.8, 0.6, -0.2],
        [-0.7, 0.3, 1.2, -0.5, 0.1],
        [0.2, 0.9, 0.4, 1.1, -0.6],
        [0.6, -0.2, -0.9, 0.7, 0.8],
        [-0.1, 0.7, 0.5, -0.4, 1.3],
    ];
    let mut motion: Excitation<5> = Excitation::new();
    ROWS.iter().for_each(|row| motion.add(row, 1.0));
    let nominal = [1.0, 2.0, 0.5, 1.5, 3.0];
    let base: SelectedParameters<f64, 3, 5> =
        motion.select::<_, 0, 3>(&nominal, 1.0).expect("three columns");
    let product = |a: usize, b: usize| ROWS.iter().map(|row| row[a] * row[b]).sum::<f64>();
    let columns = base.columns;
    assert!(columns.is_sorted());
    let own = columns.map(|a| columns.map(|b| product(a, b)));
    let regression: [[f64; 3]; 5] =
        core::array::from_fn(|i| solved(own, columns.map(|a| product(a, i))));
    let variance = nominal.map(|x| x * x);
    let prior: [[f64; 3]; 3] = core::array::from_fn(|k| {
        core::array::from_fn(|l| {
            let of = |i: usize| regression[i][k] * variance[i] * regression[i][l];
            (0..5).map(of).sum()
        })
    });
    let variances: [f64; 3] = core::array::from_fn(|k| prior[k][k]);
    for (got, variance) in base.prior.iter().zip(variances) {
        assert!((got - variance.sqrt()).abs() < 1e-12);
    }
    for (i, row) in base.spread.iter().enumerate() {
        let expected = solved(prior, regression[i].map(|x| variance[i] * x));
        for k in 0..3 {
            assert!((row[k] - expected[k]).abs() < 1e-12, "{i}");
        }
    }
    // The last column that was selected explains more of what the others leave than any that was
    // not.
    let left = |of: &[usize; 2], i: usize| {
        let own = of.map(|a| of.map(|b| product(a, b)));
        let with = of.map(|a| product(a, i));
        let share = solved(own, with);
        variance[i] * (product(i, i) - share[0] * with[0] - share[1] * with[1])
    };
    assert_eq!(columns, [1, 3, 4]);
    assert!(left(&[1, 4], 3) > left(&[1, 4], 0).max(left(&[1, 4], 2)));
}
