//! What is demanded of each quantity: case, quantity, f32, f64. Bounds are about twice what was measured.

use super::outcome::Demand::{self, Named, NamedWithin, Within};

/// By cases.
pub const BOUNDS: &[(u32, &str, Demand, Demand)] = &[];
const _: [Demand; 3] = [Named, NamedWithin(0.0), Within(0.0)];
