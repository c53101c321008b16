//! The geometric Jacobian: the velocity of a body's frame per rate of each joint.
//!
//! Featherstone, RBDA (2008), section 4.1; axes and arms in base coordinates: z_j, z_j × (p − p_j).

use core::borrow::Borrow;
use core::marker::PhantomData;

use super::compile::{
    Compiled, CompiledJoint, CompiledRobot, JointAndBody, JointMotion, JointPair,
};
use super::displacement::Displacement;
use super::folding::Folded;
use super::folding::{Mat3, Vec3};
use super::{Engine, Specialised, only_if};
use crate::model::{JointCoordinate, Robot};
use crate::scalar::{Real, Vector};
use crate::spatial::Motion;
use crate::state::Configuration;
use crate::trig::Kernel;

impl<T, K> Engine<T, K> {
    /// The Jacobian J of the body of the number BODY with v = J q̇, by columns, one for each joint.
    ///
    /// ω in rad/s and the velocity in m/s of the origin of that body's frame, both along the axes of the base. τ = Jᵀ f
    /// for a force at that origin.
    ///
    /// # Cost
    /// `docs/costs.md` in the repository.
    ///
    /// # Source
    /// Featherstone, RBDA (2008), section 4.1.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Engine, robots::Ur5e};
    /// use dynamics_core::model::Robot;
    /// const WRIST: usize = Ur5e::MODEL.body("wrist_3");
    /// let j = Engine::<Ur5e>::jacobian::<WRIST, _, _, _, _>(&[0.0_f32, -1.2, 1.5, 0.3, 0.0, 0.0]);
    /// assert_eq!(j[0].ang.to_array(), [0.0, 0.0, 1.0]); // the first axis is vertical
    /// ```
    ///
    /// A body that the robot does not have does not compile:
    ///
    /// ```compile_fail,E0080
    /// use dynamics_core::{Engine, robots::Ur5e};
    /// let _ = Engine::<Ur5e>::jacobian::<6, _, _, _, _>(&[0.0_f32; 6]);
    /// // error: the Jacobian is of a body that the robot does not have: bodies are numbered from 0
    /// ```
    #[doc(alias = "end effector")]
    #[inline(never)]
    #[must_use]
    pub fn jacobian<const BODY: usize, R: Real, const B: usize, const Q: usize, const V: usize>(
        q: &impl Configuration<R, Q>,
    ) -> [Motion<R>; V]
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
    {
        let trig = q.trig_or(Specialised::<T, K, B, V>(PhantomData));
        columns::<R, CompiledRobot<T, B, Q, V>, B, Q, V, BODY>(&trig.borrow().coordinates)
    }
}

/// The columns of the joints that move the body; zero for others.
#[cfg_attr(not(debug_assertions), inline(always))]
fn columns<R: Real, C, const B: usize, const Q: usize, const V: usize, const BODY: usize>(
    turns: &[JointCoordinate<R>; Q],
) -> [Motion<R>; V]
where
    C: Compiled,
{
    const {
        assert!(
            BODY < B,
            "the Jacobian is of a body that the robot does not have: bodies are numbered from 0"
        );
    }
    let mut columns = [Motion::ZERO; V];
    for_each_joint!(J, {
        if const { CompiledJoint::<C, J>::IS_ON_BASE && JointAndBody::<C, J, BODY>::SUPPORTS }
            && let Some(reach) = const {
                only_if(
                    CompiledJoint::<C, J>::IS_ON_BASE && JointAndBody::<C, J, BODY>::SUPPORTS,
                    reach::<R, C, Q, V, BODY, J> as Reach<R, Q, V>,
                )
            }
        {
            let base = Mat3::constant(&glam::DMat3::IDENTITY);
            let _ = reach(turns, &base, &mut columns);
        }
    });
    columns
}

type Reach<R, const Q: usize, const V: usize> =
    fn(&[JointCoordinate<R>; Q], &Mat3<R>, &mut [Motion<R>; V]) -> Vec3<R>;

/// Writes the columns of joint I and of its descendants; returns the offset of the body's origin from the
/// parent's, in base coordinates, m. `parent` holds the axes of the parent's frame.
#[cfg_attr(not(debug_assertions), inline(always))]
fn reach<R: Real, C, const Q: usize, const V: usize, const BODY: usize, const I: usize>(
    turns: &[JointCoordinate<R>; Q],
    parent: &Mat3<R>,
    columns: &mut [Motion<R>; V],
) -> Vec3<R>
where
    C: Compiled,
{
    let joint = CompiledJoint::<C, I>::JOINT;
    let length = C::LENGTH;
    let rot = Mat3::constant(&joint.rot);
    let [x, y, z] = rot.0;
    let sides = Mat3([parent.mul(x), parent.mul(y), parent.mul(z)]);
    let at = Displacement::of::<C, Q, I>(turns);
    let axes = at.axes::<C, I>(&sides);
    let mut offset = parent.mul(Vec3::constant(joint.pos * length));
    if CompiledJoint::<C, I>::SHIFTS {
        offset = offset + at.along::<C, I>(&sides).scale(Folded::constant(length));
    }
    let mut beyond = Vec3::<R>::ZERO;
    if JointAndBody::<C, I, BODY>::IS_ON_JOINT {
        let place = JointAndBody::<C, I, BODY>::PLACE;
        beyond = axes.mul(Vec3::constant(place.pos * length));
    }
    for_each_joint!(J, {
        if const { JointPair::<C, I, J>::IS_PARENT && JointAndBody::<C, J, BODY>::SUPPORTS }
            && let Some(reach) = const {
                only_if(
                    JointPair::<C, I, J>::IS_PARENT && JointAndBody::<C, J, BODY>::SUPPORTS,
                    reach::<R, C, Q, V, BODY, J> as Reach<R, Q, V>,
                )
            }
        {
            beyond = reach(turns, &axes, columns);
        }
    });
    let axis = axes.0[joint.axis];
    columns[I] = if joint.prismatic {
        Motion::new(R::Vec3::ZERO, axis.get())
    } else if matches!(joint.motion, JointMotion::Screw) {
        let along = axis.scale(Folded::constant(joint.pitch * length));
        Motion::new(axis.get(), (axis.cross(beyond) + along).get())
    } else {
        Motion::new(axis.get(), axis.cross(beyond).get())
    };
    offset + beyond
}
