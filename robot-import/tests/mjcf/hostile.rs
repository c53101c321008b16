//! Models that are refused.
