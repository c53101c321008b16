//! Positions, velocities and accelerations of joints in the library's coordinates, from
//! one-coordinate chains.

use dynamics_core::glam::{DMat3, DQuat, DVec3};
use num_dual::Dual2_64;

use super::energy::{axes, identity, moved};
use crate::description::Kind;

/// The motion of a joint in the library's coordinates, and the derivatives ∂v/∂u̇, a column for
/// each coordinate u.
#[derive(Clone, Debug)]
pub struct JointMotion {
    /// Position: (x, y, z, w) of a quaternion first.
    pub q: Vec<f64>,
    /// Velocity: that of the body in its own frame, angular first.
    pub qd: Vec<f64>,
    /// The derivative of the velocity's components.
    pub qdd: Vec<f64>,
    /// The derivatives ∂v/∂u̇.
    pub columns: Vec<Vec<f64>>,
}

/// The motion of a joint at coordinates u of its chain.
pub fn motion(kind: Kind, u: &[f64], ud: &[f64], udd: &[f64]) -> JointMotion {
    if kind.has_axis() {
        return JointMotion {
            q: u.to_vec(),
            qd: ud.to_vec(),
            qdd: udd.to_vec(),
            columns: vec![vec![1.0]],
        };
    }
    let [pose, rate, second] = derivatives(kind, u, ud, udd);
    let columns = (0..u.len()).map(|i| {
        let unit: Vec<f64> = (0..u.len()).map(|k| if k == i { 1.0 } else { 0.0 }).collect();
        let [pose, rate, _] = derivatives(kind, u, &unit, &vec![0.0; u.len()]);
        selected(kind, velocity(&pose, &rate))
    });
    // The derivative of Rᵀ Ṙ and Rᵀ ṗ.
    let [(r, _), (r_dot, p_dot), (r_ddot, p_ddot)] = [&pose, &rate, &second];
    let omega_dot = axial(r_dot.transpose() * *r_dot + r.transpose() * *r_ddot);
    let v_dot = r_dot.transpose() * *p_dot + r.transpose() * *p_ddot;
    JointMotion {
        q: position(kind, &pose, u),
        qd: selected(kind, velocity(&pose, &rate)),
        qdd: selected(kind, [omega_dot, v_dot]),
        columns: columns.collect(),
    }
}

type Matrices = (DMat3, DVec3);

/// The pose of a chain with its first and second derivative in time.
fn derivatives(kind: Kind, u: &[f64], ud: &[f64], udd: &[f64]) -> [Matrices; 3] {
    let in_time = |k: usize| Dual2_64::new(u[k], ud[k], udd[k]);
    let u: Vec<_> = (0..u.len()).map(in_time).collect();
    let pose = moved(identity(), axes(kind), &u);
    let part = |of: fn(&Dual2_64) -> f64| {
        let column = |k: usize| DVec3::from_array([0, 1, 2].map(|i| of(&pose[i][k])));
        (DMat3::from_cols(column(0), column(1), column(2)), column(3))
    };
    [part(|x| x.re), part(|x| x.v1), part(|x| x.v2)]
}

/// Angular and linear velocity in the body's frame.
fn velocity((r, _): &Matrices, (r_dot, p_dot): &Matrices) -> [DVec3; 2] {
    [axial(r.transpose() * *r_dot), r.transpose() * *p_dot]
}

/// The vector of the antisymmetric part.
fn axial(m: DMat3) -> DVec3 {
    let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis];
    DVec3::new(y.z - z.y, z.x - x.z, x.y - y.x) * 0.5
}

/// The components that a kind of joint has.
fn selected(kind: Kind, [angular, linear]: [DVec3; 2]) -> Vec<f64> {
    match kind {
        Kind::Spherical => angular.to_array().to_vec(),
        Kind::Planar => vec![angular.z, linear.x, linear.y],
        _ => [angular.to_array(), linear.to_array()].concat(),
    }
}

fn position(kind: Kind, (r, p): &Matrices, u: &[f64]) -> Vec<f64> {
    let quaternion = DQuat::from_mat3(r).to_array().to_vec();
    match kind {
        Kind::Spherical => quaternion,
        Kind::Planar => vec![u[2], u[0], u[1]],
        _ => [quaternion, p.to_array().to_vec()].concat(),
    }
}
