//! The reference of the simulations that `cargo xtask accuracy` compares.

use dynamics_core::effects::RIGID_BODY;
use dynamics_core::robots::Ur5e;
use fixtures::accuracy::simulation::{DoublePendulum, PassiveMotion};
use host_tests::measured::largest;
use host_tests::true_motion::{FINE, SAMPLE, SECOND, true_motion};

/// The double pendulum by Lagrange's equations, angles from the vertical, the second's relative to
/// the first.
fn lagrange() -> Vec<[[f64; 2]; 2]> {
    let (m, l, c, i, g) = (1.0, 0.5, 0.25, 1.0 / 48.0, 9.81);
    let acceleration = |[q, qd]: [[f64; 2]; 2]| -> [f64; 2] {
        let (a, b) = (i + m * c * c + m * l * l, i + m * c * c);
        let (cross, sine) = (m * l * c * q[1].cos(), m * l * c * q[1].sin());
        let mass = [[a + b + 2.0 * cross, b + cross], [b + cross, b]];
        let weight = m * g * c * (q[0] + q[1]).sin();
        let bias = [
            -sine * (2.0 * qd[0] * qd[1] + qd[1] * qd[1]) + m * g * (c + l) * q[0].sin() + weight,
            sine * qd[0] * qd[0] + weight,
        ];
        let det = mass[0][0] * mass[1][1] - mass[0][1] * mass[1][0];
        [
            (-bias[0] * mass[1][1] + bias[1] * mass[0][1]) / det,
            (-bias[1] * mass[0][0] + bias[0] * mass[1][0]) / det,
        ]
    };
    let plus = |[q, qd]: [[f64; 2]; 2], [dq, dqd]: [[f64; 2]; 2], h: f64| {
        [[q[0] + h * dq[0], q[1] + h * dq[1]], [qd[0] + h * dqd[0], qd[1] + h * dqd[1]]]
    };
    let slope = |at: [[f64; 2]; 2]| [at[1], acceleration(at)];
    let mut at = DoublePendulum::START;
    let h = f64::from(FINE) * 1e-6;
    let samples = (0..SECOND).map(|_| {
        for _ in 0..SAMPLE / FINE {
            let first = slope(at);
            let second = slope(plus(at, first, h / 2.0));
            let third = slope(plus(at, second, h / 2.0));
            let last = slope(plus(at, third, h));
            for (slope, share) in [(first, 6.0), (second, 3.0), (third, 3.0), (last, 6.0)] {
                at = plus(at, slope, h / share);
            }
        }
        at
    });
    samples.collect()
}

/// The reference of the simulations agrees with equations of another kind, and does not depend on
/// its step.
#[test]
fn true_motions_agree_with_lagrange_and_longer_steps() {
    fn apart<const N: usize>(a: &[[[f64; N]; 2]], b: &[[[f64; N]; 2]]) -> f64 {
        let pairs = a.iter().zip(b).flat_map(|(a, b)| a[0].into_iter().zip(b[0]));
        largest(pairs.map(|(a, b)| (a - b).abs()))
    }
    fn coarser<T: PassiveMotion<N>, const N: usize>() -> f64 {
        let motion = |step| true_motion::<T, _, N>(&RIGID_BODY, step);
        apart(&motion(FINE), &motion(2 * FINE))
    }
    let pendulum = true_motion::<DoublePendulum, _, 2>(&RIGID_BODY, FINE);
    let errors = [
        ("true motion from Lagrange's", apart(&pendulum, &lagrange())),
        ("true motion of the pendulum at twice the step", coarser::<DoublePendulum, 2>()),
        ("true motion of the UR5e at twice the step", coarser::<Ur5e, 6>()),
    ];
    for (what, error) in errors {
        assert!(error <= 1e-9, "{what}: {error:.1e} rad");
    }
}
