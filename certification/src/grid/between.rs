//! How much more a trigonometric polynomial can be between the angles of a grid than at them.
//!
//! With N angles x_j, a polynomial T of degree n < N/2 is
//!
//!   T(x) = 1/N Σ_j T(x_j) K(x − x_j),   K(t) = 1 + 2 Σ_{0 < m < N − n} c_m cos m t,   c_m = min(1, (N − n − m)/(N − 2 n)),
//!
//! since on the grid a frequency that K has and T has not is none of T's: de la Vallée Poussin's kernel. So max |T| ≤ Λ max |T(x_j)| with
//! Λ = max 1/N Σ_j |K(x − x_j)|. Of few angles Λ is less than Riesz' 1/cos(π n/N): 1.52 against 1.70 of ten angles and degree three.

use std::collections::HashMap;
use std::f64::consts::{PI, TAU};
use std::sync::{LazyLock, Mutex};

/// Known factors, by degree and number of angles.
static KNOWN: LazyLock<Mutex<HashMap<(usize, usize), f64>>> = LazyLock::new(Mutex::default);

/// The lesser of both factors for polynomials of this degree on so many angles.
pub fn factor(degree: usize, angles: usize) -> f64 {
    let Ok(mut known) = KNOWN.lock() else {
        return lesser(degree, angles);
    };
    let key = (degree, angles);
    *known.entry(key).or_insert_with(|| lesser(degree, angles))
}

fn lesser(degree: usize, angles: usize) -> f64 {
    let riesz = 1.0 / (PI * degree as f64 / angles as f64).cos();
    // From there on it is Riesz who says less.
    if degree == 0 || angles >= 4 * degree {
        return riesz;
    }
    kernel(degree, angles).min(riesz)
}

/// Places between two angles of the grid at which Λ is evaluated.
const PLACES: usize = 5000;

/// Λ: the greatest at these places, and what the slope of K allows in between.
fn kernel(degree: usize, angles: usize) -> f64 {
    let (n, all) = (degree as f64, angles as f64);
    let frequencies = (1..angles - degree).map(|m| m as f64);
    let terms = frequencies.map(|m| (m, ((all - n - m) / (all - 2.0 * n)).min(1.0)));
    let terms: Vec<(f64, f64)> = terms.collect();
    let at = |t: f64| 1.0 + 2.0 * terms.iter().map(|(m, c)| c * (m * t).cos()).sum::<f64>();
    let step = TAU / all / PLACES as f64;
    let sum = |place: usize| {
        let x = step * place as f64;
        let each = (0..angles).map(|j| at(x - TAU * j as f64 / all).abs());
        each.sum::<f64>() / all
    };
    let slope = 2.0 * terms.iter().map(|(m, c)| m * c).sum::<f64>();
    let greatest = (0..=PLACES).map(sum).fold(0.0, f64::max);
    greatest + 0.5 * step * slope + 1e-9
}
