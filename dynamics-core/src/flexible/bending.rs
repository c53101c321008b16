//! [`Bending`]: links that bend of a robot known at compile time, by the textbook and by the
//! engine.

use core::borrow::Borrow;
use core::marker::PhantomData;

use super::compiled::CompiledModes;
use super::feedforward::correct;
use super::forward_dynamics::{accelerates, accelerations};
use super::{
    BendingRobot, FlexibleError, FlexibleInertia, JointsAndModes, ModalFeedforward, Modes, crba,
    forward_dynamics, modal_dynamics, rnea,
};
use crate::algorithms::MassMatrix;
use crate::effects::{Bias, Effect, Scene, add_inertia, all_transmitted, no_gyroscopic_rotors};
use crate::engine::Call;
use crate::model::{RobotModel, Static};
use crate::scalar::Real;
use crate::state::{Configuration, JointTrig, RobotState, State, entry};
use crate::trig::Kernel;
use crate::{Core, Engine};

/// The algorithms of the module for a robot and modes known at compile time: `Bending<Core<T>>` or
/// `Bending<Engine<T>>`.
///
/// The engine folds the integrals of the modes as it does all constants of a robot: of links that
/// bend in the plane in which they move, most are zero. It takes robots of up to 64 joints and
/// modes in all, whose joints have one degree of freedom, and whose bodies on fixed joints do not
/// bend; others do not compile.
///
/// ```
/// use dynamics_core::effects::{Elasticity, RIGID_BODY};
/// use dynamics_core::flexible::{Beam, Bending, BendingRobot, FlexibleLink, Modes, Shape};
/// use dynamics_core::model::{ArmModel, BASE, Body, Joint, Robot};
/// use dynamics_core::{Core, Engine, state::State};
///
/// const BEAM: Beam = Beam::new(0.5, 0.8).bending([4.0, 4.0]).tip(0.3, 1e-4);
/// const LINK: FlexibleLink = match BEAM.link(0, &[Shape::BendZ(1), Shape::BendZ(2)]) { Ok(link) => link, Err(_) => panic!() };
/// struct Boom;
/// impl Robot<1, 1, 1> for Boom {
///     const MODEL: ArmModel<f64, 1> = ArmModel::new("boom", [
///         Body::new("boom", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(BEAM.mass()).com(BEAM.com()).inertia(BEAM.inertia()),
///     ]);
/// }
/// impl BendingRobot<1, 1, 1, 2> for Boom {
///     const MODES: Modes<f64, 2> = Modes::new(&Self::MODEL, &[LINK]);
/// }
///
/// let scene = (RIGID_BODY, Elasticity);
/// let joint = State { q: [0.3_f64], qd: [2.0], qdd: [10.0] };
/// let bent = State { q: [-0.02, 0.001], qd: [0.5, -0.1], qdd: [3.0, 20.0] };
/// let (a, b) = (Bending::<Core<Boom>>::rnea(&joint, &bent, &scene), Bending::<Engine<Boom>>::rnea(&joint, &bent, &scene));
/// assert!((a.joints[0] - b.joints[0]).abs() < 1e-13 && (a.modes[1] - b.modes[1]).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Bending<A>(PhantomData<A>);

mod sealed {
    use super::{BendingRobot, Modes, Real};

    /// A scalar in which the table of a robot's modes is a constant.
    pub trait Table: Real {
        fn modes<T, const B: usize, const Q: usize, const V: usize, const M: usize>()
        -> &'static Modes<Self, M>
        where
            T: BendingRobot<B, Q, V, M>;
    }

    impl Table for f32 {
        fn modes<T, const B: usize, const Q: usize, const V: usize, const M: usize>()
        -> &'static Modes<f32, M>
        where
            T: BendingRobot<B, Q, V, M>,
        {
            const { &T::MODES.to_f32() }
        }
    }

    impl Table for f64 {
        fn modes<T, const B: usize, const Q: usize, const V: usize, const M: usize>()
        -> &'static Modes<f64, M>
        where
            T: BendingRobot<B, Q, V, M>,
        {
            const { &T::MODES }
        }
    }
}

use sealed::Table;

impl<T, K> Bending<Core<T, K>> {
    /// The torque of each motor, N·m or N, and the force on each mode: see [`rnea`](super::rnea()).
    #[inline(never)]
    #[must_use]
    pub fn rnea<R: Table, E, const B: usize, const Q: usize, const V: usize, const M: usize>(
        state: impl RobotState<R, Q, V>,
        bent: &State<R, M, M>,
        effects: &E,
    ) -> JointsAndModes<R, V, M>
    where
        T: BendingRobot<B, Q, V, M>,
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        rnea(&Static::<T, K>::NEW, R::modes::<T, B, Q, V, M>(), state, bent, effects)
    }

    /// The inertia M(q, η) of joints and modes: see [`crba`](super::crba()).
    #[inline(never)]
    #[must_use]
    pub fn crba<R: Table, E, const B: usize, const Q: usize, const V: usize, const M: usize>(
        q: &impl Configuration<R, Q>,
        eta: &[R; M],
        effects: &E,
    ) -> FlexibleInertia<R, V, M>
    where
        T: BendingRobot<B, Q, V, M>,
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        crba(&Static::<T, K>::NEW, R::modes::<T, B, Q, V, M>(), q, eta, effects)
    }

    /// The accelerations of joints and modes, rad/s² or m/s², under these torques of the motors:
    /// see [`forward_dynamics`](super::forward_dynamics()).
    ///
    /// # Errors
    /// [`FlexibleError`] names a joint or a mode that moves no inertia.
    #[inline(never)]
    pub fn forward_dynamics<
        R: Table,
        E,
        const B: usize,
        const Q: usize,
        const V: usize,
        const M: usize,
    >(
        state: impl RobotState<R, Q, V>,
        bent: &State<R, M, M>,
        tau: &[R; V],
        effects: &E,
    ) -> Result<JointsAndModes<R, V, M>, FlexibleError>
    where
        T: BendingRobot<B, Q, V, M>,
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        let modes = R::modes::<T, B, Q, V, M>();
        forward_dynamics(&Static::<T, K>::NEW, modes, state, bent, tau, effects)
    }

    /// The accelerations of the modes along a motion of the joints, m/s² or rad/s²: see
    /// [`modal_dynamics`](super::modal_dynamics()).
    ///
    /// # Errors
    /// [`FlexibleError::Mode`].
    #[inline(never)]
    pub fn modal_dynamics<
        R: Table,
        E,
        const B: usize,
        const Q: usize,
        const V: usize,
        const M: usize,
    >(
        state: impl RobotState<R, Q, V>,
        bent: &State<R, M, M>,
        effects: &E,
    ) -> Result<[R; M], FlexibleError>
    where
        T: BendingRobot<B, Q, V, M>,
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        modal_dynamics(&Static::<T, K>::NEW, R::modes::<T, B, Q, V, M>(), state, bent, effects)
    }

    /// The torques of the joints' motors at a tick of h seconds, N·m or N, at which the joints'
    /// motion is `reference`: see [`ModalFeedforward::tick`].
    ///
    /// # Errors
    /// Those of [`ModalFeedforward::tick`]; the modes are then unchanged.
    #[inline(never)]
    pub fn tick<R: Table, E, const B: usize, const Q: usize, const V: usize, const M: usize>(
        feedforward: &mut ModalFeedforward<R, M>,
        reference: &State<R, Q, V>,
        effects: &E,
        h: R,
    ) -> Result<[R; V], FlexibleError>
    where
        T: BendingRobot<B, Q, V, M>,
        Static<T, K>: RobotModel<R, B, Q, V>,
        E: Effect<R, B, V>,
    {
        const { Scene::<R, E, B, V>::OF_CORE };
        feedforward.tick(&Static::<T, K>::NEW, R::modes::<T, B, Q, V, M>(), reference, effects, h)
    }
}

impl<T, K> Bending<Engine<T, K>> {
    /// The torque of each motor, N·m or N, and the force on each mode at a state of joints and
    /// modes, as [`rnea`](super::rnea()) computes them.
    ///
    /// Effects as there; base parameters from memory do not compile. Angles as in [`Engine::rnea`].
    ///
    /// # Cost
    /// `docs/costs.md` in the repository, `two_link`; the same instructions for all data.
    ///
    /// # Source
    /// Book (1984), over base parameters: the mass of a body whose joint is on the very end of a
    /// link that bends is a point there.
    ///
    /// # Example
    /// See the example of [`Bending`]. A joint of several degrees of freedom does not compile:
    ///
    /// ```compile_fail,E0080
    /// # use dynamics_core::effects::RIGID_BODY;
    /// # use dynamics_core::flexible::{Beam, Bending, BendingRobot, FlexibleLink, Modes, Shape};
    /// # use dynamics_core::model::{BASE, Body, Joint, Model, Robot};
    /// # use dynamics_core::{Engine, state::State};
    /// # const BEAM: Beam = Beam::new(0.5, 0.8).bending([4.0, 4.0]).tip(0.3, 1e-4);
    /// # const LINK: FlexibleLink = match BEAM.link(0, &[Shape::BendZ(1)]) { Ok(link) => link, Err(_) => panic!() };
    /// # struct Boom;
    /// impl Robot<1, 4, 3> for Boom {
    ///     const MODEL: Model<f64, 1, 4, 3> = Model::new("boom", [
    ///         Body::new("boom", BASE, Joint::spherical()).mass(BEAM.mass()).com(BEAM.com()).inertia(BEAM.inertia()),
    ///     ]);
    /// }
    /// # impl BendingRobot<1, 4, 3, 1> for Boom { const MODES: Modes<f64, 1> = Modes::new(&Self::MODEL, &[LINK]); }
    /// let state = State { q: [1.0, 0.0, 0.0, 0.0], qd: [0.0; 3], qdd: [0.0; 3] };
    /// let _ = Bending::<Engine<Boom>>::rnea(&state, &State::at([0.0]), &RIGID_BODY);
    /// // error: robot `boom`, body `boom`: a joint has several degrees of freedom, which the engine does not take beside modes; use
    /// // `Core`
    /// ```
    #[inline(never)]
    #[must_use]
    pub fn rnea<R: Real, E, const B: usize, const Q: usize, const V: usize, const M: usize>(
        state: impl RobotState<R, Q, V>,
        bent: &State<R, M, M>,
        effects: &E,
    ) -> JointsAndModes<R, V, M>
    where
        T: BendingRobot<B, Q, V, M>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        const { taken::<T, R, E, B, Q, V, M>() };
        let trig = state.configuration().trig_or(Engine::<T, K>::trig_source::<B, V>());
        inverse::<T, R, E, B, Q, V, M>(trig.borrow(), state.state(), bent, effects)
    }

    /// The inertia M(q, η) of joints and modes, kg, kg·m or kg·m², as [`crba`](super::crba())
    /// computes it.
    ///
    /// # Shape
    /// Blocks of V × V, M × V and M × M.
    ///
    /// # Cost
    /// `docs/costs.md` in the repository, `two_link`: by columns, each of which is
    /// [`Bending::rnea`] of the unit acceleration of one coordinate at rest, so that it grows with
    /// the square of their number.
    ///
    /// # Source
    /// Walker & Orin (1982), method 1, over known zeros.
    ///
    /// # Example
    /// See the example of `forward_dynamics` of the same type.
    #[inline(never)]
    #[must_use]
    pub fn crba<R: Real, E, const B: usize, const Q: usize, const V: usize, const M: usize>(
        q: &impl Configuration<R, Q>,
        eta: &[R; M],
        effects: &E,
    ) -> FlexibleInertia<R, V, M>
    where
        T: BendingRobot<B, Q, V, M>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        const { taken::<T, R, E, B, Q, V, M>() };
        let trig = q.trig_or(Engine::<T, K>::trig_source::<B, V>());
        inertia::<T, R, E, B, Q, V, M>(trig.borrow(), eta, effects)
    }

    /// The accelerations of joints and modes, rad/s² or m/s², under these torques of the motors, as
    /// [`forward_dynamics`](super::forward_dynamics()) computes them.
    ///
    /// # Cost
    /// The cost of [`Bending::rnea`] without accelerations, of [`Bending::crba`], and (V + M)³ / 3
    /// flops.
    ///
    /// # Errors
    /// [`FlexibleError`] names a joint or a mode that moves no inertia, or whose acceleration is
    /// not finite. A coordinate on which nothing depends, such as the angle about a vertical axis
    /// on the base, is not read.
    ///
    /// ```
    /// # use dynamics_core::flexible::{Beam, BendingRobot, FlexibleLink, Modes, Shape};
    /// # use dynamics_core::model::{ArmModel, BASE, Body, Joint, Robot};
    /// use dynamics_core::effects::{Elasticity, RIGID_BODY};
    /// use dynamics_core::flexible::Bending;
    /// use dynamics_core::{Engine, state::State};
    /// # const BEAM: Beam = Beam::new(0.5, 0.8).bending([4.0, 4.0]).tip(0.3, 1e-4);
    /// # const LINK: FlexibleLink = match BEAM.link(0, &[Shape::BendZ(1)]) { Ok(link) => link, Err(_) => panic!() };
    /// # struct Boom;
    /// # impl Robot<1, 1, 1> for Boom {
    /// #     const MODEL: ArmModel<f64, 1> = ArmModel::new("boom", [
    /// #         Body::new("boom", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(BEAM.mass()).com(BEAM.com()).inertia(BEAM.inertia()),
    /// #     ]);
    /// # }
    /// # impl BendingRobot<1, 1, 1, 1> for Boom { const MODES: Modes<f64, 1> = Modes::new(&Self::MODEL, &[LINK]); }
    /// let scene = (RIGID_BODY, Elasticity);
    /// let (mut joint, mut bent) = (State::at([0.3_f64]), State::at([-0.02]));
    /// let found = Bending::<Engine<Boom>>::forward_dynamics(&joint, &bent, &[2.0], &scene)?;
    /// (joint.qdd, bent.qdd) = (found.joints, found.modes);
    /// let tau = Bending::<Engine<Boom>>::rnea(&joint, &bent, &scene);
    /// assert!((tau.joints[0] - 2.0).abs() < 1e-12 && tau.modes[0].abs() < 1e-12);
    /// let m = Bending::<Engine<Boom>>::crba(&joint.q, &bent.q, &scene);
    /// assert!(m.joints.get(0, 0) * m.modes.get(0, 0) > m.coupling[0][0] * m.coupling[0][0]);
    /// # Ok::<(), dynamics_core::flexible::FlexibleError>(())
    /// ```
    #[inline(never)]
    pub fn forward_dynamics<
        R: Real,
        E,
        const B: usize,
        const Q: usize,
        const V: usize,
        const M: usize,
    >(
        state: impl RobotState<R, Q, V>,
        bent: &State<R, M, M>,
        tau: &[R; V],
        effects: &E,
    ) -> Result<JointsAndModes<R, V, M>, FlexibleError>
    where
        T: BendingRobot<B, Q, V, M>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        const {
            taken::<T, R, E, B, Q, V, M>();
            accelerates::<R, E, B, V>();
        };
        let trig = state.configuration().trig_or(Engine::<T, K>::trig_source::<B, V>());
        let (trig, joints) = (trig.borrow(), state.state());
        let bias = inverse::<T, R, _, B, Q, V, M>(trig, joints, bent, &Bias(effects));
        let m = inertia::<T, R, E, B, Q, V, M>(trig, &bent.q, effects);
        let tau = all_transmitted(&Static::<T, K>::NEW, joints, effects, tau);
        m.solve(&JointsAndModes {
            joints: core::array::from_fn(|k| entry(&tau, k) - entry(&bias.joints, k)),
            modes: bias.modes.map(|force| -force),
        })
    }

    /// The accelerations η̈ of the modes along a motion of the joints, m/s² or rad/s², as
    /// [`modal_dynamics`](super::modal_dynamics()) computes them.
    ///
    /// # Cost
    /// The cost of [`Bending::rnea`], of the columns of the modes' inertia and of M³/3 flops for
    /// its factors.
    ///
    /// # Errors
    /// [`FlexibleError::Mode`].
    ///
    /// # Example
    /// See the example of [`Bending::tick`].
    #[inline(never)]
    pub fn modal_dynamics<
        R: Real,
        E,
        const B: usize,
        const Q: usize,
        const V: usize,
        const M: usize,
    >(
        state: impl RobotState<R, Q, V>,
        bent: &State<R, M, M>,
        effects: &E,
    ) -> Result<[R; M], FlexibleError>
    where
        T: BendingRobot<B, Q, V, M>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        const { taken::<T, R, E, B, Q, V, M>() };
        let trig = state.configuration().trig_or(Engine::<T, K>::trig_source::<B, V>());
        let (trig, joints) = (trig.borrow(), state.state());
        let coasting = State { qdd: [R::ZERO; M], ..*bent };
        let force = inverse::<T, R, E, B, Q, V, M>(trig, joints, &coasting, effects).modes;
        let m = of_modes::<T, R, E, B, Q, V, M>(trig, &bent.q, effects);
        accelerations(&m, force)
    }

    /// The torques of the joints' motors at a tick of h seconds, N·m or N, at which the joints'
    /// motion is `reference`, as [`ModalFeedforward::tick`] computes them. To be called once in
    /// every tick.
    ///
    /// # Cost
    /// Two calls of [`Bending::rnea`] and one of [`Bending::modal_dynamics`] without it, sines and
    /// cosines once.
    ///
    /// # Errors
    /// Those of [`ModalFeedforward::tick`]; the modes are then unchanged.
    ///
    /// ```
    /// # use dynamics_core::flexible::{Beam, BendingRobot, FlexibleLink, Modes, Shape};
    /// # use dynamics_core::model::{ArmModel, BASE, Body, Joint, Robot};
    /// use dynamics_core::effects::{Elasticity, RIGID_BODY};
    /// use dynamics_core::flexible::{Bending, ModalFeedforward};
    /// use dynamics_core::{Core, Engine, model::Static, state::State};
    /// # const BEAM: Beam = Beam::new(0.5, 0.8).bending([4.0, 4.0]).tip(0.3, 1e-4);
    /// # const LINK: FlexibleLink = match BEAM.link(0, &[Shape::BendZ(1)]) { Ok(link) => link, Err(_) => panic!() };
    /// # struct Boom;
    /// # impl Robot<1, 1, 1> for Boom {
    /// #     const MODEL: ArmModel<f64, 1> = ArmModel::new("boom", [
    /// #         Body::new("boom", BASE, Joint::revolute([0.0, 1.0, 0.0])).mass(BEAM.mass()).com(BEAM.com()).inertia(BEAM.inertia()),
    /// #     ]);
    /// # }
    /// # impl BendingRobot<1, 1, 1, 1> for Boom { const MODES: Modes<f64, 1> = Modes::new(&Self::MODEL, &[LINK]); }
    /// let scene = (RIGID_BODY, Elasticity);
    /// let mut core = ModalFeedforward::at_rest(&Static::<Boom>::NEW, &Boom::MODES, &[0.0], &scene)?;
    /// let mut engine = core;
    /// let reference = State { q: [0.0], qd: [0.0], qdd: [5.0] };
    /// let tau = Bending::<Engine<Boom>>::tick(&mut engine, &reference, &scene, 1e-3)?;
    /// let same = Bending::<Core<Boom>>::tick(&mut core, &reference, &scene, 1e-3)?;
    /// assert!((tau[0] - same[0]).abs() < 1e-12 && (engine.bent.q[0] - core.bent.q[0]).abs() < 1e-15);
    /// let free = Bending::<Engine<Boom>>::modal_dynamics(&reference, &engine.bent, &scene)?; // η̈, m/s²
    /// # assert!((free[0] - Bending::<Core<Boom>>::modal_dynamics(&reference, &engine.bent, &scene)?[0]).abs() < 1e-9);
    /// # Ok::<(), dynamics_core::flexible::FlexibleError>(())
    /// ```
    #[inline(never)]
    pub fn tick<R: Table, E, const B: usize, const Q: usize, const V: usize, const M: usize>(
        feedforward: &mut ModalFeedforward<R, M>,
        reference: &State<R, Q, V>,
        effects: &E,
        h: R,
    ) -> Result<[R; V], FlexibleError>
    where
        T: BendingRobot<B, Q, V, M>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        const { taken::<T, R, E, B, Q, V, M>() };
        let trig: JointTrig<R, Q> = Engine::<T, K>::joint_trig(&reference.q);
        let mut bent = feedforward.ahead(h);
        let force = inverse::<T, R, E, B, Q, V, M>(&trig, reference, &bent, effects).modes;
        let m = of_modes::<T, R, E, B, Q, V, M>(&trig, &bent.q, effects);
        let elastic = E::ELASTICITY.then(R::modes::<T, B, Q, V, M>);
        correct(&mut bent, &m, force, elastic, h)?;
        let tau = inverse::<T, R, E, B, Q, V, M>(&trig, reference, &bent, effects).joints;
        feedforward.accept(bent, tau)
    }
}

#[cfg_attr(optimised, inline(always))]
fn inverse<T, R: Real, E, const B: usize, const Q: usize, const V: usize, const M: usize>(
    trig: &JointTrig<R, Q>,
    joints: &State<R, Q, V>,
    bent: &State<R, M, M>,
    effects: &E,
) -> JointsAndModes<R, V, M>
where
    T: BendingRobot<B, Q, V, M>,
    E: Effect<R, B, V>,
{
    let (joints, modes) =
        Call::<R, CompiledModes<T, B, Q, V, M>, E, B, Q, V>::new(&trig.coordinates, effects)
            .bending_torques(joints, bent);
    JointsAndModes { joints, modes }
}

#[cfg_attr(optimised, inline(always))]
fn inertia<T, R: Real, E, const B: usize, const Q: usize, const V: usize, const M: usize>(
    trig: &JointTrig<R, Q>,
    eta: &[R; M],
    effects: &E,
) -> FlexibleInertia<R, V, M>
where
    T: BendingRobot<B, Q, V, M>,
    E: Effect<R, B, V>,
{
    let (joints, coupling, modes) =
        Call::<R, CompiledModes<T, B, Q, V, M>, E, B, Q, V>::new(&trig.coordinates, effects)
            .bending_inertia::<M, true>(eta);
    let mut m = FlexibleInertia {
        joints: MassMatrix { rows: joints },
        coupling,
        modes: MassMatrix { rows: modes },
    };
    for joint in 0..V {
        if let Some(diagonal) = m.joints.diagonal_mut(joint) {
            add_inertia(effects, joint, diagonal);
        }
    }
    m
}

/// The inertia of the modes alone.
#[cfg_attr(optimised, inline(always))]
fn of_modes<T, R: Real, E, const B: usize, const Q: usize, const V: usize, const M: usize>(
    trig: &JointTrig<R, Q>,
    eta: &[R; M],
    effects: &E,
) -> [[R; M]; M]
where
    T: BendingRobot<B, Q, V, M>,
    E: Effect<R, B, V>,
{
    Call::<R, CompiledModes<T, B, Q, V, M>, E, B, Q, V>::new(&trig.coordinates, effects)
        .bending_inertia::<M, false>(eta)
        .2
}

/// A robot and a scene that the engine takes with modes.
const fn taken<T, R: Real, E, const B: usize, const Q: usize, const V: usize, const M: usize>()
where
    T: BendingRobot<B, Q, V, M>,
    E: Effect<R, B, V>,
{
    let _ = CompiledModes::<T, B, Q, V, M>::ENDS;
    let () = Scene::<R, E, B, V>::OF_CORE;
    no_gyroscopic_rotors::<R, E, B, V>();
}
