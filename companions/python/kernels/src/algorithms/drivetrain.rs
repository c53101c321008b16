//! The algorithms for robots with elastic joints.

use dynamics_core::drivetrain::{ElasticJoints, ElasticReference, elastic_inverse_dynamics};
use dynamics_core::model::RobotModel;
use dynamics_core::scalar::Real;

use super::*;
use crate::scene::Differentiable;

algorithm! {
    /// Torques, positions and velocities of the motors, of q with four derivatives; stiffness,
    /// rotors and friction of the joints.
    ElasticInverseDynamics<'a> { joints: [&'a [f64]; 3] }, none, |this, robot, counts, scene, row| {
        let [stiffness, rotor, friction] = this.joints.map(|values| {
            std::array::from_fn(|i| values.get(i).map_or(R::ONE, |&x| R::from_f64(x)))
        });
        let reference = ElasticReference {
            state: state(row, counts, 3),
            jerk: filled(row, 3, counts.v),
            snap: filled(row, 4, counts.v),
        };
        let joints = ElasticJoints { stiffness, rotor, friction };
        let scene = Differentiable::<R, V, false>(parts_of(scene));
        let found = elastic_inverse_dynamics(robot, &joints, &reference, &scene)?;
        for (i, values) in [found.torque, found.position, found.velocity].iter().enumerate() {
            put(row, i, 0, &values[..counts.v]);
        }
    }
}
