//! The actuator: its lag and its torque-speed curve in closed form.

use super::*;
use dynamics_core::effects::Inertia;
use dynamics_core::sim::{Actuator, semi_implicit};

fn drive<R: Real>() -> Actuator<R> {
    Actuator {
        torque_constant: R::from_f64(2.0),
        current_limit: R::from_f64(10.0),
        voltage: R::from_f64(48.0),
        resistance: R::from_f64(1.2),
        lag: R::from_f64(2e-3),
        current: R::ZERO,
    }
}

#[test]
fn the_current_rises_exponentially_whatever_the_step() {
    fn worst<R: Real>(h: f64) -> Worst {
        let (mut drive, mut worst) = (drive::<R>(), Worst::default());
        for i in 1..=(0.02 / h) as u32 {
            drive.advance(R::from_f64(12.0), R::ZERO, R::from_f64(h));
            let want = 12.0 * (1.0 - (-f64::from(i) * h / 2e-3).exp());
            worst.see(drive.torque().to_f64(), want);
        }
        worst
    }
    worst::<f64>(1e-3).check::<f64>("actuator", "lag");
    worst::<f64>(1e-5).check::<f64>("actuator", "lag in fine steps");
    worst::<f32>(1e-3).check::<f32>("actuator", "lag");
}

#[test]
fn torque_follows_back_emf_within_the_current_limit() {
    let drive = drive::<f64>();
    for i in -400..=400 {
        let speed = f64::from(i) * 0.1;
        let line = |sign: f64| 2.0 * (sign * 48.0 - 2.0 * speed) / 1.2;
        for command in [-1e3, -15.0, 0.0, 3.0, 1e3] {
            let want = f64::clamp(command, -20.0, 20.0).clamp(line(-1.0), line(1.0));
            assert!((drive.saturated_torque(command, speed) - want).abs() < 1e-12);
        }
    }
}

#[test]
fn a_motor_runs_up_to_its_no_load_speed() {
    // Beyond the corner J ω̇ = k (U − k ω)/R: an exponential, here without lag.
    let mut drive = Actuator { lag: 1e-9, current_limit: 1e3, ..drive::<f64>() };
    let (mut wheel, h, mut worst) = (State::at([0.0]), 1e-5, Worst::default());
    let rate = 2.0 * 2.0 / 1.2 / 2.0;
    for i in 1..=300_000 {
        drive.advance(1e3, wheel.qd[0], h);
        semi_implicit(&SLEDGE, &mut wheel, &[drive.torque()], &(Inertia,), h).unwrap();
        worst.see(wheel.qd[0], 24.0 * (1.0 - (-rate * h * f64::from(i)).exp()));
    }
    worst.check::<f64>("actuator", "run-up");
}
