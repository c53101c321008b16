//! A robot's constants as the oracle's script reads them.

use dynamics_core::model::{BASE, JointKind, Link, Model};
use dynamics_core::spatial::{SpatialInertia, Xform};
use serde::{Deserialize, Serialize};

/// A robot in URDF's terms.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Robot {
    pub name: String,
    /// The bodies, parents first.
    pub bodies: Vec<Body>,
}

/// A body and the joint that carries it.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Body {
    pub name: String,
    /// Index of the parent; −1 is the base.
    pub parent: i64,
    /// The joint's kind in small letters.
    pub joint: String,
    /// The joint's unit axis in the body's frame, a universal joint's first one at q = 0; zero if
    /// it has none.
    pub axis: [f64; 3],
    /// A universal joint's second unit axis in the body's frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis2: Option<[f64; 3]>,
    /// A helical joint's slide per turn, m/rad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pitch: Option<f64>,
    /// The joint's frame in the parent's.
    pub placement: Placement,
    /// kg
    pub mass: f64,
    /// Centre of mass in the body's frame, m.
    pub com: [f64; 3],
    /// About the centre of mass: xx, xy, xz, yy, yz, zz, kg m².
    pub inertia_com: [f64; 6],
}

/// x_parent = R x + p.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Placement {
    /// R by rows.
    pub rotation: [f64; 9],
    /// p, m.
    pub position: [f64; 3],
}

/// The robot's f64 numbers as they stand in the library.
pub fn robot<const B: usize, const Q: usize, const V: usize>(model: &Model<f64, B, Q, V>) -> Robot {
    Robot {
        name: model.name.into(),
        bodies: (0..B).map(|i| body(&model.links[i], model.in_link_frame(i))).collect(),
    }
}

fn body(link: &Link<f64>, (placement, inertia): (Xform<f64>, SpatialInertia<f64>)) -> Body {
    let (joint, kind) = (&link.joint, link.joint.kind);
    let universal = kind == JointKind::Universal;
    let com =
        if inertia.mass > 0.0 { inertia.first_moment / inertia.mass } else { inertia.first_moment };
    let about_origin = inertia.rotational.to_cols_array_2d();
    let c = com.to_array().map(|x| x + 0.0); // no negative zero
    let about_com = |i: usize, j: usize| {
        let diagonal = if i == j { com.dot(com) } else { 0.0 };
        about_origin[i][j] - inertia.mass * (diagonal - c[i] * c[j])
    };
    Body {
        name: link.name.into(),
        parent: if link.parent == BASE { -1 } else { link.parent as i64 },
        joint: format!("{kind:?}").to_lowercase(),
        axis: if universal { joint.first_axis } else { joint.axis }.to_array(),
        axis2: universal.then(|| joint.axis.to_array()),
        pitch: (kind == JointKind::Helical).then_some(joint.pitch),
        placement: Placement {
            // The columns of the transform of coordinates are the rows of its inverse.
            rotation: placement.rot.to_cols_array(),
            position: placement.pos.to_array(),
        },
        mass: inertia.mass,
        com: c,
        inertia_com: [
            about_com(0, 0),
            about_com(0, 1),
            about_com(0, 2),
            about_com(1, 1),
            about_com(1, 2),
            about_com(2, 2),
        ],
    }
}
