//! Masses of several links as one body's.

use dynamics_core::glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

use crate::description::Pose;
use crate::number::tidy;

/// Mass, centre of mass and rotational inertia about it, all in the body's frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MassProperties {
    /// Mass, kg.
    pub mass: f64,
    /// Centre of mass, m.
    pub com: [f64; 3],
    /// xx, xy, xz, yy, yz, zz about the centre of mass, kg·m².
    pub inertia: [f64; 6],
}

impl MassProperties {
    /// From an inertia along the axes of a frame whose origin is the centre of mass.
    pub fn in_frame(mass: f64, frame: &Pose, inertia: [f64; 6]) -> Self {
        let turned = match frame.rotation == DMat3::IDENTITY {
            true => inertia,
            false => entries(frame.rotation * matrix(inertia) * frame.rotation.transpose()),
        };
        Self { mass, com: frame.position.to_array(), inertia: turned }
    }

    /// The same in the frame in which `frame` is given.
    pub fn moved(&self, frame: &Pose) -> Self {
        let com = Pose::translation(DVec3::from_array(self.com));
        Self::in_frame(self.mass, &frame.then(&com), self.inertia)
    }

    /// Whether it has neither mass nor inertia.
    pub fn is_none(&self) -> bool {
        self.mass == 0.0 && self.inertia == [0.0; 6]
    }

    /// The mass properties of two bodies together.
    pub fn plus(&self, other: &Self) -> Self {
        if self.is_none() || other.is_none() {
            return if self.is_none() { *other } else { *self };
        }
        let mass = self.mass + other.mass;
        let [a, b] = [self, other].map(|part| DVec3::from_array(part.com));
        let com = match mass == 0.0 {
            true => DVec3::ZERO,
            false => (a * self.mass + b * other.mass) / mass,
        };
        let about = |part: &Self| {
            let arm = DVec3::from_array(part.com) - com;
            let square = DMat3::from_cols(arm * arm.x, arm * arm.y, arm * arm.z);
            let steiner = (DMat3::from_diagonal(DVec3::splat(arm.dot(arm))) - square) * part.mass;
            matrix(part.inertia) + steiner
        };
        Self { mass, com: com.to_array(), inertia: entries(about(self) + about(other)) }
    }

    /// With numbers of fewer digits where they differ by rounding alone.
    pub fn tidied(&self) -> Self {
        Self { mass: tidy(self.mass), com: self.com.map(tidy), inertia: self.inertia.map(tidy) }
    }
}

/// The symmetric matrix of six entries.
pub fn matrix([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> DMat3 {
    DMat3::from_cols_array(&[xx, xy, xz, xy, yy, yz, xz, yz, zz])
}

/// The six entries of a symmetric matrix.
pub fn entries(m: DMat3) -> [f64; 6] {
    let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis];
    let mean = |a: f64, b: f64| 0.5 * (a + b);
    [x.x, mean(x.y, y.x), mean(x.z, z.x), y.y, mean(y.z, z.y), z.z]
}
