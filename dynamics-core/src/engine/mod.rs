//! The engine: the algorithms of a robot known at compile time, specialised by the compiler.
//!
//! The functions have the robot, state, effects and names of [`crate::Core`]: a user switches by
//! changing one word. There is no code generator, and no nightly compiler is needed: [`folding`]
//! removes products with constants of the robot that are 0, 1 or −1, [`compile`] regroups its
//! inertias to base parameters at compile time, and one recursion over its bodies keeps
//! intermediate values in registers.
//!
//! Functions are inlined by force where this crate is optimised (the cfg `optimised`, which the
//! build script sets): the folding needs it, and forced inlining at opt-level 0 has fifty times the
//! code.
//!
//! Joints: all kinds ([`crate::model::JointKind`]), on trees of up to 64 velocity coordinates.

/// Expands a block once for each joint that there may be, its number a constant: loops are not
/// unrolled at every opt-level, and a constant can be a const generic argument.
///
/// With a condition and a function, only for joints that meet it: see [`only_if`]. The functions
/// of all joints are one constant, since the compiler would evaluate 64 of them in each instance.
macro_rules! for_each_joint {
    ($j:ident, $condition:expr, $name:ident = $function:expr, $body:block) => {
        for_each_joint!(@all functions $j ($condition) $name ($function) $body)
    };
    ($j:ident, $body:block) => {
        for_each_joint!(@all joints $j $body)
    };
    (@all $($site:tt)*) => {
        for_each_joint!(@ $($site)* 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15
            16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31 32 33 34 35 36 37 38 39 40 41 42 43 44 45 46 47
            48 49 50 51 52 53 54 55 56 57 58 59 60 61 62 63)
    };
    (@ functions $j:ident ($condition:expr) $name:ident ($function:expr) $body:block $($n:literal)*) => {
        let functions = const {
            &[$({
                const $j: usize = $n;
                $crate::engine::only_if($condition, $function)
            }),*]
        };
        for_each_joint!(@ joints $j {
            if $condition
                && let Some($name) = functions[$j]
            {
                $body
            }
        } $($n)*);
    };
    (@ joints $j:ident $body:block $($n:literal)*) => {$({
        const $j: usize = $n;
        $body
    })*};
}

pub(crate) use for_each_joint;

/// [`for_each_joint`] from the last joint to the first.
macro_rules! for_each_joint_reversed {
    ($j:ident, $body:block) => {
        for_each_joint!(N, {
            const $j: usize = 63 - N;
            $body
        })
    };
}

/// The place I in a list of N: a constant with a name, which the compiler evaluates once, and not
/// in each instance of a function.
pub(crate) struct Index<const I: usize, const N: usize>;

impl<const I: usize, const N: usize> Index<I, N> {
    /// Whether there is an I-th.
    pub(crate) const IS_BELOW: bool = I < N;
}

/// The function if the condition holds, for an inline `const`. A call in a branch that is never
/// taken would still make the compiler visit its function and all that this calls: 64 × 64 pairs of
/// joints in place of those that exist. The condition stands before it, too: without optimisation
/// that alone keeps the branch out of the machine code.
const fn only_if<F: Copy>(condition: bool, function: F) -> Option<F> {
    if condition { Some(function) } else { None }
}

/// Fails to compile, in the body of the public function that it stands in, for a robot `T` and
/// Effects that the engine does not take.
macro_rules! scene_is_taken {
    () => {
        const { $crate::engine::gate::EngineScene::<T, R, E, B, Q, V>::TAKEN }
    };
}

mod aba;
mod acceleration_field;
mod acceleration_gradient;
mod articulated_inertia;
mod base;
mod base_parameters;
mod bending;
mod call;
mod centroidal;
mod compile;
mod crba;
mod derivatives;
mod displacement;
mod energy;
mod folding;
mod forward_dynamics;
mod free_base;
mod gate;
mod hybrid_dynamics;
mod jacobian;
mod joint_rates;
mod kinematics;
mod ltdl;
mod momentum;
mod named;
mod operational_space;
mod parallel_axes;
mod pass;
mod pivot_noise;
mod pose;
mod reaction;
mod regressor;
mod rnea;
mod rotors;
mod subtree;
mod torque_rates;
mod totals;
mod tree_matrix;
mod wrenches;

use core::borrow::Borrow;
use core::hint::black_box;
use core::marker::PhantomData;

use crate::effects::Effect;
use crate::model::{JointCoordinate, Robot};
use crate::scalar::{Native, Real};
use crate::state::{Configuration, JointTrig, RobotState, State, TrigSource};
use crate::trig::{Kernel, VECTORS};
pub(crate) use bending::{BendingLink, BendingMode, Bends, MODES};
pub(crate) use call::{Call, joint_state};
pub(crate) use compile::{
    BendingTree, BodyPlacement, Compiled, CompiledJoint, CompiledRobot, Joint, JointMotion,
    compile_bending, has_subtree_functions, mat_add, outer, support,
};
pub use tree_matrix::{TreeLtdl, TreeMatrix};

/// The algorithms specialised at compile time for the robot `T`; sines and cosines by the kernel
/// `K`.
///
/// Robots: trees of up to 64 velocity coordinates on joints of any kind. Any number of bodies may
/// be welded to one moving body, but at most 32 in a scene with wrenches
/// ([`crate::effects::Contact`], [`crate::effects::BodyWrench`] and others that act on a body).
/// Others do not compile; use [`crate::Core`] for them.
///
/// ```
/// use dynamics_core::{Core, Engine, effects::RIGID_BODY, robots::Ur5e, state::State};
/// let state = State { q: [0.1_f32; 6], qd: [0.5; 6], qdd: [1.0; 6] };
/// let (a, b) = (Core::<Ur5e>::rnea(&state, &RIGID_BODY), Engine::<Ur5e>::rnea(&state, &RIGID_BODY));
/// assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 4e-5));
/// ```
///
/// The base of a robot may be free: six velocity coordinates and a unit quaternion, as of
/// [`JointKind::Free`](crate::model::JointKind::Free).
///
/// ```
/// use dynamics_core::{Engine, effects::RIGID_BODY, robots::A1Free, state::State};
/// let mut standing = State::at([0.0_f32; 19]);
/// standing.q[3] = 1.0; // no rotation
/// let tau = Engine::<A1Free>::rnea(&standing, &RIGID_BODY);
/// assert!((tau[5] - 134.8).abs() < 0.1); // its weight, N
/// ```
///
/// A robot of more coordinates does not compile:
///
/// ```compile_fail,E0080
/// use dynamics_core::{Engine, model::{ArmModel, BASE, Body, Joint, Model, Robot}};
/// struct Comb;
/// impl Robot<65, 65, 65> for Comb {
///     const MODEL: ArmModel<f64, 65> = Model::new("comb", [Body::new("tooth", BASE, Joint::prismatic([1.0, 0.0, 0.0])); 65]);
/// }
/// let _ = Engine::<Comb>::joint_trig(&[0.1_f32; 65]);
/// // error: the engine takes up to 64 velocity coordinates; use `Core`
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Engine<T, K = Native>(PhantomData<(T, K)>);

impl<T, K> Engine<T, K> {
    /// The sines and cosines of the configuration q, for every algorithm of a tick.
    #[cfg_attr(optimised, inline(always))]
    #[must_use]
    pub fn joint_trig<R: Real, const B: usize, const Q: usize, const V: usize>(
        q: &[R; Q],
    ) -> JointTrig<R, Q>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
    {
        if let Some(near) = const { CompiledRobot::<T, B, Q, V>::ALL_TURN }
            && VECTORS
        {
            let coordinates = if near {
                JointCoordinate::of_all::<K, true, Q>(q)
            } else {
                JointCoordinate::of_all::<K, false, Q>(q)
            };
            return JointTrig { coordinates };
        }
        let mut turns = [JointCoordinate::default(); Q];
        for_each_joint!(J, {
            if Index::<J, V>::IS_BELOW {
                CompiledJoint::<CompiledRobot<T, B, Q, V>, J>::turn::<R, K, Q>(q, &mut turns);
            }
        });
        JointTrig { coordinates: turns }
    }

    /// τ = ID(q, q̇, q̈): the torque of each motor, N·m or N, as [`crate::algorithms::rnea()`]
    /// computes it.
    ///
    /// Sines and cosines that no effect in the scene needs are not computed. Angles of joints whose
    /// limits lie within ±4π may be up to ±100 rad, others up to ±10⁴ rad.
    ///
    /// # Cost
    /// `docs/costs.md` in the repository; the same instructions for all data. The savings of less
    /// accurate kernels are in `docs/accuracy.md`:
    ///
    /// ```
    /// use dynamics_core::{Engine, effects::RIGID_BODY, robots::Ur5e, state::State, trig::Table};
    /// let state = State { q: [0.1_f32; 6], qd: [0.5; 6], qdd: [1.0; 6] };
    /// let tau = Engine::<Ur5e, Table<256, 1>>::rnea(&state, &RIGID_BODY);
    /// # assert!((tau[1] - Engine::<Ur5e>::rnea(&state, &RIGID_BODY)[1]).abs() < 0.02);
    /// ```
    ///
    /// # Source
    /// Featherstone & Orin (2000), (3) to (8), over base parameters.
    #[doc(alias = "ID")]
    #[doc(alias = "inverse dynamics")]
    #[inline(never)]
    pub fn rnea<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> [R; V]
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        let trig = state.configuration().trig_or(Self::trig_source());
        let trig = trig.borrow();
        // Not needed for gravity alone.
        let back = if const { E::VELOCITY_PRODUCTS | E::ACCELERATIONS } {
            loaded_again(&state, trig)
        } else {
            trig
        };
        Self::call(trig, effects).torques(&back.coordinates, state.state())
    }
}

/// The same sines and cosines. Precomputed ones are loaded again on the inward pass: `black_box`
/// hides from the compiler that both references are the same, since it would spill the loaded
/// values to the stack.
#[cfg_attr(optimised, inline(always))]
fn loaded_again<'a, R: Real, State: RobotState<R, Q, V>, const Q: usize, const V: usize>(
    _: &State,
    trig: &'a JointTrig<R, Q>,
) -> &'a JointTrig<R, Q> {
    if const { State::Configuration::PRECOMPUTED } { black_box(trig) } else { trig }
}

/// [`Engine::joint_trig`] of a robot of B bodies and V velocity coordinates.
pub(crate) struct Specialised<T, K, const B: usize, const V: usize>(PhantomData<(T, K)>);

impl<R: Real, T, K, const B: usize, const Q: usize, const V: usize> TrigSource<R, Q>
    for Specialised<T, K, B, V>
where
    T: Robot<B, Q, V>,
    K: Kernel<R>,
{
    #[cfg_attr(optimised, inline(always))]
    fn compute(&self, q: &[R; Q]) -> JointTrig<R, Q> {
        Engine::<T, K>::joint_trig(q)
    }
}

impl<T> Engine<T> {
    /// The recursion of [`rnea`] for clusters, whose sines are known; `back` is `trig` as the
    /// inward pass loads it.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn run<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        trig: &JointTrig<R, Q>,
        back: &JointTrig<R, Q>,
        state: &State<R, Q, V>,
        effects: &E,
    ) -> [R; V]
    where
        T: Robot<B, Q, V>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        // Not a constant, as in `torques`: where sines are known it costs instructions (decision
        // 13).
        let mut tau = [R::ZERO; V];
        Self::call(trig, effects).write_torques(&back.coordinates, state, &mut tau);
        tau
    }
}
