//! defmt's trait for types with glam's vectors, which do not implement it, for the feature `defmt`.
//!
//! All else that firmware logs derives it where it is defined.

use crate::effects::Payload;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::{Force, Motion, SpatialInertia};
use defmt::{Format, Formatter, write};

impl<R: Real + Format> Format for Motion<R> {
    fn format(&self, f: Formatter<'_>) {
        let (ang, lin) = (self.ang.array(), self.lin.array());
        write!(f, "Motion {{ ang: {}, lin: {} }}", ang, lin);
    }
}

impl<R: Real + Format> Format for Force<R> {
    fn format(&self, f: Formatter<'_>) {
        let (ang, lin) = (self.ang.array(), self.lin.array());
        write!(f, "Force {{ ang: {}, lin: {} }}", ang, lin);
    }
}

impl<R: Real + Format> Format for SpatialInertia<R> {
    fn format(&self, f: Formatter<'_>) {
        let columns = self.rotational.cols().map(R::Vec3::array);
        write!(
            f,
            "SpatialInertia {{ mass: {}, first_moment: {}, rotational: {} }}",
            self.mass,
            self.first_moment.array(),
            columns
        );
    }
}

impl<R: Real + Format, const BODY: usize> Format for Payload<R, BODY> {
    fn format(&self, f: Formatter<'_>) {
        write!(f, "Payload of body {}: {}", BODY, self.0);
    }
}
