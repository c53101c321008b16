//! The claims of the scenes' machines: momentum is conserved, and a ship does not turn the camera.

use crate::common::*;
use dynamics_core::algorithms::{momentum, poses};
use dynamics_core::effects::{Armature, Coriolis, Coulomb, Inertia, Viscous, Width};
use dynamics_core::model::{Calibrated, Robot, Static};
use dynamics_core::scalar::{Real, Vector};
use dynamics_core::sim::{linearly_implicit, momentum_preserving};
use dynamics_core::spatial::Force;
use dynamics_core::state::State;
use firmware_demo::plant::{self, Plant, Simulated};
use firmware_demo::robots::ship::Swing;
use firmware_demo::robots::{Gimbal, Ship, SpaceArm};
use firmware_demo::scene::{Scene, TICK};
use firmware_demo::scenes::space_arm::{EFFECTS, ReachOut};
use firmware_demo::trajectories::STOWED;
use firmware_demo::trajectories::watch::Watch;
use glam::{DMat3, DVec3};
use host_tests::measured::largest;

type Floating<R> = State<R, 13, 12>;

/// The scene's effects in this scalar.
fn acting<R: Real>() -> (Inertia, Coriolis, Viscous<R, 12>, Coulomb<R, 12>, Armature<R, 12>) {
    let (inertia, coriolis, viscous, coulomb, rotors) = EFFECTS;
    let cast = |x: f32| R::from_f64(f64::from(x));
    let coulomb =
        Coulomb { torque: coulomb.torque.map(cast), width: Width::new(cast(coulomb.width.get())) };
    (inertia, coriolis, Viscous(viscous.0.map(cast)), coulomb, Armature(rotors.0.map(cast)))
}

/// 60 s of the scene's way, again and again, under its feed-forward and feedback, in `steps` steps
/// a tick: the largest momentum about the origin, angular and linear, each as a share of the
/// largest that the arm has beside a satellite at rest. `step` is given the joints' torques and the
/// seconds.
fn drift<R: Real>(steps: u32, mut step: impl FnMut(&[f32; 6], R) -> Floating<R>) -> f64 {
    let (way, inertia) = (ReachOut::reference().unwrap(), ReachOut::inertia(&()));
    let h = R::from_f64(f64::from(TICK) / f64::from(steps));
    let size = |state: &Floating<R>| {
        let Force { ang, lin } = momentum(&Static::<SpaceArm>::NEW, state, &());
        [ang, lin].map(|v| DVec3::from(v.array().map(R::to_f64)).length())
    };
    let (mut lost, mut full) = ([0.0_f64; 2], [0.0_f64; 2]);
    let mut q = STOWED.map(f64::from);
    let mut qd = [0.0; 6];
    for tick in 0..60_000 {
        let wanted = way.at(tick % (way.ticks() + 1));
        let mut tau = ReachOut::inverse(&wanted, &(), &EFFECTS);
        for j in 0..6 {
            let (off, slow) = (f64::from(wanted.q[j]) - q[j], f64::from(wanted.qd[j]) - qd[j]);
            tau[j] += inertia[j] * (400.0 * off + 40.0 * slow) as f32;
        }
        let mut state = step(&tau, h);
        for _ in 1..steps {
            state = step(&tau, h);
        }
        q = core::array::from_fn(|j| state.q[7 + j].to_f64());
        qd = core::array::from_fn(|j| state.qd[6 + j].to_f64());
        let mut held = state;
        held.qd[..6].fill(R::ZERO);
        for (most, now) in [(&mut lost, size(&state)), (&mut full, size(&held))] {
            *most = core::array::from_fn(|k| largest([most[k], now[k]]));
        }
    }
    largest([lost[0] / full[0], lost[1] / full[1]])
}

/// The drift of the plain step.
fn plain<R: Real>(steps: u32) -> f64 {
    let (mut effects, mut state) = (acting::<R>(), start::<R>());
    drift::<R>(steps, |tau, h| {
        linearly_implicit(&Static::<SpaceArm>::NEW, &mut state, &wide(tau), &mut effects, h)
            .unwrap();
        state
    })
}

/// The satellite at the origin, the arm folded away.
fn start<R: Real>() -> Floating<R> {
    State::at(SpaceArm::at(STOWED).map(|q| R::from_f64(f64::from(q))))
}

/// Torques of the joints, and none on the satellite.
fn wide<R: Real>(tau: &[f32; 6]) -> [R; 12] {
    SpaceArm::joints(*tau).map(|tau| R::from_f64(f64::from(tau)))
}

// The loss falls down to a floor.
#[test]
fn plain_steps_lose_momentum_at_first_order() {
    let double = [1, 2, 4].map(plain::<f64>);
    for pair in double.windows(2) {
        let ratio = pair[0] / pair[1];
        assert!((ratio - 2.0).abs() < 0.02, "{ratio}: {double:?}");
    }
    let single = [1, 2, 4].map(plain::<f32>);
    assert!(single[0] > single[1] && single[1] > single[2], "{single:?}");
    let mut verdict = Verdict::default();
    verdict.see("space arm", "momentum lost by plain steps", "f64", &share(double[2]));
    verdict.see("space arm", "momentum lost by plain steps", "f32", &share(single[2]));
    verdict.speak();
}

/// In f32 it is the scene's own plant.
#[test]
fn momentum_preserving_steps_lose_no_momentum() {
    let mut verdict = Verdict::default();
    for steps in [1, 4] {
        let (mut effects, mut state) = (acting::<f64>(), start::<f64>());
        let lost = drift::<f64>(steps, |tau, h| {
            let arm = Static::<SpaceArm>::NEW;
            momentum_preserving(&arm, &mut state, &wide(tau), &mut effects, Force::ZERO, h)
                .unwrap();
            state
        });
        verdict.see("space arm", "momentum lost", "f64", &share(lost));

        let mut plant = ReachOut::plant(None);
        let lost = drift::<f32>(steps, |tau, h| {
            plant.step(tau, &(), h).unwrap();
            plant.0.state
        });
        verdict.see("space arm", "momentum lost", "f32", &share(lost));
    }
    verdict.speak();
}

fn share(error: f64) -> Worst {
    Worst { error, full_scale: 1.0 }
}

/// The ship's attitude, and the foot of its mast in the world.
fn pose(ship: &Ship<f64>, t: f64) -> (DMat3, DVec3) {
    let [yaw, pitch, roll] = [ship.yaw, ship.pitch, ship.roll].map(|swing| swing.at(t)[0]);
    let attitude =
        DMat3::from_rotation_z(yaw) * DMat3::from_rotation_y(pitch) * DMat3::from_rotation_x(roll);
    let foot = DVec3::Z * ship.heave.at(t)[0] + attitude * ship.mast;
    (attitude, foot)
}

#[test]
fn the_inertial_unit_measures_the_masts_motion() {
    let ship = Ship::<f64>::patrol_boat();
    let (mut velocity, mut acceleration, mut gravity) =
        (Worst::default(), Worst::default(), Worst::default());
    for second in 0..60 {
        let t = f64::from(second) * 1.13;
        let ((attitude, _), (g, base)) = (pose(&ship, t), ship.measured(t));
        let foot = slope(|dt| pose(&ship, t + dt).1.to_array());
        let v = attitude.transpose() * DVec3::from(foot);
        let turn = attitude.transpose()
            * DMat3::from_cols_array(&slope(|dt| pose(&ship, t + dt).0.to_cols_array()));
        let omega = DVec3::new(turn.y_axis.z, turn.z_axis.x, turn.x_axis.y);
        velocity.see(six(base.velocity), flat::<f64>(omega, v));
        // In the ship's own coordinates a spatial acceleration is the rate of the velocity's
        // numbers.
        let rate = slope(|dt| six(ship.measured(t + dt).1.velocity));
        acceleration.see(six(base.acceleration), rate);
        let weight = attitude.transpose() * DVec3::new(0.0, 0.0, -9.81);
        gravity.see(g.0.to_array(), weight.to_array());
    }
    let mut verdict = Verdict::default();
    verdict.see("ship", "velocity of the mast", "f64", &velocity);
    verdict.see("ship", "acceleration of the mast", "f64", &acceleration);
    verdict.see("ship", "gravity", "f64", &gravity);
    verdict.speak();
}

#[test]
fn the_watch_keeps_the_camera_level_and_on_its_sweep() {
    let watch = Watch::<f64> { ship: Ship::patrol_boat(), sweep: Swing::of(1.0, 8.0), ticks: 0 };
    let (mut level, mut rates) = (Worst::default(), Worst::default());
    for second in 0..60 {
        let t = f64::from(second) * 0.97;
        let State { q, qd, qdd } = watch.after(t);
        let [.., camera] = poses(&Gimbal::MODEL, &q);
        let attitude = pose(&watch.ship, t).0 * camera.rot;
        let wanted = DMat3::from_rotation_z(watch.sweep.at(t)[0]);
        level.see(attitude.to_cols_array(), wanted.to_cols_array());
        rates.see(qd, slope(|dt| watch.after(t + dt).q));
        rates.see(qdd, slope(|dt| watch.after(t + dt).qd));
    }
    let mut verdict = Verdict::default();
    verdict.see("watch", "attitude of the camera", "f64", &level);
    verdict.see("watch", "rates of the joints", "f64", &rates);
    verdict.speak();
}

#[test]
fn the_environment_acts_on_a_robot_that_floats() {
    let still = |resistance: f32| {
        let effects = (Inertia, Coriolis, Viscous([0.0_f32; 12]));
        let apply: fn(&mut _, &f32) = |effects: &mut (Inertia, Coriolis, Viscous<f32, 12>), x| {
            effects.2.0[6..].fill(*x);
        };
        let robot = Calibrated::<SpaceArm, f32, 7, 13, 12>::nominal();
        let plant = Plant::new(robot, effects, SpaceArm::at(STOWED), apply);
        let mut floating = plant::Floating(plant);
        for _ in 0..100 {
            Simulated::<f32, 6>::step(&mut floating, &[1.0; 6], &resistance, 1e-3).unwrap();
        }
        floating.0.state.qd[6..].iter().all(|qd| qd.abs() < 1e-3)
    };
    assert!(still(1e5) && !still(0.0));
}
