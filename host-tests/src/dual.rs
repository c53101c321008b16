//! Dual numbers: the derivative of a computation to a rounding, without a step.
//!
//! Clifford, "Preliminary sketch of biquaternions" (1873): f(x + ε) = f(x) + ε f′(x), as ε² = 0.

use core::array::from_fn;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use dynamics_core::model::{Joint, JointKind, JointLimits, Link, Model, Robot};
use dynamics_core::scalar::{Matrix, Real, Vector, sealed};
use dynamics_core::spatial::{SpatialInertia, Xform};
use dynamics_core::state::State;
use glam::{DMat3, DQuat, DVec3};

/// A value and its derivative by whatever the computation's input depends on.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Dual {
    pub value: f64,
    pub slope: f64,
}

/// A vector of dual numbers, or a matrix by its columns.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Three<T>([T; 3]);
type Columns = Three<Three<Dual>>;

const fn dual(value: f64, slope: f64) -> Dual {
    Dual { value, slope }
}

macro_rules! operator {
    ($trait:ident $function:ident |$a:ident, $b:ident| $slope:expr) => {
        impl $trait for Dual {
            type Output = Self;
            fn $function(self, $b: Self) -> Self {
                let $a = self;
                dual($trait::$function($a.value, $b.value), $slope)
            }
        }
    };
}
operator!(Add add |a, b| a.slope + b.slope);
operator!(Sub sub |a, b| a.slope - b.slope);
operator!(Mul mul |a, b| a.slope * b.value + a.value * b.slope);
operator!(Div div |a, b| (a.slope - a.value / b.value * b.slope) / b.value);

impl<T: Add<Output = T> + Copy> Add for Three<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(from_fn(|i| self.0[i] + other.0[i]))
    }
}

impl<T: Sub<Output = T> + Copy> Sub for Three<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(from_fn(|i| self.0[i] - other.0[i]))
    }
}

impl<T: Mul<Dual, Output = T> + Copy> Mul<Dual> for Three<T> {
    type Output = Self;
    fn mul(self, by: Dual) -> Self {
        Self(self.0.map(|x| x * by))
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        dual(-self.value, -self.slope)
    }
}

impl Neg for Three<Dual> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|x| -x))
    }
}

impl Mul<Three<Dual>> for Columns {
    type Output = Three<Dual>;
    fn mul(self, v: Three<Dual>) -> Three<Dual> {
        let [x, y, z] = from_fn(|i| self.0[i] * v.0[i]);
        x + y + z
    }
}

impl Mul for Columns {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self(other.0.map(|column| self * column))
    }
}

macro_rules! assign {
    ($($type:ty: $trait:ident $function:ident $operator:tt;)*) => {$(
        impl $trait for $type {
            fn $function(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    )*};
}
assign! {
    Dual: AddAssign add_assign +;
    Dual: SubAssign sub_assign -;
    Dual: MulAssign mul_assign *;
    Three<Dual>: AddAssign add_assign +;
    Three<Dual>: SubAssign sub_assign -;
    Columns: AddAssign add_assign +;
    Columns: SubAssign sub_assign -;
}

impl Vector<Dual> for Three<Dual> {
    const ZERO: Self = Self([Dual::ZERO; 3]);
    fn new(x: Dual, y: Dual, z: Dual) -> Self {
        Self([x, y, z])
    }
    fn array(self) -> [Dual; 3] {
        self.0
    }
    fn dot(self, other: Self) -> Dual {
        let [x, y, z] = from_fn(|i| self.0[i] * other.0[i]);
        x + y + z
    }
    fn cross(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([b * z - c * y, c * x - a * z, a * y - b * x])
    }
}

impl Matrix<Dual> for Columns {
    const ZERO: Self = Self([Three::<Dual>::ZERO; 3]);
    const IDENTITY: Self = {
        let (o, l) = (Dual::ZERO, Dual::ONE);
        Self([Three([l, o, o]), Three([o, l, o]), Three([o, o, l])])
    };
    fn from_cols(x: Three<Dual>, y: Three<Dual>, z: Three<Dual>) -> Self {
        Self([x, y, z])
    }
    fn cols(self) -> [Three<Dual>; 3] {
        self.0
    }
    fn transpose(self) -> Self {
        Self(from_fn(|i| Three(self.0.map(|column| column.0[i]))))
    }
    fn transpose_mul(self, v: Three<Dual>) -> Three<Dual> {
        Three(self.0.map(|column| column.dot(v)))
    }
}

impl sealed::Sealed for Dual {}

impl Real for Dual {
    type Vec3 = Three<Self>;
    type Mat3 = Columns;
    const ZERO: Self = dual(0.0, 0.0);
    const ONE: Self = dual(1.0, 0.0);
    const MAX_TRUNC: f64 = <f64 as Real>::MAX_TRUNC;
    const EPSILON: Self = dual(f64::EPSILON, 0.0);
    const MIN_POSITIVE: Self = dual(f64::MIN_POSITIVE, 0.0);

    fn from_f64(x: f64) -> Self {
        dual(x, 0.0)
    }
    fn to_f64(self) -> f64 {
        self.value
    }
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.value.sin_cos();
        (dual(s, c * self.slope), dual(c, -s * self.slope))
    }
    fn sin_cos_near(self) -> (Self, Self) {
        Real::sin_cos(self)
    }
    fn exp_neg(self) -> Self {
        let e = (-self.value.max(0.0)).exp();
        dual(e, if self.value < 0.0 { 0.0 } else { -e * self.slope })
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        dual(root, self.slope / (2.0 * root))
    }
    fn atan2(self, x: Self) -> Self {
        let square = self.value * self.value + x.value * x.value;
        let slope = (x.value * self.slope - self.value * x.slope) / square;
        dual(self.value.atan2(x.value), slope)
    }
    fn rsqrt(self) -> Self {
        Self::ONE / Real::sqrt(self)
    }
    fn abs(self) -> Self {
        if self.value < 0.0 { -self } else { self }
    }
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.slope.is_finite()
    }
    fn clamped(self, lo: Self, hi: Self) -> Self {
        let x = if self > lo { self } else { lo };
        if x < hi { x } else { hi }
    }
    /// The library limits numbers by it: the slope is that of the limit, not of the steps.
    fn trunc_saturating(self) -> Self {
        let within = self.value.abs() < Self::MAX_TRUNC;
        dual(self.value.trunc_saturating(), if within { self.slope } else { 0.0 })
    }
    fn to_u32(self) -> u32 {
        self.value as u32
    }
    fn cast<const B: usize, const Q: usize, const V: usize>(
        model: &Model<f64, B, Q, V>,
    ) -> Model<Self, B, Q, V> {
        model.in_scalar(from_fn(|i| lifted(&model.links[i])))
    }
    fn model<T, const B: usize, const Q: usize, const V: usize>() -> &'static Model<Self, B, Q, V>
    where
        T: Robot<B, Q, V>,
    {
        unreachable!("a robot is cast, not known to the compiler")
    }
    fn either(condition: bool, yes: Self, no: Self) -> Self {
        if condition { yes } else { no }
    }
    fn select(double: f64, _: f32) -> Self {
        dual(double, 0.0)
    }
}

/// A constant vector.
pub fn vector<R: Real>(v: DVec3) -> R::Vec3 {
    let [x, y, z] = v.to_array().map(R::from_f64);
    R::Vec3::new(x, y, z)
}

fn matrix(m: DMat3) -> Columns {
    Three([m.x_axis, m.y_axis, m.z_axis].map(vector::<Dual>))
}

fn lifted(link: &Link<f64>) -> Link<Dual> {
    let (joint, inertia, limits) = (&link.joint, &link.inertia, &link.limits);
    let of = Dual::from_f64;
    Link {
        name: link.name,
        parent: link.parent,
        joint: Joint {
            kind: joint.kind,
            axis: vector::<Dual>(joint.axis),
            first_axis: vector::<Dual>(joint.first_axis),
            pitch: of(joint.pitch),
        },
        to_joint_frame: matrix(link.to_joint_frame),
        placement: Xform {
            rot: matrix(link.placement.rot),
            pos: vector::<Dual>(link.placement.pos),
        },
        inertia: SpatialInertia {
            mass: of(inertia.mass),
            first_moment: vector::<Dual>(inertia.first_moment),
            rotational: matrix(inertia.rotational),
        },
        idx_q: link.idx_q,
        idx_v: link.idx_v,
        limits: JointLimits {
            lower: of(limits.lower),
            upper: of(limits.upper),
            velocity: of(limits.velocity),
            torque: of(limits.torque),
        },
    }
}

/// q whose slope is that of q ⊕ δ along the coordinate k of δ, by the definitions of the joints.
pub fn along<const B: usize, const Q: usize, const V: usize>(
    model: &Model<f64, B, Q, V>,
    q: &[f64; Q],
    k: usize,
) -> [Dual; Q] {
    let mut rates = [0.0; Q];
    for link in &model.links {
        let (at, unit) = (link.idx_q, |i| f64::from(u8::from(link.idx_v + i == k)));
        match link.joint.kind {
            JointKind::Spherical | JointKind::Free => {
                let attitude = DQuat::from_slice(&q[at..at + 4]);
                let half = DQuat::from_xyzw(unit(0) / 2.0, unit(1) / 2.0, unit(2) / 2.0, 0.0);
                rates[at..at + 4].copy_from_slice(&(attitude * half).to_array());
                if link.joint.kind == JointKind::Free {
                    let v = attitude * DVec3::new(unit(3), unit(4), unit(5));
                    rates[at + 4..at + 7].copy_from_slice(&v.to_array());
                }
            }
            JointKind::Planar => {
                let (s, c) = q[at].sin_cos();
                let (x, y) = (unit(1), unit(2));
                rates[at..at + 3].copy_from_slice(&[unit(0), c * x - s * y, s * x + c * y]);
            }
            kind => (0..kind.coordinates().0).for_each(|i| rates[at + i] = unit(i)),
        }
    }
    from_fn(|i| dual(q[i], rates[i]))
}

/// Constants, of which number k has the slope 1.
pub fn seeded<const N: usize>(values: &[f64; N], k: usize) -> [Dual; N] {
    from_fn(|i| dual(values[i], f64::from(u8::from(i == k))))
}

/// ∂f/∂q and ∂f/∂q̇ of a function of a state, q along ⊕, by rows of f.
pub fn gradient<const B: usize, const Q: usize, const V: usize, const N: usize>(
    model: &Model<f64, B, Q, V>,
    state: &State<f64, Q, V>,
    f: impl Fn(&State<Dual, Q, V>) -> [Dual; N],
) -> [[[f64; V]; N]; 2] {
    let fixed = State {
        q: state.q.map(Dual::from_f64),
        qd: state.qd.map(Dual::from_f64),
        qdd: state.qdd.map(Dual::from_f64),
    };
    let mut by = [[[0.0; V]; N]; 2];
    for k in 0..V {
        let by_q = f(&State { q: along(model, &state.q, k), ..fixed });
        let by_qd = f(&State { qd: seeded(&state.qd, k), ..fixed });
        for (rows, column) in by.iter_mut().zip([by_q, by_qd]) {
            rows.iter_mut().zip(column).for_each(|(row, entry)| row[k] = entry.slope);
        }
    }
    by
}
