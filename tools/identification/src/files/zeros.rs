//! The zeros of a robot's joints by the sensitivities of its torques.
//!
//! A zero that is shifted by δ changes the torques by δ ∂τ/∂q_j, of which the estimate takes what
//! other parameters explain. Least squares of the torques that it leaves, in the base parameters
//! and in δ, is a step of Gauss and Newton.

use dynamics_core::algorithms::rnea_derivatives;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::spatial::SpatialInertia;

use crate::fit::Equations;
use crate::reduced::Filters;
use crate::{IdentificationError, TickRecording};

use super::attempt::{Attempt, Estimate};

/// The standard deviation of a zero before the recording is known, rad or m, and of one that is
/// not looked for.
const SHIFTED: f64 = 0.3;
const KNOWN: f64 = 1e-9;

impl<const V: usize> Attempt<V> {
    /// By how much the positions are too small, rad or m, and the joint whose zero alone is
    /// shifted, or none if those of all may be: of these choices the one that leaves the least.
    pub fn shifts(
        &self,
        part: &TickRecording<V>,
        among: &[Option<usize>],
    ) -> Result<(Option<usize>, [f64; V]), IdentificationError> {
        let Estimate { arm, fit, found, .. } = &self.estimate;
        let (p, mut model) = (arm.len(), arm.robot);
        for (link, phi) in model.links.iter_mut().zip(self.set.bodies) {
            let (frame, own) = (link.to_joint_frame, SpatialInertia::from_parameters(phi));
            link.inertia = SpatialInertia {
                first_moment: frame * own.first_moment,
                rotational: frame * own.rotational * frame.transpose(),
                ..own
            };
        }
        let filters = Filters::new(fit.cutoff, fit.delay, part.tick())?;
        let mut reduced = filters.reduce(part, |state, _| {
            let mut rows = arm.rows(state);
            let gradient = rnea_derivatives(&model, state, &RIGID_BODY);
            rows.iter_mut().zip(gradient.dq).for_each(|(row, by)| row.extend(by));
            rows
        });
        for (j, rows) in reduced.rows.iter_mut().enumerate() {
            for (k, row) in rows.chunks_exact_mut(p + V + 1).enumerate() {
                row[p + V] = self.left[k][j];
            }
        }
        let equations = Equations::of(&reduced, &vec![0.0; p + V]);
        let tried = among.iter().map(|&only| {
            let is_free = |j: usize| only.is_none_or(|only| only == j);
            let own = (0..V).map(|j| if is_free(j) { SHIFTED } else { KNOWN });
            let prior: Vec<f64> = found.prior.iter().copied().chain(own).collect();
            let estimate = equations.solve(&found.noise, &prior).estimate;
            let left = (0..V).map(|j| equations.square(&estimate, j) / self.largest[j].powi(2));
            let step = std::array::from_fn(|j| if is_free(j) { estimate[p + j] } else { 0.0 });
            (left.sum::<f64>(), (only, step))
        });
        let best = tried.min_by(|a, b| a.0.total_cmp(&b.0));
        Ok(best.map_or((None, [0.0; V]), |(_, step)| step))
    }
}
