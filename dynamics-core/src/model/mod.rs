//! A robot: a tree of rigid bodies, each on one joint.
//!
//! Bodies are listed so that a parent comes before its children; link frames, joint axes and
//! placements follow URDF. A robot is described once, as a `const` in f64, which is checked at
//! compile time and cast to f32 by [`Model::to_f32`]:
//!
//! ```
//! use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};
//!
//! /// A pendulum: 2 kg on 0.5 m.
//! struct Pendulum;
//! impl Robot<1, 1, 1> for Pendulum {
//!     const MODEL: ArmModel<f64, 1> = Model::new("pendulum", [
//!         Body::new("rod", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(2.0).com([0.0, 0.0, -0.5]),
//!     ]);
//! }
//! const _: ArmModel<f64, 1> = Pendulum::MODEL; // checked by `cargo check`, too
//! assert_eq!(Pendulum::MODEL.links[0].inertia.mass, 2.0);
//! ```
//!
//! An impossible description does not compile; the message names the body. The compiler evaluates a
//! trait's constant only where compiled code uses it: `cargo check` and clippy compile none, and a
//! library need not use its robot. The line `const _` above evaluates it at once; every robot
//! should have one, or a scene that is a constant
//! ([`Engine::scene_f32`](crate::Engine::scene_f32)), which evaluates it, too. This description
//! compiles,
//!
//! ```
//! use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
//! const ARM: ArmModel<f64, 2> = Model::new("arm", [
//!     Body::new("root", BASE, Joint::revolute([0.0, 0.0, 1.0])).mass(2.0),
//!     Body::new("tip", 0, Joint::revolute([0.0, 1.0, 0.0])).mass(1.0),
//! ]);
//! const _: usize = ARM.links.len();
//! ```
//!
//! but the same with a parent that is not listed before its child, a zero axis or a negative mass
//! does not:
//!
//! ```compile_fail,E0080
//! use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
//! const ARM: ArmModel<f64, 2> = Model::new("arm", [
//!     Body::new("root", BASE, Joint::revolute([0.0, 0.0, 1.0])).mass(2.0),
//!     Body::new("tip", 1, Joint::revolute([0.0, 1.0, 0.0])).mass(1.0),
//! ]); // error: body `tip`: its parent is not listed before it
//! const _: usize = ARM.links.len();
//! ```
//!
//! ```compile_fail,E0080
//! use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
//! const ARM: ArmModel<f64, 2> = Model::new("arm", [
//!     Body::new("root", BASE, Joint::revolute([0.0, 0.0, 1.0])).mass(2.0),
//!     Body::new("tip", 0, Joint::revolute([0.0, 0.0, 0.0])).mass(1.0),
//! ]); // error: body `tip`: its joint axis is zero or not finite
//! const _: usize = ARM.links.len();
//! ```
//!
//! ```compile_fail,E0080
//! use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
//! const ARM: ArmModel<f64, 2> = Model::new("arm", [
//!     Body::new("root", BASE, Joint::revolute([0.0, 0.0, 1.0])).mass(2.0),
//!     Body::new("tip", 0, Joint::revolute([0.0, 1.0, 0.0])).mass(-1.0),
//! ]); // error: body `tip`: its mass is negative or not finite
//! const _: usize = ARM.links.len();
//! ```

mod aligned;
mod body;
mod cast;
mod check;
mod error;
mod floating_base;
mod inertia;
mod joint;
mod joint_coordinate;
mod joint_kind;
mod joint_kinematics;
mod link_view;
mod merged;
mod named;
mod possible;
mod pruned;
mod robot;
mod source;

#[doc(hidden)]
pub use body::impossible;
pub use body::{BASE, Body, JointLimits};
pub(crate) use error::Text;
pub use error::{ModelError, Problem};
pub use floating_base::attach_to;
pub use inertia::BodyInertia;
pub use joint::Joint;
pub use joint_coordinate::JointCoordinate;
pub(crate) use joint_coordinate::{near_unit, rotation};
pub use joint_kind::{JointKind, JointKinds};
pub use link_view::LinkView;
pub use merged::{Merged, MergedBody};
pub use named::{Bodies, BodyNumber, OnBody};
pub use possible::ImpossibleInertia;
pub use pruned::Pruned;
pub use robot::{Arm, Robot, model};
pub use source::{AllRevolute, Calibrated, RevoluteChain, RobotModel, Static};

use self::aligned::{aligned, is_finite};
use crate::scalar::Real;
use crate::spatial::{SpatialInertia, Xform};
use glam::{DMat3, DVec3};

/// One body with the joint to its parent, as the algorithms use it: in an aligned frame, which has
/// the origin of the body's own frame, but whose z is the joint's axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link<R: Real> {
    /// The body's name.
    pub name: &'static str,
    /// Index λ(i) of the parent in the model's list, or [`BASE`].
    pub parent: usize,
    /// The joint between parent and body.
    pub joint: Joint<R>,
    /// Rotation of coordinates from the body's own frame, as described, to the aligned one.
    pub to_joint_frame: R::Mat3,
    /// ᵀX: from the parent's aligned frame to this one's at q = 0.
    pub placement: Xform<R>,
    /// The body's inertia at the origin, in the aligned frame.
    pub inertia: SpatialInertia<R>,
    /// Index of the joint's first position in q; [`BASE`] if it has none.
    pub idx_q: usize,
    /// Index of the joint's first velocity in q̇; [`BASE`] if it has none.
    pub idx_v: usize,
    /// The limits of the joint's coordinates.
    pub limits: JointLimits<R>,
}

impl Link<f64> {
    /// The greatest angle to which the engine computes this joint to its stated accuracy, rad, on
    /// either side of zero: 100 where the joint's limits lie within ±4π, 10⁴ elsewhere; none for a
    /// joint whose position is no angle.
    ///
    /// ```
    /// use dynamics_core::{model::Robot, robots::Ur5e};
    /// assert_eq!(Ur5e::MODEL.links[0].angle_range(), Some(100.0));
    /// ```
    pub const fn angle_range(&self) -> Option<f64> {
        match self.joint.kind {
            JointKind::Revolute | JointKind::Continuous if self.limits.within_two_turns() => {
                Some(100.0)
            }
            JointKind::Revolute | JointKind::Continuous => Some(1e4),
            _ => None,
        }
    }
}

/// A robot of B bodies, Q position and V velocity coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Model<R: Real, const B: usize, const Q: usize, const V: usize> {
    /// The robot's name.
    pub name: &'static str,
    /// The bodies, parents first.
    pub links: [Link<R>; B],
    /// λ of every velocity coordinate: the one before it, on its own joint or on the nearest joint
    /// that supports it; [`BASE`] for the first of a branch. RBDA (2008), section 6.5.
    pub lambda: [usize; V],
    /// The kinds of its joints.
    kinds: JointKinds,
    /// Whether the parent of every body is the one before it.
    chain: bool,
}

/// A robot of N bodies on N joints of one degree of freedom.
pub type ArmModel<R, const N: usize> = Model<R, N, N, N>;

impl<R: Real, const B: usize, const Q: usize, const V: usize> Model<R, B, Q, V> {
    /// The name of the body of each velocity coordinate.
    ///
    /// ```
    /// use dynamics_core::{model::Robot, robots::A1Leg};
    /// assert_eq!(A1Leg::MODEL.coordinate_names().len(), 3); // the foot is fixed
    /// ```
    pub fn coordinate_names(&self) -> [&'static str; V] {
        let mut names = [""; V];
        for link in &self.links {
            let (_, count) = link.joint.kind.coordinates();
            for name in names.iter_mut().skip(link.idx_v).take(count) {
                *name = link.name;
            }
        }
        names
    }

    /// The kinds of its joints.
    pub(crate) const fn kinds(&self) -> JointKinds {
        self.kinds
    }
}

impl<const B: usize, const Q: usize, const V: usize> Model<f64, B, Q, V> {
    /// A model from its bodies; an impossible description does not compile.
    ///
    /// # Panics
    /// If [`Model::try_new`] returns an error, with the body's name. Meant for `const` items, where
    /// a panic is a compile error; for descriptions at run time use `try_new`.
    #[track_caller]
    pub const fn new(name: &'static str, bodies: [Body; B]) -> Self {
        match Self::try_new(name, bodies) {
            Ok(model) => model,
            Err(error) => error.panic(),
        }
    }

    /// A model from its bodies.
    ///
    /// # Errors
    /// [`ModelError`] names the body: parent not listed before it, zero or non-finite axis, axes of
    /// a universal joint that are not at right angles, a pitch that is not finite, negative or
    /// non-finite mass, other non-finite numbers, roll, pitch or yaw beyond a whole turn, limits
    /// that are NaN or exclude each other; or the robot, with the Q and V of its joints.
    pub const fn try_new(name: &'static str, bodies: [Body; B]) -> Result<Self, ModelError> {
        let mut links = [EMPTY; B];
        let (mut lambda, mut kinds, mut chain) = ([BASE; V], JointKinds::NONE, true);
        let (mut idx_q, mut idx_v, mut i) = (0, 0, 0);
        while i < B {
            let body = &bodies[i];
            if let Some(problem) = body.problem(i) {
                return Err(ModelError { body: body.name, problem });
            }
            let (nq, nv) = body.joint.kind.coordinates();
            let mut link = aligned(body, &links);
            if !is_finite(&link) {
                return Err(ModelError { body: body.name, problem: Problem::NotFinite });
            }
            link.idx_q = if nq == 0 { BASE } else { idx_q };
            link.idx_v = if nv == 0 { BASE } else { idx_v };
            links[i] = link;
            kinds = kinds.with(link.joint.kind);
            chain &= body.parent == i.wrapping_sub(1);
            let (mut parent, mut k) = (last_coordinate(&links, body.parent), 0);
            while k < nv && idx_v + k < V {
                lambda[idx_v + k] = parent;
                parent = idx_v + k;
                k += 1;
            }
            idx_q += nq;
            idx_v += nv;
            i += 1;
        }
        if idx_q != Q || idx_v != V {
            return Err(ModelError {
                body: name,
                problem: Problem::Coordinates { expected: [idx_q, idx_v], given: [Q, V] },
            });
        }
        Ok(Self { name, links, lambda, kinds, chain })
    }

    /// The same tree with its links in another scalar, which the host's tools bring.
    #[doc(hidden)]
    pub fn in_scalar<R: Real>(&self, links: [Link<R>; B]) -> Model<R, B, Q, V> {
        Model { name: self.name, links, lambda: self.lambda, kinds: self.kinds, chain: self.chain }
    }

    /// Whether the parent of every body is the one before it.
    pub(crate) const fn is_chain(&self) -> bool {
        self.chain
    }

    /// Whether all joints turn, and each link [is placed by screws](LinkView::is_placed_by_screws).
    pub(crate) const fn has_screws(&self) -> bool {
        let (mut all, mut i) = (self.kinds.are_revolute(), 0);
        while i < B {
            let Xform { rot, pos } = &self.links[i].placement;
            let (x, y, z) = (rot.x_axis, rot.y_axis, rot.z_axis);
            all &=
                x.x > 0.0 && x.y == 0.0 && x.z == 0.0 && y.y * pos.y == 0.0 && z.y * pos.z == 0.0;
            i += 1;
        }
        all
    }

    /// Placement and inertia of link `i` in the frames of its description, as in a URDF; up to
    /// rounding where an axis is none of x, y, z.
    pub fn in_link_frame(&self, i: usize) -> (Xform<f64>, SpatialInertia<f64>) {
        let link = &self.links[i];
        let (back, parent) = match self.links.get(link.parent) {
            Some(parent) => (link.to_joint_frame.transpose(), parent.to_joint_frame),
            None => (link.to_joint_frame.transpose(), DMat3::IDENTITY),
        };
        let placement = Xform {
            rot: back * link.placement.rot * parent,
            pos: parent.transpose() * link.placement.pos,
        };
        let inertia = SpatialInertia {
            mass: link.inertia.mass,
            first_moment: back * link.inertia.first_moment,
            rotational: back * link.inertia.rotational * link.to_joint_frame,
        };
        (placement, inertia)
    }
}

const EMPTY: Link<f64> = Link {
    name: "",
    parent: BASE,
    joint: Joint::fixed(),
    to_joint_frame: DMat3::IDENTITY,
    placement: Xform { rot: DMat3::IDENTITY, pos: DVec3::ZERO },
    inertia: SpatialInertia { mass: 0.0, first_moment: DVec3::ZERO, rotational: DMat3::ZERO },
    idx_q: BASE,
    idx_v: BASE,
    limits: JointLimits::NONE,
};

/// The last velocity coordinate of the nearest joint with coordinates, from body `at` to the base.
const fn last_coordinate<const B: usize>(links: &[Link<f64>; B], mut at: usize) -> usize {
    while at != BASE {
        let (_, count) = links[at].joint.kind.coordinates();
        if count > 0 {
            return links[at].idx_v + count - 1;
        }
        at = links[at].parent;
    }
    BASE
}
