//! The firmware of the arm.

use dynamics_core::Core;
use dynamics_core::algorithms::{friction_regressor, regressor_columns};
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::model::model;
use dynamics_core::robots::So101;
use dynamics_core::state::State;
use firmware_demo::scenes::so101_teach::{MAX_DUTY, SERVO_GAIN, STALL};
use motion_control::{
    ConfigError, Estimate, Observer, ObserverConfig, ParameterEstimator, ParameterEstimatorConfig,
    PayloadEstimator, PayloadEstimatorConfig,
};

use super::TICK;
use super::arm::GRIPPER;
use super::parameters::{Known, Model, OWN, P, WIDTH};

/// Ticks before and after a row of which the difference of velocities is its acceleration.
const APART: usize = 8;
const KEPT: usize = 2 * APART + 1;
/// Ticks until the observer has the velocities.
const START: u32 = 200;
/// Slower joints have no row: the sign of their friction is not known well enough. rad/s.
const SLOWEST: f32 = 0.15;
/// Standard deviations of the torques of a row, N·m: with the errors of velocities and
/// accelerations.
pub const STATED: [f32; 6] = [0.025, 0.025, 0.025, 0.025, 0.055, 0.03];
/// Standard deviations of a load's parameters: kg, kg·m, kg·m².
const LOAD_PRIOR: [f32; 10] = [0.5, 0.05, 0.05, 0.05, 2e-3, 2e-3, 2e-3, 2e-3, 2e-3, 2e-3];
const MOST: f32 = MAX_DUTY * STALL;

/// The firmware's task beside following its motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Task {
    /// It estimates the arm's parameters, a row of one joint in each tick.
    Learn,
    /// It estimates a load, by the rows of all joints.
    Weigh,
}

#[derive(Clone, Debug)]
pub struct Firmware<'a> {
    known: &'a Known,
    pub model: Model,
    /// The estimator of the arm's parameters.
    pub estimator: ParameterEstimator<f32, P, 6>,
    pub payload: PayloadEstimator<f32, 6>,
    observer: Observer<f32, 6>,
    /// An observer that has no position yet.
    fresh: Observer<f32, 6>,
    /// Estimates and measured torques of the last ticks, in rotation.
    past: [(Estimate<f32, 6>, [f32; 6]); KEPT],
    tick: u32,
    pub rejected: u32,
}

/// The data that a tick adds to an estimator.
enum Addition {
    Nothing,
    Row(usize, [f32; P], f32),
    Load([[f32; 10]; 6], [f32; 6]),
}

impl<'a> Firmware<'a> {
    /// At the start of its motion, with the nominal model.
    ///
    /// # Errors
    /// [`ConfigError`] names a number that is none.
    pub fn new(known: &'a Known, model: Model) -> Result<Self, ConfigError> {
        let still = Estimate {
            q: [0.0; 6],
            qd: [0.0; 6],
        };
        let observer = Observer::try_new(ObserverConfig {
            bandwidth: 60.0,
            tick: TICK,
        })?;
        Ok(Self {
            known,
            model,
            estimator: ParameterEstimator::try_new(ParameterEstimatorConfig {
                noise: STATED,
                prior: known.base.prior,
                own: known.base.own(6, OWN),
                forgetting: 1e-4,
                limit: 5.0,
            })?,
            payload: PayloadEstimator::try_new(PayloadEstimatorConfig {
                noise: STATED,
                prior: LOAD_PRIOR,
                forgetting: 0.0,
                // The scene has only five seconds: also the ticks count in which the arm sags under
                // its load.
                limit: 1000.0,
            })?,
            observer,
            fresh: observer,
            past: [(still, [0.0; 6]); KEPT],
            tick: 0,
            rejected: 0,
        })
    }

    /// A tick: from the encoders and the torques that were measured in the tick before to the
    /// commanded ones.
    pub fn tick(
        &mut self,
        encoders: &[f32; 6],
        before: &[f32; 6],
        wanted: &State<f32, 6, 6>,
        task: Task,
    ) -> [f32; 6] {
        let last = (self.tick as usize + KEPT - 1) % KEPT;
        self.past[last].1 = *before;
        let estimate = self.observer.update(encoders, &wanted.qdd);

        let addition = match task {
            _ if self.tick <= START => Addition::Nothing,
            Task::Learn => self.row(),
            Task::Weigh => self.load(),
        };
        self.past[self.tick as usize % KEPT].0 = estimate;
        self.tick += 1;

        let added = match &addition {
            Addition::Nothing => true,
            Addition::Row(joint, y, residual) => {
                self.estimator.update(*joint, y, *residual).is_ok()
            }
            Addition::Load(y, residual) => self.payload.update(y, residual).is_ok(),
        };
        self.rejected += u32::from(!added);

        let ahead = self.model.torque(wanted);
        let tau: [f32; 6] = core::array::from_fn(|i| {
            ahead[i]
                + SERVO_GAIN * STALL * (wanted.q[i] - estimate.q[i])
                + 0.5 * (wanted.qd[i] - estimate.qd[i])
        });

        let command = tau.map(|tau| tau.clamp(-MOST, MOST));
        command
    }

    /// For another motion: the observer starts anew, and there are no rows until it has the
    /// velocities.
    pub fn restart(&mut self) {
        self.observer = self.fresh;
        self.tick = 0;
    }

    /// The state in the middle of what is kept, and its measured torques. The oldest estimate is
    /// the one that this tick replaces.
    fn measured(&self) -> (State<f32, 6, 6>, [f32; 6]) {
        let at = |ticks: usize| &self.past[(self.tick as usize + ticks) % KEPT];
        let [(first, _), (middle, tau), (last, _)] = [at(0), at(APART), at(2 * APART)];
        let rate = 1.0 / (2.0 * TICK * APART as f32);
        let state = State {
            q: middle.q,
            qd: middle.qd,
            qdd: core::array::from_fn(|i| rate * (last.qd[i] - first.qd[i])),
        };
        (state, *tau)
    }

    /// The row of one joint, with the load-dependent friction of the torque that the estimate
    /// implies, and the residual.
    fn row(&self) -> Addition {
        let (state, tau) = self.measured();
        let joint = self.tick as usize % 6;
        if state.qd[joint].abs() <= SLOWEST {
            return Addition::Nothing;
        }
        let Known { nominal, base } = self.known;
        let bodies = Core::<So101>::regressor_row(&state, &RIGID_BODY, joint);
        let [viscous, sign] = friction_regressor(&state.qd, WIDTH)[joint];
        let mut own = [viscous, sign, state.qdd[joint], 0.0, 0.0];
        let still = dot(bodies.as_flattened(), &nominal[..60]) + dot(&own, joints(nominal, joint));
        let load = still
            + self
                .estimator
                .explained(joint, &base.row(joint, &bodies, &own));
        // s (m |τ| + d s τ) per μ₁ = m + d and μ₂ = m − d.
        let (even, odd) = (0.5 * sign * load.abs(), 0.5 * sign * sign * load);
        (own[3], own[4]) = (even + odd, even - odd);
        let modelled = still + dot(&own[3..], &joints(nominal, joint)[3..]);
        Addition::Row(joint, base.row(joint, &bodies, &own), tau[joint] - modelled)
    }

    /// The rows of the load, but for those of slow joints.
    fn load(&self) -> Addition {
        let (state, tau) = self.measured();
        let arm = model::<f32, So101, 6, 6, 6>();
        let mut y = regressor_columns(arm, &state, &RIGID_BODY, GRIPPER);
        for (y, qd) in y.iter_mut().zip(&state.qd) {
            if qd.abs() <= SLOWEST {
                *y = [0.0; 10];
            }
        }
        Addition::Load(y, self.model.unexplained(&state, &tau))
    }
}

fn joints(all: &[f32], joint: usize) -> &[f32] {
    &all[60 + OWN * joint..60 + OWN * (joint + 1)]
}

fn dot(a: &[f32], b: &[f32]) -> f32 {
    a.iter().zip(b).fold(0.0, |sum, (a, b)| sum + a * b)
}
