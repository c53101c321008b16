//! Centre of mass and momentum of all bodies together, and the matrix that maps q̇ to the momentum.
//!
//! Orin, Goswami & Lee, "Centroidal dynamics of a humanoid robot" (2013). A column of the matrix is
//! the momentum of the composite body beyond a joint at unit rate of that joint.

use core::borrow::Borrow;

use super::Engine;
use super::acceleration_field::Inertia;
use super::call::Call;
use super::compile::{Compiled, CompiledJoint, CompiledRobot, Joint, JointPair, Remainder};
use super::energy::WithMasses;
use super::folding::Folded;
use super::pass::{Pass, sweep};
use super::pose::Pose;
use super::totals::{Totals, centre, fixed};
use crate::algorithms::CenterOfMass;
use crate::effects::{Declared, Effect};
use crate::model::Robot;
use crate::scalar::{Real, Vector};
use crate::spatial::Force;
use crate::state::{Configuration, RobotState};
use crate::trig::Kernel;

impl<T, K> Engine<T, K> {
    /// The centre of mass of all bodies and a payload, m, its velocity, m/s, and their mass, kg, as
    /// [`crate::algorithms::center_of_mass`] computes them.
    ///
    /// # Cost
    /// Some 60 flops for each revolute joint; the same instructions for all data.
    ///
    /// # Source
    /// Orin, Goswami & Lee (2013), section 2.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Engine, robots::Ur5e, state::State};
    /// let up = State::at([0.0_f64, -1.57, 0.0, 0.0, 0.0, 0.0]);
    /// let arm = Engine::<Ur5e>::center_of_mass(&up, &());
    /// assert!(arm.mass > 16.0 && arm.position.z > 0.3);
    /// ```
    #[doc(alias = "CoM")]
    #[inline(never)]
    #[must_use]
    pub fn center_of_mass<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> CenterOfMass<R>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        let length = CompiledRobot::<T, B, Q, V>::LENGTH;
        let all = Self::all_bodies(state, effects);
        let (position, mass_inv) = all.centre(length);
        CenterOfMass {
            mass: (all.mass * Folded::constant(1.0 / (length * length))).get(),
            position,
            velocity: force(&all, length).lin * mass_inv,
        }
    }

    /// The momentum of all bodies together, about the base's origin and along its axes, N·m·s and
    /// N·s, as [`crate::algorithms::momentum`](crate::algorithms::momentum()) computes it.
    ///
    /// # Cost
    /// Some 60 flops for each revolute joint; the same instructions for all data.
    ///
    /// # Source
    /// Featherstone, RBDA (2008), (2.60), over base parameters.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Engine, robots::Ur5e, state::State};
    /// let state = State { qd: [1.0; 6], ..State::at([0.3_f64; 6]) };
    /// let (h, c) = (Engine::<Ur5e>::momentum(&state, &()), Engine::<Ur5e>::center_of_mass(&state, &()));
    /// assert!((h.lin - c.velocity * c.mass).length() < 1e-12);
    /// ```
    #[inline(never)]
    #[must_use]
    pub fn momentum<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> Force<R>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        let all = Self::all_bodies(state, effects);
        force(&all, CompiledRobot::<T, B, Q, V>::LENGTH)
    }

    /// The centroidal momentum h_G: about the centre of mass and along the base's axes, N·m·s and
    /// N·s, as [`crate::algorithms::centroidal_momentum`] computes it.
    ///
    /// # Cost
    /// Some 60 flops for each revolute joint; the same instructions for all data.
    ///
    /// # Source
    /// Orin, Goswami & Lee (2013).
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Engine, robots::Ur5e, state::State};
    /// let state = State { qd: [1.0, 0.0, 0.0, 0.0, 0.0, 0.0], ..State::at([0.0_f64; 6]) };
    /// assert!(Engine::<Ur5e>::centroidal_momentum(&state, &()).ang.z > 0.0);
    /// ```
    #[inline(never)]
    #[must_use]
    pub fn centroidal_momentum<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> Force<R>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        let length = CompiledRobot::<T, B, Q, V>::LENGTH;
        let all = Self::all_bodies(state, effects);
        let (h, (centre, _)) = (force(&all, length), all.centre(length));
        Force::new(h.ang - centre.cross(h.lin), h.lin)
    }

    #[cfg_attr(optimised, inline(always))]
    fn all_bodies<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> Totals<R>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        const { WithMasses::<R, E, B, V>::KNOWN };
        let configuration = state.configuration();
        let trig = configuration.trig_or(Self::trig_source());
        let (trig, qd) = (trig.borrow(), &state.state().qd);
        Self::call(trig, effects).totals::<true>(Some(qd))
    }

    /// The centroidal momentum matrix A_G with h_G = A_G q̇, by columns, one for each coordinate,
    /// for a base at rest, as [`crate::algorithms::centroidal_matrix`] computes it.
    ///
    /// About the centre of mass and along the base's axes, N·m·s and N·s per rad/s or m/s.
    ///
    /// # Cost
    /// Some 90 flops for each revolute joint; the same instructions for all data.
    ///
    /// # Source
    /// Orin, Goswami & Lee (2013), section 5, over base parameters.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Engine, robots::Ur5e, state::State};
    /// let state = State { qd: [0.0, 2.0, 0.0, 0.0, 0.0, 0.0], ..State::at([0.3_f64; 6]) };
    /// let column = Engine::<Ur5e>::centroidal_matrix(&state.q, &())[1];
    /// let h = Engine::<Ur5e>::centroidal_momentum(&state, &());
    /// assert!((h.ang - column.ang * 2.0).length() < 1e-12);
    /// ```
    #[doc(alias = "CMM")]
    #[inline(never)]
    #[must_use]
    pub fn centroidal_matrix<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        q: &impl Configuration<R, Q>,
        effects: &E,
    ) -> [Force<R>; V]
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        const { WithMasses::<R, E, B, V>::KNOWN };
        const { assert!(!E::GYROSCOPIC_ROTORS, "no rotors that spin as bodies here; name `Armature`") };
        let trig = q.trig_or(Self::trig_source());
        Self::call(trig.borrow(), effects).centroidal_matrix()
    }
}

/// A momentum in units of length as one in SI units.
#[cfg_attr(optimised, inline(always))]
fn force<R: Real>(all: &Totals<R>, length: f64) -> Force<R> {
    let h = all.momentum;
    Force::new(h.n.get(), h.f.scale(Folded::constant(1.0 / length)).get())
}

impl<R, T, E, const B: usize, const Q: usize, const V: usize> Call<'_, R, T, E, B, Q, V>
where
    R: Real,
    T: Compiled,
    E: Effect<R, B, V>,
{
    #[cfg_attr(optimised, inline(always))]
    fn centroidal_matrix(self) -> [Force<R>; V] {
        let mut columns = [Force::ZERO; V];
        let mut pass = Columns::<R, T, E, B, Q, V> { call: self, columns: &mut columns };
        let moving = sweep(&mut pass, &Pose::BASE);
        let all = moving + fixed(Remainder::<T, B, V>::AT_BASE);
        let (centre, _) = centre(all.mass, all.moment, T::LENGTH);
        for column in &mut columns {
            column.ang -= centre.cross(column.lin);
        }
        columns
    }
}

struct Columns<'a, R: Real, T, E, const B: usize, const Q: usize, const V: usize> {
    call: Call<'a, R, T, E, B, Q, V>,
    columns: &'a mut [Force<R>; V],
}

impl<R: Real, T: Compiled, E, const B: usize, const Q: usize, const V: usize> Pass
    for Columns<'_, R, T, E, B, Q, V>
where
    E: Effect<R, B, V>,
{
    type Tree = T;
    type Outward = Pose<R>;
    type Inward = Inertia<R>;
    const NOTHING: Inertia<R> = Inertia::NONE;

    #[cfg_attr(optimised, inline(always))]
    fn enter<const I: usize>(&mut self, parent: &Pose<R>) -> Pose<R> {
        parent.transformed_by::<T, I>(&self.call.displacement::<I>())
    }

    #[cfg_attr(optimised, inline(always))]
    fn leave<const I: usize>(&mut self, at: &Pose<R>, inner: Inertia<R>) -> Inertia<R> {
        let body = self.call.inertia::<I>(true) + inner;
        for_each_joint!(K, {
            if JointPair::<T, I, K>::IS_COORDINATE {
                self.columns[K] = column(at, &body, CompiledJoint::<T, K>::JOINT, T::LENGTH_INV);
            }
        });
        body.to_parent(&self.call.displacement::<I>())
    }
}

/// The momentum of a body at unit rate of a joint at its origin, about the base's origin and along
/// its axes.
#[cfg_attr(optimised, inline(always))]
fn column<R: Real>(
    at: &Pose<R>,
    body: &Inertia<R>,
    joint: &'static Joint,
    length_inv: f64,
) -> Force<R> {
    let length_inv = Folded::constant(length_inv);
    let h = body.wrench_of(joint, length_inv);
    let (n, f) = (at.axes.mul(h.n), at.axes.mul(h.f));
    Force::new((n + at.origin.cross(f)).get(), f.scale(length_inv).get())
}
