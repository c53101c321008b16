//! Claims about single parts of the control layer: what they forget, and what they keep to second
//! order.

use dynamics_core::Core;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::robots::Ur5e;
use host_tests::measured::largest;
use motion_control::estimate::{Observer, ObserverConfig};
use motion_control::law::InertiaUpdate;

const H: f64 = 1e-3;
/// Both poles at β = exp(−ω h): e_{n+2} = 2β e_{n+1} − β² e_n, of a late measurement too.
#[test]
fn a_late_observer_has_both_poles_at_its_bandwidth() {
    for bandwidth in [50.0, 150.0, 400.0] {
        let mut observer = Observer::<f64, 1>::new(ObserverConfig { bandwidth, tick: H });
        observer.reset(&[1.0]);
        let positions = (0..60).map(|_| observer.update_delayed(&[0.0], &[0.0]).q[0]);
        let e: Vec<f64> = positions.collect();
        // Sums that yield trace and determinant of the recurrence: two equations of one error each.
        let [a, b] = [0, 5].map(|n| [e[n + 1], -e[n], e[n + 2]]);
        let det = a[0] * b[1] - a[1] * b[0];
        let trace = (a[2] * b[1] - a[1] * b[2]) / det;
        let product = (a[0] * b[2] - a[2] * b[0]) / det;
        let beta = (-bandwidth * H).exp();
        // The observer's exponential ends with the fifth power of ω h.
        let rest = (bandwidth * H).powi(6) / 720.0;
        assert!((trace - 2.0 * beta).abs() < 2.5 * rest, "{bandwidth}: {trace}");
        assert!((product - beta * beta).abs() < 2.5 * rest, "{bandwidth}: {product}");
    }
}

// M is held and acts on the present acceleration.
#[test]
fn between_updates_the_bias_is_extrapolated_linearly() {
    let m = Core::<Ur5e>::crba(&[0.0_f64, -1.2, 1.5, 0.3, 0.1, 0.0], &RIGID_BODY);
    let torque = |bias: f64, qdd: f64| m.mul_vec(&[qdd; 6]).map(|inertial| bias + inertial);
    let mut between = InertiaUpdate::<f64, 6, 4>::start();
    between.update(torque(3.0, 1.0), m, &[1.0; 6]);
    between.update(torque(5.0, -2.0), m, &[-2.0; 6]);
    for (bias, qdd) in [(5.5, 0.5), (6.0, 7.0), (6.5, 0.0)] {
        let held = between.hold(&[qdd; 6]);
        let error = largest(held.iter().zip(torque(bias, qdd)).map(|(a, b)| (a - b).abs()));
        assert!(error < 2e-14, "{bias}: {error:e}");
    }
}
