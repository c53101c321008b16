//! M(q) by composite bodies: the bodies that a joint moves as one rigid body, and the wrench of its
//! unit acceleration.
//!
//! Walker & Orin (1982); Featherstone, RBDA (2008), table 6.2, over base parameters: the masses of
//! composite bodies are known zeros behind revolute joints, and h travels as R h.

use core::borrow::Borrow;
use core::hint::black_box;

use super::acceleration_field::{Inertia, Wrench, along_z};
use super::call::Call;
use super::compile::{Compiled, CompiledJoint, JointMotion, JointPair};
use super::folding::Folded;
use super::joint_rates::Twist;
use super::parallel_axes::Felt;
use super::tree_matrix::{TreeMatrix, place};
use super::{Engine, only_if};
use crate::algorithms::MassMatrix;
use crate::effects::{Declared, Effect, add_inertia};
use crate::model::{BASE, Robot};
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
        scene_is_taken!();
        let trig = q.trig_or(Self::trig_source());
        let mut m = MassMatrix::ZERO;
        Self::call(trig.borrow(), effects).mass_matrix::<true>(&mut m.rows);
        m
    }

    /// The entries of M(q) that are not zero by the tree, up to the diagonal, into `m`: what
    /// [`Engine::tree_ltdl`] needs. The bits are those of [`Engine::crba`].
    ///
    /// # Cost
    /// The same without the stores of zeros and of the other triangle: 144 less 36 on a quadruped.
    ///
    /// # Source
    /// As [`Engine::crba`].
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Engine, TreeMatrix, effects::RIGID_BODY, robots::A1};
    /// let mut m = TreeMatrix::ZERO; // once, before the loop
    /// Engine::<A1>::tree_crba(&[0.3_f32; 12], &RIGID_BODY, &mut m);
    /// assert_eq!(m.square(), Engine::<A1>::crba(&[0.3; 12], &RIGID_BODY));
    /// ```
    #[inline(never)]
    pub fn tree_crba<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        q: &impl Configuration<R, Q>,
        effects: &E,
        m: &mut TreeMatrix<T, R, V>,
    ) where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        let trig = q.trig_or(Self::trig_source());
        Self::call(trig.borrow(), effects).mass_matrix::<false>(&mut m.entries);
    }
}

/// The data that all bodies share; whether M is written as a square.
struct Task<'a, R: Real, T, E, const B: usize, const Q: usize, const V: usize, const SQUARE: bool> {
    call: Call<'a, R, T, E, B, Q, V>,
    rows: &'a mut [[R; V]; V],
    /// Zero, for joints on two branches.
    zero: R,
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Call<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    /// Writes M(q): as a square by rows, or the entries of the tree up to the diagonal, one behind
    /// the other.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn mass_matrix<const SQUARE: bool>(self, rows: &mut [[R; V]; V]) {
        let mut zero = R::ZERO;
        if SQUARE && !const { is_chain(T::SUPPORT) } {
            // The compiler makes fills of zeros that it knows. On some processors these are calls,
            // which take longer than the rest of the algorithm.
            zero = black_box(zero);
        }
        let mut task = Task::<_, _, _, B, Q, V, SQUARE> { call: self, rows, zero };
        for_each_joint!(
            J,
            CompiledJoint::<T, J>::IS_ON_BASE,
            composite = Task::composite::<J> as fn(&mut _, &_) -> _,
            {
                let _ = composite(&mut task, &Twist::ZERO);
            }
        );
    }
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize, const SQUARE: bool>
    Task<'_, R, T, E, B, Q, V, SQUARE>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    /// Writes the entry of joint I and an ancestor.
    #[cfg_attr(optimised, inline(always))]
    fn write<const I: usize>(&mut self, ancestor: usize, entry: R) {
        if SQUARE {
            self.rows[I][ancestor] = entry;
            self.rows[ancestor][I] = entry;
        } else {
            self.rows.as_flattened_mut()[place::<T, I>(ancestor)] = entry;
        }
    }

    /// Writes the columns of joint I and of its descendants; returns their inertia in the parent's
    /// frame, or what joints on parallel axes feel of it. `root` is the motion of the joint on the
    /// base at rate −1, in the frame of the parent, or in that of the last ancestor on parallel
    /// axes.
    #[cfg_attr(optimised, inline(always))]
    fn composite<const I: usize>(&mut self, root: &Twist<R>) -> (Inertia<R>, Felt<R>) {
        let at = self.call.displacement::<I>();
        let joint = CompiledJoint::<T, I>::JOINT;
        let length_inv = Folded::constant(T::LENGTH_INV);
        let own = if CompiledJoint::<T, I>::IS_ON_BASE {
            // At rate −1, entries of its row need no negation.
            Twist::along(joint, T::LENGTH_INV, Folded::constant(-1.0))
        } else if CompiledJoint::<T, I>::IS_PARALLEL {
            root.carried(&at)
        } else {
            *root
        };
        let (mut body, mut spin) = (Inertia::NONE, Folded::ZERO);
        if let Some(inertia) = const {
            only_if(CompiledJoint::<T, I>::LAST == I, Call::matrix_inertia::<I> as fn(_) -> _)
        } {
            (body, spin) = inertia(self.call);
        }
        let mut beyond = Felt::NONE;
        for_each_joint!(
            J,
            JointPair::<T, I, J>::IS_PARENT,
            composite = Self::composite::<J> as fn(&mut _, &_) -> _,
            {
                let (inertia, felt) = composite(self, &own);
                body = body + inertia;
                beyond = beyond + felt;
            }
        );
        if CompiledJoint::<T, I>::IS_PARALLEL {
            let felt = Felt::of(&body, Self::own_spin::<I>(spin), &own) + beyond;
            self.write::<I>(CompiledJoint::<T, I>::ROOT, felt.between.get());
            self.column::<I>(felt.about, &felt.wrench(&at), root);
            let left = felt.to_parent(&at, root);
            if CompiledJoint::<T, I>::PARENT.parent == BASE {
                return (left.on_root(), Felt::NONE);
            }
            return (Inertia::NONE, left);
        }
        let turned = body.turned(&at);
        if const { keeps_axis(CompiledJoint::<T, I>::MOTION) } {
            // The wrench is that of the turned body, so that column I and the composite of the
            // parent share the turn's products.
            let mut wrench = turned.wrench_of(joint, length_inv);
            if !joint.prismatic {
                wrench.n.0[2] = body.second.xx + body.second.yy + spin;
            }
            self.column::<I>(wrench.along(joint, length_inv), &wrench, root);
        } else {
            let wrench = body.wrench_of(joint, length_inv);
            let diagonal = wrench.along(joint, length_inv);
            self.column::<I>(diagonal, &wrench.turned(&at), root);
        }
        (turned.turned_to_parent(&at), Felt::NONE)
    }

    /// Column I of M: its diagonal entry, and the wrench of joint I's unit acceleration, in the
    /// joint's frame, projected on each ancestor. If it meets `root`, the motion of the joint on
    /// the base, their product is the entry of both joints.
    #[cfg_attr(optimised, inline(always))]
    fn column<const I: usize>(&mut self, diagonal: Folded<R>, wrench: &Wrench<R>, root: &Twist<R>) {
        let (mut diagonal, mut wrench) = (diagonal.get(), *wrench);
        let length_inv = Folded::constant(T::LENGTH_INV);
        add_inertia(self.call.effects, I, &mut diagonal);
        self.write::<I>(I, diagonal);
        let couple = along_z(self.call.coupling::<I>());
        wrench = self.call.borne(wrench, couple);
        // From joint I to the base: parents come before their children.
        for_each_joint_reversed!(K, {
            if SQUARE && K < I && !JointPair::<T, K, I>::SUPPORTS {
                self.write::<I>(K, self.zero);
            }
            if JointPair::<T, K, I>::SUPPORTS {
                let joint = CompiledJoint::<T, K>::JOINT;
                if joint.parent != BASE {
                    let at = self.call.displacement::<K>();
                    wrench = if const { K == I } {
                        wrench.turned_to_parent(&at)
                    } else {
                        wrench.to_parent(&at)
                    };
                    let parent = CompiledJoint::<T, K>::PARENT;
                    if !(CompiledJoint::<T, I>::MEETS_ROOT && CompiledJoint::<T, K>::PARENT_ON_BASE)
                    {
                        self.write::<I>(joint.parent, wrench.along(parent, length_inv).get());
                    }
                    if JointPair::<T, K, I>::IS_MEETING {
                        let power = root.ang.dot(wrench.n) + root.lin.dot(wrench.f);
                        self.write::<I>(CompiledJoint::<T, I>::ROOT, (-power).get());
                    }
                }
            }
        });
    }

    /// The inertia `spin` that only joint I's own rotation feels, less what is contained in that of
    /// the children on parallel axes.
    #[cfg_attr(optimised, inline(always))]
    fn own_spin<const I: usize>(spin: Folded<R>) -> Folded<R> {
        if E::BASE_PARAMETERS > 0 {
            spin
        } else {
            Folded::constant(CompiledJoint::<T, I>::OWN_SPIN)
        }
    }
}

/// Whether a rotation of the joint's body leaves the axis of its coordinate as it is: body and
/// wrench may be turned in either order. The axes of planar, spherical and free joints turn with
/// the body.
const fn keeps_axis(motion: JointMotion) -> bool {
    matches!(motion, JointMotion::Turn | JointMotion::Slide | JointMotion::Screw)
}

/// Whether the last joint is supported by all others.
const fn is_chain(support: &[u64]) -> bool {
    match support {
        [.., last] => last.count_ones() as usize == support.len(),
        [] => true,
    }
}
