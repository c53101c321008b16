//! Whether an inertia is one that a distribution of mass can have, and the nearest that is.
//!
//! About the centre of mass the second moments Σ = ½ tr(I) 1 − I have to be positive semidefinite (the triangle
//! inequality of the principal moments; Wensing, Kim and Slotine 2018). The nearest physical inertia is that of Σ with
//! its negative eigenvalues set to zero: the projection in the Frobenius norm.

use dynamics_core::glam::{DMat3, DVec3};

use crate::inertia::{entries, matrix};

/// A second moment that is negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Violation {
    /// The principal axis about which the moment of inertia is larger than the sum of the two others.
    pub axis: DVec3,
    /// By how much, of the largest moment.
    pub excess: f64,
    /// The nearest physical inertia: xx, xy, xz, yy, yz, zz, kg·m².
    pub repaired: [f64; 6],
}

/// The violation of an inertia about the centre of mass, if it is larger than `tolerance` of its largest moment.
pub fn violation(inertia: [f64; 6], tolerance: f64) -> Option<Violation> {
    let about_com = matrix(inertia);
    let half_trace = 0.5 * (inertia[0] + inertia[3] + inertia[5]);
    let second = DMat3::from_diagonal(DVec3::splat(half_trace)) - about_com;
    let (values, axes) = eigen(second);
    let [a, b, c] = values;
    // Principal moments: the sums of two second moments.
    let largest = [a + b, b + c, a + c]
        .into_iter()
        .fold(0.0, |most: f64, x| most.max(x.abs()));
    let (worst, least) = (0..3)
        .map(|i| (i, values[i]))
        .min_by(|x, y| x.1.total_cmp(&y.1))?;
    if largest == 0.0 || -least <= tolerance * largest {
        return None;
    }
    let kept = values.map(|value| value.max(0.0));
    let axes_matrix = DMat3::from_cols(axes[0], axes[1], axes[2]);
    let second =
        axes_matrix * DMat3::from_diagonal(DVec3::from_array(kept)) * axes_matrix.transpose();
    let repaired = DMat3::from_diagonal(DVec3::splat(kept.iter().sum())) - second;
    Some(Violation {
        axis: axes[worst],
        excess: -2.0 * least / largest,
        repaired: entries(repaired),
    })
}

/// What is impossible about an inertia about the centre of mass, a sentence, if it is by more than `tolerance` of its largest
/// moment: a moment that is negative, or one that exceeds the sum of the two others.
pub fn impossible(inertia: [f64; 6], tolerance: f64) -> Option<String> {
    let found = violation(inertia, tolerance)?;
    let (moments, axes) = eigen(matrix(inertia));
    let largest = moments.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let about = |axis: DVec3| {
        // Of the two directions of an axis, the one with more positive components.
        let axis = if axis.element_sum() < 0.0 {
            -axis
        } else {
            axis
        };
        axis.to_array()
            .map(|x| format!("{:.2}", x + 0.0))
            .join(", ")
            .replace("-0.00", "0.00")
    };
    let least = moments.iter().zip(axes).min_by(|a, b| a.0.total_cmp(b.0));
    if let Some((least, axis)) = least.filter(|(least, _)| **least < -tolerance * largest) {
        return Some(format!(
            "The moment of inertia about ({}) is {least:.3e} kg·m², and none is negative: no body has it.",
            about(axis)
        ));
    }
    Some(format!(
        "The moment of inertia about ({}) exceeds the sum of the two others by {:.1} % of the largest: no body has it.",
        about(found.axis),
        100.0 * found.excess
    ))
}

/// Eigenvalues and eigenvectors of a symmetric matrix by Jacobi's rotations.
pub fn eigen(mut m: DMat3) -> ([f64; 3], [DVec3; 3]) {
    let mut axes = DMat3::IDENTITY;
    for _ in 0..30 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let off = m.col(q)[p];
            if off == 0.0 {
                continue;
            }
            let theta = 0.5 * (2.0 * off).atan2(m.col(q)[q] - m.col(p)[p]);
            let (s, c) = theta.sin_cos();
            let mut turn = DMat3::IDENTITY;
            turn.col_mut(p)[p] = c;
            turn.col_mut(q)[q] = c;
            turn.col_mut(q)[p] = s;
            turn.col_mut(p)[q] = -s;
            m = turn.transpose() * m * turn;
            axes *= turn;
        }
    }
    (
        [0, 1, 2].map(|i| m.col(i)[i]),
        [0, 1, 2].map(|i| axes.col(i)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    // A rod is physical.
    #[test]
    fn an_unphysical_axis_is_named_and_repaired() {
        assert_eq!(violation([0.0, 0.0, 0.0, 1.0, 0.0, 1.0], 1e-9), None);
        let found = violation([1.0, 0.0, 0.0, 1.0, 0.0, 2.5], 1e-9).expect("too large");
        assert!((found.axis.z.abs() - 1.0).abs() < 1e-12);
        assert!((found.excess - 0.2).abs() < 1e-12);
        assert_eq!(violation(found.repaired, 1e-12), None);
        // The second moments (0.25, 0.25, −… ) keep those that are positive: xx = yy = 1.25, zz = 2.5.
        let [xx, _, _, yy, _, zz] = found.repaired;
        assert!((xx - 1.25).abs() < 1e-12 && (yy - 1.25).abs() < 1e-12 && (zz - 2.5).abs() < 1e-12);
    }

    #[test]
    fn what_is_impossible_is_named_with_its_amount() {
        assert_eq!(impossible([1.0, 0.0, 0.0, 1.0, 0.0, 1.9], 1e-3), None);
        let words = impossible([1.0, 0.0, 0.0, 1.0, 0.0, 2.5], 1e-3).expect("too large");
        assert!(
            words.contains("about (0.00, 0.00, 1.00) exceeds the sum of the two others by 20.0 %"),
            "{words}"
        );
        let words = impossible([0.012, 0.0, 0.0, -0.01, 0.0, 0.009], 1e-3).expect("negative");
        assert!(
            words.contains("about (0.00, 1.00, 0.00) is -1.000e-2 kg·m²"),
            "{words}"
        );
        // Two moments of which one is small and negative, by turned axes.
        let words = impossible([1.0, 1.5, 0.0, 1.0, 0.0, 1.0], 1e-3).expect("negative");
        assert!(words.contains("is -5.000e-1 kg·m²"), "{words}");
        let rounded = [1.0, 0.0, 0.0, 1.0, 0.0, 2.000_1];
        assert_eq!(impossible(rounded, 1e-3), None);
    }

    #[test]
    fn eigenvectors_make_the_matrix_diagonal() {
        let m = matrix([2.0, 0.3, -0.4, 1.5, 0.7, 0.9]);
        let (values, axes) = eigen(m);
        for (value, axis) in values.into_iter().zip(axes) {
            assert!((m * axis - axis * value).length() < 1e-14);
        }
    }
}
