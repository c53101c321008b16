use dynamics_core::glam::{DMat3, DVec3};

use super::*;
use crate::law::hybrid_force::orientation_error;

/// As near to half a turn as its direction is known.
const HALF_A_TURN: f64 = core::f64::consts::PI - 5e-8;

const AXES: [DVec3; 6] = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];

/// An attitude with no zero in its matrix.
fn attitude() -> DMat3 {
    DMat3::from_axis_angle(DVec3::new(2.0, -3.0, 6.0) / 7.0, 0.8)
}

fn near(got: DVec3, want: DVec3) {
    let off = (got - want).abs().max_element();
    assert!(off < 1e-13, "{got}, not {want}");
}

#[test]
fn an_error_of_attitude_is_along_its_axis_in_the_base() {
    // Each component is the largest one of an axis.
    let [a, b, c] = [-0.36, 0.48, 0.8];
    let skew = [[a, b, c], [b, c, a], [c, a, b]].map(DVec3::from_array);
    for axis in AXES.into_iter().chain(skew).chain(skew.map(|axis| -axis)) {
        // The largest component of the quaternion is the scalar one, then one of the others, and
        // then no other is usable.
        for angle in [0.0, 1e-6, 0.3, 1.5, 2.2, 3.1, HALF_A_TURN] {
            let turn = DMat3::from_axis_angle(axis, angle);
            let wanted = turn * attitude();
            let got = quaternion_error::<f64>(&attitude(), &wanted);
            near(got, axis * (2.0 * (0.5 * angle).sin()));
            let got = orientation_error::<f64>(&attitude(), &wanted);
            near(got, axis * angle.sin());
        }
    }
}

#[test]
fn beyond_half_a_turn_the_short_way_is_back() {
    for axis in AXES {
        let wanted = DMat3::from_axis_angle(axis, 3.3) * attitude();
        let back = 0.5 * (core::f64::consts::TAU - 3.3);
        let got = quaternion_error::<f64>(&attitude(), &wanted);
        near(got, axis * (-2.0 * back.sin()));
    }
}

#[test]
fn a_pose_error_leads_from_the_pose_to_the_wanted_one() {
    for axis in AXES {
        let pose = Pose::<f64> { rot: attitude(), pos: DVec3::new(0.25, -0.5, 2.0) };
        let wanted = Pose::<f64> {
            rot: DMat3::from_axis_angle(axis, 0.4) * attitude(),
            pos: DVec3::new(1.5, 0.75, -1.0),
        };
        let error = pose_error(&pose, &wanted);
        near(error.ang, axis * (2.0 * 0.2_f64.sin()));
        assert_eq!(error.lin, DVec3::new(1.25, 1.25, -3.0));
    }
}
