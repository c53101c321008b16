//! Inverse dynamics, M and forward dynamics of a chain of joints with one coordinate each, as arms are.
//!
//! The algorithms of the same names in [`super`], which call them: between a body and the next one nothing branches, so that what
//! they share stays in registers, and links are visited anew rather than stored.

pub(super) mod aba;
mod across;
pub(super) mod crba;
pub(super) mod rnea;
