//! The computed model: all terms of the rigid-body equation or fewer, of the robot or of a
//! simplified one.

use core::marker::PhantomData;

use dynamics_core::effects::{Coriolis, Effect, Gravity, Inertia, RIGID_BODY};
use dynamics_core::model::{Model, Pruned, Robot};
use glam::{DMat3, DVec3};

/// A robot as it is computed, and the effects that are.
pub trait Modelled<const B: usize, const N: usize> {
    /// On the axis `model`.
    const NAME: &'static str;
    /// The robot, or the simplified robot in its place.
    type Robot: Robot<B, N, N>;
    type Scene: Effect<f32, B, N> + Effect<f64, B, N>;
    const SCENE: Self::Scene;
}

macro_rules! modelled {
    ($($(#[$doc:meta])* $model:ident<$($n:ident)?> of $robot:ty = $name:expr, $scene:ty = $value:expr;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $model<T $(, const $n: u32)?>(PhantomData<T>);

        impl<T: Robot<B, N, N> $(, const $n: u32)?, const B: usize, const N: usize> Modelled<B, N> for $model<T $(, $n)?> {
            const NAME: &'static str = $name;
            type Robot = $robot;
            type Scene = $scene;
            const SCENE: $scene = $value;
        }
    )*};
}
modelled! {
    /// M q̈ + C q̇ + g.
    Full<> of T = "full", (Gravity, Inertia, Coriolis) = RIGID_BODY;
    /// M q̈ + g.
    NoCoriolis<> of T = "no_coriolis", (Gravity, Inertia) = (Gravity::EARTH, Inertia);
    /// g.
    GravityOnly<> of T = "gravity", (Gravity,) = (Gravity::EARTH,);
    /// All of it, of a robot whose lengths, masses and inertias are known to `BITS` bits: 8 are
    /// those of bf16, 11 of f16.
    Parameters<BITS> of Rounded<T, BITS> = match BITS {
        6 => "params6",
        8 => "params8",
        11 => "params11",
        _ => panic!("no such model"),
    }, (Gravity, Inertia, Coriolis) = RIGID_BODY;
    /// All of it, but for the base parameters that take less than so many millionths of the robot's
    /// torque.
    Without<PPM> of Pruned<T, PPM> = match PPM {
        100 => "pruned100",
        1000 => "pruned1000",
        3000 => "pruned3000",
        10_000 => "pruned10000",
        30_000 => "pruned30000",
        _ => panic!("no such model"),
    }, (Gravity, Inertia, Coriolis) = RIGID_BODY;
}

/// The robot with rounded parameters.
#[derive(Clone, Copy, Debug)]
pub struct Rounded<T, const BITS: u32>(PhantomData<T>);

impl<T, const BITS: u32, const B: usize, const N: usize> Robot<B, N, N> for Rounded<T, BITS>
where
    T: Robot<B, N, N>,
{
    const MODEL: Model<f64, B, N, N> = {
        let mut model = T::MODEL;
        let mut i = 0;
        while i < B {
            let link = &mut model.links[i];
            let inertia = &mut link.inertia;
            link.placement.pos = DVec3::from_array(rounded(link.placement.pos.to_array(), BITS));
            inertia.mass = round(inertia.mass, BITS);
            inertia.first_moment =
                DVec3::from_array(rounded(inertia.first_moment.to_array(), BITS));
            inertia.rotational =
                DMat3::from_cols_array(&rounded(inertia.rotational.to_cols_array(), BITS));
            i += 1;
        }
        model
    };
}

const fn rounded<const K: usize>(mut numbers: [f64; K], bits: u32) -> [f64; K] {
    let mut i = 0;
    while i < K {
        numbers[i] = round(numbers[i], bits);
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
