//! Naive alternatives of other codes, which fail.

use super::setup::turning;
use dynamics_core::algorithms::{crba, rnea};
use dynamics_core::model::ArmModel;
use dynamics_core::scalar::{Matrix, Real, Vector};
use dynamics_core::spatial::{Force, Motion, SpatialInertia, Xform};
use dynamics_core::state::{JointTrig, State};
use fixtures::hard::Scene;

/// Forward dynamics whose pivots are lifted to an absolute floor.
pub fn floored<R: Real, const N: usize>(
    arm: &ArmModel<R, N>,
    state: &State<R, N, N>,
    tau: &[R; N],
    scene: &Scene<R, N>,
    floor: f64,
) -> [R; N] {
    let still = State { qdd: [R::ZERO; N], ..*state };
    let arm = turning(arm);
    let bias = rnea(&arm, &still, scene);
    let m = crba(&arm, &state.q, scene);
    let mut rows: [[R; N]; N] = std::array::from_fn(|i| std::array::from_fn(|j| m.get(i, j)));
    let mut x: [R; N] = std::array::from_fn(|i| tau[i] - bias[i]);
    let floor = R::from_f64(floor);
    for k in (0..N).rev() {
        if rows[k][k] < floor {
            rows[k][k] = floor;
        }
        for i in 0..k {
            let l = rows[k][i] / rows[k][k];
            let pivot_row = rows[k];
            for (entry, &m) in rows[i].iter_mut().zip(&pivot_row).take(i + 1) {
                *entry -= l * m;
            }
            let product = l * x[k];
            x[i] -= product;
        }
    }
    for k in 0..N {
        for i in 0..k {
            let product = rows[k][i] * x[i];
            x[k] -= product;
        }
        x[k] = x[k] / rows[k][k];
    }
    x
}

/// Inverse dynamics with all motions, inertias and forces about the base's origin, in base
/// coordinates.
pub fn absolute<R: Real, const N: usize>(
    arm: &ArmModel<R, N>,
    state: &State<R, N, N>,
    g: R::Vec3,
) -> [R; N] {
    let trig = JointTrig::new(arm, &state.q);
    let (mut v, mut a) = (Motion::ZERO, Motion::new(R::Vec3::ZERO, -g));
    let mut x = Xform::IDENTITY;
    let (mut axes, mut forces) = ([Motion::ZERO; N], [Force::ZERO; N]);
    for i in 0..N {
        let link = dynamics_core::model::RobotModel::link(arm, i).expect("a chain");
        x = link.xform(&trig.coordinates) * x;
        let along = x.rot.transpose_mul(R::Vec3::new(R::ZERO, R::ZERO, R::ONE));
        let axis = Motion::new(along, x.pos.cross(along));
        v += axis * state.qd[i];
        a += axis * state.qdd[i];
        a += v.cross(axis) * state.qd[i];
        forces[i] = about_origin(&arm.links[i].inertia, &x).force(a, v);
        axes[i] = axis;
    }
    let (mut tau, mut sum) = ([R::ZERO; N], Force::ZERO);
    for i in (0..N).rev() {
        sum += forces[i];
        tau[i] = axes[i].dot(sum);
    }
    tau
}

/// An inertia about the base's origin. RBDA (2.66).
fn about_origin<R: Real>(inertia: &SpatialInertia<R>, x: &Xform<R>) -> SpatialInertia<R> {
    let (e, p) = (x.rot, x.pos);
    let h = e.transpose_mul(inertia.first_moment);
    let moment = h + p * inertia.mass;
    let turned = e.transpose() * inertia.rotational * e;
    let inertia_there =
        turned - crossed::<R>(p) * crossed::<R>(h) - crossed::<R>(moment) * crossed::<R>(p);
    SpatialInertia { mass: inertia.mass, first_moment: moment, rotational: inertia_there }
}

/// \[v\]×
fn crossed<R: Real>(v: R::Vec3) -> R::Mat3 {
    let ([x, y, z], o) = (v.array(), R::ZERO);
    R::Mat3::from_cols(R::Vec3::new(o, z, -y), R::Vec3::new(-z, o, x), R::Vec3::new(y, -x, o))
}
