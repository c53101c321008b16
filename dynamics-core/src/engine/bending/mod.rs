//! Inverse dynamics of a robot whose links bend, by the recursion of [`super::rnea`]: the integrals
//! of the modes are constants of the robot, and of shapes that bend in one plane most are zero.
//!
//! Between a body and its children is the end of the link. A joint whose axis is that about which
//! the end turns has its angle larger by the end's; nothing else is then rotated.

mod end;
mod link;
mod motion;
mod table;

use core::marker::PhantomData;

use end::{End, Stand};
use link::bent_wrench;
use motion::{Measured, Mode, Moves, Of, Unit};
pub(crate) use table::{BendingLink, BendingMode, Bends, MODES};
use table::{Bent, Ends, HasMode};

use super::acceleration_field::{AccelerationField, Wrench};
use super::call::Call;
use super::compile::{CompiledJoint, JointPair};
use super::displacement::Displacement;
use super::folding::Folded;
use super::rnea::Task;
use crate::effects::{Declared, Effect};
use crate::model::JointCoordinate;
use crate::scalar::Real;
use crate::state::State;

/// Expands a block once for each mode that a link may have, its number a constant.
macro_rules! for_each_mode {
    ($k:ident, $body:block) => {
        $crate::engine::for_each_joint!(@ joints $k $body 0 1 2 3 4 5)
    };
}

use for_each_mode;

/// The data that all bodies share.
struct Bending<
    'a,
    'b,
    Scalar: Real,
    Tree,
    Effects,
    Course,
    const B: usize,
    const Q: usize,
    const V: usize,
    const M: usize,
> {
    rigid: &'a mut Task<'b, Scalar, Tree, Effects, (), B, Q, V>,
    moves: Course,
    forces: &'a mut [Scalar; M],
}

impl<Scalar, Tree, Effects, const B: usize, const Q: usize, const V: usize>
    Call<'_, Scalar, Tree, Effects, B, Q, V>
where
    Scalar: Real,
    Tree: Bends,
    Effects: Effect<Scalar, B, V>,
{
    /// The torques of the joints and the forces on the modes.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn bending_torques<const M: usize>(
        self,
        joints: &State<Scalar, Q, V>,
        modes: &State<Scalar, M, M>,
    ) -> ([Scalar; V], [Scalar; M]) {
        let moves = Measured { joints, modes, effects: PhantomData::<Of<Effects, B>> };
        self.swept(joints, moves, &self.base())
    }

    /// The inertia of joints and modes, without armatures; without `JOINTS` the block of the modes
    /// alone.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn bending_inertia<const M: usize, const JOINTS: bool>(
        self,
        eta: &[Scalar; M],
    ) -> Blocks<Scalar, V, M> {
        let mut m = ([[Scalar::ZERO; V]; V], [[Scalar::ZERO; V]; M], [[Scalar::ZERO; M]; M]);
        for_each_joint!(
            L,
            const { is_column(L, V, M, JOINTS) },
            column = Self::column::<M, L> as fn(_, &_) -> ([Scalar; V], [Scalar; M]),
            {
                let (tau, forces) = column(self, eta);
                // Bodies and links are in the order of the tree: what is before a coordinate has
                // the entry in its own column.
                if L < V {
                    for (i, &entry) in tau.iter().enumerate().skip(L) {
                        (m.0[i][L], m.0[L][i]) = (entry, entry);
                    }
                } else {
                    let mode = L - V;
                    for (k, &entry) in forces.iter().enumerate().skip(mode) {
                        (m.2[k][mode], m.2[mode][k]) = (entry, entry);
                    }
                    m.1[mode] = tau;
                }
            }
        );
        m
    }

    /// The torques and forces that a unit acceleration of coordinate L needs.
    #[cfg_attr(optimised, inline(always))]
    fn column<const M: usize, const L: usize>(
        self,
        eta: &[Scalar; M],
    ) -> ([Scalar; V], [Scalar; M]) {
        let (moves, base) = (Unit::<Scalar, V, M, L> { eta }, AccelerationField::RESTING);
        self.swept(&State::at([Scalar::ZERO; Q]), moves, &base)
    }

    /// The recursion from the base.
    #[cfg_attr(optimised, inline(always))]
    fn swept<Course, const M: usize>(
        self,
        joints: &State<Scalar, Q, V>,
        moves: Course,
        base: &AccelerationField<Scalar>,
    ) -> ([Scalar; V], [Scalar; M])
    where
        Course: Moves<Scalar>,
    {
        let (mut tau, mut forces) = ([Scalar::ZERO; V], [Scalar::ZERO; M]);
        let mut rigid =
            Task { call: self, back: self.turns, state: joints, tau: &mut tau, seen: () };
        let mut task = Bending { rigid: &mut rigid, moves, forces: &mut forces };
        let stand = Stand::rigid(*base);
        for_each_joint!(
            J,
            CompiledJoint::<Tree, J>::IS_ON_BASE,
            visit = Bending::visit::<J> as fn(&mut _, &_) -> _,
            {
                let _ = visit(&mut task, &stand);
            }
        );
        (tau, forces)
    }
}

/// The blocks of M(q, η): joints, a row for each mode between it and the joints, and modes.
pub(crate) type Blocks<Scalar, const V: usize, const M: usize> =
    ([[Scalar; V]; V], [[Scalar; V]; M], [[Scalar; M]; M]);

/// Whether there is a coordinate L.
const fn is_column(l: usize, joints: usize, modes: usize, all: bool) -> bool {
    l < joints + modes && (all || l >= joints)
}

impl<Scalar, Tree, Effects, Course, const B: usize, const Q: usize, const V: usize, const M: usize>
    Bending<'_, '_, Scalar, Tree, Effects, Course, B, Q, V, M>
where
    Scalar: Real,
    Tree: Bends,
    Effects: Effect<Scalar, B, V>,
    Course: Moves<Scalar>,
{
    /// Visits joint I and its descendants; returns the wrench that they need from what they stand
    /// on.
    #[cfg_attr(optimised, inline(always))]
    fn visit<const I: usize>(&mut self, on: &Stand<Scalar>) -> Wrench<Scalar> {
        let rates = self.moves.joint(I);
        let mut bent = Mode::NO_MODES;
        for_each_mode!(K, {
            if HasMode::<Tree, I, K>::IS {
                bent[K] = self.moves.mode(const { Bent::<Tree, I, true>::LINK.first + K });
            }
        });
        let at = self.stood::<I>(on);
        let mut field = on.field.across(&at, rates);
        if Effects::BODY_POSE {
            field.pose = on.field.pose.transformed_by(&at);
        }
        let moves = const { Course::ALL && Effects::BASE_MOTION };
        let body = self.rigid.call.inertia::<I>(moves);
        let mut forces = [Folded::ZERO; MODES];
        let elastic = const { Course::ALL && Effects::ELASTICITY };
        let mut total = if moves {
            bent_wrench::<Scalar, Tree, I, true>(&field, body, &bent, elastic, &mut forces)
        } else {
            bent_wrench::<Scalar, Tree, I, false>(&field, body, &bent, elastic, &mut forces)
        };
        if const { Course::ALL && Effects::WRENCH } {
            total = self.rigid.call.environment::<I>(&field, total);
        }
        if !Bent::<Tree, I, true>::IS {
            let load = self.children::<I>(&Stand::rigid(field));
            total = total + load;
        } else if !Bent::<Tree, I, true>::IS_LAST {
            total = total
                + if moves {
                    self.beyond::<I, true>(&field, &bent, &mut forces)
                } else {
                    self.beyond::<I, false>(&field, &bent, &mut forces)
                };
        }
        for_each_mode!(K, {
            if HasMode::<Tree, I, K>::IS {
                self.forces[const { Bent::<Tree, I, true>::LINK.first + K }] = forces[K].get();
            }
        });
        if Course::ALL {
            self.rigid.drive::<I>(&total);
        } else {
            let along = total.along(CompiledJoint::<Tree, I>::JOINT, Folded::ONE);
            self.rigid.tau[I] = along.get();
        }
        total.to_parent(&at)
    }

    /// The wrench that the joints and bodies on the end of the body of joint I need from this body.
    #[cfg_attr(optimised, inline(always))]
    fn beyond<const I: usize, const MOVES: bool>(
        &mut self,
        field: &AccelerationField<Scalar>,
        bent: &[Mode<Scalar>; MODES],
        forces: &mut [Folded<Scalar>; MODES],
    ) -> Wrench<Scalar> {
        let (end, along) = End::of::<Tree, I, MOVES>(field, bent);
        let stand = end.stand::<Tree, I, MOVES>(&along);
        let mut load = self.children::<I>(&stand);
        if !Bent::<Tree, I, MOVES>::ADDS_TO_ANGLES {
            load = end.turned_back::<Tree, I, MOVES>(load);
        }
        if Bent::<Tree, I, MOVES>::HAS_BODY_ON_END {
            let at = end.turned::<Tree, I, MOVES>(&along);
            let ends = Call::<Scalar, Ends<Tree>, Effects, B, Q, V>::new(
                self.rigid.call.turns,
                self.rigid.call.effects,
            );
            let mut fixed = at.wrench(&ends.inertia::<I>(MOVES));
            if const { Course::ALL && Effects::WRENCH } {
                fixed = ends.environment::<I>(&at, fixed);
            }
            load = load + end.turned_back::<Tree, I, MOVES>(fixed);
        }
        end.carry::<Tree, I, MOVES>(load, forces)
    }

    /// The sum over the children of joint I.
    #[cfg_attr(optimised, inline(always))]
    fn children<const I: usize>(&mut self, on: &Stand<Scalar>) -> Wrench<Scalar> {
        let mut total = Wrench::ZERO;
        for_each_joint!(
            J,
            JointPair::<Tree, I, J>::IS_CHILD,
            visit = Self::visit::<J> as fn(&mut _, &_) -> _,
            {
                total = total + visit(self, on);
            }
        );
        total
    }

    /// The displacement of joint I, its angle with that of what it stands on.
    #[cfg_attr(optimised, inline(always))]
    fn stood<const I: usize>(&self, on: &Stand<Scalar>) -> Displacement<Scalar, Tree, I> {
        let at = self.rigid.call.displacement::<I>();
        let axis = super::folding::Vec3::constant(CompiledJoint::<Tree, I>::JOINT.rot.z_axis);
        let (s, c) = (Folded::runtime(at.turn.sin), Folded::runtime(at.turn.cos));
        let (sin, cos) = (on.sin.dot(axis), on.cos);
        let turn = JointCoordinate {
            sin: (s * cos + c * sin).get(),
            cos: (c * cos - s * sin).get(),
            ..at.turn
        };
        at.with_turn(turn)
    }
}
