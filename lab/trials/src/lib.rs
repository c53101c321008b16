//! The scenes of [`contact`](lab_target::contact) and [`learning`](lab_target::learning) on the host: many more runs than those of
//! the firmware, as the figures of `docs/contact.md` and `docs/learning.md`. The tests hold the bars.

pub mod contact;
pub mod learning;
pub mod page;
pub mod select;
