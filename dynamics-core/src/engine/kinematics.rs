//! Poses, velocities and accelerations of bodies that are named while compiling, and of all bodies.
//!
//! Featherstone & Orin (2000), (3) and (4), in the field form of [`super::acceleration_field`];
//! only the joints that move the named bodies are visited.

use core::borrow::Borrow;
use core::marker::PhantomData;

use super::Engine;
use super::acceleration_field::AccelerationField;
use super::call::Call;
use super::compile::{BodyPlacement, Compiled};
use super::folding::{Folded, Mat3, Vec3};
use super::named::{AllBodies, ListedBody, joints};
use super::pass::{Motions, Nothing, Pass, sweep};
use crate::algorithms::{Frame, Kinematics, Pose};
use crate::effects::Effect;
use crate::model::{BASE, Bodies, JointCoordinate, OnBody, Robot};
use crate::scalar::{Matrix, Real};
use crate::spatial::Motion;
use crate::state::{Configuration, RobotState, State};
use crate::trig::Kernel;

impl<T, K> Engine<T, K> {
    /// The pose of every body's own frame in the base's: rotation, and position in m, as
    /// [`crate::algorithms::poses`] computes them.
    ///
    /// # Cost
    /// Some 20 flops for each revolute joint; the same instructions for all data.
    /// [`Engine::poses_of`] costs less.
    ///
    /// # Source
    /// Featherstone, RBDA (2008), table 2.6.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Engine, robots::Ur5e};
    /// let [.., elbow, _, _, _] = Engine::<Ur5e>::poses(&[0.0_f32, -1.57, 0.0, 0.0, 0.0, 0.0]);
    /// assert!(elbow.pos.z > 0.5); // the upper arm points upwards
    /// ```
    #[doc(alias = "forward kinematics")]
    #[inline(never)]
    #[must_use]
    pub fn poses<R: Real, const B: usize, const Q: usize, const V: usize>(
        q: &impl Configuration<R, Q>,
    ) -> [Pose<R>; B]
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
    {
        let trig = q.trig_or(Self::trig_source());
        Self::call(trig.borrow(), &()).poses(AllBodies)
    }

    /// The poses of some bodies' own frames in the base's, in the order of `bodies`: those of
    /// [`Engine::poses`].
    ///
    /// A body that the robot does not have does not compile.
    ///
    /// # Cost
    /// Some 20 flops for each revolute joint that moves one of these bodies; the same instructions
    /// for all data.
    ///
    /// # Source
    /// Featherstone, RBDA (2008), table 2.6.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Engine, model::{OnBody, Robot}, robots::Ur5e};
    /// const WRIST: usize = Ur5e::MODEL.body("wrist_3");
    /// let [hand] = Engine::<Ur5e>::poses_of(&[0.0_f32; 6], OnBody::<WRIST>);
    /// assert!(hand.pos.x < -0.8); // stretched out along −x
    /// ```
    #[doc(alias = "forward kinematics")]
    #[doc(alias = "end effector")]
    #[inline(never)]
    #[must_use]
    pub fn poses_of<R: Real, const N: usize, const B: usize, const Q: usize, const V: usize>(
        q: &impl Configuration<R, Q>,
        bodies: impl Bodies<N>,
    ) -> [Pose<R>; N]
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
    {
        let trig = q.trig_or(Self::trig_source());
        Self::call(trig.borrow(), &()).poses(bodies)
    }

    /// Pose, velocity and acceleration of every body, on a base that moves as the effects specify,
    /// as [`crate::algorithms::kinematics()`] computes them.
    ///
    /// # Cost
    /// Some 80 flops for each revolute joint; the same instructions for all data.
    /// [`Engine::kinematics_of`] costs less.
    ///
    /// # Source
    /// Featherstone & Orin (2000), (3) and (4).
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Engine, algorithms::frame, robots::Ur5e, state::State};
    /// let turning = State { qd: [1.0, 0.0, 0.0, 0.0, 0.0, 0.0], ..State::at([0.0_f64; 6]) };
    /// let k = Engine::<Ur5e>::kinematics(&turning, &());
    /// let (hand, p) = (k.velocity(5, frame::LocalWorldAligned), k.poses[5].pos);
    /// assert!((hand.lin.x + p.y).abs() < 1e-12 && (hand.lin.y - p.x).abs() < 1e-12);
    /// ```
    #[doc(alias = "forward kinematics")]
    #[inline(never)]
    #[must_use]
    pub fn kinematics<R: Real, E, const B: usize, const Q: usize, const V: usize>(
        state: impl RobotState<R, Q, V>,
        effects: &E,
    ) -> Kinematics<R, B>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        let configuration = state.configuration();
        let trig = configuration.trig_or(Self::trig_source());
        let call = Self::call(trig.borrow(), effects);
        call.walk::<_, B, true>(state.state(), &call.carried(), AllBodies)
    }

    /// Pose, velocity and acceleration of some bodies, in the order of `bodies`: those of
    /// [`Engine::kinematics`].
    ///
    /// The numbers that the functions of [`Kinematics`] take are the places in `bodies`. A body
    /// that the robot does not have does not compile.
    ///
    /// # Cost
    /// Some 80 flops for each revolute joint that moves one of these bodies; the same instructions
    /// for all data.
    ///
    /// # Source
    /// Featherstone & Orin (2000), (3) and (4).
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Engine, algorithms::frame, model::{OnBody, Robot}, robots::Ur5e, state::State};
    /// const WRIST: usize = Ur5e::MODEL.body("wrist_3");
    /// let turning = State { qd: [1.0, 0.0, 0.0, 0.0, 0.0, 0.0], ..State::at([0.0_f64; 6]) };
    /// let wrist = Engine::<Ur5e>::kinematics_of(&turning, &(), OnBody::<WRIST>);
    /// let all = Engine::<Ur5e>::kinematics(&turning, &());
    /// assert_eq!(wrist.velocity(0, frame::World), all.velocity(WRIST, frame::World));
    /// ```
    #[doc(alias = "forward kinematics")]
    #[doc(alias = "end effector")]
    #[inline(never)]
    #[must_use]
    pub fn kinematics_of<
        R: Real,
        E,
        const N: usize,
        const B: usize,
        const Q: usize,
        const V: usize,
    >(
        state: impl RobotState<R, Q, V>,
        effects: &E,
        bodies: impl Bodies<N>,
    ) -> Kinematics<R, N>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        E: Effect<R, B, V>,
    {
        scene_is_taken!();
        let configuration = state.configuration();
        let trig = configuration.trig_or(Self::trig_source());
        let call = Self::call(trig.borrow(), effects);
        call.walk::<_, N, true>(state.state(), &call.carried(), bodies)
    }

    /// The acceleration J̇ q̇ of a body at q̈ = 0, in a [`Frame`], rad/s² and m/s², as
    /// [`crate::algorithms::bias_acceleration`] computes it.
    ///
    /// A body that the robot does not have does not compile.
    ///
    /// # Cost
    /// Some 80 flops for each revolute joint that moves the body; the same instructions for all
    /// data.
    ///
    /// # Source
    /// Featherstone & Orin (2000), (4) at q̈ = 0; RBDA (2008), section 4.1.
    ///
    /// # Example
    /// ```
    /// use dynamics_core::{Engine, algorithms::frame, model::{OnBody, Robot}, robots::Ur5e, state::State};
    /// const WRIST: usize = Ur5e::MODEL.body("wrist_3");
    /// let turning = State { qd: [2.0, 0.0, 0.0, 0.0, 0.0, 0.0], ..State::at([0.0_f64; 6]) };
    /// let a = Engine::<Ur5e>::bias_acceleration(&turning, OnBody::<WRIST>, frame::LocalWorldAligned);
    /// assert!(a.lin.x > 3.0); // towards the axis
    /// ```
    #[doc(alias = "drift")]
    #[doc(alias = "Jdot")]
    #[inline(never)]
    #[must_use]
    pub fn bias_acceleration<
        R: Real,
        F,
        const BODY: usize,
        const B: usize,
        const Q: usize,
        const V: usize,
    >(
        state: impl RobotState<R, Q, V>,
        body: OnBody<BODY>,
        frame: F,
    ) -> Motion<R>
    where
        T: Robot<B, Q, V>,
        K: Kernel<R>,
        F: Frame,
    {
        let configuration = state.configuration();
        let trig = configuration.trig_or(Self::trig_source());
        let coasting = State { qdd: [R::ZERO; V], ..*state.state() };
        let Kinematics { poses: [pose], velocities: [v], accelerations: [a] } = Self::call(
            trig.borrow(),
            &(),
        )
        .walk::<_, 1, true>(&coasting, &AccelerationField::RESTING, body);
        frame.express(&pose, a) + frame.classical_term(frame.express(&pose, v))
    }
}

impl<R: Real, T: Compiled, E, const B: usize, const Q: usize, const V: usize>
    Call<'_, R, T, E, B, Q, V>
{
    /// The poses of the bodies of the list.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn poses<List: Bodies<N>, const N: usize>(self, bodies: List) -> [Pose<R>; N] {
        let resting = State { q: [R::ZERO; Q], qd: [R::ZERO; V], qdd: [R::ZERO; V] };
        let base = AccelerationField::RESTING;
        self.walk::<List, N, false>(&resting, &base, bodies).poses
    }

    /// The poses of the bodies of the list and, if the joints have RATES, their motions.
    #[cfg_attr(optimised, inline(always))]
    fn walk<List: Bodies<N>, const N: usize, const RATES: bool>(
        self,
        state: &State<R, Q, V>,
        base: &AccelerationField<R>,
        _: List,
    ) -> Kinematics<R, N> {
        let mut walk = Walk::<R, T, List, N, Q, V, RATES> {
            turns: self.turns,
            state,
            found: Kinematics {
                poses: [Pose::IDENTITY; N],
                velocities: [Motion::ZERO; N],
                accelerations: [Motion::ZERO; N],
            },
            types: PhantomData,
        };
        walk.see::<BASE>(base);
        let Nothing = sweep(&mut walk, base);
        walk.found
    }
}

struct Walk<'a, R: Real, T, List, const N: usize, const Q: usize, const V: usize, const RATES: bool>
{
    turns: &'a [JointCoordinate<R>; Q],
    state: &'a State<R, Q, V>,
    found: Kinematics<R, N>,
    types: PhantomData<(T, List)>,
}

impl<R: Real, T: Compiled, List, const N: usize, const Q: usize, const V: usize, const RATES: bool>
    Pass for Walk<'_, R, T, List, N, Q, V, RATES>
where
    List: Bodies<N>,
{
    type Tree = T;
    type Outward = AccelerationField<R>;
    type Inward = Nothing;
    const NOTHING: Nothing = Nothing;
    const JOINTS: u64 = joints::<T>(&List::NUMBERS);

    #[cfg_attr(optimised, inline(always))]
    fn enter<const I: usize>(&mut self, parent: &AccelerationField<R>) -> AccelerationField<R> {
        let motions = Motions {
            turns: self.turns,
            qd: &self.state.qd,
            qdd: &self.state.qdd,
            velocity: RATES,
            products: RATES,
            accel: RATES,
        };
        let field = motions.field::<T, I>(parent);
        self.see::<I>(&field);
        field
    }

    #[cfg_attr(optimised, inline(always))]
    fn leave<const I: usize>(&mut self, _: &AccelerationField<R>, _: Nothing) -> Nothing {
        Nothing
    }
}

impl<R: Real, T: Compiled, List, const N: usize, const Q: usize, const V: usize, const RATES: bool>
    Walk<'_, R, T, List, N, Q, V, RATES>
where
    List: Bodies<N>,
{
    /// Writes the poses and motions of the bodies of the list that move with joint I, or stand on
    /// the base.
    #[cfg_attr(optimised, inline(always))]
    fn see<const I: usize>(&mut self, field: &AccelerationField<R>) {
        const { ListedBody::<T, List, N, I, 0>::ARE_FEW };
        for_each_joint!(K, {
            if ListedBody::<T, List, N, I, K>::IS_SOME {
                let (at, place) = ListedBody::<T, List, N, I, K>::BODY;
                let (pose, v, a) = motion_of(field, place, T::LENGTH);
                self.found.poses[*at] = pose;
                if RATES {
                    self.found.velocities[*at] = v;
                    self.found.accelerations[*at] = a;
                }
            }
        });
    }
}

/// Pose, velocity and spatial acceleration of a body, in its own frame.
#[cfg_attr(optimised, inline(always))]
fn motion_of<R: Real>(
    field: &AccelerationField<R>,
    place: &'static BodyPlacement,
    length: f64,
) -> (Pose<R>, Motion<R>, Motion<R>) {
    let (rot, pos) = (Mat3::constant(&place.rot), Vec3::constant(place.pos));
    let length = Folded::constant(length);
    let x = field.pose.of(place, length);
    let v = field.v + field.omega.cross(pos);
    // The field is of classical accelerations; RBDA (2.47).
    let a = field.a + field.u.mul(pos) - field.omega.cross(v);
    let pose = Pose { rot: x.rot.transpose(), pos: x.pos };
    let (v, a) = (v.scale(length), a.scale(length));
    (pose, own(&rot, field.omega, v), own(&rot, field.alpha, a))
}

/// A motion in the body's own frame.
#[cfg_attr(optimised, inline(always))]
fn own<R: Real>(rot: &Mat3<R>, ang: Vec3<R>, lin: Vec3<R>) -> Motion<R> {
    Motion::new(rot.transpose_mul(ang).get(), rot.transpose_mul(lin).get())
}
