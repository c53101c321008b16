//! Functions of plain numbers: what is evaluated while compiling, and e⁻ˣ.

pub(crate) mod const_eval;
mod exp_neg;

pub use exp_neg::exp_neg;
