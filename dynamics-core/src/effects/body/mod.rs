//! Effects on single bodies: wrenches, contact, payloads.

mod contact;
mod payload;
mod wrench;

pub use contact::{Contact, ContactPoint};
pub use payload::{InvalidPayload, Payload};
pub use wrench::{BodyWrench, WorldWrench};
