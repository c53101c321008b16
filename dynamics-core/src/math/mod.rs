//! Functions of plain numbers: what is evaluated while compiling, and e⁻ˣ.

pub(crate) mod const_eval;
mod exp_neg;

pub use exp_neg::exp_neg;

/// The entry of a joint's coordinate, or zero for a joint that has none.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn entry<T: Copy + Default>(values: &[T], at: usize) -> T {
    values.get(at).copied().unwrap_or_default()
}
