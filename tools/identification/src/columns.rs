//! The columns of the regression: ten parameters of each body, four of each joint.

use std::fmt;

use dynamics_core::algorithms::{friction_regressor, regressor};
use dynamics_core::effects::{Effect, Width};
use dynamics_core::model::RobotModel;
use dynamics_core::state::State;

/// The parameters of a joint: viscous and Coulomb friction, armature, and the offset of its torque.
pub const OF_JOINT: usize = 4;

/// A parameter of an arm.
///
/// ```
/// use identification::{OfJoint, Parameter};
/// let armature = Parameter::Joint { joint: 2, of: OfJoint::Armature };
/// assert_eq!(armature.column(6), 60 + 2 * 4 + 2);
/// assert_eq!(Parameter::at(70, 6), armature);
/// assert_eq!(Parameter::at(13, 6).to_string(), "body 1 m c_z");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// An inertial parameter of a body.
    Body {
        /// The body.
        body: usize,
        /// Its place in the order of
        /// [`SpatialInertia::parameters`](dynamics_core::spatial::SpatialInertia::parameters).
        place: usize,
    },
    /// A parameter of a joint.
    Joint {
        /// The joint's coordinate.
        joint: usize,
        /// Which one.
        of: OfJoint,
    },
}

/// A parameter of a joint, in the order of the columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OfJoint {
    /// Viscous friction, N·m·s/rad or N·s/m.
    Viscous,
    /// Coulomb friction, N·m or N.
    Coulomb,
    /// The inertia of the rotor behind the gear, kg·m² or kg.
    Armature,
    /// The torque that is measured without any, N·m or N.
    Offset,
}

impl OfJoint {
    const ALL: [Self; OF_JOINT] = [Self::Viscous, Self::Coulomb, Self::Armature, Self::Offset];
}

impl Parameter {
    /// The parameter of a column of an arm with this many bodies.
    #[must_use]
    pub fn at(column: usize, bodies: usize) -> Self {
        match column.checked_sub(10 * bodies) {
            None => Self::Body { body: column / 10, place: column % 10 },
            Some(own) => Self::Joint { joint: own / OF_JOINT, of: OfJoint::ALL[own % OF_JOINT] },
        }
    }

    /// Its column, in an arm with this many bodies.
    #[must_use]
    pub fn column(self, bodies: usize) -> usize {
        match self {
            Self::Body { body, place } => 10 * body + place,
            Self::Joint { joint, of } => 10 * bodies + OF_JOINT * joint + of as usize,
        }
    }
}

impl fmt::Display for Parameter {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        const NAMES: [&str; 10] =
            ["m", "m c_x", "m c_y", "m c_z", "I_xx", "I_xy", "I_yy", "I_xz", "I_yz", "I_zz"];
        match *self {
            Self::Body { body, place } => write!(out, "body {body} {}", NAMES[place]),
            Self::Joint { joint, of } => {
                let name = match of {
                    OfJoint::Viscous => "viscous friction",
                    OfJoint::Coulomb => "Coulomb friction",
                    OfJoint::Armature => "armature",
                    OfJoint::Offset => "offset",
                };
                write!(out, "joint {joint} {name}")
            }
        }
    }
}

/// The torque of each joint per unit of each parameter: the regressor of the bodies, and q̇,
/// s(q̇/w), q̈ and 1 of each joint.
pub(crate) fn columns<D, E, const B: usize, const V: usize>(
    robot: &D,
    scene: &E,
    width: Width<f64>,
    state: &State<f64, V, V>,
) -> [Vec<f64>; V]
where
    D: RobotModel<f64, B, V, V>,
    E: Effect<f64, B, V>,
{
    let bodies = regressor(robot, state, scene);
    let friction = friction_regressor(&state.qd, width);
    std::array::from_fn(|j| {
        let mut row = bodies[j].as_flattened().to_vec();
        row.resize(10 * B + OF_JOINT * V, 0.0);
        let own = [friction[j][0], friction[j][1], state.qdd[j], 1.0];
        let at = 10 * B + OF_JOINT * j;
        row[at..at + OF_JOINT].copy_from_slice(&own);
        row
    })
}
