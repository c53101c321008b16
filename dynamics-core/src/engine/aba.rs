//! Forward dynamics by articulated bodies.
//!
//! Featherstone (1983); RBDA (2008), table 7.1, in two steps: the recursion of [`super::rnea`]
//! subtracts the bias from the torques, and the remaining torques accelerate a robot at rest
//! without gravity, so that the articulated bodies need neither velocities nor velocity products.

use core::borrow::Borrow;
use core::hint::black_box;
use core::marker::PhantomData;

use super::acceleration_field::{Inertia, Wrench};
use super::articulated_inertia::Articulated;
use super::call::Call;
use super::compile::{Compiled, CompiledJoint, CompiledRobot, JointMotion, JointPair};
use super::folding::Folded;
use super::folding::{Mat3, Vec3};
use super::pivot_noise::Singular;
use super::{Engine, only_if};
use crate::algorithms::NotPositiveDefinite;
use crate::effects::{Declared, Effect, add_inertia};
use crate::model::{BASE, Robot};
use crate::scalar::{Real, Vector};
use crate::state::{Configuration, RobotState, State};
use crate::trig::Kernel;

impl<T, K> Engine<T, K> {
    /// The acceleration of each joint, q̈ = FD(q, q̇, τ), as by [`Engine::forward_dynamics`], with
    /// articulated bodies.
    ///
    /// `state.qdd` is not read.
    ///
    /// # Cost
    /// O(V), but more than that of M and its factors on short chains: `docs/costs.md` in the
    /// repository. [`Engine::forward_dynamics`] takes the cheaper one.
    ///
    /// # Source
    /// Featherstone (1983); RBDA (2008), table 7.1.
    ///
    /// # Errors
    /// As [`Engine::forward_dynamics`].
    #[doc(alias = "ABI")]
    #[doc(alias = "FD")]
    #[inline(never)]
    pub fn aba<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        tau: &[R; V],
        effects: &E,
    ) -> Result<[R; V], NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        const {
            assert!(
                !E::GYROSCOPIC_ROTORS,
                "the engine's articulated bodies carry no rotors that spin as bodies; use `forward_dynamics`"
            )
        };
        let trig = state.configuration().trig_or(Self::trig_source());
        let call = Call {
            turns: &trig.borrow().coordinates,
            effects,
            robot: PhantomData::<CompiledRobot<T, B, Q, V>>,
        };
        call.accelerations_by_bodies(state.state(), tau)
    }
}

/// The results of the inward pass for the outward pass.
struct Task<'a, R: Real, T, E, const B: usize, const Q: usize, const V: usize> {
    call: Call<'a, R, T, E, B, Q, V>,
    /// U = Iᴬ S: couple and force.
    u: &'a mut [[R; 6]; V],
    d_inv: &'a mut [R; V],
    singular: Singular,
    /// The torques without the bias forces of the descendants; then the accelerations.
    x: &'a mut [R; V],
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Call<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn accelerations_by_bodies(
        self,
        state: &State<R, Q, V>,
        tau: &[R; V],
    ) -> Result<[R; V], NotPositiveDefinite> {
        // One phase after the other: as one block they would need more registers than there are.
        let mut x = self.remaining(state, tau);
        black_box(&mut x);
        let (mut u, mut d_inv) = ([[R::ZERO; 6]; V], [R::ZERO; V]);
        let mut task = Task {
            call: self,
            u: &mut u,
            d_inv: &mut d_inv,
            singular: Singular::default(),
            x: &mut x,
        };
        for_each_joint!(
            J,
            CompiledJoint::<T, J>::IS_ON_BASE,
            inward = Task::inward::<J> as fn(&mut _) -> _,
            {
                let _ = inward(&mut task);
            }
        );
        task.singular.outermost()?;
        for_each_joint!(
            J,
            CompiledJoint::<T, J>::IS_ON_BASE,
            outward = Task::outward::<J> as fn(&mut _, _),
            {
                outward(&mut task, [R::Vec3::ZERO; 2]);
            }
        );
        Ok(x)
    }
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Task<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    /// The inward pass: the articulated inertia of joint I and its bias force, in the parent's
    /// frame.
    #[cfg_attr(optimised, inline(always))]
    fn inward<const I: usize>(&mut self) -> (Articulated<R>, Wrench<R>) {
        let joint = CompiledJoint::<T, I>::JOINT;
        let length_inv = Folded::constant(T::LENGTH_INV);
        let mut ia = Articulated::of(&Inertia::NONE);
        if let Some(inertia) =
            const { only_if(CompiledJoint::<T, I>::LAST == I, Call::inertia::<I> as fn(_, _) -> _) }
        {
            ia = Articulated::of(&inertia(self.call, false));
        }
        let mut push = Wrench { f: Vec3::ZERO, n: Vec3::ZERO };
        for_each_joint!(
            J,
            JointPair::<T, I, J>::IS_PARENT,
            inward = Self::inward::<J> as fn(&mut _) -> (Articulated<R>, Wrench<R>),
            {
                let (inertia, wrench) = inward(self);
                ia = ia + inertia;
                push = Wrench { f: push.f + wrench.f, n: push.n + wrench.n };
            }
        );
        let own = ia.wrench_of(joint, length_inv);
        let (n, f) = (own.n, own.f);
        let mut d = own.along(joint, length_inv).get();
        add_inertia(self.call.effects, I, &mut d);
        let noise = self.call.pivot_noise::<I>();
        self.singular.note::<R, I>(d, noise);
        let d_inv = R::ONE / d;
        let rest = Folded::runtime(self.x[I]) - push.along(joint, length_inv);
        let ([nx, ny, nz], [fx, fy, fz]) = (n.0, f.0);
        self.u[I] = [nx.get(), ny.get(), nz.get(), fx.get(), fy.get(), fz.get()];
        self.d_inv[I] = d_inv;
        self.x[I] = rest.get();

        let gain = rest * Folded::runtime(d_inv);
        push = Wrench { f: push.f + f.scale(gain), n: push.n + n.scale(gain) };
        let at = self.call.displacement::<I>();
        (ia.minus_joint(n, f, Folded::runtime(d_inv)).to_parent(&at), push.to_parent(&at))
    }

    /// The outward pass: the acceleration of joint I, from its parent's α and a.
    #[cfg_attr(optimised, inline(always))]
    fn outward<const I: usize>(&mut self, [alpha, a]: [R::Vec3; 2]) {
        let joint = CompiledJoint::<T, I>::JOINT;
        let length_inv = Folded::constant(T::LENGTH_INV);
        let (rot, mut p) = (Mat3::constant(&joint.rot), Vec3::constant(joint.pos));
        let at = self.call.displacement::<I>();
        if CompiledJoint::<T, I>::SHIFTS {
            p = p + at.shift();
        }
        // Plain numbers: what is known of them ends with the first joints, which are at rest.
        let (mut alpha, mut a) = if joint.parent == BASE {
            (Vec3::ZERO, Vec3::ZERO)
        } else {
            (Vec3::runtime(alpha), Vec3::runtime(a))
        };
        (alpha, a) = (at.enter(&rot, alpha), at.enter(&rot, a + alpha.cross(p)));
        let [nx, ny, nz, fx, fy, fz] = self.u[I].map(Folded::runtime);
        let lost = Vec3([nx, ny, nz]).dot(alpha) + Vec3([fx, fy, fz]).dot(a);
        let qdd = (Folded::runtime(self.x[I]) - lost) * Folded::runtime(self.d_inv[I]);
        self.x[I] = qdd.get();
        if joint.prismatic {
            a.0[joint.axis] = a.0[joint.axis] + qdd * length_inv;
        } else {
            alpha.0[joint.axis] = alpha.0[joint.axis] + qdd;
        }
        if matches!(joint.motion, JointMotion::Screw) {
            a.0[2] = a.0[2] + qdd * Folded::constant(joint.pitch);
        }
        for_each_joint!(
            J,
            JointPair::<T, I, J>::IS_PARENT,
            outward = Self::outward::<J> as fn(&mut _, _),
            {
                outward(self, [alpha.get(), a.get()]);
            }
        );
    }
}
