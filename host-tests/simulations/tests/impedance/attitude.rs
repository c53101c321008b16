//! The error of attitude.

use crate::common::*;
use glam::{DMat3, DQuat, DVec3};
use motion_control::law::quaternion_error;

#[test]
fn the_shortest_rotation_is_found_from_every_attitude() {
    let (mut rng, mut worst) = (Rng::new(43), [(); 2].map(|()| Worst::default()));
    for k in 0..2000 {
        let from = DQuat::from_slice(&rng.vector::<4>(1.0)).normalize();
        let axis = DVec3::from(rng.vector(1.0)).normalize();
        // Every tenth within 10⁻⁹ of half a turn or of none.
        let angle = match k % 20 {
            0 => core::f64::consts::PI - 1e-9,
            10 => 1e-9,
            _ => rng.within(3.1),
        };
        let to = DQuat::from_axis_angle(axis, angle) * from;
        let want = axis * (2.0 * (0.5 * angle).sin());
        let (from, to) = (DMat3::from_quat(from), DMat3::from_quat(to));
        worst[0].see(quaternion_error::<f64>(&from, &to).to_array(), want.to_array());
        let error = quaternion_error::<f32>(&from.as_mat3(), &to.as_mat3()).as_dvec3();
        // In f32 half a turn has two directions.
        let error = if angle > 3.12 && error.dot(want) < 0.0 { -error } else { error };
        worst[1].see(error.to_array(), want.to_array());
    }
    let mut verdict = Verdict::default();
    verdict.see("rotations", "shortest rotation", "f64", &worst[0]);
    verdict.see("rotations", "shortest rotation", "f32", &worst[1]);
    verdict.speak();
    for half in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ONE.normalize()] {
        let turn = DMat3::from_quat(DQuat::from_xyzw(half.x, half.y, half.z, 0.0));
        let error = quaternion_error::<f64>(&DMat3::IDENTITY, &turn);
        assert!((error.length() - 2.0).abs() < 1e-15 && error.cross(half).length() < 1e-15);
    }
}
