//! From a recording of a small arm to its parameters, and what is refused.

mod arm;
mod found;
mod hostile;
mod mistakes;
mod presliding;
