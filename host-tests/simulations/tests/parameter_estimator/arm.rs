//! The simulated arm: its parameters, its motion, and the rows that it measures.

use std::collections::VecDeque;

use dynamics_core::Core;
use dynamics_core::algorithms::{friction_regressor, inertial_parameters};
use dynamics_core::effects::{
    Armature, Coriolis, Coulomb, Gravity, Inertia, LoadFriction, Payload, RIGID_BODY, Viscous,
    Width,
};
use dynamics_core::model::{BodyInertia, Robot};
use dynamics_core::robots::So101;
use dynamics_core::scalar::Real;
use dynamics_core::sim::runge_kutta;
use dynamics_core::spatial::SpatialInertia;
use dynamics_core::state::State;
use firmware_demo::scenes::so101_teach as so101;
use motion_control::estimate::{Estimate, Excitation, Observer, ObserverConfig};

use crate::common::Rng;

/// Viscous and Coulomb friction, armature, and friction per torque of the load while the motor
/// drives and while the load does.
pub const OWN: usize = 5;
pub const N: usize = 60 + 6 * OWN;
pub const TICK: f64 = 2e-3;
/// Ticks until the observer has the velocities.
pub const START: usize = 200;
/// Rows of half a minute.
pub const LEARNED: usize = 15_000;
/// Noise of the measured torque, N·m: two steps of the duty.
pub const NOISE: f64 = 7e-3;
/// Noise of a row, joint by joint: with encoders of 12 bits and velocities and accelerations from
/// them.
pub const STATED: [f64; 6] = [0.025, 0.025, 0.025, 0.025, 0.055, 0.03];
/// Ticks before and after a row of which the difference of velocities is its acceleration.
pub const APART: usize = 8;
/// Slower joints have no row: the sign of their friction is not known well enough.
pub const SLOWEST: f32 = 3.0 * WIDTH as f32;
pub const WIDTH: f64 = 0.05;
pub const FRICTION: f64 = so101::LOAD as f64;

pub type Friction = (Viscous<f64, 6>, Coulomb<f64, 6>, Armature<f64, 6>, LoadFriction<f64, 6>);

/// A number of a normal distribution, nearly.
pub fn normal(rng: &mut Rng) -> f64 {
    (0..12).map(|_| 0.5 * rng.within(1.0)).sum()
}

pub fn friction() -> Friction {
    let width = Width::new(WIDTH);
    (
        Viscous([f64::from(so101::VISCOUS + so101::BACK_EMF); 6]),
        Coulomb { torque: [f64::from(so101::COULOMB); 6], width },
        Armature([f64::from(so101::ARMATURE); 6]),
        LoadFriction::of_motor_and_load([FRICTION; 6], [FRICTION; 6], width),
    )
}

/// All parameters: of these bodies, and of the joints with each friction and armature times a
/// number of `of`.
pub fn parameters(bodies: &[[f64; 10]; 6], mut of: impl FnMut() -> f64) -> [f64; N] {
    let (viscous, coulomb, armature, gears) = friction();
    let own =
        [viscous.0[0], coulomb.torque[0], armature.0[0], gears.driving[0], gears.backdriving[0]];
    let joints = core::array::from_fn::<f64, 30, _>(|k| own[k % OWN] * of());
    core::array::from_fn(|k| bodies.as_flattened().iter().chain(&joints).copied().nth(k).unwrap())
}

/// The bodies off by 30 % as below, and each parameter of a joint.
pub fn nominal(seed: u64) -> [f64; N] {
    let mut rng = Rng::new(seed);
    let mut factor = || if rng.below(2) == 0 { 0.7 } else { 1.3 };
    let bodies = off_by_30_percent(&inertial_parameters(&So101::MODEL, &()), &mut factor);
    parameters(&bodies, factor)
}

/// Each mass, each component of each centre of mass and each inertia about the centre times a
/// factor.
pub fn off_by_30_percent(
    bodies: &[[f64; 10]; 6],
    factor: &mut impl FnMut() -> f64,
) -> [[f64; 10]; 6] {
    bodies.map(|body| {
        let about = BodyInertia::about_com(&SpatialInertia::from_parameters(body));
        let inertia = factor();
        let off = BodyInertia {
            mass: about.mass * factor(),
            com: about.com.map(|c| c * factor()),
            inertia: about.inertia.map(|x| x * inertia),
        };
        Payload::<f64, 0>::from_inertia(off).0.parameters()
    })
}

/// Each joint swings at two frequencies.
pub fn excitation(t: f64) -> State<f64, 6, 6> {
    const CENTRE: [f64; 6] = [0.0, -0.2, 0.2, 0.0, 0.0, 0.8];
    const SIZE: [f64; 6] = [0.9, 0.8, -0.8, 0.9, 1.2, 0.7];
    let of = |f: fn(f64, f64) -> f64| -> [f64; 6] {
        core::array::from_fn(|i| {
            let slow = 0.6 * f(1.3 + 0.37 * i as f64, t);
            SIZE[i] * (slow + 0.4 * f(3.1 + 0.53 * i as f64, t))
        })
    };
    let swing = of(|w, t| (w * t).sin());
    State {
        q: core::array::from_fn(|i| CENTRE[i] + swing[i]),
        qd: of(|w, t| w * (w * t).cos()),
        qdd: of(|w, t| -w * w * (w * t).sin()),
    }
}

/// A row of one joint, without the columns of load-dependent friction.
#[derive(Clone, Copy)]
pub struct Row<R = f32> {
    pub joint: usize,
    pub bodies: [[R; 10]; 6],
    pub own: [R; OWN],
    pub tau: R,
}

impl<R: Real> Row<R> {
    pub fn of(joint: usize, state: &State<f64, 6, 6>, tau: f64) -> Self {
        let state = State {
            q: state.q.map(R::from_f64),
            qd: state.qd.map(R::from_f64),
            qdd: state.qdd.map(R::from_f64),
        };
        let [viscous, sign] = friction_regressor(&state.qd, Width::new(R::from_f64(WIDTH)))[joint];
        Self {
            joint,
            bodies: Core::<So101>::regressor_row(&state, &RIGID_BODY, joint),
            own: [viscous, sign, state.qdd[joint], R::ZERO, R::ZERO],
            tau: R::from_f64(tau),
        }
    }

    /// With the friction of a gear that transmits this torque: s (m |τ| + d s τ) per μ₁ = m + d and
    /// μ₂ = m − d.
    pub fn loaded(mut self, load: f64) -> Self {
        let s = self.own[1].to_f64();
        let (even, odd) = (0.5 * s * load.abs(), 0.5 * s * s * load);
        (self.own[3], self.own[4]) = (R::from_f64(even + odd), R::from_f64(even - odd));
        self
    }

    pub fn all(&self) -> [R; N] {
        Excitation::row(self.joint, &self.bodies, &self.own)
    }

    pub fn torque(&self, all: &[f64; N]) -> f64 {
        dot(&self.all().map(R::to_f64), all)
    }
}

pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The rows of a run in closed loop under the servos' position gains with the feed-forward of a
/// model, and their ticks; the encoder of joint 2 sticks in the ticks `stuck`.
pub fn run(nominal: &[f64; N], ticks: usize, stuck: core::ops::Range<usize>) -> Vec<(usize, Row)> {
    observed(nominal, ticks, stuck, |_, _| ())
}

/// The same; `observe` gets the estimate and the torques of each tick.
pub fn observed(
    nominal: &[f64; N],
    ticks: usize,
    stuck: core::ops::Range<usize>,
    mut observe: impl FnMut(&Estimate<f64, 6>, &[f64; 6]),
) -> Vec<(usize, Row)> {
    let gain = f64::from(so101::SERVO_GAIN * so101::STALL);
    let step = f64::from(so101::STALL) * 1e-3;
    let most = f64::from(so101::MAX_DUTY * so101::STALL);
    let resolution = f64::from(so101::RESOLUTION);
    let scene = (Gravity::EARTH, (Inertia, Coriolis), friction());
    let (mut rng, mut at) = (Rng::new(1), excitation(0.0));
    let config = ObserverConfig { bandwidth: 60.0, tick: TICK };
    let mut observer: Observer<f64, 6> = Observer::try_new(config).expect("a good one");
    let (mut found, mut held, mut past) = (Vec::new(), None, VecDeque::new());
    for k in 0..ticks {
        let wanted = excitation(TICK * k as f64);
        let mut encoders = at.q.map(|q| (q / resolution).round() * resolution);
        match stuck.contains(&k) {
            true => encoders[2] = *held.get_or_insert(encoders[2]),
            false => held = None,
        }
        let estimate = observer.update(&encoders, &wanted.qdd);
        let ahead = torques(nominal, &wanted);
        let tau: [f64; 6] = core::array::from_fn(|i| {
            let law = ahead[i]
                + gain * (wanted.q[i] - estimate.q[i])
                + 0.5 * (wanted.qd[i] - estimate.qd[i]);
            (law.clamp(-most, most) / step).round() * step
        });
        observe(&estimate, &tau);
        past.push_back((estimate, tau));
        let joint = k % 6;
        if past.len() > 2 * APART {
            let (middle, tau) = past[APART];
            let ends = [past[0].0.qd, past[2 * APART].0.qd];
            let measured = State {
                q: middle.q,
                qd: middle.qd,
                qdd: core::array::from_fn(|i| {
                    (ends[1][i] - ends[0][i]) / (2.0 * TICK * APART as f64)
                }),
            };
            let noisy = tau[joint] + NOISE * normal(&mut rng);
            let row: Row = Row::of(joint, &measured, noisy);
            found.extend((k > START && row.own[0].abs() > SLOWEST).then_some((k, row)));
            past.pop_front();
        }
        for _ in 0..2 {
            runge_kutta(&So101::MODEL, &mut at, &tau, &scene, TICK / 2.0)
                .expect("an arm with mass");
        }
    }
    found
}

/// The torques of the motors by all parameters.
pub fn torques(all: &[f64; N], state: &State<f64, 6, 6>) -> [f64; 6] {
    core::array::from_fn(|joint| {
        let still: Row<f64> = Row::of(joint, state, 0.0);
        still.loaded(still.torque(all)).torque(all)
    })
}
