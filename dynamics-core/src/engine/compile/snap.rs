//! Entries that differ from −1, 0 or 1 by rounding alone become exact, so that their products fold.

use glam::{DMat3, DVec3};

const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Entries of a rotation that differ from −1, 0 or 1 by rounding alone.
pub(super) const fn snapped(r: &DMat3) -> DMat3 {
    DMat3::from_cols(snap_vec(r.x_axis), snap_vec(r.y_axis), snap_vec(r.z_axis))
}

const fn snap_vec(v: DVec3) -> DVec3 {
    DVec3::new(snap(v.x), snap(v.y), snap(v.z))
}

const fn snap(x: f64) -> f64 {
    let nearest = if x > 0.5 {
        1.0
    } else if x < -0.5 {
        -1.0
    } else {
        0.0
    };
    if (x - nearest).abs() < ROUNDING { nearest } else { x }
}

/// Components of an offset that are zero but for rounding.
pub(super) const fn snap_small(v: DVec3) -> DVec3 {
    let limit = ROUNDING * (v.x.abs() + v.y.abs() + v.z.abs());
    DVec3::new(
        if v.x.abs() <= limit { 0.0 } else { v.x },
        if v.y.abs() <= limit { 0.0 } else { v.y },
        if v.z.abs() <= limit { 0.0 } else { v.z },
    )
}
