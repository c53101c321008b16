//! Laws of inverse and forward dynamics with clusters, on 200 random states of every robot.

use cluster_tests::{FiveBarLeg, FloatingAnkle, Geared, Random, Wrist, apart, largest};
use dynamics_core::algorithms::MassMatrix;
use dynamics_core::clusters::{Clustered, ClusteredRobot};
use dynamics_core::effects::{Armature, Coriolis, Gravity, Inertia, RIGID_BODY, Viscous};
use dynamics_core::model::Static;
use dynamics_core::state::{RobotState, State};
use dynamics_core::{Core, Engine, algorithms};
use firmware_demo::robots::{AnkleLeg, FourBarLeg};

type Scene<const V: usize> = (
    Gravity,
    Inertia,
    Coriolis,
    Viscous<[f64; V]>,
    Armature<f64, V>,
);

/// x with M x = τ, by elimination: M is positive definite.
fn solved<const N: usize>(m: &MassMatrix<f64, N>, tau: &[f64; N]) -> [f64; N] {
    let mut a: [[f64; N]; N] = core::array::from_fn(|i| core::array::from_fn(|j| m.get(i, j)));
    let mut x = *tau;
    for k in 0..N {
        for i in k + 1..N {
            let l = a[i][k] / a[k][k];
            for j in k..N {
                a[i][j] -= l * a[k][j];
            }
            x[i] -= l * x[k];
        }
    }
    for k in (0..N).rev() {
        for j in k + 1..N {
            x[k] -= a[k][j] * x[j];
        }
        x[k] /= a[k][k];
    }
    x
}
