//! Base parameters that replace those of the robot's description.

use crate::effects::RegroupedInertia;

/// Writes what is left to the body behind one joint.
type Load<E, R> = fn(&E, usize, &mut RegroupedInertia<R>);

/// Base parameters of all bodies, for the engine: see [`BaseParameters`](crate::effects::BaseParameters).
#[derive(Debug)]
pub struct Regrouped<E, R> {
    pub(in crate::effects) load: Option<Load<E, R>>,
    pub(in crate::effects) sets: usize,
    /// The name of the robot that they belong to.
    pub(in crate::effects) robot: &'static str,
}

impl<E, R> Regrouped<E, R> {
    /// Those of the robot's description.
    pub const NONE: Self = Self {
        load: None,
        sets: 0,
        robot: "",
    };

    /// Those of the robot of this name that `load` writes.
    pub(in crate::effects) const fn loaded(robot: &'static str, load: Load<E, R>) -> Self {
        Self {
            load: Some(load),
            sets: 1,
            robot,
        }
    }

    /// That of a forwarder.
    #[doc(hidden)]
    pub const fn forwarded(on: bool, sets: usize, robot: &'static str, load: Load<E, R>) -> Self {
        if on && sets > 0 {
            Self {
                load: Some(load),
                sets,
                robot,
            }
        } else {
            Self::NONE
        }
    }
}
