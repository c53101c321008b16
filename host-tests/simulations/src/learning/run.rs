//! Learning, then the load.

use dynamics_core::Core;
use dynamics_core::effects::{Effect, Payload, RIGID_BODY};
use dynamics_core::model::BodyInertia;
use dynamics_core::robots::So101;
use dynamics_core::scalar::Real;
use dynamics_core::sim::KahanState;
use dynamics_core::spatial::SpatialInertia;
use dynamics_core::state::State;
use firmware_demo::scene::Scene;
use firmware_demo::scenes::so101_teach::TaughtPath;
use motion_control::PhysicalParameters;

use super::TICK;
use super::arm::{Arm, GEARS, SMOOTH};
use super::firmware::{Firmware, Task};
use super::parameters::{Known, Model, N, P};

/// Ticks of learning: half a minute.
pub const LEARNING: u32 = 15_000;
/// Ticks of the estimate of a load: five seconds without it for taring, five seconds with it.
pub const WEIGHING: u32 = 2_500;
/// The load that the arm carries in the end.
pub const LOAD: BodyInertia<f32> = BodyInertia {
    mass: 0.15,
    com: [0.01, -0.02, -0.05],
    inertia: [1e-4, 0.0, 0.0, 1e-4, 0.0, 5e-5],
};

/// The motion by which the arm learns: each joint swings at two frequencies, and no two of them are
/// in phase twice.
pub fn excitation(t: f32) -> State<f32, 6, 6> {
    swing(t, |i| [1.3 + 0.37 * i, 3.1 + 0.53 * i])
}

/// The motion by which the arm weighs: the same with a period of five seconds.
pub fn weighing(t: f32) -> State<f32, 6, 6> {
    const TURN: f32 = core::f32::consts::TAU / 5.0;
    swing(t, |i| [TURN, TURN * (2.0 + 0.5 * (i - i % 2.0))])
}

fn swing(t: f32, rates: impl Fn(f32) -> [f32; 2]) -> State<f32, 6, 6> {
    const CENTRE: [f32; 6] = [0.0, -0.2, 0.2, 0.0, 0.0, 0.8];
    const SIZE: [f32; 6] = [0.9, 0.8, -0.8, 0.9, 1.2, 0.7];
    let mut state = State::at(CENTRE);
    for (i, size) in SIZE.into_iter().enumerate() {
        for (share, rate) in [0.6, 0.4].into_iter().zip(rates(i as f32)) {
            // Not the method: where std is linked it would be another sine.
            let ((sin, cos), size) = (Real::sin_cos(rate * t), share * size);
            state.q[i] += size * sin;
            state.qd[i] += size * rate * cos;
            state.qdd[i] -= size * rate * rate * sin;
        }
    }
    state
}

/// The error of a model's torques on the path of the scene `so101_teach`, relative to their size:
/// of all joints, and of the worst one.
pub fn validation(model: &Model) -> [f32; 2] {
    let Ok(path) = TaughtPath::reference() else {
        return [f32::NAN; 2];
    };
    let (mut errors, mut sizes) = ([0.0; 6], [0.0; 6]);
    for tick in (0..path.ticks()).step_by(9) {
        let state = path.at(tick);
        let truth = Core::<So101>::rnea(&state, &(RIGID_BODY, SMOOTH, GEARS));
        for (joint, found) in model.torque(&state).into_iter().enumerate() {
            errors[joint] += (found - truth[joint]) * (found - truth[joint]);
            sizes[joint] += truth[joint] * truth[joint];
        }
    }
    let of = |a: f32, b: f32| libm::sqrtf(a / b);
    let worst = (0..6).map(|i| of(errors[i], sizes[i])).fold(0.0, f32::max);
    [of(errors.iter().sum(), sizes.iter().sum()), worst]
}

/// All parameters by an estimate, as far as they are possible.
pub fn possible(known: &Known, estimate: &[f32; P]) -> Option<[f32; N]> {
    let mut stored: PhysicalParameters<f32, 6, N> =
        PhysicalParameters::try_new(known.nominal).ok()?;
    stored.update(&known.base, estimate);
    Some(*stored.parameters())
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// The relative error of the torques on the validation path, of all joints and of the worst
    /// one, before and after learning.
    pub errors: [[f32; 2]; 2],
    pub rejected: u32,
    /// The mass of the load, kg, and how far its centre is from where it was found, m.
    pub load: [f32; 2],
}

/// Learns and weighs, with friction of the kind `F`. `observe` gets the task, its tick and the
/// firmware after each tick.
///
/// Nothing if the nominal model is impossible or the arm has no forward dynamics.
pub fn run<F: Effect<f32, 6, 6> + Clone>(
    known: &Known,
    friction: F,
    mut observe: impl FnMut(Task, u32, &Firmware<'_>),
) -> Option<Outcome> {
    let nominal = Model::of(&known.nominal)?;
    let mut arm = Arm::new(excitation(0.0), friction);
    let mut firmware = Firmware::new(known, nominal).ok()?;
    let mut before = [0.0; 6];
    let mut ticks = |firmware: &mut Firmware<'_>, arm: &mut Arm<F>, task| {
        let (motion, count): (fn(f32) -> _, _) = match task {
            Task::Learn => (excitation, LEARNING),
            Task::Weigh => (weighing, WEIGHING),
        };
        for tick in 0..count {
            let wanted = motion(TICK * tick as f32);
            let command = firmware.tick(&arm.encoders(), &before, &wanted, task);
            before = arm.advance(&command).ok()?;
            observe(task, tick, firmware);
        }
        Some(())
    };
    ticks(&mut firmware, &mut arm, Task::Learn)?;
    let learned = Model::of(&possible(known, &firmware.estimator.estimate())?)?;
    firmware.model = learned;
    let rejected = firmware.rejected;
    // The other motion begins at rest of the estimates: the first period is for the arm to follow
    // it.
    arm.at = KahanState::at(weighing(0.0));
    firmware.restart();
    ticks(&mut firmware, &mut arm, Task::Weigh)?;
    // The remaining error of the model would count as load.
    firmware.payload.restart();
    ticks(&mut firmware, &mut arm, Task::Weigh)?;
    let tare = firmware.payload.inertia().parameters();
    firmware.payload.restart();
    arm.load = Payload::from_inertia(LOAD);
    ticks(&mut firmware, &mut arm, Task::Weigh)?;
    let mut load = firmware.payload.inertia().parameters();
    load.iter_mut()
        .zip(tare)
        .for_each(|(load, tare)| *load -= tare);
    let found = BodyInertia::about_com(&SpatialInertia::from_parameters(load));
    let apart = |i: usize| found.com[i] - LOAD.com[i];
    let distance = libm::sqrtf((0..3).map(|i| apart(i) * apart(i)).sum());
    Some(Outcome {
        errors: [validation(&nominal), validation(&learned)],
        rejected,
        load: [found.mass, distance],
    })
}
