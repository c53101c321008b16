//! The little f64 mathematics that turns a robot's description into numbers while compiling.
//!
//! `const fn` cannot use operators of glam's types nor `sin` and `sqrt`; these stand in for them
//! and are never called at run time on the target.

use glam::{DMat3, DVec3};

/// √x by Newton's iteration; within one ulp for normal x, NaN below zero.
pub(crate) const fn sqrt(x: f64) -> f64 {
    if x == 0.0 || x.is_nan() || x.is_infinite() {
        return x;
    }
    if x < 0.0 {
        return f64::NAN;
    }
    let mut y = f64::from_bits((x.to_bits() >> 1) + (1023 << 51));
    let mut i = 0;
    while i < 6 {
        y = 0.5 * (y + x / y);
        i += 1;
    }
    y
}

/// (sin x, cos x) by Taylor series about the nearest quarter turn; within 2 ulp to ±100 rad.
pub(crate) const fn sin_cos(x: f64) -> (f64, f64) {
    let turns = x * core::f64::consts::FRAC_2_PI;
    let k = if turns < 0.0 { (turns - 0.5) as i64 } else { (turns + 0.5) as i64 };
    // π/2 in two parts, the first with enough zero bits that k times it is exact.
    let r = (x - k as f64 * 1.570_796_326_734_125_6) - k as f64 * 6.077_100_506_506_192e-11;
    let (mut s, mut c, mut n) = (0.0, 0.0, 12);
    while n >= 1 {
        let even = (2 * n) as f64;
        s = r * r / (even * (even + 1.0)) * (1.0 - s);
        c = r * r / (even * (even - 1.0)) * (1.0 - c);
        n -= 1;
    }
    (s, c) = (r * (1.0 - s), 1.0 - c);
    match k.rem_euclid(4) {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    }
}

/// eˣ by Taylor series about the nearest multiple of ln 2; within 2 ulp to |x| ≤ 700.
pub(crate) const fn exp(x: f64) -> f64 {
    let powers = x * core::f64::consts::LOG2_E;
    let k = (if powers < 0.0 { powers - 0.5 } else { powers + 0.5 }) as i64;
    // ln 2 in two parts, the first with enough zero bits that k times it is exact.
    let r = (x - k as f64 * 0.693_147_180_369_123_8) - k as f64 * 1.908_214_929_270_587_7e-10;
    let (mut sum, mut n) = (1.0, 16);
    while n >= 1 {
        sum = 1.0 + sum * r / n as f64;
        n -= 1;
    }
    sum * f64::from_bits(((k + 1023) as u64) << 52)
}

pub(crate) const fn vec3(v: [f64; 3]) -> DVec3 {
    DVec3::new(v[0], v[1], v[2])
}

pub(crate) const fn scale(v: DVec3, s: f64) -> DVec3 {
    DVec3::new(v.x * s, v.y * s, v.z * s)
}

pub(crate) const fn add(a: DVec3, b: DVec3) -> DVec3 {
    DVec3::new(a.x + b.x, a.y + b.y, a.z + b.z)
}

pub(crate) const fn dot(a: DVec3, b: DVec3) -> f64 {
    a.x * b.x + a.y * b.y + a.z * b.z
}

pub(crate) const fn mul_vec(m: &DMat3, v: DVec3) -> DVec3 {
    add(add(scale(m.x_axis, v.x), scale(m.y_axis, v.y)), scale(m.z_axis, v.z))
}

pub(crate) const fn mul(a: &DMat3, b: &DMat3) -> DMat3 {
    DMat3::from_cols(mul_vec(a, b.x_axis), mul_vec(a, b.y_axis), mul_vec(a, b.z_axis))
}

pub(crate) const fn transpose(m: &DMat3) -> DMat3 {
    DMat3::from_cols(
        DVec3::new(m.x_axis.x, m.y_axis.x, m.z_axis.x),
        DVec3::new(m.x_axis.y, m.y_axis.y, m.z_axis.y),
        DVec3::new(m.x_axis.z, m.y_axis.z, m.z_axis.z),
    )
}

/// The rotation Q of coordinates with Q x = (1, 0, 0) and Q z = (0, 0, 1), of orthonormal x and z.
pub(crate) const fn frame(x: DVec3, z: DVec3) -> DMat3 {
    let y = DVec3::new(z.y * x.z - z.z * x.y, z.z * x.x - z.x * x.z, z.x * x.y - z.y * x.x);
    transpose(&DMat3::from_cols(x, y, z))
}

/// A unit vector perpendicular to the unit vector u: a coordinate axis where u is one.
pub(crate) const fn perpendicular(u: DVec3) -> DVec3 {
    let helper = if u.x.abs() <= u.y.abs() && u.x.abs() <= u.z.abs() {
        DVec3::X
    } else if u.y.abs() <= u.z.abs() {
        DVec3::Y
    } else {
        DVec3::Z
    };
    let x = add(helper, scale(u, -dot(helper, u)));
    scale(x, 1.0 / sqrt(dot(x, x)))
}

/// R = Rz(yaw) Ry(pitch) Rx(roll) from (sin, cos) pairs: child coordinates to parent's.
pub(crate) const fn rotation(roll: (f64, f64), pitch: (f64, f64), yaw: (f64, f64)) -> DMat3 {
    let x = DMat3::from_cols(
        DVec3::X,
        DVec3::new(0.0, roll.1, roll.0),
        DVec3::new(0.0, -roll.0, roll.1),
    );
    let y = DMat3::from_cols(
        DVec3::new(pitch.1, 0.0, -pitch.0),
        DVec3::Y,
        DVec3::new(pitch.0, 0.0, pitch.1),
    );
    let z =
        DMat3::from_cols(DVec3::new(yaw.1, yaw.0, 0.0), DVec3::new(-yaw.0, yaw.1, 0.0), DVec3::Z);
    mul(&z, &mul(&y, &x))
}

/// (sin, cos) of a number of quarter turns, exactly.
pub(crate) const fn quarter(turns: i32) -> (f64, f64) {
    match turns.rem_euclid(4) {
        0 => (0.0, 1.0),
        1 => (1.0, 0.0),
        2 => (0.0, -1.0),
        _ => (-1.0, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn const_sine_cosine_and_root_match_libm() {
        let mut x = -60.0;
        while x < 60.0 {
            let (s, c) = sin_cos(x);
            assert!((s - libm::sin(x)).abs() < 5e-16, "sin {x}: {s}");
            assert!((c - libm::cos(x)).abs() < 5e-16, "cos {x}: {c}");
            let y = libm::exp(x);
            assert!((sqrt(y) / libm::sqrt(y) - 1.0).abs() < 3e-16, "sqrt {y}");
            assert!((exp(x) / y - 1.0).abs() < 5e-16, "exp {x}");
            x += 0.137;
        }
    }
}
