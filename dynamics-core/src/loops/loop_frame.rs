//! Loop frames in numbers: computed in f64 while compiling, and rounded to f32.

use glam::{DMat3, DVec3};

use super::loop_joint::BodyFrame;
use crate::math::const_eval as m;
use crate::model::Joint;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::Xform;

/// A vector in f64 and f32.
pub(super) type Both = ([f64; 3], [f32; 3]);

/// An aligned loop frame in the aligned frame of its body, in f64 and rounded to f32.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    /// Rotation of coordinates from the body's frame to this one, by rows.
    pub(super) rot: [Both; 3],
    pos: Both,
}

impl Frame {
    pub(super) const fn of(body: DMat3, joint: &Joint<f64>, end: &BodyFrame) -> Self {
        let rot = m::mul(&joint.normalised().frame(), &m::transpose(&end.rotation));
        let rows = m::mul(&body, &m::transpose(&rot));
        Self {
            rot: [both(rows.x_axis), both(rows.y_axis), both(rows.z_axis)],
            pos: both(m::mul_vec(&body, m::vec3(end.position))),
        }
    }

    /// From the body's aligned frame to this one.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn xform<R: Real>(&self) -> Xform<R> {
        let [x, y, z] = self.rot.each_ref().map(select::<R>);
        Xform { rot: R::Mat3::from_cols(x, y, z).transpose(), pos: select::<R>(&self.pos) }
    }
}

pub(super) const fn both(v: DVec3) -> Both {
    let v = [v.x, v.y, v.z];
    (v, [v[0] as f32, v[1] as f32, v[2] as f32])
}

#[cfg_attr(optimised, inline(always))]
pub(super) fn select<R: Real>(&([x, y, z], [p, q, r]): &Both) -> R::Vec3 {
    R::Vec3::new(R::select(x, p), R::select(y, q), R::select(z, r))
}
