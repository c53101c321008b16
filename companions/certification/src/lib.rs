//! Proven rounding errors of machine code over a whole box of states.
//!
//! | module | what |
//! |---|---|
//! | [`program`], [`image`], `function` | a robot's functions, compiled as firmware is, and read |
//! | `decode`, [`walk`], [`graph`] | from instructions to the expression that they evaluate |
//! | [`interval`], [`state_box`], [`forms`] | ranges of numbers, inputs and sums |
//! | [`bound`], [`branch`] | the error over a part of the box, and over the whole |
//! | [`grid`] | the error over all angles, by a grid of them |
//! | [`sines`], [`roots`] | the errors of sines and of reciprocal roots, by trying every number |
//! | [`paths`] | that every state of the box takes the path that was followed at a branch |
//! | [`bodies`], [`exact`] | the robot's bodies, and the functions that are proven, in f64 |
//! | [`configurations`] | the errors of other kernels of sines and of other models |
//! | [`search`] | the worst error that is found |
//! | [`certificate`], `output`, [`page`] | what was proven, as data and text |
//! | [`check`] | that the page is of today's machine code |
//! | [`cycles`], `flow`, `machine`, `words` | the most cycles of a path, by the cycle meter's model |
//! | [`stack`] | the most stack |
//! | [`emulation`], [`target`], [`narrow`] | the functions in QEMU, and boxes of one's own |
#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod bodies;
pub mod bound;
pub mod branch;
pub mod certificate;
pub mod check;
pub mod configurations;
pub mod cycles;
mod decode;
mod digits;
pub mod emulation;
pub mod error;
pub mod exact;
mod flags;
mod flow;
pub mod forms;
mod function;
pub mod graph;
pub mod grid;
pub mod image;
pub mod interval;
mod machine;
pub mod narrow;
mod output;
pub mod page;
mod parts;
pub mod paths;
pub mod program;
pub mod roots;
pub mod search;
pub mod sines;
pub mod stack;
pub mod state_box;
pub mod target;
pub mod walk;
mod words;
