//! Spatial vectors, transforms and inertias in compact form: never a 6×6 matrix.
//!
//! Motion and force vectors are different types, so that a frame or duality error does not
//! compile: `motion.dot(force)` is power, `motion.cross(motion)` is ×, `motion.cross_force(force)`
//! is ×*. Featherstone, *Rigid Body Dynamics Algorithms* (RBDA, 2008), chapter 2 and table 2.6.
//!
//! ```compile_fail
//! use dynamics_core::spatial::{Force, Motion};
//! let v = Motion::<f32>::ZERO;
//! let f = Force::<f32>::ZERO;
//! let _ = v + f; // a velocity is not a force
//! ```

mod acceleration_field;
mod axial_screws;
mod body_coriolis;
pub(crate) mod inertia;
mod motion_subspace;
pub(crate) mod rotation;
pub(crate) mod symmetric;

pub(crate) use acceleration_field::AccelerationField;
pub(crate) use axial_screws::{AxialScrews, Screw};
pub(crate) use body_coriolis::BodyCoriolis;
pub(crate) use motion_subspace::{MotionSubspace, raised};

use core::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

use crate::scalar::{Matrix, Real, Vector};

/// A spatial motion vector in M⁶: velocity (rad/s, m/s) or acceleration (rad/s², m/s²).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion<R: Real> {
    /// Angular part ω, rad/s.
    pub ang: R::Vec3,
    /// Linear part v of the body-fixed point at the frame's origin, m/s.
    pub lin: R::Vec3,
}

/// A spatial force vector in F⁶: couple about the frame's origin (N·m) and force (N).
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Force<R: Real> {
    /// Couple n about the origin, N·m.
    pub ang: R::Vec3,
    /// Force f, N.
    pub lin: R::Vec3,
}

/// The coordinate transform ᴮX_A from frame A to frame B: E rotates coordinates, r places B in A.
///
/// ```
/// use dynamics_core::spatial::{Force, Motion, Xform};
/// use glam::Vec3;
/// // B stands 1 m along x of A: a rotation about A's z moves its origin along y.
/// let x = Xform { pos: Vec3::X, ..Xform::<f32>::IDENTITY };
/// assert_eq!((x * Motion::new(Vec3::Z, Vec3::ZERO)).lin, Vec3::Y);
/// // A force along y at B's origin is a couple about A's z.
/// assert_eq!(x.transpose_mul(Force::new(Vec3::ZERO, Vec3::Y)).ang, Vec3::Z);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Xform<R: Real> {
    /// Rotation of coordinates from A to B.
    pub rot: R::Mat3,
    /// Origin of B in A coordinates, m.
    pub pos: R::Vec3,
}

/// The inertia of a rigid body at its frame's origin: ten numbers.
///
/// ```
/// use dynamics_core::spatial::{Motion, SpatialInertia};
/// use glam::Vec3;
/// let ball = SpatialInertia::<f32> { mass: 2.0, ..SpatialInertia::ZERO };
/// assert_eq!((ball * Motion::new(Vec3::ZERO, Vec3::X)).lin, Vec3::X * 2.0); // momentum
/// assert_eq!(SpatialInertia::<f32>::default(), SpatialInertia::ZERO);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialInertia<R: Real> {
    /// Mass m, kg.
    pub mass: R,
    /// First moment h = m c, kg·m.
    pub first_moment: R::Vec3,
    /// Rotational inertia about the frame's origin, kg·m².
    pub rotational: R::Mat3,
}

/// Zero inertia; the default of glam's matrices would be 1 kg·m².
impl<R: Real> Default for SpatialInertia<R> {
    fn default() -> Self {
        Self::ZERO
    }
}

macro_rules! vector_space {
    ($t:ident, $what:literal) => {
        impl<R: Real> $t<R> {
            #[doc = concat!("The zero ", $what, ".")]
            pub const ZERO: Self = Self { ang: R::Vec3::ZERO, lin: R::Vec3::ZERO };
            #[doc = concat!("A ", $what, " from its angular and linear parts.")]
            #[cfg_attr(optimised, inline(always))]
            pub const fn new(ang: R::Vec3, lin: R::Vec3) -> Self {
                Self { ang, lin }
            }
        }
        impl<R: Real> Add for $t<R> {
            type Output = Self;
            #[cfg_attr(optimised, inline(always))]
            fn add(self, o: Self) -> Self {
                Self::new(self.ang + o.ang, self.lin + o.lin)
            }
        }
        impl<R: Real> Sub for $t<R> {
            type Output = Self;
            #[cfg_attr(optimised, inline(always))]
            fn sub(self, o: Self) -> Self {
                Self::new(self.ang - o.ang, self.lin - o.lin)
            }
        }
        impl<R: Real> Neg for $t<R> {
            type Output = Self;
            #[cfg_attr(optimised, inline(always))]
            fn neg(self) -> Self {
                Self::new(-self.ang, -self.lin)
            }
        }
        impl<R: Real> Mul<R> for $t<R> {
            type Output = Self;
            #[cfg_attr(optimised, inline(always))]
            fn mul(self, s: R) -> Self {
                Self::new(self.ang * s, self.lin * s)
            }
        }
        impl<R: Real> AddAssign for $t<R> {
            #[cfg_attr(optimised, inline(always))]
            fn add_assign(&mut self, o: Self) {
                *self = *self + o;
            }
        }
        impl<R: Real> SubAssign for $t<R> {
            #[cfg_attr(optimised, inline(always))]
            fn sub_assign(&mut self, o: Self) {
                *self = *self - o;
            }
        }
    };
}
vector_space!(Motion, "motion");
vector_space!(Force, "force");

impl<R: Real> Force<R> {
    /// The couple, then the force.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn components(self) -> [R; 6] {
        let ([nx, ny, nz], [fx, fy, fz]) = (self.ang.array(), self.lin.array());
        [nx, ny, nz, fx, fy, fz]
    }
}

impl<R: Real> Motion<R> {
    /// The k-th unit vector of M⁶.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn unit(k: usize) -> Self {
        let at = |i| if i == k { R::ONE } else { R::ZERO };
        Self::new(R::Vec3::new(at(0), at(1), at(2)), R::Vec3::new(at(3), at(4), at(5)))
    }

    /// Six NaNs: the motion of a body that the robot does not have.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn nan() -> Self {
        let none = R::from_f64(f64::NAN);
        let none = R::Vec3::new(none, none, none);
        Self::new(none, none)
    }

    /// Power m · f in W if `self` is a velocity. RBDA 2.1. 11 flops.
    ///
    /// ```
    /// use dynamics_core::spatial::{Force, Motion};
    /// use glam::Vec3;
    /// let v = Motion::<f32>::new(Vec3::Z, Vec3::X);
    /// assert_eq!(v.dot(Force::new(Vec3::Z * 3.0, Vec3::X * 4.0)), 7.0);
    /// ```
    #[cfg_attr(optimised, inline(always))]
    pub fn dot(self, f: Force<R>) -> R {
        self.ang.dot(f.ang) + self.lin.dot(f.lin)
    }

    /// m × m₂, the rate of change of m₂ moving with velocity m. RBDA (2.31). 30 flops.
    #[cfg_attr(optimised, inline(always))]
    pub fn cross(self, m: Self) -> Self {
        Self::new(self.ang.cross(m.ang), self.ang.cross(m.lin) + self.lin.cross(m.ang))
    }

    /// m ×* f, the rate of change of f moving with velocity m. RBDA (2.32). 30 flops.
    #[cfg_attr(optimised, inline(always))]
    pub fn cross_force(self, f: Force<R>) -> Force<R> {
        Force::new(self.ang.cross(f.ang) + self.lin.cross(f.lin), self.ang.cross(f.lin))
    }
}

impl<R: Real> Xform<R> {
    /// The transform that changes nothing.
    pub const IDENTITY: Self = Self { rot: R::Mat3::IDENTITY, pos: R::Vec3::ZERO };

    /// Xᵀ f: a force from B to A coordinates, RBDA table 2.6. 39 flops.
    #[cfg_attr(optimised, inline(always))]
    pub fn transpose_mul(&self, f: Force<R>) -> Force<R> {
        let lin = self.rot.transpose_mul(f.lin);
        Force::new(self.rot.transpose_mul(f.ang) + self.pos.cross(lin), lin)
    }
}

/// X m: a motion from A to B coordinates, RBDA table 2.6. 39 flops.
impl<R: Real> Mul<Motion<R>> for Xform<R> {
    type Output = Motion<R>;
    #[cfg_attr(optimised, inline(always))]
    fn mul(self, m: Motion<R>) -> Motion<R> {
        Motion::new(self.rot * m.ang, self.rot * (m.lin - self.pos.cross(m.ang)))
    }
}

/// ᶜX_B ᴮX_A, RBDA table 2.6. 63 flops.
impl<R: Real> Mul for Xform<R> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn mul(self, first: Self) -> Self {
        Self { rot: self.rot * first.rot, pos: first.pos + first.rot.transpose_mul(self.pos) }
    }
}

impl<R: Real> SpatialInertia<R> {
    /// I a + v ×* I v: the force that accelerates a body moving with v. RBDA (2.58), written out by
    /// the acceleration a + ω × v of the origin's point. 102 flops.
    #[cfg_attr(optimised, inline(always))]
    pub fn force(&self, a: Motion<R>, v: Motion<R>) -> Force<R> {
        let w = v.ang;
        let point = a.lin + w.cross(v.lin);
        Force::new(
            self.first_moment.cross(point) + (self.turn(a.ang) + w.cross(self.turn(w))),
            point * self.mass
                + a.ang.cross(self.first_moment)
                + w.cross(w.cross(self.first_moment)),
        )
    }

    /// v ×* I v: the force that keeps a body moving with v without acceleration. [`Self::force`]
    /// without its zeros, 69 flops.
    #[cfg_attr(optimised, inline(always))]
    pub fn bias_force(&self, v: Motion<R>) -> Force<R> {
        let (w, h) = (v.ang, self.first_moment);
        let point = w.cross(v.lin);
        Force::new(h.cross(point) + w.cross(self.turn(w)), point * self.mass + w.cross(w.cross(h)))
    }

    /// Ī w, reading the upper triangle of Ī. 15 flops.
    #[cfg_attr(optimised, inline(always))]
    fn turn(&self, w: R::Vec3) -> R::Vec3 {
        let ([xx, xy, xz, yy, yz, zz], [x, y, z]) = (self.upper(), w.array());
        R::Vec3::new(xx * x + xy * y + xz * z, xy * x + yy * y + yz * z, xz * x + yz * y + zz * z)
    }

    /// The upper triangle of Ī: xx, xy, xz, yy, yz, zz.
    #[cfg_attr(optimised, inline(always))]
    fn upper(&self) -> [R; 6] {
        let [x, y, z] = self.rotational.cols();
        let ([xx, _, _], [xy, yy, _], [xz, yz, zz]) = (x.array(), y.array(), z.array());
        [xx, xy, xz, yy, yz, zz]
    }

    /// The ten parameters: m, h_x, h_y, h_z, Ī_xx, Ī_xy, Ī_yy, Ī_xz, Ī_yz, Ī_zz in kg, kg·m and
    /// kg·m².
    ///
    /// ```
    /// use dynamics_core::effects::Payload;
    /// use dynamics_core::{model::BodyInertia, spatial::SpatialInertia};
    /// let load = BodyInertia { mass: 2.0, com: [0.0, 0.0, 0.5], inertia: [0.1, 0.0, 0.01, 0.2, 0.0, 0.15] };
    /// let phi = Payload::<f64, 0>::from_inertia(load).0.parameters();
    /// assert_eq!(phi, [2.0, 0.0, 0.0, 1.0, 0.6, 0.0, 0.7, 0.01, 0.0, 0.15]);
    /// assert_eq!(SpatialInertia::<f64>::from_parameters(phi).parameters(), phi);
    /// ```
    #[inline]
    pub fn parameters(&self) -> [R; 10] {
        let ([xx, xy, xz, yy, yz, zz], [x, y, z]) = (self.upper(), self.first_moment.array());
        [self.mass, x, y, z, xx, xy, yy, xz, yz, zz]
    }

    /// The inertia of these [parameters](Self::parameters).
    #[inline]
    pub fn from_parameters([mass, x, y, z, xx, xy, yy, xz, yz, zz]: [R; 10]) -> Self {
        let column = |x, y, z| R::Vec3::new(x, y, z);
        Self {
            mass,
            first_moment: column(x, y, z),
            rotational: R::Mat3::from_cols(
                column(xx, xy, xz),
                column(xy, yy, yz),
                column(xz, yz, zz),
            ),
        }
    }

    /// Zero inertia.
    pub const ZERO: Self =
        Self { mass: R::ZERO, first_moment: R::Vec3::ZERO, rotational: R::Mat3::ZERO };
}

impl<R: Real> Add for SpatialInertia<R> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn add(self, o: Self) -> Self {
        Self {
            mass: self.mass + o.mass,
            first_moment: self.first_moment + o.first_moment,
            rotational: self.rotational + o.rotational,
        }
    }
}

/// I v: momentum from velocity, force from acceleration. RBDA (2.63). 45 flops.
impl<R: Real> Mul<Motion<R>> for SpatialInertia<R> {
    type Output = Force<R>;
    #[cfg_attr(optimised, inline(always))]
    fn mul(self, m: Motion<R>) -> Force<R> {
        Force::new(
            self.rotational * m.ang + self.first_moment.cross(m.lin),
            m.lin * self.mass - self.first_moment.cross(m.ang),
        )
    }
}
