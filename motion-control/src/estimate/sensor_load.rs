//! The load of a force sensor and its offset, from poses at rest, by least squares.
//!
//! At rest in the pose in which gravity is g in the sensor's frame, a sensor measures the wrench
//! that holds its load of mass m and first moment h, and its own offset:
//!
//! ```text
//! f = f₀ − m g      n = n₀ − h × g
//! ```
//!
//! Both are linear in these ten numbers, and their normal equations part into one for m and three
//! for h over the deviations from the means, g̃ = g − ḡ:
//!
//! ```text
//! m Σ g̃ᵀ g̃ = −Σ g̃ᵀ f      Σ (g̃ᵀ g̃ 1 − g̃ g̃ᵀ) h = −Σ g̃ × n
//! ```
//!
//! If the axes of the sensor are not those of gravity, f̃ = B g̃ with another matrix B than −m 1:
//! its nine numbers explain more of the forces than m does, by an F test of both least squares.

use dynamics_core::algorithms::shifted_solution;
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::spatial::{Force, SpatialInertia};

#[cfg(test)]
mod tests;

/// The least share of Σ gᵀ g that deviations across the line of the largest ones have.
const TURNED: f64 = 1e-3;
/// The share of the forces' squares that may show a wrong sign or other axes without an error: of
/// axes that are turned by 7°.
const SHARE: f64 = 0.01;
/// The ratio of variances (F) beyond which that share is no noise.
const RATIO: f64 = 50.0;
/// The share of the forces' deviations in all of them below which f32 does not tell them.
const ROUNDING: f64 = 1e-5;

/// The load of a force sensor and its offset: ten numbers.
///
/// ```
/// use motion_control::estimate::SensorLoad;
/// use dynamics_core::{glam::DVec3, spatial::Force};
/// // A tool of 1.2 kg, its centre 80 mm before the sensor, which shows 3 N too much along x.
/// let load = SensorLoad::<f64> { mass: 1.2, first_moment: DVec3::new(0.0, 0.0, 0.096), offset: Force::new(DVec3::ZERO, DVec3::X * 3.0) };
/// let hanging = load.at_rest(DVec3::new(0.0, 0.0, 9.81));
/// assert!((hanging.lin.z + 1.2 * 9.81).abs() < 1e-12 && hanging.lin.x == 3.0);
/// ```
#[doc(alias = "payload compensation")]
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorLoad<R: Real> {
    /// The mass m beyond the sensor, kg.
    pub mass: R,
    /// Its first moment h = m c about the sensor's origin, in the sensor's frame, kg·m.
    pub first_moment: R::Vec3,
    /// The wrench that the sensor shows without a load, N·m and N.
    pub offset: Force<R>,
}

impl<R: Real> SensorLoad<R> {
    /// The wrench that the sensor shows at rest, N·m and N, where gravity (the acceleration of free
    /// fall, m/s²) is `gravity` in the sensor's frame: a contact's wrench is the measured one less
    /// this.
    ///
    /// # Cost
    /// 24 flops.
    #[inline]
    #[must_use]
    pub fn at_rest(&self, gravity: R::Vec3) -> Force<R> {
        let Self { mass, first_moment, offset } = self;
        Force::new(offset.ang - first_moment.cross(gravity), offset.lin - gravity * *mass)
    }

    /// The inertia of the load without its moments of inertia, kg and kg·m: for an arm that moves,
    /// as a [`Payload`](dynamics_core::effects::Payload) of the body beyond the sensor, whose
    /// wrench [`Engine::rnea_and_wrenches`](dynamics_core::Engine::rnea_and_wrenches) predicts.
    #[must_use]
    pub fn inertia(&self) -> SpatialInertia<R> {
        let (mass, first_moment) = (self.mass, self.first_moment);
        SpatialInertia { mass, first_moment, ..SpatialInertia::ZERO }
    }
}

/// The reason why no load follows from the poses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SensorLoadError {
    /// A number of a pose is not finite, or products of finite numbers overflow.
    NotFinite,
    /// Fewer than three poses.
    FewPoses(u32),
    /// From pose to pose gravity changes along one line of the sensor's frame, or hardly.
    OneDirection,
    /// The forces have the other sign: the mass would be negative.
    Sign,
    /// The forces do not follow gravity along the axes that were given. Of a sensor without a load
    /// five poses tell its noise from that.
    Turned,
}

impl core::fmt::Display for SensorLoadError {
    fn fmt(&self, out: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NotFinite => out.write_str("a number of a pose is not finite"),
            Self::FewPoses(poses) => write!(out, "{poses} poses are fewer than three"),
            Self::OneDirection => out
                .write_str("gravity hardly changes in the frame of the sensor, or along one line"),
            Self::Sign => out.write_str(
                "the mass would be negative: the sensor shows what the load exerts on it, or \
                 gravity has the other sign",
            ),
            Self::Turned => out.write_str(
                "the forces do not follow gravity: the axes of the sensor are not those in which \
                 gravity is given",
            ),
        }
    }
}

impl core::error::Error for SensorLoadError {}

/// The sums over poses at rest from which a [`SensorLoad`] follows, on the target or on the host.
///
/// Twelve poses whose gravity points in all directions of the sensor, each the mean of 64 readings,
/// give mass and centre of a load of 1.2 kg within a per cent with the noise of a Robotiq FT 300.
///
/// ```
/// use motion_control::estimate::{SensorLoad, SensorLoadFit};
/// use dynamics_core::{glam::DVec3, spatial::Force};
/// let load = SensorLoad::<f64> { mass: 0.7, first_moment: DVec3::new(0.01, 0.0, 0.04), offset: Force::new(DVec3::Y * 0.1, DVec3::X * 3.0) };
/// let mut fit = SensorLoadFit::new();
/// for gravity in [DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Z].map(|axis| axis * 9.81) {
///     fit.add(gravity, &load.at_rest(gravity)); // the sensor's reading, in an application
/// }
/// let found = fit.load()?;
/// assert!((found.mass - 0.7).abs() < 1e-12 && (found.offset.lin.x - 3.0).abs() < 1e-12);
/// # Ok::<(), motion_control::estimate::SensorLoadError>(())
/// ```
#[doc(alias = "sensor calibration")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorLoadFit<R: Real> {
    poses: u32,
    gravity: R::Vec3,
    wrench: Force<R>,
    /// Σ gᵀ f, Σ g × n, and Σ g gᵀ by its columns.
    along: R,
    across: R::Vec3,
    squares: [R::Vec3; 3],
    /// Σ f gᵀ by its columns, and Σ nᵀ n and Σ fᵀ f.
    forces: [R::Vec3; 3],
    shown: [R; 2],
}

impl<R: Real> Default for SensorLoadFit<R> {
    fn default() -> Self {
        Self::new()
    }
}

impl<R: Real> SensorLoadFit<R> {
    /// No pose.
    #[must_use]
    pub fn new() -> Self {
        let zero = R::Vec3::ZERO;
        let (along, squares, shown) = (R::ZERO, [zero; 3], [R::ZERO; 2]);
        let (wrench, across, forces) = (Force::ZERO, zero, squares);
        Self { poses: 0, gravity: zero, wrench, along, across, squares, forces, shown }
    }

    /// Adds a pose at rest: gravity in the sensor's frame, m/s², and the wrench that the sensor
    /// shows there, N·m and N, best as a mean over some time.
    ///
    /// # Cost
    /// 74 flops.
    pub fn add(&mut self, gravity: R::Vec3, measured: &Force<R>) {
        self.poses = self.poses.saturating_add(1);
        self.gravity += gravity;
        self.wrench += *measured;
        self.along += gravity.dot(measured.lin);
        self.across += gravity.cross(measured.ang);
        let columns = self.squares.iter_mut().zip(&mut self.forces);
        for ((square, force), x) in columns.zip(gravity.array()) {
            *square += gravity * x;
            *force += measured.lin * x;
        }
        for (sum, x) in self.shown.iter_mut().zip([measured.ang, measured.lin]) {
            *sum += x.dot(x);
        }
    }

    /// The load and the offset of the least squares.
    ///
    /// # Errors
    /// [`SensorLoadError`].
    ///
    /// # Source
    /// The normal equations in this module; Kubus, Kröger & Wahl, "On-line rigid object recognition
    /// and pose estimation based on inertial parameters" (2007), at rest.
    pub fn load(&self) -> Result<SensorLoad<R>, SensorLoadError> {
        if self.poses < 3 {
            return Err(SensorLoadError::FewPoses(self.poses));
        }
        let share = R::ONE / R::from_f64(f64::from(self.poses));
        let (g, f, n) = (self.gravity * share, self.wrench.lin * share, self.wrench.ang * share);
        // The sums over deviations from the means.
        let poses = R::from_f64(f64::from(self.poses));
        let along = self.along - poses * g.dot(f);
        let [x, y, z] = (self.across - g.cross(n) * poses).array();
        let mean = g.array();
        let less = |columns: &[R::Vec3; 3], of: R::Vec3| {
            core::array::from_fn(|k| (columns[k] - of * (poses * mean[k])).array())
        };
        let [xx, yy, zz]: [[R; 3]; 3] = less(&self.squares, g);
        let by_columns: [[R; 3]; 3] = less(&self.forces, f);
        let trace = xx[0] + yy[1] + zz[2];
        let whole = trace + poses * g.dot(g);
        let forces = self.shown[1] - poses * f.dot(f);
        if !(whole + along + forces + self.shown[0] + x + y + z).is_finite() {
            return Err(SensorLoadError::NotFinite);
        }
        let a = [
            [trace - xx[0], -yy[0], -zz[0]],
            [-xx[1], trace - yy[1], -zz[1]],
            [-xx[2], -yy[2], trace - zz[2]],
        ];
        // Its least eigenvalue, the sum of the two lesser ones of Σ g̃ g̃ᵀ, is at least this
        // determinant over the square of the trace.
        let rows = a.map(|[x, y, z]| R::Vec3::new(x, y, z));
        let determinant = rows[0].dot(rows[1].cross(rows[2]));
        let turns = determinant > R::from_f64(TURNED) * whole * trace * trace;
        if !turns {
            return Err(SensorLoadError::OneDirection);
        }
        let [hx, hy, hz] = shifted_solution(a, [R::ZERO; 3], [-x, -y, -z]);
        let (mass, h) = (-along / trace, R::Vec3::new(hx, hy, hz));
        let offset = Force::new(n + h.cross(g), f + g * mass);

        // The squares of the forces' deviations: all, of m, and of B.
        let of_mass = -along * mass;
        let shift = [trace * R::from_f64(ROUNDING); 3];
        let of_all = (0..3).fold(R::ZERO, |sum, k| {
            let row = by_columns.map(|column| column[k]);
            let solved = shifted_solution([xx, yy, zz], shift, row);
            row.iter().zip(solved).fold(sum, |sum, (a, b)| sum + *a * b)
        });
        let freedom = R::from_f64((3.0 * f64::from(self.poses) - 12.0).max(1.0));
        let noise = (forces - of_all) / freedom * R::from_f64(RATIO);
        let least = forces * R::from_f64(SHARE);
        let is_told = forces > self.shown[1] * R::from_f64(ROUNDING);
        let is_seen =
            |part: R, numbers: f64| is_told && part > least && part > noise * R::from_f64(numbers);
        if is_seen(of_all - of_mass, 8.0) {
            return Err(SensorLoadError::Turned);
        }
        if mass < R::ZERO && is_seen(of_mass, 1.0) {
            return Err(SensorLoadError::Sign);
        }
        Ok(SensorLoad { mass, first_moment: h, offset })
    }

    /// The root mean squares of the couple, N·m, and the force, N, over the poses, of what the
    /// sensor showed less what it shows of a load: near its noise if the load is right. In f32
    /// rounding is some hundredths of a per cent of what it showed.
    #[must_use]
    pub fn residual(&self, load: &SensorLoad<R>) -> [R; 2] {
        let SensorLoad { mass: m, first_moment: h, offset: Force { ang: n0, lin: f0, .. } } = *load;
        let poses = R::from_f64(f64::from(self.poses));
        let [hx, hy, hz] = h.array();
        let [x, y, z] = self.squares;
        let [[xx, ..], [_, yy, _], [.., zz]] = self.squares.map(R::Vec3::array);
        let across = h.dot(h) * (xx + yy + zz) - h.dot(x * hx + y * hy + z * hz);
        let couple = h.dot(self.across) - n0.dot(self.wrench.ang + h.cross(self.gravity));
        let force = self.along * m - f0.dot(self.wrench.lin + self.gravity * m);
        let [nn, ff] = self.shown;
        let squares = [
            nn + across + poses * n0.dot(n0) + (couple + couple),
            ff + (xx + yy + zz) * (m * m) + poses * f0.dot(f0) + (force + force),
        ];
        squares.map(|sum| if sum > R::ZERO { Real::sqrt(sum / poses) } else { R::ZERO })
    }
}
