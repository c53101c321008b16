//! Feed-forward torques along a reference of the joints, with the modes' motion under it.

use core::borrow::Borrow;

use super::crba::modal_inertia;
use super::forward_dynamics::{Factors, finite};
use super::step::advance;
use super::{FlexibleError, Modes, rnea};
use crate::effects::{Bias, Effect};
use crate::model::RobotModel;
use crate::scalar::Real;
use crate::state::{Configuration, JointTrig, State, entry};

/// The modes' motion along a reference of the joints, from which follow the torques that move the
/// joints along it.
///
/// The inverse dynamics of the joints' motion: the modes move as those of links whose joints are
/// clamped, which their damping brings to rest, so that it is sound for any reference. The inverse
/// dynamics of the tip's motion is not; see the [module](super).
///
/// ```
/// # use dynamics_core::flexible::{Beam, FlexibleLink, Shape};
/// # use dynamics_core::model::{ArmModel, BASE, Body, Joint, Robot};
/// use dynamics_core::effects::{Elasticity, RIGID_BODY};
/// use dynamics_core::flexible::{ModalFeedforward, Modes};
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
/// let scene = (RIGID_BODY, Elasticity);
/// let mut feedforward = ModalFeedforward::at_rest(&Boom::MODEL, &MODES, &[0.0], &scene)?;
/// assert!(feedforward.bent.q[0] < -0.01); // sagging under its weight, m
/// let reference = State { q: [0.0], qd: [0.0], qdd: [5.0] };
/// let tau = feedforward.tick(&Boom::MODEL, &MODES, &reference, &scene, 1e-3)?;
/// assert!(tau[0].is_finite());
/// # Ok::<(), dynamics_core::flexible::FlexibleError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModalFeedforward<R, const M: usize> {
    /// η, η̇ and η̈ at the last tick.
    pub bent: State<R, M, M>,
}

/// Iterations of the deflection at rest, each of which reduces its error by the ratio of weight to
/// stiffness.
const ITERATIONS: usize = 12;
/// The largest last correction, of the deflection.
const CONVERGED: f64 = 1e-4;

impl<R: Real, const M: usize> ModalFeedforward<R, M> {
    /// With the modes at rest under the scene's gravity at configuration q.
    /// [`Elasticity`](crate::effects::Elasticity) has to be in the scene: without it no force
    /// balances the weight, and the deflection has no meaning.
    ///
    /// # Cost
    /// Twelve calls of [`rnea()`]: at start, not in the control tick.
    ///
    /// # Errors
    /// [`FlexibleError::Mode`] if the stiffness of a mode is not positive, a number is not finite,
    /// or the deflection has not converged: the link is too soft for its weight.
    pub fn at_rest<D, E, const B: usize, const Q: usize, const V: usize>(
        robot: &D,
        modes: &Modes<R, M>,
        q: &[R; Q],
        effects: &E,
    ) -> Result<Self, FlexibleError>
    where
        D: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { assert!(E::ELASTICITY, "modes at rest need `Elasticity` in the scene") };
        let stiffness = Factors::of(&modes.stiffness).map_err(FlexibleError::Mode)?;
        let (mut bent, mut last) = (State::at([R::ZERO; M]), [R::ZERO; M]);
        for _ in 0..ITERATIONS {
            let force = rnea(robot, modes, &State::at(*q), &bent, &Bias(effects)).modes;
            let correction = stiffness.solve(force);
            bent.q = core::array::from_fn(|k| entry(&bent.q, k) - entry(&correction, k));
            last = correction;
        }
        finite(&bent.q).map_err(FlexibleError::Mode)?;
        let largest = |of: &[R; M]| {
            let sizes = of.iter().map(|x| x.abs());
            sizes.fold(R::ZERO, |most, x| if x > most { x } else { most })
        };
        let most = largest(&bent.q) * R::from_f64(CONVERGED);
        match last.iter().position(|x| x.abs() > most) {
            Some(mode) => Err(FlexibleError::Mode(mode)),
            None => Ok(Self { bent }),
        }
    }

    /// The torques of the joints' motors at a tick, N·m or N, at which the joints' motion is
    /// `reference`. To be called once in every tick: it moves the modes on by h seconds.
    ///
    /// The modes' step is the generalised-α method with ρ∞ = 0 (Chung & Hulbert, 1993), of second
    /// order and with damping of modes that are faster than the tick: with η and η̇ extrapolated by
    /// η̈, and r the force on the modes there, η̈ changes by
    ///
    /// ```text
    /// δ = −(2 M + (3/2) h D + h² K)⁻¹ r      η̇ ← η̇ + (3/2) h δ      η ← η + h² δ
    /// ```
    ///
    /// # Cost
    /// Two calls of [`rnea()`], one of [`crba`](super::crba()) for the modes alone, and M³ / 3
    /// flops.
    ///
    /// # Errors
    /// [`FlexibleError`] names a mode that moves no inertia or whose acceleration is not finite, or
    /// a joint whose torque is not; the modes are then unchanged.
    #[cfg_attr(optimised, inline(always))]
    pub fn tick<D, E, const B: usize, const Q: usize, const V: usize>(
        &mut self,
        robot: &D,
        modes: &Modes<R, M>,
        reference: &State<R, Q, V>,
        effects: &E,
        h: R,
    ) -> Result<[R; V], FlexibleError>
    where
        D: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        let trig = reference.q.trig_of(robot);
        let trig: &JointTrig<R, Q> = trig.borrow();
        let mut bent = self.ahead(h);
        let force = rnea(robot, modes, trig.with(reference), &bent, effects).modes;
        let m = modal_inertia(robot, modes, trig, &bent.q, effects);
        correct(&mut bent, &m, force, E::ELASTICITY.then_some(modes), h)?;
        let tau = rnea(robot, modes, trig.with(reference), &bent, effects).joints;
        self.accept(bent, tau)
    }

    /// The modes after h seconds, extrapolated by η̈.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn ahead(&self, h: R) -> State<R, M, M> {
        let mut bent = self.bent;
        advance(&mut bent, &self.bent.qdd, h);
        bent
    }

    /// Stores the modes of a tick and returns its torques.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn accept<const V: usize>(
        &mut self,
        bent: State<R, M, M>,
        tau: [R; V],
    ) -> Result<[R; V], FlexibleError> {
        finite(&bent.qdd).map_err(FlexibleError::Mode)?;
        finite(&tau).map_err(FlexibleError::Joint)?;
        self.bent = bent;
        Ok(tau)
    }
}

/// Corrects extrapolated modes, of this inertia and with this force on them, by the change δ of η̈;
/// `elastic` has their stiffness.
#[cfg_attr(optimised, inline(always))]
pub(super) fn correct<R: Real, const M: usize>(
    bent: &mut State<R, M, M>,
    m: &[[R; M]; M],
    force: [R; M],
    elastic: Option<&Modes<R, M>>,
    h: R,
) -> Result<(), FlexibleError> {
    let [of_rate, square] = [h * R::from_f64(1.5), h * h];
    let mut matrix = m.map(|row| row.map(|m| m + m));
    if let Some(modes) = elastic {
        modes.add_stiffness(&mut matrix, [of_rate, square]);
    }
    let factors = Factors::of(&matrix).map_err(FlexibleError::Mode)?;
    for (k, change) in factors.solve(force).into_iter().enumerate() {
        let terms = [(&mut bent.q, square), (&mut bent.qd, of_rate), (&mut bent.qdd, R::ONE)];
        for (to, factor) in terms {
            if let Some(to) = to.get_mut(k) {
                *to -= factor * change;
            }
        }
    }
    Ok(())
}
