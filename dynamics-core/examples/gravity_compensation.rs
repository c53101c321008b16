//! Gravity compensation: the torques that support an arm's own weight, so that it can be guided by
//! hand.
//!
//! `cargo run -p dynamics-core --example gravity_compensation`

use dynamics_core::Engine;
use dynamics_core::effects::Gravity;
use dynamics_core::model::{ArmModel, BASE, Body, Joint, Model, Robot};
use dynamics_core::state::State;

/// A shoulder and an elbow that rotate about y; at q = 0 both links hang down.
struct TwoLinks;
impl Robot<2, 2, 2> for TwoLinks {
    const MODEL: ArmModel<f64, 2> = Model::new(
        "two links",
        [
            Body::new("upper arm", BASE, Joint::revolute([0.0, 1.0, 0.0]))
                .mass(1.5)
                .com([0.0, 0.0, -0.2]),
            Body::new("forearm", 0, Joint::revolute([0.0, 1.0, 0.0]))
                .xyz([0.0, 0.0, -0.4])
                .mass(0.8)
                .com([0.0, 0.0, -0.15]),
        ],
    );
}
const _: ArmModel<f64, 2> = TwoLinks::MODEL; // `cargo check` now reports a description that is wrong

/// The computation of each tick: the torques at the measured positions, N·m.
fn compensation(q: [f32; 2]) -> [f32; 2] {
    // Gravity is the only effect, so that no other term is in the machine code.
    Engine::<TwoLinks>::rnea(&State::at(q), &Gravity::EARTH)
}

fn main() {
    println!("shoulder  elbow, rad | shoulder  elbow, N·m");
    for [shoulder, elbow] in [[0.0_f32, 0.0], [0.5, 0.3], [-1.57, 0.0], [-1.0, -1.2]] {
        let tau = compensation([shoulder, elbow]);
        println!("{shoulder:8.2} {elbow:6.2}      | {:8.3} {:6.3}", tau[0], tau[1]);

        // The same by hand: weight times horizontal distance.
        let (upper, both) = (shoulder.sin(), (shoulder + elbow).sin());
        let at_elbow = 9.81 * 0.8 * 0.15 * both;
        let at_shoulder = 9.81 * (1.5 * 0.2 + 0.8 * 0.4) * upper + at_elbow;
        assert!((tau[0] - at_shoulder).abs() < 1e-5);
        assert!((tau[1] - at_elbow).abs() < 1e-5);
    }
}
