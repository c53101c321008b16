//! Every driver against its data sheet or protocol document, in one program.

mod absolute;
mod can;
mod drives;
mod feetech;
mod incremental;
mod mapping;
