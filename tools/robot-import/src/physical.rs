//! Whether an inertia is one that a distribution of mass can have, and the nearest that is.
//!
//! The library decides, by [`ImpossibleInertia`].

use dynamics_core::model::ImpossibleInertia;

/// By how much a principal moment may exceed the sum of the others: the rounding of a file's
/// digits.
pub const TOLERANCE: f64 = 1e-3;

/// The defect of an inertia about the centre of mass, if it exceeds `tolerance` of its largest
/// moment.
pub fn impossible(inertia: [f64; 6], tolerance: f64) -> Option<ImpossibleInertia> {
    ImpossibleInertia::of(inertia, tolerance)
}

/// The same as a sentence.
pub fn sentence(found: &ImpossibleInertia) -> String {
    capitalised(&found.to_string())
}

/// A clause as a sentence.
pub fn capitalised(clause: &str) -> String {
    let mut letters = clause.chars();
    let first = letters.next().map(char::to_uppercase).into_iter().flatten();
    first.chain(letters).chain(['.']).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    // A rod is physical.
    #[test]
    fn an_unphysical_axis_is_named_and_repaired() {
        assert_eq!(impossible([0.0, 0.0, 0.0, 1.0, 0.0, 1.0], 1e-9), None);
        let found = impossible([1.0, 0.0, 0.0, 1.0, 0.0, 2.5], 1e-9).expect("too large");
        assert!((found.axis[2].abs() - 1.0).abs() < 1e-12);
        assert!((found.excess - 0.2).abs() < 1e-12);
        // The second moments (0.25, 0.25, −… ) keep those that are positive: xx = yy = 1.25, zz =
        // 2.5.
        for inertia in [
            [1.0, 0.0, 0.0, 1.0, 0.0, 2.5],
            [1.0, 1.5, 0.0, 1.0, 0.0, 1.0],
            [0.02, 0.01, -0.03, 0.01, 0.02, -0.01],
        ] {
            let repaired = ImpossibleInertia::nearest(inertia);
            assert_eq!(impossible(repaired, 1e-12), None);
            // The nearest inertia has no nearer one: a projection.
            let again = ImpossibleInertia::nearest(repaired);
            for (a, b) in repaired.into_iter().zip(again) {
                assert!((a - b).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn what_is_impossible_is_named_with_its_amount() {
        assert_eq!(impossible([1.0, 0.0, 0.0, 1.0, 0.0, 1.9], 1e-3), None);
        let words = impossible([1.0, 0.0, 0.0, 1.0, 0.0, 2.5], 1e-3).expect("too large");
        let words = sentence(&words);
        assert!(
            words.contains("about (0.00, 0.00, 1.00) exceeds the sum of the two others by 20.0 %"),
            "{words}"
        );
        let words = impossible([0.012, 0.0, 0.0, -0.01, 0.0, 0.009], 1e-3).expect("negative");
        let words = sentence(&words);
        assert!(words.contains("about (0.00, 1.00, 0.00) is -1.000e-2 kg·m²"), "{words}");
        // Two moments of which one is small and negative, by turned axes.
        let words = impossible([1.0, 1.5, 0.0, 1.0, 0.0, 1.0], 1e-3).expect("negative");
        let words = sentence(&words);
        assert!(words.contains("is -5.000e-1 kg·m²"), "{words}");
        let rounded = [1.0, 0.0, 0.0, 1.0, 0.0, 2.000_1];
        assert_eq!(impossible(rounded, 1e-3), None);
    }
}
