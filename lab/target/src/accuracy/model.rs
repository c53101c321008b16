//! The computed model: all terms of the rigid-body equation or fewer, of the robot or of a simplified one.

use core::marker::PhantomData;

use dynamics_core::effects::{Coriolis, Effect, Gravity, Inertia};
use dynamics_core::model::{Model, Pruned, Robot};
use glam::{DMat3, DVec3};

use super::numbers::{Compensated, Fixed};

/// A robot as it is computed, and the effects that are.
pub trait Modelled<const B: usize, const N: usize> {
    /// On the axis `model`.
    const NAME: &'static str;
    /// The robot, or the simplified robot in its place.
    type Robot: Robot<B, N, N>;
    type Scene: Effect<f32, B, N>
        + Effect<f64, B, N>
        + Effect<Compensated, B, N>
        + Effect<Fixed, B, N>;
    const SCENE: Self::Scene;
    /// Their numbers in the [`Units`] of the robot.
    const IN_UNITS: Self::Scene;
}

/// Free fall, m/s², as in [`Gravity::EARTH`].
const FREE_FALL: f64 = 9.81;

macro_rules! modelled {
    ($($(#[$doc:meta])* $model:ident<$($n:ident)?> of $robot:ty = $name:expr, $scene:ty = |$g:ident| $value:expr;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $model<T $(, const $n: u32)?>(PhantomData<T>);

        impl<T: Robot<B, N, N> $(, const $n: u32)?, const B: usize, const N: usize> Modelled<B, N> for $model<T $(, $n)?> {
            const NAME: &'static str = $name;
            type Robot = $robot;
            type Scene = $scene;
            const SCENE: $scene = {
                let $g = Gravity::new(FREE_FALL);
                $value
            };
            const IN_UNITS: $scene = {
                let $g = Gravity::new(Units::of(&T::MODEL).acceleration(FREE_FALL));
                $value
            };
        }
    )*};
}
modelled! {
    /// M q̈ + C q̇ + g.
    Full<> of T = "full", (Gravity, Inertia, Coriolis) = |g| (g, Inertia, Coriolis);
    /// M q̈ + g.
    NoCoriolis<> of T = "no_coriolis", (Gravity, Inertia) = |g| (g, Inertia);
    /// g.
    GravityOnly<> of T = "gravity", (Gravity,) = |g| (g,);
    /// All of it, of a robot whose lengths, masses and inertias are known to `BITS` bits: 8 are those of bf16, 11 of f16.
    Parameters<BITS> of Rounded<T, BITS> = match BITS {
        6 => "params6",
        8 => "params8",
        11 => "params11",
        _ => panic!("no such model"),
    }, (Gravity, Inertia, Coriolis) = |g| (g, Inertia, Coriolis);
    /// All of it, but for the base parameters that take less than so many millionths of the robot's torque.
    Without<PPM> of Pruned<T, PPM> = match PPM {
        100 => "pruned100",
        1000 => "pruned1000",
        3000 => "pruned3000",
        10_000 => "pruned10000",
        30_000 => "pruned30000",
        _ => panic!("no such model"),
    }, (Gravity, Inertia, Coriolis) = |g| (g, Inertia, Coriolis);
}

/// The robot with rounded parameters.
#[derive(Clone, Copy, Debug)]
pub struct Rounded<T, const BITS: u32>(PhantomData<T>);

impl<T, const BITS: u32, const B: usize, const N: usize> Robot<B, N, N> for Rounded<T, BITS>
where
    T: Robot<B, N, N>,
{
    const MODEL: Model<f64, B, N, N> = changed(T::MODEL, 1.0, 1.0, BITS);
}

/// The robot in units of `length` m and `mass` kg, its numbers rounded to so many bits; its joints turn, since lengths
/// among coordinates and limits stay as they are.
const fn changed<const B: usize, const N: usize>(
    mut model: Model<f64, B, N, N>,
    length: f64,
    mass: f64,
    bits: u32,
) -> Model<f64, B, N, N> {
    let (first, second) = (1.0 / (mass * length), 1.0 / (mass * length * length));
    let mut i = 0;
    while i < B {
        let link = &mut model.links[i];
        let inertia = &mut link.inertia;
        link.placement.pos =
            DVec3::from_array(rounded(link.placement.pos.to_array(), 1.0 / length, bits));
        inertia.mass = round(inertia.mass / mass, bits);
        inertia.first_moment =
            DVec3::from_array(rounded(inertia.first_moment.to_array(), first, bits));
        inertia.rotational =
            DMat3::from_cols_array(&rounded(inertia.rotational.to_cols_array(), second, bits));
        i += 1;
    }
    model
}

/// These numbers times s, rounded.
const fn rounded<const K: usize>(mut numbers: [f64; K], s: f64, bits: u32) -> [f64; K] {
    let mut i = 0;
    while i < K {
        numbers[i] = round(numbers[i] * s, bits);
        i += 1;
    }
    numbers
}

/// To nearest, by adding and cutting off bits of the mantissa's 53.
const fn round(x: f64, bits: u32) -> f64 {
    assert!(bits >= 1 && bits <= 53);
    let cut = 53 - bits;
    let half = (1_u64 << cut) >> 1;
    f64::from_bits((x.to_bits() + half) >> cut << cut)
}

/// Units in which everything that inverse dynamics meets stays within ±2.
#[derive(Clone, Copy, Debug)]
pub struct Units {
    /// m: the reach, rounded up to a power of two.
    pub length: f64,
    /// kg: the mass of all bodies, likewise.
    pub mass: f64,
    /// s.
    pub time: f64,
}

impl Units {
    /// Those of a robot whose joints turn at 3 rad/s all at once, or one of them much faster.
    pub const fn of<const B: usize, const N: usize>(model: &Model<f64, B, N, N>) -> Self {
        let (mut reach, mut total, mut i) = (0.0, 0.0, 0);
        while i < B {
            let at = model.links[i].placement.pos;
            reach += at.x.abs() + at.y.abs() + at.z.abs();
            total += model.links[i].inertia.mass;
            i += 1;
        }
        Self {
            length: power_of_two(reach),
            mass: power_of_two(total),
            time: 1.0 / 16.0,
        }
    }

    /// An acceleration of m/s² in these units.
    pub const fn acceleration(&self, a: f64) -> f64 {
        a * self.time * self.time / self.length
    }

    /// N·m of the unit of torque.
    pub const fn torque(&self) -> f64 {
        self.mass * self.length * self.length / (self.time * self.time)
    }
}

const fn power_of_two(least: f64) -> f64 {
    let mut power = 1.0 / 64.0;
    while power < least {
        power *= 2.0;
    }
    power
}

/// The robot in its [`Units`].
#[derive(Clone, Copy, Debug)]
pub struct InUnits<T>(PhantomData<T>);

impl<T: Robot<B, N, N>, const B: usize, const N: usize> Robot<B, N, N> for InUnits<T> {
    const MODEL: Model<f64, B, N, N> = {
        let Units { length, mass, .. } = Units::of(&T::MODEL);
        changed(T::MODEL, length, mass, 53)
    };
}
