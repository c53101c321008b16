//! The UR5e, its limits, and the greatest shares of them in a motion.

use dynamics_core::Core;
use dynamics_core::effects::{Armature, Coriolis, Gravity, Inertia};
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use motion_control::reference::{PathLimits, Reference};

use crate::hand_guiding::plant::{Q, ROTORS};

pub const RIGID: (Gravity, Inertia, Coriolis, Armature<f64, 6>) =
    (Gravity::EARTH, Inertia, Coriolis, ROTORS);

pub fn inverse_dynamics(state: &State<f64, 6, 6>) -> Q {
    Core::<Ur5e>::rnea(state, &RIGID)
}

/// By another way than that of the plan: M q̈ by CRBA, and C q̇ with the Coriolis matrix.
fn torques(state: &State<f64, 6, 6>) -> Q {
    let m = Core::<Ur5e>::crba(&state.q, &RIGID);
    let c = Core::<Ur5e>::coriolis_matrix(state, &RIGID);
    let gravity = Core::<Ur5e>::rnea(&State::at(state.q), &Gravity::EARTH);
    core::array::from_fn(|i| {
        let products = (0..6).map(|j| m.get(i, j) * state.qdd[j] + c[i][j] * state.qd[j]);
        gravity[i] + products.sum::<f64>()
    })
}

/// The greatest shares of the limits in a motion: torque, speed, acceleration.
#[derive(Clone, Copy, Debug, Default)]
pub struct Shares {
    pub torque: f64,
    pub speed: f64,
    pub acceleration: f64,
}

impl Shares {
    pub fn most(self, other: Self) -> Self {
        Self {
            torque: self.torque.max(other.torque),
            speed: self.speed.max(other.speed),
            acceleration: self.acceleration.max(other.acceleration),
        }
    }
}

/// With Coulomb friction, which counts as `certain` where it relieves the motor.
pub fn shares(motion: &impl Reference<f64, 6>, limits: &PathLimits<f64, 6>) -> Shares {
    let mut most = Shares::default();
    for k in 0..motion.ticks() {
        let state = motion.at(k);
        let rigid = torques(&state);
        for (j, rigid) in rigid.into_iter().enumerate() {
            let (qd, friction) = (state.qd[j], limits.friction[j]);
            let sign = if qd == 0.0 { 0.0 } else { qd.signum() };
            let against = friction.coulomb * sign + friction.viscous * qd;
            let tau = [1.0, friction.certain].map(|share| rigid + share * against);
            // Friction is between its certain part and the whole.
            let tau = if against * rigid > 0.0 { tau[0] } else { tau[1] };
            let [speed, acceleration] = [limits.motion[j].velocity, limits.motion[j].acceleration];
            most = most.most(Shares {
                torque: tau.abs() / limits.torque[j],
                speed: qd.abs() / speed,
                acceleration: state.qdd[j].abs() / acceleration,
            });
        }
    }
    most
}
