//! The functions that have certificates, and their expressions in a program.

use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};
use crate::factors::Order;
use crate::graph::Node;
use crate::image::Image;
use crate::walk::{Walked, walk};

/// A function that has a certificate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Function {
    /// Inverse dynamics of the engine: gravity, inertia and velocity products
    Rnea,
    /// Inverse dynamics of the engine under gravity alone
    Gravity,
    /// The inertia matrix of the engine
    Crba,
    /// Inverse dynamics of the core
    Core,
    /// Forward dynamics of the engine, whose error is relative to the condition of the inertia
    /// matrix
    #[serde(rename = "forward_dynamics")]
    #[value(name = "forward_dynamics")]
    ForwardDynamics,
    /// The inertia matrix of the core
    #[serde(rename = "core_crba")]
    #[value(name = "core_crba")]
    CoreCrba,
    /// Forward dynamics of the core, as that of the engine
    #[serde(rename = "core_forward_dynamics")]
    #[value(name = "core_forward_dynamics")]
    CoreForwardDynamics,
    /// Inverse dynamics of the engine for a robot with a kinematic loop: the program of
    /// `four_bar_leg` has no other
    Clustered,
}

impl Function {
    /// Its name on a page.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rnea => "engine `rnea`",
            Self::Gravity => "engine `rnea`, gravity alone",
            Self::Crba => "engine `crba`",
            Self::Core => "core `rnea`",
            Self::ForwardDynamics => "engine `forward_dynamics`",
            Self::CoreCrba => "core `crba`",
            Self::CoreForwardDynamics => "core `forward_dynamics`",
            Self::Clustered => "engine `rnea` with a four-bar",
        }
    }

    /// The variable of the program that holds its address.
    fn variable(self) -> &'static str {
        match self {
            Self::Rnea => "CERTIFIED_RNEA",
            Self::Gravity => "CERTIFIED_GRAVITY",
            Self::Crba => "CERTIFIED_CRBA",
            Self::Core => "CERTIFIED_CORE_RNEA",
            Self::ForwardDynamics => "CERTIFIED_FORWARD",
            Self::CoreCrba => "CERTIFIED_CORE_CRBA",
            Self::CoreForwardDynamics => "CERTIFIED_CORE_FORWARD",
            Self::Clustered => "CERTIFIED_CLUSTERED",
        }
    }

    /// Whether its results are the entries of an inertia matrix.
    pub(crate) fn is_matrix(self) -> bool {
        matches!(self, Self::Crba | Self::CoreCrba)
    }

    /// For forward dynamics, the function whose matrix it factors, and the order of its sums.
    pub fn matrix(self) -> Option<(Self, Order)> {
        match self {
            Self::ForwardDynamics => Some((Self::Crba, Order::Outward)),
            Self::CoreForwardDynamics => Some((Self::CoreCrba, Order::Inward)),
            _ => None,
        }
    }

    /// Whether its errors are torques or forces, which depend on speeds and accelerations.
    pub(crate) fn is_inverse_dynamics(self) -> bool {
        matches!(self, Self::Rnea | Self::Core | Self::Clustered)
    }
}

/// The address of a function of a program, as firmware calls it.
///
/// # Errors
/// [`Error::Missing`].
pub fn address(image: &Image, function: Function) -> Result<u32> {
    let variable = match function {
        Function::Clustered => "CERTIFIED_FIRMWARE",
        _ => function.variable(),
    };
    Ok(image.variable(variable)?.1[0])
}

/// The expression of a function of a program.
///
/// # Errors
/// [`Error::Declined`], [`Error::Missing`].
pub fn expression(image: &Image, function: Function) -> Result<Walked> {
    let address = image.variable(function.variable())?.1[0];
    let (effects, _) = image.variable("CERTIFIED_EFFECTS")?;
    let effects = Some(effects);
    let mut walked = match function {
        Function::Crba | Function::CoreCrba => walk(image, address, [None, None, effects])?,
        _ if function.matrix().is_some() => {
            walk(image, address, [None, None, None, None, effects])?
        }
        _ => walk(image, address, [None, None, None, effects])?,
    };
    if function == Function::Clustered || function.matrix().is_some() {
        // The first word says that there are results, which are the next ones.
        let (_, status) = walked.graph.outputs.remove(0);
        if walked.graph.nodes[status] != Node::Literal(0.0) {
            return Err(Error::Missing("results at the state zero".to_owned()));
        }
        for output in &mut walked.graph.outputs {
            output.0 -= 4;
        }
    }
    Ok(walked)
}
