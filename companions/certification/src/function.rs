//! The functions that have certificates, and their expressions in a program.

use serde::Serialize;

use crate::error::{Error, Result};
use crate::graph::Node;
use crate::image::Image;
use crate::walk::{Walked, walk};

/// A function that has a certificate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Function {
    /// Inverse dynamics of the engine: gravity, inertia and velocity products
    Rnea,
    /// Inverse dynamics of the engine under gravity alone
    Gravity,
    /// Inverse dynamics of the core
    Core,
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
            Self::Core => "core `rnea`",
            Self::Clustered => "engine `rnea` with a four-bar",
        }
    }

    /// The variable of the program that holds its address.
    fn variable(self) -> &'static str {
        match self {
            Self::Rnea => "CERTIFIED_RNEA",
            Self::Gravity => "CERTIFIED_GRAVITY",
            Self::Core => "CERTIFIED_CORE_RNEA",
            Self::Clustered => "CERTIFIED_CLUSTERED",
        }
    }

    /// Whether its results depend on speeds and accelerations.
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
    let mut walked = walk(image, address, [None, None, None, Some(effects)])?;
    if function == Function::Clustered {
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
