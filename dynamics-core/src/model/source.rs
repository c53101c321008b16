//! The robots that the algorithms accept: known at run time or at compile time.

use core::marker::PhantomData;

use super::{JointKinds, LinkView, Model, ModelError, Robot, model};
use crate::scalar::{Native, Real};
use crate::spatial::{SpatialInertia, Xform};
use crate::trig::Kernel;

/// A robot of B bodies, Q position and V velocity coordinates, with the properties that are known
/// at compile time: the machine code contains only the kinds of joint that it has.
///
/// Nothing of a [`Model`] is known at compile time; all of a [`Robot`] as [`Static`] is.
pub trait RobotModel<R: Real, const B: usize, const Q: usize, const V: usize> {
    /// The kernel that computes its sines and cosines.
    type Kernel: Kernel<R>;
    /// The kinds of joint that occur.
    const KINDS: JointKinds = JointKinds::ALL;
    /// Whether the parent of every body is known to be the one before it.
    const CHAIN: bool = false;
    /// Whether every body is known to have one coordinate.
    const SINGLE: bool = false;
    /// Whether every joint turns, and each link stands in its parent's frame as Denavit &
    /// Hartenberg's parameters say: turned about x, and shifted along x and along its own axis.
    /// None: each call asks.
    const SCREWS: Option<bool> = None;
    /// Whether it is a model loaded at run time whose joints may all be revolute. For others
    /// [`as_all_revolute`](Self::as_all_revolute) and
    /// [`as_revolute_chain`](Self::as_revolute_chain) are not called, so that no second form of an
    /// algorithm is compiled, not even without optimisation.
    const MAY_BE_REVOLUTE: bool = false;

    /// The robot's numbers.
    fn model(&self) -> &Model<R, B, Q, V>;

    /// The same robot as one of revolute joints only, if all joints of a model loaded at run time
    /// are revolute. None if the robot is known at compile time.
    #[cfg_attr(optimised, inline(always))]
    fn as_all_revolute(&self) -> Option<AllRevolute<'_, R, B, Q, V>> {
        None
    }

    /// The same robot as a chain of revolute joints, if a model loaded at run time is one: for
    /// algorithms that are compiled a second time for this case. None if the robot is known at
    /// compile time.
    #[cfg_attr(optimised, inline(always))]
    fn as_revolute_chain(&self) -> Option<RevoluteChain<'_, R, B, Q, V>> {
        None
    }

    /// Whether [`RobotModel::SCREWS`] holds, of a robot whose joints turn.
    #[cfg_attr(optimised, inline(always))]
    fn has_screws(&self) -> bool {
        let asked = || self.links().all(|link| link.is_placed_by_screws());
        const { Self::SCREWS }.unwrap_or_else(asked)
    }

    /// The links, parents first, each with the properties of its joint that are known at compile
    /// time.
    #[cfg_attr(optimised, inline(always))]
    fn links<'a>(&'a self) -> impl DoubleEndedIterator<Item = LinkView<'a, R>> + ExactSizeIterator
    where
        R: 'a,
    {
        let links = self.model().links.iter().enumerate();
        links.map(|(i, link)| LinkView::new(i, link, Self::KINDS, Self::SINGLE))
    }

    /// Link `i`.
    #[cfg_attr(optimised, inline(always))]
    fn link<'a>(&'a self, i: usize) -> Option<LinkView<'a, R>>
    where
        R: 'a,
    {
        let link = self.model().links.get(i)?;
        Some(LinkView::new(i, link, Self::KINDS, Self::SINGLE))
    }
}

impl<R: Real, const B: usize, const Q: usize, const V: usize> RobotModel<R, B, Q, V>
    for Model<R, B, Q, V>
{
    type Kernel = Native;
    const MAY_BE_REVOLUTE: bool = B == Q && B == V;

    #[cfg_attr(optimised, inline(always))]
    fn model(&self) -> &Self {
        self
    }

    #[cfg_attr(optimised, inline(always))]
    fn as_all_revolute(&self) -> Option<AllRevolute<'_, R, B, Q, V>> {
        let only = Self::MAY_BE_REVOLUTE && self.kinds.are_revolute();
        only.then_some(AllRevolute(self))
    }

    #[cfg_attr(optimised, inline(always))]
    fn as_revolute_chain(&self) -> Option<RevoluteChain<'_, R, B, Q, V>> {
        let only = Self::MAY_BE_REVOLUTE && self.kinds.are_revolute() & self.chain;
        only.then_some(AllRevolute(self))
    }
}

/// A [`Model`] whose joints are all known to be revolute.
///
/// [`RobotModel::as_all_revolute`] makes it, and with `SERIAL` for a chain
/// [`RobotModel::as_revolute_chain`]. A loop over it has no branch on the kind of joint, and over a
/// chain each body finds its parent's results where the loop left them.
#[derive(Clone, Copy, Debug)]
#[doc(hidden)]
pub struct AllRevolute<
    'a,
    R: Real,
    const B: usize,
    const Q: usize,
    const V: usize,
    const SERIAL: bool = false,
>(&'a Model<R, B, Q, V>);

/// A [`Model`] known to be a chain of revolute joints.
#[doc(hidden)]
pub type RevoluteChain<'a, R, const B: usize, const Q: usize, const V: usize> =
    AllRevolute<'a, R, B, Q, V, true>;

impl<R: Real, const B: usize, const Q: usize, const V: usize, const SERIAL: bool>
    RobotModel<R, B, Q, V> for AllRevolute<'_, R, B, Q, V, SERIAL>
{
    type Kernel = Native;
    const KINDS: JointKinds = JointKinds::REVOLUTE;
    const CHAIN: bool = SERIAL;
    const SINGLE: bool = true;

    #[cfg_attr(optimised, inline(always))]
    fn model(&self) -> &Model<R, B, Q, V> {
        self.0
    }
}

/// The robot `T`, known at compile time, as a [`RobotModel`]; sines and cosines by the kernel `K`.
///
/// ```
/// use dynamics_core::{algorithms::rnea, effects::RIGID_BODY, model::{Static, Robot}, robots::Ur5e, state::State};
/// let state = State::at([0.3_f64; 6]);
/// let known = rnea(&Static::<Ur5e>::NEW, &state, &RIGID_BODY);
/// assert_eq!(known, rnea(&Ur5e::MODEL, &state, &RIGID_BODY));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Static<T, K = Native>(PhantomData<(T, K)>);

impl<T, K> Static<T, K> {
    /// The only value.
    pub const NEW: Self = Self(PhantomData);
}

impl<R, T, K, const B: usize, const Q: usize, const V: usize> RobotModel<R, B, Q, V>
    for Static<T, K>
where
    R: Real,
    T: Robot<B, Q, V>,
    K: Kernel<R>,
{
    type Kernel = K;
    const KINDS: JointKinds = T::MODEL.kinds();
    const CHAIN: bool = T::MODEL.is_chain();
    const SINGLE: bool = T::MODEL.kinds().are_single() && B == Q && B == V;
    const SCREWS: Option<bool> = Some(T::MODEL.has_screws());

    #[cfg_attr(optimised, inline(always))]
    fn model(&self) -> &Model<R, B, Q, V> {
        model::<R, T, B, Q, V>()
    }
}

/// A robot with the structure of `T`, known at compile time, and run-time parameters: identified
/// masses and inertias, measured lengths.
///
/// It is as fast and as small as [`Static`], while a [`Model`] at run time has a branch on the kind
/// of each joint; but forward dynamics of a chain by [`aba`](crate::algorithms::aba()) takes no
/// shorter form where its links are placed as Denavit & Hartenberg's parameters say.
///
/// ```
/// use dynamics_core::{algorithms::rnea, effects::RIGID_BODY, model::Calibrated, robots::Ur5e, state::State};
/// let mut arm = Calibrated::<Ur5e, f64, 6, 6, 6>::nominal();
/// let state = State::at([0.0, -1.2, 1.5, 0.3, 0.0, 0.0]);
/// let before = rnea(&arm, &state, &RIGID_BODY);
/// for inertia in arm.inertias() {
///     *inertia = *inertia + *inertia; // all of it twice as heavy
/// }
/// assert_eq!(rnea(&arm, &state, &RIGID_BODY), before.map(|tau| 2.0 * tau));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Calibrated<T, R: Real, const B: usize, const Q: usize, const V: usize> {
    pub(super) model: Model<R, B, Q, V>,
    // A function, so that the type contains no T.
    robot: PhantomData<fn() -> T>,
}

impl<T, R: Real, const B: usize, const Q: usize, const V: usize> Calibrated<T, R, B, Q, V>
where
    T: Robot<B, Q, V>,
{
    /// The robot as it is described.
    pub fn nominal() -> Self {
        Self { model: *model::<R, T, B, Q, V>(), robot: PhantomData }
    }

    /// Its bodies' inertias, about the origins of their aligned frames and in their coordinates.
    /// Numbers in the frames of the description go through [`Calibrated::set_inertia`].
    pub fn inertias(&mut self) -> impl Iterator<Item = &mut SpatialInertia<R>> {
        self.model.links.iter_mut().map(|link| &mut link.inertia)
    }

    /// Checks that every inertia is physical, see [`Model::check`]: for identified numbers, before
    /// they are used.
    ///
    /// # Errors
    /// As [`Model::check`].
    pub fn check(&self, relative: f64) -> Result<(), ModelError> {
        self.model.check(relative)
    }

    /// The placements of its joints at q = 0, from the parents' aligned frames.
    pub fn placements(&mut self) -> impl Iterator<Item = &mut Xform<R>> {
        self.model.links.iter_mut().map(|link| &mut link.placement)
    }
}

impl<T, R: Real, const B: usize, const Q: usize, const V: usize> RobotModel<R, B, Q, V>
    for Calibrated<T, R, B, Q, V>
where
    T: Robot<B, Q, V>,
{
    type Kernel = Native;
    const KINDS: JointKinds = T::MODEL.kinds();
    const CHAIN: bool = T::MODEL.is_chain();
    const SINGLE: bool = T::MODEL.kinds().are_single() && B == Q && B == V;
    // Its placements can change, and code for both forms takes 4 kB more.
    const SCREWS: Option<bool> = Some(false);

    #[cfg_attr(optimised, inline(always))]
    fn model(&self) -> &Model<R, B, Q, V> {
        &self.model
    }
}
