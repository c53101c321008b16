//! The description of loops, checked while compiling.

use core::ops::Range;

use glam::DMat3;

use super::error::{LoopModelError, LoopProblem};
use super::joint_constraint::{JointConstraint, MOST, counts};
use super::loop_frame::{Both, Frame, both, select};
use super::loop_joint::{BodyFrame, LoopJoint};
use super::reach;
use super::thresholds::{SINGULAR, thresholds};
use crate::model::{BASE, Joint, JointKind, Model};
use crate::scalar::{Matrix, Real};
use crate::spatial::{Force, Xform};

/// No coordinate, no loop, no row or no column of K.
pub(super) const NONE: usize = usize::MAX;

/// The L loops of a robot, which constrain C directions, and its A actuated coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loops<const L: usize, const C: usize, const A: usize> {
    /// The robot's name.
    pub(super) robot: &'static str,
    pub(super) joints: [LoopJoint; L],
    frames: [[Frame; 2]; L],
    /// Rotation of coordinates from the loop frames as described to the aligned ones, by columns.
    axes: [[Both; 3]; L],
    first_rows: [usize; L],
    pub(super) actuated: [usize; A],
    /// The number of coordinates without a motor.
    pub(super) undriven: usize,
    /// ε in f64 and f32.
    pub(super) threshold: (f64, f32),
}

impl<const L: usize, const C: usize, const A: usize> Loops<L, C, A> {
    /// Loops on `model`, and the indices in q̇ of the coordinates that have a motor; impossible
    /// loops do not compile.
    ///
    /// ```
    /// use dynamics_core::loops::{BodyFrame, LoopJoint, Loops};
    /// use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
    /// const Y: [f64; 3] = [0.0, 1.0, 0.0];
    /// const TREE: ArmModel<f64, 3> = Model::new("slider_crank", [
    ///     Body::new("crank", BASE, Joint::revolute(Y)).mass(1.0),
    ///     Body::new("rod", 0, Joint::revolute(Y)).xyz([0.1, 0.0, 0.0]).mass(1.0),
    ///     Body::new("piston", BASE, Joint::prismatic([1.0, 0.0, 0.0])).mass(0.5),
    /// ]);
    /// const PIN: LoopJoint = LoopJoint::new("pin", Joint::revolute(Y), [
    ///     BodyFrame::new(2),
    ///     BodyFrame::new(1).xyz([0.3, 0.0, 0.0]),
    /// ]);
    /// const LOOPS: Loops<1, 5, 1> = Loops::new(&TREE, [PIN], [0]);
    /// assert_eq!(LOOPS.rows(0), 0..5);
    /// ```
    ///
    /// A loop on one body does not compile,
    ///
    /// ```compile_fail,E0080
    /// use dynamics_core::loops::{BodyFrame, LoopJoint, Loops};
    /// use dynamics_core::model::{Joint, Robot};
    /// use dynamics_core::robots::A1;
    /// const LOOPS: Loops<1, 3, 12> = Loops::new(&A1::MODEL, [
    ///     LoopJoint::new("knee", Joint::spherical(), [BodyFrame::new(1), BodyFrame::new(1)]),
    /// ], [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]); // error: loop `knee`: both ends are on the same body
    /// const _: usize = LOOPS.rows(0).end;
    /// ```
    ///
    /// nor does another C than its joints make, nor a coordinate that is actuated twice:
    ///
    /// ```compile_fail,E0080
    /// use dynamics_core::loops::{BodyFrame, LoopJoint, Loops};
    /// use dynamics_core::model::{BASE, Joint, Robot};
    /// use dynamics_core::robots::Ur5e;
    /// const LOOPS: Loops<1, 4, 6> = Loops::new(&Ur5e::MODEL, [
    ///     LoopJoint::new("table", Joint::planar(), [BodyFrame::new(BASE), BodyFrame::new(5)]),
    /// ], [0, 1, 2, 3, 4, 5]); // error: robot `ur5e`: its loop joints constrain another number of directions than C: 3, not 4
    /// const _: usize = LOOPS.rows(0).end;
    /// ```
    ///
    /// ```compile_fail,E0080
    /// use dynamics_core::loops::{BodyFrame, LoopJoint, Loops};
    /// use dynamics_core::model::{BASE, Joint, Robot};
    /// use dynamics_core::robots::Ur5e;
    /// const LOOPS: Loops<1, 3, 6> = Loops::new(&Ur5e::MODEL, [
    ///     LoopJoint::new("table", Joint::planar(), [BodyFrame::new(BASE), BodyFrame::new(5)]),
    /// ], [0, 1, 2, 3, 4, 4]); // error: robot `ur5e`: a coordinate is actuated twice: 4
    /// const _: usize = LOOPS.rows(0).end;
    /// ```
    ///
    /// Nor does a loop that cannot close, or one of which too few coordinates are actuated, as far
    /// as lengths and numbers show it. The rest is found at each configuration:
    /// [`super::LoopError`].
    ///
    /// ```compile_fail,E0080
    /// # use dynamics_core::loops::{BodyFrame, LoopJoint, Loops};
    /// # use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
    /// # const Y: [f64; 3] = [0.0, 1.0, 0.0];
    /// const TREE: ArmModel<f64, 2> = Model::new("triangle", [
    ///     Body::new("short", BASE, Joint::revolute(Y)).mass(1.0),
    ///     Body::new("long", BASE, Joint::revolute(Y)).xyz([0.6, 0.0, 0.0]).mass(1.0),
    /// ]);
    /// const LOOPS: Loops<1, 5, 1> = Loops::new(&TREE, [
    ///     LoopJoint::new("apex", Joint::revolute(Y), [
    ///         BodyFrame::new(0).xyz([0.2, 0.0, 0.0]),
    ///         BodyFrame::new(1).xyz([0.3, 0.0, 0.0]),
    ///     ]),
    /// ], [0]); // error: loop `apex`: one link is longer than all the others together, so that it cannot close
    /// const _: usize = LOOPS.rows(0).end;
    /// ```
    ///
    /// ```compile_fail,E0080
    /// # use dynamics_core::loops::{BodyFrame, LoopJoint, Loops};
    /// # use dynamics_core::model::{BASE, Joint, Robot};
    /// # use dynamics_core::robots::Ur5e;
    /// const LOOPS: Loops<1, 3, 2> = Loops::new(&Ur5e::MODEL, [
    ///     LoopJoint::new("table", Joint::planar(), [BodyFrame::new(BASE), BodyFrame::new(5)]),
    /// ], [0, 1]); // error: robot `ur5e`: fewer coordinates are actuated than are free to move: 2 of at least 3
    /// const _: usize = LOOPS.rows(0).end;
    /// ```
    ///
    /// # Panics
    /// As [`Loops::try_new`] errs, with the loop's name. Meant for `const` items, where a panic is
    /// a compile error.
    pub const fn new<const B: usize, const Q: usize, const V: usize>(
        model: &Model<f64, B, Q, V>,
        joints: [LoopJoint; L],
        actuated: [usize; A],
    ) -> Self {
        match Self::try_new(model, joints, actuated) {
            Ok(loops) => loops,
            Err(error) => error.panic(),
        }
    }

    /// The same for descriptions of run time.
    ///
    /// # Errors
    /// [`LoopModelError`] names the loop: no such body, both ends on one body or on bodies that
    /// cannot move relative to each other, a joint that constrains nothing, impossible axes or
    /// frames, links of which one is longer than all others together; or the robot: another C,
    /// actuated coordinates that do not exist, that are listed twice, or of which there are fewer
    /// than V − C.
    pub const fn try_new<const B: usize, const Q: usize, const V: usize>(
        model: &Model<f64, B, Q, V>,
        joints: [LoopJoint; L],
        actuated: [usize; A],
    ) -> Result<Self, LoopModelError> {
        Self::described(model, &joints, &actuated, true)
    }

    /// The same of up to L loops and A actuated coordinates, which constrain up to C directions:
    /// for programs that learn at run time what a robot's loops are. A is V at least.
    ///
    /// Rows beyond those of the loops are zero, and redundant. Several loops whose rows are no more
    /// than the coordinates are eliminated in another order than by [`Loops::new`], so that last
    /// digits differ.
    ///
    /// ```
    /// use dynamics_core::effects::RIGID_BODY;
    /// use dynamics_core::loops::{self, BodyFrame, LoopJoint, Loops};
    /// use dynamics_core::model::{BASE, Joint, Robot};
    /// use dynamics_core::{robots::Ur5e, state::State};
    /// const TABLE: LoopJoint = LoopJoint::new("table", Joint::planar(), [BodyFrame::new(BASE), BodyFrame::new(5)]);
    /// let exact: Loops<1, 3, 6> = Loops::try_new(&Ur5e::MODEL, [TABLE], [0, 1, 2, 3, 4, 5])?;
    /// let filled: Loops<2, 9, 8> = Loops::try_filled(&Ur5e::MODEL, &[TABLE], &[0, 1, 2, 3, 4, 5])?;
    /// let at = State::at(loops::assemble(&Ur5e::MODEL, &exact, &[0.1_f64; 6], loops::Moving::All)?.q);
    /// let tau = loops::inverse_dynamics(&Ur5e::MODEL, &exact, &at, &RIGID_BODY)?;
    /// let same = loops::inverse_dynamics(&Ur5e::MODEL, &filled, &at, &RIGID_BODY)?;
    /// assert_eq!(tau.drive, same.drive);
    /// assert!(tau.tau.iter().zip(same.tau).all(|(a, b)| (a - b).abs() < 1e-9));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`Loops::try_new`]; [`LoopProblem::Rows`] of more than C, and of more than L loops or A
    /// coordinates.
    pub const fn try_filled<const B: usize, const Q: usize, const V: usize>(
        model: &Model<f64, B, Q, V>,
        joints: &[LoopJoint],
        actuated: &[usize],
    ) -> Result<Self, LoopModelError> {
        const { assert!(A >= V, "up to A coordinates are actuated, of V at least") };
        if joints.len() > L || actuated.len() > A {
            let (expected, given) =
                if joints.len() > L { (joints.len(), L) } else { (actuated.len(), A) };
            let problem = LoopProblem::Rows { expected, given };
            let name = model.name;
            return Err(LoopModelError { name, problem });
        }
        Self::described(model, joints, actuated, false)
    }

    const fn described<const B: usize, const Q: usize, const V: usize>(
        model: &Model<f64, B, Q, V>,
        given: &[LoopJoint],
        motors: &[usize],
        exact: bool,
    ) -> Result<Self, LoopModelError> {
        const NOWHERE: Frame = Frame::of(DMat3::IDENTITY, &Joint::fixed(), &BodyFrame::new(BASE));
        const FILLER: LoopJoint = LoopJoint::new("", Joint::free(), [BodyFrame::new(BASE); 2]);
        let (mut frames, mut first_rows) = ([[NOWHERE; 2]; L], [0; L]);
        let (mut axes, mut joints) = ([NOWHERE.rot; L], [FILLER; L]);
        let (mut rows, mut i) = (0, 0);
        while i < given.len() {
            let joint = &given[i];
            joints[i] = *joint;
            let problem = match joint.problem(B) {
                None => reach::problem(joint, model),
                problem => problem,
            };
            if let Some(problem) = problem {
                let name = joint.name;
                return Err(LoopModelError { name, problem });
            }
            let mut end = 0;
            while end < 2 {
                let at = &joint.ends[end];
                let body = match at.body {
                    BASE => DMat3::IDENTITY,
                    body => model.links[body].to_joint_frame,
                };
                frames[i][end] = Frame::of(body, &joint.joint, at);
                end += 1;
            }
            let aligned = joint.joint.normalised().frame();
            axes[i] = [both(aligned.x_axis), both(aligned.y_axis), both(aligned.z_axis)];
            let [rotations, translations] = counts(joint.joint.kind);
            first_rows[i] = rows;
            rows += rotations + translations;
            i += 1;
        }
        while i < L {
            first_rows[i] = rows;
            i += 1;
        }
        let most = if exact || rows > C { C } else { rows };
        if let Some(problem) = whole(V, [most, rows], motors) {
            let name = model.name;
            return Err(LoopModelError { name, problem });
        }
        let mut actuated = [NONE; A];
        i = 0;
        while i < motors.len() {
            actuated[i] = motors[i];
            i += 1;
        }
        let undriven = V.saturating_sub(motors.len());
        Ok(Self {
            robot: model.name,
            joints,
            frames,
            axes,
            first_rows,
            actuated,
            undriven,
            threshold: thresholds(SINGULAR, rows, undriven),
        })
    }

    /// The loops.
    pub const fn joints(&self) -> &[LoopJoint; L] {
        &self.joints
    }

    /// The actuated coordinates, as indices in q̇.
    pub const fn actuated(&self) -> &[usize; A] {
        &self.actuated
    }

    /// The number of directions that the loops constrain: C if they are not filled up.
    pub(super) const fn constrained(&self) -> usize {
        self.rows(L.saturating_sub(1)).end
    }

    /// The rows of loop `i` in K, or an empty range if the machine has no loop of this number.
    pub const fn rows(&self, i: usize) -> Range<usize> {
        if i >= L {
            return C..C;
        }
        let [rotations, translations] = counts(self.joints[i].joint.kind);
        self.first_rows[i]..self.first_rows[i] + rotations + translations
    }

    /// The force of loop joint `i` on its successor, N·m and N, in the loop frame of the successor,
    /// from the λ of all loops. Its predecessor gets the opposite force. `x` is from the
    /// predecessor's loop frame to the successor's.
    pub(super) fn wrench<R: Real>(&self, i: usize, x: Xform<R>, lambda: &[R; C]) -> Force<R> {
        let (Some(joint), Some(axes)) = (self.joints.get(i), self.axes.get(i)) else {
            return Force::ZERO;
        };
        let mut own = [R::ZERO; MOST];
        for (own, row) in own.iter_mut().zip(self.rows(i)) {
            *own = lambda.get(row).copied().unwrap_or_default();
        }
        let force = self.constraint(joint, x).force(own);
        let [a, b, c] = axes.each_ref().map(select::<R>);
        let back = R::Mat3::from_cols(a, b, c);
        Force::new(back.transpose_mul(force.ang), back.transpose_mul(force.lin))
    }

    #[cfg_attr(optimised, inline(always))]
    pub(super) fn constraint<R: Real>(&self, joint: &LoopJoint, x: Xform<R>) -> JointConstraint<R> {
        let kind = joint.joint.kind;
        let pitch = match kind {
            JointKind::Helical => R::from_f64(joint.joint.pitch),
            _ => R::ZERO,
        };
        JointConstraint { kind, pitch, x }
    }

    /// Each loop joint, with the transforms from the aligned frames of its predecessor and
    /// successor to its own.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn ends<R: Real>(&self) -> impl Iterator<Item = (&LoopJoint, [Xform<R>; 2])> {
        let frames = self.frames.iter();
        let xforms = frames.map(|ends| ends.each_ref().map(Frame::xform::<R>));
        self.joints.iter().zip(xforms)
    }

    /// Which coordinates are not actuated.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn passive<const V: usize>(&self) -> [bool; V] {
        let mut passive = [true; V];
        for &at in &self.actuated {
            if let Some(passive) = passive.get_mut(at) {
                *passive = false;
            }
        }
        passive
    }

    /// The name of the loop that row `row` of K belongs to, such as a redundant one; the robot's if
    /// there is none.
    pub fn name_of_row(&self, row: usize) -> &'static str {
        let mut rows = self.joints.iter().enumerate();
        let joint = rows.find(|(i, _)| self.rows(*i).contains(&row));
        joint.map_or(self.robot, |(_, joint)| joint.name)
    }
}

/// The mistake in the robot as a whole: C, and the actuated coordinates.
const fn whole(
    coordinates: usize,
    [given, expected]: [usize; 2],
    actuated: &[usize],
) -> Option<LoopProblem> {
    if expected != given {
        return Some(LoopProblem::Rows { expected, given });
    }
    let mut i = 0;
    while i < actuated.len() {
        if actuated[i] >= coordinates {
            return Some(LoopProblem::NoCoordinate(actuated[i]));
        }
        let mut j = 0;
        while j < i {
            if actuated[i] == actuated[j] {
                return Some(LoopProblem::ActuatedTwice(actuated[i]));
            }
            j += 1;
        }
        i += 1;
    }
    let needed = coordinates.saturating_sub(expected);
    let given = actuated.len();
    if given < needed {
        return Some(LoopProblem::TooFewActuated { needed, given });
    }
    None
}
