//! The configuration manifold: q is not always a vector, nor q̇ always its derivative.
//!
//! Continuous joints return to the same place after a turn, and attitudes are unit quaternions: a
//! step along q̇ and the difference of two configurations are exponentials and logarithms, joint by
//! joint. For joints of one axis they are a sum and a difference. Meant for simulation and
//! planning: nothing here is in the control tick.

use core::fmt;

use crate::model::{JointKind, RobotModel};
use crate::scalar::{Real, Vector};
use crate::spatial::rotation::{
    conjugate, log, product, rotate, se3_exp_translation, se3_log, so3_plus, squared,
};
use crate::state::entry;

use JointKind::*;

/// The error for a quaternion of length zero or with a NaN, which is not an attitude.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct NoAttitude {
    /// The place of the joint's first coordinate in q.
    pub at: usize,
}

impl fmt::Display for NoAttitude {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "the quaternion at q[{}] is zero or not a number", self.at)
    }
}

impl core::error::Error for NoAttitude {}

/// The configuration of rest: every coordinate zero, every attitude that of the description.
///
/// ```
/// use dynamics_core::{state::manifold::neutral, model::{BASE, Body, Joint, Model}};
/// let ball = Model::<f64, 1, 4, 3>::new("ball", [Body::new("b", BASE, Joint::spherical()).mass(1.0)]);
/// assert_eq!(neutral(&ball), [0.0, 0.0, 0.0, 1.0]);
/// ```
pub fn neutral<R: Real, D, const B: usize, const Q: usize, const V: usize>(robot: &D) -> [R; Q]
where
    D: RobotModel<R, B, Q, V>,
{
    let mut q = [R::ZERO; Q];
    for link in robot.links() {
        if matches!(link.kind(), Spherical | Free) {
            put(&mut q, link.idx_q() + 3, &[R::ONE]);
        }
    }
    q
}

/// The configuration q ⊕ δ after a unit of time at the constant velocity δ, rad and m.
///
/// Exact for every joint: quaternions by the exponential of SO(3), free joints of SE(3), planar
/// ones of SE(2); they come out at unit length within two units in the last place, after any number
/// of steps. `integrate(robot, q, q̇·h)` is a step of h seconds.
///
/// ```
/// use dynamics_core::{state::manifold::{integrate, neutral}, model::{BASE, Body, Joint, Model}};
/// let ball = Model::<f64, 1, 4, 3>::new("ball", [Body::new("b", BASE, Joint::spherical()).mass(1.0)]);
/// let q = integrate(&ball, &neutral(&ball), &[0.0, 0.0, core::f64::consts::PI]);
/// assert!((q[2] - 1.0).abs() < 1e-15 && q[3].abs() < 1e-15); // half a turn about z
/// ```
pub fn integrate<R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    q: &[R; Q],
    delta: &[R; V],
) -> [R; Q]
where
    D: RobotModel<R, B, Q, V>,
{
    let mut out = *q;
    for link in robot.links() {
        let (at, d) = (link.idx_q(), |k| entry(delta, link.idx_v() + k));
        let was = |k| entry(q, at + k);
        let omega = || R::Vec3::new(d(0), d(1), d(2));
        match link.kind() {
            Spherical => put(&mut out, at, &so3_plus::<R>(quaternion(q, at), omega())),
            Free => {
                let attitude = quaternion(q, at);
                let place = se3_exp_translation::<R>(omega(), R::Vec3::new(d(3), d(4), d(5)));
                let [x, y, z] = rotate::<R>(attitude, place).array();
                put(&mut out, at, &so3_plus::<R>(attitude, omega()));
                put(&mut out, at + 4, &[was(4) + x, was(5) + y, was(6) + z]);
            }
            Planar => {
                let phi = R::Vec3::new(R::ZERO, R::ZERO, d(0));
                let place = se3_exp_translation::<R>(phi, R::Vec3::new(d(1), d(2), R::ZERO));
                let ([x, y, _], (sin, cos)) = (place.array(), was(0).sin_cos());
                let (x, y) = (cos * x - sin * y, sin * x + cos * y);
                put(&mut out, at, &[was(0) + d(0), was(1) + x, was(2) + y]);
            }
            Revolute | Continuous | Prismatic | Helical | Cylindrical | Universal | Fixed => {
                for k in link.coordinates() {
                    let k = k - link.idx_v();
                    put(&mut out, at + k, &[was(k) + d(k)]);
                }
            }
        }
    }
    out
}

/// The velocity q₁ ⊖ q₀ that leads from q₀ to q₁ in a unit of time, along the shorter rotation.
///
/// `integrate(robot, q0, difference(robot, q0, q1))` is q₁ (a turn without end: its place; a
/// quaternion: up to sign). Between attitudes that differ by half a turn there are two shortest
/// rotations, of which this is one.
///
/// ```
/// use dynamics_core::{state::manifold::difference, model::{BASE, Body, Joint, Model}};
/// let wheel = Model::<f64, 1, 1, 1>::new("wheel", [
///     Body::new("w", BASE, Joint::continuous([0.0, 0.0, 1.0])).mass(1.0),
/// ]);
/// let [d] = difference(&wheel, &[3.0], &[-3.0]);
/// assert!((d - (core::f64::consts::TAU - 6.0)).abs() < 1e-15); // through π
/// ```
pub fn difference<R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    from: &[R; Q],
    to: &[R; Q],
) -> [R; V]
where
    D: RobotModel<R, B, Q, V>,
{
    let mut out = [R::ZERO; V];
    for link in robot.links() {
        let (at, idx_v) = (link.idx_q(), link.idx_v());
        let step = |k| entry(to, at + k) - entry(from, at + k);
        let turn = || product(conjugate(quaternion(from, at)), quaternion(to, at));
        match link.kind() {
            Continuous => put(&mut out, idx_v, &[shortest(step(0))]),
            Spherical => put(&mut out, idx_v, &log::<R>(turn()).array()),
            Free => {
                let place = R::Vec3::new(step(4), step(5), step(6));
                let place = rotate::<R>(conjugate(quaternion(from, at)), place);
                let (phi, rho) = se3_log::<R>(turn(), place);
                put(&mut out, idx_v, &phi.array());
                put(&mut out, idx_v + 3, &rho.array());
            }
            Planar => {
                let (sin, cos) = entry(from, at).sin_cos();
                let (x, y) = (step(1), step(2));
                let place = R::Vec3::new(cos * x + sin * y, cos * y - sin * x, R::ZERO);
                let half = shortest(step(0)) * R::from_f64(0.5);
                let (sin, cos) = half.sin_cos();
                let (phi, rho) = se3_log::<R>([R::ZERO, R::ZERO, sin, cos], place);
                let ([_, _, turn], [x, y, _]) = (phi.array(), rho.array());
                put(&mut out, idx_v, &[turn, x, y]);
            }
            Revolute | Prismatic | Helical | Cylindrical | Universal | Fixed => {
                for k in link.coordinates() {
                    put(&mut out, k, &[step(k - idx_v)]);
                }
            }
        }
    }
    out
}

/// Brings every quaternion of q to unit length, within two units in the last place, however far it
/// has drifted, and every turn without end to the same place within ±π, where its last digits are
/// worth most: a wheel that has turned sixty times has lost seven bits. A turn that is there
/// already keeps its bits.
///
/// # Errors
/// [`NoAttitude`] names the first that is zero (or so small that its square is) or not a number;
/// what stands before it in q is normalised, it and the rest are left.
///
/// ```
/// use dynamics_core::{state::manifold::normalise, model::{BASE, Body, Joint, Model}};
/// let ball = Model::<f64, 1, 4, 3>::new("ball", [
///     Body::new("b", BASE, Joint::spherical()).mass(1.0),
/// ]).to_f32();
/// let mut q = [0.0, 0.0, 3.0, 4.0];
/// normalise(&ball, &mut q)?;
/// assert_eq!(q, [0.0, 0.0, 0.6, 0.8]);
/// assert!(normalise(&ball, &mut [0.0; 4]).is_err());
/// let wheel = Model::<f64, 1, 1, 1>::new("wheel", [
///     Body::new("w", BASE, Joint::continuous([0.0, 0.0, 1.0])).mass(1.0),
/// ]);
/// let mut q = [-7.0];
/// normalise(&wheel, &mut q)?;
/// assert!((q[0] - (core::f64::consts::TAU - 7.0)).abs() < 1e-15);
/// # Ok::<(), dynamics_core::state::manifold::NoAttitude>(())
/// ```
pub fn normalise<R: Real, D, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    q: &mut [R; Q],
) -> Result<(), NoAttitude>
where
    D: RobotModel<R, B, Q, V>,
{
    for link in robot.links() {
        let at = link.idx_q();
        if matches!(link.kind(), Spherical | Free) {
            let p = quaternion(q, at);
            let length = squared(p).sqrt();
            if !(length > R::ZERO && length.is_finite()) {
                return Err(NoAttitude { at });
            }
            put(q, at, &p.map(|x| x / length));
        } else if matches!(link.kind(), Continuous) {
            let angle = nearest_turn(entry(q, at), R::ZERO);
            put(q, at, &[angle]);
        }
    }
    Ok(())
}

fn quaternion<R: Real>(q: &[R], at: usize) -> [R; 4] {
    [0, 1, 2, 3].map(|k| entry(q, at + k))
}

fn put<R: Real>(out: &mut [R], at: usize, values: &[R]) {
    for (k, &value) in values.iter().enumerate() {
        if let Some(out) = out.get_mut(at + k) {
            *out = value;
        }
    }
}

/// The same angle, rad, moved by whole turns to within half a turn of `to`: of two points on a
/// circle, the short way is `nearest_turn(angle, to) − to`.
///
/// An angle that is there already keeps its bits, and so does one that is not finite; 10⁸ turns at
/// most. The subtraction of the turns is off by less than a rounding of them.
///
/// ```
/// use core::f32::consts::TAU;
/// use dynamics_core::state::manifold::nearest_turn;
/// assert_eq!(nearest_turn(3.0_f32, 2.0), 3.0);
/// assert!((nearest_turn(-3.1_f32, 3.1) - (TAU - 3.1)).abs() < 1e-6);
/// assert!((nearest_turn(0.25_f32 + 100.0 * TAU, 0.0) - 0.25).abs() < 1e-4); // the f32 has no better digits
/// ```
pub fn nearest_turn<R: Real>(angle: R, to: R) -> R {
    use core::f64::consts::{PI, TAU};
    let apart = angle - to;
    if apart.abs() <= R::from_f64(PI) || !apart.is_finite() {
        return angle;
    }
    let half = R::from_f64(if apart > R::ZERO { 0.5 } else { -0.5 });
    let turns = (apart * R::from_f64(1.0 / TAU) + half).trunc_saturating();
    // 2π in two parts, the first with as few digits as leave its product exact.
    let (whole, rest) = (201.0 / 32.0, TAU - 201.0 / 32.0);
    (angle - turns * R::from_f64(whole)) - turns * R::from_f64(rest)
}

/// The same angle within ±π.
fn shortest<R: Real>(angle: R) -> R {
    let (sin, cos) = angle.sin_cos();
    sin.atan2(cos)
}
