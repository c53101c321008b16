//! Assembly: the configuration near a guess at which all loops are closed.
//!
//! Levenberg (1944) and Marquardt (1963), with a damping that follows the square of the error:
//! Newton's convergence also where rows are redundant or a loop is near a singular configuration
//! (Yamashita & Fukushima, 2001).

use super::constraints;
use super::description::Loops;
use super::elimination::{dot, subtract};
use super::error::LoopError;
use crate::algorithms::{Damping, damped_inverse};
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::manifold::integrate;
use crate::state::{State, all_finite};

/// The most steps that are tried.
const STEPS: usize = 60;
/// The error at which a loop is closed, relative to its size.
const CLOSED: (f64, f32) = (4e-14, 2e-6);
/// The longest step of a coordinate, rad or m over the loop's size.
const STRIDE: f64 = 0.5;
/// The damping for each square of the error, at first; a step that gains multiplies it by `LESS`,
/// one that does not by `MORE`.
const DAMPING: f64 = 1e-2;
const LESS: f64 = 0.25;
const MORE: f64 = 8.0;
/// Roundings of K Kᵀ that the damping exceeds for each row.
const ROUNDINGS: f64 = 8.0;

/// Which coordinates assembly may move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Moving {
    /// Those without a motor: the others are measured.
    Passive,
    /// All of them.
    All,
}

/// A configuration with closed loops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assembly<R, const Q: usize> {
    /// The configuration.
    pub q: [R; Q],
    /// The number of steps that it took.
    pub steps: usize,
    /// The largest error that remains, relative to the size of its loop.
    pub error: R,
}

/// The configuration near `guess` at which all loops are closed, rad and m.
///
/// Loops have several such configurations: the guess decides which one is found.
///
/// # Shape
/// Q.
///
/// # Cost
/// At most 60 steps, each of [`constraints()`] and 4 C³ + 2 C² V flops. Not for the control tick.
///
/// # Source
/// Yamashita & Fukushima, "On the rate of convergence of the Levenberg-Marquardt method" (2001).
///
/// # Example
/// ```
/// use dynamics_core::loops::{BodyFrame, LoopJoint, Loops, Moving, assemble};
/// use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
/// const Y: [f64; 3] = [0.0, 1.0, 0.0];
/// const TREE: ArmModel<f64, 3> = Model::new("slider_crank", [
///     Body::new("crank", BASE, Joint::revolute(Y)).mass(1.0).com([0.05, 0.0, 0.0]),
///     Body::new("rod", 0, Joint::revolute(Y)).xyz([0.1, 0.0, 0.0]).mass(1.0).com([0.15, 0.0, 0.0]),
///     Body::new("piston", BASE, Joint::prismatic([1.0, 0.0, 0.0])).xyz([0.4, 0.0, 0.0]).mass(0.5),
/// ]);
/// const LOOPS: Loops<1, 5, 1> = Loops::new(&TREE, [
///     LoopJoint::new("pin", Joint::revolute(Y), [
///         BodyFrame::new(2),
///         BodyFrame::new(1).xyz([0.3, 0.0, 0.0]),
///     ]),
/// ], [0]);
/// let closed = assemble(&TREE, &LOOPS, &[0.5_f64, -0.3, 0.0], Moving::Passive)?;
/// assert!((0.1 * 0.5_f64.sin() + 0.3 * (0.5 + closed.q[1]).sin()).abs() < 1e-14);
/// # Ok::<(), dynamics_core::loops::LoopError>(())
/// ```
///
/// # Errors
/// [`LoopError::Open`] names the loop that is farthest from closed after all steps,
/// [`LoopError::NotFinite`] one that a guess which is not finite reaches.
#[doc(alias = "position analysis")]
pub fn assemble<
    R: Real,
    D,
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
>(
    robot: &D,
    loops: &Loops<L, C, A>,
    guess: &[R; Q],
    moving: Moving,
) -> Result<Assembly<R, Q>, LoopError>
where
    D: RobotModel<R, B, Q, V>,
{
    let may_move = match moving {
        Moving::Passive => loops.passive(),
        Moving::All => [true; V],
    };
    let at = |q: &[R; Q]| constraints(robot, loops, &State::<R, Q, V>::at(*q));
    let (mut q, mut damping) = (*guess, R::from_f64(DAMPING));
    let mut now = at(&q);
    now.check(loops)?;
    for steps in 0..=STEPS {
        let (error, row) = now.worst();
        if error <= R::select(CLOSED.0, CLOSED.1) {
            return Ok(Assembly { q, steps, error });
        }
        if steps == STEPS {
            let (name, error) = (loops.name_of_row(row), error.to_f64());
            return Err(LoopError::Open { name, error });
        }
        let step = step(&now.scaled(), &now.error(), &may_move, damping);
        let next = integrate(robot, &q, &step);
        let there = at(&next);
        // False of a NaN, too.
        if all_finite(&next) && squared(&there.error()) < squared(&now.error()) {
            (q, now) = (next, there);
            damping *= R::from_f64(LESS);
        } else {
            damping *= R::from_f64(MORE);
        }
    }
    let name = loops.robot; // not reached: the last round returns
    Err(LoopError::NotFinite { name })
}

/// −Kᵀ (K Kᵀ + μ 1)⁻¹ φ in the coordinates that may move, shortened to a stride.
fn step<R: Real, const V: usize, const C: usize>(
    rows: &[[R; V]; C],
    error: &[R; C],
    may_move: &[bool; V],
    damping: R,
) -> [R; V] {
    let mut rows = *rows;
    for row in &mut rows {
        for (entry, &may_move) in row.iter_mut().zip(may_move) {
            *entry = if may_move { *entry } else { R::ZERO };
        }
    }
    let (mut squares, mut largest) = ([[R::ZERO; C]; C], R::ZERO);
    for (i, (entries, row)) in squares.iter_mut().zip(&rows).enumerate() {
        *entries = rows.each_ref().map(|other| dot(row, other));
        largest = if entries[i] > largest { entries[i] } else { largest };
    }
    let rounding = R::EPSILON * R::from_f64(ROUNDINGS * C as f64) * largest;
    let mu = damping * squared(error) + rounding + R::MIN_POSITIVE;
    for (i, entries) in squares.iter_mut().enumerate() {
        entries[i] += mu;
    }
    let (inverse, _) = damped_inverse(&squares, Damping::relative(R::ZERO));
    let mut step = [R::ZERO; V];
    for (weights, row) in inverse.iter().zip(&rows) {
        subtract(&mut step, dot(weights, error), row);
    }
    let longest =
        step.iter().fold(R::ZERO, |longest, x| if x.abs() > longest { x.abs() } else { longest });
    let stride = R::from_f64(STRIDE);
    if longest > stride {
        step = step.map(|x| x * (stride / longest));
    }
    step
}

fn squared<R: Real, const C: usize>(error: &[R; C]) -> R {
    dot(error, error)
}
