//! The figures of the README, and the programs on the guide's pages.

mod circles;
mod files;
mod pages;
mod readme;
