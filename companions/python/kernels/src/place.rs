//! Frames that are fixed to bodies: what acts at one acts at its body.

use dynamics_core::glam::{DMat3, DVec3};
use robot_import::number::Attitude;

use crate::spec::{BodyRef, Six, Spec, Three};

/// A frame on a body: its origin and its rotation in the body's frame.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    body: usize,
    xyz: DVec3,
    rotation: DMat3,
}

impl Place {
    pub fn new(body: usize, xyz: Three, attitude: Attitude) -> Self {
        let [roll, pitch, yaw] = match attitude {
            Attitude::QuarterTurns(turns) => {
                turns.map(|turns| f64::from(turns) * core::f64::consts::FRAC_PI_2)
            }
            Attitude::Rpy(angles) => angles,
        };
        let rotation = DMat3::from_rotation_z(yaw)
            * DMat3::from_rotation_y(pitch)
            * DMat3::from_rotation_x(roll);
        Self { body, xyz: xyz.into(), rotation }
    }

    /// A point of the frame, in the body's.
    fn point(&self, point: Three) -> Three {
        (self.xyz + self.rotation * DVec3::from(point)).into()
    }

    /// A moment of inertia (xx, xy, xz, yy, yz, zz) along the axes of the frame, along the body's.
    fn inertia(&self, [xx, xy, xz, yy, yz, zz]: Six) -> Six {
        let own = DMat3::from_cols_array(&[xx, xy, xz, xy, yy, yz, xz, yz, zz]);
        let [x, y, z] = (self.rotation * own * self.rotation.transpose()).to_cols_array_2d();
        [x[0], x[1], x[2], y[1], y[2], z[2]]
    }

    /// A wrench at the origin of the frame and along its axes, at and along the body's.
    fn wrench(&self, [a, b, c, x, y, z]: Six) -> Six {
        let [couple, force] = [[a, b, c], [x, y, z]].map(|v| self.rotation * DVec3::from(v));
        let couple = couple + self.xyz.cross(force);
        [couple.x, couple.y, couple.z, force.x, force.y, force.z]
    }
}

impl Spec {
    /// The names of the bodies or frames at which it acts.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        let (one, points) = match self {
            Self::Payload { body, .. }
            | Self::BodyWrench { body, .. }
            | Self::WorldWrench { body, .. } => (Some(body), [].as_slice()),
            Self::Contact { points, .. } => (None, points.as_slice()),
            _ => (None, [].as_slice()),
        };
        let all = one.into_iter().chain(points.iter().map(|(body, _)| body));
        all.filter_map(|body| match body {
            BodyRef::Name(name) => Some(name.as_str()),
            _ => None,
        })
    }

    /// The same effect at the bodies of the frames that `find` finds by their names.
    #[must_use]
    pub fn at_bodies(&self, find: impl Fn(&str) -> Option<Place>) -> Self {
        let find = |on: &BodyRef| match on {
            BodyRef::Name(name) => find(name),
            _ => None,
        };
        let mut effect = self.clone();
        match &mut effect {
            Self::Payload { body, com, inertia, .. } => {
                if let Some(place) = find(body) {
                    *body = BodyRef::Number(place.body);
                    (*com, *inertia) = (place.point(*com), place.inertia(*inertia));
                }
            }
            Self::BodyWrench { body, wrench } => {
                if let Some(place) = find(body) {
                    (*body, *wrench) = (BodyRef::Number(place.body), place.wrench(*wrench));
                }
            }
            Self::WorldWrench { body, .. } => {
                if let Some(place) = find(body) {
                    *body = BodyRef::Point(place.body, place.xyz.into());
                }
            }
            Self::Contact { points, .. } => {
                for (body, point) in points {
                    if let Some(place) = find(body) {
                        (*body, *point) = (BodyRef::Number(place.body), place.point(*point));
                    }
                }
            }
            _ => {}
        }
        effect
    }
}
