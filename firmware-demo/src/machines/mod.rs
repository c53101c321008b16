//! Robots of which no maker publishes the inertias: numbers of our own, of the size of real ones.

mod scara;

pub use scara::Scara;
