//! A UR5e without force sensors runs against a wall, finds the contact by its momentum, and reacts.
//!
//! | module | what |
//! |---|---|
//! | [`plant`] | the arm, its friction of either kind, the wall, and how they differ from the model |
//! | [`firmware`] | a tick: observer, detector, reaction, law, gate |
//! | [`crash`] | a run into the wall |
//! | [`path`] | the pick and place without a wall, with pushes |
//! | [`watch`] | the worst runs into a wall, false alarms, and the delay until a push is found |

pub mod crash;
pub mod firmware;
pub mod path;
pub mod plant;
pub mod watch;
