//! A stretch of a hop: the ground's force as a polynomial, where it moves the centre of mass, and
//! how deep and how high the foot is meanwhile.

use dynamics_core::scalar::Real;

/// A number that moves: itself and its rates, per s and per s².
pub(super) type Moving = [f32; 3];

/// A section of the trajectory with one formula.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Phase {
    pub start: u32,
    /// T and 1/T, s.
    pub time: f32,
    pub time_inv: f32,
    /// The acceleration f at rest and its change, m/s².
    pub rest: f32,
    pub change: f32,
    pub push: f32,
    /// z_c and its rate at the start, m and m/s.
    pub centre: f32,
    pub rate: f32,
    /// 64 times the foot's clearance, m.
    pub lift: f32,
}

impl Phase {
    pub fn lasting(time: f32) -> Self {
        Self { time, time_inv: 1.0 / time, ..Self::default() }
    }

    /// z_c.
    #[inline(always)]
    pub fn centre(&self, s: f32, gravity: f32) -> Moving {
        let (s2, r) = (s * s, 1.0 - s);
        let (s4, u) = (s2 * s2, s * r);
        let change = [
            s4 * s * (0.5 + s * (-0.5 + s * (1.0 / 7.0))),
            s4 * (2.5 + s * (-3.0 + s)),
            s2 * s * (10.0 + s * (-15.0 + s * 6.0)),
        ];
        let push = [
            s4 * s * (7.0 + s * (-14.0 + s * (10.0 - s * 2.5))),
            s4 * (35.0 + s * (-84.0 + s * (70.0 - s * 20.0))),
            140.0 * u * u * u,
        ];
        let steady = [0.5 * s2, s, 1.0];
        let sum = |k: usize| {
            (self.rest - gravity) * steady[k] + self.change * change[k] + self.push * push[k]
        };
        let ahead = self.time * s;
        [
            self.centre + ahead * self.rate + self.time * self.time * sum(0),
            self.rate + self.time * sum(1),
            sum(2),
        ]
    }

    /// The depth of the foot in the ground: (f − ḟ b/k) M/k.
    #[inline(always)]
    pub fn depth(&self, s: f32, give: f32, lag: f32) -> Moving {
        let (r, per) = (1.0 - s, self.time_inv);
        let (u, slope) = (s * r, r - s);
        let (h, b) = (self.change, self.push);
        // f and its rates per s.
        let f = [
            self.rest + h * s * s * s * (10.0 + s * (-15.0 + s * 6.0)) + b * 140.0 * u * u * u,
            per * u * u * (30.0 * h + 420.0 * b * slope),
            per * per * u * (60.0 * h * slope + 840.0 * b * (1.0 - 5.0 * u)),
            per * per * per * (60.0 * h * (1.0 - 6.0 * u) + 840.0 * b * (1.0 - 10.0 * u) * slope),
        ];
        [0, 1, 2].map(|k| give * (f[k] - lag * f[k + 1]))
    }

    /// The height of the foot above the ground.
    #[inline(always)]
    pub fn lift(&self, s: f32) -> Moving {
        let (r, per) = (1.0 - s, self.time_inv);
        let (u, slope) = (s * r, r - s);
        [
            self.lift * u * u * u,
            self.lift * per * 3.0 * u * u * slope,
            self.lift * per * per * 6.0 * u * (1.0 - 5.0 * u),
        ]
    }
}

/// The angle in rad of a cosine x, 0 ≤ x ≤ 0.99: √(1 − x) times a polynomial, absolute error below
/// 4·10⁻⁷.
///
/// Abramowitz & Stegun, *Handbook of Mathematical Functions* (1964), (4.4.46). Cost: 40 flops, no
/// division.
///
/// ```
/// use firmware_demo::trajectories::hop::arc_cosine;
/// assert!((arc_cosine(0.5) - core::f32::consts::FRAC_PI_3).abs() < 4e-7);
/// ```
#[inline(always)]
pub fn arc_cosine(x: f32) -> f32 {
    const A: [f32; 8] = [
        core::f32::consts::FRAC_PI_2,
        -0.214_598_8,
        0.088_978_99,
        -0.050_174_303,
        0.030_891_88,
        -0.017_088_126,
        0.006_670_09,
        -0.001_262_491_1,
    ];
    let polynomial = A.iter().rev().fold(0.0, |sum, a| sum * x + a);
    let rest = 1.0 - x;
    rest * rest.rsqrt() * polynomial
}
