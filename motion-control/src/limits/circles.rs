//! Which joints are circles, and which are lines.

use crate::limits::{SafetyLimits, SafetyLimitsError};
use core::f64::consts::{PI, TAU};
use dynamics_core::drivetrain::Transmission;
use dynamics_core::model::{JointKind, Model};
use dynamics_core::scalar::Real;
use dynamics_core::state::manifold::nearest_turn;

#[cfg(test)]
mod tests;

/// The joints whose positions are points on a circle: q and q + 2π are one place, and the way
/// between two places is the short one.
///
/// The position of every other joint is a number on a line, of which the turns count: that of a
/// prismatic joint, of a revolute joint with stops, and of a continuous joint whose cables a
/// further turn would wind. Which of these a continuous joint is, is your choice: [`Circles::of`]
/// takes all of a model, [`Circles::counted`] takes one of them out.
///
/// A [`MotionController`](crate::motion::MotionController) has the choice in its type,
/// [`OnCircles`](crate::motion::OnCircles), so that lines cost nothing. Joints are numbered from 0,
/// up to 127.
///
/// ```
/// use dynamics_core::{model::Robot, robots::Gen3};
/// use motion_control::limits::Circles;
/// const CIRCLES: Circles = Circles::of(&Gen3::MODEL);
/// let has = [0, 1, 2, 3, 4, 5, 6].map(|joint| CIRCLES.has(joint));
/// assert_eq!(has, [true, false, true, false, true, false, true]);
/// // A hose runs through the last joint: its turns count.
/// assert!(!CIRCLES.counted(6).has(6));
/// ```
#[doc(alias = "continuous joint")]
#[doc(alias = "wrap around")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Circles(u128);

impl Circles {
    /// No joint: the turns of each count.
    pub const NONE: Self = Self(0);

    /// The continuous joints of a model whose coordinates are those of the controller.
    ///
    /// A continuous joint that its description limits to a range of more than a turn is a line: the
    /// limits count turns. Joints with numbers above 127 are lines, too. If the controller's
    /// coordinates are those of motors, take [`Circles::through`] of this.
    pub const fn of<const B: usize, const Q: usize, const V: usize>(
        model: &Model<f64, B, Q, V>,
    ) -> Self {
        let (mut circles, mut i) = (Self::NONE, 0);
        while i < B {
            let link = &model.links[i];
            let range = link.limits.upper - link.limits.lower;
            let counts = range > TAU && range.is_finite();
            let continuous = matches!(link.joint.kind, JointKind::Continuous);
            if continuous && !counts && link.idx_v < JOINTS {
                circles = circles.with(link.idx_v);
            }
            i += 1;
        }
        circles
    }

    /// The motors that are circles where these joints are: a whole turn of such a motor is a whole
    /// number of turns of each joint that it moves.
    ///
    /// ```
    /// use dynamics_core::drivetrain::Transmission;
    /// use motion_control::limits::Circles;
    /// let joints = Circles::NONE.with(0).with(1).with(2);
    /// // The first motor turns two joints, the other behind a gear of 2.5.
    /// let gears = Transmission { matrix: [[1.0, 0.0], [-1.0, 0.0], [0.0, 0.4]], offset: [0.0; 3] };
    /// assert_eq!(joints.through(&gears), Circles::NONE.with(0));
    /// ```
    #[must_use]
    pub const fn through<const M: usize, const V: usize>(
        self,
        transmission: &Transmission<f64, M, V>,
    ) -> Self {
        let (mut circles, mut motor) = (Self::NONE, 0);
        while motor < M {
            let (mut moves, mut circle, mut joint) = (false, true, 0);
            while joint < V {
                let ratio = transmission.matrix[joint][motor];
                let whole = self.has(joint) && ratio % 1.0 == 0.0;
                moves |= ratio != 0.0;
                circle &= ratio == 0.0 || whole;
                joint += 1;
            }
            if moves && circle {
                circles = circles.with(motor);
            }
            motor += 1;
        }
        circles
    }

    /// These and one more, from 0 to 127.
    ///
    /// # Panics
    /// If the number is above 127; in a constant, this does not compile.
    #[must_use]
    pub const fn with(self, joint: usize) -> Self {
        assert!(joint < JOINTS, "a joint on a circle has a number up to 127");
        Self(self.0 | 1 << joint)
    }

    /// These without one, whose turns count.
    #[must_use]
    pub const fn counted(self, joint: usize) -> Self {
        if joint < JOINTS { Self(self.0 & !(1 << joint)) } else { self }
    }

    /// Whether the joint is a circle.
    #[inline(always)]
    pub const fn has(self, joint: usize) -> bool {
        joint < JOINTS && self.0 >> joint & 1 == 1
    }

    /// Whether any joint is a circle.
    #[inline(always)]
    pub const fn any(self) -> bool {
        self.0 != 0
    }

    /// A bit for each joint, from the lowest: the parameter of
    /// [`OnCircles`](crate::motion::OnCircles).
    #[inline(always)]
    pub const fn bits(self) -> u128 {
        self.0
    }

    /// The joints of these bits.
    #[inline(always)]
    pub const fn from_bits(bits: u128) -> Self {
        Self(bits)
    }

    /// The places, rad, moved by whole turns to within half a turn of `to`; positions of lines stay as
    /// they are.
    ///
    /// ```
    /// use motion_control::limits::Circles;
    /// let [wheel, slide] = Circles::NONE.with(0).near(&[-3.1_f32, -3.1], &[3.1, 3.1]);
    /// assert!((wheel - 3.183).abs() < 1e-3 && slide == -3.1);
    /// ```
    #[inline]
    pub fn near<R: Real, const V: usize>(self, q: &[R; V], to: &[R; V]) -> [R; V] {
        let mut near = *q;
        for (joint, (q, &to)) in near.iter_mut().zip(to).enumerate() {
            if self.has(joint) {
                *q = nearest_turn(*q, to);
            }
        }
        near
    }

    /// Moves each point by whole turns, so that the way to it from the one before is the short one:
    /// the first to within half a turn of zero. [`Trajectory`](crate::reference::Trajectory) and
    /// [`PathSpline`](crate::reference::PathSpline) go where the numbers of their way-points lead,
    /// turns included; call this for way-points that name places.
    ///
    /// ```
    /// use motion_control::{limits::Circles, reference::WayPoint};
    /// let mut points = [[3.0_f32], [-3.0], [-2.5]].map(|q| WayPoint { q, qd: [0.0], ticks: 0 });
    /// Circles::NONE.with(0).shorten(points.iter_mut().map(|point| &mut point.q));
    /// assert!((points[1].q[0] - 3.283).abs() < 1e-3 && (points[2].q[0] - 3.783).abs() < 1e-3);
    /// ```
    pub fn shorten<'a, R: Real, const V: usize>(
        self,
        points: impl IntoIterator<Item = &'a mut [R; V]>,
    ) {
        let mut last = [R::ZERO; V];
        for point in points {
            *point = self.near(point, &last);
            last = *point;
        }
    }

    /// Checks that no circle has a range of positions that counts turns: either it has no bounds,
    /// or two within a turn.
    ///
    /// # Errors
    /// [`SafetyLimitsError::CountsTurns`] names the first joint with its range.
    pub fn check<R: Real, const V: usize>(
        self,
        limits: &SafetyLimits<R, V>,
    ) -> Result<(), SafetyLimitsError> {
        self.check_ranges(&limits.lower, &limits.upper)
    }

    /// Checks the ends of ranges as [`Self::check`] does those of limits.
    pub(crate) fn check_ranges<R: Real, const V: usize>(
        self,
        lower: &[R; V],
        upper: &[R; V],
    ) -> Result<(), SafetyLimitsError> {
        for (joint, (&lower, &upper)) in lower.iter().zip(upper).enumerate() {
            let free = !lower.is_finite() & !upper.is_finite();
            let within = upper - lower <= R::from_f64(TAU);
            if self.has(joint) & !free & !within {
                return Err(SafetyLimitsError::CountsTurns {
                    joint,
                    lower: lower.to_f64(),
                    upper: upper.to_f64(),
                });
            }
        }
        Ok(())
    }

    /// The point from which the turns of each circle are counted: the middle of its range, or `q`
    /// where it has none. A line is not moved, wherever this is.
    #[inline]
    pub(crate) fn centres<R: Real, const V: usize>(
        middle: &[R; V],
        half: &[R; V],
        q: &[R; V],
    ) -> [R; V] {
        let mut centres = *q;
        for ((centre, &middle), &half) in centres.iter_mut().zip(middle).zip(half) {
            if half <= R::from_f64(ARC) {
                *centre = middle;
            }
        }
        centres
    }
}

/// The joints that can be circles: the bits of the set.
const JOINTS: usize = 128;
/// Greater half widths than this, rad, are no bounds: those of an arc are at most π, and a
/// [`BackOff`](crate::motion::BackOff) widens them by less than as much again.
const ARC: f64 = 2.0 * PI;
