//! M(q) by composite bodies: the bodies that a joint moves as one rigid body, and the wrench of its
//! unit acceleration.
//!
//! Walker & Orin (1982); Featherstone, RBDA (2008), table 6.2, over base parameters: the masses of
//! composite bodies are known zeros behind revolute joints, and h travels as R h.

use core::borrow::Borrow;
use core::marker::PhantomData;

use super::acceleration_field::{Inertia, Wrench, along_z};
use super::compile::{Compiled, CompiledJoint, CompiledRobot, JointMotion, JointPair};
use super::displacement::Displacement;
use super::folding::Folded;
use super::gate::EngineScene;
use super::joint_rates::Twist;
use super::parallel_axes::Felt;
use super::rnea::matrix_inertia;
use super::rotors::{borne, coupling};
use super::{Engine, Specialised, only_if};
use crate::algorithms::MassMatrix;
use crate::effects::{Declared, Effect, add_inertia};
use crate::model::{BASE, JointCoordinate, Robot};
use crate::scalar::Real;
use crate::state::Configuration;
use crate::trig::Kernel;

impl<T, K> Engine<T, K> {
    /// The joint-space inertia matrix M(q), kg·m², kg and kg·m, with the armatures, the payload and
    /// the base parameters of the scene.
    ///
    /// Other effects are ignored: [`crate::effects::RIGID_BODY`] gives the robot's own M. Angles as
    /// in [`Engine::rnea`].
    ///
    /// # Cost
    /// `docs/costs.md` in the repository; the same instructions for all data.
    ///
    /// # Source
    /// Walker & Orin (1982); Featherstone, RBDA (2008), table 6.2.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Engine, effects::{RIGID_BODY, Armature}, robots::Ur5e};
    /// let q = [0.0_f32, -1.2, 1.5, 0.3, 0.0, 0.0];
    /// let (bare, geared) = (Engine::<Ur5e>::crba(&q, &RIGID_BODY), Armature([0.5; 6]));
    /// let driven = Engine::<Ur5e>::crba(&q, &(RIGID_BODY, geared));
    /// assert_eq!(driven.get(2, 2), bare.get(2, 2) + 0.5);
    /// ```
    #[doc(alias = "inertia matrix")]
    #[doc(alias = "mass matrix")]
    #[inline(never)]
    #[must_use]
    pub fn crba<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        q: &impl Configuration<R, Q>,
        effects: &E,
    ) -> MassMatrix<R, V>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        const { EngineScene::<T, R, E, B, Q, V>::TAKEN };
        let trig = q.trig_or(Specialised::<T, K, B, V>(PhantomData));
        let mut m = MassMatrix::ZERO;
        mass_matrix::<R, CompiledRobot<T, B, Q, V>, E, B, Q, V>(
            &trig.borrow().coordinates,
            effects,
            &mut m,
        );
        m
    }
}

/// The data that all bodies share.
struct Task<'a, R, E, const Q: usize, const V: usize> {
    turns: &'a [JointCoordinate<R>; Q],
    effects: &'a E,
    m: &'a mut MassMatrix<R, V>,
}

impl<R: Real, E, const Q: usize, const V: usize> Task<'_, R, E, Q, V> {
    /// Writes the entry of joint I and the joint on the base.
    #[cfg_attr(optimised, inline(always))]
    fn both<C: Compiled, const I: usize>(&mut self, entry: Folded<R>) {
        let (root, entry) = (CompiledJoint::<C, I>::ROOT, entry.get());
        self.m.rows[I][root] = entry;
        self.m.rows[root][I] = entry;
    }
}

/// Writes M(q), both triangles; what is zero by the tree's branches stays as it is.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn mass_matrix<R, C, E, const B: usize, const Q: usize, const V: usize>(
    turns: &[JointCoordinate<R>; Q],
    effects: &E,
    m: &mut MassMatrix<R, V>,
) where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    let mut task = Task { turns, effects, m };
    for_each_joint!(J, {
        if CompiledJoint::<C, J>::IS_ON_BASE
            && let Some(composite) = const {
                only_if(
                    CompiledJoint::<C, J>::IS_ON_BASE,
                    composite::<R, C, E, B, Q, V, J> as Composite<R, E, Q, V>,
                )
            }
        {
            let _ = composite(&mut task, &Twist::ZERO);
        }
    });
}

type Composite<R, E, const Q: usize, const V: usize> =
    fn(&mut Task<'_, R, E, Q, V>, &Twist<R>) -> (Inertia<R>, Felt<R>);

/// Writes the columns of joint I and of its descendants; returns their inertia in the parent's
/// frame, or what joints on parallel axes feel of it. `root` is the motion of the joint on the base
/// at rate −1, in the frame of the parent, or in that of the last ancestor on parallel axes.
#[cfg_attr(optimised, inline(always))]
fn composite<R, C, E, const B: usize, const Q: usize, const V: usize, const I: usize>(
    task: &mut Task<'_, R, E, Q, V>,
    root: &Twist<R>,
) -> (Inertia<R>, Felt<R>)
where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    let at = Displacement::of::<C, Q, I>(task.turns);
    let joint = CompiledJoint::<C, I>::JOINT;
    let length_inv = Folded::constant(C::LENGTH_INV);
    let own = if CompiledJoint::<C, I>::IS_ON_BASE {
        // At rate −1, entries of its row need no negation.
        Twist::along(joint, C::LENGTH_INV, Folded::constant(-1.0))
    } else if CompiledJoint::<C, I>::IS_PARALLEL {
        root.carried::<C, I>(&at)
    } else {
        *root
    };
    let (mut body, mut spin) = (Inertia::NONE, Folded::ZERO);
    if let Some(inertia) = const {
        only_if(
            CompiledJoint::<C, I>::LAST == I,
            matrix_inertia::<R, C, E, B, Q, V, I> as fn(&E) -> (Inertia<R>, Folded<R>),
        )
    } {
        (body, spin) = inertia(task.effects);
    }
    let mut beyond = Felt::NONE;
    for_each_joint!(J, {
        if JointPair::<C, I, J>::IS_PARENT
            && let Some(composite) = const {
                only_if(
                    JointPair::<C, I, J>::IS_PARENT,
                    composite::<R, C, E, B, Q, V, J> as Composite<R, E, Q, V>,
                )
            }
        {
            let (inertia, felt) = composite(task, &own);
            body = body + inertia;
            beyond = beyond + felt;
        }
    });
    if CompiledJoint::<C, I>::IS_PARALLEL {
        let felt = Felt::of(&body, own_spin::<R, C, E, B, V, I>(spin), &own) + beyond;
        task.both::<C, I>(felt.between);
        column::<R, C, E, B, Q, V, I>(task, felt.about, &felt.wrench::<C, I>(&at), root);
        let left = felt.to_parent::<C, I>(&at, root);
        if CompiledJoint::<C, I>::PARENT.parent == BASE {
            return (left.on_root(), Felt::NONE);
        }
        return (Inertia::NONE, left);
    }
    let turned = body.turned::<C, I>(&at);
    if const { keeps_axis(CompiledJoint::<C, I>::MOTION) } {
        // Of the turned body, so that column I and the composite of the parent share the turn's
        // products.
        let mut wrench = turned.wrench_of(joint, length_inv);
        if !joint.prismatic {
            wrench.n.0[2] = body.second.xx + body.second.yy + spin;
        }
        column::<R, C, E, B, Q, V, I>(task, wrench.along(joint, length_inv), &wrench, root);
    } else {
        let wrench = body.wrench_of(joint, length_inv);
        let diagonal = wrench.along(joint, length_inv);
        column::<R, C, E, B, Q, V, I>(task, diagonal, &wrench.turned::<C, I>(&at), root);
    }
    (turned.turned_to_parent::<C, I>(&at), Felt::NONE)
}

/// Whether a rotation of the joint's body leaves the axis of its coordinate as it is: body and
/// wrench may be turned in either order. The axes of planar, spherical and free joints turn with
/// the body.
const fn keeps_axis(motion: JointMotion) -> bool {
    matches!(
        motion,
        JointMotion::Turn | JointMotion::Slide | JointMotion::Screw
    )
}

/// Column I of M: its diagonal entry, and the wrench of joint I's unit acceleration, in the joint's
/// frame, projected on each ancestor. Where it meets `root`, that of the joint on the base, their
/// product is the entry of both.
#[cfg_attr(optimised, inline(always))]
fn column<R, C, E, const B: usize, const Q: usize, const V: usize, const I: usize>(
    task: &mut Task<'_, R, E, Q, V>,
    diagonal: Folded<R>,
    wrench: &Wrench<R>,
    root: &Twist<R>,
) where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    let (mut diagonal, mut wrench) = (diagonal.get(), *wrench);
    let length_inv = Folded::constant(C::LENGTH_INV);
    add_inertia(task.effects, I, &mut diagonal);
    task.m.rows[I][I] = diagonal;
    let couple = along_z(coupling::<R, C, E, B, V, I>(task.effects));
    wrench = borne::<R, E, B, V>(task.effects, wrench, couple);
    // From joint I to the base: parents come before their children.
    for_each_joint_reversed!(K, {
        if JointPair::<C, K, I>::SUPPORTS {
            let joint = CompiledJoint::<C, K>::JOINT;
            if joint.parent != BASE {
                let at = Displacement::of::<C, Q, K>(task.turns);
                wrench = if const { K == I } {
                    wrench.turned_to_parent::<C, K>(&at)
                } else {
                    wrench.to_parent::<C, K>(&at)
                };
                let parent = CompiledJoint::<C, K>::PARENT;
                if !(CompiledJoint::<C, I>::MEETS_ROOT && CompiledJoint::<C, K>::PARENT_ON_BASE) {
                    let entry = wrench.along(parent, length_inv).get();
                    task.m.rows[I][joint.parent] = entry;
                    task.m.rows[joint.parent][I] = entry;
                }
                if JointPair::<C, K, I>::IS_MEETING {
                    let power = root.ang.dot(wrench.n) + root.lin.dot(wrench.f);
                    task.both::<C, I>(-power);
                }
            }
        }
    });
}

/// Of the inertia `spin` that joint I's own rotation feels, what those of the children on parallel
/// axes do not contain.
#[cfg_attr(optimised, inline(always))]
fn own_spin<R, C, E, const B: usize, const V: usize, const I: usize>(spin: Folded<R>) -> Folded<R>
where
    R: Real,
    C: Compiled,
    E: Effect<R, B, V>,
{
    if E::BASE_PARAMETERS > 0 {
        spin
    } else {
        Folded::constant(CompiledJoint::<C, I>::OWN_SPIN)
    }
}
