//! The pose of a body, and the frames in which its motion is expressed.

use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::{Motion, Xform};

/// The pose of a body's own frame in the base's.
///
/// ```
/// use dynamics_core::{Core, robots::Ur5e};
/// let [.., hand] = Core::<Ur5e>::poses(&[0.0_f32; 6]);
/// assert!(hand.pos.x < -0.8); // stretched out along −x
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<R: Real> {
    /// Rotation of coordinates from the body's frame to the base's; its columns are the body's
    /// axes.
    pub rot: R::Mat3,
    /// The origin of the body's frame, in base coordinates, m.
    pub pos: R::Vec3,
}

impl<R: Real> Default for Pose<R> {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl<R: Real> Pose<R> {
    /// The pose of the base.
    pub const IDENTITY: Self = Self { rot: R::Mat3::IDENTITY, pos: R::Vec3::ZERO };

    /// A point given in the body's frame, in base coordinates, m. 18 flops.
    #[cfg_attr(optimised, inline(always))]
    pub fn point(&self, p: R::Vec3) -> R::Vec3 {
        self.rot * p + self.pos
    }

    /// ⁱX₀: motions from the base's frame to the body's.
    #[cfg_attr(optimised, inline(always))]
    pub fn xform(&self) -> Xform<R> {
        Xform { rot: self.rot.transpose(), pos: self.pos }
    }

    /// The pose of the frame to which X transforms coordinates from this one's. 63 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(in crate::algorithms) fn transformed_by(&self, x: &Xform<R>) -> Self {
        Self { rot: self.rot * x.rot.transpose(), pos: self.point(x.pos) }
    }

    /// The pose with the same origin, and axes that `frame` rotates into this one's.
    #[cfg_attr(optimised, inline(always))]
    pub(in crate::algorithms) fn in_link_frame(&self, frame: &R::Mat3) -> Self {
        Self { rot: self.rot * *frame, pos: self.pos }
    }
}

mod sealed {
    /// Restricts [`super::Frame`] to the frames of this module.
    pub trait Sealed {}
    impl Sealed for super::Local {}
    impl Sealed for super::World {}
    impl Sealed for super::LocalWorldAligned {}
    impl Sealed for super::AnyFrame {}
}

/// A frame in which the motion of a body is expressed: [`Local`], [`World`] or
/// [`LocalWorldAligned`].
///
/// The frame is a type, not a flag, so that it is fixed at compile time; [`AnyFrame`] is chosen at
/// run time. For a body with the angular velocity ω and the origin p:
///
/// | frame | axes | reference point | bias acceleration J̇ q̇ |
/// |---|---|---|---|
/// | `Local` | the body's | its origin | spatial acceleration at q̈ = 0 |
/// | `World` | the base's | the base's origin | spatial acceleration at q̈ = 0 |
/// | `LocalWorldAligned` | the base's | the body's origin | ω̇ and p̈ at q̈ = 0 |
pub trait Frame: sealed::Sealed + Copy {
    /// Transforms a motion of the body at `pose` from its own frame to this one.
    fn express<R: Real>(self, pose: &Pose<R>, m: Motion<R>) -> Motion<R>;
    /// The transform that [`Frame::express`] applies.
    fn transform<R: Real>(self, pose: &Pose<R>) -> Xform<R>;
    /// Transforms a motion of the body at `pose` from [`LocalWorldAligned`] to this frame.
    fn express_aligned<R: Real>(self, pose: &Pose<R>, m: Motion<R>) -> Motion<R>;
    /// The difference of the acceleration in this frame and the spatial one; v is the velocity in
    /// this frame.
    #[cfg_attr(optimised, inline(always))]
    fn classical_term<R: Real>(self, v: Motion<R>) -> Motion<R> {
        let _ = v;
        Motion::ZERO
    }
}

/// The body's own frame.
#[doc(alias = "body frame")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Local;

/// The base's frame: the velocity is that of the point of the body which is at the base's origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct World;

/// The base's axes at the body's origin: ω and ṗ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LocalWorldAligned;

impl Frame for Local {
    #[cfg_attr(optimised, inline(always))]
    fn express<R: Real>(self, _: &Pose<R>, m: Motion<R>) -> Motion<R> {
        m
    }
    #[cfg_attr(optimised, inline(always))]
    fn transform<R: Real>(self, _: &Pose<R>) -> Xform<R> {
        Xform::IDENTITY
    }
    #[cfg_attr(optimised, inline(always))]
    fn express_aligned<R: Real>(self, pose: &Pose<R>, m: Motion<R>) -> Motion<R> {
        Motion::new(pose.rot.transpose_mul(m.ang), pose.rot.transpose_mul(m.lin))
    }
}

impl Frame for World {
    #[cfg_attr(optimised, inline(always))]
    fn express<R: Real>(self, pose: &Pose<R>, m: Motion<R>) -> Motion<R> {
        self.express_aligned(pose, LocalWorldAligned.express(pose, m))
    }
    #[cfg_attr(optimised, inline(always))]
    fn transform<R: Real>(self, pose: &Pose<R>) -> Xform<R> {
        Xform { rot: pose.rot, pos: -pose.rot.transpose_mul(pose.pos) }
    }
    #[cfg_attr(optimised, inline(always))]
    fn express_aligned<R: Real>(self, pose: &Pose<R>, m: Motion<R>) -> Motion<R> {
        Motion::new(m.ang, m.lin + pose.pos.cross(m.ang))
    }
}

impl Frame for LocalWorldAligned {
    #[cfg_attr(optimised, inline(always))]
    fn express<R: Real>(self, pose: &Pose<R>, m: Motion<R>) -> Motion<R> {
        Motion::new(pose.rot * m.ang, pose.rot * m.lin)
    }
    #[cfg_attr(optimised, inline(always))]
    fn transform<R: Real>(self, pose: &Pose<R>) -> Xform<R> {
        Xform { rot: pose.rot, pos: R::Vec3::ZERO }
    }
    #[cfg_attr(optimised, inline(always))]
    fn express_aligned<R: Real>(self, _: &Pose<R>, m: Motion<R>) -> Motion<R> {
        m
    }
    #[cfg_attr(optimised, inline(always))]
    fn classical_term<R: Real>(self, v: Motion<R>) -> Motion<R> {
        classical(Motion::ZERO, v)
    }
}

/// A frame that is chosen at run time.
///
/// ```
/// use dynamics_core::{Core, algorithms::frame, robots::Ur5e};
/// let chosen = frame::AnyFrame::World; // by a user
/// let q = [0.3_f32; 6];
/// let (a, b) = (Core::<Ur5e>::jacobian(&q, 5, chosen), Core::<Ur5e>::jacobian(&q, 5, frame::World));
/// assert_eq!(a, b);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnyFrame {
    /// [`Local`].
    Local,
    /// [`World`].
    World,
    /// [`LocalWorldAligned`].
    LocalWorldAligned,
}

/// Calls a method of the frame that was chosen.
macro_rules! of_chosen {
    ($frame:expr, $function:ident($($argument:expr),*)) => {
        match $frame {
            AnyFrame::Local => Local.$function($($argument),*),
            AnyFrame::World => World.$function($($argument),*),
            AnyFrame::LocalWorldAligned => LocalWorldAligned.$function($($argument),*),
        }
    };
}

impl Frame for AnyFrame {
    #[cfg_attr(optimised, inline(always))]
    fn express<R: Real>(self, pose: &Pose<R>, m: Motion<R>) -> Motion<R> {
        of_chosen!(self, express(pose, m))
    }
    #[cfg_attr(optimised, inline(always))]
    fn transform<R: Real>(self, pose: &Pose<R>) -> Xform<R> {
        of_chosen!(self, transform(pose))
    }
    #[cfg_attr(optimised, inline(always))]
    fn express_aligned<R: Real>(self, pose: &Pose<R>, m: Motion<R>) -> Motion<R> {
        of_chosen!(self, express_aligned(pose, m))
    }
    #[cfg_attr(optimised, inline(always))]
    fn classical_term<R: Real>(self, v: Motion<R>) -> Motion<R> {
        of_chosen!(self, classical_term(v))
    }
}

/// The classical acceleration, ω̇ and p̈ of the body's origin p, from the spatial acceleration a
/// and the velocity v in the same frame.
///
/// rad/s² and m/s².
///
/// # Cost
/// 12 flops.
///
/// # Source
/// Featherstone, RBDA (2008), (2.47): p̈ = a + ω × v.
///
/// # Example
/// ```
/// use dynamics_core::{algorithms::classical, spatial::Motion};
/// use glam::Vec3;
/// // On a circle of 2 m at 3 rad/s the spatial acceleration is zero, the centripetal one is not.
/// let v = Motion::<f32>::new(Vec3::Z * 3.0, Vec3::Y * 6.0);
/// assert_eq!(classical(Motion::ZERO, v).lin, Vec3::X * -18.0);
/// ```
#[cfg_attr(optimised, inline(always))]
#[must_use]
pub fn classical<R: Real>(a: Motion<R>, v: Motion<R>) -> Motion<R> {
    Motion::new(a.ang, a.lin + v.ang.cross(v.lin))
}
