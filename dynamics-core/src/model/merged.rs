//! A robot whose bodies on fixed joints are parts of the bodies that carry them.

use glam::{DMat3, DVec3};

use super::{BASE, EMPTY, JointKind, JointKinds, Link, Model, ModelError, Problem};
use crate::math::const_eval::{add, dot, mul, mul_vec, scale, transpose};
use crate::spatial::{SpatialInertia, Xform};

/// The frame of a body of the description in the merged robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MergedBody {
    /// The number of the body that carries it, itself if it moves; [`BASE`] if the base does.
    pub body: usize,
    /// From the frame of that body's description to its own; the identity if it moves.
    pub placement: Xform<f64>,
}

impl MergedBody {
    /// A point of the body's frame, in the frame of the body that carries it, m: where a contact of
    /// the one touches the other.
    pub fn point(&self, p: DVec3) -> DVec3 {
        self.placement.rot.transpose() * p + self.placement.pos
    }
}

/// A robot of M bodies, each on a joint that moves, and where it has the B bodies of another:
/// [`Model::merged`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Merged<const B: usize, const M: usize, const Q: usize, const V: usize> {
    /// The robot.
    pub model: Model<f64, M, Q, V>,
    /// The place of each body of the description.
    pub places: [MergedBody; B],
}

impl<const B: usize, const Q: usize, const V: usize> Model<f64, B, Q, V> {
    /// The number M of bodies on joints that move.
    pub const fn moving_bodies(&self) -> usize {
        let (mut count, mut i) = (0, 0);
        while i < B {
            count += !is_fixed(&self.links[i]) as usize;
            i += 1;
        }
        count
    }

    /// [`Model::try_merged`] for `const` items.
    ///
    /// # Panics
    /// As [`Model::try_merged`] has errors; in a `const` item that is a compile error.
    #[track_caller]
    pub const fn merged<const M: usize>(&self) -> Merged<B, M, Q, V> {
        match self.try_merged() {
            Ok(merged) => merged,
            Err(error) => error.panic(),
        }
    }

    /// The same robot with every body on a fixed joint as part of the body that carries it.
    ///
    /// The algorithms then visit M bodies in place of B, and have shorter forms if all joints turn.
    /// The [engine](crate::Engine) merges while compiling, and robots that are read from files are
    /// merged already. q, q̇ and τ are as before, and torques, inertia matrix and accelerations are
    /// the same but for rounding. Bodies keep their order, names and frames, but have other
    /// numbers, which effects must name: [`Merged::places`] has them by the numbers of the
    /// description.
    ///
    /// A body that is fixed to the base is not in the robot: it moves no joint, but mass, momentum
    /// and energy are without it.
    ///
    /// ```
    /// use dynamics_core::algorithms::{poses, rnea};
    /// use dynamics_core::effects::RIGID_BODY;
    /// use dynamics_core::{model::Robot, robots::A1, state::State};
    /// let merged = A1::MODEL.try_merged::<12>()?; // 16 bodies, of which four are feet on fixed joints
    /// let state = State { q: [0.3; 12], qd: [0.5; 12], qdd: [1.0; 12] };
    /// let (before, after) = (rnea(&A1::MODEL, &state, &RIGID_BODY), rnea(&merged.model, &state, &RIGID_BODY));
    /// assert!(before.iter().zip(after).all(|(a, b)| (a - b).abs() < 1e-13));
    ///
    /// let foot = A1::MODEL.body("FR_foot");
    /// let place = merged.places[foot];
    /// let calf = poses(&merged.model, &state.q)[place.body];
    /// let below = calf.point(place.placement.pos); // the foot's origin
    /// assert!((below - poses(&A1::MODEL, &state.q)[foot].pos).length() < 1e-15);
    /// # Ok::<(), dynamics_core::model::ModelError>(())
    /// ```
    ///
    /// A velocity, an acceleration or a column of the Jacobian in the frame of the carrying body
    /// goes to that of body i by `places[i].placement`, a wrench on body i by its `transpose_mul`
    /// to the carrying body.
    ///
    /// # Errors
    /// [`Problem::Bodies`] names the robot, if M is another number than [`Model::moving_bodies`];
    /// [`Problem::Parent`] names a body whose parent is not listed before it: the fields of a model
    /// can be changed after its check.
    ///
    /// # Source
    /// RBDA (2008), (2.66), of two bodies that are rigidly connected.
    #[doc(alias = "weld")]
    #[doc(alias = "lumped")]
    pub const fn try_merged<const M: usize>(&self) -> Result<Merged<B, M, Q, V>, ModelError> {
        let expected = self.moving_bodies();
        if expected != M {
            let given = M;
            return Err(ModelError {
                body: self.name,
                problem: Problem::Bodies { expected, given },
            });
        }
        let mut links = [EMPTY; M];
        let mut places = [ON_BASE; B];
        let (mut kinds, mut chain) = (JointKinds::NONE, true);
        let (mut count, mut i) = (0, 0);
        while i < B {
            let link = &self.links[i];
            if link.parent != BASE && link.parent >= i {
                return Err(ModelError { body: link.name, problem: Problem::Parent });
            }
            let carrier = if link.parent == BASE { ON_BASE } else { places[link.parent] };
            let placement = after(&link.placement, &carrier.placement);
            if is_fixed(link) {
                let body = carrier.body;
                places[i] = MergedBody { body, placement };
                if body != BASE {
                    links[body].inertia = with(&links[body].inertia, &link.inertia, &placement);
                }
            } else {
                links[count] = Link { parent: carrier.body, placement, ..*link };
                kinds = kinds.with(link.joint.kind);
                chain &= carrier.body == count.wrapping_sub(1);
                places[i].body = count;
                count += 1;
            }
            i += 1;
        }
        // From the aligned frames of the carrying bodies to those of their descriptions.
        i = 0;
        while i < B {
            let place = &mut places[i];
            if is_fixed(&self.links[i]) && place.body != BASE {
                let frame = links[place.body].to_joint_frame;
                place.placement.rot = mul(&place.placement.rot, &frame);
                place.placement.pos = mul_vec(&transpose(&frame), place.placement.pos);
            }
            i += 1;
        }
        let model = Model { name: self.name, links, lambda: self.lambda, kinds, chain };
        Ok(Merged { model, places })
    }
}

const ON_BASE: MergedBody =
    MergedBody { body: BASE, placement: Xform { rot: DMat3::IDENTITY, pos: DVec3::ZERO } };

const fn is_fixed(link: &Link<f64>) -> bool {
    matches!(link.joint.kind, JointKind::Fixed)
}

/// X X₁, RBDA table 2.6.
const fn after(x: &Xform<f64>, first: &Xform<f64>) -> Xform<f64> {
    Xform {
        rot: mul(&x.rot, &first.rot),
        pos: add(first.pos, mul_vec(&transpose(&first.rot), x.pos)),
    }
}

/// I + Xᵀ I₁ X, RBDA (2.66): with h = Eᵀ h₁ and w = h + m₁ r / 2, the rotational part is Eᵀ Ī₁ E +
/// 2 (r·w) 1 − r wᵀ − w rᵀ.
const fn with(
    body: &SpatialInertia<f64>,
    part: &SpatialInertia<f64>,
    x: &Xform<f64>,
) -> SpatialInertia<f64> {
    let (back, r) = (transpose(&x.rot), x.pos);
    let h = mul_vec(&back, part.first_moment);
    let w = add(h, scale(r, 0.5 * part.mass));
    let turned = mul(&mul(&back, &part.rotational), &x.rot);
    let (own, two) = (&body.rotational, 2.0 * dot(r, w));
    let x_axis = add(turned.x_axis, apart(DVec3::X, two, r, w));
    let y_axis = add(turned.y_axis, apart(DVec3::Y, two, r, w));
    let z_axis = add(turned.z_axis, apart(DVec3::Z, two, r, w));
    SpatialInertia {
        mass: body.mass + part.mass,
        first_moment: add(body.first_moment, add(h, scale(r, part.mass))),
        rotational: DMat3::from_cols(
            add(own.x_axis, x_axis),
            add(own.y_axis, y_axis),
            add(own.z_axis, z_axis),
        ),
    }
}

/// 2 (r·w) e − (r (w·e) + w (r·e)), a column of the parallel-axis theorem from any point to any
/// other.
const fn apart(e: DVec3, two: f64, r: DVec3, w: DVec3) -> DVec3 {
    let products = add(scale(r, dot(w, e)), scale(w, dot(r, e)));
    add(scale(e, two), scale(products, -1.0))
}
