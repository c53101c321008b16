//! The same robot in other units, or with its numbers rounded.

use glam::{DMat3, DVec3};

use super::{Link, Model};
use crate::math::const_eval::scale;
use crate::spatial::{SpatialInertia, Xform};

impl<const B: usize, const Q: usize, const V: usize> Model<f64, B, Q, V> {
    /// The robot in units of `length` m and `mass` kg; its joints turn, since lengths among coordinates and limits
    /// stay as they are.
    ///
    /// In a unit of time of t s, q̇ is to be given t times as large, q̈ and g/`length` t² times, and a torque of 1 is
    /// `mass · length² / t²` N·m. Meant for [`crate::scalar::Fixed`], whose numbers have to stay within ±2.
    ///
    /// ```
    /// use dynamics_core::{model::Robot, robots::Ur5e};
    /// let heavy = Ur5e::MODEL.in_units(0.5, 2.0);
    /// assert_eq!(heavy.links[1].inertia.mass, 8.058 / 2.0);
    /// ```
    #[must_use]
    pub const fn in_units(mut self, length: f64, mass: f64) -> Self {
        let mut i = 0;
        while i < B {
            let Xform { rot, pos } = self.links[i].placement;
            self.links[i].placement = Xform {
                rot,
                pos: scale(pos, 1.0 / length),
            };
            let inertia = self.links[i].inertia;
            self.links[i].inertia = SpatialInertia {
                mass: inertia.mass / mass,
                first_moment: scale(inertia.first_moment, 1.0 / (mass * length)),
                inertia: scaled(&inertia.inertia, 1.0 / (mass * length * length)),
            };
            i += 1;
        }
        self
    }

    /// The robot with lengths, masses, moments and inertias rounded to `bits` significant bits: parameters that are
    /// stored, or known, no better.
    ///
    /// ```
    /// use dynamics_core::{model::Robot, robots::Ur5e};
    /// assert_eq!(Ur5e::MODEL.rounded(8).links[1].inertia.mass, 8.0625); // kg, of 8.058
    /// ```
    #[must_use]
    pub const fn rounded(mut self, bits: u32) -> Self {
        let mut i = 0;
        while i < B {
            let Link {
                placement: Xform { rot, pos },
                inertia,
                ..
            } = self.links[i];
            self.links[i].placement = Xform {
                rot,
                pos: vector(pos, bits),
            };
            let m = &inertia.inertia;
            let columns = [m.x_axis, m.y_axis, m.z_axis];
            self.links[i].inertia = SpatialInertia {
                mass: number(inertia.mass, bits),
                first_moment: vector(inertia.first_moment, bits),
                inertia: DMat3::from_cols(
                    vector(columns[0], bits),
                    vector(columns[1], bits),
                    vector(columns[2], bits),
                ),
            };
            i += 1;
        }
        self
    }
}

const fn scaled(m: &DMat3, s: f64) -> DMat3 {
    DMat3::from_cols(scale(m.x_axis, s), scale(m.y_axis, s), scale(m.z_axis, s))
}

const fn vector(v: DVec3, bits: u32) -> DVec3 {
    DVec3::new(number(v.x, bits), number(v.y, bits), number(v.z, bits))
}

/// To nearest, by adding and cutting off bits of the mantissa's 53.
const fn number(x: f64, bits: u32) -> f64 {
    assert!(bits >= 1 && bits <= 52);
    let cut = 53 - bits;
    let half = 1_u64 << (cut - 1);
    f64::from_bits((x.to_bits() + half) >> cut << cut)
}
