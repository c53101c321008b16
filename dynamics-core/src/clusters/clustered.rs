//! [`Clustered`]: the algorithms for a robot with clusters.

use super::places::{TreeCoordinate, TreeLayout};
use core::marker::PhantomData;

use super::description::{TreeState, sealed::Set};
use super::layout::{EXPANDED, NONE};
use super::{ClusterError, ClusteredRobot, TreeMotion};
use crate::algorithms::rnea;
use crate::effects::{Declared, Effect, OfBodies, no_load_friction};
use crate::engine::{
    CompiledJoint, CompiledRobot, Index, for_each_joint, has_subtree_functions, joint_state,
};
use crate::model::{JointCoordinate, Robot, RobotModel, Static};
use crate::scalar::Real;
use crate::state::{JointTrig, State, entry};
use crate::trig::Kernel;
use crate::{Core, Engine};

/// The algorithms for a robot with clusters by those of its tree: `Clustered<Core<T>>` or
/// `Clustered<Engine<T>>`.
///
/// States are those of y: see [`ClusteredRobot`].
#[derive(Clone, Copy, Debug)]
pub struct Clustered<A>(PhantomData<A>);

/// The kernel K without its form for small angles, which the engine takes and the core does not.
#[derive(Clone, Copy, Debug)]
#[doc(hidden)]
pub struct Unbounded<K>(PhantomData<K>);

impl<R, K: Kernel<R>> Kernel<R> for Unbounded<K> {
    #[cfg_attr(optimised, inline(always))]
    fn sin_cos(x: R) -> (R, R) {
        K::sin_cos(x)
    }
}

/// The algorithms of a tree: [`Core`] or [`Engine`].
#[doc(hidden)]
pub trait TreeAlgorithms<R: Real, const B: usize, const Q: usize, const V: usize>:
    sealed::Tree<R, B, Q, V>
{
}

impl<A, R: Real, const B: usize, const Q: usize, const V: usize> TreeAlgorithms<R, B, Q, V> for A where
    A: sealed::Tree<R, B, Q, V>
{
}

pub(super) mod sealed {
    use super::{ClusteredRobot, Effect, JointCoordinate, JointTrig, Kernel, Real, Robot, State};

    /// The functions of core and engine that robots with clusters need.
    pub trait Tree<R: Real, const B: usize, const Q: usize, const V: usize> {
        /// The robot.
        type Robot: Robot<B, Q, V>;
        /// Its sines and cosines.
        type Kernel: Kernel<R>;

        /// Sines and cosines of the coordinates in no cluster.
        fn free_turns<const P: usize, const Y: usize>(
            q: &[R; Q],
            turns: &mut [JointCoordinate<R>; Q],
        ) where
            Self::Robot: ClusteredRobot<B, Q, V, P, Y>;

        /// Inverse dynamics of the tree.
        fn rnea<E: Effect<R, B, V>>(
            trig: &JointTrig<R, Q>,
            state: &State<R, Q, V>,
            effects: &E,
        ) -> [R; V];
    }
}

impl<T, K, R: Real, const B: usize, const Q: usize, const V: usize> sealed::Tree<R, B, Q, V>
    for Core<T, K>
where
    T: Robot<B, Q, V>,
    K: Kernel<R>,
{
    type Robot = T;
    type Kernel = Unbounded<K>;

    #[cfg_attr(optimised, inline(always))]
    fn free_turns<const P: usize, const Y: usize>(q: &[R; Q], turns: &mut [JointCoordinate<R>; Q])
    where
        T: ClusteredRobot<B, Q, V, P, Y>,
    {
        let layout = TreeLayout::<T, B, Q, V, P, Y>::LAYOUT;
        for link in Static::<T, K>::NEW.links() {
            let v = link.coordinates().start;
            if layout.cluster.get(v) == Some(&NONE) {
                link.pose::<K>(q, turns);
            }
        }
    }

    #[cfg_attr(optimised, inline(always))]
    fn rnea<E: Effect<R, B, V>>(
        trig: &JointTrig<R, Q>,
        state: &State<R, Q, V>,
        effects: &E,
    ) -> [R; V] {
        rnea(&Static::<T, K>::NEW, trig.with(state), effects)
    }
}

impl<T, K, R: Real, const B: usize, const Q: usize, const V: usize> sealed::Tree<R, B, Q, V>
    for Engine<T, K>
where
    T: Robot<B, Q, V>,
    K: Kernel<R>,
{
    type Robot = T;
    type Kernel = K;

    #[cfg_attr(optimised, inline(always))]
    fn free_turns<const P: usize, const Y: usize>(q: &[R; Q], turns: &mut [JointCoordinate<R>; Q])
    where
        T: ClusteredRobot<B, Q, V, P, Y>,
    {
        for_each_joint!(J, {
            if TreeCoordinate::<T, B, Q, V, P, Y, J>::IS_FREE {
                CompiledJoint::<CompiledRobot<T, B, Q, V>, J>::turn::<R, K, Q>(q, turns);
            }
        });
    }

    #[cfg_attr(optimised, inline(always))]
    fn rnea<E: Effect<R, B, V>>(
        trig: &JointTrig<R, Q>,
        state: &State<R, Q, V>,
        effects: &E,
    ) -> [R; V] {
        if const { !has_subtree_functions::<CompiledRobot<T, B, Q, V>>(E::WRENCH) } {
            return Engine::<T>::run(trig, trig, state, effects);
        }
        // Functions of subtrees get the state in memory, and with it angles of which only effects
        // at joints read more than sine and cosine: these are added here.
        let mut turns = *trig;
        for_each_joint!(J, {
            if Index::<J, V>::IS_BELOW
                && CompiledJoint::<CompiledRobot<T, B, Q, V>, J>::IS_TURN
                && let Some(k) = CompiledJoint::<CompiledRobot<T, B, Q, V>, J>::POSITION
            {
                turns.coordinates[k].q = R::ZERO;
            }
        });
        let at_zero = State { q: [R::ZERO; Q], ..*state };
        let mut tau = Engine::<T>::run(&turns, &turns, &at_zero, &OfBodies(effects));
        for_each_joint!(J, {
            if Index::<J, V>::IS_BELOW {
                let at = joint_state::<R, CompiledRobot<T, B, Q, V>, Q, V, J>(state);
                effects.torque(J, at, &mut tau[J]);
                if let Some(inertia) = effects.inertia(J) {
                    tau[J] += inertia * state.qdd[J];
                }
            }
        });
        tau
    }
}

impl<A> Clustered<A> {
    /// The tree's state at y, ẏ, ÿ, and G, for every algorithm of a tick.
    ///
    /// # Cost
    /// The cost of the clusters, and a sine and cosine for each angle in no cluster.
    ///
    /// # Errors
    /// [`ClusterError`] names the cluster that no configuration closes at y.
    ///
    /// # Example
    /// See the example of [`TreeMotion`].
    #[inline(never)]
    pub fn motion<
        R,
        const B: usize,
        const Q: usize,
        const V: usize,
        const P: usize,
        const Y: usize,
    >(
        y: &State<R, P, Y>,
    ) -> Result<TreeMotion<R, A::Robot, B, Q, V, P, Y>, ClusterError>
    where
        R: Real,
        A: TreeAlgorithms<R, B, Q, V>,
        A::Robot: ClusteredRobot<B, Q, V, P, Y>,
    {
        evaluate::<R, A, B, Q, V, P, Y>(y)
    }

    /// τ_y = Gᵀ ID(γ(y), G ẏ, G ÿ + Ġ ẏ): the torques at y, N·m or N, under the effects of the
    /// scene.
    ///
    /// Gravity alone: the same with `&Gravity::EARTH`. Effects act on the tree: friction and rotors
    /// are of its coordinates.
    ///
    /// Towards a singular configuration of a cluster the torques grow without bound, and this
    /// result does not say so: [`Clustered::rnea_with_status`] does.
    ///
    /// # Shape
    /// Y.
    ///
    /// # Cost
    /// The cost of the tree's `rnea` without the sines of the dependent angles, that of the
    /// clusters, and 2 M N flops for each. The same instructions for all data, but at
    /// singularities. Dependent angles themselves, which only effects of joints read, cost an arc
    /// tangent each where one does, in the core, and in the engine on trees of more than 16 joints
    /// with wrenches on bodies.
    ///
    /// # Errors
    /// [`ClusterError`] names the cluster that no configuration closes at y; and where a torque is
    /// not finite, the first cluster with such a one, or the robot.
    ///
    /// # Source
    /// Jain (2011), section 11.4; Featherstone, RBDA (2008), (3.16), G being the null space of the
    /// loops' constraints.
    ///
    /// # Example
    /// See the example of [the module](super).
    #[inline(never)]
    pub fn rnea<
        R,
        E,
        const B: usize,
        const Q: usize,
        const V: usize,
        const P: usize,
        const Y: usize,
    >(
        y: &State<R, P, Y>,
        effects: &E,
    ) -> Result<[R; Y], ClusterError>
    where
        R: Real,
        A: TreeAlgorithms<R, B, Q, V>,
        A::Robot: ClusteredRobot<B, Q, V, P, Y>,
        E: Effect<R, B, V>,
    {
        no_load_friction::<R, E, B, V>();
        let motion = evaluate::<R, A, B, Q, V, P, Y>(y)?;
        let tau = A::rnea(&motion.trig, &motion.tree, effects);
        TreeMotion::<R, A::Robot, B, Q, V, P, Y>::finite(motion.torque(&tau))
    }
}

/// The tree's state, and the motions of its clusters.
#[cfg_attr(optimised, inline(always))]
pub(super) fn evaluate<
    R,
    A,
    const B: usize,
    const Q: usize,
    const V: usize,
    const P: usize,
    const Y: usize,
>(
    y: &State<R, P, Y>,
) -> Result<TreeMotion<R, A::Robot, B, Q, V, P, Y>, ClusterError>
where
    R: Real,
    A: TreeAlgorithms<R, B, Q, V>,
    A::Robot: ClusteredRobot<B, Q, V, P, Y>,
{
    let layout = TreeLayout::<A::Robot, B, Q, V, P, Y>::LAYOUT;
    let mut tree = State { q: [R::ZERO; Q], qd: [R::ZERO; V], qdd: [R::ZERO; V] };
    // Not by loops alone, which might not be unrolled: the tree's state would stay in memory, and
    // with it numbers that no effect reads.
    for_each_joint!(J, {
        let p = TreeCoordinate::<A::Robot, B, Q, V, P, Y, J>::FREE_POSITION;
        let y_k = TreeCoordinate::<A::Robot, B, Q, V, P, Y, J>::FREE_VELOCITY;
        if p < P {
            tree.q[J] = y.q[p];
        }
        if y_k < Y {
            (tree.qd[J], tree.qdd[J]) = (y.qd[y_k], y.qdd[y_k]);
        }
    });
    if const { Q > EXPANDED } {
        for (q, &place) in tree.q.iter_mut().zip(&layout.free_q).skip(EXPANDED) {
            *q = entry(&y.q, place);
        }
        let rates = tree.qd.iter_mut().zip(&mut tree.qdd);
        for ((qd, qdd), &place) in rates.zip(&layout.free).skip(EXPANDED) {
            (*qd, *qdd) = (entry(&y.qd, place), entry(&y.qdd, place));
        }
    }
    let mut turns = [JointCoordinate::default(); Q];
    A::free_turns::<P, Y>(&tree.q, &mut turns);
    let set = const { <A::Robot as ClusteredRobot<B, Q, V, P, Y>>::CLUSTERS };
    let motions = set.evaluate::<R, A::Kernel, A::Robot, B, Q, V, P, Y>(
        y,
        &mut TreeState { turns: &mut turns, state: &mut tree },
    )?;
    Ok(TreeMotion { trig: JointTrig { coordinates: turns }, tree, motions, one: [R::ONE] })
}
