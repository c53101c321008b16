//! The errors of the plant that the controller does not know.

use dynamics_core::model::{Calibrated, Robot};

/// Factors about one, from a fixed seed (Marsaglia's xorshift32, 2003).
#[derive(Clone, Copy, Debug)]
pub struct Noise(u32);

impl Noise {
    /// Noise whose factors are the same each time.
    pub const fn seeded() -> Self {
        Self(0x5eed_1234)
    }

    /// A factor in 1 ± `spread`.
    pub fn factor(&mut self, spread: f32) -> f32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        1.0 + spread * (self.0 as f32 * (2.0 / 4_294_967_296.0) - 1.0)
    }

    /// Friction off by up to 10 %, joint by joint.
    pub fn friction<const N: usize>(&mut self, coefficients: &mut [f32; N]) {
        for coefficient in coefficients {
            *coefficient *= self.factor(0.1);
        }
    }

    /// Masses off by up to 3 %, each body's inertia with its mass.
    pub fn masses<T, const B: usize, const Q: usize, const V: usize>(
        &mut self,
        robot: &mut Calibrated<T, f32, B, Q, V>,
    ) where
        T: Robot<B, Q, V>,
    {
        for inertia in robot.inertias() {
            let factor = self.factor(0.03);
            inertia.mass *= factor;
            inertia.first_moment *= factor;
            inertia.rotational *= factor;
        }
    }
}
