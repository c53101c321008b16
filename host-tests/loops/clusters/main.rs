//! Clusters of joints: laws, closed forms, recordings, singularities. One program, since all of it
//! uses the same functions of the same robots.

mod laws;
mod linkages;
mod motor_motion;
mod motors;
mod oracle;
mod plant;
mod singular;
mod singular_platforms;
