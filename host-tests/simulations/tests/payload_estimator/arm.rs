//! The simulated arm with its load, and what an estimator gets from it.

use core::ops::Range;

use dynamics_core::Core;
use dynamics_core::effects::{
    Armature, Coriolis, Coulomb, Gravity, Inertia, Payload, RIGID_BODY, Viscous, Width,
};
use dynamics_core::model::{BodyInertia, Robot};
use dynamics_core::robots::Ur5e;
use dynamics_core::sim::runge_kutta;
use dynamics_core::state::State;
use motion_control::estimate::{Observer, ObserverConfig};

use crate::common::Rng;

pub const TICK: f64 = 1e-3;
pub const WRIST: usize = Ur5e::MODEL.body("wrist_3");
/// Standard deviations of the torques' noise, N·m.
pub const NOISE: [f64; 6] = [1.5, 1.5, 1.0, 0.3, 0.3, 0.3];
pub const PRIOR: [f64; 10] = [5.0, 0.5, 0.5, 0.5, 0.05, 0.05, 0.05, 0.05, 0.05, 0.05];
/// A load of 2.5 kg whose centre is 60 mm off.
pub const LOAD: BodyInertia<f64> = BodyInertia {
    mass: 2.5,
    com: [0.04, -0.02, 0.04],
    inertia: [0.008, 0.001, 0.0, 0.006, 0.0, 0.007],
};

pub type Tick = ([[f64; 10]; 6], [f64; 6]);

/// A number of a normal distribution, nearly.
pub fn normal(rng: &mut Rng) -> f64 {
    (0..12).map(|_| 0.5 * rng.within(1.0)).sum()
}

type Friction = (Armature<f64, 6>, Viscous<f64, 6>, Coulomb<f64, 6>);

fn friction(share: f64) -> Friction {
    let coulomb = Coulomb {
        torque: [8.0, 8.0, 5.0, 2.0, 2.0, 2.0].map(|f| f * share),
        width: Width::new(0.05),
    };
    (
        Armature([2.0, 2.0, 2.0, 0.2, 0.2, 0.2]),
        Viscous([6.0, 6.0, 4.0, 1.0, 1.0, 1.0].map(|b| b * share)),
        coulomb,
    )
}

/// Each joint swings from rest; in half a minute no two of them are in phase twice.
pub fn reference(t: f64) -> State<f64, 6, 6> {
    const START: [f64; 6] = [0.0, -1.2, 1.3, -0.4, 0.5, 0.1];
    const SIZE: [f64; 6] = [0.5, 0.3, -0.4, 0.6, 0.7, 0.9];
    let rate = |i: usize| 2.0 + 0.43 * i as f64;
    let of = |f: fn(f64, f64) -> f64| core::array::from_fn(|i| SIZE[i] * f(rate(i), t));
    let swing: [f64; 6] = of(|w, t| 1.0 - (w * t).cos());
    State {
        q: core::array::from_fn(|i| START[i] + swing[i]),
        qd: of(|w, t| w * (w * t).sin()),
        qdd: of(|w, t| w * w * (w * t).cos()),
    }
}

#[derive(Clone, Debug)]
pub struct Run {
    pub ticks: usize,
    pub seed: u64,
    /// The controller has the model of friction times this, and none of the load.
    pub friction: f64,
    /// Another load from this tick on.
    pub changed: Option<(usize, BodyInertia<f64>)>,
    /// The encoder of joint 2 sticks in these ticks.
    pub stuck: Range<usize>,
    /// The noise of the torques, in standard deviations.
    pub noise: f64,
}

pub const GOOD: Run =
    Run { ticks: 5000, seed: 1, friction: 1.0, changed: None, stuck: 0..0, noise: 1.0 };

/// The measurements of an estimator in each tick of a run.
pub fn measure(run: &Run) -> Vec<Tick> {
    const KP: [f64; 6] = [4000.0, 4000.0, 3000.0, 600.0, 600.0, 400.0];
    const KD: [f64; 6] = [200.0, 200.0, 150.0, 20.0, 20.0, 15.0];
    let (mut rng, mut at) = (Rng::new(run.seed), reference(0.0));
    let model = (RIGID_BODY, friction(run.friction));
    let observed = ObserverConfig { bandwidth: 150.0, tick: TICK };
    let mut observer: Observer<f64, 6> = Observer::try_new(observed).expect("a good one");
    let (mut found, mut held) = (Vec::new(), None);
    for k in 0..run.ticks {
        let wanted = reference(TICK * k as f64);
        let counts = 16384.0 / core::f64::consts::TAU;
        let mut encoders = at.q.map(|q| (q * counts).round() / counts);
        match run.stuck.contains(&k) {
            true => encoders[2] = *held.get_or_insert(encoders[2]),
            false => held = None,
        }
        let estimate = observer.update(&encoders, &wanted.qdd);
        let ahead = Core::<Ur5e>::rnea(&wanted, &model);
        let tau: [f64; 6] = core::array::from_fn(|i| {
            ahead[i]
                + KP[i] * (wanted.q[i] - estimate.q[i])
                + KD[i] * (wanted.qd[i] - estimate.qd[i])
        });
        let measured = State { q: estimate.q, qd: estimate.qd, qdd: wanted.qdd };
        let modelled = Core::<Ur5e>::rnea(&measured, &model);
        let y = Core::<Ur5e>::regressor_columns(&measured, &RIGID_BODY, WRIST);
        let z = core::array::from_fn(|i| {
            tau[i] + run.noise * NOISE[i] * normal(&mut rng) - modelled[i]
        });
        found.push((y, z));
        let load = match run.changed {
            Some((from, load)) if k >= from => load,
            _ => LOAD,
        };
        let load = Payload::<f64, WRIST>::from_inertia(load);
        let scene = (Gravity::EARTH, (Inertia, Coriolis), friction(1.0), load);
        for _ in 0..4 {
            runge_kutta(&Ur5e::MODEL, &mut at, &tau, &scene, TICK / 4.0).expect("an arm with mass");
        }
    }
    found
}
