//! Damping, springs, dry friction and rotors of all joints at once, against MuJoCo.

use super::*;
use dynamics_core::Core;
use dynamics_core::effects::{Armature, Coulomb, RIGID_BODY, Spring, Viscous, Width};
use dynamics_core::robots::Ur5e;
use host_tests::recordings::{read, row};

/// The output of `host-tests/oracle/passive.py`.
#[derive(serde::Deserialize)]
struct Passive {
    damping: [f64; 6],
    friction: [f64; 6],
    stiffness: [f64; 6],
    rest: [f64; 6],
    armature: [f64; 6],
    q: Vec<Vec<f64>>,
    qd: Vec<Vec<f64>>,
    qdd: Vec<Vec<f64>>,
    tau: Vec<Vec<f64>>,
}

fn agree<R: Real>(r: &Passive) {
    let cast = |values: &[f64; 6]| values.map(R::from_f64);
    let scene = (
        RIGID_BODY,
        Viscous(cast(&r.damping)),
        // MuJoCo's joints slip at 0.5 rad/s and more: beyond the width of the smooth sign.
        Coulomb { torque: cast(&r.friction), width: Width::new(R::from_f64(0.01)) },
        Spring { stiffness: cast(&r.stiffness), rest: cast(&r.rest) },
        Armature(cast(&r.armature)),
    );
    let mut worst = Worst::default();
    for i in 0..r.q.len() {
        let state =
            State { q: cast(&row(&r.q, i)), qd: cast(&row(&r.qd, i)), qdd: cast(&row(&r.qdd, i)) };
        worst.see_all(&Core::<Ur5e>::rnea(&state, &scene), &row::<6>(&r.tau, i));
    }
    worst.check::<R>("ur5e", "passive joints");
}

#[test]
fn damping_springs_friction_and_rotors_are_those_of_mujoco() {
    let r: Passive = read("passive_ur5e");
    assert_eq!(r.q.len(), 50);
    agree::<f64>(&r);
    agree::<f32>(&r);
}
