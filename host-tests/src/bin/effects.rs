//! Prints the torque that each effect contributes on the UR5e's pick and place, as lines `effect NAME RMS`:
//! `cargo xtask effects` puts them into docs/effects.md.

use dynamics_core::Core;
use dynamics_core::control::{Speed, Trajectory};
use dynamics_core::effects::{Effect, JointState, RIGID_BODY};
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use firmware_demo::catalogue::{self, RIGID, Visitor};
use firmware_demo::scene::TICK;
use firmware_demo::trajectories::PICK_AND_PLACE;

/// The states of the trajectory, tick by tick.
struct Reference(Vec<State<f32, 6, 6>>);

impl Visitor<6> for Reference {
    /// √(mean of |Δτ|²) over the ticks, |Δτ|² summed over the joints.
    fn scene<E: Effect<f32, 6, 6>>(&mut self, name: &'static str, mut effects: E) {
        if name == RIGID {
            return;
        }
        let mut sum = 0.0;
        for state in &self.0 {
            let with = Core::<Ur5e>::rnea(state, &effects);
            let without = Core::<Ur5e>::rnea(state, &RIGID_BODY);
            let squares = with.iter().zip(without);
            sum += squares.map(|(a, b)| f64::from(a - b).powi(2)).sum::<f64>();
            for joint in 0..6 {
                let at = JointState {
                    q: state.q[joint],
                    qd: state.qd[joint],
                    qdd: state.qdd[joint],
                };
                effects.advance(joint, at, TICK);
            }
        }
        println!("effect {name} {:.6}", (sum / self.0.len() as f64).sqrt());
    }
}

fn main() {
    // Limits are the scene's to check.
    let any = [Speed {
        velocity: f32::MAX,
        acceleration: f32::MAX,
    }; 6];
    let trajectory =
        Trajectory::new(&PICK_AND_PLACE, TICK, &any).expect("nothing exceeds these limits");
    let ticks = 0..=trajectory.ticks();
    let mut reference = Reference(ticks.map(|tick| trajectory.at(tick)).collect());
    catalogue::rigid(&mut reference);
    catalogue::joints(&mut reference);
    catalogue::bodies(&mut reference);
    catalogue::spinning(&mut reference);
}
