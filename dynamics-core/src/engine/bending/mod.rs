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
use motion::{Measured, Mode, Moves, SceneType, Unit};
use table::{BendingBody, Ends, HasMode};
pub(crate) use table::{BendingLink, BendingMode, Bends, MODES};

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
    R: Real,
    T,
    E,
    Course,
    const B: usize,
    const Q: usize,
    const V: usize,
    const M: usize,
> {
    rigid: &'a mut Task<'b, R, T, E, (), B, Q, V>,
    moves: Course,
    forces: &'a mut [R; M],
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Call<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Bends,
    E: Effect<R, B, V>,
{
    /// The torques of the joints and the forces on the modes.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn bending_torques<const M: usize>(
        self,
        joints: &State<R, Q, V>,
        modes: &State<R, M, M>,
    ) -> ([R; V], [R; M]) {
        let moves = Measured { joints, modes, effects: PhantomData::<SceneType<E, B>> };
        self.swept(joints, moves, &self.base())
    }

    /// The inertia of joints and modes, without armatures; without `JOINTS` the block of the modes
    /// alone.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn bending_inertia<const M: usize, const JOINTS: bool>(
        self,
        eta: &[R; M],
    ) -> Blocks<R, V, M> {
        let mut m = ([[R::ZERO; V]; V], [[R::ZERO; V]; M], [[R::ZERO; M]; M]);
        for_each_joint!(
            L,
            const { is_column(L, V, M, JOINTS) },
            column = Self::column::<M, L> as fn(_, &_) -> ([R; V], [R; M]),
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
    fn column<const M: usize, const L: usize>(self, eta: &[R; M]) -> ([R; V], [R; M]) {
        let (moves, base) = (Unit::<R, V, M, L> { eta }, AccelerationField::RESTING);
        self.swept(&State::at([R::ZERO; Q]), moves, &base)
    }

    /// The recursion from the base.
    #[cfg_attr(optimised, inline(always))]
    fn swept<Course, const M: usize>(
        self,
        joints: &State<R, Q, V>,
        moves: Course,
        base: &AccelerationField<R>,
    ) -> ([R; V], [R; M])
    where
        Course: Moves<R>,
    {
        let (mut tau, mut forces) = ([R::ZERO; V], [R::ZERO; M]);
        let mut rigid =
            Task { call: self, back: self.turns, state: joints, tau: &mut tau, seen: () };
        let mut task = Bending { rigid: &mut rigid, moves, forces: &mut forces };
        let stand = Stand::rigid(*base);
        for_each_joint!(
            J,
            CompiledJoint::<T, J>::IS_ON_BASE,
            visit = Bending::visit::<J> as fn(&mut _, &_) -> _,
            {
                let _ = visit(&mut task, &stand);
            }
        );
        (tau, forces)
    }
}

/// The blocks of M(q, η): joints, a row for each mode between it and the joints, and modes.
pub(crate) type Blocks<R, const V: usize, const M: usize> = ([[R; V]; V], [[R; V]; M], [[R; M]; M]);

/// Whether there is a coordinate L.
const fn is_column(l: usize, joints: usize, modes: usize, all: bool) -> bool {
    l < joints + modes && (all || l >= joints)
}

impl<R, T, E, Course, const B: usize, const Q: usize, const V: usize, const M: usize>
    Bending<'_, '_, R, T, E, Course, B, Q, V, M>
where
    R: Real,
    T: Bends,
    E: Effect<R, B, V>,
    Course: Moves<R>,
{
    /// Visits joint I and its descendants; returns the wrench that they need from what they stand
    /// on.
    #[cfg_attr(optimised, inline(always))]
    fn visit<const I: usize>(&mut self, on: &Stand<R>) -> Wrench<R> {
        let rates = self.moves.joint(I);
        let mut bent = Mode::NO_MODES;
        for_each_mode!(K, {
            if HasMode::<T, I, K>::IS {
                bent[K] = self.moves.mode(const { BendingBody::<T, I, true>::LINK.first + K });
            }
        });
        let at = self.stood::<I>(on);
        let mut field = on.field.across(&at, rates);
        if E::BODY_POSE {
            field.pose = on.field.pose.transformed_by(&at);
        }
        let moves = const { Course::ALL && E::BASE_MOTION };
        let body = self.rigid.call.inertia::<I>(moves);
        let mut forces = [Folded::ZERO; MODES];
        let elastic = const { Course::ALL && E::ELASTICITY };
        let mut total = if moves {
            bent_wrench::<R, T, I, true>(&field, body, &bent, elastic, &mut forces)
        } else {
            bent_wrench::<R, T, I, false>(&field, body, &bent, elastic, &mut forces)
        };
        if const { Course::ALL && E::WRENCH } {
            total = self.rigid.call.environment::<I>(&field, total);
        }
        if !BendingBody::<T, I, true>::IS {
            let load = self.children::<I>(&Stand::rigid(field));
            total = total + load;
        } else if !BendingBody::<T, I, true>::IS_LAST {
            total = total
                + if moves {
                    self.beyond::<I, true>(&field, &bent, &mut forces)
                } else {
                    self.beyond::<I, false>(&field, &bent, &mut forces)
                };
        }
        for_each_mode!(K, {
            if HasMode::<T, I, K>::IS {
                self.forces[const { BendingBody::<T, I, true>::LINK.first + K }] = forces[K].get();
            }
        });
        if Course::ALL {
            self.rigid.drive::<I>(&total);
        } else {
            let along = total.along(CompiledJoint::<T, I>::JOINT, Folded::ONE);
            self.rigid.tau[I] = along.get();
        }
        total.to_parent(&at)
    }

    /// The wrench that the joints and bodies on the end of the body of joint I need from this body.
    #[cfg_attr(optimised, inline(always))]
    fn beyond<const I: usize, const MOVES: bool>(
        &mut self,
        field: &AccelerationField<R>,
        bent: &[Mode<R>; MODES],
        forces: &mut [Folded<R>; MODES],
    ) -> Wrench<R> {
        let (end, along) = End::of::<T, I, MOVES>(field, bent);
        let stand = end.stand::<T, I, MOVES>(&along);
        let mut load = self.children::<I>(&stand);
        if !BendingBody::<T, I, MOVES>::ADDS_TO_ANGLES {
            load = end.turned_back::<T, I, MOVES>(load);
        }
        if BendingBody::<T, I, MOVES>::HAS_BODY_ON_END {
            let at = end.turned::<T, I, MOVES>(&along);
            let ends =
                Call::<R, Ends<T>, E, B, Q, V>::new(self.rigid.call.turns, self.rigid.call.effects);
            let mut fixed = at.wrench(&ends.inertia::<I>(MOVES));
            if const { Course::ALL && E::WRENCH } {
                fixed = ends.environment::<I>(&at, fixed);
            }
            load = load + end.turned_back::<T, I, MOVES>(fixed);
        }
        end.carry::<T, I, MOVES>(load, forces)
    }

    /// The sum over the children of joint I.
    #[cfg_attr(optimised, inline(always))]
    fn children<const I: usize>(&mut self, on: &Stand<R>) -> Wrench<R> {
        let mut total = Wrench::ZERO;
        for_each_joint!(
            J,
            JointPair::<T, I, J>::IS_CHILD,
            visit = Self::visit::<J> as fn(&mut _, &_) -> _,
            {
                total = total + visit(self, on);
            }
        );
        total
    }

    /// The displacement of joint I, its angle with that of what it stands on.
    #[cfg_attr(optimised, inline(always))]
    fn stood<const I: usize>(&self, on: &Stand<R>) -> Displacement<R, T, I> {
        let at = self.rigid.call.displacement::<I>();
        let axis = super::folding::Vec3::constant(CompiledJoint::<T, I>::JOINT.rot.z_axis);
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
