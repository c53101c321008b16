//! Eight f32 side by side as one scalar of the library: its algorithms then compute eight states at
//! once.
//!
//! Each operation is that of IEEE 754 in every lane, in the order of the algorithm, so that a lane
//! has the bits of f32 alone. Sines, exponentials and conversions are those of the library, lane by
//! lane. A comparison holds if it holds in all lanes: the algorithms over revolute joints compare
//! only whether a pivot is large enough, and a block of states in which one is not is computed
//! again one by one.

use std::array::from_fn;
use std::cmp::Ordering;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use dynamics_core::model::{Joint, JointLimits, Link, Model, Robot};
use dynamics_core::scalar::{Matrix, Real, Vector, sealed};
use dynamics_core::spatial::{SpatialInertia, Xform};
use wide::f32x8;

use crate::job::{Job, Row, Rows};

/// The number of states that are computed at once.
pub const LANES: usize = 8;

/// One number of each of eight states.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct Lanes(f32x8);

impl Lanes {
    #[inline(always)]
    fn splat(x: f32) -> Self {
        Self(f32x8::splat(x))
    }

    #[inline(always)]
    fn of(values: [f32; LANES]) -> Self {
        Self(f32x8::new(values))
    }

    #[inline(always)]
    fn array(self) -> [f32; LANES] {
        self.0.to_array()
    }

    /// A function of f32 in each lane.
    #[inline(always)]
    fn each(self, f: impl Fn(f32) -> f32) -> Self {
        Self::of(self.array().map(f))
    }

    /// Two functions of f32 in each lane.
    #[inline(always)]
    fn pairs(self, f: impl Fn(f32) -> (f32, f32)) -> (Self, Self) {
        let pairs = self.array().map(f);
        (Self::of(pairs.map(|pair| pair.0)), Self::of(pairs.map(|pair| pair.1)))
    }

    /// Whether a comparison holds in all lanes.
    #[inline(always)]
    fn all(self, other: Self, holds: impl Fn(f32, f32) -> bool) -> bool {
        let (a, b) = (self.array(), other.array());
        let mut all = true;
        for i in 0..LANES {
            all &= holds(a[i], b[i]);
        }
        all
    }
}

impl Default for Lanes {
    fn default() -> Self {
        Self::splat(0.0)
    }
}

impl PartialEq for Lanes {
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.all(*other, |a, b| a == b)
    }
}

macro_rules! comparisons {
    ($($function:ident $operator:tt),*) => {$(
        #[inline(always)]
        fn $function(&self, other: &Self) -> bool {
            self.all(*other, |a, b| a $operator b)
        }
    )*};
}

impl PartialOrd for Lanes {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        let is = |order| self.all(*other, |a, b| a.partial_cmp(&b) == Some(order));
        [Ordering::Less, Ordering::Equal, Ordering::Greater].into_iter().find(|&order| is(order))
    }
    comparisons!(lt <, le <=, gt >, ge >=);
}

macro_rules! operators {
    ($($trait:ident $function:ident),*) => {$(
        impl $trait for Lanes {
            type Output = Self;
            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self($trait::$function(self.0, other.0))
            }
        }
    )*};
}

operators!(Add add, Sub sub, Mul mul, Div div);

macro_rules! assigning {
    ($($type:ty: $trait:ident $function:ident $operator:tt),* $(,)?) => {$(
        impl $trait for $type {
            #[inline(always)]
            fn $function(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    )*};
}

assigning!(
    Lanes: AddAssign add_assign +, Lanes: SubAssign sub_assign -, Lanes: MulAssign mul_assign *,
    Vec3: AddAssign add_assign +, Vec3: SubAssign sub_assign -,
    Mat3: AddAssign add_assign +, Mat3: SubAssign sub_assign -,
);

impl Neg for Lanes {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0 ^ f32x8::splat(-0.0))
    }
}

/// A vector for each of the eight states.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec3 {
    x: Lanes,
    y: Lanes,
    z: Lanes,
}

/// A matrix for each of the eight states, by its columns.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mat3 {
    x: Vec3,
    y: Vec3,
    z: Vec3,
}

macro_rules! componentwise {
    ($($type:ident)*) => {$(
        componentwise!($type: Add<$type> add(o, x y z) o.x, o.y, o.z);
        componentwise!($type: Sub<$type> sub(o, x y z) o.x, o.y, o.z);
        componentwise!($type: Mul<Lanes> mul(o, x y z) o, o, o);
    )*};
    ($type:ident: $trait:ident<$other:ident> $function:ident($o:ident, $x:ident $y:ident $z:ident) $ox:expr, $oy:expr, $oz:expr) => {
        impl $trait<$other> for $type {
            type Output = Self;
            #[inline(always)]
            fn $function(self, $o: $other) -> Self {
                Self {
                    $x: $trait::$function(self.$x, $ox),
                    $y: $trait::$function(self.$y, $oy),
                    $z: $trait::$function(self.$z, $oz),
                }
            }
        }
    };
}

componentwise!(Vec3 Mat3);

impl Neg for Vec3 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z }
    }
}

// The sums and products below have the order of glam's, which are those of f32.
impl Vector<Lanes> for Vec3 {
    const ZERO: Self = Self { x: Lanes::ZERO, y: Lanes::ZERO, z: Lanes::ZERO };
    #[inline(always)]
    fn new(x: Lanes, y: Lanes, z: Lanes) -> Self {
        Self { x, y, z }
    }
    #[inline(always)]
    fn array(self) -> [Lanes; 3] {
        [self.x, self.y, self.z]
    }
    #[inline(always)]
    fn dot(self, o: Self) -> Lanes {
        self.x * o.x + self.y * o.y + self.z * o.z
    }
    #[inline(always)]
    fn cross(self, o: Self) -> Self {
        Self {
            x: self.y * o.z - o.y * self.z,
            y: self.z * o.x - o.z * self.x,
            z: self.x * o.y - o.x * self.y,
        }
    }
}

impl Mul<Vec3> for Mat3 {
    type Output = Vec3;
    #[inline(always)]
    fn mul(self, v: Vec3) -> Vec3 {
        self.x * v.x + self.y * v.y + self.z * v.z
    }
}

impl Mul for Mat3 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        Self { x: self * o.x, y: self * o.y, z: self * o.z }
    }
}

impl Matrix<Lanes> for Mat3 {
    const ZERO: Self = Self { x: Vec3::ZERO, y: Vec3::ZERO, z: Vec3::ZERO };
    const IDENTITY: Self = {
        let mut one = Self::ZERO;
        (one.x.x, one.y.y, one.z.z) = (Lanes::ONE, Lanes::ONE, Lanes::ONE);
        one
    };
    #[inline(always)]
    fn from_cols(x: Vec3, y: Vec3, z: Vec3) -> Self {
        Self { x, y, z }
    }
    #[inline(always)]
    fn cols(self) -> [Vec3; 3] {
        [self.x, self.y, self.z]
    }
    #[inline(always)]
    fn transpose(self) -> Self {
        let [x, y, z] = self.cols();
        Self {
            x: Vec3::new(x.x, y.x, z.x),
            y: Vec3::new(x.y, y.y, z.y),
            z: Vec3::new(x.z, y.z, z.z),
        }
    }
    #[inline(always)]
    fn transpose_mul(self, v: Vec3) -> Vec3 {
        Vec3::new(self.x.dot(v), self.y.dot(v), self.z.dot(v))
    }
}

impl sealed::Sealed for Lanes {}

impl Real for Lanes {
    type Vec3 = Vec3;
    type Mat3 = Mat3;
    const ZERO: Self = Self(f32x8::ZERO);
    const ONE: Self = Self(f32x8::ONE);
    const MAX_TRUNC: f64 = <f32 as Real>::MAX_TRUNC;
    const EPSILON: Self = Self(f32x8::new([f32::EPSILON; LANES]));
    const MIN_POSITIVE: Self = Self(f32x8::new([f32::MIN_POSITIVE; LANES]));

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Self::splat(x as f32)
    }
    fn to_f64(self) -> f64 {
        f64::from(self.array()[0])
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        self.pairs(Real::sin_cos)
    }
    #[inline(always)]
    fn sin_cos_near(self) -> (Self, Self) {
        self.pairs(Real::sin_cos_near)
    }
    fn exp_neg(self) -> Self {
        self.each(Real::exp_neg)
    }
    fn sqrt(self) -> Self {
        self.each(Real::sqrt)
    }
    fn atan2(self, x: Self) -> Self {
        let (a, b) = (self.array(), x.array());
        Self::of(from_fn(|i| Real::atan2(a[i], b[i])))
    }
    fn rsqrt(self) -> Self {
        self.each(Real::rsqrt)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0 & f32x8::splat(f32::from_bits(0x7fff_ffff)))
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        self.array().iter().all(|x| x.is_finite())
    }
    fn clamped(self, lo: Self, hi: Self) -> Self {
        let (x, lo, hi) = (self.array(), lo.array(), hi.array());
        Self::of(from_fn(|i| Real::clamped(x[i], lo[i], hi[i])))
    }
    fn trunc_saturating(self) -> Self {
        self.each(Real::trunc_saturating)
    }
    fn to_u32(self) -> u32 {
        Real::to_u32(self.array()[0])
    }
    fn cast<const B: usize, const Q: usize, const V: usize>(
        model: &Model<f64, B, Q, V>,
    ) -> Model<Self, B, Q, V> {
        let single = model.to_f32();
        model.in_scalar(from_fn(|i| lifted(&single.links[i])))
    }
    fn model<T, const B: usize, const Q: usize, const V: usize>() -> &'static Model<Self, B, Q, V>
    where
        T: Robot<B, Q, V>,
    {
        unreachable!("robots of run time are computed in lanes, no others")
    }
    #[inline(always)]
    fn either(condition: bool, yes: Self, no: Self) -> Self {
        if condition { yes } else { no }
    }
    #[inline(always)]
    fn select(_: f64, single: f32) -> Self {
        Self::splat(single)
    }
}

fn vector(v: dynamics_core::glam::Vec3) -> Vec3 {
    let [x, y, z] = v.to_array().map(Lanes::splat);
    Vec3 { x, y, z }
}

fn matrix(m: dynamics_core::glam::Mat3) -> Mat3 {
    Mat3 { x: vector(m.x_axis), y: vector(m.y_axis), z: vector(m.z_axis) }
}

/// A link with every number in all lanes.
fn lifted(link: &Link<f32>) -> Link<Lanes> {
    Link {
        name: link.name,
        parent: link.parent,
        joint: Joint {
            kind: link.joint.kind,
            axis: vector(link.joint.axis),
            first_axis: vector(link.joint.first_axis),
            pitch: Lanes::splat(link.joint.pitch),
        },
        to_joint_frame: matrix(link.to_joint_frame),
        placement: Xform { rot: matrix(link.placement.rot), pos: vector(link.placement.pos) },
        inertia: SpatialInertia {
            mass: Lanes::splat(link.inertia.mass),
            first_moment: vector(link.inertia.first_moment),
            rotational: matrix(link.inertia.rotational),
        },
        idx_q: link.idx_q,
        idx_v: link.idx_v,
        limits: JointLimits {
            lower: Lanes::splat(link.limits.lower),
            upper: Lanes::splat(link.limits.upper),
            velocity: Lanes::splat(link.limits.velocity),
            torque: Lanes::splat(link.limits.torque),
        },
    }
}

/// The whole blocks of eight rows of a job.
pub struct Blocks<'j, 'a> {
    /// The job that has the rows.
    pub job: &'j mut Job<'a, f32>,
    /// The number of blocks of eight rows.
    pub count: usize,
}

struct Block<'j, 'a> {
    job: &'j mut Job<'a, f32>,
    row: usize,
}

impl Row<Lanes> for Block<'_, '_> {
    #[inline(always)]
    fn get(&self, input: usize, column: usize) -> Lanes {
        let input = self.job.inputs[input];
        let rows = &input.data[self.row * input.width..(self.row + LANES) * input.width];
        Lanes::of(from_fn(|lane| rows[lane * input.width + column]))
    }

    #[inline(always)]
    fn put(&mut self, output: usize, column: usize, value: Lanes) {
        let output = &mut self.job.outputs[output];
        let width = output.width;
        let rows = &mut output.data[self.row * width..(self.row + LANES) * width];
        for (lane, x) in value.array().into_iter().enumerate() {
            rows[lane * width + column] = x;
        }
    }
}

impl Rows<Lanes> for Blocks<'_, '_> {
    fn count(&self) -> usize {
        self.count
    }

    #[inline(always)]
    fn at(&mut self, block: usize) -> impl Row<Lanes> {
        Block { job: self.job, row: block * LANES }
    }
}
