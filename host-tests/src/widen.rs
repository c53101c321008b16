//! An f32 model's own numbers in f64: what an oracle of f32 results has to compute with.

use glam::{DMat3, DQuat, Mat3};

use dynamics_core::model::{Link, Model};

/// The model rounded to f32 and widened again: f32's numbers, but for rotations, which are made
/// rotations again. One that is not orthonormal is not the same in every algorithm: they go by it
/// and by its transpose.
pub fn widened<const B: usize, const Q: usize, const V: usize>(
    model: &Model<f64, B, Q, V>,
) -> Model<f64, B, Q, V> {
    let (single, mut wide) = (model.to_f32(), *model);
    for (link, rounded) in std::iter::zip(&mut wide.links, &single.links) {
        widen(link, rounded);
    }
    wide
}

fn widen(link: &mut Link<f64>, rounded: &Link<f32>) {
    link.joint.axis = rounded.joint.axis.as_dvec3();
    link.joint.first_axis = rounded.joint.first_axis.as_dvec3();
    link.joint.pitch = rounded.joint.pitch.into();
    link.to_joint_frame = rotation(&rounded.to_joint_frame);
    link.placement.rot = rotation(&rounded.placement.rot);
    link.placement.pos = rounded.placement.pos.as_dvec3();
    link.inertia.mass = rounded.inertia.mass.into();
    link.inertia.first_moment = rounded.inertia.first_moment.as_dvec3();
    link.inertia.rotational = rounded.inertia.rotational.as_dmat3();
}

fn rotation(rounded: &Mat3) -> DMat3 {
    DMat3::from_quat(DQuat::from_mat3(&rounded.as_dmat3()).normalize())
}
