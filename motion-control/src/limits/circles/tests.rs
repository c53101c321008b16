use super::*;
use dynamics_core::model::{BASE, Body, Joint, JointLimits};

const Z: [f64; 3] = [0.0, 0.0, 1.0];

const fn range(end: f64) -> JointLimits<f64> {
    JointLimits { lower: -end, upper: end, ..JointLimits::NONE }
}

#[test]
fn only_continuous_joints_that_count_no_turns_are_circles() {
    let body = |parent, joint| Body::new("b", parent, joint).mass(1.0);
    let model = Model::<f64, 7, 6, 6>::new(
        "all",
        [
            body(BASE, Joint::continuous(Z)),
            body(0, Joint::revolute(Z)),
            body(1, Joint::fixed()),
            body(2, Joint::continuous(Z)).limits(range(2.0)),
            body(3, Joint::continuous(Z)).limits(range(4.0 * PI)),
            body(4, Joint::prismatic(Z)),
            body(5, Joint::revolute(Z)).limits(range(4.0 * PI)),
        ],
    );
    assert_eq!(Circles::of(&model), Circles::NONE.with(0).with(2));
}

#[test]
fn way_points_are_shortened_for_circles_alone() {
    let mut points = [[25.13_f32, 25.13], [-3.0, -3.0], [3.0, 3.0]];
    Circles::NONE.with(0).shorten(&mut points);
    assert!((points[0][0] + 0.0027).abs() < 1e-3 && points[1][0] == -3.0);
    assert!((points[2][0] + 3.2832).abs() < 1e-3);
    assert_eq!(points.map(|[_, slide]| slide), [25.13, -3.0, 3.0]);
}

#[test]
fn the_last_joint_that_can_be_a_circle_is_number_127() {
    let last = Circles::NONE.with(127);
    assert!(last.has(127) && last.any() && !last.has(128) && !last.has(126));
    assert_eq!(last.counted(127), Circles::NONE);
    assert_eq!(last.counted(128), last);
}
