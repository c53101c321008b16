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
use super::base::base;
use super::compile::{CompiledJoint, JointPair};
use super::displacement::Displacement;
use super::folding::Folded;
use super::only_if;
use super::rnea::{Task, drive, environment, inertia};
use crate::effects::{Declared, Effect};
use crate::model::JointCoordinate;
use crate::scalar::Real;
use crate::state::{JointTrig, State};

/// Expands a block once for each mode that a link may have, its number a constant.
macro_rules! for_each_mode {
    ($k:ident, $body:block) => {
        $crate::engine::for_each_joint!(@ $k $body 0 1 2 3 4 5)
    };
}

use for_each_mode;

/// The data that all bodies share.
struct Bending<'a, 'b, R: Real, E, X, const Q: usize, const V: usize, const M: usize> {
    rigid: &'a mut Task<'b, R, E, Q, V>,
    moves: X,
    forces: &'a mut [R; M],
}

/// The torques of the joints and the forces on the modes.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn bending_torques<
    R,
    C,
    E,
    const B: usize,
    const Q: usize,
    const V: usize,
    const M: usize,
>(
    trig: &JointTrig<R, Q>,
    joints: &State<R, Q, V>,
    modes: &State<R, M, M>,
    effects: &E,
) -> ([R; V], [R; M])
where
    R: Real,
    C: Bends,
    E: Effect<R, B, V>,
{
    let moves = Measured::<R, Of<E, B>, Q, V, M> {
        joints,
        modes,
        effects: PhantomData,
    };
    let base = base::<R, E, B, V>(effects, C::LENGTH);
    swept::<R, C, E, _, B, Q, V, M>(trig, joints, moves, effects, &base)
}

/// The blocks of M(q, η): joints, a row for each mode between it and the joints, and modes.
pub(crate) type Blocks<R, const V: usize, const M: usize> = ([[R; V]; V], [[R; V]; M], [[R; M]; M]);

/// The inertia of joints and modes, without armatures; without `JOINTS` the block of the modes
/// alone.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn bending_inertia<
    R,
    C,
    E,
    const B: usize,
    const Q: usize,
    const V: usize,
    const M: usize,
    const JOINTS: bool,
>(
    trig: &JointTrig<R, Q>,
    eta: &[R; M],
    effects: &E,
) -> Blocks<R, V, M>
where
    R: Real,
    C: Bends,
    E: Effect<R, B, V>,
{
    let mut m = ([[R::ZERO; V]; V], [[R::ZERO; V]; M], [[R::ZERO; M]; M]);
    for_each_joint!(L, {
        if const { is_column(L, V, M, JOINTS) }
            && let Some(column) = const {
                only_if(
                    is_column(L, V, M, JOINTS),
                    column::<R, C, E, B, Q, V, M, L> as Column<R, E, Q, V, M>,
                )
            }
        {
            let (tau, forces) = column(trig, eta, effects);
            // Bodies and links are in the order of the tree: what is before a coordinate has the
            // entry in its own column.
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
    });
    m
}

/// Whether there is a coordinate L.
const fn is_column(l: usize, joints: usize, modes: usize, all: bool) -> bool {
    l < joints + modes && (all || l >= joints)
}

type Column<R, E, const Q: usize, const V: usize, const M: usize> =
    fn(&JointTrig<R, Q>, &[R; M], &E) -> ([R; V], [R; M]);

/// The torques and forces that a unit acceleration of coordinate L needs.
#[cfg_attr(optimised, inline(always))]
fn column<R, C, E, const B: usize, const Q: usize, const V: usize, const M: usize, const L: usize>(
    trig: &JointTrig<R, Q>,
    eta: &[R; M],
    effects: &E,
) -> ([R; V], [R; M])
where
    R: Real,
    C: Bends,
    E: Effect<R, B, V>,
{
    let (moves, base) = (Unit::<R, V, M, L> { eta }, AccelerationField::RESTING);
    swept::<R, C, E, _, B, Q, V, M>(trig, &State::at([R::ZERO; Q]), moves, effects, &base)
}

/// The recursion from the base.
#[cfg_attr(optimised, inline(always))]
fn swept<R, C, E, X, const B: usize, const Q: usize, const V: usize, const M: usize>(
    trig: &JointTrig<R, Q>,
    joints: &State<R, Q, V>,
    moves: X,
    effects: &E,
    base: &AccelerationField<R>,
) -> ([R; V], [R; M])
where
    R: Real,
    C: Bends,
    E: Effect<R, B, V>,
    X: Moves<R>,
{
    let (mut tau, mut forces) = ([R::ZERO; V], [R::ZERO; M]);
    let mut rigid = Task {
        turns: &trig.coordinates,
        back: &trig.coordinates,
        state: joints,
        effects,
        tau: &mut tau,
    };
    let mut task = Bending {
        rigid: &mut rigid,
        moves,
        forces: &mut forces,
    };
    let stand = Stand::rigid(*base);
    for_each_joint!(J, {
        if CompiledJoint::<C, J>::IS_ON_BASE
            && let Some(visit) = const {
                only_if(
                    CompiledJoint::<C, J>::IS_ON_BASE,
                    visit::<R, C, E, X, B, Q, V, M, J> as Visit<R, E, X, Q, V, M>,
                )
            }
        {
            let _ = visit(&mut task, &stand);
        }
    });
    (tau, forces)
}

type Visit<R, E, X, const Q: usize, const V: usize, const M: usize> =
    fn(&mut Bending<'_, '_, R, E, X, Q, V, M>, &Stand<R>) -> Wrench<R>;

/// Visits joint I and its descendants; returns the wrench that they need from what they stand on.
#[cfg_attr(optimised, inline(always))]
fn visit<
    R,
    C,
    E,
    X,
    const B: usize,
    const Q: usize,
    const V: usize,
    const M: usize,
    const I: usize,
>(
    task: &mut Bending<'_, '_, R, E, X, Q, V, M>,
    on: &Stand<R>,
) -> Wrench<R>
where
    R: Real,
    C: Bends,
    E: Effect<R, B, V>,
    X: Moves<R>,
{
    let rates = task.moves.joint(I);
    let mut bent = Mode::NO_MODES;
    for_each_mode!(K, {
        if HasMode::<C, I, K>::IS {
            bent[K] = task
                .moves
                .mode(const { Bent::<C, I, true>::LINK.first + K });
        }
    });
    let at = stood::<R, C, Q, I>(task.rigid.turns, on);
    let mut field = on.field.across::<C, I>(&at, rates);
    if E::BODY_POSE {
        field.pose = on.field.pose.transformed_by::<C, I>(&at);
    }
    let moves = const { X::ALL && E::BASE_MOTION };
    let body = inertia::<R, C, E, B, Q, V, I>(task.rigid.effects, moves);
    let mut forces = [Folded::ZERO; MODES];
    let elastic = const { X::ALL && E::ELASTICITY };
    let mut total = if moves {
        bent_wrench::<R, C, I, true>(&field, body, &bent, elastic, &mut forces)
    } else {
        bent_wrench::<R, C, I, false>(&field, body, &bent, elastic, &mut forces)
    };
    if const { X::ALL && E::WRENCH } {
        total = environment::<R, C, E, B, Q, V, I>(task.rigid.effects, &field, total);
    }
    if !Bent::<C, I, true>::IS {
        let load = children::<R, C, E, X, B, Q, V, M, I>(task, &Stand::rigid(field));
        total = total + load;
    } else if !Bent::<C, I, true>::IS_LAST {
        total = total
            + if moves {
                beyond::<R, C, E, X, B, Q, V, M, I, true>(task, &field, &bent, &mut forces)
            } else {
                beyond::<R, C, E, X, B, Q, V, M, I, false>(task, &field, &bent, &mut forces)
            };
    }
    for_each_mode!(K, {
        if HasMode::<C, I, K>::IS {
            task.forces[const { Bent::<C, I, true>::LINK.first + K }] = forces[K].get();
        }
    });
    if X::ALL {
        drive::<R, C, E, B, Q, V, I>(task.rigid, &total);
    } else {
        let along = total.along(CompiledJoint::<C, I>::JOINT, Folded::ONE);
        task.rigid.tau[I] = along.get();
    }
    total.to_parent::<C, I>(&at)
}

/// What is on the end of the body of joint I: the wrench that it needs from the body.
#[cfg_attr(optimised, inline(always))]
fn beyond<
    R,
    C,
    E,
    X,
    const B: usize,
    const Q: usize,
    const V: usize,
    const M: usize,
    const I: usize,
    const MOVES: bool,
>(
    task: &mut Bending<'_, '_, R, E, X, Q, V, M>,
    field: &AccelerationField<R>,
    bent: &[Mode<R>; MODES],
    forces: &mut [Folded<R>; MODES],
) -> Wrench<R>
where
    R: Real,
    C: Bends,
    E: Effect<R, B, V>,
    X: Moves<R>,
{
    let (end, along) = End::of::<C, I, MOVES>(field, bent);
    let stand = end.stand::<C, I, MOVES>(&along);
    let mut load = children::<R, C, E, X, B, Q, V, M, I>(task, &stand);
    if !Bent::<C, I, MOVES>::ADDS_TO_ANGLES {
        load = end.turned_back::<C, I, MOVES>(load);
    }
    if Bent::<C, I, MOVES>::HAS_BODY_ON_END {
        let (effects, at) = (task.rigid.effects, end.turned::<C, I, MOVES>(&along));
        let mut fixed = at.wrench(&inertia::<R, Ends<C>, E, B, Q, V, I>(effects, MOVES));
        if const { X::ALL && E::WRENCH } {
            fixed = environment::<R, Ends<C>, E, B, Q, V, I>(effects, &at, fixed);
        }
        load = load + end.turned_back::<C, I, MOVES>(fixed);
    }
    end.carry::<C, I, MOVES>(load, forces)
}

/// The sum over the children of joint I.
#[cfg_attr(optimised, inline(always))]
fn children<
    R,
    C,
    E,
    X,
    const B: usize,
    const Q: usize,
    const V: usize,
    const M: usize,
    const I: usize,
>(
    task: &mut Bending<'_, '_, R, E, X, Q, V, M>,
    on: &Stand<R>,
) -> Wrench<R>
where
    R: Real,
    C: Bends,
    E: Effect<R, B, V>,
    X: Moves<R>,
{
    let mut total = Wrench::ZERO;
    for_each_joint!(J, {
        if JointPair::<C, I, J>::IS_CHILD
            && let Some(visit) = const {
                only_if(
                    JointPair::<C, I, J>::IS_CHILD,
                    visit::<R, C, E, X, B, Q, V, M, J> as Visit<R, E, X, Q, V, M>,
                )
            }
        {
            total = total + visit(task, on);
        }
    });
    total
}

/// The displacement of joint I, its angle with that of what it stands on.
#[cfg_attr(optimised, inline(always))]
fn stood<R: Real, C: Bends, const Q: usize, const I: usize>(
    turns: &[JointCoordinate<R>; Q],
    on: &Stand<R>,
) -> Displacement<R> {
    let at = Displacement::of::<C, Q, I>(turns);
    let axis = super::folding::Vec3::constant(CompiledJoint::<C, I>::JOINT.rot.z_axis);
    let (s, c) = (Folded::runtime(at.turn.sin), Folded::runtime(at.turn.cos));
    let (sin, cos) = (on.sin.dot(axis), on.cos);
    at.with_turn(JointCoordinate {
        sin: (s * cos + c * sin).get(),
        cos: (c * cos - s * sin).get(),
        ..at.turn
    })
}
