//! Further columns of a model on trial: what each leaves of the torques.
//!
//! All of them are reduced to the factors R of the joints' rows once, whose columns are then
//! selected; the weights are those of an estimate.

use dynamics_core::effects::Effect;
use dynamics_core::model::RobotModel;
use dynamics_core::state::State;
use nalgebra::{DMatrix, DVector};

use crate::reduced::{Filters, Reduced};
use crate::solved::Solved;
use crate::{BaseModel, Fit, IdentificationError, TickRecording};

/// The deviation of a further column's torque before the recording is known, of the joint's torque.
const FURTHER: f64 = 0.5;

/// The factor of each joint's rows, and the number of rows.
struct Factors<const V: usize> {
    factors: [DMatrix<f64>; V],
    count: usize,
}

impl<const V: usize> Factors<V> {
    fn of(reduced: &Reduced<V>) -> Option<Self> {
        let count = reduced.times.len();
        let factor =
            |all: &Vec<f64>| DMatrix::from_row_slice(count, all.len() / count, all).qr().r();
        (count > 0).then(|| Self { factors: reduced.rows.each_ref().map(factor), count })
    }

    /// The first p columns of all joints, with one more for each joint, and one as the torques.
    fn selected(
        &self,
        p: usize,
        further: Option<usize>,
        right: usize,
    ) -> (DMatrix<f64>, DVector<f64>) {
        let (each, extra) = (self.factors[0].nrows(), if further.is_some() { V } else { 0 });
        let mut rows = DMatrix::zeros(V * each, p + extra);
        let mut torques = DVector::zeros(V * each);
        for (j, factor) in self.factors.iter().enumerate() {
            rows.view_mut((j * each, 0), (each, p)).copy_from(&factor.columns(0, p));
            if let Some(further) = further {
                rows.view_mut((j * each, p + j), (each, 1)).copy_from(&factor.column(further));
            }
            torques.rows_mut(j * each, each).copy_from(&factor.column(right));
        }
        (rows, torques)
    }

    /// The root mean squares of what an estimate leaves.
    fn left(
        &self,
        (rows, torques): &(DMatrix<f64>, DVector<f64>),
        estimate: &DVector<f64>,
    ) -> [f64; V] {
        let (left, each) = (torques - rows * estimate, self.factors[0].nrows());
        std::array::from_fn(|j| left.rows(j * each, each).norm() / (self.count as f64).sqrt())
    }
}

/// The estimate of rows with the noise of joints, and a prior of nominal values with deviations.
fn estimate(
    (rows, torques): &(DMatrix<f64>, DVector<f64>),
    noise: &[f64],
    prior: &[(f64, f64)],
) -> DVector<f64> {
    let (n, p, each) = (rows.nrows(), rows.ncols(), rows.nrows() / noise.len());
    let mut all = rows.clone().resize_vertically(n + p, 0.0);
    let mut right = DMatrix::zeros(n + p, 1);
    right.view_mut((0, 0), (n, 1)).copy_from(torques);
    for (i, (nominal, _)) in prior.iter().enumerate() {
        all[(n + i, i)] = 1.0;
        right[(n + i, 0)] = *nominal;
    }
    Solved::of(&all, &right, |at| match noise.get(at / each) {
        Some(noise) if at < n => noise * noise,
        _ => prior[at - n].1.powi(2),
    })
    .estimate
}

impl Fit {
    /// What is left of the torques of the second recording by an estimate from the first one: of
    /// the model alone, and of the model with each further column of a joint, N·m or N, RMS.
    pub(crate) fn further<D, E, const B: usize, const V: usize>(
        &self,
        arm: &BaseModel<D, E, B, V>,
        recordings: [&TickRecording<V>; 2],
        noise: &[f64; V],
        prior: &[(f64, f64)],
        columns: impl Fn(usize, &State<f64, V, V>, &[f64]) -> Vec<f64>,
    ) -> Result<Vec<[f64; V]>, IdentificationError>
    where
        D: RobotModel<f64, B, V, V>,
        E: Effect<f64, B, V>,
    {
        let filters = Filters::new(self.cutoff, self.delay, recordings[0].tick())?;
        let factors = |recording: &TickRecording<V>| {
            let reduced = filters.reduce(recording, |state, _| {
                let mut rows = arm.rows(state);
                for (j, row) in rows.iter_mut().enumerate() {
                    row.extend(columns(j, state, row));
                }
                rows
            });
            Factors::of(&reduced).ok_or_else(|| self.too_short(recording))
        };
        let (fitted, held) = (factors(recordings[0])?, factors(recordings[1])?);
        let p = prior.len();
        let right = fitted.factors[0].ncols() - 1;
        let with = |further: Option<usize>| {
            let own = arm.limits.torque.iter().map(|torque| (0.0, FURTHER * torque));
            let prior: Vec<_> = prior.iter().copied().chain(own).collect();
            let prior = &prior[..p + if further.is_some() { V } else { 0 }];
            let found = estimate(&fitted.selected(p, further, right), noise, prior);
            held.left(&held.selected(p, further, right), &found)
        };
        Ok(std::iter::once(None).chain((p..right).map(Some)).map(with).collect())
    }
}
