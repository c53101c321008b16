//! The geometric Jacobian: the velocity of a body's frame per rate of each joint.
//!
//! Featherstone, RBDA (2008), section 4.1; axes and arms in base coordinates: z_j, z_j × (p − p_j).

use core::borrow::Borrow;

use super::Engine;
use super::call::Call;
use super::compile::{Compiled, CompiledJoint, JointAndBody, JointMotion, JointPair};
use super::folding::Folded;
use super::folding::{Mat3, Vec3};
use crate::algorithms::Frame;
use crate::model::{OnBody, Robot};
use crate::scalar::{Real, Vector};
use crate::spatial::Motion;
use crate::state::Configuration;
use crate::trig::Kernel;

impl<T, K> Engine<T, K> {
    /// The geometric Jacobian J of a body in a [`Frame`] with v = J q̇, by columns, one for each
    /// coordinate, as [`crate::algorithms::jacobian`] computes it.
    ///
    /// ω in rad/s and velocity in m/s per rad/s or m/s; τ = Jᵀ f for a force in the same frame.
    ///
    /// # Cost
    /// `docs/costs.md` in the repository, in `LocalWorldAligned`; 30 flops a column more in
    /// `Local`, 9 in `World`.
    ///
    /// # Source
    /// Featherstone, RBDA (2008), section 4.1.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Engine, algorithms::frame, model::{OnBody, Robot}, robots::Ur5e};
    /// const WRIST: usize = Ur5e::MODEL.body("wrist_3");
    /// let q = [0.0_f32, -1.2, 1.5, 0.3, 0.0, 0.0];
    /// let j = Engine::<Ur5e>::jacobian(&q, OnBody::<WRIST>, frame::LocalWorldAligned);
    /// assert_eq!(j[0].ang.to_array(), [0.0, 0.0, 1.0]); // the first axis is vertical
    /// ```
    ///
    /// A body that the robot does not have does not compile:
    ///
    /// ```compile_fail,E0080
    /// use dynamics_core::{Engine, algorithms::frame, model::OnBody, robots::Ur5e};
    /// let _ = Engine::<Ur5e>::jacobian(&[0.0_f32; 6], OnBody::<6>, frame::World);
    /// // error: a named body is one that the robot does not have: bodies are numbered from 0
    /// ```
    #[doc(alias = "end effector")]
    #[doc(alias = "geometric Jacobian")]
    #[inline(never)]
    #[must_use]
    pub fn jacobian<
        R: Real,
        F: Frame,
        const BODY: usize,
        const B: usize,
        const Q: usize,
        const V: usize,
    >(
        q: &impl Configuration<R, Q>,
        body: OnBody<BODY>,
        frame: F,
    ) -> [Motion<R>; V]
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
    {
        let _ = body;
        let trig = q.trig_or(Self::trig_source());
        Self::call(trig.borrow(), &()).jacobian::<F, BODY>(frame)
    }
}

impl<R: Real, T: Compiled, E, const B: usize, const Q: usize, const V: usize>
    Call<'_, R, T, E, B, Q, V>
{
    /// The Jacobian of a body in the frame F.
    #[cfg_attr(optimised, inline(always))]
    fn jacobian<F: Frame, const BODY: usize>(self, frame: F) -> [Motion<R>; V] {
        let mut columns = self.jacobian_columns::<BODY>();
        let [pose] = self.poses(OnBody::<BODY>);
        for_each_joint!(J, {
            if JointAndBody::<T, J, BODY>::SUPPORTS {
                columns[J] = frame.express_aligned(&pose, columns[J]);
            }
        });
        columns
    }

    /// The columns of the joints that move the body; zero for others.
    #[cfg_attr(optimised, inline(always))]
    fn jacobian_columns<const BODY: usize>(self) -> [Motion<R>; V] {
        let mut columns = [Motion::ZERO; V];
        let base = Mat3::constant(&glam::DMat3::IDENTITY);
        for_each_joint!(
            J,
            const { CompiledJoint::<T, J>::IS_ON_BASE && JointAndBody::<T, J, BODY>::SUPPORTS },
            reach = Self::reach::<BODY, J> as fn(_, &_, &mut _) -> Vec3<R>,
            {
                let _ = reach(self, &base, &mut columns);
            }
        );
        columns
    }

    /// Writes the columns of joint I and of its descendants; returns the offset of the body's
    /// origin from the parent's, in base coordinates, m. `parent` holds the axes of the parent's
    /// frame.
    #[cfg_attr(optimised, inline(always))]
    fn reach<const BODY: usize, const I: usize>(
        self,
        parent: &Mat3<R>,
        columns: &mut [Motion<R>; V],
    ) -> Vec3<R> {
        let joint = CompiledJoint::<T, I>::JOINT;
        let length = T::LENGTH;
        let rot = Mat3::constant(&joint.rot);
        let [x, y, z] = rot.0;
        let sides = Mat3([parent.mul(x), parent.mul(y), parent.mul(z)]);
        let at = self.displacement::<I>();
        let axes = at.axes(&sides);
        let mut offset = parent.mul(Vec3::constant(joint.pos * length));
        if CompiledJoint::<T, I>::SHIFTS {
            offset = offset + at.along(&sides).scale(Folded::constant(length));
        }
        let mut beyond = Vec3::<R>::ZERO;
        if JointAndBody::<T, I, BODY>::IS_ON_JOINT {
            let place = JointAndBody::<T, I, BODY>::PLACE;
            beyond = axes.mul(Vec3::constant(place.pos * length));
        }
        for_each_joint!(
            J,
            const { JointPair::<T, I, J>::IS_PARENT && JointAndBody::<T, J, BODY>::SUPPORTS },
            reach = Self::reach::<BODY, J> as fn(_, &_, &mut _) -> Vec3<R>,
            {
                beyond = reach(self, &axes, columns);
            }
        );
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
}
