//! Every driver against its data sheet or protocol document, in one program.

mod absolute;
mod arrays;
mod can;
mod can_joints;
mod control_loop;
mod drives;
mod feetech;
mod incremental;
mod mapping;
