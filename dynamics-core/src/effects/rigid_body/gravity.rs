//! Uniform gravity: a_0 = −g instead of a force on every body.
//!
//! Featherstone & Orin (2000), remark after (7); Luh, Walker & Paul (1980).

use core::marker::PhantomData;

use crate::effects::{Effect, hook};
use crate::scalar::{Real, Vector};

/// A direction in base coordinates, known to the compiler.
pub trait Direction {
    /// The unit vector; one of another length does not compile.
    const UNIT: [f64; 3];
}

/// Along −z of the base frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Down;

impl Direction for Down {
    const UNIT: [f64; 3] = [0.0, 0.0, -1.0];
}

/// Uniform gravity with its direction as a type; magnitude in m/s².
///
/// Its direction lets the engine drop the products with its zero components, and the sine and
/// cosine of a first joint whose axis is parallel to it.
#[doc(alias = "gravity compensation")]
#[doc(alias = "hand guiding")]
#[doc(alias = "lead-through")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gravity<D = Down> {
    double: f64,
    single: f32,
    direction: PhantomData<D>,
}

impl Gravity<Down> {
    /// 9.81 m/s² along −z of the base frame.
    pub const EARTH: Self = Self::new(9.81);
    /// 1.62 m/s² along −z of the base frame.
    pub const MOON: Self = Self::new(1.62);
}

impl<D: Direction> Gravity<D> {
    /// Gravity of the magnitude g, m/s², along D.
    ///
    /// ```
    /// use dynamics_core::effects::{Down, Gravity};
    /// const MARS: Gravity<Down> = Gravity::new(3.72);
    /// ```
    ///
    /// ```compile_fail,E0080
    /// use dynamics_core::effects::{Direction, Gravity};
    /// struct Aslant;
    /// impl Direction for Aslant {
    ///     const UNIT: [f64; 3] = [0.0, 1.0, -1.0];
    /// }
    /// const TILTED: Gravity<Aslant> = Gravity::new(9.81); // error: a direction is a vector of length 1
    /// ```
    pub const fn new(g: f64) -> Self {
        const {
            let [x, y, z] = D::UNIT;
            let squared = x * x + y * y + z * z;
            assert!(
                squared > 1.0 - 1e-9 && squared < 1.0 + 1e-9,
                "a direction is a vector of length 1"
            );
        }
        Self { double: g, single: g as f32, direction: PhantomData }
    }
}

impl<R: Real, D: Direction, const B: usize, const V: usize> Effect<R, B, V> for Gravity<D> {
    const DIFFERENTIABLE: bool = true;
    const GRAVITY_FIELD: hook::Field<Self, R> = hook::Field::gravity(Self::field::<R>).along([
        D::UNIT[0] != 0.0,
        D::UNIT[1] != 0.0,
        D::UNIT[2] != 0.0,
    ]);
}

impl<D: Direction> Gravity<D> {
    /// Adds the field.
    #[cfg_attr(optimised, inline(always))]
    fn field<R: Real>(&self, g: &mut R::Vec3) {
        // Component by component: a loop would convert from f64 at run time at opt-level s.
        let x = R::from_f64(D::UNIT[0]);
        let y = R::from_f64(D::UNIT[1]);
        let z = R::from_f64(D::UNIT[2]);
        *g += R::Vec3::new(x, y, z) * R::select(self.double, self.single);
    }
}
