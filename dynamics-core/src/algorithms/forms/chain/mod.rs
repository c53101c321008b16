//! Inverse dynamics, M and forward dynamics of a chain of joints with one coordinate each, as arms
//! are.
//!
//! The algorithms of the same names in [`algorithms`](crate::algorithms): between a body and the
//! next one nothing branches, so that what they share stays in registers, and links are visited
//! anew rather than stored.

mod aba;
mod across;
mod crba;
mod rnea;

pub(crate) use aba::aba;
pub(crate) use crba::crba;
pub(crate) use rnea::rnea;
