//! A robot: a tree of rigid bodies, each carried by one joint.
//!
//! Bodies are listed so that a parent comes before its children; link frames, joint axes and
//! placements follow URDF. A robot is written once, as a `const` in f64, checked while compiling,
//! and cast to f32 by [`Model::to_f32`]:
//!
//! ```
//! use dynamics_core::model::{Arm, BASE, Body, Joint, Model, Robot};
//!
//! /// A pendulum: 2 kg on 0.5 m.
//! struct Pendulum;
//! impl Robot<1, 1, 1> for Pendulum {
//!     const MODEL: Arm<f64, 1> = Model::new("pendulum", [
//!         Body::new("rod", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(2.0).com([0.0, 0.0, -0.5]),
//!     ]);
//! }
//! assert_eq!(Pendulum::MODEL.links[0].inertia.mass, 2.0);
//! ```
//!
//! A description that cannot be does not compile; the message names the body. This one can be,
//!
//! ```
//! use dynamics_core::model::{Arm, BASE, Body, Joint, Model};
//! const ARM: Arm<f64, 2> = Model::new("arm", [
//!     Body::new("root", BASE, Joint::revolute([0.0, 0.0, 1.0])).mass(2.0),
//!     Body::new("tip", 0, Joint::revolute([0.0, 1.0, 0.0])).mass(1.0),
//! ]);
//! const _: usize = ARM.links.len();
//! ```
//!
//! and the same with a parent that is not listed before its child, a zero axis or a negative mass
//! cannot:
//!
//! ```compile_fail,E0080
//! use dynamics_core::model::{Arm, BASE, Body, Joint, Model};
//! const ARM: Arm<f64, 2> = Model::new("arm", [
//!     Body::new("root", BASE, Joint::revolute([0.0, 0.0, 1.0])).mass(2.0),
//!     Body::new("tip", 1, Joint::revolute([0.0, 1.0, 0.0])).mass(1.0),
//! ]); // error: body `tip`: its parent is not listed before it
//! const _: usize = ARM.links.len();
//! ```
//!
//! ```compile_fail,E0080
//! use dynamics_core::model::{Arm, BASE, Body, Joint, Model};
//! const ARM: Arm<f64, 2> = Model::new("arm", [
//!     Body::new("root", BASE, Joint::revolute([0.0, 0.0, 1.0])).mass(2.0),
//!     Body::new("tip", 0, Joint::revolute([0.0, 0.0, 0.0])).mass(1.0),
//! ]); // error: body `tip`: its joint axis is zero or not finite
//! const _: usize = ARM.links.len();
//! ```
//!
//! ```compile_fail,E0080
//! use dynamics_core::model::{Arm, BASE, Body, Joint, Model};
//! const ARM: Arm<f64, 2> = Model::new("arm", [
//!     Body::new("root", BASE, Joint::revolute([0.0, 0.0, 1.0])).mass(2.0),
//!     Body::new("tip", 0, Joint::revolute([0.0, 1.0, 0.0])).mass(-1.0),
//! ]); // error: body `tip`: its mass is negative or not finite
//! const _: usize = ARM.links.len();
//! ```

mod body;
mod error;
mod joint;

pub use body::{BASE, Body, Limits};
pub use error::{ModelError, Problem};
pub use joint::{Joint, JointKind, Turn};

use crate::const_math::{self as m, add, dot, scale, vec3};
use crate::scalar::Real;
use crate::spatial::{SpatialInertia, Xform};
use glam::{DMat3, DVec3, Mat3, Vec3};

/// One body with the joint that carries it, as the algorithms use it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link<R: Real> {
    /// The body's name.
    pub name: &'static str,
    /// Index λ(i) of the parent in the model's list, or [`BASE`].
    pub parent: usize,
    /// The joint between parent and body.
    pub joint: Joint<R>,
    /// ᵀX: from the parent's frame to the joint's frame at q = 0.
    pub placement: Xform<R>,
    /// The body's inertia at the origin of its own frame.
    pub inertia: SpatialInertia<R>,
    /// Where the joint's position stands in q; [`BASE`] if it has none.
    pub q_at: usize,
    /// Where the joint's velocity stands in q̇; [`BASE`] if it has none.
    pub v_at: usize,
    /// The joint's limits.
    pub limits: Limits<R>,
}

/// A robot of B bodies, Q position and V velocity coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Model<R: Real, const B: usize, const Q: usize, const V: usize> {
    /// The robot's name.
    pub name: &'static str,
    /// The bodies, parents first.
    pub links: [Link<R>; B],
}

/// A robot of N bodies on N joints of one degree of freedom.
pub type Arm<R, const N: usize> = Model<R, N, N, N>;

/// A robot known at compile time.
pub trait Robot<const B: usize, const Q: usize, const V: usize> {
    /// The robot's description, in f64.
    const MODEL: Model<f64, B, Q, V>;
    /// The same, rounded to f32.
    const MODEL_F32: Model<f32, B, Q, V> = Self::MODEL.to_f32();
}

/// The model of a robot known at compile time, in the scalar R.
///
/// ```
/// use dynamics_core::{model::model, robots::Ur5e};
/// assert_eq!(model::<f32, Ur5e, 6, 6, 6>().links[1].name, "upper_arm");
/// ```
#[inline(always)]
pub fn model<R: Real, T, const B: usize, const Q: usize, const V: usize>()
-> &'static Model<R, B, Q, V>
where
    T: Robot<B, Q, V>,
{
    R::pick(const { &T::MODEL }, const { &T::MODEL_F32 })
}

impl<const B: usize, const Q: usize, const V: usize> Model<f64, B, Q, V> {
    /// A model from its bodies; a description that cannot be does not compile.
    ///
    /// # Panics
    /// As [`Model::try_new`] errs, with the body's name. Meant for `const` items, where a panic
    /// is a compile error; for descriptions that come at run time use `try_new`.
    pub const fn new(name: &'static str, bodies: [Body; B]) -> Self {
        match Self::try_new(name, bodies) {
            Ok(model) => model,
            Err(error) => error.panic(),
        }
    }

    /// A model from its bodies.
    ///
    /// # Errors
    /// [`ModelError`] names the body: parent not listed before it, zero or non-finite axis,
    /// negative or non-finite mass, other non-finite numbers, limits that are NaN or exclude each
    /// other, or Q or V that the joints do not add up to.
    pub const fn try_new(name: &'static str, bodies: [Body; B]) -> Result<Self, ModelError> {
        let mut links = [EMPTY; B];
        let (mut q_at, mut v_at, mut i) = (0, 0, 0);
        while i < B {
            let body = &bodies[i];
            if let Some(problem) = body.problem(i) {
                return Err(ModelError {
                    body: body.name,
                    problem,
                });
            }
            let (nq, nv) = body.joint.kind.coordinates();
            links[i] = Link {
                name: body.name,
                parent: body.parent,
                joint: body.joint.normalised(),
                placement: Xform {
                    rot: m::transpose(&body.rotation),
                    pos: vec3(body.position),
                },
                inertia: at_origin(body),
                q_at: if nq == 0 { BASE } else { q_at },
                v_at: if nv == 0 { BASE } else { v_at },
                limits: body.limits,
            };
            q_at += nq;
            v_at += nv;
            i += 1;
        }
        if q_at != Q || v_at != V {
            return Err(ModelError {
                body: name,
                problem: Problem::Coordinates,
            });
        }
        Ok(Self { name, links })
    }

    /// The same robot in f32, each number rounded to nearest.
    pub const fn to_f32(&self) -> Model<f32, B, Q, V> {
        let mut links = [EMPTY.single(); B];
        let mut i = 0;
        while i < B {
            links[i] = self.links[i].single();
            i += 1;
        }
        Model {
            name: self.name,
            links,
        }
    }

    /// Whether every inertia could be that of a body: principal moments (about the centre of
    /// mass) that are not negative and obey the triangle inequality within `relative`.
    ///
    /// Published robots break it (PUMA 560) or pass by a hair (Panda), and have to run all the
    /// same: hence a check, not a condition.
    ///
    /// # Errors
    /// [`Problem::Triangle`] with the body's name and the amount by which the largest moment
    /// exceeds the sum of the others, relative to that moment.
    pub fn check(&self, relative: f64) -> Result<(), ModelError> {
        for link in &self.links {
            let excess = body::triangle_excess(&link.inertia);
            if excess > relative || excess.is_nan() {
                return Err(ModelError {
                    body: link.name,
                    problem: Problem::Triangle(excess),
                });
            }
        }
        Ok(())
    }
}

const EMPTY: Link<f64> = Link {
    name: "",
    parent: BASE,
    joint: Joint::fixed(),
    placement: Xform {
        rot: DMat3::IDENTITY,
        pos: DVec3::ZERO,
    },
    inertia: SpatialInertia {
        mass: 0.0,
        moment: DVec3::ZERO,
        inertia: DMat3::ZERO,
    },
    q_at: BASE,
    v_at: BASE,
    limits: Limits::NONE,
};

/// The parallel-axis theorem, RBDA (2.63): Ī_O = Ī_C + m (c·c 1 − c cᵀ).
const fn at_origin(body: &Body) -> SpatialInertia<f64> {
    let (c, [xx, xy, xz, yy, yz, zz]) = (vec3(body.com), body.inertia);
    let cc = dot(c, c);
    SpatialInertia {
        mass: body.mass,
        moment: scale(c, body.mass),
        inertia: DMat3::from_cols(
            add(DVec3::new(xx, xy, xz), parallel(body.mass, DVec3::X, c, cc)),
            add(DVec3::new(xy, yy, yz), parallel(body.mass, DVec3::Y, c, cc)),
            add(DVec3::new(xz, yz, zz), parallel(body.mass, DVec3::Z, c, cc)),
        ),
    }
}

/// m (c·c e − c (c·e)), a column of the parallel-axis term.
const fn parallel(mass: f64, e: DVec3, c: DVec3, cc: f64) -> DVec3 {
    scale(add(scale(e, cc), scale(c, -dot(c, e))), mass)
}

impl Link<f64> {
    const fn single(&self) -> Link<f32> {
        Link {
            name: self.name,
            parent: self.parent,
            joint: Joint {
                kind: self.joint.kind,
                axis: single(self.joint.axis),
            },
            placement: Xform {
                rot: single_mat(&self.placement.rot),
                pos: single(self.placement.pos),
            },
            inertia: SpatialInertia {
                mass: self.inertia.mass as f32,
                moment: single(self.inertia.moment),
                inertia: single_mat(&self.inertia.inertia),
            },
            q_at: self.q_at,
            v_at: self.v_at,
            limits: Limits {
                lower: self.limits.lower as f32,
                upper: self.limits.upper as f32,
                velocity: self.limits.velocity as f32,
                torque: self.limits.torque as f32,
            },
        }
    }
}

const fn single(v: DVec3) -> Vec3 {
    Vec3::new(v.x as f32, v.y as f32, v.z as f32)
}

const fn single_mat(m: &DMat3) -> Mat3 {
    Mat3::from_cols(single(m.x_axis), single(m.y_axis), single(m.z_axis))
}
