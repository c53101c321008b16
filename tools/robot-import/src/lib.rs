//! Robots from URDF or MJCF as constants of dynamics-core, with advice and a proof.
//!
//! A file becomes a [`description::Description`]; a [`selection::Selection`] of it a
//! [`tree::Tree`], in which all that does not move is merged; a tree the text of a Rust file by
//! [`write::source`]. [`check::check`] compares the tree's torques with Lagrange's equations of the
//! file's own links, and [`advice::advice`] lists what its user should know.
//!
//! ```
//! use robot_import::{selection::Selection, source, tree::{Numbers, Tree}, write};
//! let urdf = r#"<robot name="pendulum"><link name="base"/><link name="rod"><inertial><mass value="2"/>
//!     <origin xyz="0 0 -0.5"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.001"/></inertial></link>
//!     <joint name="pivot" type="revolute"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/></joint></robot>"#;
//! let robot = source::parse(urdf, ".".as_ref())?;
//! let tree = Tree::of(&robot, &Selection::default().of(&robot)?, Numbers::Exact)?;
//! assert_eq!(tree.bodies[0].inertia.com, [0.0, 0.0, -0.5]);
//! # Ok::<(), robot_import::error::ImportError>(())
//! ```
#![deny(missing_docs)]

pub mod advice;
#[cfg(feature = "program")]
pub mod check;
pub mod description;
pub mod dropped;
pub mod error;
#[cfg(feature = "program")]
pub mod estimate;
#[cfg(feature = "program")]
pub mod import;
pub mod inertia;
pub mod limits;
pub mod loops;
pub mod model;
pub mod number;
#[cfg(feature = "program")]
pub mod outputs;
pub mod physical;
pub mod plausible;
#[cfg(feature = "program")]
mod print;
#[cfg(feature = "program")]
pub mod project;
#[cfg(feature = "program")]
pub mod report;
#[cfg(feature = "program")]
mod rows;
pub mod selection;
pub mod snap;
pub mod source;
pub mod text;
pub mod tree;
pub mod write;
