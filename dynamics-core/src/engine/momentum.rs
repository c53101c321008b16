//! p = M q̇ with Cᵀ q̇ or with β = Cᵀ q̇ − g − F, by one recursion over the bodies: velocities on
//! entering a joint, momenta and weights on returning.
//!
//! De Luca & Mattone (2003), over base parameters: they give the same kinetic energy for all q and
//! q̇, hence the same p = ∂T/∂q̇ and Cᵀ q̇ = ∂T/∂q. Masses are known zeros behind revolute joints.
//! The U of the field is zero: g and the wrenches of the environment come without products of
//! velocities.

use core::borrow::Borrow;

use super::acceleration_field::{AccelerationField, Inertia, Wrench, along_z};
use super::call::Call;
use super::compile::{Compiled, CompiledJoint, JointMotion, JointPair};
use super::displacement::Displacement;
use super::folding::{Folded, Vec3};
use super::joint_rates::{JointRates, SeveralRates, Twist};
use super::{Engine, loaded_again, only_if};
use crate::algorithms::{MomentumAndCoriolis, MomentumAndDrift};
use crate::effects::{Declared, Effect};
use crate::model::{JointCoordinate, Robot};
use crate::scalar::Real;
use crate::state::{Configuration, RobotState, State};
use crate::trig::Kernel;

impl<T, K> Engine<T, K> {
    /// The generalised momentum p = M q̇ and the transposed Coriolis product Cᵀ q̇, in joint
    /// coordinates, N·m·s and N·m, as [`crate::algorithms::momentum_and_coriolis`] computes them.
    ///
    /// Effects that change neither are ignored. Angles as in [`Engine::rnea`].
    ///
    /// # Cost
    /// `docs/costs.md` in the repository; the same instructions for all data.
    ///
    /// # Source
    /// De Luca & Mattone (2003); Haddadin, De Luca & Albu-Schäffer (2017), section V.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Core, Engine, robots::Ur5e, state::State};
    /// let state = State { qd: [0.5, -1.0, 2.0, 0.3, 0.0, 1.0], ..State::at([0.3_f64; 6]) };
    /// let (a, b) = (
    ///     Core::<Ur5e>::momentum_and_coriolis(&state, &()),
    ///     Engine::<Ur5e>::momentum_and_coriolis(&state, &()),
    /// );
    /// assert!((0..6).all(|i| (a.p[i] - b.p[i]).abs() < 1e-14 && (a.ct_qd[i] - b.ct_qd[i]).abs() < 1e-14));
    /// ```
    #[doc(alias = "momentum observer")]
    #[inline(never)]
    pub fn momentum_and_coriolis<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> MomentumAndCoriolis<R, V>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        let trig = state.configuration().trig_or(Self::trig_source());
        let trig = trig.borrow();
        let back = &loaded_again(&state, trig).coordinates;
        let MomentumAndDrift { p, beta } =
            Self::call(trig, effects).momenta::<false>(back, state.state());
        MomentumAndCoriolis { p, ct_qd: beta }
    }

    /// The generalised momentum p = M q̇ and its drift β = Cᵀ q̇ − g − F, N·m·s and N·m, as
    /// [`crate::algorithms::momentum_and_drift`] computes them.
    ///
    /// Angles as in [`Engine::rnea`].
    ///
    /// # Cost
    /// `docs/costs.md` in the repository, with the rest of an observer's tick, as `residual`; the
    /// same instructions for all data.
    ///
    /// # Source
    /// De Luca & Mattone (2003); Haddadin, De Luca & Albu-Schäffer (2017), section V.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::effects::{RIGID_BODY, Viscous};
    /// use dynamics_core::{Core, Engine, robots::Ur5e, state::State};
    /// let state = State { qd: [0.5, -1.0, 2.0, 0.3, 0.0, 1.0], ..State::at([0.3_f64; 6]) };
    /// let scene = (RIGID_BODY, Viscous([8.0; 6]));
    /// let (a, b) = (
    ///     Core::<Ur5e>::momentum_and_drift(&state, &scene),
    ///     Engine::<Ur5e>::momentum_and_drift(&state, &scene),
    /// );
    /// assert!((0..6).all(|i| (a.p[i] - b.p[i]).abs() < 1e-14 && (a.beta[i] - b.beta[i]).abs() < 1e-12));
    /// ```
    #[doc(alias = "momentum observer")]
    #[inline(never)]
    pub fn momentum_and_drift<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> MomentumAndDrift<R, V>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        let trig = state.configuration().trig_or(Self::trig_source());
        let trig = trig.borrow();
        let back = &loaded_again(&state, trig).coordinates;
        Self::call(trig, effects).momenta::<true>(back, state.state())
    }
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Call<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    /// The recursion of p and β, or of p and Cᵀ q̇ without DRIFT; `back` are the positions as they
    /// are loaded on returning.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn momenta<const DRIFT: bool>(
        self,
        back: &[JointCoordinate<R>; Q],
        state: &State<R, Q, V>,
    ) -> MomentumAndDrift<R, V> {
        // A constant, for the order of the sines: see `torques` of `rnea`.
        let mut result = const { MomentumAndDrift { p: [R::ZERO; V], beta: [R::ZERO; V] } };
        let mut base = self.unaccelerated();
        if !DRIFT {
            base.a = Vec3::ZERO;
        }
        let mut task = Task { call: self, back, state, result: &mut result };
        for_each_joint!(
            J,
            CompiledJoint::<T, J>::IS_ON_BASE,
            visit = Task::visit::<DRIFT, J> as fn(&mut _, &_) -> _,
            {
                visit(&mut task, &base);
            }
        );
        result
    }
}

/// The data that all bodies share.
struct Task<'a, R: Real, T, E, const B: usize, const Q: usize, const V: usize> {
    call: Call<'a, R, T, E, B, Q, V>,
    /// The positions of the call, loaded again on returning.
    back: &'a [JointCoordinate<R>; Q],
    state: &'a State<R, Q, V>,
    result: &'a mut MomentumAndDrift<R, V>,
}

/// The momentum of a body and its descendants, and the wrench that carries their weight less those
/// of the environment.
#[derive(Clone, Copy)]
struct MomentumAndLoad<R> {
    h: Wrench<R>,
    load: Wrench<R>,
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Task<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    /// Visits joint I and its descendants; returns what they carry about the origin of the parent,
    /// in its frame.
    #[cfg_attr(optimised, inline(always))]
    fn visit<const DRIFT: bool, const I: usize>(
        &mut self,
        parent: &AccelerationField<R>,
    ) -> MomentumAndLoad<R> {
        let at = self.call.displacement::<I>();
        let mut body = Self::across::<I>(parent, &at, &self.state.qd);
        if DRIFT && E::BODY_POSE {
            body.pose = parent.pose.transformed_by(&at);
        }

        let mut inner = MomentumAndLoad { h: Wrench::ZERO, load: Wrench::ZERO };
        for_each_joint!(
            J,
            JointPair::<T, I, J>::IS_CHILD,
            visit = Self::visit::<DRIFT, J> as fn(&mut _, &_) -> MomentumAndLoad<R>,
            {
                let child = visit(self, &body);
                inner = MomentumAndLoad { h: inner.h + child.h, load: inner.load + child.load };
            }
        );

        // After the children: until then the velocity takes fewer registers than the momentum
        // beside it.
        let own = self.call.inertia::<I>(E::BASE_MOTION);
        let h = momentum(&body, &own) + inner.h;
        let driven = self.call.felt::<I>(h, parent.omega);
        if CompiledJoint::<T, I>::COUNT == 1 {
            self.entries::<I>(&body, &driven);
        } else if let Some(entries) = const {
            only_if(
                CompiledJoint::<T, I>::COUNT > 1,
                Self::several_entries::<I> as fn(&mut _, &_, &_),
            )
        } {
            entries(self, &body, &driven);
        }
        let mut load = Wrench::ZERO;
        if DRIFT {
            load = body.wrench(&own);
            if E::WRENCH {
                load = self.call.environment::<I>(&body, load);
            }
            load = load + inner.load;
            if CompiledJoint::<T, I>::COUNT == 1 {
                self.hold::<I>(&load);
            } else if let Some(hold) = const {
                only_if(CompiledJoint::<T, I>::COUNT > 1, Self::hold_several::<I> as fn(&mut _, &_))
            } {
                hold(self, &load);
            }
        }
        let turn = self.back[CompiledJoint::<T, I>::Q];
        let at = at.with_turn(turn);
        let spin = self.call.coupling::<I>() * Folded::runtime(self.state.qd[I]);
        let h = self.call.borne(h, along_z(spin));
        MomentumAndLoad { h: h.to_parent(&at), load: load.to_parent(&at) }
    }

    /// The velocities of the body behind joint I.
    #[cfg_attr(optimised, inline(always))]
    fn across<const I: usize>(
        parent: &AccelerationField<R>,
        at: &Displacement<R, T, I>,
        qd: &[R; V],
    ) -> AccelerationField<R> {
        if CompiledJoint::<T, I>::COUNT > 1 {
            let rates = SeveralRates {
                velocity: Twist::of::<T, V, I>(qd, true),
                products: Twist::ZERO,
                accel: Twist::ZERO,
            };
            return parent.across_several(at, &rates);
        }
        let mut rates = JointRates {
            velocity: Folded::runtime(qd[I]),
            omega_products: Folded::ZERO,
            accel: Folded::ZERO,
        };
        if CompiledJoint::<T, I>::PRISMATIC {
            rates.velocity = rates.velocity * Folded::constant(T::LENGTH_INV);
        }
        parent.across(at, rates)
    }

    /// The entries of p and of Cᵀ q̇ of coordinate I, whose body moves as `body` and has with its
    /// descendants the momentum `h`.
    #[cfg_attr(optimised, inline(always))]
    fn entries<const I: usize>(&mut self, body: &AccelerationField<R>, h: &Wrench<R>) {
        let joint = CompiledJoint::<T, I>::JOINT;
        let length_inv = Folded::constant(T::LENGTH_INV);
        let mut p = h.along(joint, length_inv).get();
        if let Some(armature) = self.call.effects.inertia(I) {
            p += armature * self.state.qd[I];
        }
        self.result.p[I] = p;
        self.result.beta[I] = Self::rate::<I>(body, h).get();
    }

    /// The same of all coordinates of a joint.
    #[cfg_attr(optimised, inline(always))]
    fn several_entries<const I: usize>(&mut self, body: &AccelerationField<R>, h: &Wrench<R>) {
        for_each_joint!(
            K,
            JointPair::<T, I, K>::IS_COORDINATE,
            entries = Self::entries::<K> as fn(&mut _, &_, &_),
            {
                entries(self, body, h);
            }
        );
    }

    /// Subtracts from the entry of coordinate I what carries `load` and what the effects at the
    /// joint need.
    #[cfg_attr(optimised, inline(always))]
    fn hold<const I: usize>(&mut self, load: &Wrench<R>) {
        let length_inv = Folded::constant(T::LENGTH_INV);
        let at = self.call.joint_state::<I>(self.state);
        let mut held = load.along(CompiledJoint::<T, I>::JOINT, length_inv).get();
        self.call.effects.torque(I, at, &mut held);
        self.result.beta[I] -= held;
    }

    /// The same of all coordinates of a joint.
    #[cfg_attr(optimised, inline(always))]
    fn hold_several<const I: usize>(&mut self, load: &Wrench<R>) {
        for_each_joint!(
            K,
            JointPair::<T, I, K>::IS_COORDINATE,
            hold = Self::hold::<K> as fn(&mut _, &_),
            {
                hold(self, load);
            }
        );
    }

    /// The entry of Cᵀ q̇ of a coordinate: (v × S)ᵀ h = −Sᵀ (v ×* h).
    #[cfg_attr(optimised, inline(always))]
    fn rate<const I: usize>(body: &AccelerationField<R>, h: &Wrench<R>) -> Folded<R> {
        let length_inv = Folded::constant(T::LENGTH_INV);
        if matches!(CompiledJoint::<T, I>::MOTION, JointMotion::Turn | JointMotion::Slide) {
            let ([wx, wy, _], [vx, vy, _]) = (body.omega.0, body.v.0);
            let ([fx, fy, _], [nx, ny, _]) = (h.f.0, h.n.0);
            return if CompiledJoint::<T, I>::PRISMATIC {
                (wy * fx - wx * fy) * length_inv
            } else {
                wy * nx - wx * ny + (vy * fx - vx * fy)
            };
        }
        let back =
            Wrench { f: h.f.cross(body.omega), n: h.n.cross(body.omega) + h.f.cross(body.v) };
        back.along(CompiledJoint::<T, I>::JOINT, length_inv)
    }
}

/// The momentum I v of a body: m v + ω × h, and h × v + tr(Σ) ω − Σ ω.
#[cfg_attr(optimised, inline(always))]
pub(super) fn momentum<R: Real>(body: &AccelerationField<R>, inertia: &Inertia<R>) -> Wrench<R> {
    let (s, [wx, wy, wz]) = (&inertia.second, body.omega.0);
    let (xy, xz, yz) = (s.xx + s.yy, s.xx + s.zz, s.yy + s.zz);
    let spin = Vec3([
        yz * wx - s.xy * wy - s.xz * wz,
        xz * wy - s.xy * wx - s.yz * wz,
        xy * wz - s.xz * wx - s.yz * wy,
    ]);
    Wrench {
        f: body.v.scale(inertia.mass) + body.omega.cross(inertia.moment),
        n: inertia.moment.cross(body.v) + spin,
    }
}
