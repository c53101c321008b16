//! Shapes of a uniform beam that is clamped at one end and carries a body at the other, while
//! compiling.
//!
//! Bending: EI w⁗ = ω² ρA w, so that w = cosh − cos + r (sinh − sin) of β x, with EI w″ = ω² J w′
//! and EI w‴ = −ω² m w at the end; torsion: θ = sin β x, with GJ θ′ = ω² J θ. Meirovitch,
//! *Fundamentals of Vibrations* (2001), sections 8.4, 8.6.

use crate::math::const_eval::{exp, sin_cos};

/// The start of the search for roots, its step, and its end.
const SCAN: (f64, f64, f64) = (0.01, 0.05, 60.0);

/// A shape over u = x / L, one at u = 1.
#[derive(Clone, Copy)]
pub(super) struct Line {
    bending: bool,
    /// βL.
    pub(super) wave: f64,
    /// 1 + r, without cancellation.
    delta: f64,
    scale: f64,
}

impl Line {
    /// The `index`-th bending shape, from one, with a body at the end of mass m and inertia J:
    /// `ratios` are m / ρAL and J / ρAL³. None beyond the search.
    pub(super) const fn bending(index: usize, ratios: [f64; 2]) -> Option<Self> {
        let Some(wave) = root(true, index, ratios) else {
            return None;
        };
        let Hyperbolic { decay, sinh, cosh } = hyperbolic(wave);
        let ((s, c), mu) = (sin_cos(wave), ratios[0] * wave);
        // From the condition of the shear force, which keeps its size with heavy bodies, too.
        let delta = (decay + c + s + mu * (c - s - decay)) / (cosh + c + mu * (sinh - s));
        Some(Self { bending: true, wave, delta, scale: 1.0 }.scaled())
    }

    /// The `index`-th torsion shape, from one; `ratio` is J / ρI_p L.
    pub(super) const fn torsion(index: usize, ratio: f64) -> Option<Self> {
        let Some(wave) = root(false, index, [ratio, 0.0]) else {
            return None;
        };
        Some(Self { bending: false, wave, delta: 0.0, scale: 1.0 }.scaled())
    }

    const fn scaled(mut self) -> Self {
        self.scale = 1.0 / self.at(1.0)[0];
        self
    }

    /// The value and its derivative with respect to u.
    pub(super) const fn at(&self, u: f64) -> [f64; 2] {
        let x = self.wave * u;
        let (s, c) = sin_cos(x);
        let [value, slope] = if self.bending {
            let Hyperbolic { decay, sinh, cosh } = hyperbolic(x);
            let (delta, r) = (self.delta, self.delta - 1.0);
            [decay + delta * sinh - c - r * s, delta * cosh - decay + s - r * c]
        } else {
            [s, c]
        };
        [value * self.scale, slope * self.scale * self.wave]
    }
}

/// e⁻ˣ, sinh x, cosh x.
struct Hyperbolic {
    decay: f64,
    sinh: f64,
    cosh: f64,
}

const fn hyperbolic(x: f64) -> Hyperbolic {
    let (growth, decay) = (exp(x), exp(-x));
    Hyperbolic { decay, sinh: 0.5 * (growth - decay), cosh: 0.5 * (growth + decay) }
}

/// The characteristic function at βL = b, over cosh b in bending.
const fn characteristic(bending: bool, b: f64, [mass, inertia]: [f64; 2]) -> f64 {
    let (s, c) = sin_cos(b);
    if !bending {
        return c - mass * b * s;
    }
    let Hyperbolic { sinh, cosh, .. } = hyperbolic(b);
    let (t, k) = (sinh / cosh, 1.0 / cosh);
    let (mu, j) = (mass * b, inertia * b * b * b);
    c + k + mu * (c * t - s) - j * (t * c + s) + j * mu * (k - c)
}

/// The `index`-th positive root.
const fn root(bending: bool, index: usize, ratios: [f64; 2]) -> Option<f64> {
    let (first, step, last) = SCAN;
    let (mut low, mut found) = (first, 0);
    let mut sign = characteristic(bending, low, ratios) > 0.0;
    while low < last {
        let high = low + step;
        if (characteristic(bending, high, ratios) > 0.0) != sign {
            found += 1;
            if found == index {
                return Some(bisected(bending, [low, high], sign, ratios));
            }
            sign = !sign;
        }
        low = high;
    }
    None
}

const fn bisected(
    bending: bool,
    [mut low, mut high]: [f64; 2],
    sign: bool,
    ratios: [f64; 2],
) -> f64 {
    let mut i = 0;
    while i < 52 {
        let middle = 0.5 * (low + high);
        if (characteristic(bending, middle, ratios) > 0.0) == sign {
            low = middle;
        } else {
            high = middle;
        }
        i += 1;
    }
    0.5 * (low + high)
}

/// Nodes and weights of Gauss and Legendre within (0, 1), four of eight: the others are their
/// mirror images.
const GAUSS: [[f64; 2]; 4] = [
    [0.183_434_642_495_649_8, 0.362_683_783_378_362],
    [0.525_532_409_916_329, 0.313_706_645_877_887_3],
    [0.796_666_477_413_626_7, 0.222_381_034_453_374_5],
    [0.960_289_856_497_536_3, 0.101_228_536_290_376_3],
];
/// Parts of the beam that are integrated separately.
const PARTS: usize = 12;
/// Points of the quadrature.
pub(super) const POINTS: usize = 8 * PARTS;

/// The k-th point of the quadrature over 0 < u < 1, and its weight.
pub(super) const fn point(k: usize) -> [f64; 2] {
    let [node, weight] = GAUSS[k % 4];
    let node = if k % 8 < 4 { node } else { -node };
    let part = (k / 8) as f64;
    [(part + 0.5 * (1.0 + node)) / PARTS as f64, 0.5 * weight / PARTS as f64]
}

#[cfg(test)]
mod tests {
    use super::{Line, POINTS, point};

    #[test]
    fn a_bare_beam_has_the_textbook_roots() {
        // Meirovitch (2001), table 8.4 to more digits.
        let roots = [1.875_104_068_711_961, 4.694_091_132_974_175, 7.854_757_438_237_613];
        for (k, root) in roots.into_iter().enumerate() {
            let line = Line::bending(k + 1, [0.0; 2]).expect("a root");
            assert!((line.wave - root).abs() < 4e-15 * root, "{k}: {}", line.wave);
        }
        let twist = Line::torsion(2, 0.0).expect("a root");
        assert!((twist.wave - 1.5 * core::f64::consts::PI).abs() < 2e-15);
    }

    // The body at the end counts in the orthogonality.
    #[test]
    fn mode_shapes_are_orthogonal_and_slopes_their_derivatives() {
        let (m, j) = (0.7, 0.05);
        let lines = [1, 2, 3].map(|k| Line::bending(k, [m, j]).expect("a root"));
        for (i, a) in lines.iter().enumerate() {
            let at = a.at(0.4 + 1e-5)[0] - a.at(0.4 - 1e-5)[0];
            assert!((at / 2e-5 - a.at(0.4)[1]).abs() < 1e-7);
            assert!(a.at(0.0)[0].abs() < 1e-15 && a.at(0.0)[1].abs() < 1e-14);
            for b in &lines[..i] {
                let beam: f64 = (0..POINTS)
                    .map(|k| point(k)[1] * a.at(point(k)[0])[0] * b.at(point(k)[0])[0])
                    .sum();
                let end = m + j * a.at(1.0)[1] * b.at(1.0)[1];
                assert!((beam + end).abs() < 1e-12, "{beam} {end}");
            }
        }
    }

    #[test]
    fn a_mode_beyond_the_search_is_none() {
        assert!(Line::bending(40, [0.0; 2]).is_none());
    }
}
