//! The description of a link that bends: its modes by their integrals over the mass.

use core::fmt;

use crate::engine::MODES;

/// The most modes of one link.
pub const MODES_PER_LINK: usize = MODES;

/// A vector, and a matrix by rows, of a description.
pub(super) type Row = [f64; 3];
pub(super) type Rows = [Row; 3];

/// One assumed mode of a link: a displacement φ(r₀) η of every point r₀, in the link's frame.
///
/// φ has no unit and η is in m where the shape is scaled by a displacement, and φ in m/rad and η in
/// rad where it is scaled by an angle. The frame is that of the link's joint, with which the link
/// is clamped there: φ and its derivatives are zero at the joint's end.
///
/// ```
/// use dynamics_core::flexible::Mode;
/// // A massless rod along x of 1 m that bends along z, with 2 kg at its end: η is the displacement of these, m.
/// let (mut mode, tip) = (Mode::ZERO, 2.0);
/// mode.momentum = [0.0, 0.0, tip];
/// mode.moments[2][0] = tip * 1.0; // φ along z, r along x
/// mode.shift = [0.0, 0.0, 1.0];
/// mode.turn = [0.0, -1.5, 0.0]; // the slope of a cantilever is 3/2 of deflection over length, about −y
/// assert_ne!(mode, Mode::ZERO);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// ∫ φ dm, kg times the unit of φ.
    pub momentum: [f64; 3],
    /// ∫ φ r₀ᵀ dm, kg·m times the unit of φ: a row for each component of φ.
    pub moments: [[f64; 3]; 3],
    /// φ at the link's end.
    pub shift: [f64; 3],
    /// The rotation of the link's end per η, rad/m or 1: ½ curl φ.
    pub turn: [f64; 3],
}

impl Mode {
    /// No displacement.
    pub const ZERO: Self =
        Self { momentum: [0.0; 3], moments: [[0.0; 3]; 3], shift: [0.0; 3], turn: [0.0; 3] };
}

/// A link with its modes: what [`Modes`](super::Modes) is made of.
///
/// From a beam's data by [`Beam::link`](super::Beam::link), or from the integrals of a
/// finite-element model:
///
/// ```
/// use dynamics_core::flexible::{FlexibleLink, Mode};
/// let (mut mode, tip) = (Mode::ZERO, 2.0);
/// mode.momentum[2] = tip;
/// mode.moments[2][0] = tip;
/// mode.shift[2] = 1.0;
/// mode.turn[1] = -1.5;
/// let mut link = FlexibleLink::new(0, [1.0, 0.0, 0.0], &[mode]);
/// link.products[0][0][2][2] = tip; // ∫ φ φᵀ dm
/// link.stiffness[0][0] = 3.0 * 40.0; // 3 EI / L³, N/m
/// link.damping[0][0] = 0.2;
/// assert_eq!(link.count, 1);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlexibleLink {
    /// The body's number in the robot.
    pub body: usize,
    /// The link's end in its frame, m, undeformed: bodies whose parent this link is stand on the
    /// end and move with it.
    pub end: [f64; 3],
    /// The number of modes that are used.
    pub count: usize,
    /// The modes, N = `count` of them.
    pub modes: [Mode; MODES_PER_LINK],
    /// ∫ φₖ φₗᵀ dm of each pair k, l, of which the traces are the modes' inertia. The matrix of l,
    /// k is the transpose.
    pub products: [[Rows; MODES_PER_LINK]; MODES_PER_LINK],
    /// Stiffness K, N/m or N·m/rad, symmetric.
    pub stiffness: [[f64; MODES_PER_LINK]; MODES_PER_LINK],
    /// Damping D, N·s/m or N·m·s/rad, symmetric.
    pub damping: [[f64; MODES_PER_LINK]; MODES_PER_LINK],
}

impl FlexibleLink {
    /// A link with these modes, whose products, stiffness and damping are zero.
    /// [`Modes`](super::Modes) refuses more than [`MODES_PER_LINK`].
    pub const fn new(body: usize, end: [f64; 3], modes: &[Mode]) -> Self {
        const NONE: [f64; MODES_PER_LINK] = [0.0; MODES_PER_LINK];
        let mut link = Self {
            body,
            end,
            count: modes.len(),
            modes: [Mode::ZERO; MODES_PER_LINK],
            products: [[[[0.0; 3]; 3]; MODES_PER_LINK]; MODES_PER_LINK],
            stiffness: [NONE; MODES_PER_LINK],
            damping: [NONE; MODES_PER_LINK],
        };
        let mut k = 0;
        while k < modes.len() && k < MODES_PER_LINK {
            link.modes[k] = modes[k];
            k += 1;
        }
        link
    }
}

/// The modes of a link that cannot be used.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub struct ModeError {
    /// The link's name; the robot's, where no link is concerned.
    pub link: &'static str,
    /// The mode's number among those of the link.
    pub mode: usize,
    /// The mistake in it.
    pub problem: ModeProblem,
}

/// A mistake in the modes of a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ModeProblem {
    /// The robot has no body of this number.
    NoBody,
    /// Links are not in the order of their bodies, or one is named twice.
    Order,
    /// The links' modes are fewer or more than the M of [`Modes`](super::Modes), or those of one
    /// link more than [`MODES_PER_LINK`].
    Count,
    /// A number is not finite.
    NotFinite,
    /// The mode moves no mass.
    NoMass,
    /// The products of the modes are not a symmetric and positive definite matrix: the mode is a
    /// sum of those before it, or a number is wrong.
    Inertia,
    /// With the rigid motions of its link the inertia is not positive definite: a part of the mode
    /// is a rigid motion, or the body's mass is not that which the mode moves.
    RigidMotion,
    /// The stiffness is zero or negative, or the matrix is not symmetric and positive definite.
    Stiffness,
    /// The damping is negative, or the matrix is not symmetric.
    Damping,
    /// The beam's length or mass is not positive, or a property is negative.
    Beam,
    /// The beam has no shape of this number: shapes are counted from one, and of high ones no root
    /// was found.
    NoShape,
}

impl ModeProblem {
    pub(super) const fn text(self) -> &'static str {
        match self {
            Self::NoBody => "the robot has no body of this number",
            Self::Order => "links are not in the order of their bodies",
            Self::Count => "the links have another number of modes in all, or one has too many",
            Self::NotFinite => "a number is not finite",
            Self::NoMass => "it moves no mass",
            Self::Inertia => "the modes' inertia is not positive definite",
            Self::RigidMotion => {
                "it is in part a rigid motion, or moves more mass than the body has"
            }
            Self::Stiffness => "its stiffness is not positive definite",
            Self::Damping => "its damping is negative or not symmetric",
            Self::Beam => {
                "a property of the beam is negative, or it has no length, mass or stiffness"
            }
            Self::NoShape => "the beam has no shape of this number",
        }
    }
}

impl fmt::Display for ModeProblem {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.text())
    }
}

impl core::error::Error for ModeProblem {}

impl fmt::Display for ModeError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { link, mode, problem } = self;
        write!(out, "link `{link}`, mode {mode}: {problem}")
    }
}

impl core::error::Error for ModeError {}
