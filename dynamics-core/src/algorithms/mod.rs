//! The algorithms, one a file, for every tree and joint.

mod aba;
mod error;
mod handed;
mod rnea;

pub use aba::{aba, aba_at};
pub use error::NotPositiveDefinite;
pub use rnea::{rnea, rnea_at};
