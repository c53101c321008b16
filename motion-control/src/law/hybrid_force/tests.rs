use dynamics_core::glam::{DMat3, DVec3};

use super::*;

#[test]
fn directions_of_a_task_are_the_axes_of_its_frame() {
    // Columns that differ in each component.
    let axes = DMat3::from_axis_angle(DVec3::new(2.0, -3.0, 6.0) / 7.0, 0.8);
    let columns = [axes.x_axis, axes.y_axis, axes.z_axis];
    let along = columns.map(|axis| Force::<f64>::new(DVec3::ZERO, axis));
    let about = columns.map(|axis| Force::<f64>::new(0.25 * axis, DVec3::ZERO));
    let frame = TaskFrame::<f64> { axes };
    assert_eq!(frame.place(), along);
    let turn_and_place = frame.turn_and_place(0.25);
    assert_eq!(turn_and_place[..3], about);
    assert_eq!(turn_and_place[3..], along);
    let base = TaskFrame::<f64>::BASE.place().map(|direction| direction.lin);
    assert_eq!(base, [DVec3::X, DVec3::Y, DVec3::Z]);
}

#[test]
fn commands_are_a_damped_oscillator_and_a_force_with_its_excess() {
    let motion = TaskCommand::motion(TaskMotion {
        error: 0.5,
        error_rate: 0.25,
        acceleration: 3.0,
        omega_n: 4.0,
        zeta: 0.75,
    });
    // 3 + 2 · 0.75 · 4 · 0.25 + 16 · 0.5.
    assert_eq!(motion, TaskCommand::Motion { acceleration: 12.5 });
    let force = TaskCommand::force(TaskForce {
        desired: 10.0,
        measured: 6.0,
        gain: 0.5,
        velocity: 0.25,
        damping: 8.0,
    });
    // 10 + 0.5 · 4, and −8 · 0.25.
    let (force_of, acceleration) = (12.0, -2.0);
    assert_eq!(force, TaskCommand::Force { force: force_of, acceleration });
}
