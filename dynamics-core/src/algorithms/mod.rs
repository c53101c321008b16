//! The algorithms, one a file, for every tree and joint.

mod aba;
mod cholesky;
mod composite;
mod crba;
mod error;
mod factor;
mod forward;
mod handed;
mod hybrid;
mod operator;
mod rnea;

pub use aba::{aba, aba_at};
pub use cholesky::{Cholesky, cholesky};
pub use composite::{crba_jacobian, crba_jacobian_at};
pub use crba::{crba, crba_at};
pub use error::NotPositiveDefinite;
pub use factor::{factor, inverse, solve};
pub use forward::{forward, forward_at};
pub use hybrid::{Given, Response, hybrid, hybrid_at};
pub use operator::{operator_factor, operator_inverse};
pub use rnea::{rnea, rnea_at};
