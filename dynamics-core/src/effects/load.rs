//! Friction of gears that grows with the torque they transmit, in inverse and in forward dynamics.
//!
//! The motor supplies x = τ + a |τ| + b τ, where τ is the torque for all else at the joint. With
//! |a| < 1 + b, τ has the sign of x, and τ = x / (1 + b + a sgn x).

use super::{Declared, Effect, JointState, LoadFactors, TorqueDerivatives, call_hook, joint_state};
use crate::model::LinkView;
use crate::scalar::{Real, positive_part};
use crate::state::{State, entry};

/// Adds the friction of one joint's gear to the torque τ of all else.
#[cfg_attr(optimised, inline(always))]
pub fn load_friction<R: Real, E, const B: usize, const V: usize>(
    effects: &E,
    joint: usize,
    at: JointState<R>,
    tau: &mut R,
) where
    E: Effect<R, B, V>,
{
    if const { E::LOAD_DEPENDENT } {
        let LoadFactors { magnitude, torque } = factors(effects, joint, at);
        *tau += magnitude * tau.abs() + torque * *tau;
    }
}

/// The same for all coordinates of a joint.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn load_frictions<R: Real, E, const B: usize, const Q: usize, const V: usize>(
    effects: &E,
    link: &LinkView<'_, R>,
    state: &State<R, Q, V>,
    tau: &mut [R; V],
) where
    E: Effect<R, B, V>,
{
    if const { E::LOAD_DEPENDENT } {
        for k in link.coordinates() {
            if let Some(tau) = tau.get_mut(k) {
                load_friction(effects, k, joint_state(link, state, k), tau);
            }
        }
    }
}

/// The part τ of the motor's torque x that is left for all else. If the load drives and cannot turn
/// the gear, 1 + b + a sgn x ≤ 0, it is not finite: that takes a friction which holds, not one of a
/// smooth sign.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn transmitted<R: Real, E, const B: usize, const V: usize>(
    effects: &E,
    joint: usize,
    at: JointState<R>,
    tau: R,
) -> R
where
    E: Effect<R, B, V>,
{
    if const { !E::LOAD_DEPENDENT } {
        return tau;
    }
    let LoadFactors { magnitude, torque } = factors(effects, joint, at);
    let even = R::ONE + torque;
    tau / positive_part(even + R::either(tau < R::ZERO, -magnitude, magnitude))
}

/// Adds −∂τ/∂q̇ of [`transmitted`] to the derivatives of one joint, where it is positive.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn add_load_slope<R: Real, E, const B: usize, const V: usize>(
    effects: &E,
    joint: usize,
    at: JointState<R>,
    tau: R,
    derivatives: &mut TorqueDerivatives<R>,
) where
    E: Effect<R, B, V>,
{
    if const { E::LOAD_DEPENDENT } {
        // x = τ (1 + b + a sgn τ) at a given x: (1 + b + a sgn τ) ∂τ/∂q̇ = −(a′ |τ| + b′ τ), and
        // its factor is x/τ.
        let load = transmitted(effects, joint, at, tau);
        let mut slopes = LoadFactors::default();
        call_hook!(E::LOAD_FRICTION.slopes, effects, joint, at, &mut slopes);
        let rise = slopes.magnitude * load.abs() + slopes.torque * load;
        let share = (load.abs() + R::MIN_POSITIVE) / (tau.abs() + R::MIN_POSITIVE);
        // If friction falls with speed, an implicit step would not be the stabler one.
        derivatives.dqd += positive_part(rise) * share;
    }
}

/// a and b of one joint.
#[cfg_attr(optimised, inline(always))]
fn factors<R: Real, E, const B: usize, const V: usize>(
    effects: &E,
    joint: usize,
    at: JointState<R>,
) -> LoadFactors<R>
where
    E: Effect<R, B, V>,
{
    // x + (−0.0) is x for every x, so that no addition is left in the machine code.
    let none = R::from_f64(-0.0);
    let mut factors = LoadFactors { magnitude: none, torque: none };
    call_hook!(E::LOAD_FRICTION.factors, effects, joint, at, &mut factors);
    factors
}

/// The motors' torques of all coordinates without the friction of their gears, for forward
/// dynamics.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn all_transmitted<R: Real, D, E, const B: usize, const Q: usize, const V: usize>(
    robot: &D,
    state: &State<R, Q, V>,
    effects: &E,
    tau: &[R; V],
) -> [R; V]
where
    D: crate::model::RobotModel<R, B, Q, V>,
    E: Effect<R, B, V>,
{
    let mut rest = *tau;
    if const { E::LOAD_DEPENDENT } {
        for link in robot.links() {
            for k in link.coordinates() {
                if let Some(rest) = rest.get_mut(k) {
                    *rest = transmitted(effects, k, joint_state(&link, state, k), entry(tau, k));
                }
            }
        }
    }
    rest
}

/// Algorithms that do not know which torque a gear transmits do not take friction that depends on
/// it.
#[cfg_attr(optimised, inline(always))]
pub(crate) const fn no_load_friction<R: Real, E, const B: usize, const V: usize>()
where
    E: Effect<R, B, V>,
{
    const {
        assert!(
            !E::LOAD_DEPENDENT,
            "load-dependent friction needs the torque of each gear: it acts on trees without \
             loops, clusters or elastic joints"
        )
    };
}
