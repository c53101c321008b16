//! Computed torque: feedback as an acceleration, so that the same gains are right in every
//! configuration.
//!
//! `cargo run -p dynamics-core --example computed_torque`

use dynamics_core::effects::{RIGID_BODY, Viscous};
use dynamics_core::sim::linearly_implicit;
use dynamics_core::state::State;
use dynamics_core::{Core, model::Robot, robots::A1Leg};

const TICK: f32 = 1e-3;

/// The torques that let each joint follow its reference as a damped oscillator, N·m.
///
/// On a microcontroller, `Engine` in place of `Core` takes a fraction of the cycles for the same
/// result.
fn control(reference: &State<f32, 3, 3>, q: &[f32; 3], qd: &[f32; 3]) -> [f32; 3] {
    let (omega, zeta) = (30.0, 1.0); // rad/s, and no overshoot
    let mut wanted = State { q: *q, qd: *qd, qdd: reference.qdd };
    for joint in 0..3 {
        let (error, rate) = (reference.q[joint] - q[joint], reference.qd[joint] - qd[joint]);
        wanted.qdd[joint] += omega * (omega * error + 2.0 * zeta * rate);
    }
    Core::<A1Leg>::rnea(&wanted, &RIGID_BODY)
}

fn main() {
    // Friction that the controller does not know.
    let mut plant = (RIGID_BODY, Viscous([0.02_f32; 3]));
    let mut leg = State::at([0.2_f32, 0.6, -1.4]); // 0.1 rad off in every joint
    println!("  time, s | largest error, mrad");
    for tick in 0..=1000_u16 {
        let t = f32::from(tick) * TICK;
        let (s, c) = (3.0 * t).sin_cos();
        let reference = State {
            q: [0.1 + 0.2 * s, 0.7 + 0.3 * s, -1.5 + 0.4 * s],
            qd: [0.6 * c, 0.9 * c, 1.2 * c],
            qdd: [-1.8 * s, -2.7 * s, -3.6 * s],
        };
        let errors = [0, 1, 2].map(|joint| (reference.q[joint] - leg.q[joint]).abs());
        let error = errors.into_iter().fold(0.0, f32::max);
        if tick % 200 == 0 {
            println!("{t:9.1} | {:8.2}", 1e3 * error);
        }
        assert!(tick < 400 || error < 6e-3, "{error} rad at {t} s");
        let tau = control(&reference, &leg.q, &leg.qd);
        linearly_implicit(&A1Leg::MODEL_F32, &mut leg, &tau, &mut plant, TICK)
            .expect("every joint of the leg moves some mass");
    }
    println!("at the end: {:?} rad", leg.q);
}
