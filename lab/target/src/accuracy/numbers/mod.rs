//! Ways in other numbers than f32. Nobody ships [`Compensated`] and [`Fixed`]: they are here to be compared with.

mod compensated;
mod fixed;
mod vector;

use core::marker::PhantomData;

use dynamics_core::drivetrain::ElasticReference;
use dynamics_core::model::Robot;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use dynamics_core::{Core, Engine};

use super::Inverse;
use super::key::Key;
use super::model::{InUnits, Modelled, Units};

pub use compensated::Compensated;
pub use fixed::{Fixed, HalfTurns};

/// A scalar that glam does not have as a [`Real`]; what no inverse dynamics computes goes through f64.
macro_rules! real {
    ($r:ident, full: $full:expr, epsilon: $epsilon:expr, tiny: $tiny:expr, sin_cos: $sin_cos:expr,
     $($name:ident: |$x:pat_param| -> $out:ty { $value:expr })*) => {
        impl dynamics_core::scalar::Sealed for $r {}

        impl Real for $r {
            type Vec3 = super::vector::Vec3<Self>;
            type Mat3 = super::vector::Mat3<Self>;
            const ZERO: Self = Self::new(0.0);
            const ONE: Self = Self::new(1.0);
            const MAX_TRUNC: f64 = $full;
            const EPSILON: Self = $epsilon;
            const MIN_POSITIVE: Self = $tiny;
            $(
                #[inline(always)]
                fn $name(self) -> $out {
                    let $x = self;
                    $value
                }
            )*
            #[inline(always)]
            fn from_f64(x: f64) -> Self {
                Self::new(x)
            }
            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                $sin_cos(self)
            }
            #[inline(always)]
            fn sin_cos_near(self) -> (Self, Self) {
                $sin_cos(self)
            }
            fn to_u32(self) -> u32 {
                self.to_f64() as u32
            }
            fn exp_neg(self) -> Self {
                Self::new(self.to_f64().exp_neg())
            }
            fn sqrt(self) -> Self {
                Self::new(self.to_f64().sqrt())
            }
            fn atan2(self, x: Self) -> Self {
                Self::new(self.to_f64().atan2(x.to_f64()))
            }
            #[inline(always)]
            fn clamped(self, lo: Self, hi: Self) -> Self {
                let x = if self > lo { self } else { lo };
                if x < hi { x } else { hi }
            }
            fn cast<const B: usize, const Q: usize, const V: usize>(
                model: &Model<f64, B, Q, V>,
            ) -> Model<Self, B, Q, V> {
                cast(model)
            }
            #[inline(always)]
            fn model<T: Robot<B, Q, V>, const B: usize, const Q: usize, const V: usize>()
            -> &'static Model<Self, B, Q, V> {
                const { &cast(&T::MODEL) }
            }
            #[inline(always)]
            fn either(condition: bool, yes: Self, no: Self) -> Self {
                if condition { yes } else { no }
            }
            #[inline(always)]
            fn select(double: f64, _: f32) -> Self {
                Self::new(double)
            }
        }

        use dynamics_core::model::{Model, Robot};

        const fn cast<const B: usize, const Q: usize, const V: usize>(
            model: &Model<f64, B, Q, V>,
        ) -> Model<$r, B, Q, V> {
            use super::vector::{Mat3, Vec3};
            dynamics_core::cast_model!(model, B, $r, |x| <$r>::new(x), Vec3::of, Mat3::of)
        }

        super::assigning! {
            [] $r, AddAssign add_assign +;
            [] $r, SubAssign sub_assign -;
            [] $r, MulAssign mul_assign *;
        }
    };
}
/// Operators of one or two operands, each with its result in terms of them.
macro_rules! operators {
    ($($(#[$doc:meta])* [$($generics:tt)*] $t:ty, $op:ident $name:ident ($($other:ty)?) -> $out:ty:
       |$a:ident $(, $b:ident)?| $value:expr;)*) => {$(
        $(#[$doc])*
        impl<$($generics)*> core::ops::$op $(<$other>)? for $t {
            type Output = $out;
            #[inline(always)]
            fn $name(self $(, $b: $other)?) -> $out {
                let $a = self;
                $value
            }
        }
    )*};
}
/// The operators that assign, by those that do not.
macro_rules! assigning {
    ($([$($generics:tt)*] $t:ty, $op:ident $name:ident $sign:tt;)*) => {$(
        impl<$($generics)*> core::ops::$op for $t {
            #[inline(always)]
            fn $name(&mut self, other: Self) {
                *self = *self $sign other;
            }
        }
    )*};
}
use {assigning, operators, real};

/// In fixed point, by the core: angles come in half turns, rates and accelerations in the robot's [`Units`], as
/// drives of this kind count them.
#[derive(Debug)]
pub struct FixedPoint<T, M, const B: usize>(PhantomData<(T, M)>);

inverse! {
    [T: Robot<B, N, N>, M: Modelled<B, N, Robot = T>, const B: usize] FixedPoint<T, M, B>,
        Key { arith: "q31", model: M::NAME, form: "core", ..Key::DEFAULT },
        { const UNIT: f64 = Units::of(&T::MODEL).torque(); },
        State<Fixed, N, N> = |course| {
            let State { q, qd, qdd } = course.state;
            let time = const { Units::of(&T::MODEL).time };
            let q = q.map(|q| {
                let half_turns = f64::from(q) / core::f64::consts::PI;
                // Whole turns are none.
                let turns = (half_turns * 0.5 + 0.5 * half_turns.signum()) as i32;
                Fixed::from_f64(half_turns - 2.0 * f64::from(turns))
            });
            let qd = qd.map(|qd| Fixed::from_f64(f64::from(qd) * time));
            let qdd = qdd.map(|qdd| Fixed::from_f64(f64::from(qdd) * time * time));
            State { q, qd, qdd }
        }, Fixed,
        |_| Self(PhantomData), #[inline(never)] |self, state| {
            let trig = Engine::<InUnits<T>, HalfTurns>::joint_trig(&state.q);
            Core::<InUnits<T>>::rnea(trig.with(state), &M::IN_UNITS)
        };
}
