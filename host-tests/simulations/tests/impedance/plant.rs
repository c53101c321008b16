//! An arm on an impedance.

use dynamics_core::algorithms::{
    Conditioning, Damping, OperationalSpace, Pose, crba, frame, kinematics, ltdl,
    operational_space, rnea, solve,
};
use dynamics_core::effects::{Armature, Coriolis, Effect, Gravity, Inertia, hook};
use dynamics_core::model::ArmModel;
use dynamics_core::sim::semi_implicit;
use dynamics_core::state::State;
use glam::DVec3;
use motion_control::law::{
    CartesianImpedance, ImpedanceConfig, TaskDeviation, TaskFrame, pose_error,
};
use motion_control::limits::Fault;

pub const STIFFNESS: [f64; 6] = [40.0, 40.0, 40.0, 400.0, 400.0, 400.0];
pub const CONFIG: ImpedanceConfig<f64, 6> =
    ImpedanceConfig { stiffness: STIFFNESS, zeta: 0.5, slowest: 2.0 };
pub const UR5E: [f64; 6] = [0.2, -1.2, 1.5, 0.3, 0.7, 0.1];
pub const PANDA: [f64; 7] = [0.3, -0.4, 0.2, -2.0, 0.3, 1.9, 0.5];

/// A constant force on the origin of a body, N, along the base's axes.
#[derive(Clone, Copy)]
pub struct Push {
    body: usize,
    force: DVec3,
}

impl<const B: usize, const V: usize> Effect<f64, B, V> for Push {
    const EXTERNAL_WRENCH: hook::Wrench<Self, f64> =
        hook::Wrench::of_state(|push, body, at, fx| {
            if body == push.body {
                fx.lin += at.pose.rot * push.force;
            }
        });
}

#[derive(Clone, Copy)]
pub struct Sprung<const N: usize> {
    pub arm: ArmModel<f64, N>,
    pub impedance: CartesianImpedance<f64, 6>,
    pub goal: Pose<f64>,
    pub state: State<f64, N, N>,
    /// The wanted posture, its stiffness and damping; `projected`: only in the null space.
    pub posture: ([f64; N], f64, f64),
    pub projected: bool,
}

pub type Task<const N: usize> = OperationalSpace<f64, 6, N>;

impl<const N: usize> Sprung<N> {
    /// The arm at rest at its goal.
    pub fn at(arm: ArmModel<f64, N>, q: [f64; N]) -> Self {
        let state = State::at(q);
        Self {
            arm,
            impedance: CartesianImpedance::try_new(CONFIG).unwrap(),
            goal: kinematics(&arm, &state, &()).poses[N - 1],
            state,
            posture: (q, 0.0, 4.0),
            projected: true,
        }
    }

    pub fn rotors() -> Armature<f64, N> {
        Armature([0.3; N])
    }

    pub fn task(&self) -> Task<N> {
        let scene = (Inertia, Self::rotors());
        let directions = TaskFrame::BASE.turn_and_place(1.0);
        let tip = (N - 1, frame::LocalWorldAligned);
        operational_space(
            &self.arm,
            &self.state.q,
            tip,
            &directions,
            &scene,
            Damping::relative(1e-4),
        )
        .unwrap()
    }

    pub fn deviation(&self) -> TaskDeviation<f64, 6> {
        let directions = TaskFrame::BASE.turn_and_place(1.0);
        let tip = kinematics(&self.arm, &self.state, &());
        let off = pose_error(&tip.poses[N - 1], &self.goal);
        let v = tip.velocity(N - 1, frame::LocalWorldAligned);
        TaskDeviation {
            position: directions.map(|d| off.dot(d)),
            velocity: directions.map(|d| -v.dot(d)),
        }
    }

    pub fn torque(&mut self) -> Result<([f64; N], Conditioning<f64>), Fault> {
        let rest = State::at(self.state.q);
        let bias = rnea(&self.arm, &rest, &Gravity::EARTH);
        let (wanted, kn, dn) = self.posture;
        let free =
            core::array::from_fn(|i| kn * (wanted[i] - self.state.q[i]) - dn * self.state.qd[i]);
        let (mut bias, mut posture) = (bias, free);
        if !self.projected {
            bias = core::array::from_fn(|i| bias[i] + free[i]);
            posture = [0.0; N];
        }
        let (arm, scene) = (self.arm, (Inertia, Self::rotors()));
        let factors = ltdl(&arm, &crba(&arm, &self.state.q, &scene)).unwrap();
        let solve = |tau: &_| solve(&arm, &factors, tau);
        let (rows, deviation) = (self.task().jacobian, self.deviation());
        let out = self.impedance.torque(&rows, solve, &deviation, &bias, &posture)?;
        Ok((out.tau, out.conditioning))
    }

    /// A tick of h seconds under a push.
    pub fn advance(&mut self, push: DVec3, h: f64) {
        let (tau, _) = self.torque().unwrap();
        let push = Push { body: N - 1, force: push };
        let scene = ((Gravity::EARTH, Inertia, Coriolis), (Self::rotors(), push));
        semi_implicit(&self.arm, &mut self.state, &tau, &scene, h).unwrap();
    }
}
