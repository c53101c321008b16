//! Symmetric 3×3 matrices in six numbers, and their eigenvalues for checks of models.

use core::ops::{Add, AddAssign};

use crate::math::const_eval::sqrt;
use crate::scalar::{Matrix, Real, Vector};

/// A symmetric matrix, by its upper triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Symmetric<R> {
    pub(crate) xx: R,
    pub(crate) xy: R,
    pub(crate) xz: R,
    pub(crate) yy: R,
    pub(crate) yz: R,
    pub(crate) zz: R,
}

impl<R: Real> Symmetric<R> {
    /// m 1.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn diagonal(m: R) -> Self {
        Self { xx: m, xy: R::ZERO, xz: R::ZERO, yy: m, yz: R::ZERO, zz: m }
    }

    /// 0.
    pub(crate) const ZERO: Self =
        Self { xx: R::ZERO, xy: R::ZERO, xz: R::ZERO, yy: R::ZERO, yz: R::ZERO, zz: R::ZERO };

    /// Its columns.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn columns(&self) -> [R::Vec3; 3] {
        [
            R::Vec3::new(self.xx, self.xy, self.xz),
            R::Vec3::new(self.xy, self.yy, self.yz),
            self.column_z(),
        ]
    }

    /// The upper triangle of a matrix.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn of(m: &R::Mat3) -> Self {
        let [x, y, z] = m.cols();
        let ([xx, _, _], [xy, yy, _], [xz, yz, zz]) = (x.array(), y.array(), z.array());
        Self { xx, xy, xz, yy, yz, zz }
    }

    /// Row and column z.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn column_z(&self) -> R::Vec3 {
        R::Vec3::new(self.xz, self.yz, self.zz)
    }

    /// Σ v. 15 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn times(&self, v: R::Vec3) -> R::Vec3 {
        let [x, y, z] = v.array();
        R::Vec3::new(
            self.xx * x + self.xy * y + self.xz * z,
            self.xy * x + self.yy * y + self.yz * z,
            self.xz * x + self.yz * y + self.zz * z,
        )
    }

    /// The matrix less a bᵀ, of whose products only the upper triangle is used. 12 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn minus_outer(&self, a: R::Vec3, b: R::Vec3) -> Self {
        let ([ax, ay, az], [bx, by, bz]) = (a.array(), b.array());
        Self {
            xx: self.xx - ax * bx,
            xy: self.xy - ax * by,
            xz: self.xz - ax * bz,
            yy: self.yy - ay * by,
            yz: self.yz - ay * bz,
            zz: self.zz - az * bz,
        }
    }

    /// Eᵀ Σ E in 59 flops instead of 75: Σ is zz 1, a matrix without a third column, and \[v\]×;
    /// the first is what it was, the last turns as v does, and the trace spares a product.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn turned_back(&self, e: &R::Mat3) -> Self {
        let [x, y, z] = e.cols().map(Vector::array);
        let (c, f) = (self.xz, self.yz);
        let (a, b, d) = (self.xx - self.zz, self.xy, self.yy - self.zz);
        let l = [[a, b], [b, d], [c + c, f + f]];
        let (ly, lz) = (row_times(y, &l), row_times(z, &l));
        let v = |at: [R; 3]| at[1] * c - at[0] * f;
        let (yy, zz) = (along(ly, y), along(lz, z));
        Self {
            xx: (a + d) - yy - zz + self.zz,
            xy: along(ly, x) + v(z),
            xz: along(lz, x) - v(y),
            yy: yy + self.zz,
            yz: along(lz, y) + v(x),
            zz: zz + self.zz,
        }
    }
}

/// Eᵀ H E of any matrix, split as [`Symmetric::turned_back`] does. 77 flops instead of 90.
#[cfg_attr(optimised, inline(always))]
pub(crate) fn turned_back<R: Real>(h: &R::Mat3, e: &R::Mat3) -> R::Mat3 {
    let [x, y, z] = e.cols().map(Vector::array);
    let [[xx, yx, zx], [xy, yy, zy], [xz, yz, zz]] = h.cols().map(Vector::array);
    let (a, d) = (xx - zz, yy - zz);
    let l = [[a, xy], [yx, d], [zx + xz, zy + yz]];
    let (lx, ly, lz) = (row_times(x, &l), row_times(y, &l), row_times(z, &l));
    let v = |at: [R; 3]| at[1] * xz - at[0] * yz;
    let (vx, vy, vz) = (v(x), v(y), v(z));
    let (m_yy, m_zz) = (along(ly, y), along(lz, z));
    R::Mat3::from_cols(
        R::Vec3::new((a + d) - m_yy - m_zz + zz, along(ly, x) + vz, along(lz, x) - vy),
        R::Vec3::new(along(lx, y) - vz, m_yy + zz, along(lz, y) + vx),
        R::Vec3::new(along(lx, z) + vy, along(ly, z) - vx, m_zz + zz),
    )
}

/// A row times a matrix without a third column.
#[cfg_attr(optimised, inline(always))]
fn row_times<R: Real>([x, y, z]: [R; 3], l: &[[R; 2]; 3]) -> [R; 2] {
    let [[a, b], [c, d], [e, f]] = *l;
    [x * a + y * c + z * e, x * b + y * d + z * f]
}

/// The scalar product with the first two of three.
#[cfg_attr(optimised, inline(always))]
fn along<R: Real>([a, b]: [R; 2], [x, y, _]: [R; 3]) -> R {
    a * x + b * y
}

impl<R: Real> Add for Symmetric<R> {
    type Output = Self;
    #[cfg_attr(optimised, inline(always))]
    fn add(self, o: Self) -> Self {
        Self {
            xx: self.xx + o.xx,
            xy: self.xy + o.xy,
            xz: self.xz + o.xz,
            yy: self.yy + o.yy,
            yz: self.yz + o.yz,
            zz: self.zz + o.zz,
        }
    }
}

impl<R: Real> AddAssign for Symmetric<R> {
    #[cfg_attr(optimised, inline(always))]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

/// Eigenvalues and eigenvectors, in no order.
#[derive(Clone, Copy)]
pub(crate) struct Eigen {
    pub(crate) values: [f64; 3],
    pub(crate) vectors: [[f64; 3]; 3],
}

/// By cyclic Jacobi rotations, each quadratic in the entries that are left: eight sweeps are more
/// than f64 needs. The vectors are those of the unit matrix unless they are asked for.
pub(crate) const fn eigen<const VECTORS: bool>(mut a: [[f64; 3]; 3]) -> Eigen {
    let mut vectors = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut sweep = 0;
    while sweep < 8 {
        rotate::<0, 1, VECTORS>(&mut a, &mut vectors);
        rotate::<0, 2, VECTORS>(&mut a, &mut vectors);
        rotate::<1, 2, VECTORS>(&mut a, &mut vectors);
        sweep += 1;
    }
    Eigen { values: [a[0][0], a[1][1], a[2][2]], vectors }
}

/// The rotation in the plane of axes P and Q that makes the entry there zero; its indices are
/// constants, so that no check of bounds is left.
const fn rotate<const P: usize, const Q: usize, const VECTORS: bool>(
    a: &mut [[f64; 3]; 3],
    vectors: &mut [[f64; 3]; 3],
) {
    if a[P][Q] == 0.0 {
        return;
    }
    let theta = (a[Q][Q] - a[P][P]) / (2.0 * a[P][Q]);
    let t = theta.signum() / (theta.abs() + sqrt(theta * theta + 1.0));
    let c = 1.0 / sqrt(t * t + 1.0);
    let s = t * c;
    let mut i = 0;
    while i < 3 {
        (a[i][P], a[i][Q]) = (c * a[i][P] - s * a[i][Q], s * a[i][P] + c * a[i][Q]);
        i += 1;
    }
    let ([px, py, pz], [qx, qy, qz]) = (a[P], a[Q]);
    a[P] = [c * px - s * qx, c * py - s * qy, c * pz - s * qz];
    a[Q] = [s * px + c * qx, s * py + c * qy, s * pz + c * qz];
    if VECTORS {
        let ([px, py, pz], [qx, qy, qz]) = (vectors[P], vectors[Q]);
        vectors[P] = [c * px - s * qx, c * py - s * qy, c * pz - s * qz];
        vectors[Q] = [s * px + c * qx, s * py + c * qy, s * pz + c * qz];
    }
}

#[cfg(test)]
mod tests {
    use super::{Symmetric, turned_back};
    use glam::{DMat3, DQuat, DVec3};

    #[test]
    fn turned_back_equals_the_product_of_three_matrices() {
        let e = DMat3::from_quat(DQuat::from_xyzw(0.1, -0.5, 0.7, 0.3).normalize());
        let h = DMat3::from_cols(
            DVec3::new(1.0, -2.0, 3.0),
            DVec3::new(4.0, 5.0, -6.0),
            DVec3::new(7.0, 0.8, 0.9),
        );
        let error = turned_back::<f64>(&h, &e) - e.transpose() * h * e;
        assert!(error.abs_diff_eq(DMat3::ZERO, 1e-14), "{error}");
        let s = h + h.transpose();
        let (got, want) = (Symmetric::<f64>::of(&s).turned_back(&e), e.transpose() * s * e);
        for v in [DVec3::X, DVec3::Y, DVec3::Z] {
            let got: DVec3 = Symmetric::<f64>::times(&got, v);
            assert!(got.abs_diff_eq(want * v, 1e-14), "{got:?} {want}");
        }
    }

    #[test]
    fn eigenvectors_make_the_matrix_diagonal() {
        for m in [[2.0, 0.3, -0.4, 1.5, 0.7, 0.9], [1.0, 1.5, 0.0, 1.0, 0.0, 1.0]] {
            let [xx, xy, xz, yy, yz, zz] = m;
            let found = super::eigen::<true>([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]);
            let m = DMat3::from_cols_array(&[xx, xy, xz, xy, yy, yz, xz, yz, zz]);
            for (value, axis) in found.values.into_iter().zip(found.vectors) {
                let axis = DVec3::from_array(axis);
                assert!((m * axis - axis * value).length() < 1e-14);
                assert!((axis.length() - 1.0).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn eigenvalues_of_a_known_matrix() {
        let a = [[2.0, 1.0, 0.0], [1.0, 2.0, 1.0], [0.0, 1.0, 2.0]];
        let mut e = super::eigen::<false>(a).values;
        e.sort_by(f64::total_cmp);
        for (got, want) in e.iter().zip([2.0 - 2.0_f64.sqrt(), 2.0, 2.0 + 2.0_f64.sqrt()]) {
            assert!((got - want).abs() < 1e-14, "{got} {want}");
        }
    }
}
