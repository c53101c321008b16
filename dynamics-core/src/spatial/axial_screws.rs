//! The transform across a link as two screws about coordinate axes, whose turns mix two components
//! of a vector each.
//!
//! Denavit & Hartenberg's parameters as Craig, *Introduction to Robotics* (1989), numbers them: a
//! turn about the parent's x by α and a shift along it by a, then a turn about the joint's z by q
//! and a shift along it by d. McMillan & Orin, *Efficient computation of articulated-body inertias
//! using successive axial screws* (1995).

use core::ops::Mul;

use super::inertia::{ArticulatedInertia, CompositeInertia, FreeAboutZ};
use super::symmetric::Symmetric;
use super::{Force, Motion};
use crate::scalar::{Matrix, Real, Vector};

/// A turn about a coordinate axis and a shift along it, rad and m.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Screw<R> {
    pub(crate) sin: R,
    pub(crate) cos: R,
    pub(crate) shift: R,
}

/// ⁱX_λ(i): a screw about x, then one about z.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AxialScrews<R> {
    pub(crate) about_x: Screw<R>,
    pub(crate) about_z: Screw<R>,
}

impl<R: Real> Screw<R> {
    /// The components across the axis of a vector, in the turned frame. 6 flops.
    #[cfg_attr(optimised, inline(always))]
    fn turn(&self, [a, b]: [R; 2]) -> [R; 2] {
        [self.cos * a + self.sin * b, self.cos * b - self.sin * a]
    }

    /// The same back. 6 flops.
    #[cfg_attr(optimised, inline(always))]
    fn turn_back(&self, [a, b]: [R; 2]) -> [R; 2] {
        [self.cos * a - self.sin * b, self.sin * a + self.cos * b]
    }

    /// The block across the axis of a matrix, turned back. 24 flops, of a symmetric block 21; by
    /// its trace, which stays as it is, 11 and 10 would do, with roundings of the larger entry in
    /// the smaller.
    #[cfg_attr(optimised, inline(always))]
    fn block_back(&self, [x, y]: [[R; 2]; 2]) -> [[R; 2]; 2] {
        let ([xx, xy], [yx, yy]) = (self.turn_back(x), self.turn_back(y));
        let ([xx, yx], [xy, yy]) = (self.turn_back([xx, yx]), self.turn_back([xy, yy]));
        [[xx, xy], [yx, yy]]
    }
}

/// X m. 32 flops.
impl<R: Real> Mul<Motion<R>> for AxialScrews<R> {
    type Output = Motion<R>;
    #[cfg_attr(optimised, inline(always))]
    fn mul(self, m: Motion<R>) -> Motion<R> {
        let (x, z) = (&self.about_x, &self.about_z);
        let ([wx, wy, wz], [vx, vy, vz]) = (m.ang.array(), m.lin.array());
        let [vy, vz] = x.turn([vy + x.shift * wz, vz - x.shift * wy]);
        let [wy, wz] = x.turn([wy, wz]);
        let [vx, vy] = z.turn([vx + z.shift * wy, vy - z.shift * wx]);
        let [wx, wy] = z.turn([wx, wy]);
        Motion::new(R::Vec3::new(wx, wy, wz), R::Vec3::new(vx, vy, vz))
    }
}

impl<R: Real> AxialScrews<R> {
    /// A bound of the distance between the two origins.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn distance(&self) -> R {
        self.about_x.shift.abs() + self.about_z.shift.abs()
    }

    /// Xᵀ f. 32 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn transpose_mul(&self, f: Force<R>) -> Force<R> {
        let (x, z) = (&self.about_x, &self.about_z);
        let ([nx, ny, nz], [fx, fy, fz]) = (f.ang.array(), f.lin.array());
        let [fx, fy] = z.turn_back([fx, fy]);
        let [nx, ny] = z.turn_back([nx, ny]);
        let (nx, ny) = (nx - z.shift * fy, ny + z.shift * fx);
        let [fy, fz] = x.turn_back([fy, fz]);
        let [ny, nz] = x.turn_back([ny, nz]);
        let (ny, nz) = (ny - x.shift * fz, nz + x.shift * fy);
        Force::new(R::Vec3::new(nx, ny, nz), R::Vec3::new(fx, fy, fz))
    }

    /// Xᵀ Iᶜ X. 64 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn composite_at_parent(&self, ic: &CompositeInertia<R>) -> CompositeInertia<R> {
        let ic = self.about_z.composite_back_about_z(ic).renamed();
        self.about_x.composite_back_about_z(&ic).renamed().renamed()
    }

    /// Xᵀ Iᵃ X. 230 flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn articulated_at_parent(
        &self,
        ia: &ArticulatedInertia<R>,
    ) -> ArticulatedInertia<R> {
        let ia = self.about_z.articulated_back_about_z(ia).renamed();
        self.about_x.articulated_back_about_z(&ia).renamed().renamed()
    }

    /// The same where nothing resists a turn about z, nor does in the frame between the screws. 174
    /// flops.
    #[cfg_attr(optimised, inline(always))]
    pub(crate) fn free_at_parent(&self, ia: &FreeAboutZ<R>) -> ArticulatedInertia<R> {
        self.about_x.free_back_about_x(&self.about_z.free_back_about_z(ia))
    }
}

impl<R: Real> Screw<R> {
    /// The inertia of a body that turns freely about z, before the screw about z. 99 flops.
    #[cfg_attr(optimised, inline(always))]
    fn free_back_about_z(&self, ia: &FreeAboutZ<R>) -> FreeAboutZ<R> {
        let mass = self.symmetric_back(&ia.mass);
        let ([hxx, hxy, hxz], [hyx, hyy, hyz]) = (ia.coupling_x.array(), ia.coupling_y.array());
        let [[hxx, hxy], [hyx, hyy]] = self.block_back([[hxx, hxy], [hyx, hyy]]);
        let [hxz, hyz] = self.turn_back([hxz, hyz]);
        let [[xx, xy], [_, yy]] = self.block_back([[ia.xx, ia.xy], [ia.xy, ia.yy]]);
        // H + r× M, and Ī + r× Hᵀ − (H + r× M) r×, along z.
        let r = self.shift;
        let (kxx, kxy, kxz) = (hxx - r * mass.xy, hxy - r * mass.yy, hxz - r * mass.yz);
        let (kyx, kyy, kyz) = (hyx + r * mass.xx, hyy + r * mass.xy, hyz + r * mass.xz);
        FreeAboutZ {
            xx: xx - r * (hxy + kxy),
            xy: xy + r * (kxx - hyy),
            yy: yy + r * (hyx + kyx),
            coupling_x: R::Vec3::new(kxx, kxy, kxz),
            coupling_y: R::Vec3::new(kyx, kyy, kyz),
            mass,
        }
    }

    /// The same before the screw about x, in which rows y and z are shares of what was row y. 75
    /// flops.
    #[cfg_attr(optimised, inline(always))]
    fn free_back_about_x(&self, ia: &FreeAboutZ<R>) -> ArticulatedInertia<R> {
        let (s, c) = (self.sin, self.cos);
        let mass = self.symmetric_back(&ia.mass.renamed()).renamed().renamed();
        let ([hxx, hxy, hxz], [hyx, hyy, hyz]) = (ia.coupling_x.array(), ia.coupling_y.array());
        let [hxy, hxz] = self.turn_back([hxy, hxz]);
        let [py, pz] = self.turn_back([hyy, hyz]);
        let [[hyx, hyy, hyz], [hzx, hzy, hzz]] =
            [[hyx, py, pz].map(|h| c * h), [hyx, py, pz].map(|h| s * h)];
        let (cyy, syy) = (c * ia.yy, s * ia.yy);
        // H + r× M, and Ī + r× Hᵀ − (H + r× M) r×, along x.
        let r = self.shift;
        let (kyx, kyy, kyz) = (hyx - r * mass.xz, hyy - r * mass.yz, hyz - r * mass.zz);
        let (kzx, kzy, kzz) = (hzx + r * mass.xy, hzy + r * mass.yy, hzz + r * mass.yz);
        ArticulatedInertia {
            inertia: Symmetric {
                xx: ia.xx,
                xy: c * ia.xy - r * hxz,
                xz: s * ia.xy + r * hxy,
                yy: c * cyy - r * (hyz + kyz),
                yz: c * syy + r * (kyy - hzz),
                zz: s * syy + r * (hzy + kzy),
            },
            coupling: R::Mat3::from_cols(
                R::Vec3::new(hxx, kyx, kzx),
                R::Vec3::new(hxy, kyy, kzy),
                R::Vec3::new(hxz, kyz, kzz),
            ),
            mass,
        }
    }

    /// An articulated inertia before the screw, about z. 115 flops.
    #[cfg_attr(optimised, inline(always))]
    fn articulated_back_about_z(&self, ia: &ArticulatedInertia<R>) -> ArticulatedInertia<R> {
        let (i, mass) = (self.symmetric_back(&ia.inertia), self.symmetric_back(&ia.mass));
        let [[hxx, hyx, hzx], [hxy, hyy, hzy], [hxz, hyz, hzz]] =
            ia.coupling.cols().map(Vector::array);
        let [[hxx, hxy], [hyx, hyy]] = self.block_back([[hxx, hxy], [hyx, hyy]]);
        let ([hxz, hyz], [hzx, hzy]) = (self.turn_back([hxz, hyz]), self.turn_back([hzx, hzy]));
        // H + r× M, and Ī + r× Hᵀ − (H + r× M) r×, along z.
        let r = self.shift;
        let (kxx, kxy, kxz) = (hxx - r * mass.xy, hxy - r * mass.yy, hxz - r * mass.yz);
        let (kyx, kyy, kyz) = (hyx + r * mass.xx, hyy + r * mass.xy, hyz + r * mass.xz);
        ArticulatedInertia {
            inertia: Symmetric {
                xx: i.xx - r * (hxy + kxy),
                xy: i.xy + r * (kxx - hyy),
                xz: i.xz - r * hzy,
                yy: i.yy + r * (hyx + kyx),
                yz: i.yz + r * hzx,
                zz: i.zz,
            },
            coupling: R::Mat3::from_cols(
                R::Vec3::new(kxx, kyx, hzx),
                R::Vec3::new(kxy, kyy, hzy),
                R::Vec3::new(kxz, kyz, hzz),
            ),
            mass,
        }
    }

    /// The inertia of bodies that move as one before the screw, about z. 32 flops.
    #[cfg_attr(optimised, inline(always))]
    fn composite_back_about_z(&self, ic: &CompositeInertia<R>) -> CompositeInertia<R> {
        let i = self.symmetric_back_by_trace(&ic.inertia);
        let [hx, hy, hz] = ic.first_moment.array();
        let [hx, hy] = self.turn_back([hx, hy]);
        // Ī − r× h× − (h + m r)× r×, along z.
        let r = self.shift;
        let kz = hz + r * ic.mass;
        let d = r * (hz + kz);
        CompositeInertia {
            mass: ic.mass,
            first_moment: R::Vec3::new(hx, hy, kz),
            inertia: Symmetric {
                xx: i.xx + d,
                xy: i.xy,
                xz: i.xz - hx * r,
                yy: i.yy + d,
                yz: i.yz - hy * r,
                zz: i.zz,
            },
        }
    }

    /// A symmetric matrix, turned back about z, whose trace across z stays as it is. 16 flops. An
    /// entry gets roundings of the largest one of its block, as it does by general rotations.
    #[cfg_attr(optimised, inline(always))]
    fn symmetric_back_by_trace(&self, m: &Symmetric<R>) -> Symmetric<R> {
        let twice = m.xy + m.xy;
        let w = self.sin * (m.xx - m.yy) + self.cos * twice;
        let moved = self.sin * w;
        let [xz, yz] = self.turn_back([m.xz, m.yz]);
        Symmetric { xx: m.xx - moved, xy: self.cos * w - m.xy, xz, yy: m.yy + moved, yz, zz: m.zz }
    }

    /// A symmetric matrix, turned back about z. 27 flops.
    #[cfg_attr(optimised, inline(always))]
    fn symmetric_back(&self, m: &Symmetric<R>) -> Symmetric<R> {
        let [[xx, xy], [_, yy]] = self.block_back([[m.xx, m.xy], [m.xy, m.yy]]);
        let [xz, yz] = self.turn_back([m.xz, m.yz]);
        let zz = m.zz;
        Symmetric { xx, xy, xz, yy, yz, zz }
    }
}

/// In axes of other names: y is called x, z is called y, and x is called z. Three times is what it
/// was.
trait Renamed {
    fn renamed(&self) -> Self;
}

impl<R: Real> Renamed for Symmetric<R> {
    #[cfg_attr(optimised, inline(always))]
    fn renamed(&self) -> Self {
        Self { xx: self.yy, xy: self.yz, xz: self.xy, yy: self.zz, yz: self.xz, zz: self.xx }
    }
}

impl<R: Real> Renamed for CompositeInertia<R> {
    #[cfg_attr(optimised, inline(always))]
    fn renamed(&self) -> Self {
        let [x, y, z] = self.first_moment.array();
        Self {
            mass: self.mass,
            first_moment: R::Vec3::new(y, z, x),
            inertia: self.inertia.renamed(),
        }
    }
}

impl<R: Real> Renamed for ArticulatedInertia<R> {
    #[cfg_attr(optimised, inline(always))]
    fn renamed(&self) -> Self {
        let [x, y, z] = self.coupling.cols().map(|column| {
            let [x, y, z] = column.array();
            R::Vec3::new(y, z, x)
        });
        Self {
            inertia: self.inertia.renamed(),
            coupling: R::Mat3::from_cols(y, z, x),
            mass: self.mass.renamed(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{AxialScrews, Screw};
    use crate::spatial::inertia::{ArticulatedInertia, CompositeInertia};
    use crate::spatial::symmetric::Symmetric;
    use crate::spatial::{Force, Motion, Xform};
    use glam::{DMat3, DVec3};

    const ALPHA: f64 = 0.7;
    const Q: f64 = -2.1;

    fn screw(angle: f64, shift: f64) -> Screw<f64> {
        let (sin, cos) = angle.sin_cos();
        Screw { sin, cos, shift }
    }

    /// The two screws, and the same transform by a matrix and an origin.
    fn both() -> (AxialScrews<f64>, Xform<f64>) {
        let (about_x, about_z) = (screw(ALPHA, 0.3), screw(Q, -0.2));
        let twist = DMat3::from_rotation_x(-ALPHA);
        let x = Xform {
            rot: DMat3::from_rotation_z(-Q) * twist,
            pos: DVec3::X * 0.3 + twist.transpose() * DVec3::Z * -0.2,
        };
        (AxialScrews { about_x, about_z }, x)
    }

    /// Twenty-one numbers without a pattern.
    fn articulated() -> ArticulatedInertia<f64> {
        let symmetric =
            |a: f64| Symmetric { xx: a, xy: 0.2, xz: -0.3 * a, yy: 0.7, yz: 0.1 * a, zz: 1.1 };
        ArticulatedInertia {
            inertia: symmetric(2.0),
            coupling: DMat3::from_cols(
                DVec3::new(0.1, -0.2, 0.3),
                DVec3::new(0.4, 0.5, -0.6),
                DVec3::new(0.7, 0.8, 0.9),
            ),
            mass: symmetric(3.0),
        }
    }

    fn forces(ia: &ArticulatedInertia<f64>) -> [Force<f64>; 6] {
        [0, 1, 2, 3, 4, 5].map(|k| {
            let unit = |k| DVec3::new(f64::from(k == 0), f64::from(k == 1), f64::from(k == 2));
            ia.times(Motion::new(unit(k), unit(k - 3)))
        })
    }

    fn differ(a: &ArticulatedInertia<f64>, b: &ArticulatedInertia<f64>) -> f64 {
        let pairs = forces(a).into_iter().zip(forces(b));
        let each = pairs.map(|(a, b)| (a.ang - b.ang).length() + (a.lin - b.lin).length());
        each.fold(0.0, f64::max)
    }

    #[test]
    fn two_screws_take_vectors_as_their_product_does() {
        let (screws, x) = both();
        let (a, b) = (DVec3::new(1.0, -2.0, 0.5), DVec3::new(0.3, 0.7, -1.1));
        let (got, want) = (screws * Motion::new(a, b), x * Motion::new(a, b));
        assert!((got.ang - want.ang).length() + (got.lin - want.lin).length() < 1e-15);
        let f = Force::new(a, b);
        let (got, want) = (screws.transpose_mul(f), x.transpose_mul(f));
        assert!((got.ang - want.ang).length() + (got.lin - want.lin).length() < 1e-15);
        assert!(screws.distance() >= x.pos.length());
    }

    #[test]
    fn two_screws_take_inertias_as_their_product_does() {
        let (screws, x) = both();
        let ia = articulated();
        let error = differ(&screws.articulated_at_parent(&ia), &ia.at_parent(&x));
        assert!(error < 5e-15, "{error}");
        let u = Force::new(ia.inertia.column_z(), DVec3::new(0.3, -0.6, 0.9));
        let free = ia.free_about_z(u, 1.0 / 1.1);
        let error = differ(&screws.free_at_parent(&free), &free.at_parent(&x));
        assert!(error < 5e-15, "{error}");
        let ic = CompositeInertia {
            mass: 3.0,
            first_moment: DVec3::new(0.4, -0.5, 0.6),
            inertia: ia.inertia,
        };
        let pairs = [screws.composite_at_parent(&ic), ic.at_parent(&x)].map(|i| i.parameters());
        let pairs = pairs[0].iter().zip(pairs[1]);
        let error = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(error < 5e-15, "{error}");
    }
}
