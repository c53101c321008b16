//! From a recording of a small arm to its parameters, and what is refused.

mod arm;
mod formats;
mod found;
mod hostile;
mod logs;
mod mistakes;
mod presliding;
mod spoilt;
