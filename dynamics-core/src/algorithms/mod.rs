//! The algorithms, one a file, for every tree and joint.

mod aba;
mod rnea;

pub use aba::{NotPositiveDefinite, aba, aba_at};
pub use rnea::{rnea, rnea_at};
