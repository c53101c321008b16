//! Poses are written as matrices here.

use crate::description::Pose;

/// A pose: the upper three rows of a 4 × 4 matrix.
pub type Rows<T> = [[T; 4]; 3];

/// The matrix of a pose, by rows.
pub fn rows(pose: &Pose) -> Rows<f64> {
    std::array::from_fn(|i| {
        std::array::from_fn(|k| match k {
            3 => pose.position[i],
            _ => pose.rotation.col(k)[i],
        })
    })
}
