//! The columns of the regression: ten parameters of each body, six of each joint.

use std::fmt;

use dynamics_core::algorithms::{friction_regressor, regressor};
use dynamics_core::effects::{Effect, Width};
use dynamics_core::model::RobotModel;
use dynamics_core::state::State;

/// The parameters of a joint: viscous and Coulomb friction, armature, the offset of its torque,
/// Stribeck's excess and the asymmetry of Coulomb friction.
pub const OF_JOINT: usize = 6;

/// The friction of joints in a model, which is linear in its parameters.
///
/// ```
/// use dynamics_core::effects::Width;
/// use identification::Friction;
/// let friction: Friction = Width::new(0.02).into();
/// assert_eq!(friction.stribeck, None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// The speed w below which Coulomb friction fades, rad/s or m/s.
    pub width: Width<f64>,
    /// The speed v_s of [`Stribeck`](dynamics_core::effects::Stribeck), rad/s or m/s; without it
    /// the model lacks this friction.
    pub stribeck: Option<f64>,
    /// Whether Coulomb friction may differ with direction, as in
    /// [`AsymmetricCoulomb`](dynamics_core::effects::AsymmetricCoulomb).
    pub asymmetric: bool,
}

impl From<Width<f64>> for Friction {
    fn from(width: Width<f64>) -> Self {
        Self { width, stribeck: None, asymmetric: false }
    }
}

/// A parameter of an arm.
///
/// ```
/// use identification::{OfJoint, Parameter};
/// let armature = Parameter::Joint { joint: 2, of: OfJoint::Armature };
/// assert_eq!(armature.column(6), 60 + 2 * 6 + 2);
/// assert_eq!(Parameter::at(74, 6), armature);
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
    /// Friction at rest in excess of Coulomb friction, N·m or N.
    Stribeck,
    /// Half of the difference of Coulomb friction forward and backward, N·m or N.
    Asymmetry,
}

impl OfJoint {
    pub(crate) const ALL: [Self; OF_JOINT] = [
        Self::Viscous,
        Self::Coulomb,
        Self::Armature,
        Self::Offset,
        Self::Stribeck,
        Self::Asymmetry,
    ];
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
                    OfJoint::Stribeck => "Stribeck's excess",
                    OfJoint::Asymmetry => "asymmetry",
                };
                write!(out, "joint {joint} {name}")
            }
        }
    }
}

/// The torque of each joint per unit of each parameter: the regressor of the bodies, and q̇,
/// s = s(q̇/w), q̈, 1, e^{−(q̇/v_s)²} s and s² of each joint. A friction that the model lacks has a
/// column of zeros, which is no base parameter.
pub(crate) fn columns<D, E, const B: usize, const V: usize>(
    robot: &D,
    scene: &E,
    friction: Friction,
    state: &State<f64, V, V>,
) -> [Vec<f64>; V]
where
    D: RobotModel<f64, B, V, V>,
    E: Effect<f64, B, V>,
{
    let bodies = regressor(robot, state, scene);
    let columns = friction_regressor(&state.qd, friction.width);
    std::array::from_fn(|j| {
        let mut row = bodies[j].as_flattened().to_vec();
        row.resize(10 * B + OF_JOINT * V, 0.0);
        let [viscous, sign] = columns[j];
        let bell = |speed: f64| sign * (-(state.qd[j] / speed).powi(2)).exp();
        let stribeck = friction.stribeck.map_or(0.0, bell);
        let asymmetry = if friction.asymmetric { sign * sign } else { 0.0 };
        let own = [viscous, sign, state.qdd[j], 1.0, stribeck, asymmetry];
        let at = 10 * B + OF_JOINT * j;
        row[at..at + OF_JOINT].copy_from_slice(&own);
        row
    })
}

/// The numbers of joints, with zeros for the last ones.
pub(crate) fn padded<const N: usize, const V: usize>(
    joints: &[[f64; N]; V],
) -> [[f64; OF_JOINT]; V] {
    joints.map(|own| std::array::from_fn(|k| own.get(k).copied().unwrap_or(0.0)))
}
