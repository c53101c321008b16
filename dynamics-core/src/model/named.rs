//! Bodies that are named while compiling.

mod sealed {
    /// Restricts [`super::BodyNumber`] to numbers and [`super::OnBody`].
    pub trait Sealed {}
    impl Sealed for usize {}
    impl<const BODY: usize> Sealed for super::OnBody<BODY> {}
}

/// The body of the number BODY, named while compiling: for [`Engine`](crate::Engine), whose machine
/// code then has no other.
///
/// ```
/// use dynamics_core::{Core, Engine, algorithms::frame, model::{OnBody, Robot}, robots::Ur5e, state::State};
/// const WRIST: usize = Ur5e::MODEL.body("wrist_3");
/// let state = State { qd: [0.5; 6], ..State::at([0.3_f64; 6]) };
/// let a = Core::<Ur5e>::bias_acceleration(&state, OnBody::<WRIST>, frame::World);
/// let b = Engine::<Ur5e>::bias_acceleration(&state, OnBody::<WRIST>, frame::World);
/// assert!((a.lin - b.lin).length() < 1e-14);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OnBody<const BODY: usize>;

/// The number of a body in the description: a `usize`, or [`OnBody`].
pub trait BodyNumber: sealed::Sealed + Copy {
    /// The number, from 0.
    fn number(self) -> usize;
}

impl BodyNumber for usize {
    #[cfg_attr(optimised, inline(always))]
    fn number(self) -> usize {
        self
    }
}

impl<const BODY: usize> BodyNumber for OnBody<BODY> {
    #[cfg_attr(optimised, inline(always))]
    fn number(self) -> usize {
        BODY
    }
}

/// N bodies of a robot that are named while compiling, for [`Engine`](crate::Engine).
///
/// ```
/// use dynamics_core::{Engine, model::{Bodies, Robot}, robots::A1};
/// #[derive(Clone, Copy)]
/// struct Feet;
/// impl Bodies<2> for Feet {
///     const NUMBERS: [usize; 2] = [A1::MODEL.body("FR_foot"), A1::MODEL.body("FL_foot")];
/// }
/// let [right, left] = Engine::<A1>::poses_of(&[0.0_f32; 12], Feet);
/// assert_eq!(right.pos.y, -left.pos.y);
/// ```
pub trait Bodies<const N: usize>: Copy {
    /// Their numbers in the description, in any order.
    const NUMBERS: [usize; N];
}

impl<const BODY: usize> Bodies<1> for OnBody<BODY> {
    const NUMBERS: [usize; 1] = [BODY];
}
