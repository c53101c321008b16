use dynamics_core::Core;
use dynamics_core::algorithms::{Conditioning, frame, jacobian_rows};
use dynamics_core::effects::{Armature, Inertia};
use dynamics_core::robots::Ur5e;
use dynamics_core::scalar::Real;

use super::*;

const STIFFNESS: [f64; 6] = [30.0, 30.0, 30.0, 600.0, 600.0, 600.0];

fn law<R: Real>() -> CartesianImpedance<R, 6> {
    let stiffness = STIFFNESS.map(R::from_f64);
    let [zeta, slowest] = [0.7, 2.0].map(R::from_f64);
    CartesianImpedance::try_new(ImpedanceConfig {
        stiffness,
        zeta,
        slowest,
    })
    .expect("a good one")
}

/// The torques of the damper alone at a posture.
fn damped<R: Real>(law: &mut CartesianImpedance<R, 6>, q: &[R; 6], rate: &[R; 6], rotors: R) -> ImpedanceTorque<R, 6> {
    let rows = jacobian_rows(&Core::<Ur5e>::jacobian(q, 5, frame::LocalWorldAligned));
    let m = Core::<Ur5e>::crba(q, &(Inertia, Armature([rotors; 6])));
    let factors = Core::<Ur5e>::ltdl(&m).expect("an arm with mass");
    let deviation = TaskDeviation { position: [R::ZERO; 6], velocity: *rate };
    let solve = |tau: &_| Core::<Ur5e>::solve(&factors, tau);
    law.torque(&rows, solve, &deviation, &[R::ZERO; 6], &[R::ZERO; 6]).expect("finite")
}

fn run<R: Real>(rotors: f64, speed: f64) {
    let (mut follows, mut worst, mut passes, mut coupling) = (law::<R>(), 0.0_f64, [0; 9], 0.0_f64);
    let (mut regular, mut worst_at, mut torque_most) = (0, 0, 0.0_f64);
    for k in 0..10_000 {
        let t = 1e-3 * f64::from(k);
        let q: [f64; 6] = core::array::from_fn(|i| {
            let w = 1.0 + 0.37 * i as f64;
            [0.2, -1.2, 0.0, 0.3, 0.7, 0.1][i] + speed / w * (w * t).sin()
        });
        let rate: [f64; 6] = core::array::from_fn(|i| if i < 3 { 0.5 } else { 0.2 } * (3.0 * t + 2.0 * i as f64).sin());
        let got = damped(&mut follows, &q.map(R::from_f64), &rate.map(R::from_f64), R::from_f64(rotors));
        let mut fresh = law::<f64>();
        let want = damped(&mut fresh, &q, &rate, rotors);
        if got.conditioning == Conditioning::Regular { regular += 1; }
        passes[got.passes] += 1;
        coupling = coupling.max(got.coupling.to_f64().sqrt());
        for (got, want) in got.tau.iter().zip(want.tau) {
            let e = (got.to_f64() - want).abs();
            torque_most = torque_most.max(want.abs());
            if e > worst { worst = e; worst_at = k; }
        }
    }
    std::println!("rotors {rotors} speed {speed}: worst {worst:e} of {torque_most} at {worst_at}, passes {passes:?} coupling {coupling:e} regular {regular}");
}

#[test]
fn trial() {
    for rotors in [0.3, 0.0] { for speed in [1.0, 3.0] {
        run::<f32>(rotors, speed);
        run::<f64>(rotors, speed);
    } }
}
