//! A free base that nothing holds: its velocity from the momentum, and inverse dynamics of the
//! joints that it carries.
//!
//! The composite inertia of all bodies at the base, as that of one rigid body, gives the base's
//! step from what is lacking: Umetani & Yoshida (1989) for velocities, Featherstone, RBDA (2008),
//! section 9.5 for accelerations, where a₀ = −(Iᶜ₀)⁻¹ f₀ and τᵢ = τᵢ(a₀ = 0) + Sᵢᵀ Iᶜᵢ ⁱX₀ a₀.

use core::borrow::Borrow;
use core::hint::black_box;
use core::marker::PhantomData;

use super::acceleration_field::Inertia;
use super::call::Call;
use super::compile::{Compiled, CompiledJoint, JointMotion, JointPair};
use super::folding::{Folded, Mat3, Vec3};
use super::{Engine, only_if};
use crate::algorithms::{JointResult, NotPositiveDefinite};
use crate::effects::{Declared, Effect, OfBodies};
use crate::model::Robot;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::inertia::CompositeInertia;
use crate::spatial::{Force, Motion, SpatialInertia};
use crate::state::{Configuration, RobotState};
use crate::trig::Kernel;

/// The number of velocity coordinates of a free base, which are the robot's first.
const BASE_RATES: usize = 6;

impl<T, K> Engine<T, K> {
    /// The velocity q̇ at which the total momentum of a floating robot is h, as
    /// [`crate::algorithms::base_velocity_from_momentum`] computes it.
    ///
    /// The rates of the first body are replaced; h is about the base's origin and along its axes,
    /// N·m·s and N·s. A robot whose first joint is not free does not compile:
    ///
    /// ```compile_fail,E0080
    /// use dynamics_core::{Engine, robots::Ur5e, spatial::Force, state::State};
    /// let _ = Engine::<Ur5e>::base_velocity_from_momentum(&State::at([0.0_f32; 6]), Force::ZERO, &());
    /// // error: the first joint of the robot is not free
    /// ```
    ///
    /// # Cost
    /// The cost of the momentum, and some 150 flops and 60 more for each joint.
    ///
    /// # Source
    /// Umetani & Yoshida (1989), section II.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::algorithms::momentum;
    /// use dynamics_core::{Engine, model::Robot, robots::A1Free, spatial::Force, state::State};
    /// let mut state = State { qd: [0.5_f64; 18], ..State::at([0.3; 19]) };
    /// (state.q[0], state.q[1], state.q[2], state.q[3]) = (0.5, 0.5, -0.5, 0.5);
    /// state.qd = Engine::<A1Free>::base_velocity_from_momentum(&state, Force::ZERO, &())?;
    /// let h = momentum(&A1Free::MODEL, &state, &());
    /// assert!(h.ang.length() < 1e-14 && h.lin.length() < 1e-14);
    /// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
    /// ```
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names the first coordinate if the bodies have no mass, or no inertia
    /// about some axis.
    #[doc(alias = "recoil")]
    #[inline(never)]
    pub fn base_velocity_from_momentum<R, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        h: Force<R>,
        effects: &E,
    ) -> Result<[R; V], NotPositiveDefinite>
    where
        R: Real,
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        const { FreeScene::<R, E, B, V>::TAKEN };
        let trig = state.configuration().trig_or(Self::trig_source());
        let (trig, state) = (trig.borrow(), state.state());
        let call = Self::call(trig, effects);
        let bodies = OfBodies(effects);
        let p = call.under(&bodies).momenta::<false>(call.turns, state).p;
        // One phase after the other: as one block they would need more registers than there are.
        let p = black_box(&p);
        let (all, _) = call.composite();
        let h = call.in_base(h);
        let mut qd = state.qd;
        step(&all, &(h - first(p)), &mut qd)?;
        Ok(qd)
    }

    /// The torques at which the joints accelerate as q̈ says while no force holds the free base,
    /// and the accelerations of all coordinates, those of the base included.
    ///
    /// The entries of the base in the state's q̈ are replaced. The result is that of
    /// [`crate::algorithms::hybrid_dynamics`] with the torque zero at the base and accelerations at
    /// the joints; rotor inertias of the base's coordinates are not read, where there is no motor.
    /// A robot whose first joint is not free does not compile.
    ///
    /// # Cost
    /// The cost of [`Engine::rnea`], and some 150 flops and 100 more for each joint.
    ///
    /// # Source
    /// Featherstone, RBDA (2008), section 9.5.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::effects::{Coriolis, Inertia};
    /// use dynamics_core::{Engine, robots::A1Free, state::State};
    /// let mut state = State { qdd: [1.0_f64; 18], ..State::at([0.3; 19]) };
    /// (state.q[0], state.q[1], state.q[2], state.q[3]) = (0.5, 0.5, -0.5, 0.5);
    /// let free = Engine::<A1Free>::free_base_inverse_dynamics(&state, &(Inertia, Coriolis))?;
    /// let tau = Engine::<A1Free>::rnea(&State { qdd: free.qdd, ..state }, &(Inertia, Coriolis));
    /// assert!((0..6).all(|k| tau[k].abs() < 1e-13)); // nothing holds the trunk
    /// assert!((6..18).all(|k| (tau[k] - free.tau[k]).abs() < 1e-13 && free.qdd[k] == 1.0));
    /// # Ok::<(), dynamics_core::algorithms::NotPositiveDefinite>(())
    /// ```
    ///
    /// # Errors
    /// [`NotPositiveDefinite`] names the first coordinate if the bodies have no mass, or no inertia
    /// about some axis.
    #[doc(alias = "floating base")]
    #[doc(alias = "hybrid dynamics")]
    #[inline(never)]
    pub fn free_base_inverse_dynamics<R, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> Result<JointResult<R, V>, NotPositiveDefinite>
    where
        R: Real,
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        const { FreeScene::<R, E, B, V>::TAKEN };
        let trig = state.configuration().trig_or(Self::trig_source());
        let (trig, state) = (trig.borrow(), state.state());
        let call = Self::call(trig, effects);
        let mut tau = call.torques(call.turns, state);
        black_box(&mut tau);
        let (all, columns) = call.composite();
        let columns = black_box(&columns);
        let mut qdd = state.qdd;
        let step = step(&all, &-first(&tau), &mut qdd)?;
        call.spread(columns, &step, &mut tau);
        for tau in tau.iter_mut().take(BASE_RATES) {
            *tau = R::ZERO;
        }
        Ok(JointResult { qdd, tau })
    }
}

/// A scene that a base which nothing holds may have.
struct FreeScene<R, E, const B: usize, const V: usize>(PhantomData<(R, E)>);

impl<R: Real, E: Effect<R, B, V>, const B: usize, const V: usize> FreeScene<R, E, B, V> {
    const TAKEN: () =
        assert!(!E::GYROSCOPIC_ROTORS, "no rotors that spin as bodies here; name `Armature`");
}

/// The force on the base whose components are the first coordinates.
#[cfg_attr(optimised, inline(always))]
fn first<R: Real, const V: usize>(tau: &[R; V]) -> Force<R> {
    Force::new(R::Vec3::new(tau[0], tau[1], tau[2]), R::Vec3::new(tau[3], tau[4], tau[5]))
}

/// The motion of the base that the force `lacking` gives all bodies, which is added to its rates.
#[cfg_attr(optimised, inline(always))]
fn step<R: Real, const V: usize>(
    all: &CompositeInertia<R>,
    lacking: &Force<R>,
    rates: &mut [R; V],
) -> Result<Motion<R>, NotPositiveDefinite> {
    let Some(step) = all.solve(*lacking) else {
        return Err(NotPositiveDefinite { joint: 0 });
    };
    let steps = step.ang.array().into_iter().chain(step.lin.array());
    for (rate, step) in rates.iter_mut().zip(steps) {
        *rate += step;
    }
    Ok(step)
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Call<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    /// A force about the origin of the base of the description and along its axes, in the frame of
    /// the free body.
    #[cfg_attr(optimised, inline(always))]
    fn in_base(self, h: Force<R>) -> Force<R> {
        let joint = CompiledJoint::<T, 0>::JOINT;
        let (rot, at) = (Mat3::constant(&joint.rot), self.displacement::<0>());
        let origin = Vec3::constant(joint.pos) + at.shift();
        let lin = Vec3::runtime(h.lin);
        let arm = origin.scale(Folded::constant(T::LENGTH));
        let ang = Vec3::runtime(h.ang) - arm.cross(lin);
        Force::new(at.enter(&rot, ang).get(), at.enter(&rot, lin).get())
    }

    /// The composite inertia of the free body and its descendants in its own frame, and the columns
    /// of the descendants.
    #[cfg_attr(optimised, inline(always))]
    fn composite(self) -> (CompositeInertia<R>, Columns<R, V>) {
        const {
            assert!(
                matches!(CompiledJoint::<T, 0>::MOTION, JointMotion::Free),
                "the first joint of the robot is not free"
            );
        }
        let mut columns = [[R::ZERO; 6]; V];
        let all = self.with_descendants::<0>(&mut columns);
        let length_inv = Folded::constant(T::LENGTH_INV);
        let s = all.second;
        let [x, y, z] = [
            Vec3([s.yy + s.zz, -s.xy, -s.xz]),
            Vec3([-s.xy, s.xx + s.zz, -s.yz]),
            Vec3([-s.xz, -s.yz, s.xx + s.yy]),
        ]
        .map(Vec3::get);
        let body = SpatialInertia {
            mass: (all.mass * length_inv * length_inv).get(),
            first_moment: all.moment.scale(length_inv).get(),
            rotational: R::Mat3::from_cols(x, y, z),
        };
        (body.into(), columns)
    }

    /// The inertia of the body behind joint I and of its descendants, in its frame.
    #[cfg_attr(optimised, inline(always))]
    fn with_descendants<const I: usize>(self, columns: &mut Columns<R, V>) -> Inertia<R> {
        let mut body = self.inertia::<I>(false);
        for_each_joint!(
            J,
            JointPair::<T, I, J>::IS_CHILD,
            child = Self::at_parent::<J> as fn(_, &mut _) -> _,
            {
                body = body + child(self, columns);
            }
        );
        body
    }

    /// The same in the frame of the parent; writes the joint's columns.
    #[cfg_attr(optimised, inline(always))]
    fn at_parent<const I: usize>(self, columns: &mut Columns<R, V>) -> Inertia<R> {
        let body = self.with_descendants::<I>(columns);
        for_each_joint!(K, {
            if JointPair::<T, I, K>::IS_COORDINATE {
                let length_inv = Folded::constant(T::LENGTH_INV);
                let wrench = body.wrench_of(CompiledJoint::<T, K>::JOINT, length_inv);
                let ([nx, ny, nz], [fx, fy, fz]) = (wrench.n.0, wrench.f.0);
                columns[K] = [nx.get(), ny.get(), nz.get(), fx.get(), fy.get(), fz.get()];
            }
        });
        body.to_parent(&self.displacement::<I>())
    }

    /// Adds to the torques what the joints of the descendants need for an acceleration of the base.
    #[cfg_attr(optimised, inline(always))]
    fn spread(self, columns: &Columns<R, V>, step: &Motion<R>, tau: &mut [R; V]) {
        let length_inv = Folded::constant(T::LENGTH_INV);
        let alpha = Vec3::runtime(step.ang);
        let a = Vec3::runtime(step.lin).scale(length_inv);
        self.to_children::<0>(columns, [alpha, a], tau);
    }

    /// α and a of the body behind joint I reach its children.
    #[cfg_attr(optimised, inline(always))]
    fn to_children<const I: usize>(
        self,
        columns: &Columns<R, V>,
        motion: [Vec3<R>; 2],
        tau: &mut [R; V],
    ) {
        for_each_joint!(J, {
            if JointPair::<T, I, J>::IS_CHILD
                && let Some(outward) = const {
                    only_if(
                        JointPair::<T, I, J>::IS_CHILD,
                        Self::outward::<J> as fn(_, &_, _, &mut _),
                    )
                }
            {
                outward(self, columns, motion, tau);
            }
        });
    }

    /// Joint I and its descendants, from α and a of the parent.
    #[cfg_attr(optimised, inline(always))]
    fn outward<const I: usize>(
        self,
        columns: &Columns<R, V>,
        [alpha, a]: [Vec3<R>; 2],
        tau: &mut [R; V],
    ) {
        let joint = CompiledJoint::<T, I>::JOINT;
        let (rot, mut p) = (Mat3::constant(&joint.rot), Vec3::constant(joint.pos));
        let at = self.displacement::<I>();
        if CompiledJoint::<T, I>::SHIFTS {
            p = p + at.shift();
        }
        let motion = [at.enter(&rot, alpha), at.enter(&rot, a + alpha.cross(p))];
        for_each_joint!(K, {
            if JointPair::<T, I, K>::IS_COORDINATE {
                let [nx, ny, nz, fx, fy, mut fz] = columns[K].map(Folded::runtime);
                if CompiledJoint::<T, K>::IS_TURN {
                    fz = Folded::ZERO;
                }
                let load = Vec3([nx, ny, nz]).dot(motion[0]) + Vec3([fx, fy, fz]).dot(motion[1]);
                tau[K] += load.get();
            }
        });
        self.to_children::<I>(columns, motion, tau);
    }
}

/// The wrenches Iᶜ S of unit accelerations, in the frames of their bodies: couple and force.
type Columns<R, const V: usize> = [[R; 6]; V];
