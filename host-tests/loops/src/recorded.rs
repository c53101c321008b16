//! The records of Pinocchio for the machines (`host-tests/oracle/loops.py`), and how far inverse
//! and forward dynamics with loops are from it.

use dynamics_core::effects::RIGID_BODY;
use dynamics_core::loops::{Stabilisation, forward_dynamics, inverse_dynamics};
use dynamics_core::model::{RobotModel, Static};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use host_tests::recordings::{read, row};
use host_tests::tolerances::Errors;
use serde::Deserialize;

use crate::export::Exported;
use crate::machines::Machine;

/// Every row of an array is a state.
#[derive(Deserialize)]
pub struct Recording {
    pub pinocchio: String,
    pub machine: Exported,
    /// Positions with closed loops.
    pub q: Vec<Vec<f64>>,
    /// Velocities with closed loops.
    pub qd: Vec<Vec<f64>>,
    /// Accelerations with closed loops.
    pub qdd: Vec<Vec<f64>>,
    /// The motors' torques with those accelerations.
    pub tau: Vec<Vec<f64>>,
    /// Torques of the motors given to forward dynamics.
    pub given_tau: Vec<Vec<f64>>,
    /// The accelerations that they give: `constraintDynamics`.
    pub forward: Vec<Vec<f64>>,
}

impl Recording {
    /// Loads the recording of the machine of this name.
    ///
    /// # Panics
    /// If there is none.
    pub fn load(name: &str) -> Self {
        let recording: Self = read(&format!("loop_{name}"));
        assert_eq!(recording.q.len(), 200);
        recording
    }

    /// A recorded state, rounded to the scalar.
    pub fn state<R: Real, const Q: usize, const V: usize>(&self, k: usize) -> State<R, Q, V> {
        State {
            q: row(&self.q, k).map(R::from_f64),
            qd: row(&self.qd, k).map(R::from_f64),
            qdd: row(&self.qdd, k).map(R::from_f64),
        }
    }
}

/// Errors over the recorded states, in f64 and f32. In f32 they include those of rounding the
/// recorded states, whose dependent coordinates are not exactly representable.
///
/// # Panics
/// If a recorded state has no result.
pub fn errors<
    T,
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
>() -> Errors
where
    T: Machine<B, Q, V, L, C, A>,
{
    let recorded = Recording::load(T::MODEL.name);
    let mut errors = Errors::new(T::MODEL.name);
    for k in 0..recorded.q.len() {
        of_state::<T, f64, B, Q, V, L, C, A>(&recorded, k, "f64", &mut errors);
        of_state::<T, f32, B, Q, V, L, C, A>(&recorded, k, "f32", &mut errors);
    }
    errors
}

fn of_state<
    T,
    R,
    const B: usize,
    const Q: usize,
    const V: usize,
    const L: usize,
    const C: usize,
    const A: usize,
>(
    recorded: &Recording,
    k: usize,
    scalar: &'static str,
    errors: &mut Errors,
) where
    T: Machine<B, Q, V, L, C, A>,
    R: Real,
    Static<T>: RobotModel<R, B, Q, V>,
{
    let (robot, loops) = (Static::<T>::NEW, T::LOOPS);
    let state = recorded.state::<R, Q, V>(k);
    let mut compare = |quantity, got: &[R], want: &[f64]| {
        let got: Vec<f64> = got.iter().map(|x| x.to_f64()).collect();
        errors.add(quantity, scalar, &got, want);
    };
    let id = inverse_dynamics(&robot, &loops, &state, &RIGID_BODY).expect("a torque");
    compare("recorded torques", &id.tau, &recorded.tau[k]);
    compare("recorded rates", &id.state.qd, &recorded.qd[k]);
    compare("recorded dependent accelerations", &id.state.qdd, &recorded.qdd[k]);
    let tau = row(&recorded.given_tau, k).map(R::from_f64);
    let fd = forward_dynamics(&robot, &loops, &state, &tau, Stabilisation::NONE, &RIGID_BODY);
    let qdd = fd.expect("accelerations").qdd;
    compare("recorded accelerations", &qdd, &recorded.forward[k]);
}
