//! A step of simulation of a robot whose links bend.

use core::borrow::Borrow;

use super::{FlexibleError, JointsAndModes, Modes, crba, rnea};
use crate::effects::{Bias, Effect, all_transmitted};
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::{Configuration, JointTrig, State, entry};

/// One step of h seconds: the state of joints and modes after it; q̈ and η̈ are the accelerations
/// within it.
///
/// The trapezoidal rule for the modes' stiffness and damping, so that a mode of any frequency is
/// stable under any step and keeps its energy; what else acts is taken at the step's begin. For
/// joints of one coordinate each.
///
/// ```text
/// (M + (h/2) D + (h²/4) K) η̈ + … = −K (η + (h/2) η̇) − D η̇ − …
/// ```
///
/// # Cost
/// The cost of [`forward_dynamics`](super::forward_dynamics()).
///
/// # Errors
/// [`FlexibleError`]; the states are then unchanged.
///
/// # Example
/// ```
/// # use dynamics_core::flexible::{Beam, FlexibleLink, Shape};
/// # use dynamics_core::model::{ArmModel, BASE, Body, Joint, Robot};
/// use dynamics_core::effects::{Elasticity, RIGID_BODY};
/// use dynamics_core::flexible::{Modes, step};
/// use dynamics_core::state::State;
/// # const BEAM: Beam = Beam::new(0.5, 0.8).bending([4.0, 4.0]).tip(0.3, 1e-4);
/// # const LINK: FlexibleLink = match BEAM.link(0, &[Shape::BendZ(1)]) { Ok(link) => link, Err(_) => panic!() };
/// # struct Boom;
/// # impl Robot<1, 1, 1> for Boom {
/// #     const MODEL: ArmModel<f64, 1> = ArmModel::new("boom", [
/// #         Body::new("boom", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(BEAM.mass()).com(BEAM.com()).inertia(BEAM.inertia()),
/// #     ]);
/// # }
/// const MODES: Modes<f64, 1> = Modes::new(&Boom::MODEL, &[LINK]);
/// let (mut joint, mut bent) = (State::at([0.0]), State::at([0.0]));
/// for _ in 0..100 {
///     step(&Boom::MODEL, &MODES, &mut joint, &mut bent, &[3.0], &(RIGID_BODY, Elasticity), 1e-3)?;
/// }
/// assert!(joint.q[0] > 0.0 && bent.q[0] != 0.0);
/// # Ok::<(), dynamics_core::flexible::FlexibleError>(())
/// ```
pub fn step<R: Real, D, E, const B: usize, const V: usize, const M: usize>(
    robot: &D,
    modes: &Modes<R, M>,
    state: &mut State<R, V, V>,
    bent: &mut State<R, M, M>,
    tau: &[R; V],
    effects: &E,
    h: R,
) -> Result<(), FlexibleError>
where
    D: RobotModel<R, B, V, V>,
    E: Effect<R, B, V>,
{
    let now = *state;
    let trig = now.q.trig_of(robot);
    let trig: &JointTrig<R, V> = trig.borrow();
    let (half, quarter) = (h * R::from_f64(0.5), h * h * R::from_f64(0.25));
    let mut m = crba(robot, modes, trig, &bent.q, effects);
    let mut bias = rnea(robot, modes, trig.with(&now), bent, &Bias(effects));
    if E::ELASTICITY {
        modes.add_stiffness(&mut m.modes.rows, [half, quarter]);
        // The increase of K η by bending h/2 η̇ further.
        for (row, force) in modes.stiffness.iter().zip(&mut bias.modes) {
            for (&k, &rate) in row.iter().zip(&bent.qd) {
                *force += k * (half * rate);
            }
        }
    }
    let tau = all_transmitted(robot, &now, effects, tau);
    let found = m.solve(&JointsAndModes {
        joints: core::array::from_fn(|k| entry(&tau, k) - entry(&bias.joints, k)),
        modes: bias.modes.map(|force| -force),
    })?;
    advance(state, &found.joints, h);
    advance(bent, &found.modes, h);
    Ok(())
}

impl<R: Real, const M: usize> Modes<R, M> {
    /// Adds a D + b K to the inertia of the modes.
    pub(super) fn add_stiffness(&self, rows: &mut [[R; M]; M], [a, b]: [R; 2]) {
        let tables = self.damping.iter().zip(&self.stiffness);
        for (row, (damping, stiffness)) in rows.iter_mut().zip(tables) {
            for (m, (&d, &k)) in row.iter_mut().zip(damping.iter().zip(stiffness)) {
                *m += a * d + b * k;
            }
        }
    }
}

/// ẋ + h ẍ, and x by the mean rate.
pub(super) fn advance<R: Real, const N: usize>(
    state: &mut State<R, N, N>,
    accelerations: &[R; N],
    h: R,
) {
    let half = h * R::from_f64(0.5);
    let coordinates = state.q.iter_mut().zip(&mut state.qd);
    for ((q, qd), &qdd) in coordinates.zip(accelerations) {
        *q += h * (*qd + half * qdd);
        *qd += h * qdd;
    }
    state.qdd = *accelerations;
}
