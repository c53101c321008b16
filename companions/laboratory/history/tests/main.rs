//! The ancestors of today's algorithms: their torques, and the operations that they take.

mod counts;
mod oracle;
