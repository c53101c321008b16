//! A ship in a seaway.

use dynamics_core::effects::{GravityVector, MovingBase};
use dynamics_core::scalar::{Real, Vector};

/// An oscillation a cos ω t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swing<R> {
    /// Amplitude, rad or m.
    pub amplitude: R,
    /// Angular frequency, rad/s.
    pub omega: R,
}

impl<R: Real> Swing<R> {
    /// A swing of this amplitude and of a period in seconds.
    pub fn of(amplitude: f64, period: f64) -> Self {
        Self {
            amplitude: R::from_f64(amplitude),
            omega: R::from_f64(core::f64::consts::TAU / period),
        }
    }

    /// Value, rate and acceleration after t seconds.
    #[inline(always)]
    pub fn at(&self, t: R) -> [R; 3] {
        let (sin, cos) = (self.omega * t).sin_cos();
        let (x, rate) = (self.amplitude * cos, self.amplitude * self.omega);
        [x, -(rate * sin), -(rate * self.omega * cos)]
    }
}

/// A ship that yaws, pitches and rolls (by ψ about z, then θ about y, then φ about x: forward, to
/// port, up) and heaves, about the point that all of this leaves at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ship<R: Real> {
    /// φ, rad.
    pub roll: Swing<R>,
    /// θ, rad.
    pub pitch: Swing<R>,
    /// ψ, rad.
    pub yaw: Swing<R>,
    /// Upwards, m.
    pub heave: Swing<R>,
    /// ContactPoint of the gimbal, in the ship, m.
    pub mast: R::Vec3,
}

impl<R: Real> Ship<R> {
    /// A patrol boat of 25 m, hull across the waves: numbers of our own, of the size of real ones.
    pub fn patrol_boat() -> Self {
        Self {
            roll: Swing::of(0.24, 5.2),
            pitch: Swing::of(0.09, 4.1),
            yaw: Swing::of(0.04, 7.3),
            heave: Swing::of(0.8, 4.6),
            mast: R::Vec3::new(R::from_f64(3.0), R::ZERO, R::from_f64(7.0)),
        }
    }

    /// The measurement of the mast's inertial unit after t seconds: gravity and the motion of the
    /// mast's foot, in the ship's coordinates.
    ///
    /// RBDA (2008), (2.42) in its angular part, from axis to axis: ω' = E ω + e q̇, ω̇' = E ω̇ + e
    /// q̈ + E ω × e q̇.
    pub fn measured(&self, t: R) -> (GravityVector<R>, MovingBase<R>) {
        let zero = R::ZERO;
        let (roll, pitch, yaw) = (self.roll.at(t), self.pitch.at(t), self.yaw.at(t));
        let [_, climb, lift] = self.heave.at(t);

        let up = across_x(roll[0], across_y(pitch[0], R::Vec3::new(zero, zero, R::ONE)));
        let about_z = |k: usize| R::Vec3::new(zero, zero, yaw[k]);
        let about_y = |k: usize| R::Vec3::new(zero, pitch[k], zero);
        let about_x = |k: usize| R::Vec3::new(roll[k], zero, zero);
        let (w, a) = (across_y(pitch[0], about_z(1)), across_y(pitch[0], about_z(2)));
        let (w, a) = (w + about_y(1), a + about_y(2) + w.cross(about_y(1)));
        let (w, a) = (across_x(roll[0], w), across_x(roll[0], a));
        let (omega, alpha) = (w + about_x(1), a + about_x(2) + w.cross(about_x(1)));

        let lever = omega.cross(self.mast);
        let velocity = up * climb + lever;
        let acceleration = up * lift + alpha.cross(self.mast) + omega.cross(lever);
        let g = up * R::from_f64(-9.81);
        let base = MovingBase::of_point(omega, alpha, velocity, acceleration);
        (GravityVector(g), base)
    }
}

/// Coordinates in a frame that is turned by q about x.
fn across_x<R: Real>(q: R, v: R::Vec3) -> R::Vec3 {
    let ((s, c), [x, y, z]) = (q.sin_cos(), v.array());
    R::Vec3::new(x, c * y + s * z, c * z - s * y)
}

/// Coordinates in a frame that is turned by q about y.
fn across_y<R: Real>(q: R, v: R::Vec3) -> R::Vec3 {
    let ((s, c), [x, y, z]) = (q.sin_cos(), v.array());
    R::Vec3::new(c * x - s * z, y, c * z + s * x)
}
