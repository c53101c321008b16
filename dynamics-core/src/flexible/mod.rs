//! Links that bend: assumed modes of a link as coordinates beside those of the joints.
//!
//! A robot is its rigid description and [`Modes`], a table of the integrals of its links' mode
//! shapes. Shapes come from beam data ([`Beam`]) or from a finite-element model ([`FlexibleLink`]);
//! a robot without them uses the functions of [`crate::algorithms`], [`Core`](crate::Core) and
//! [`Engine`](crate::Engine), of which this module changes nothing. Stiffness and damping of the
//! modes are an effect, [`Elasticity`](crate::effects::Elasticity).
//!
//! | function | result |
//! |---|---|
//! | [`rnea()`] | torques of the joints and forces on the modes |
//! | [`crba()`] | the inertia of joints and modes |
//! | [`forward_dynamics()`] | accelerations of both |
//! | [`modal_dynamics`] | accelerations of the modes along a given motion of the joints |
//! | [`step()`] | a step of simulation, stable for modes of any frequency |
//! | [`ModalFeedforward`] | torques along a reference, with the modes' motion under it |
//! | [`Bending`] | all of these but [`step()`] and [`ModalFeedforward::at_rest`] for a robot known at compile time, by the textbook or by the engine |
//!
//! The torques that move the *joints* along a reference are a sound inverse: the modes move under
//! it as those of links whose joints are clamped, and settle. The torques that would move the *tip*
//! along one are not: the tip of a link that bends is a non-minimum-phase output, whose inverse
//! grows without bound or begins before the motion (De Luca & Siciliano, 1993). No function has it.
//! A tip that is to come to rest is a matter of the reference: `motion_control::reference::Shaped`.
//!
//! # Limits
//! Displacements are linear in the modes: deflections to some 10 % of a link's length. A beam's
//! shortening and the stiffness that rotation and axial load give it are not included: joint rates
//! well below the first frequency.
//!
//! # Source
//! Book (1984); Shabana, *Dynamics of Multibody Systems* (2005), chapter 5.

mod beam;
mod bending;
mod check;
mod compiled;
mod crba;
mod deformation;
mod feedforward;
mod forward_dynamics;
mod frequencies;
mod link;
mod modal_forces;
mod modes;
mod rnea;
mod shape;
mod step;

pub use beam::{Beam, Shape};
pub use bending::Bending;
pub use crba::{FlexibleInertia, crba};
pub use feedforward::ModalFeedforward;
pub use forward_dynamics::{FlexibleError, forward_dynamics, modal_dynamics};
pub use link::{FlexibleLink, MODES_PER_LINK, Mode, ModeError, ModeProblem};
pub use modes::{BendingRobot, Modes};
pub use rnea::rnea;
pub use step::step;

use crate::scalar::Real;

/// A quantity of each joint and of each mode: torques and forces, or accelerations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointsAndModes<R, const V: usize, const M: usize> {
    /// Values of the joints, N·m or N; rad/s² or m/s².
    pub joints: [R; V],
    /// Values of the modes, N or N·m; m/s² or rad/s².
    pub modes: [R; M],
}

impl<R: Real, const V: usize, const M: usize> JointsAndModes<R, V, M> {
    /// Zero.
    pub const ZERO: Self = Self { joints: [R::ZERO; V], modes: [R::ZERO; M] };
}
