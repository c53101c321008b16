//! Arithmetic that folds what is known while compiling: scalars, vectors and matrices, and products
//! with a joint's constants.

mod folded;
mod joint_products;
mod linalg;
mod series;

pub(crate) use folded::Folded;
pub(crate) use joint_products::{
    constant_offset_cross, rotate_matrix_to_parent, rotate_symmetric_to_parent, rotate_to_parent,
};
pub(crate) use linalg::{Mat3, Sym3, Vec3};
pub(crate) use series::{Series, Turn};
