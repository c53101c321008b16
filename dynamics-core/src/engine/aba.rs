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
use super::compile::{Compiled, CompiledJoint, CompiledRobot, JointMotion, JointPair};
use super::displacement::Displacement;
use super::folding::Folded;
use super::folding::{Mat3, Vec3};
use super::forward_dynamics::remaining;
use super::gate::EngineScene;
use super::pivot_noise::{Singular, of_joint};
use super::rnea::inertia;
use super::{Engine, Specialised, only_if};
use crate::algorithms::NotPositiveDefinite;
use crate::effects::{Declared, Effect, add_inertia};
use crate::model::{BASE, JointCoordinate, Robot};
use crate::scalar::{Real, Vector};
use crate::state::{Configuration, JointTrig, RobotState, State};
use crate::trig::Kernel;

impl<T, K> Engine<T, K> {
    /// The acceleration of each joint, q̈ = FD(q, q̇, τ), as by [`Engine::forward_dynamics`], with
    /// articulated bodies.
    ///
    /// `state.qdd` is not read.
    ///
    /// # Cost
    /// O(V), but more than that of `forward_dynamics` on short chains: `docs/costs.md` in the
    /// repository.
    ///
    /// # Source
    /// Featherstone (1983); RBDA (2008), table 7.1.
    ///
    /// # Errors
    /// As [`Engine::forward_dynamics`].
    #[doc(alias = "ABI")]
    #[doc(alias = "FD")]
    #[inline(never)]
    pub fn aba<R: Real, S, E, const B: usize, const Q: usize, const V: usize>(
        state: S,
        tau: &[R; V],
        effects: &E,
    ) -> Result<[R; V], NotPositiveDefinite>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        S: RobotState<R, Q, V>,
        E: Effect<R, B, V>,
    {
        const { EngineScene::<T, R, E, B, Q, V>::TAKEN };
        const {
            assert!(
                !E::GYROSCOPIC_ROTORS,
                "the engine's articulated bodies carry no rotors that spin as bodies; use `forward_dynamics`"
            )
        };
        let trig = state
            .configuration()
            .trig_or(Specialised::<T, K, B, V>(PhantomData));
        accelerate::<R, CompiledRobot<T, B, Q, V>, E, B, Q, V>(
            trig.borrow(),
            state.state(),
            tau,
            effects,
        )
    }
}

/// The results of the inward pass for the outward pass.
struct Task<'a, R, E, const Q: usize, const V: usize> {
    turns: &'a [JointCoordinate<R>; Q],
    effects: &'a E,
    /// U = Iᴬ S: couple and force.
    u: &'a mut [[R; 6]; V],
    d_inv: &'a mut [R; V],
    singular: Singular,
    /// The torques without the bias forces of the descendants; then the accelerations.
    x: &'a mut [R; V],
}

#[cfg_attr(optimised, inline(always))]
fn accelerate<R, C, E, const B: usize, const Q: usize, const V: usize>(
    trig: &JointTrig<R, Q>,
    state: &State<R, Q, V>,
    tau: &[R; V],
    effects: &E,
) -> Result<[R; V], NotPositiveDefinite>
where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    // One phase after the other: as one block they would need more registers than there are.
    let mut x = remaining::<R, C, E, B, Q, V>(trig, state, tau, effects);
    black_box(&mut x);
    let (mut u, mut d_inv) = ([[R::ZERO; 6]; V], [R::ZERO; V]);
    let mut task = Task {
        turns: &trig.coordinates,
        effects,
        u: &mut u,
        d_inv: &mut d_inv,
        singular: Singular::default(),
        x: &mut x,
    };
    for_each_joint!(J, {
        if CompiledJoint::<C, J>::IS_ON_BASE
            && let Some(inward) = const {
                only_if(
                    CompiledJoint::<C, J>::IS_ON_BASE,
                    inward::<R, C, E, B, Q, V, J> as Inward<R, E, Q, V>,
                )
            }
        {
            let _ = inward(&mut task);
        }
    });
    task.singular.outermost()?;
    for_each_joint!(J, {
        if CompiledJoint::<C, J>::IS_ON_BASE
            && let Some(outward) = const {
                only_if(
                    CompiledJoint::<C, J>::IS_ON_BASE,
                    outward::<R, C, E, B, Q, V, J> as Outward<R, E, Q, V>,
                )
            }
        {
            outward(&mut task, [R::Vec3::ZERO; 2]);
        }
    });
    Ok(x)
}

type Inward<R, E, const Q: usize, const V: usize> =
    fn(&mut Task<'_, R, E, Q, V>) -> (Articulated<R>, Wrench<R>);
type Outward<R, E, const Q: usize, const V: usize> =
    fn(&mut Task<'_, R, E, Q, V>, [<R as Real>::Vec3; 2]);

/// The inward pass: the articulated inertia of joint I and its bias force, in the parent's frame.
#[cfg_attr(optimised, inline(always))]
fn inward<R, C, E, const B: usize, const Q: usize, const V: usize, const I: usize>(
    task: &mut Task<'_, R, E, Q, V>,
) -> (Articulated<R>, Wrench<R>)
where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    let joint = CompiledJoint::<C, I>::JOINT;
    let length_inv = Folded::constant(C::LENGTH_INV);
    let mut ia = Articulated::of(&Inertia::NONE);
    if let Some(inertia) = const {
        only_if(
            CompiledJoint::<C, I>::LAST == I,
            inertia::<R, C, E, B, Q, V, I> as fn(&E, bool) -> Inertia<R>,
        )
    } {
        ia = Articulated::of(&inertia(task.effects, false));
    }
    let mut push = Wrench {
        f: Vec3::ZERO,
        n: Vec3::ZERO,
    };
    for_each_joint!(J, {
        if JointPair::<C, I, J>::IS_PARENT
            && let Some(inward) = const {
                only_if(
                    JointPair::<C, I, J>::IS_PARENT,
                    inward::<R, C, E, B, Q, V, J> as Inward<R, E, Q, V>,
                )
            }
        {
            let (inertia, wrench) = inward(task);
            ia = ia + inertia;
            push = Wrench {
                f: push.f + wrench.f,
                n: push.n + wrench.n,
            };
        }
    });
    let own = ia.wrench_of(joint, length_inv);
    let (n, f) = (own.n, own.f);
    let mut d = own.along(joint, length_inv).get();
    add_inertia(task.effects, I, &mut d);
    let noise = of_joint::<R, C, E, B, Q, V, I>(task.turns, task.effects);
    task.singular.note::<R, I>(d, noise);
    let d_inv = R::ONE / d;
    let rest = Folded::runtime(task.x[I]) - push.along(joint, length_inv);
    let ([nx, ny, nz], [fx, fy, fz]) = (n.0, f.0);
    task.u[I] = [nx.get(), ny.get(), nz.get(), fx.get(), fy.get(), fz.get()];
    task.d_inv[I] = d_inv;
    task.x[I] = rest.get();

    let gain = rest * Folded::runtime(d_inv);
    push = Wrench {
        f: push.f + f.scale(gain),
        n: push.n + n.scale(gain),
    };
    let at = Displacement::of::<C, Q, I>(task.turns);
    (
        ia.minus_joint(n, f, Folded::runtime(d_inv))
            .to_parent::<C, I>(&at),
        push.to_parent::<C, I>(&at),
    )
}

/// The outward pass: the acceleration of joint I, from its parent's α and a.
#[cfg_attr(optimised, inline(always))]
fn outward<R, C, E, const B: usize, const Q: usize, const V: usize, const I: usize>(
    task: &mut Task<'_, R, E, Q, V>,
    [alpha, a]: [R::Vec3; 2],
) where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    let joint = CompiledJoint::<C, I>::JOINT;
    let length_inv = Folded::constant(C::LENGTH_INV);
    let (rot, mut p) = (Mat3::constant(&joint.rot), Vec3::constant(joint.pos));
    let at = Displacement::of::<C, Q, I>(task.turns);
    if CompiledJoint::<C, I>::SHIFTS {
        p = p + at.shift::<C, I>();
    }
    // Plain numbers: what is known of them ends with the first joints, which are at rest.
    let (mut alpha, mut a) = if joint.parent == BASE {
        (Vec3::ZERO, Vec3::ZERO)
    } else {
        (Vec3::runtime(alpha), Vec3::runtime(a))
    };
    (alpha, a) = (
        at.enter::<C, I>(&rot, alpha),
        at.enter::<C, I>(&rot, a + alpha.cross(p)),
    );
    let [nx, ny, nz, fx, fy, fz] = task.u[I].map(Folded::runtime);
    let lost = Vec3([nx, ny, nz]).dot(alpha) + Vec3([fx, fy, fz]).dot(a);
    let qdd = (Folded::runtime(task.x[I]) - lost) * Folded::runtime(task.d_inv[I]);
    task.x[I] = qdd.get();
    if joint.prismatic {
        a.0[joint.axis] = a.0[joint.axis] + qdd * length_inv;
    } else {
        alpha.0[joint.axis] = alpha.0[joint.axis] + qdd;
    }
    if matches!(joint.motion, JointMotion::Screw) {
        a.0[2] = a.0[2] + qdd * Folded::constant(joint.pitch);
    }
    for_each_joint!(J, {
        if JointPair::<C, I, J>::IS_PARENT
            && let Some(outward) = const {
                only_if(
                    JointPair::<C, I, J>::IS_PARENT,
                    outward::<R, C, E, B, Q, V, J> as Outward<R, E, Q, V>,
                )
            }
        {
            outward(task, [alpha.get(), a.get()]);
        }
    });
}
