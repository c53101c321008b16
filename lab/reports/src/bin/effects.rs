//! Prints the torque that each effect contributes on an arm's pick and place, as lines
//! `effect ROBOT NAME RMS`: `cargo xtask effects` puts them into docs/effects.md.

use std::marker::PhantomData;

use dynamics_core::Core;
use dynamics_core::effects::{Effect, JointState, RIGID_BODY};
use dynamics_core::model::{Robot, model};
use dynamics_core::robots::{Panda, Ur5e};
use dynamics_core::state::State;
use firmware_demo::scene::TICK;
use firmware_demo::trajectories::PICK_AND_PLACE;
use fixtures::effect_presets::{self, RIGID, Visitor};
use fixtures::trajectories::PANDA_PICK_AND_PLACE;
use motion_control::limits::MotionLimits;
use motion_control::reference::{Trajectory, WayPoint};

/// Greatest acceleration of each joint, rad/s², as in the scene `ur5e`.
const ACCELERATION: f32 = 12.0;

/// The states of an arm's trajectory, tick by tick.
struct Reference<T, const N: usize> {
    states: Vec<State<f32, N, N>>,
    robot: PhantomData<T>,
}

impl<T: Robot<N, N, N>, const N: usize> Visitor<N> for Reference<T, N> {
    /// √(mean of |Δτ|²) over the ticks, |Δτ|² summed over the joints.
    fn scene<E: Effect<f32, N, N>>(&mut self, name: &'static str, mut effects: E) {
        if name == RIGID {
            return;
        }
        let mut sum = 0.0;
        for state in &self.states {
            let with = Core::<T>::rnea(state, &effects);
            let without = Core::<T>::rnea(state, &RIGID_BODY);
            let pairs = with.iter().zip(without);
            sum += pairs.map(|(a, b)| f64::from(a - b).powi(2)).sum::<f64>();
            for joint in 0..N {
                let at = JointState::new(state.q[joint], state.qd[joint]);
                effects.advance(joint, at, TICK);
            }
        }
        let rms = (sum / self.states.len() as f64).sqrt();
        println!("effect {} {name} {rms:.6}", T::MODEL.name);
    }
}

fn main() {
    every::<Ur5e, 6, 9, 5>(&PICK_AND_PLACE);
    every::<Panda, 7, 7, 6>(&PANDA_PICK_AND_PLACE);
}

/// Prints a line for each effect, along the trajectory through these points.
fn every<T: Robot<N, N, N>, const N: usize, const W: usize, const TIP: usize>(
    points: &[WayPoint<f32, N>; W],
) {
    let limits = model::<f32, T, N, N, N>()
        .links
        .map(|link| MotionLimits { velocity: link.limits.velocity, acceleration: ACCELERATION });
    let trajectory = Trajectory::new(points, TICK, &limits).expect("the arm can go there");
    let ticks = 0..=trajectory.ticks();
    let reference = &mut Reference::<T, N> {
        states: ticks.map(|tick| trajectory.at(tick)).collect(),
        robot: PhantomData,
    };
    effect_presets::rigid(reference);
    effect_presets::joints(reference);
    effect_presets::bodies::<N, TIP>(reference);
    effect_presets::spinning(reference);
}
