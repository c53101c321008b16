//! The scenes of [`contact`](firmware_demo::contact) on the host: many more runs than those of the firmware, as the figures of
//! `docs/contact.md`. The tests hold the bars.

pub mod contact;
pub mod page;
