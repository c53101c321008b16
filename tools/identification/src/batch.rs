//! Weighted least squares of a recording.
//!
//! Both sides of τ(t) = Y(q, q̇, q̈) β are projected on the same harmonics 0 to H of the
//! excitation: q, q̇ and q̈ are those of the series of H harmonics that is nearest to the
//! positions, τ and the columns of Y are projected on an orthonormal base of these harmonics.
//! Faster motion, which the positions lack, is in neither. This is the parallel filter of Gautier,
//! "Dynamic identification of robots with power model" (1997), with a filter that has neither delay
//! nor transients as the motion is periodic.

use std::f64::consts::TAU;

use dynamics_core::effects::Effect;
use dynamics_core::model::RobotModel;
use nalgebra::DMatrix;

use crate::noise::Noise;
use crate::solved::Solved;
use crate::{BaseModel, FourierMotion, IdentificationError, Identified, Recording};

/// Passes over the weights at most; some ten are enough.
const PASSES: usize = 30;
/// Noise that changes by less than this share is final.
const FINAL: f64 = 1e-4;
/// The evaluation of a recording.
///
/// # Example
/// An identification of the pendulum's friction, offset and inertias is in the documentation of
/// [the crate](crate).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Batch {
    /// The highest harmonic of the period that is used, H: enough for the reversals of friction,
    /// some 20 Hz.
    pub harmonics: usize,
    /// The time by which a torque is later than the position of the same sample, s: half a tick for
    /// a torque that was commanded at the sample and is held for a tick.
    pub delay: f64,
    /// The greatest condition number at which all parameters are determined:
    /// [`BaseModel::condition`] with the estimated noise.
    pub most: f64,
}

impl Batch {
    /// Half a tick of delay and condition numbers up to 10⁴.
    ///
    /// ```
    /// use identification::Batch;
    /// assert_eq!(Batch::new(25, 2e-3).delay, 1e-3);
    /// ```
    #[must_use]
    pub fn new(harmonics: usize, tick: f64) -> Self {
        Self { harmonics, delay: 0.5 * tick, most: 1e4 }
    }

    /// The base parameters of an arm with their covariance, by least squares with the weights 1/σ
    /// of the noise of each joint.
    ///
    /// σ² = s₀ + s₁ (h/H)⁴ in harmonic h is that of torques and of accelerations from noisy
    /// positions. Both are estimated of each joint from the residuals, and iterated with the
    /// weights. The covariance is that of these weights under the mean squares of the residuals of
    /// each harmonic and ten on either side: noise may have any colour, but for what changes within
    /// some 4 Hz.
    ///
    /// # Errors
    /// [`IdentificationError::RankDeficient`] names the parameters that the motion does not show,
    /// [`IdentificationError::Harmonics`] those that are possible.
    ///
    /// # Source
    /// Swevers et al. (1997), section III; Gautier & Poignet, "Extended Kalman filtering and
    /// weighted least squares dynamic identification of robot" (2001), section 3; the covariance
    /// after White, "A heteroskedasticity-consistent covariance matrix estimator" (1980), with mean
    /// squares of bands in place of those of single rows.
    pub fn identify<D, E, const B: usize, const V: usize>(
        &self,
        arm: &BaseModel<D, E, B, V>,
        recording: &Recording<V>,
    ) -> Result<Identified<V>, IdentificationError>
    where
        D: RobotModel<f64, B, V, V>,
        E: Effect<f64, B, V>,
    {
        let (samples, harmonics) = (recording.positions.len(), self.harmonics);
        let (least, most) = (arm.len().div_ceil(2), samples.saturating_sub(1) / 2);
        if harmonics < least || harmonics > most {
            return Err(IdentificationError::Harmonics { harmonics, least, most });
        }
        let motion = FourierMotion::fit(&recording.positions, recording.period(), harmonics);
        let [rows, torques] = self.projected(arm, recording, &motion);
        let mut noise = Noise::first(&arm.limits.torque, harmonics);
        let mut solved = Solved::of(&rows, &torques, |at| noise.square(at));
        for _ in 0..PASSES {
            solved.check(arm, self.most)?;
            let change = noise.update(&solved, &arm.limits.torque);
            solved = Solved::of(&rows, &torques, |at| noise.square(at));
            if change < FINAL {
                break;
            }
        }
        let condition = solved.check(arm, self.most)?;
        let bands = noise.bands(&solved);
        let root = solved.deviations(&bands);
        let of_sample = |square: f64| (square * recording.periods() as f64).sqrt();
        let of = |h: usize, j: usize| {
            let at = j * (2 * harmonics + 1) + 2 * h;
            of_sample(noise.square(at) * bands[at])
        };
        Ok(Identified {
            base: solved.estimate.iter().copied().collect(),
            deviations: root.column_iter().map(|column| column.norm()).collect(),
            noise: (0..=harmonics).map(|h| std::array::from_fn(|j| of(h, j))).collect(),
            condition,
            motion,
            root,
        })
    }

    /// The regressor and the torques, joint by joint, projected on harmonics.
    fn projected<D, E, const B: usize, const V: usize>(
        &self,
        arm: &BaseModel<D, E, B, V>,
        recording: &Recording<V>,
        motion: &FourierMotion<V>,
    ) -> [DMatrix<f64>; 2]
    where
        D: RobotModel<f64, B, V, V>,
        E: Effect<f64, B, V>,
    {
        let (samples, each) = (recording.positions.len(), 2 * self.harmonics + 1);
        let harmonics = orthonormal(samples, self.harmonics);
        let mut all = vec![DMatrix::zeros(samples, arm.len() + 1); V];
        for (k, measured) in recording.torques.iter().enumerate() {
            let state = motion.at(recording.time(k) + self.delay);
            for ((all, row), tau) in all.iter_mut().zip(arm.rows(&state)).zip(measured) {
                for (i, y) in row.into_iter().chain([*tau]).enumerate() {
                    all[(k, i)] = y;
                }
            }
        }
        let mut rows = DMatrix::zeros(V * each, arm.len() + 1);
        for (j, all) in all.iter().enumerate() {
            rows.rows_mut(j * each, each).copy_from(&(&harmonics * all));
        }
        let torques = rows.columns(arm.len(), 1).into_owned();
        [rows.remove_column(arm.len()), torques]
    }
}

/// The orthonormal base of harmonics 0 to H of a period of n samples, in rows.
fn orthonormal(n: usize, harmonics: usize) -> DMatrix<f64> {
    DMatrix::from_fn(2 * harmonics + 1, n, |row, k| {
        let h = row.div_ceil(2);
        let angle = TAU * ((h * k) % n) as f64 / n as f64;
        let amplitude = (2.0 / n as f64).sqrt();
        match row {
            0 => (1.0 / n as f64).sqrt(),
            row if row % 2 == 1 => amplitude * angle.sin(),
            _ => amplitude * angle.cos(),
        }
    })
}
