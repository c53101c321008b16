//! p = M q̇ with Cᵀ q̇ or with β = Cᵀ q̇ − g − F, by one recursion over the bodies: velocities on entering a joint, momenta and
//! weights on returning.
//!
//! De Luca & Mattone (2003), over base parameters: they give the same kinetic energy for all q and q̇, hence the same
//! p = ∂T/∂q̇ and Cᵀ q̇ = ∂T/∂q. Masses are known zeros behind revolute joints. The U of the field is zero: g and the wrenches of
//! the environment come without products of velocities.

use core::borrow::Borrow;
use core::hint::black_box;
use core::marker::PhantomData;

use super::acceleration_field::{AccelerationField, Inertia, JointRates, Wrench};
use super::base::{no_gyroscopic_rotors, unaccelerated};
use super::compile::{Compiled, CompiledJoint, CompiledRobot, JointPair};
use super::folding::{Folded, Vec3};
use super::gate::EngineScene;
use super::rnea::{environment, inertia};
use super::{Engine, Specialised, only_if};
use crate::algorithms::{MomentumAndCoriolis, MomentumAndDrift};
use crate::effects::{Declared, Effect, JointState};
use crate::model::{JointCoordinate, Robot};
use crate::scalar::Real;
use crate::state::{Configuration, JointTrig, RobotState, State};
use crate::trig::Kernel;

impl<T, K> Engine<T, K> {
    /// The generalised momentum p = M q̇ and the transposed Coriolis product Cᵀ q̇, in joint coordinates, N·m·s and N·m, as
    /// [`crate::algorithms::momentum_and_coriolis`] computes them.
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
    pub fn momentum_and_coriolis<R: Real, S, E, const B: usize, const Q: usize, const V: usize>(
        state: S,
        effects: &E,
    ) -> MomentumAndCoriolis<R, V>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        S: RobotState<R, Q, V>,
        E: Effect<R, B, V>,
    {
        const { EngineScene::<T, R, E, B, Q, V>::TAKEN };
        let MomentumAndDrift { p, beta } = Self::momenta::<R, S, E, B, Q, V, false>(state, effects);
        MomentumAndCoriolis { p, ct_qd: beta }
    }

    /// The generalised momentum p = M q̇ and its drift β = Cᵀ q̇ − g − F, N·m·s and N·m, as
    /// [`crate::algorithms::momentum_and_drift`] computes them.
    ///
    /// Angles as in [`Engine::rnea`].
    ///
    /// # Cost
    /// `docs/costs.md` in the repository, with the rest of an observer's tick, as `residual`; the same instructions for all data.
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
    pub fn momentum_and_drift<R: Real, S, E, const B: usize, const Q: usize, const V: usize>(
        state: S,
        effects: &E,
    ) -> MomentumAndDrift<R, V>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        S: RobotState<R, Q, V>,
        E: Effect<R, B, V>,
    {
        const { EngineScene::<T, R, E, B, Q, V>::TAKEN };
        Self::momenta::<R, S, E, B, Q, V, true>(state, effects)
    }

    /// p and β, or p and Cᵀ q̇ if there is no DRIFT.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn momenta<R: Real, S, E, const B: usize, const Q: usize, const V: usize, const DRIFT: bool>(
        state: S,
        effects: &E,
    ) -> MomentumAndDrift<R, V>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        S: RobotState<R, Q, V>,
        E: Effect<R, B, V>,
    {
        let trig = state
            .configuration()
            .trig_or(Specialised::<T, K, B, V>(PhantomData));
        let trig = trig.borrow();
        // As in `rnea`.
        let back = if const { S::Configuration::PRECOMPUTED } {
            black_box(trig)
        } else {
            trig
        };
        momenta::<R, CompiledRobot<T, B, Q, V>, E, B, Q, V, DRIFT>(
            trig,
            back,
            state.state(),
            effects,
        )
    }
}

/// The recursion of p and β; `back` is `trig` as it is loaded on returning.
#[cfg_attr(not(debug_assertions), inline(always))]
fn momenta<R, C, E, const B: usize, const Q: usize, const V: usize, const DRIFT: bool>(
    trig: &JointTrig<R, Q>,
    back: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    effects: &E,
) -> MomentumAndDrift<R, V>
where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    no_gyroscopic_rotors::<R, E, B, V>();
    let mut result = MomentumAndDrift {
        p: [R::ZERO; V],
        beta: [R::ZERO; V],
    };
    let mut base = unaccelerated::<R, E, B, V>(effects, C::LENGTH);
    if !DRIFT {
        base.a = Vec3::ZERO;
    }
    let mut task = Task {
        turns: &trig.coordinates,
        back: &back.coordinates,
        state,
        effects,
        result: &mut result,
    };
    for_each_joint!(J, {
        if CompiledJoint::<C, J>::IS_ON_BASE
            && let Some(visit) = const {
                only_if(
                    CompiledJoint::<C, J>::IS_ON_BASE,
                    visit::<R, C, E, B, Q, V, DRIFT, J> as Visit<R, E, Q, V>,
                )
            }
        {
            visit(&mut task, &base);
        }
    });
    result
}

/// The data that all bodies share.
struct Task<'a, R: Real, E, const Q: usize, const V: usize> {
    turns: &'a [JointCoordinate<R>; Q],
    /// The same, loaded again on returning.
    back: &'a [JointCoordinate<R>; Q],
    state: &'a State<R, Q, V>,
    effects: &'a E,
    result: &'a mut MomentumAndDrift<R, V>,
}

/// The momentum of a body and its descendants, and the wrench that carries their weight less those of the environment.
#[derive(Clone, Copy)]
struct Carried<R> {
    h: Wrench<R>,
    load: Wrench<R>,
}

type Visit<R, E, const Q: usize, const V: usize> =
    fn(&mut Task<'_, R, E, Q, V>, &AccelerationField<R>) -> Carried<R>;

/// Visits joint I and its descendants; returns what they carry about the origin of the parent, in its frame.
#[cfg_attr(not(debug_assertions), inline(always))]
fn visit<
    R,
    C,
    E,
    const B: usize,
    const Q: usize,
    const V: usize,
    const DRIFT: bool,
    const I: usize,
>(
    task: &mut Task<'_, R, E, Q, V>,
    parent: &AccelerationField<R>,
) -> Carried<R>
where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    let joint = CompiledJoint::<C, I>::JOINT;
    let length_inv = Folded::constant(C::LENGTH_INV);
    let (turn, at) = (
        task.turns[I],
        JointState::new(task.state.q[I], task.state.qd[I]),
    );
    let slide = Folded::runtime(turn.q) * length_inv;
    let mut rates = JointRates {
        velocity: Folded::runtime(at.qd),
        omega_products: Folded::ZERO,
        accel: Folded::ZERO,
    };
    let mut body = if joint.prismatic {
        rates.velocity = rates.velocity * length_inv;
        parent.across_prismatic(joint, slide, rates)
    } else {
        parent.across_revolute::<true>(joint, turn, rates)
    };
    if DRIFT && E::BODY_POSE {
        body.pose = parent.pose.transformed_by(joint, turn, slide);
    }

    let mut inner = Carried {
        h: Wrench::ZERO,
        load: Wrench::ZERO,
    };
    for_each_joint!(J, {
        if JointPair::<C, I, J>::IS_PARENT
            && let Some(visit) = const {
                only_if(
                    JointPair::<C, I, J>::IS_PARENT,
                    visit::<R, C, E, B, Q, V, DRIFT, J> as Visit<R, E, Q, V>,
                )
            }
        {
            let child = visit(task, &body);
            inner = Carried {
                h: inner.h + child.h,
                load: inner.load + child.load,
            };
        }
    });

    // After the children: until then the velocity takes fewer registers than the momentum beside it.
    let own = inertia::<R, C, E, B, Q, V, I>(task.effects, E::BASE_MOTION);
    let h = momentum(&body, &own) + inner.h;
    let mut p = h.along(joint.prismatic, length_inv).get();
    if let Some(armature) = task.effects.inertia(I) {
        p += armature * at.qd;
    }
    task.result.p[I] = p;
    let mut beta = rate(&body, h, joint.prismatic, length_inv).get();
    let mut load = Wrench::ZERO;
    if DRIFT {
        load = body.wrench(&own);
        if E::WRENCH {
            load = environment::<R, C, E, B, Q, V, I>(task.effects, &body, load);
        }
        load = load + inner.load;
        let mut held = load.along(joint.prismatic, length_inv).get();
        task.effects.torque(I, at, &mut held);
        beta -= held;
    }
    task.result.beta[I] = beta;
    let turn = task.back[I];
    Carried {
        h: h.to_parent::<C, I>(turn, slide),
        load: load.to_parent::<C, I>(turn, slide),
    }
}

/// The momentum I v of a body: m v + ω × h, and h × v + tr(Σ) ω − Σ ω.
#[cfg_attr(not(debug_assertions), inline(always))]
fn momentum<R: Real>(body: &AccelerationField<R>, inertia: &Inertia<R>) -> Wrench<R> {
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

/// The entry of Cᵀ q̇ of a joint along z: (v × S)ᵀ h.
#[cfg_attr(not(debug_assertions), inline(always))]
fn rate<R: Real>(
    body: &AccelerationField<R>,
    h: Wrench<R>,
    prismatic: bool,
    length_inv: Folded<R>,
) -> Folded<R> {
    let ([wx, wy, _], [vx, vy, _]) = (body.omega.0, body.v.0);
    let ([fx, fy, _], [nx, ny, _]) = (h.f.0, h.n.0);
    if prismatic {
        (wy * fx - wx * fy) * length_inv
    } else {
        wy * nx - wx * ny + (vy * fx - vx * fy)
    }
}
