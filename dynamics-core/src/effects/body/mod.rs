//! Effects on single bodies: wrenches, contact, payloads; and base parameters of all of them.

mod base_parameters;
mod contact;
mod payload;
mod wrench;

pub use base_parameters::BaseParameters;
pub use contact::{Contact, ContactPoint};
pub use payload::{InvalidPayload, Payload};
pub use wrench::{BodyWrench, WorldWrench};
