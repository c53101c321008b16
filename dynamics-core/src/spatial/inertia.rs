//! Inertias that are summed inward: of composite rigid bodies and of articulated bodies.

use core::ops::AddAssign;

use super::MotionSubspace;
use crate::math::entry;
use crate::scalar::{Matrix, Real, Vector};
use crate::spatial::symmetric::{Symmetric, turned_back};
use crate::spatial::{Force, Motion, SpatialInertia, Xform};

/// The inertia of bodies that move as one, in ten numbers. RBDA (2.63).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CompositeInertia<R: Real> {
    pub(super) mass: R,
    pub(super) first_moment: R::Vec3,
    pub(super) inertia: Symmetric<R>,
}

impl<R: Real> From<SpatialInertia<R>> for CompositeInertia<R> {
    #[cfg_attr(optimised, inline(always))]
    fn from(i: SpatialInertia<R>) -> Self {
        Self { mass: i.mass, first_moment: i.first_moment, inertia: Symmetric::of(&i.rotational) }
    }
}

impl<R: Real> AddAssign for CompositeInertia<R> {
    #[cfg_attr(optimised, inline(always))]
    fn add_assign(&mut self, o: Self) {
        self.mass += o.mass;
        self.first_moment += o.first_moment;
        self.inertia += o.inertia;
    }
}

impl<R: Real> CompositeInertia<R> {
    /// The ten parameters, in the order of [`SpatialInertia::parameters`].
    pub(crate) fn parameters(&self) -> [R; 10] {
        let Symmetric { xx, xy, xz, yy, yz, zz } = self.inertia;
        let [x, y, z] = self.first_moment.array();
        [self.mass, x, y, z, xx, xy, yy, xz, yz, zz]
    }

    /// Iᶜ s, the force of unit acceleration along a column of S.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn along(&self, s: &MotionSubspace<R>) -> Force<R> {
        let [x, y, _] = self.first_moment.array();
        let zero = R::ZERO;
        match s {
            MotionSubspace::RevoluteZ => {
                Force::new(self.inertia.column_z(), R::Vec3::new(-y, x, zero))
            }
            MotionSubspace::PrismaticZ => {
                Force::new(R::Vec3::new(y, -x, zero), R::Vec3::new(zero, zero, self.mass))
            }
            MotionSubspace::Unit(k) => self.column(*k),
            MotionSubspace::General(s) => Force::new(
                self.inertia.times(s.ang) + self.first_moment.cross(s.lin),
                s.lin * self.mass - self.first_moment.cross(s.ang),
            ),
        }
    }

    /// Column k of Iᶜ as a 6 × 6 matrix.
    #[cfg_attr(optimised, inline(always))]
    fn column(&self, k: usize) -> Force<R> {
        let ([x, y, z], zero) = (self.first_moment.array(), R::ZERO);
        let Symmetric { xx, xy, xz, yy, yz, zz } = self.inertia;
        let [ang, lin] = match k {
            0 => [[xx, xy, xz], [zero, -z, y]],
            1 => [[xy, yy, yz], [z, zero, -x]],
            2 => [[xz, yz, zz], [-y, x, zero]],
            3 => [[zero, z, -y], [self.mass, zero, zero]],
            4 => [[-z, zero, x], [zero, self.mass, zero]],
            _ => [[y, -x, zero], [zero, zero, self.mass]],
        };
        let vector = |[x, y, z]: [R; 3]| R::Vec3::new(x, y, z);
        Force::new(vector(ang), vector(lin))
    }

    /// The motion m with Iᶜ m = f, RBDA (2.74): about the centre of mass, rotation and translation
    /// are decoupled. None if there is no mass, or no inertia about some axis. 130 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn solve(&self, f: Force<R>) -> Option<Motion<R>> {
        let mass_inv = R::ONE / self.mass;
        let c = self.first_moment * mass_inv;
        // Ī + c× h×: 1 h·c less, as c and h are parallel.
        let mut about = self.inertia;
        let hc = self.first_moment.dot(c);
        (about.xx, about.yy, about.zz) = (about.xx - hc, about.yy - hc, about.zz - hc);
        let [x, y, z] = about.minus_outer(-self.first_moment, c).columns();
        let adjugate = [y.cross(z), z.cross(x), x.cross(y)];
        let det = x.dot(adjugate[0]);
        // One comparison that a NaN fails too.
        if !(det > R::ZERO && det.is_finite() && self.mass > R::ZERO) {
            return None;
        }
        let n = (f.ang - c.cross(f.lin)) * (R::ONE / det);
        let [p, q, r] = adjugate.map(|row| row.dot(n));
        let omega = R::Vec3::new(p, q, r);
        Some(Motion::new(omega, f.lin * mass_inv - omega.cross(c)))
    }

    /// Xᵀ Iᶜ X: the same inertia at the parent's frame. RBDA (2.66). 107 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn at_parent(&self, x: &Xform<R>) -> Self {
        let (h, r) = (x.rot.transpose_mul(self.first_moment), x.pos);
        let moment = h + r * self.mass;
        let i = self.inertia.turned_back(&x.rot);
        // Ī − r× h× − (h + m r)× r×, the parallel-axis theorem from any point to any other.
        let ([rx, ry, rz], [hx, hy, _]) = (r.array(), h.array());
        let ([_, ky, kz], [wx, wy, wz]) = (moment.array(), (h + moment).array());
        let (dx, dy, dz) = (rx * wx, ry * wy, rz * wz);
        Self {
            mass: self.mass,
            first_moment: moment,
            inertia: Symmetric {
                xx: i.xx + (dy + dz),
                xy: i.xy - (hx * ry + rx * ky),
                xz: i.xz - (hx * rz + rx * kz),
                yy: i.yy + (dx + dz),
                yz: i.yz - (hy * rz + ry * kz),
                zz: i.zz + (dx + dy),
            },
        }
    }
}

/// The inertia of an articulated body: symmetric, but no longer that of a rigid one.
///
/// The blocks of [Ī H; Hᵀ M], RBDA (2.72), in 21 numbers: the force per acceleration of its handle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ArticulatedInertia<R: Real> {
    pub(super) inertia: Symmetric<R>,
    pub(super) coupling: R::Mat3,
    pub(super) mass: Symmetric<R>,
}

impl<R: Real> From<SpatialInertia<R>> for ArticulatedInertia<R> {
    #[cfg_attr(optimised, inline(always))]
    fn from(i: SpatialInertia<R>) -> Self {
        let ([x, y, z], zero) = (i.first_moment.array(), R::ZERO);
        Self {
            inertia: Symmetric::of(&i.rotational),
            coupling: R::Mat3::from_cols(
                R::Vec3::new(zero, z, -y),
                R::Vec3::new(-z, zero, x),
                R::Vec3::new(y, -x, zero),
            ),
            mass: Symmetric::diagonal(i.mass),
        }
    }
}

impl<R: Real> AddAssign for ArticulatedInertia<R> {
    #[cfg_attr(optimised, inline(always))]
    fn add_assign(&mut self, o: Self) {
        self.inertia += o.inertia;
        self.coupling += o.coupling;
        self.mass += o.mass;
    }
}

/// Adds the inertia of a rigid body. 15 flops.
impl<R: Real> AddAssign<SpatialInertia<R>> for ArticulatedInertia<R> {
    #[cfg_attr(optimised, inline(always))]
    fn add_assign(&mut self, o: SpatialInertia<R>) {
        let [hx, hy, hz] = o.first_moment.array();
        let [[xx, yx, zx], [xy, yy, zy], [xz, yz, zz]] = self.coupling.cols().map(Vector::array);
        self.inertia += Symmetric::of(&o.rotational);
        self.coupling = R::Mat3::from_cols(
            R::Vec3::new(xx, yx + hz, zx - hy),
            R::Vec3::new(xy - hz, yy, zy + hx),
            R::Vec3::new(xz + hy, yz - hx, zz),
        );
        self.mass.xx += o.mass;
        self.mass.yy += o.mass;
        self.mass.zz += o.mass;
    }
}

impl<R: Real> ArticulatedInertia<R> {
    /// Iᴬ m. 66 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn times(&self, m: Motion<R>) -> Force<R> {
        Force::new(
            self.inertia.times(m.ang) + self.coupling * m.lin,
            self.coupling.transpose_mul(m.ang) + self.mass.times(m.lin),
        )
    }

    /// U = Iᴬ s, for a column of S.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn along(&self, s: &MotionSubspace<R>) -> Force<R> {
        let [x, y, z] = self.coupling.cols();
        match s {
            MotionSubspace::RevoluteZ => {
                let row_z = R::Vec3::new(x.array()[2], y.array()[2], z.array()[2]);
                Force::new(self.inertia.column_z(), row_z)
            }
            MotionSubspace::PrismaticZ => Force::new(z, self.mass.column_z()),
            MotionSubspace::Unit(k) => self.column(*k),
            MotionSubspace::General(s) => self.times(*s),
        }
    }

    /// Column k of Iᴬ as a 6 × 6 matrix.
    #[cfg_attr(optimised, inline(always))]
    fn column(&self, k: usize) -> Force<R> {
        let [hx, hy, hz] = self.coupling.cols();
        let row = |i: usize| {
            let of = [hx, hy, hz].map(|column| entry(&column.array(), i));
            R::Vec3::new(of[0], of[1], of[2])
        };
        let ([ix, iy, iz], [mx, my, mz]) = (self.inertia.columns(), self.mass.columns());
        match k {
            0 => Force::new(ix, row(0)),
            1 => Force::new(iy, row(1)),
            2 => Force::new(iz, row(2)),
            3 => Force::new(hx, mx),
            4 => Force::new(hy, my),
            _ => Force::new(hz, mz),
        }
    }

    /// Iᴬ − U Uᵀ / D: what remains when the joint is free. RBDA (7.43). 48 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn minus_outer(&self, u: Force<R>, d_inv: R) -> Self {
        let (n, f) = (u.ang * d_inv, u.lin * d_inv);
        let [fx, fy, fz] = f.array();
        Self {
            inertia: self.inertia.minus_outer(u.ang, n),
            coupling: self.coupling - R::Mat3::from_cols(u.ang * fx, u.ang * fy, u.ang * fz),
            mass: self.mass.minus_outer(u.lin, f),
        }
    }

    /// Iᴬ − U Uᵀ / D of a joint that turns about z without an inertia of its own, D = Uᵀ s. 35
    /// flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn free_about_z(&self, u: Force<R>, d_inv: R) -> FreeAboutZ<R> {
        let ([ux, uy, _], f) = (u.ang.array(), u.lin * d_inv);
        let (nx, ny) = (ux * d_inv, uy * d_inv);
        let [[hxx, hyx, _], [hxy, hyy, _], [hxz, hyz, _]] = self.coupling.cols().map(Vector::array);
        FreeAboutZ {
            xx: self.inertia.xx - ux * nx,
            xy: self.inertia.xy - ux * ny,
            yy: self.inertia.yy - uy * ny,
            coupling_x: R::Vec3::new(hxx, hxy, hxz) - f * ux,
            coupling_y: R::Vec3::new(hyx, hyy, hyz) - f * uy,
            mass: self.mass.minus_outer(u.lin, f),
        }
    }

    /// Xᵀ Iᴬ X: the same inertia at the parent's frame. RBDA (2.66). 270 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn at_parent(&self, x: &Xform<R>) -> Self {
        Self {
            inertia: self.inertia.turned_back(&x.rot),
            coupling: turned_back::<R>(&self.coupling, &x.rot),
            mass: self.mass.turned_back(&x.rot),
        }
        .at_distance(x.pos)
    }

    /// The same inertia about the point from which its frame's origin is at r: H + r× M, and Ī + r×
    /// Hᵀ − (H + r× M) r×, whose upper triangle is written out. 75 flops.
    #[cfg_attr(optimised, inline(always))]
    fn at_distance(&self, r: R::Vec3) -> Self {
        let (i, h, mass) = (self.inertia, self.coupling, self.mass);
        let [mx, my, mz] = mass.columns().map(|column| r.cross(column));
        let k = h + R::Mat3::from_cols(mx, my, mz);
        let [[_, hyx, hzx], [hxy, hyy, hzy], [hxz, hyz, hzz]] = h.cols().map(Vector::array);
        let [[kxx, kyx, kzx], [kxy, kyy, kzy], [kxz, kyz, _]] = k.cols().map(Vector::array);
        let [rx, ry, rz] = r.array();
        Self {
            inertia: Symmetric {
                xx: i.xx + (ry * (hxz + kxz) - rz * (hxy + kxy)),
                xy: i.xy + ((ry * hyz - rz * hyy) + (rz * kxx - rx * kxz)),
                xz: i.xz + ((ry * hzz - rz * hzy) + (rx * kxy - ry * kxx)),
                yy: i.yy + (rz * (hyx + kyx) - rx * (hyz + kyz)),
                yz: i.yz + ((rz * hzx - rx * hzz) + (rx * kyy - ry * kyx)),
                zz: i.zz + (rx * (hzy + kzy) - ry * (hzx + kzx)),
            },
            coupling: k,
            mass,
        }
    }
}

/// The inertia of an articulated body that turns freely about its z: nothing resists there, so that
/// row and column z of Ī and row z of H are zero and left out.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FreeAboutZ<R: Real> {
    pub(super) xx: R,
    pub(super) xy: R,
    pub(super) yy: R,
    /// Rows x and y of H.
    pub(super) coupling_x: R::Vec3,
    pub(super) coupling_y: R::Vec3,
    pub(super) mass: Symmetric<R>,
}

impl<R: Real> FreeAboutZ<R> {
    /// Iᵃ c for a velocity product c = v × S q̇ of the joint, whose components along z are zero. 35
    /// flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn times_across(&self, c: Motion<R>) -> Force<R> {
        let ([wx, wy, _], [vx, vy, _]) = (c.ang.array(), c.lin.array());
        let ([hxx, hxy, hxz], [hyx, hyy, hyz]) = (self.coupling_x.array(), self.coupling_y.array());
        let m = &self.mass;
        Force::new(
            R::Vec3::new(
                (self.xx * wx + self.xy * wy) + (hxx * vx + hxy * vy),
                (self.xy * wx + self.yy * wy) + (hyx * vx + hyy * vy),
                R::ZERO,
            ),
            R::Vec3::new(
                (hxx * wx + hyx * wy) + (m.xx * vx + m.xy * vy),
                (hxy * wx + hyy * wy) + (m.xy * vx + m.yy * vy),
                (hxz * wx + hyz * wy) + (m.xz * vx + m.yz * vy),
            ),
        )
    }

    /// Xᵀ Iᵃ X: the same inertia at the parent's frame, E's rows x and y alone turning Ī and H. 227
    /// flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn at_parent(&self, x: &Xform<R>) -> ArticulatedInertia<R> {
        let [[xx, yx, _], [xy, yy, _], [xz, yz, _]] = x.rot.cols().map(Vector::array);
        let (ex, ey) = (R::Vec3::new(xx, xy, xz), R::Vec3::new(yx, yy, yz));
        let [px, py, pz] = (ex * self.xx + ey * self.xy).array();
        let [qx, qy, qz] = (ex * self.xy + ey * self.yy).array();
        let (i_xx, i_zz) = (xx * px + yx * qx, xz * pz + yz * qz);
        let along_x = x.rot.transpose_mul(self.coupling_x);
        let along_y = x.rot.transpose_mul(self.coupling_y);
        let [ax, ay, az] = along_x.array();
        let [bx, by, bz] = along_y.array();
        ArticulatedInertia {
            inertia: Symmetric {
                xx: i_xx,
                xy: xx * py + yx * qy,
                xz: xx * pz + yx * qz,
                // E keeps the trace.
                yy: (self.xx + self.yy) - i_xx - i_zz,
                yz: xy * pz + yy * qz,
                zz: i_zz,
            },
            coupling: R::Mat3::from_cols(ex * ax + ey * bx, ex * ay + ey * by, ex * az + ey * bz),
            mass: self.mass.turned_back(&x.rot),
        }
        .at_distance(x.pos)
    }
}
