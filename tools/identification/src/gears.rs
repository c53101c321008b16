//! The friction of gears per transmitted torque, as columns beside those of the base parameters.

use dynamics_core::effects::smooth_sign;
use dynamics_core::state::State;

use crate::ticks::Stretch;

/// A stretch starts in the direction in which the joint first moves by this much, rad or m.
const STARTS: f64 = 1e-3;
/// The least share of a motor's torque that is not friction, while the estimate is on its way.
const TRANSMITTED: f64 = 0.1;
/// The most by which ln h changes in a pass, and the values between which h stays, rad or m: at one
/// of them, the recording does not determine it.
const STEP: f64 = 0.7;
pub(crate) const DEFLECTIONS: [f64; 2] = [1e-5, 1.0];
/// The values of h from which the search starts, rad or m.
const SCAN: [f64; 7] = [1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 1e-1];

/// The friction of the gear of each joint.
///
/// ```
/// use identification::Gears;
/// let [found, deviation] = [[0.2, 0.05, 2e-3], [0.01, 0.01, 5e-4]].map(|of| Gears::Presliding([of]));
/// assert_eq!(found.joint(0)[2] + deviation.joint(0)[2], 2.5e-3);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gears<const V: usize> {
    /// μ₁ and μ₂ of [`LoadFriction`](dynamics_core::effects::LoadFriction).
    Load([[f64; 2]; V]),
    /// μₐ, μ_d and h, rad or m, of
    /// [`PreslidingLoadFriction`](dynamics_core::effects::PreslidingLoadFriction). In a nominal
    /// model h is not used: a scan finds its start.
    Presliding([[f64; 3]; V]),
}

impl<const V: usize> Gears<V> {
    /// The numbers of a joint.
    #[must_use]
    pub fn joint(&self, joint: usize) -> &[f64] {
        match self {
            Self::Load(mu) => &mu[joint],
            Self::Presliding(all) => &all[joint],
        }
    }

    /// The same kind with other numbers of each joint.
    #[must_use]
    pub fn map(&self, mut to: impl FnMut(usize, usize) -> f64) -> Self {
        match self {
            Self::Load(_) => Self::Load(std::array::from_fn(|j| std::array::from_fn(|k| to(j, k)))),
            Self::Presliding(_) => {
                Self::Presliding(std::array::from_fn(|j| std::array::from_fn(|k| to(j, k))))
            }
        }
    }

    /// Columns of a joint.
    pub(crate) fn each(&self) -> usize {
        self.joint(0).len()
    }

    /// The numbers of an estimate. That of h is the change of its logarithm.
    pub(crate) fn stepped(&self, from: &[f64]) -> Self {
        let each = self.each();
        self.map(|j, k| match (k, from[each * j + k]) {
            (2, change) => {
                let [least, most] = DEFLECTIONS;
                (self.joint(j)[2] * change.clamp(-STEP, STEP).exp()).clamp(least, most)
            }
            (_, mu) => mu,
        })
    }

    /// The same with each h of the scan in all joints; without h, none.
    pub(crate) fn scan(&self) -> Vec<Self> {
        let at = |h: f64| self.map(|j, k| if k == 2 { h } else { self.joint(j)[k] });
        match self {
            Self::Load(_) => Vec::new(),
            Self::Presliding(_) => SCAN.into_iter().map(at).collect(),
        }
    }
}

/// The gears along a motion.
pub(crate) struct Moving<const V: usize> {
    gears: Gears<V>,
    width: f64,
    last: [f64; V],
    /// z and its slope with ln h.
    directions: [[f64; 2]; V],
}

impl<const V: usize> Moving<V> {
    pub fn new(gears: Gears<V>, width: f64) -> Self {
        Self { gears, width, last: [0.0; V], directions: [[0.0; 2]; V] }
    }

    /// The directions at the next tick. The law depends on the distance only, and is solved exactly
    /// between two positions.
    pub fn advance(&mut self, state: &State<f64, V, V>, start: Option<&Stretch<V>>) {
        for (j, [z, slope]) in self.directions.iter_mut().enumerate() {
            let Gears::Presliding(all) = &self.gears else { return };
            if let Some(stretch) = start {
                // The direction before is not known: the joint is taken to have gone on, so that
                // only turns show h.
                let moved = stretch.positions.iter().map(|q| q[j] - stretch.positions[0][j]);
                let first = moved.into_iter().find(|moved| moved.abs() > STARTS);
                [*z, *slope] = [first.map_or(0.0, f64::signum), 0.0];
            } else {
                let moved = (state.q[j] - self.last[j]) / all[j][2];
                let (kept, toward) = ((-moved.abs()).exp(), moved.signum());
                *slope = kept * (*slope - (toward - *z) * moved.abs());
                *z = toward - (toward - *z) * kept;
            }
        }
        self.last = state.q;
    }

    /// The motor's torque per torque for all else.
    fn ratio(&self, j: usize, still: f64) -> f64 {
        let [mu, d] = [0, 1].map(|k| self.gears.joint(j)[k]);
        let [z, _] = self.directions[j];
        1.0 / (1.0 - mu * z * still.signum() - d * z * z).max(TRANSMITTED)
    }

    /// The torque of a joint's motor, with the torque for all else.
    pub fn torque(&self, j: usize, qd: f64, still: f64) -> f64 {
        match &self.gears {
            Gears::Load(mu) => {
                let columns = self.load_columns(qd, still);
                still + mu[j][0] * columns[0] + mu[j][1] * columns[1]
            }
            Gears::Presliding(_) => still * self.ratio(j, still),
        }
    }

    /// The joint's columns into its part of a row whose other entries are those of the torque
    /// for all else. Those of [`Gears::Presliding`] are slopes of the motor's torque, and so
    /// become the others: the measured torque in a column would explain itself.
    pub fn fill(&self, j: usize, qd: f64, still: f64, row: &mut [f64], at: usize) {
        let own = self.gears.each() * j + at;
        let Gears::Presliding(all) = &self.gears else {
            row[own..own + 2].copy_from_slice(&self.load_columns(qd, still));
            return;
        };
        let (ratio, [z, slope]) = (self.ratio(j, still), self.directions[j]);
        row.iter_mut().for_each(|y| *y *= ratio);
        let (each, sign) = (ratio * ratio * still, still.signum());
        let by_z = all[j][0] * sign + 2.0 * all[j][1] * z;
        row[own..own + 3].copy_from_slice(&[each * sign * z, each * z * z, each * by_z * slope]);
    }

    /// The friction of a gear per μ₁ and μ₂: s (m |τ| + d s τ) with m, d = (μ₁ ± μ₂) / 2.
    fn load_columns(&self, qd: f64, torque: f64) -> [f64; 2] {
        let sign = smooth_sign(qd / self.width);
        let (even, odd) = (0.5 * sign * torque.abs(), 0.5 * sign * sign * torque);
        [even + odd, even - odd]
    }
}
