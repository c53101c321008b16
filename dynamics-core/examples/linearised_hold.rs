//! The least stiffness of the feedback that holds a posture, from ∂τ/∂q of gravity.
//!
//! `cargo run -p dynamics-core --example linearised_hold`

use dynamics_core::algorithms::rnea_derivatives;
use dynamics_core::effects::Gravity;
use dynamics_core::{model::Robot, robots::Ur5e, state::State};

/// The least k ≥ 0 at which ∂τ/∂q + k 1 is not negative in any direction, N·m/rad: the negative of
/// the least eigenvalue of a symmetric matrix, by the power method on a positive definite one.
fn least_gain(by_q: &[[f64; 6]; 6]) -> f64 {
    let size = by_q.iter().flatten().fold(0.0_f64, |sum, x| sum + x.abs());
    let (mut x, mut largest) = ([1.0, 0.7, 0.5, 0.3, 0.2, 0.1], 0.0);
    for _ in 0..2000 {
        let y = by_q.map(|row| row.iter().zip(&x).map(|(a, x)| -a * x).sum::<f64>());
        let shifted: [f64; 6] = core::array::from_fn(|i| y[i] + size * x[i]);
        largest = shifted.iter().map(|x| x * x).sum::<f64>().sqrt();
        x = shifted.map(|x| x / largest);
    }
    (largest - size).max(0.0)
}

fn main() {
    println!(
        "posture                | stiffness of gravity at the shoulder | a feedback must exceed"
    );
    let quarter = core::f64::consts::FRAC_PI_2;
    let mut gains = Vec::new();
    for (name, shoulder, elbow) in [
        ("hangs", quarter, 0.0),
        ("lies straight out", 0.0, 0.0),
        ("elbow up", -1.2, 1.5),
        ("stands on end", -quarter, 0.0),
    ] {
        let state = State::at([0.0, shoulder, elbow, 0.0, 0.0, 0.0]);
        let by = rnea_derivatives(&Ur5e::MODEL, &state, &Gravity::EARTH);
        let gain = least_gain(&by.dq);
        println!("{name:22} | {:27.1} N·m/rad | {:12.1} N·m/rad", by.dq[1][1], gain);
        gains.push(gain);
    }
    // The arm that hangs needs no feedback, the one that stands on end needs most.
    assert!(gains[0] < 1.0 && gains.iter().all(|&gain| gain <= gains[3]));
}
