//! The simulated arm in closed loop, and what is recorded of it.

use dynamics_core::algorithms::aba;
use dynamics_core::effects::{Armature, Coulomb, RIGID_BODY, Viscous};
use dynamics_core::model::{ArmModel, Robot};
use dynamics_core::robots::Ur5e;
use dynamics_core::spatial::SpatialInertia;
use dynamics_core::state::State;
use identification::{FourierMotion, TickRecording};

use crate::setup::*;

type At = State<f64, 6, 6>;

/// Positions and torques of the recorded periods, without their noise.
pub struct Run {
    positions: Vec<[f64; 6]>,
    torques: Vec<[f64; 6]>,
}

impl Run {
    /// Half a minute along a motion: position and velocity feedback from encoders of 14 bits, and
    /// the nominal model ahead.
    pub fn new(motion: &FourierMotion<6>, truth: &Parameters) -> Self {
        let mut plant = Plant::new(truth, motion.at(0.0));
        let nominal = Parameters::nominal().base();
        let mut run = Self { positions: Vec::new(), torques: Vec::new() };
        let mut before = plant.encoders();
        let mut speed = [0.0; 6];
        let ahead: Vec<_> =
            (0..EACH).map(|k| ARM.torques(&nominal, &motion.at(TICK * k as f64))).collect();
        for k in 0..PERIODS * EACH {
            let wanted = motion.at(TICK * k as f64);
            let q = plant.encoders();
            let tau = std::array::from_fn(|j| {
                // 0.8 of the last velocity: 9 ms.
                speed[j] = 0.8 * speed[j] + 0.2 * (q[j] - before[j]) / TICK;
                let gain = if j < 3 { 2000.0 } else { 200.0 };
                let law = gain * (wanted.q[j] - q[j]) + 0.08 * gain * (wanted.qd[j] - speed[j]);
                (ahead[k % EACH][j] + law).clamp(-RATED[j], RATED[j])
            });
            before = q;
            if k >= EACH {
                run.positions.push(q);
                run.torques.push(tau);
            }
            plant.advance(&tau);
        }
        run
    }

    /// With white noise of the torques, N·m, of which the plant is free.
    pub fn recorded(&self, noise: [f64; 6], seed: u64) -> TickRecording<6> {
        self.coloured(noise, 0.0, seed)
    }

    /// With noise of which this share is that of the sample before.
    pub fn coloured(&self, noise: [f64; 6], kept: f64, seed: u64) -> TickRecording<6> {
        let mut rng = fastrand::Rng::with_seed(seed);
        let (mut now, fresh) = ([0.0; 6], (1.0 - kept * kept).sqrt());
        let torques = self.torques.iter().map(|tau| {
            now = now.map(|now| kept * now + fresh * normal(&mut rng));
            std::array::from_fn(|j| tau[j] + noise[j] * now[j])
        });
        let torques = torques.collect();
        TickRecording::try_new(vec![(self.positions.clone(), torques)], TICK).expect("finite")
    }
}

/// The bodies of an arm with these parameters.
pub fn arm(truth: &Parameters) -> ArmModel<f64, 6> {
    let mut arm = Ur5e::MODEL;
    for (link, phi) in arm.links.iter_mut().zip(truth.bodies) {
        let own = SpatialInertia::from_parameters(phi);
        let frame = link.to_joint_frame;
        link.inertia = SpatialInertia {
            mass: own.mass,
            first_moment: frame * own.first_moment,
            rotational: frame * own.rotational * frame.transpose(),
        };
    }
    arm
}

struct Plant {
    arm: ArmModel<f64, 6>,
    joints: [[f64; 4]; 6],
    at: At,
}

impl Plant {
    fn new(truth: &Parameters, at: At) -> Self {
        let arm = arm(truth);
        Self { arm, joints: truth.joints, at: State { qdd: [0.0; 6], ..at } }
    }

    fn encoders(&self) -> [f64; 6] {
        self.at.q.map(|q| (q / COUNT).round() * COUNT)
    }

    /// A tick under constant torques.
    fn advance(&mut self, tau: &[f64; 6]) {
        let tau = std::array::from_fn(|j| tau[j] - self.joints[j][3]);
        let of = |k: usize| self.joints.map(|joint| joint[k]);
        let armature = Armature(of(2));
        let coulomb = Coulomb { torque: of(1), width: WIDTH };
        let scene = (RIGID_BODY, armature, Viscous(of(0)), coulomb);
        let moved = |x: &[f64; 6], rate: &[f64; 6], h: f64| -> [f64; 6] {
            std::array::from_fn(|i| x[i] + h * rate[i])
        };
        // The classical Runge–Kutta method.
        let (start, mut last) = (self.at, ([0.0; 6], [0.0; 6]));
        for (share, weight) in [(0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 1.0)] {
            let q = moved(&start.q, &last.0, share * TICK);
            let qd = moved(&start.qd, &last.1, share * TICK);
            let state = State { q, qd, qdd: [0.0; 6] };
            let qdd = aba(&self.arm, &state, &tau, &scene).expect("an arm with mass");
            self.at.q = moved(&self.at.q, &qd, weight * TICK / 6.0);
            self.at.qd = moved(&self.at.qd, &qdd, weight * TICK / 6.0);
            last = (qd, qdd);
        }
    }
}
