//! The grids, and how much more a polynomial may be between their points.
//!
//! For a polynomial T of degree n in one angle, and a grid of N ≥ 2n + 1 angles, two bounds are
//! known, of which the lesser counts:
//!
//! - Riesz (1914): T falls from its greatest absolute value M no faster than M cos(n θ), and one of
//!   the angles is within π/N, so that max |T| ≤ max over the grid |T| / cos(π n / N).
//! - T is the sum of its values on the grid times kernels of de la Vallée-Poussin, V(θ) = sin(N
//!   θ/2) sin((N − 2n) θ/2) / (N (N − 2n) sin²(θ/2)), so that max |T| ≤ max over the grid |T| · max
//!   Σ_j |V(θ − θ_j)|. Below four angles for each degree it is the lesser one.
//!
//! For several angles they hold one after the other (Ehlich & Zeller, Mathematische Zeitschrift 86,
//! 1964).

use std::f64::consts::{PI, TAU};

/// Angles between two of a grid at which the sum of kernels is evaluated.
const BETWEEN: usize = 128;
/// Sizes beyond the next one that are looked at.
const AHEAD: usize = 6;

/// A grid of angles, with a number of evenly spaced angles for each joint.
#[derive(Clone, Debug)]
pub struct Lattice {
    /// The angles of each joint.
    pub sizes: Vec<usize>,
    /// By joint and degree, how much more a polynomial may be between them.
    above: Vec<Vec<f64>>,
}

impl Lattice {
    /// A grid of so many angles of each joint, for polynomials up to these degrees.
    pub fn new(sizes: Vec<usize>, degrees: &[usize]) -> Self {
        let each = sizes.iter().zip(degrees);
        let above = each.map(|(size, most)| (0..=*most).map(|n| between(n, *size)).collect());
        Self { above: above.collect(), sizes }
    }

    /// The grid of at most so many points which loses least; `None` if these degrees ask for more.
    pub fn best(degrees: &[usize], most: usize) -> Option<Self> {
        let mut sizes: Vec<usize> = degrees.iter().map(|n| 2 * n + 1).collect();
        counted(&sizes, most)?;
        loop {
            // The gain for the points that are added, both as logarithms.
            let mut best = (0.0, None);
            for (i, n) in degrees.iter().enumerate().filter(|one| *one.1 > 0) {
                let here = between(*n, sizes[i]);
                for larger in sizes[i] + 1..=sizes[i] + AHEAD {
                    let mut tried = sizes.clone();
                    tried[i] = larger;
                    let gain =
                        (here / between(*n, larger)).ln() / (larger as f64 / sizes[i] as f64).ln();
                    if gain > best.0 && counted(&tried, most).is_some() {
                        best = (gain, Some(tried));
                    }
                }
            }
            match best.1 {
                Some(larger) => sizes = larger,
                None => return Some(Self::new(sizes, degrees)),
            }
        }
    }

    /// The number of its points.
    pub fn points(&self) -> usize {
        self.sizes.iter().product()
    }

    /// The factor by which a polynomial of these degrees may be larger between the points.
    pub fn between(&self, degrees: &[u8]) -> f64 {
        let each = self.above.iter().zip(degrees);
        (1.0 + 1e-12) * each.map(|(above, n)| above[usize::from(*n)]).product::<f64>()
    }
}

/// The number of points of a grid with these numbers of angles of each joint; `None` if it exceeds
/// `most`.
pub(super) fn counted(sizes: &[usize], most: usize) -> Option<usize> {
    let all = sizes.iter().try_fold(1_usize, |a, b| a.checked_mul(*b));
    all.filter(|all| *all <= most)
}

/// The factor by which a polynomial of a degree may be larger between so many angles, more than
/// twice the degree.
pub fn between(degree: usize, size: usize) -> f64 {
    if degree == 0 {
        return 1.0;
    }
    let (n, count) = (degree as f64, size as f64);
    let riesz = 1.0 / (PI * n / count).cos();
    if size >= 4 * degree {
        return riesz;
    }
    let rest = count - 2.0 * n;
    let kernel = |angle: f64| {
        let half = (0.5 * angle).sin();
        (0.5 * count * angle).sin() * (0.5 * rest * angle).sin() / (count * rest * half * half)
    };
    let sum = |i: usize| -> f64 {
        let to = |j: usize| TAU * (i as f64 / BETWEEN as f64 - j as f64) / count;
        (0..size).map(|j| kernel(to(j)).abs()).sum()
    };
    // For fixed signs the sum is a polynomial of a degree below N, to which Riesz's bound applies
    // once more. At a point of the grid it is one.
    let most = (1..BETWEEN).map(sum).fold(1.0, f64::max);
    let kernels = most * (1.0 + 1e-12) / (PI / BETWEEN as f64).cos();
    kernels.min(riesz)
}
