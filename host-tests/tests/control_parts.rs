//! Claims about single parts of the control layer: what they forget, and what they keep to second
//! order.

use dynamics_core::Core;
use dynamics_core::effects::RIGID_BODY;
use dynamics_core::robots::Ur5e;
use dynamics_core::state::State;
use host_tests::measured::{largest, within};
use motion_control::{
    InertiaUpdate, MotionController, MotionControllerConfig, MotionLimits, Observer,
    ObserverConfig, Reference, RestToRest, SafetyLimits, SupervisorConfig, TrajectoryError,
    WayPoint,
};

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
        assert!(
            (trace - 2.0 * beta).abs() < 2.5 * rest,
            "{bandwidth}: {trace}"
        );
        assert!(
            (product - beta * beta).abs() < 2.5 * rest,
            "{bandwidth}: {product}"
        );
    }
}

#[test]
fn a_late_position_is_extrapolated_by_the_speed() {
    let mut observer = Observer::<f64, 1>::new(ObserverConfig {
        bandwidth: 250.0,
        tick: H,
    });
    let position = |tick: u32| 0.5 + 2.0 * H * f64::from(tick);
    for tick in 1..400 {
        observer.update_delayed(&[position(tick - 1)], &[0.0]);
    }
    for _ in 400..420 {
        observer.predict(&[0.0]);
    }
    let before = *observer.estimate();
    observer.correct_position_delayed(&[position(419) + 0.1]);
    let after = observer.estimate();
    assert_eq!(after.qd, before.qd);
    assert!(
        (after.q[0] - position(420) - 0.1).abs() < 1e-12,
        "{after:?}"
    );
}

#[test]
fn a_smooth_motion_needs_limits_above_its_peaks() {
    let stop = |q, ticks| WayPoint {
        q: [q],
        qd: [0.0],
        ticks,
    };
    let points = [stop(0.0, 0), stop(1.7, 800)];
    let motion = |velocity, acceleration| {
        let limits = MotionLimits {
            velocity,
            acceleration,
        };
        RestToRest::<f64, 1, 2>::new(&points, H, &[limits])
    };
    let free = motion(100.0, 1000.0).unwrap();
    let peak = |of: fn(State<f64, 1, 1>) -> f64| {
        largest((0..=800).map(|tick| of(Reference::at(&free, tick)).abs()))
    };
    let (speed, acceleration) = (peak(|at| at.qd[0]), peak(|at| at.qdd[0]));
    assert!(motion(1.001 * speed, 1.001 * acceleration).is_ok());
    let slow = motion(0.999 * speed, 1.001 * acceleration);
    assert!(
        matches!(slow, Err(TrajectoryError::Velocity { .. })),
        "{slow:?}"
    );
    let weak = motion(1.001 * speed, 0.999 * acceleration);
    assert!(
        matches!(weak, Err(TrajectoryError::Acceleration { .. })),
        "{weak:?}"
    );
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
        let error = largest(
            held.iter()
                .zip(torque(bias, qdd))
                .map(|(a, b)| (a - b).abs()),
        );
        assert!(error < 2e-14, "{bias}: {error:e}");
    }
}

/// A motion of constant acceleration, which two derivatives tell in full.
struct Falling;

const FALL: f64 = 400.0; // rad/s²

impl Reference<f64, 1> for Falling {
    fn at(&self, tick: u32) -> State<f64, 1, 1> {
        let t = H * f64::from(tick);
        State {
            q: [0.5 * FALL * t * t],
            qd: [FALL * t],
            qdd: [FALL],
        }
    }
    fn ticks(&self) -> u32 {
        u32::MAX
    }
}

/// From rest at 0 the trajectory is r = w q(σ), with σ' = w: σ is known in closed form.
// The reference is read between ticks too.
#[test]
fn the_return_and_its_derivatives_have_their_closed_form() {
    const TICKS: u32 = 200;
    let mut controller = MotionController::<f64, 1>::new(MotionControllerConfig {
        supervisor: SupervisorConfig {
            limits: SafetyLimits {
                torque: [1.0],
                rate: [1.0],
                speed: [1e3],
                lower: [-1.0],
                upper: [1.0],
            },
            tick: H,
            resolution: 0.0,
            ride_through_ticks: 0,
            hold_ticks: 0,
            reentry_ticks: TICKS,
        },
        observer_bandwidth: 250.0,
        // A speed that decays within a tick: the trajectory waits at its start.
        decay_rate: 2.0 / H,
        restart_distance: 0.1,
    })
    .on_brake();
    // The arm stands still at 0, in the tick before the reset too.
    controller.tick(Ok(&[0.0]), &Falling, |_, _| [0.0]);
    controller.reset(&Falling).expect("a stopped arm");
    let mut way = vec![];
    let mut errors = vec![];
    for tick in 0..TICKS {
        let x = f64::from(tick) / f64::from(TICKS);
        controller.tick(Ok(&[0.0]), &Falling, |_, _| [0.0]);
        let at = *controller.reference();
        let w = x.powi(3) * (10.0 - 15.0 * x + 6.0 * x * x);
        let sigma = H * f64::from(TICKS) * x.powi(4) * (2.5 - 3.0 * x + x * x);
        errors.push((at.q[0] - w * 0.5 * FALL * sigma * sigma).abs());
        way.push(at);
    }
    let scale = largest(way.iter().map(|at| at.q[0].abs()));
    within(
        "position on the way, of full scale",
        largest(errors) / scale,
        1e-5,
    );
    // Central differences, to h²/6 of the third derivative from there.
    let slope =
        |f: fn(&State<f64, 1, 1>) -> f64, n: usize| (f(&way[n + 1]) - f(&way[n - 1])) / (2.0 * H);
    let inner = 1..way.len() - 1;
    let rate = largest(
        inner
            .clone()
            .map(|n| (slope(|at| at.q[0], n) - way[n].qd[0]).abs()),
    );
    let bend = largest(inner.map(|n| (slope(|at| at.qd[0], n) - way[n].qdd[0]).abs()));
    let [speeds, bends] = [
        largest(way.iter().map(|at| at.qd[0].abs())),
        largest(way.iter().map(|at| at.qdd[0].abs())),
    ];
    within("q̇ against the slope of q", rate / speeds, 2e-4);
    within("q̈ against the slope of q̇", bend / bends, 1e-3);
}
