//! Points of zero inertia, friction, and limits between grid points.

use super::*;

/// M q̈ of two coupled joints, and a load of gravity on the second one.
fn coupled(state: &State<f64, 2, 2>) -> [f64; 2] {
    let [x, y] = state.qdd;
    [2.0 * x + 0.8 * y, 0.8 * x + 0.6 * y + 1.5 * state.q[1].cos()]
}

/// The greatest share of a limit of torque in all ticks, with this inverse dynamics.
fn share<const V: usize, P: GeometricPath<f64, V>, const M: usize>(
    timed: &TimedPath<'_, f64, P, M>,
    torque: &[f64; V],
    id: impl Fn(&State<f64, V, V>) -> [f64; V],
) -> f64 {
    let mut most = 0.0_f64;
    for k in 0..timed.ticks() {
        let tau = id(&timed.at(k));
        for (tau, limit) in tau.iter().zip(torque) {
            most = most.max(tau.abs() / limit);
        }
    }
    most
}

/// An arc on which the inertia of the second joint along the path, 0.8 q₁′ + 0.6 q₂′, changes its
/// sign twice.
fn arc(s: f64) -> [[f64; 2]; 3] {
    let (sin, cos) = (5.0 * s).sin_cos();
    [[sin, cos], [5.0 * cos, -5.0 * sin], [-25.0 * sin, -25.0 * cos]]
}

#[test]
fn a_point_of_zero_inertia_is_no_special_case() {
    let (path, limits) = (Curve(arc), torques([6.0, 2.4]));
    let inertia = |s: f64| {
        let [_, [x, y], _] = arc(s);
        0.8 * x + 0.6 * y
    };
    let signs = (0..400).filter(|&k| {
        let s = f64::from(k) / 400.0;
        inertia(s) * inertia(s + 1.0 / 400.0) < 0.0
    });
    assert_eq!(signs.count(), 2);
    let coarse = TimedPath::<_, _, 101>::new(&path, 1e-4, &limits, coupled).unwrap();
    let fine = TimedPath::<_, _, 3201>::new(&path, 1e-4, &limits, coupled).unwrap();
    let lost = coarse.seconds() / fine.seconds() - 1.0;
    let excess = [share(&coarse, &limits.torque, coupled), share(&fine, &limits.torque, coupled)];
    std::println!("{lost:e} {excess:?}");
    assert!((0.0..0.01).contains(&lost), "{lost:e}");
    assert!(excess[0] < 1.002 && excess[1] < 1.000002, "{excess:?}");
    // The second joint is at its limit near its point of zero inertia, and the first one elsewhere.
    assert!(excess.iter().all(|excess| *excess > 0.9999));
}

#[test]
fn a_grid_point_of_zero_inertia_exactly_bounds_x() {
    // The second joint has no inertia along this line, and centrifugal torque −2 x along it: x ≤
    // 3/2.
    let path = Curve(|s: f64| [[s, 0.0], [1.0, 0.0], [0.0, 0.0]]);
    let id = |state: &State<f64, 2, 2>| [0.01 * state.qdd[0], -2.0 * state.qd[0] * state.qd[0]];
    let timed = TimedPath::<_, _, 101>::new(&path, 1e-3, &torques([1.0, 3.0]), id).unwrap();
    let most = (0..101).map(|k| timed.square_rate(k)).fold(0.0, f64::max);
    assert!(share_off(most, 1.5) < 1e-12, "{most}");
}

// It is part of the torques that are limited.
#[test]
fn friction_helps_only_as_far_as_it_is_certain() {
    let (d, tau, coulomb, viscous) = (2.0, 10.0, 2.0, 1.5);
    let path = line(d);
    let real = |state: &State<f64, 1, 1>| {
        let qd = state.qd[0];
        [2.5 * state.qdd[0] + viscous * qd + coulomb * qd.signum() * f64::from(qd != 0.0)]
    };
    // The fastest motion, by small steps: with all torque forward, and from the end with all torque
    // backward.
    let fastest = |certain: f64| {
        let (mut x, mut down, h) = (vec![0.0], vec![0.0], 1e-5);
        for _ in 0..(d / h) as usize {
            let (v, w) = (x[x.len() - 1], down[down.len() - 1]);
            x.push(v + 2.0 * h * (tau - coulomb - viscous * f64::sqrt(v)) / 2.5);
            down.push(w + 2.0 * h * (tau + certain * (coulomb + viscous * f64::sqrt(w))) / 2.5);
        }
        let least = x.iter().zip(down.iter().rev()).map(|(x, w)| x.min(*w).sqrt());
        let rates: Vec<f64> = least.collect();
        rates.windows(2).map(|w| 2.0 * h / (w[0] + w[1])).sum::<f64>()
    };
    let timed = |certain, velocity| {
        let limits = PathLimits {
            friction: [friction(coulomb, viscous, certain)],
            motion: [MotionLimits { velocity, ..ANY }],
            ..torques([tau])
        };
        let timed = TimedPath::<_, _, 201>::new(&path, 1e-3, &limits, inertia).unwrap();
        (timed.seconds(), share(&timed, &[tau], real))
    };
    for (certain, lost) in [(0.0, [0.005, 0.01]), (1.0, [0.03, 0.03])] {
        let best = fastest(certain);
        let (seconds, most) = timed(certain, f64::INFINITY);
        let (near, nearly_most) = timed(certain, 2.2); // just above the peak
        std::println!("{certain}: {best} {seconds} {near} {most} {nearly_most}");
        for (seconds, lost) in [seconds, near].into_iter().zip(lost) {
            let share = seconds / best - 1.0;
            assert!((0.0..lost).contains(&share), "{share}");
        }
        assert!(most.max(nearly_most) < 1.0 + 1e-9, "{most} {nearly_most}");
    }
    assert!(timed(1.0, 2.2).0 < timed(0.0, 2.2).0);
}
