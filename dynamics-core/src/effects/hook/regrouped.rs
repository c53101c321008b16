//! Base parameters that replace those of the robot's description.

/// The parameters that regrouping leaves to the body behind one joint, in the engine's frames and
/// units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[doc(hidden)]
pub struct RegroupedInertia<R> {
    /// m L², zero behind a revolute or spherical joint.
    pub(crate) mass: R,
    /// h L, in parts; its z is zero behind a revolute joint.
    pub(crate) moment: [R; 3],
    /// Σ: xx, xy, xz, yy, yz.
    pub(crate) second: [R; 5],
    /// The largest mass, first moment and second moment that the joint could move: those of its
    /// body and of its descendants, as if they lay in one line.
    pub(crate) size: [R; 3],
    /// Σ_zz, zero but behind a spherical or free joint.
    pub(crate) second_zz: R,
}

/// Writes what is left to the body behind one joint.
type Load<E, R> = fn(&E, usize, &mut RegroupedInertia<R>);

/// Base parameters of all bodies, for the engine: see
/// [`BaseParameters`](crate::effects::BaseParameters).
#[derive(Debug)]
#[doc(hidden)]
pub struct Regrouped<E, R> {
    #[doc(hidden)]
    pub load: Option<Load<E, R>>,
    pub(in crate::effects) sets: usize,
    /// The name of the robot that they belong to.
    pub(in crate::effects) robot: &'static str,
}

impl<E, R> Regrouped<E, R> {
    /// Those of the robot's description.
    pub const NONE: Self = Self { load: None, sets: 0, robot: "" };

    /// Those of the robot of this name that `load` writes.
    pub const fn loaded(robot: &'static str, load: Load<E, R>) -> Self {
        Self { load: Some(load), sets: 1, robot }
    }

    pub const fn with<F>(self, inner: &Regrouped<F, R>) -> Self {
        Self {
            load: self.load,
            sets: self.sets + inner.sets,
            robot: if self.sets > 0 { self.robot } else { inner.robot },
        }
    }

    pub const fn through(self, on: bool, load: Load<E, R>) -> Self {
        if on && self.sets > 0 { Self { load: Some(load), ..self } } else { Self::NONE }
    }
}
