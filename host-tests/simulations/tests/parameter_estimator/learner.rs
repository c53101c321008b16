//! An estimator of 24 parameters of the arm, and how good its torques are elsewhere.

use std::sync::OnceLock;

use dynamics_core::Core;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::robots::So101;
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use firmware_demo::scene::Scene;
use firmware_demo::scenes::so101_teach::TaughtPath;
use motion_control::estimate::{
    Excitation, ParameterEstimator, ParameterEstimatorConfig, RejectedRow, SelectedParameters,
};

use crate::parameter_estimator::arm::*;

/// Estimated parameters.
pub const P: usize = 24;
pub const FORGETTING: f32 = 1e-4;
pub const LIMIT: f32 = 5.0;

/// A minute of motion, by the feed-forward of this nominal model.
pub fn minute(seed: u64) -> &'static [(usize, Row)] {
    static ROWS: [OnceLock<Vec<(usize, Row)>>; 4] = [const { OnceLock::new() }; 4];
    ROWS[seed as usize].get_or_init(|| run(&nominal(seed), 2 * LEARNED, 0..0))
}

/// The base parameters of this motion: from the reference and the nominal model, before the arm
/// moves.
pub fn base_of<R: Real, const P: usize>(
    nominal: &[f64; N],
) -> Result<SelectedParameters<R, P, N>, usize> {
    let mut motion: Box<Excitation<N>> = Box::default();
    for k in 0..600 {
        let state = excitation(0.05 * k as f64);
        for (joint, noise) in STATED.into_iter().enumerate() {
            let still: Row<f64> = Row::of(joint, &state, 0.0);
            let row = still.loaded(still.torque(nominal));
            motion.add(&row.all(), noise);
        }
    }
    motion.select::<_, 6, _>(nominal, 0.4)
}

pub fn config(
    base: &SelectedParameters<f32, P, N>,
    forgetting: f32,
    limit: f32,
) -> ParameterEstimatorConfig<f32, P, 6> {
    ParameterEstimatorConfig {
        noise: STATED.map(|x| x as f32),
        prior: base.prior,
        own: base.own(6, OWN),
        forgetting,
        limit,
    }
}

#[derive(Clone)]
pub struct Learner {
    pub nominal: [f64; N],
    pub base: SelectedParameters<f32, P, N>,
    pub estimator: ParameterEstimator<f32, P, 6>,
}

impl Learner {
    pub fn new(seed: u64, forgetting: f32, limit: f32) -> Self {
        let nominal = nominal(seed);
        let base = base_of(&nominal).expect("enough columns");
        let config = config(&base, forgetting, limit);
        let estimator = ParameterEstimator::try_new(config).expect("a good one");
        Self { nominal, base, estimator }
    }

    /// The row of the base parameters, with the load-dependent friction of the torque that the
    /// estimate implies, and the residual.
    pub fn row(&self, row: &Row) -> ([f32; P], f32) {
        let still = self.base.row(row.joint, &row.bodies, &row.own);
        let change = self.estimator.explained(row.joint, &still);
        let row = row.loaded(row.torque(&self.nominal) + f64::from(change));
        let y = self.base.row(row.joint, &row.bodies, &row.own);
        (y, row.tau - row.torque(&self.nominal) as f32)
    }

    pub fn add(&mut self, row: &Row) -> Result<(), RejectedRow> {
        let (y, residual) = self.row(row);
        self.estimator.update(row.joint, &y, residual)
    }

    /// The N parameters of the estimate.
    pub fn found(&self) -> [f64; N] {
        self.with(&self.estimator.estimate().map(f64::from))
    }

    pub fn with(&self, estimate: &[f64; P]) -> [f64; N] {
        let change = self.base.change(&estimate.map(|x| x as f32));
        core::array::from_fn(|k| self.nominal[k] + f64::from(change[k]))
    }
}

/// The error of the torques on the path of the scene `so101_teach`, relative to their size: of all
/// joints, and of the worst one.
pub fn validation(all: &[f64; N]) -> (f64, f64) {
    static PATH: OnceLock<Vec<(State<f64, 6, 6>, [f64; 6])>> = OnceLock::new();
    let path = PATH.get_or_init(|| {
        let reference = TaughtPath::reference().expect("a trajectory");
        let states = (0..3600).step_by(9).map(|tick| {
            let at = reference.at(tick);
            let state = State {
                q: at.q.map(f64::from),
                qd: at.qd.map(f64::from),
                qdd: at.qdd.map(f64::from),
            };
            let tau = Core::<So101>::rnea(&state, &(RIGID_BODY, friction()));
            (state, tau)
        });
        states.collect()
    });
    let (mut errors, mut sizes) = ([0.0; 6], [0.0; 6]);
    for (state, tau) in path {
        for (joint, got) in torques(all, state).into_iter().enumerate() {
            errors[joint] += (got - tau[joint]).powi(2);
            sizes[joint] += tau[joint].powi(2);
        }
    }
    let of = |a: f64, b: f64| (a / b).sqrt();
    let worst = (0..6).map(|i| of(errors[i], sizes[i])).fold(0.0, f64::max);
    (of(errors.iter().sum(), sizes.iter().sum()), worst)
}

/// A learner after half a minute.
pub fn learned(seed: u64, forgetting: f32) -> Learner {
    let mut learner = Learner::new(seed, forgetting, LIMIT);
    for (_, row) in minute(seed).iter().filter(|(k, _)| *k < LEARNED) {
        let _ = learner.add(row);
    }
    learner
}
