//! [`Clustered`]: the algorithms for a robot with clusters.

use core::marker::PhantomData;

use super::description::{TreeState, sealed::Set};
use super::layout::NONE;
use super::{ClusterError, ClusteredRobot, TreeMotion};
use crate::algorithms::rnea;
use crate::effects::Effect;
use crate::model::{JointCoordinate, JointKind, Robot, RobotModel, Static};
use crate::scalar::Real;
use crate::state::{JointTrig, State, entry};
use crate::trig::Kernel;
use crate::{Core, Engine};

/// The algorithms for a robot with clusters by those of its tree: `Clustered<Core<T>>` or `Clustered<Engine<T>>`.
///
/// States are those of y: see [`ClusteredRobot`].
#[derive(Clone, Copy, Debug)]
pub struct Clustered<A>(PhantomData<A>);

/// The kernel K without its form for small angles, which the engine takes and the core does not.
#[derive(Clone, Copy, Debug)]
pub struct Unbounded<K>(PhantomData<K>);

impl<R, K: Kernel<R>> Kernel<R> for Unbounded<K> {
    #[inline(always)]
    fn sin_cos(x: R) -> (R, R) {
        K::sin_cos(x)
    }
}

/// The algorithms of a tree: [`Core`] or [`Engine`].
pub trait TreeAlgorithms<R: Real, const B: usize, const Q: usize, const V: usize>:
    sealed::Tree<R, B, Q, V>
{
}

impl<A, R: Real, const B: usize, const Q: usize, const V: usize> TreeAlgorithms<R, B, Q, V> for A where
    A: sealed::Tree<R, B, Q, V>
{
}

mod sealed {
    use super::{Effect, JointTrig, Kernel, Real, Robot, State};

    /// What there is of core and engine.
    pub trait Tree<R: Real, const B: usize, const Q: usize, const V: usize> {
        /// The robot.
        type Robot: Robot<B, Q, V>;
        /// Its sines and cosines.
        type Kernel: Kernel<R>;

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

    #[inline(always)]
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

    #[inline(always)]
    fn rnea<E: Effect<R, B, V>>(
        trig: &JointTrig<R, Q>,
        state: &State<R, Q, V>,
        effects: &E,
    ) -> [R; V] {
        Engine::<T>::run(trig, trig, state, effects)
    }
}

impl<A> Clustered<A> {
    /// The tree's state at y, ẏ, ÿ, and G, for every algorithm of a tick.
    ///
    /// # Cost
    /// That of the clusters, and a sine and cosine for each angle in no cluster.
    ///
    /// # Errors
    /// [`ClusterError`] names the cluster that no configuration closes at y.
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

    /// τ_y = Gᵀ ID(γ(y), G ẏ, G ÿ + Ġ ẏ): the torques at y, N·m or N, under the effects of the scene.
    ///
    /// Gravity alone: the same with `&Gravity::EARTH`. Effects act on the tree: friction and rotors are of its coordinates.
    ///
    /// # Shape
    /// Y.
    ///
    /// # Cost
    /// That of the tree's `rnea` without the sines of the dependent angles, that of the clusters, and 2 M N flops for each.
    ///
    /// # Errors
    /// [`ClusterError`] names the cluster that no configuration closes at y.
    ///
    /// # Source
    /// Jain (2011), section 11.4; Featherstone, RBDA (2008), (3.16), G being the null space of the loops' constraints.
    ///
    /// # Example
    /// That of [the module](super).
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
        let motion = evaluate::<R, A, B, Q, V, P, Y>(y)?;
        Ok(motion.torque(&A::rnea(&motion.trig, &motion.tree, effects)))
    }
}

/// The tree's state, and the motions of its clusters.
#[inline(always)]
fn evaluate<R, A, const B: usize, const Q: usize, const V: usize, const P: usize, const Y: usize>(
    y: &State<R, P, Y>,
) -> Result<TreeMotion<R, A::Robot, B, Q, V, P, Y>, ClusterError>
where
    R: Real,
    A: TreeAlgorithms<R, B, Q, V>,
    A::Robot: ClusteredRobot<B, Q, V, P, Y>,
{
    let layout = const { &TreeMotion::<R, A::Robot, B, Q, V, P, Y>::LAYOUT };
    let mut tree = State {
        q: layout.free_q.map(|place| entry(&y.q, place)),
        qd: layout.free.map(|place| entry(&y.qd, place)),
        qdd: layout.free.map(|place| entry(&y.qdd, place)),
    };
    let mut turns = [JointCoordinate::default(); Q];
    let robot = Static::<A::Robot, A::Kernel>::NEW;
    for link in robot.links() {
        let v = link.idx_v();
        if v >= V || entry(&layout.cluster, v) != NONE {
            continue;
        }
        let near =
            link.limits.lower >= R::from_f64(-FOUR_PI) && link.limits.upper <= R::from_f64(FOUR_PI);
        let turns_about_z = matches!(link.kind(), JointKind::Revolute | JointKind::Continuous);
        if turns_about_z && near {
            if let Some(turn) = turns.get_mut(link.idx_q()) {
                *turn =
                    JointCoordinate::revolute_bounded::<A::Kernel>(entry(&tree.q, link.idx_q()));
            }
        } else {
            link.pose::<A::Kernel>(&tree.q, &mut turns);
        }
    }
    let set = const { <A::Robot as ClusteredRobot<B, Q, V, P, Y>>::CLUSTERS };
    let motions = set.evaluate::<R, A::Kernel, A::Robot, B, Q, V, P, Y>(
        y,
        &mut TreeState {
            turns: &mut turns,
            state: &mut tree,
        },
    )?;
    Ok(TreeMotion {
        trig: JointTrig { turns },
        tree,
        motions,
        one: [R::ONE],
    })
}

/// The bound that the engine takes for that of a small angle.
const FOUR_PI: f64 = 4.0 * core::f64::consts::PI;
