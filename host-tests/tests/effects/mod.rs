//! Each effect against an oracle that does not share its code: closed forms, Pinocchio, expanded
//! models.

use dynamics_core::effects::{Effect, JointState, TorqueDerivatives};
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model};
use dynamics_core::scalar::Real;
use dynamics_core::state::State;
use host_tests::tolerances;

mod actuator;
mod exponential;
mod flexible;
mod friction;
mod load;
mod lugre;
mod own;
mod passive;
mod presliding;
mod rotors;
mod springs;
mod surroundings;

/// 2 kg on a level rail along x.
const SLEDGE: ArmModel<f64, 1> =
    Model::new("sledge", [Body::new("sledge", BASE, Joint::prismatic([1.0, 0.0, 0.0])).mass(2.0)]);

/// The motor's torque at one joint that moves so.
fn torque<R: Real, E: Effect<R, 1, 1>>(effect: &E, q: f64, qd: f64) -> f64 {
    let mut tau = R::ZERO;
    effect.torque(0, joint(q, qd), &mut tau);
    tau.to_f64()
}

fn joint<R: Real>(q: f64, qd: f64) -> JointState<R> {
    JointState::new(R::from_f64(q), R::from_f64(qd))
}

fn derivatives<E: Effect<f64, 1, 1>>(effect: &E, q: f64, qd: f64) -> [f64; 2] {
    let mut derivatives = TorqueDerivatives::default();
    effect.derivatives(0, joint(q, qd), &mut derivatives);
    [derivatives.dq, derivatives.dqd]
}

fn cast<R: Real, const N: usize>(state: &State<f64, N, N>) -> State<R, N, N> {
    State {
        q: state.q.map(R::from_f64),
        qd: state.qd.map(R::from_f64),
        qdd: state.qdd.map(R::from_f64),
    }
}

/// The worst error of a quantity and its full scale.
#[derive(Default)]
struct Worst {
    error: f64,
    full_scale: f64,
}

impl Worst {
    fn see(&mut self, got: f64, want: f64) {
        let error = (got - want).abs();
        assert!(error.is_finite(), "{got} {want}");
        self.error = self.error.max(error);
        self.full_scale = self.full_scale.max(want.abs());
    }

    fn see_all<R: Real, const N: usize>(&mut self, got: &[R; N], want: &[f64; N]) {
        for (got, want) in got.iter().zip(want) {
            self.see(got.to_f64(), *want);
        }
    }

    fn check<R>(&self, what: &str, quantity: &str) {
        let scalar = std::any::type_name::<R>();
        tolerances::check(what, quantity, scalar, self.error / self.full_scale)
            .unwrap_or_else(|e| panic!("{e}"));
    }
}
