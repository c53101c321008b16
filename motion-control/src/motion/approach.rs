//! The path from where an arm is to the start of its motion.

use core::fmt;

use crate::limits::MotionLimits;
use crate::limits::{Circles, LimitKind, Mode, SafetyLimits, SafetyLimitsError};
use crate::motion::{MeasurementAge, MotionController, ResetError};
use crate::real;
use crate::reference::{Reference, Trajectory, TrajectoryError, WayPoint};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::state::manifold::nearest_turn;

#[cfg(test)]
mod tests;

/// The greatest of |q̇| T/|D| of a quintic from rest to rest, at s = 1/2.
pub(crate) const SPEED: f64 = 15.0 / 8.0;
/// The greatest of |q̈| T²/|D|, at s = 1/2 ± √3/6: 10/√3.
pub(crate) const ACCELERATION: f64 = 5.773_502_691_896_258;

/// A motion that is preceded by the path to its start, from rest to rest within the limits of the
/// joints.
///
/// Each joint moves monotonically, so that the path stays within the bounds that its ends are in.
/// It knows no obstacles: [`Self::first_point`] and [`Self::last_point`] name its ends, for a check
/// of the path by the application.
///
/// A joint that is a circle goes the short way, or within its bounds where it has some. The path
/// then begins on the turn of the motion: its first point is the place of the arm, moved by whole
/// turns. A joint whose turns count goes as far as the numbers say, which is how to ask for turns.
///
/// ```
/// use motion_control::limits::{Circles, MotionLimits, SafetyLimits};
/// use motion_control::motion::Approach;
/// use motion_control::reference::{Reference, Trajectory, WayPoint};
/// let limits = [MotionLimits { velocity: 1.0, acceleration: 4.0 }];
/// let bounds = SafetyLimits { torque: [10.0_f32], rate: [8.0], speed: [3.0], lower: [-2.0], upper: [2.0] };
/// let point = |q, ticks| WayPoint { q: [q], qd: [0.0], ticks };
/// let motion = Trajectory::new(&[point(0.0, 0), point(0.5, 1000)], 1e-3, &limits)?;
///
/// let line = Circles::NONE;
/// let approach = Approach::plan(&[-1.6], &motion, 1e-3, &limits, &bounds, line)?;
/// assert_eq!(approach.path_ticks(), 3001); // 15/8 · 1.6 rad at 1 rad/s, and a tick for rounding
/// assert_eq!((approach.at(0).q, approach.at(3001).q, approach.at(4001).q), ([-1.6], [0.0], [0.5]));
///
/// let error = Approach::plan(&[2.5], &motion, 1e-3, &limits, &bounds, line).unwrap_err();
/// assert_eq!(error.to_string(), "joint 0: its position 2.5000 is outside -2.0000 to 2.0000");
///
/// // A joint without end that stands a turn away, as its number says: it is there.
/// let endless = SafetyLimits { lower: [f32::NEG_INFINITY], upper: [f32::INFINITY], ..bounds };
/// let plan = |joint| Approach::plan(&[6.28], &motion, 1e-3, &limits, &endless, joint);
/// assert!(plan(Circles::NONE.with(0))?.first_point()[0].abs() < 0.01);
/// assert_eq!(plan(Circles::NONE)?.first_point(), &[6.28]); // it unwinds a cable
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[doc(alias = "start-up")]
#[doc(alias = "homing")]
#[derive(Clone, Copy, Debug)]
pub struct Approach<'a, R, const V: usize, T> {
    path: Trajectory<R, V, 2>,
    ends: [[R; V]; 2],
    motion: &'a T,
}

/// The reason why there is no path to the start of a motion. Joints are numbered from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ApproachError {
    /// The arm is not stopped, its position is not known, or the motion has begun: see
    /// [`ResetError`].
    Reset(ResetError),
    /// A position of the arm or of the motion's start is not finite.
    NotFinite {
        /// The joint.
        joint: usize,
    },
    /// The arm is outside its bounds, from which [`BackOff`](crate::motion::BackOff) leads back, or
    /// the start of the motion is.
    Position {
        /// The joint.
        joint: usize,
        /// Its position, rad or m.
        position: f64,
        /// Its least position.
        lower: f64,
        /// Its greatest position.
        upper: f64,
    },
    /// The bounds of a circle count turns.
    Bounds(SafetyLimitsError),
    /// A limit allows no motion of a joint that has to move.
    NoMotion {
        /// The joint.
        joint: usize,
        /// Which limit: the speed, or the torque for the acceleration.
        of: LimitKind,
    },
    /// The motion does not begin at rest.
    Moving {
        /// The joint.
        joint: usize,
    },
    /// The path takes more ticks than can be counted, or the tick is not a positive number.
    Path(TrajectoryError),
}

impl fmt::Display for ApproachError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Reset(error) => error.fmt(out),
            Self::Path(error) => error.fmt(out),
            Self::Bounds(error) => error.fmt(out),
            Self::NotFinite { joint } => write!(out, "joint {joint}: a position is not finite"),
            Self::Position { joint, position, lower, upper } => write!(
                out,
                "joint {joint}: its position {position:.4} is outside {lower:.4} to {upper:.4}"
            ),
            Self::NoMotion { joint, of: LimitKind::Speed } => {
                write!(out, "joint {joint}: its limit of speed allows no motion")
            }
            Self::NoMotion { joint, .. } => {
                write!(out, "joint {joint}: its limit of acceleration allows no motion")
            }
            Self::Moving { joint } => {
                write!(out, "joint {joint}: the motion does not begin at rest")
            }
        }
    }
}

impl core::error::Error for ApproachError {}

impl<'a, R: Real, const V: usize, T: Reference<R, V>> Approach<'a, R, V, T> {
    /// The path from the positions `from` (rad, m) to the start of `motion`, in as few ticks of
    /// `tick` seconds as the motion limits allow, and then the motion. The joints of `circles` go
    /// the short way.
    ///
    /// # Errors
    /// [`ApproachError`] names the joint and the limit.
    pub fn plan(
        from: &[R; V],
        motion: &'a T,
        tick: R,
        limits: &[MotionLimits<R>; V],
        bounds: &SafetyLimits<R, V>,
        circles: Circles,
    ) -> Result<Self, ApproachError> {
        circles.check(bounds).map_err(ApproachError::Bounds)?;
        let start = motion.at(0);
        if let Some(joint) = start.qd.iter().position(|qd| qd.abs() > R::ZERO || !qd.is_finite()) {
            return Err(ApproachError::Moving { joint });
        }
        let mut seconds = R::ZERO;
        let mut first = *from;
        let ends = first.iter_mut().zip(&start.q).zip(limits);
        let ranges = bounds.lower.iter().zip(&bounds.upper);
        for (joint, (((first, &goal), limit), (&lower, &upper))) in ends.zip(ranges).enumerate() {
            let (mut from, mut to) = (*first, goal);
            for q in [from, to] {
                if !q.is_finite() {
                    return Err(ApproachError::NotFinite { joint });
                }
            }
            if circles.has(joint) {
                (from, to) = short_way(from, to, lower, upper);
                *first = from + (goal - to);
            }
            for q in [from, to] {
                if !(lower <= q && q <= upper) {
                    let [position, lower, upper] = [q, lower, upper].map(R::to_f64);
                    return Err(ApproachError::Position { joint, position, lower, upper });
                }
            }
            let least = least_seconds(joint, (to - from).abs(), limit)?;
            seconds = if least > seconds { least } else { seconds };
        }
        Ok(Self {
            path: path(first, start.q, seconds, tick, limits)?,
            ends: [first, start.q],
            motion,
        })
    }

    /// The ticks of the path, after which the motion begins.
    pub fn path_ticks(&self) -> u32 {
        self.path.ticks()
    }

    /// The positions at which the path begins, rad or m; those of circles on the turn of the
    /// motion.
    pub fn first_point(&self) -> &[R; V] {
        &self.ends[0]
    }

    /// The positions at which the path ends and the motion begins, rad or m.
    pub fn last_point(&self) -> &[R; V] {
        &self.ends[1]
    }

    /// The time of the path, s.
    pub fn path_seconds(&self, tick: R) -> R {
        real::<R>(self.path.ticks()) * tick
    }
}

impl<R: Real, const V: usize, T: Reference<R, V>> Reference<R, V> for Approach<'_, R, V, T> {
    fn at(&self, tick: u32) -> State<R, V, V> {
        match tick.checked_sub(self.path.ticks()) {
            Some(tick) => self.motion.at(tick),
            None => self.path.at(tick),
        }
    }

    fn ticks(&self) -> u32 {
        self.path.ticks().saturating_add(self.motion.ticks())
    }
}

impl<R: Real, const V: usize, A: MeasurementAge> MotionController<R, V, A> {
    /// Plans the path of a stopped arm from its measured position to the start of a motion, however
    /// far away, and sets the clock to its begin; [`Self::reset`] with the returned reference then
    /// starts the arm.
    ///
    /// ```
    /// # use motion_control::{limits::*, motion::*, reference::*, safety::*};
    /// # let bounds = SafetyLimits { torque: [10.0], rate: [10.0], speed: [3.0], lower: [-2.0], upper: [2.0] };
    /// # let config = MotionControllerConfig {
    /// #     supervisor: SupervisorConfig {
    /// #         limits: bounds,
    /// #         tick: 1e-3, resolution: 0.0, ride_through_ticks: 2, hold_ticks: 3, reentry_ticks: 10,
    /// #     },
    /// #     observer_bandwidth: 250.0, decay_rate: 25.0, restart_distance: 0.1,
    /// # };
    /// # let point = |q, ticks| WayPoint { q: [q], qd: [0.0], ticks };
    /// # let limits = [MotionLimits { velocity: 3.0, acceleration: 10.0 }];
    /// # let motion = Trajectory::new(&[point(0.0, 0), point(0.5, 1000)], 1e-3, &limits)?;
    /// let mut controller = MotionController::<f32, 1>::try_new(config)?.on_brake();
    /// // No measurement yet: the arm does not move.
    /// let refused = controller.approach(&motion, &limits, &bounds).unwrap_err();
    /// assert_eq!(refused, ApproachError::Reset(ResetError::NoMeasurement));
    ///
    /// controller.tick(Ok(&[1.4]), &motion, |_, _| [0.0]);
    /// assert_eq!(controller.reset(&motion), Err(ResetError::TooFar { joint: 0 }));
    /// let path = controller.approach(&motion, &limits, &bounds)?;
    /// controller.reset(&path)?;
    /// let command = controller.tick(Ok(&[1.4]), &path, |_, _| [0.0]);
    /// assert_eq!(command.status.mode, Mode::Full);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`ApproachError`]; the controller is then unchanged.
    pub fn approach<'a, T: Reference<R, V>>(
        &mut self,
        motion: &'a T,
        limits: &[MotionLimits<R>; V],
        bounds: &SafetyLimits<R, V>,
    ) -> Result<Approach<'a, R, V, T>, ApproachError> {
        if !matches!(self.mode(), Mode::Stopped) & !self.supervisor.stands() {
            return Err(ApproachError::Reset(ResetError::NotStopped));
        }
        if !self.measured() {
            return Err(ApproachError::Reset(ResetError::NoMeasurement));
        }
        let from = self.estimate().q;
        let tick = self.observer.tick();
        let path = Approach::plan(&from, motion, tick, limits, bounds, A::CIRCLES)?;
        self.begin_anew();
        Ok(path)
    }
}

/// Two places on a circle as the ends of the way between them, rad: the short one, or that within
/// the bounds.
fn short_way<R: Real>(from: R, to: R, lower: R, upper: R) -> (R, R) {
    if lower.is_finite() {
        let middle = R::from_f64(0.5) * (lower + upper);
        (nearest_turn(from, middle), nearest_turn(to, middle))
    } else {
        (nearest_turn(from, to), to)
    }
}

/// The least time of a joint from rest to rest, s.
pub(crate) fn least_seconds<R: Real>(
    joint: usize,
    distance: R,
    limit: &MotionLimits<R>,
) -> Result<R, ApproachError> {
    if distance <= R::ZERO {
        return Ok(R::ZERO);
    }
    for (limit, of) in [(limit.velocity, LimitKind::Speed), (limit.acceleration, LimitKind::Torque)]
    {
        // A NaN allows nothing.
        let allows = limit > R::ZERO;
        if !allows {
            return Err(ApproachError::NoMotion { joint, of });
        }
    }
    let by_speed = R::from_f64(SPEED) * distance / limit.velocity;
    let square = R::from_f64(ACCELERATION) * distance / limit.acceleration;
    let by_acceleration = if square > R::ZERO { square.sqrt() } else { R::ZERO };
    Ok(if by_speed > by_acceleration { by_speed } else { by_acceleration })
}

/// The path from rest to rest in a time, s, within limits.
pub(crate) fn path<R: Real, const V: usize>(
    from: [R; V],
    to: [R; V],
    seconds: R,
    tick: R,
    limits: &[MotionLimits<R>; V],
) -> Result<Trajectory<R, V, 2>, ApproachError> {
    // The amount that rounding may add to a peak in f32; and a path of no distance takes a tick. A
    // time that cannot be counted becomes the greatest count.
    let ticks = seconds / tick * R::from_f64(1.0 + 1e-5);
    let ticks = ticks.to_u32().saturating_add(1);
    let stop = |q, ticks| WayPoint { q, qd: [R::ZERO; V], ticks };
    Trajectory::new(&[stop(from, 0), stop(to, ticks)], tick, limits).map_err(ApproachError::Path)
}
