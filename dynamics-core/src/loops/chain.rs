//! The bodies between the ends of a loop and their nearest common ancestor. RBDA (2008), section
//! 8.2.

use heapless::Vec;

use crate::math::entry;
use crate::model::{JointCoordinate, JointKind, LinkView, RobotModel};
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::{Motion, Xform};

/// The bodies from `at` inward to `ancestor`, without it.
#[cfg_attr(optimised, inline(always))]
pub(super) fn inward<'a, R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &'a D,
    mut at: usize,
    ancestor: usize,
) -> impl Iterator<Item = (usize, LinkView<'a, R>)>
where
    D: RobotModel<R, B, Q, V>,
{
    core::iter::from_fn(move || {
        if at == ancestor {
            return None;
        }
        let (i, link) = (at, robot.link(at)?);
        at = link.parent;
        Some((i, link))
    })
}

/// The nearest body that carries both, or the base.
#[cfg_attr(optimised, inline(always))]
pub(super) fn common_ancestor<R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    [mut p, mut s]: [usize; 2],
) -> usize
where
    D: RobotModel<R, B, Q, V>,
{
    let links = &robot.model().links;
    while p != s {
        // A parent is listed before its children, the base before all.
        let later = if p.wrapping_add(1) < s.wrapping_add(1) { &mut s } else { &mut p };
        let Some(link) = links.get(*later) else {
            break;
        };
        *later = link.parent;
    }
    p
}

/// The transforms of the joints on some loop, computed once for all loops.
pub(super) struct LoopBodies<R: Real, const B: usize> {
    /// ⁱX_λ(i)
    xforms: Vec<Xform<R>, B>,
    on_a_loop: [bool; B],
}

impl<R: Real, const B: usize> LoopBodies<R, B> {
    /// No bodies, to be filled where it stands.
    #[cfg_attr(optimised, inline(always))]
    pub(super) const fn blank() -> Self {
        Self { xforms: Vec::new(), on_a_loop: [false; B] }
    }

    /// Those of loops between these pairs of bodies and their common ancestors.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn set<'b, D, const Q: usize, const V: usize>(
        &mut self,
        robot: &D,
        ends: impl Iterator<Item = (&'b [usize; 2], &'b usize)>,
        turns: &[JointCoordinate<R>; Q],
    ) where
        D: RobotModel<R, B, Q, V>,
    {
        for (ends, &ancestor) in ends {
            for &end in ends {
                for (i, _) in inward(robot, end, ancestor) {
                    if let Some(on_a_loop) = self.on_a_loop.get_mut(i) {
                        *on_a_loop = true;
                    }
                }
            }
        }
        for (i, &on_a_loop) in self.on_a_loop.iter().enumerate() {
            let link = robot.link(i).filter(|_| on_a_loop);
            let xform = link.map_or(Xform::IDENTITY, |link| link.xform(turns));
            let _ = self.xforms.push(xform);
        }
    }

    /// From the aligned frame of `ancestor` to a frame on body `at`; puts the columns of its
    /// Jacobian relative to `ancestor` with their coordinates.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn of_frame<D, const Q: usize, const V: usize>(
        &self,
        robot: &D,
        turns: &[JointCoordinate<R>; Q],
        (at, mut frame): (usize, Xform<R>),
        ancestor: usize,
        mut put: impl FnMut(usize, Column<R>),
    ) -> Xform<R>
    where
        D: RobotModel<R, B, Q, V>,
    {
        for (i, link) in inward(robot, at, ancestor) {
            subspace(&link, turns, &frame, &mut put);
            if let Some(x) = self.xforms.get(i) {
                frame = frame * *x;
            }
        }
        frame
    }

    /// The columns alone.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn columns<D, const Q: usize, const V: usize>(
        &self,
        robot: &D,
        turns: &[JointCoordinate<R>; Q],
        (at, mut frame): (usize, Xform<R>),
        ancestor: usize,
        mut put: impl FnMut(usize, Column<R>),
    ) where
        D: RobotModel<R, B, Q, V>,
    {
        for (i, link) in inward(robot, at, ancestor) {
            subspace(&link, turns, &frame, &mut put);
            if let (true, Some(x)) = (link.parent != ancestor, self.xforms.get(i)) {
                frame = frame * *x;
            }
        }
    }

    /// The velocity of a frame on body `at` relative to `ancestor` and its acceleration at q̈ = 0,
    /// in its own coordinates.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn motion<D, const Q: usize, const V: usize>(
        &self,
        robot: &D,
        (turns, qd): (&[JointCoordinate<R>; Q], &[R; V]),
        (at, mut frame): (usize, Xform<R>),
        ancestor: usize,
    ) -> [Motion<R>; 2]
    where
        D: RobotModel<R, B, Q, V>,
    {
        let (mut v, mut a) = (Motion::ZERO, Motion::ZERO);
        for (i, link) in inward(robot, at, ancestor) {
            let joint = frame * link.motion(turns, qd);
            // Only a universal joint's axes move in its aligned frame.
            if link.kind() == JointKind::Universal {
                let zero = Motion::ZERO;
                a += frame * link.plus_velocity_product(zero, turns, qd, zero);
            }
            // The frame moves by v relative to this body, and so does the joint's axis in the
            // frame's coordinates.
            if i != at {
                a -= v.cross(joint);
            }
            v += joint;
            if let (true, Some(x)) = (link.parent != ancestor, self.xforms.get(i)) {
                frame = frame * *x;
            }
        }
        [v, a]
    }
}

/// A column of a Jacobian.
#[derive(Clone, Copy)]
pub(super) enum Column<R: Real> {
    /// The body turns.
    Turn(Motion<R>),
    /// It slides along this without a turn.
    Slide(R::Vec3),
}

impl<R: Real> Column<R> {
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn motion(self) -> Motion<R> {
        match self {
            Self::Turn(motion) => motion,
            Self::Slide(along) => Motion::new(R::Vec3::ZERO, along),
        }
    }

    /// −X S, the motion of the other side.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn opposite(self, x: &Xform<R>) -> Motion<R> {
        match self {
            Self::Turn(motion) => -(*x * motion),
            Self::Slide(along) => Motion::new(R::Vec3::ZERO, -(x.rot * along)),
        }
    }
}

/// The columns of X S.
#[cfg_attr(optimised, inline(always))]
fn subspace<R: Real>(
    link: &LinkView<'_, R>,
    turns: &[JointCoordinate<R>],
    x: &Xform<R>,
    mut put: impl FnMut(usize, Column<R>),
) {
    let ([e_x, e_y, e_z], [r_x, r_y, r_z]) = (x.rot.cols(), x.pos.array());
    let turn_x = || Motion::new(e_x, e_z * r_y - e_y * r_z);
    let turn_y = || Motion::new(e_y, e_x * r_z - e_z * r_x);
    let turn_z = || Motion::new(e_z, e_y * r_x - e_x * r_y);
    let first = link.idx_v();
    match link.kind() {
        JointKind::Revolute | JointKind::Continuous => put(first, Column::Turn(turn_z())),
        JointKind::Prismatic => put(first, Column::Slide(e_z)),
        JointKind::Universal => {
            let turn = entry(turns, link.idx_q() + 1);
            put(first, Column::Turn(turn_x() * turn.cos - turn_y() * turn.sin));
            put(first + 1, Column::Turn(turn_z()));
        }
        JointKind::Spherical | JointKind::Free => {
            put(first, Column::Turn(turn_x()));
            put(first + 1, Column::Turn(turn_y()));
            put(first + 2, Column::Turn(turn_z()));
            if link.kind() == JointKind::Free {
                put(first + 3, Column::Slide(e_x));
                put(first + 4, Column::Slide(e_y));
                put(first + 5, Column::Slide(e_z));
            }
        }
        _ => {
            for (k, coordinate) in link.coordinates().enumerate() {
                put(coordinate, Column::Turn(*x * link.column(turns, k)));
            }
        }
    }
}

/// X⁻¹
#[cfg_attr(optimised, inline(always))]
pub(super) fn inverse<R: Real>(x: &Xform<R>) -> Xform<R> {
    Xform { rot: x.rot.transpose(), pos: -(x.rot * x.pos) }
}
