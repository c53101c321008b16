//! Mass, centre of mass and inertia of what is welded together.

use crate::model::Body;

/// A rigid part, its numbers in the frame of the body that it is welded to.
#[derive(Clone, Copy)]
pub(super) struct WeldedPart {
    /// kg
    pub mass: f64,
    /// m
    pub com: [f64; 3],
    /// About the centre of mass: xx, xy, xz, yy, yz, zz, kg·m².
    pub inertia: [f64; 6],
}

impl WeldedPart {
    /// The same part, its frame's origin at `xyz` in the body's frame and its axes parallel.
    pub const fn at(mut self, xyz: [f64; 3]) -> Self {
        let mut i = 0;
        while i < 3 {
            self.com[i] += xyz[i];
            i += 1;
        }
        self
    }

    /// Both as one: I = I₁ + I₂ + μ (d·d 1 − d dᵀ), with μ = m₁ m₂ / (m₁ + m₂) and d from one
    /// centre of mass to the other.
    pub const fn with(self, other: Self) -> Self {
        let mass = self.mass + other.mass;
        let reduced = self.mass * other.mass / mass;
        let (mut com, mut d, mut i) = ([0.0; 3], [0.0; 3], 0);
        while i < 3 {
            com[i] = (self.mass * self.com[i] + other.mass * other.com[i]) / mass;
            d[i] = other.com[i] - self.com[i];
            i += 1;
        }
        let [x, y, z] = d;
        let apart = [y * y + z * z, -x * y, -x * z, x * x + z * z, -y * z, x * x + y * y];
        let (mut inertia, mut i) = ([0.0; 6], 0);
        while i < 6 {
            inertia[i] = self.inertia[i] + other.inertia[i] + reduced * apart[i];
            i += 1;
        }
        Self { mass, com, inertia }
    }

    /// The body made of this part.
    pub const fn of(self, body: Body) -> Body {
        body.mass(self.mass).com(self.com).inertia(self.inertia)
    }
}
