//! The place where a function finds the coordinates of the joints: data beside the code, for
//! `certify`.

use core::mem::offset_of;

use dynamics_core::model::JointCoordinate;

/// Bytes between coordinates, and to sine, cosine and position in each.
#[used]
static CERTIFIED_TRIG: [u32; 4] = [
    size_of::<JointCoordinate<f32>>() as u32,
    offset_of!(JointCoordinate<f32>, sin) as u32,
    offset_of!(JointCoordinate<f32>, cos) as u32,
    offset_of!(JointCoordinate<f32>, q) as u32,
];
